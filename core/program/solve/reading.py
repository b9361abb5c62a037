"""Reading: what is typed in a form's fields as millimeters and radians, and a finding for each that cannot be used."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from core.finding import Finding, Severity
from core.program.fields import NUMBER_FIELDS, Field, Form, text_refusal, unread_sentence, value_refusal
from core.program.model import Block, Number, PartSetup, Program, ProgramParameters, Relative, Segment, Typed, Unread
from core.program.solve.solved import Origin, Solved, Value
from core.units import Kind, Unit, to_mm, to_radians


@dataclass(frozen=True, slots=True)
class Reading:
    """A form's typed fields: `values` by name with blanks as None, `known` in millimeters and radians.

    A relative number is known by its field's name with the ending `_inc`.
    """

    values: dict[str, Value]
    known: dict[str, float]
    findings: tuple[Finding, ...]

    def copy(self) -> Reading:
        """A reading of its own, into which calculated numbers can be put."""
        return Reading(dict(self.values), dict(self.known), self.findings)

    def fill(self, name: str, value: float | None, origin: Origin = Origin.CALCULATED) -> None:
        """Put a number that was not typed, in program units, into a field that is blank."""
        if value is not None and self.values[name] is None:
            self.values[name] = Solved(value, origin)


def read_form(
    form: Form, part: Block | Segment | ProgramParameters | PartSetup, unit: Unit, number: int | None
) -> Reading:
    """Read all numbers of a form, of segment `number`; what cannot be used is not known and has a finding."""
    values: dict[str, Value] = {}
    known: dict[str, float] = {}
    findings: list[Finding] = []
    for field in NUMBER_FIELDS[form]:
        typed = values[field.name] = getattr(part, field.name)
        if typed is None:
            continue
        trouble = _trouble(field, typed, unit)
        if trouble is None:
            assert isinstance(typed, Number | Relative)
            ending = "_inc" if isinstance(typed, Relative) else ""
            known[field.name + ending] = _internal(typed.value, field.kind, unit)
        else:
            code, text = trouble
            findings.append(Finding(code, Severity.ERROR, text, number, field.name))
    return Reading(values, known, tuple(findings))


def usable(field: Field, typed: Typed, unit: Unit) -> float | None:
    """A typed number in millimeters or radians, None for a blank and for what the field does not take."""
    if not isinstance(typed, Number) or _trouble(field, typed, unit) is not None:
        return None
    return _internal(typed.value, field.kind, unit)


def _trouble(field: Field, typed: Number | Relative | Unread, unit: Unit) -> tuple[str, str] | None:
    """Code and sentence about a field that cannot be used."""
    if isinstance(typed, Number | Relative):
        refusal = value_refusal(field, typed.value, unit)
    elif (refusal := text_refusal(typed.text, field, unit)) is None:
        return "UNREADABLE", f"{field.label}: {unread_sentence(typed)}"
    return None if refusal is None else ("OUT_OF_RANGE", refusal)


def _internal(value: float, kind: Kind, unit: Unit) -> float:
    """Millimeters of a length, millimeters per minute of a feed, radians of an angle."""
    if kind in (Kind.LENGTH, Kind.FEED):
        return to_mm(value, unit)
    return to_radians(value) if kind is Kind.ANGLE else value


def shared_findings(program: Program) -> Iterator[Finding]:
    """What cannot be used of PROGRAM PARAMETERS and PART SETUP, which all blocks share, with the screen's name."""
    for form, part in ((Form.PARAMETERS, program.parameters), (Form.SETUP, program.setup)):
        for finding in read_form(form, part, program.unit, None).findings:
            yield replace(finding, text=f"{form.value}: {finding.text}")
