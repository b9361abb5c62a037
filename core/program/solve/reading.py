"""What is typed in a form's fields as millimeters and radians, with a finding for each field that cannot be used."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from types import MappingProxyType
from typing import Final

from core.finding import Finding, Severity
from core.program.entries import misfit
from core.program.fields import TABLES, Field, Form, bounds, check
from core.program.model import Block, Entry, Parameters, PartSetup, Segment, Unread
from core.program.solve.solved import Solved, Value
from core.units import Kind, Unit, from_mm, from_radians, printable, to_mm, to_radians


@dataclass(frozen=True, slots=True)
class Reading:
    """A form's typed fields: `values` by name with blanks as None, `known` in millimeters and radians."""

    values: dict[str, Value]
    known: dict[str, float]
    findings: tuple[Finding, ...]


def read(form: Form, part: Block | Segment | Parameters | PartSetup, unit: Unit, number: int) -> Reading:
    """Read all numbers of START, a segment or what blocks share; what cannot be used is not known and has a finding."""
    values: dict[str, Value] = {}
    known: dict[str, float] = {}
    findings: list[Finding] = []
    for name, one, factor, low, high in _NUMBERS[form, unit]:
        typed = values[name] = getattr(part, name)
        if typed is None:
            continue
        # a number between the bounds is taken at once; what is not is looked at closely
        inside = isinstance(typed, Entry) and low < typed.value < high
        fault = None if inside else _fault(one, typed, number, unit)
        if fault is None:
            known[name] = typed.value * factor
        else:
            findings.append(fault)
    return Reading(values, known, tuple(findings))


def _fault(one: Field, typed: Entry | Unread, number: int, unit: Unit) -> Finding | None:
    if isinstance(typed, Unread):
        outside = misfit(typed.text, one, unit)
        if outside is not None:
            return Finding("OUT_OF_RANGE", Severity.ERROR, outside, number, one.name)
        text = f"{one.label}: {printable(typed.text)} cannot be read. {typed.reason}"
        return Finding("UNREADABLE", Severity.ERROR, text, number, one.name)
    text = check(one, typed.value, unit) or ""
    return Finding("OUT_OF_RANGE", Severity.ERROR, text, number, one.name) if text else None


def _factor(kind: Kind, unit: Unit) -> float:
    if kind in (Kind.LENGTH, Kind.FEED):
        return to_mm(1.0, unit)
    return to_radians(1.0) if kind is Kind.ANGLE else 1.0


def _open(one: Field, unit: Unit) -> tuple[float, float]:
    """Bounds between which a field takes every number, themselves left out; none for whole numbers: an empty range."""
    if one.kind is Kind.COUNT:
        return inf, -inf
    low, high = bounds(one, unit)
    least, most = -inf if low is None else low, inf if high is None else high
    return least if one.above is None else max(least, one.above), most


def _numbers(form: Form, unit: Unit) -> tuple[tuple[str, Field, float, float, float], ...]:
    numbers = (one for one in TABLES[form] if one.kind not in (Kind.CHOICE, Kind.TEXT))
    return tuple((one.name, one, _factor(one.kind, unit), *_open(one, unit)) for one in numbers)


_NUMBERS: Final = MappingProxyType({(form, unit): _numbers(form, unit) for form in Form for unit in Unit})
"""The fields of a form that take a number, each with its factor into millimeters or radians and its open bounds."""


def fill(values: dict[str, Value], calculated: Mapping[str, float], unit: Unit) -> None:
    """Put calculated lengths and feeds, in millimeters, into the fields of `values` that are blank."""
    for name, value in calculated.items():
        if values[name] is None:
            values[name] = Solved(from_mm(value, unit))


def carry(values: dict[str, Value], name: str, value: float | None, unit: Unit) -> None:
    """Put a length or feed, in millimeters, that is taken over into its field if that is blank."""
    if value is not None and values[name] is None:
        values[name] = Solved(from_mm(value, unit))


def fill_angle(values: dict[str, Value], name: str, angle: float) -> None:
    """Put a calculated angle, in radians, into its field if that is blank."""
    if values[name] is None:
        values[name] = Solved(from_radians(angle))
