"""Tool tables as the controls read them: numbers and diameters, and the reader of LinuxCNC's table files."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import Final

from core.controls.source import lines_of, shown
from core.finding import Finding, Severity
from core.tolerance import LARGEST
from core.units import Unit, to_mm


@dataclass(frozen=True, slots=True)
class CutterTool:
    """One tool: its diameter (negative where a control allows it), length and lathe orientation.

    `unit` None means the unit in which the program is when it takes the tool.
    """

    number: int
    diameter: float
    length: float = 0.0
    orientation: int = 0
    unit: Unit | None = None

    def diameter_mm(self, program: Unit) -> float:
        """Diameter in millimetres, in a program that is in this unit."""
        return to_mm(self.diameter, self.unit or program)


@dataclass(frozen=True, eq=False, slots=True)
class ToolTable:
    """The tools a control knows, by number."""

    tools: Mapping[int, CutterTool] = field(default_factory=dict)

    @staticmethod
    def of(*tools: CutterTool) -> ToolTable:
        """A table of these tools; a later one of the same number replaces an earlier one."""
        return ToolTable({tool.number: tool for tool in tools})

    @staticmethod
    def diameters(diameters: Mapping[int, float], unit: Unit | None = None) -> ToolTable:
        """A table of end mills of these diameters."""
        return ToolTable.of(*(CutterTool(number, diameter, unit=unit) for number, diameter in diameters.items()))

    def get(self, number: int) -> CutterTool | None:
        """The tool of a number, None where the table has none."""
        return self.tools.get(number)

    def with_tools(self, other: ToolTable) -> ToolTable:
        """This table with another's tools over it."""
        return ToolTable({**self.tools, **other.tools})


_WORD: Final = re.compile(r"\s*([A-Za-z])\s*([-+]?(?:\d+(?:\.\d*)?|\.\d+))")


def read_table(text: bytes, unit: Unit | None = None) -> tuple[ToolTable, tuple[Finding, ...]]:
    """The tools of a LinuxCNC table (`T1 P1 Z0 D.25 Q0 ;comment`, one tool a line), and what cannot be read."""
    tools: list[CutterTool] = []
    findings: list[Finding] = []
    for number, line in enumerate(lines_of(text), 1):
        words = line.split(";", 1)[0].strip()
        if not words:
            continue
        tool = _tool(words, unit)
        if isinstance(tool, str):
            findings.append(Finding("TOOLTABLE", Severity.ERROR, tool, line=number, column=1))
        else:
            tools.append(tool)
    return ToolTable.of(*tools), tuple(findings)


def _tool(text: str, unit: Unit | None) -> CutterTool | str:
    """One line of a table as a tool, or the sentence that says what is wrong with it."""
    end, values = 0, {}
    while found := _WORD.match(text, end):
        values[found[1].upper()] = float(found[2])
        end = found.end()
    if text[end:].strip():
        return f"{shown(text[end:])} is no word of a tool table; write T1 P1 D.25 Z0."
    if "T" not in values or not values["T"].is_integer() or not isfinite(values["T"]):
        return "A tool table's line needs a whole tool number; write T1 P1 D.25 Z0."
    if any(abs(value) > LARGEST for value in values.values()):
        return "A number of this line is too large for any tool."
    orientation = int(values.get("Q", 0.0))
    return CutterTool(int(values["T"]), values.get("D", 0.0), values.get("Z", 0.0), orientation, unit)
