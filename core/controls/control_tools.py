"""This module holds tool tables as controls read them, LinuxCNC's too; the program's own is in `program.tools`."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Final

from core.controls.program_text import lines_of
from core.finding import Finding
from core.program.tools import table_lines
from core.units import Unit, to_mm

MAX_DIGITS: Final = 8
"""Most digits of a tool's number; a longer one is a name."""


ToolId = int | str
"""A tool's number, or in Klartext the name it is called by, in capitals."""


def tool_id(text: str) -> ToolId:
    """Return a tool's number if the text is one, else its name in capitals."""
    return int(text) if text.isdecimal() and len(text) <= MAX_DIGITS else text.upper()


@dataclass(frozen=True, slots=True)
class CutterTool:
    """One tool: its number or name, diameter (negative where a control allows it), length and lathe orientation.

    `unit` None means the program's unit when it takes the tool.
    """

    number: ToolId
    diameter: float
    length: float = 0.0
    orientation: int = 0
    unit: Unit | None = None

    def diameter_mm(self, program: Unit) -> float:
        """Return the diameter in millimeters for a program in this unit."""
        return to_mm(self.diameter, self.unit or program)

    def length_mm(self, program: Unit) -> float:
        """Return the length in millimeters for a program in this unit."""
        return to_mm(self.length, self.unit or program)


@dataclass(frozen=True, eq=False, slots=True)
class ToolTable:
    """The tools a control knows, by number or name."""

    tools: Mapping[ToolId, CutterTool] = field(default_factory=dict)

    @staticmethod
    def of(*tools: CutterTool) -> ToolTable:
        """Return a table of these tools; a later one of the same number or name replaces an earlier one."""
        return ToolTable({tool.number: tool for tool in tools})

    def get(self, number: ToolId) -> CutterTool | None:
        """Return the tool with a number or name; None if the table has none."""
        return self.tools.get(number)

    def with_tools(self, other: ToolTable) -> ToolTable:
        """Return this table with another's tools added; those replace tools of the same number or name."""
        return ToolTable({**self.tools, **other.tools})

    def scaled(self, share: float) -> ToolTable:
        """Return this table with a share of each tool's diameter."""
        return ToolTable.of(*(replace(tool, diameter=share * tool.diameter) for tool in self.tools.values()))

    def without(self, number: ToolId) -> ToolTable:
        """Return this table without a tool."""
        return ToolTable({each: tool for each, tool in self.tools.items() if each != number})


@dataclass(frozen=True, slots=True)
class CommentedSize:
    """The tool diameter in a comment, as written there, with a unit if one follows, and the comment's line."""

    line: int
    diameter: str


def commented_size(lines: Sequence[str], number: ToolId) -> CommentedSize | None:
    """Return a tool's diameter from the first comment that gives it; a proposal, as no control reads comments.

    It recognizes `TOOL 1 END MILL DIAMETER 0.5000`, as cutcomp posts, and `T1 D=10.` of CAM posts.  It ignores
    fractions, several tools or sizes in one comment, and sizes of a shank, a wear or an offset.
    """
    for row, line in enumerate(lines, 1):
        for comment in _COMMENT.finditer(line):
            size = _COMMENTED.search(comment[0])
            if size is None or size[1].lstrip("0") != str(number) or _OTHER_SIZES.search(comment[0]):
                continue
            if len(_A_TOOL.findall(comment[0])) == len(_A_SIZE.findall(comment[0])) == 1 and float(size[2]) > 0.0:
                return CommentedSize(row, f"{size[2]}{size[3] or ''}")
    return None


_COMMENT: Final = re.compile(r"\([^)]*\)?|;.*")
_A_TOOL: Final = re.compile(r"\bT(?:OOL)?\s*\d", re.IGNORECASE)
_A_SIZE: Final = re.compile(r"\b(?:DIA(?:METER|\.)?\b|D\s*[=:])", re.IGNORECASE)
_OTHER_SIZES: Final = re.compile(r"\b(?:SHANK|WEAR|OFFSET|OFS)\b", re.IGNORECASE)
_COMMENTED: Final = re.compile(
    r"\bT(?:OOL)?\s*(\d{1,8})\b[^()]*?\b(?:DIA(?:METER|\.)?\s*[=:]?|D\s*[=:])\s*"
    r"(\d+\.\d+|\d+(?=\.?(?:[^\d.]|$))|\.\d+)\.?\s?(MM\b|IN\b)?(?!\s*[\d/,-])",
    re.IGNORECASE,
)
"""A tool's number, its diameter and the unit; a D without an equal sign is an offset number."""


def missing_tool(number: int | None) -> str:
    """Return the sentence that a table lacks a tool, and what to do; None is a number that is not whole."""
    which = "of this number" if number is None else str(number)
    return f"The tool table has no tool {which}. Enter it, or write the number of a tool in the table."


def read_table(text: bytes, unit: Unit | None = None) -> tuple[ToolTable, tuple[Finding, ...]]:
    """Return the tools of a LinuxCNC table (`T1 P1 Z0 D.25 Q0 ;comment`, one per line), and what cannot be read."""
    tools: list[CutterTool] = []
    findings: list[Finding] = []
    for line in table_lines(lines_of(text)):
        if isinstance(line, Finding):
            findings.append(line)
        else:
            words = line.words
            diameter, length, orientation = words.get("D", 0.0), words.get("Z", 0.0), int(words.get("Q", 0.0))
            tools.append(CutterTool(line.number, diameter, length, orientation, unit))
    return ToolTable.of(*tools), tuple(findings)
