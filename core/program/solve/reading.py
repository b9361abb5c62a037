"""This module reads a form's typed fields as millimeters and radians, with a finding for each unusable field."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import radians

from core.finding import Finding, Severity
from core.program.fields import NUMBER_FIELDS, Field, Form, typed_trouble
from core.program.model import Block, Number, PartSetup, Program, ProgramParameters, Relative, Segment, Typed
from core.program.solve.solved import Origin, Solved, Value
from core.units import Kind, Unit, to_mm


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
