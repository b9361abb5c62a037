"""This module reads a form's typed fields as millimeters and radians, with a finding for each unusable field.

It also measures a line or an arc: the value that each field of its form would have.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import atan2, degrees, radians, tau
from typing import Final

from core.finding import Finding, Severity
from core.geometry.piece import ANGLE_ROUNDING, Line, Piece, Point
from core.program.fields import NUMBER_FIELDS, Field, Form, typed_trouble
from core.program.model import Block, Number, PartSetup, Program, ProgramParameters, Relative, Segment, Typed
from core.program.solve.solved import Origin, Solved, Value
from core.units import Kind, Unit, from_mm, to_mm

ANGLE_FIELDS: Final = ("angle", "start_angle", "sweep")
"""The names of the fields in radians."""


@dataclass(frozen=True, slots=True)
class Reading:
    """A form's typed fields: `values` by name with blanks as None, `known` in millimeters and radians.

    In `known`, a relative number has its field's name with `_inc` appended.
    """

    values: dict[str, Value]
    known: dict[str, float]
    findings: tuple[Finding, ...]

    def copy(self) -> Reading:
        """Return an independent copy, into which calculated numbers can be put."""
        return Reading(dict(self.values), dict(self.known), self.findings)

    def fill(self, name: str, value: float | None, origin: Origin = Origin.CALCULATED) -> None:
        """Put a number that was not typed, in program units, into a field that is blank."""
        if value is not None and self.values[name] is None:
            self.values[name] = Solved(value, origin)


def read_form(
    form: Form, part: Block | Segment | ProgramParameters | PartSetup, unit: Unit, number: int | None
) -> Reading:
    """Read all numbers of a form, for segment `number`; an unusable one has a finding and is not in `known`."""
    values: dict[str, Value] = {}
    known: dict[str, float] = {}
    findings: list[Finding] = []
    for field in NUMBER_FIELDS[form]:
        typed = values[field.name] = getattr(part, field.name)
        if typed is None:
            continue
        trouble = typed_trouble(field, typed, unit)
        if trouble is None:
            assert isinstance(typed, Number | Relative)
            ending = "_inc" if isinstance(typed, Relative) else ""
            known[field.name + ending] = _internal(typed.value, field.kind, unit)
        else:
            code, text = trouble
            findings.append(Finding(code, Severity.ERROR, text, number, field.name))
    return Reading(values, known, tuple(findings))


def usable(field: Field, typed: Typed, unit: Unit) -> float | None:
    """Return a plain number in millimeters or radians; None for anything else or if the field does not accept it."""
    if not isinstance(typed, Number) or typed_trouble(field, typed, unit) is not None:
        return None
    return _internal(typed.value, field.kind, unit)


def _internal(value: float, kind: Kind, unit: Unit) -> float:
    """Convert a length to millimeters, a feed to millimeters per minute, an angle to radians."""
    if kind in (Kind.LENGTH, Kind.FEED):
        return to_mm(value, unit)
    return radians(value) if kind is Kind.ANGLE else value


def shared_findings(program: Program) -> Iterator[Finding]:
    """Yield findings on PROGRAM PARAMETERS and PART SETUP, which all blocks share, with the screen's name."""
    for form, part in ((Form.PARAMETERS, program.parameters), (Form.SETUP, program.setup)):
        for finding in read_form(form, part, program.unit, None).findings:
            yield replace(finding, text=f"{form.value}: {finding.text}")


def heading_at(piece: Piece, at: Point) -> float:
    """Return the direction of travel at a point of a piece in radians, from -pi to pi; 0 for a line without length."""
    if isinstance(piece, Line):
        return atan2(piece.end[1] - piece.start[1], piece.end[0] - piece.start[0])
    x, y = piece.direction_at(at)
    return atan2(y, x)


def measured(piece: Piece) -> dict[str, float]:
    """Return the values of a piece by field name, in millimeters and radians; names of relative ones end in `_inc`."""
    (x, y), (x_end, y_end) = piece.start, piece.end
    values = {"x_end": x_end, "y_end": y_end, "x_end_inc": x_end - x, "y_end_inc": y_end - y}
    heading = heading_at(piece, piece.start) % tau
    if tau - heading < ANGLE_ROUNDING:
        heading = 0.0
    if isinstance(piece, Line):
        return values | {"length": piece.length, "angle": heading}
    cx, cy = piece.center
    values |= {"x_center": cx, "y_center": cy, "x_center_inc": cx - x, "y_center_inc": cy - y}
    return values | {"radius": piece.radius, "sweep": abs(piece.sweep), "start_angle": heading}


def measured_fields(piece: Piece, unit: Unit) -> dict[str, float]:
    """Return the absolute values of a piece by field name, in program units and degrees."""
    return {
        name: degrees(value) if name in ANGLE_FIELDS else from_mm(value, unit)
        for name, value in measured(piece).items()
        if not name.endswith("_inc")
    }
