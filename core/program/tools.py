"""The tool table: which tool a field calls, how large it is, and what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import assert_never

from core.finding import Finding, Severity
from core.program.entries import misfit
from core.program.fields import Form, check, field
from core.program.model import Entry, Program, Tool, Typed, Unread
from core.units import Unit, printable, to_mm


@dataclass(frozen=True, slots=True)
class Called:
    """A tool as a block calls it: `diameter` in millimeters, None where the table gives none that can be used."""

    type: str = ""
    diameter: float | None = None
    findings: tuple[Finding, ...] = ()


def find(program: Program, number: float) -> Tool | None:
    """The tool of that number, None if the table has none."""
    return next((tool for tool in program.tools if tool.number == number), None)


def called(program: Program, typed: Typed, name: str, severity: Severity = Severity.ERROR) -> Called:
    """The tool that field `name` (`tool` or `finish_tool`) calls.

    A blank and unreadable text call nothing and are for others to tell; 0 is no finish tool.
    `severity` weighs a diameter that cannot be used, which hurts less when the center runs on the contour.
    """
    if not isinstance(typed, Entry) or (name == "finish_tool" and typed.value == 0.0):
        return Called()
    tool = find(program, typed.value)
    if tool is None:
        text = f"Tool {typed.value:g} is not in the tool table: add it on TOOL SETUP, or call another."
        return Called(findings=(Finding("TOOL_MISSING", Severity.ERROR, text, 0, name),))
    trouble = _diameter_trouble(tool, program.unit)
    if trouble is not None:
        return Called(tool.type, None, (Finding("TOOL_DIAMETER", severity, trouble, 0, name),))
    assert isinstance(tool.diameter, Entry)
    outside = check(field(Form.TOOL, "diameter"), tool.diameter.value, program.unit)
    if outside is not None:
        told = Finding("TOOL_DIAMETER", severity, f"Tool {tool.number}: {outside}", 0, name)
        return Called(tool.type, None, (told,))
    return Called(tool.type, diameter(tool, program.unit))


def diameter(tool: Tool, unit: Unit) -> float | None:
    """Diameter in millimeters, None while it is blank, unreadable or not above 0."""
    match tool.diameter:
        case Entry(value) if isfinite(value) and value > 0.0:
            return to_mm(value, unit)
        case Entry() | Unread() | None:
            return None
        case _:
            assert_never(tool.diameter)


def _diameter_trouble(tool: Tool, unit: Unit) -> str | None:
    there = f"Tool {tool.number}: enter its diameter on TOOL SETUP"
    match tool.diameter:
        case None:
            return f"{there}; it is blank."
        case Unread(text, _):
            outside = misfit(text, field(Form.TOOL, "diameter"), unit)
            return f"Tool {tool.number}: {outside}" if outside else f"{there}; {printable(text)} cannot be read."
        case Entry(value) if not isfinite(value) or value <= 0.0:
            return f"{there}; it must be above 0, and it is {value:g}."
        case Entry():
            return None
        case _:
            assert_never(tool.diameter)
