"""This module holds tool tables as controls read them, LinuxCNC's too; the program's own is in `program.tools`."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import nan
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


ToolTable = Mapping[ToolId, CutterTool]
"""The tools a control knows, by number or name."""


def table_of(*tools: CutterTool) -> ToolTable:
    """Return a table of these tools; a later one of the same number or name replaces an earlier one."""
    return {tool.number: tool for tool in tools}


@dataclass(frozen=True, slots=True)
class CommentedSize:
    """The tool diameter in a comment, as written there, with a unit if one follows, and the comment's line."""

    line: int
    diameter: str


def commented_size(lines: Sequence[str], number: ToolId) -> CommentedSize | None:
    """Return a tool's diameter from the first comment that gives it; a proposal, as no control reads comments.

    The comment names the tool, or stands behind its T word.  Recognized are `TOOL 1 END MILL DIAMETER 0.5000`, as
    cutcomp posts, `T1 D=10.` and `TOOL - 1 DIA. - .5` of CAM posts, `T1 .5 DIA` and `T1 10MM ENDMILL`.  Comments with
    several tools or sizes, or with sizes of a shank, a wear, an offset or a hole, are ignored, and so are numbers that
    are a step, a depth, a stock, a length or a corner radius.
    """
    for row, line in enumerate(lines, 1):
        for comment in _COMMENT.finditer(line):
            named = _TOOL.findall(comment[0]) or _TOOL_WORD.findall(line[: comment.start()])
            size = _size_in(_TOOL.sub("", comment[0]))
            if size and [name.lstrip("0") for name in named] == [str(number)]:
                return CommentedSize(row, size)
    return None


def _size_in(comment: str) -> str:
    """Return the only diameter in a comment without tool numbers, with its unit if it has one; empty without one."""
    if _OTHER_SIZES.search(comment):
        return ""
    # the bar keeps what stands before such a number apart from what follows it
    comment = _OTHER_NUMBERS.sub(" | ", comment)
    sizes = [match for pattern in _SIZES for match in pattern.finditer(comment) if _number(match[1]) > 0.0]
    units = [match[2] for match in sizes if match[2]]
    # the same size may be given twice: 10MM ENDMILL, DIA 10.
    if len({_number(match[1]) for match in sizes}) != 1 or len({unit.upper() for unit in units}) > 1:
        return ""
    return f"{sizes[0][1].removesuffix('.')}{units[0] if units else ''}"


def _number(text: str) -> float:
    """Return the value of a number or a fraction, NaN for one over 0."""
    numerator, _, denominator = text.partition("/")
    return float(numerator) / (float(denominator or 1.0) or nan)


_COMMENT: Final = re.compile(r"\([^)]*\)?|;.*")
_TOOL: Final = re.compile(r"\bT(?:OOL)?\s*(?:[-#]\s*)?(\d{1,8})\b", re.IGNORECASE)
_TOOL_WORD: Final = re.compile(r"(?<![A-Z])T(?:OOL CALL)?\s{0,3}(\d{1,8})(?!\d)", re.IGNORECASE)
"""A tool in a program's own words, which need no spaces between them."""
_NUMBER: Final = r"(?<![A-Z\d./,])(?<!\d[ -])(\d{1,3}/\d{1,3}|\d{0,8}\.\d{1,8}|\d{1,8}\.?)(?![\d/]|\.\d)"
_UNIT: Final = r"\s?(MM\b|IN\b)?"
_KIND: Final = r"(?:(?:FLAT|SQUARE|CARBIDE|HSS|ROUGH\w*|FINISH\w*|\d ?FL(?:UTE)?S?)\s+)*(?:END ?MILL|EM)\b"
_FEATURE: Final = r"(?:BORE|HOLE|C\W?BORE|CIRCLE|POCKET|SLOT|BOSS)S?\b"
_OTHER_SIZES: Final = re.compile(
    rf"\b(?:SHANK|WEAR|OFFSET|OFS)\b|\b{_FEATURE}\s{{0,3}}[=:-]?\s{{0,3}}{_NUMBER}{_UNIT}\s{{0,3}}DIA"
    rf"|\bDIA(?:METER)?\.?\s{{0,3}}{_FEATURE}|\b{_FEATURE}\s{{0,3}}DIA",
    re.IGNORECASE,
)
_QUANTITY: Final = (
    r"(?:STEP[ -]?(?:OVER|DOWN)|DEPTH(?:\sOF\sCUT)?|DEEP|DOC|WOC|STOCK(?:\sTO\sLEAVE)?|LEAVE|ALLOWANCE|LENGTH|LEN|LONG"
    r"|LOC|OAL|REACH|STICK ?OUT|RAD(?:IUS)?|CR|R|(?<!\d)(?<!\d )FLUTES?)\b\.?"
)
_DIAMETER_WORD: Final = r"(?:\s{0,3}DIA(?:METER)?\b\.?)?"
_NO_NUMBER: Final = r"(?!\s{0,3}[=:-]?\s{0,3}[\d.])"
_OTHER_NUMBERS: Final = re.compile(
    # the word before its number, or after it where no other number follows the word
    rf"\b{_QUANTITY}\s{{0,3}}[=:-]?\s{{0,3}}{_NUMBER}{_UNIT}(?:{_DIAMETER_WORD}{_NO_NUMBER})?"
    rf"|\b(?:FINISH\w{{0,9}}|PASS)\s{{0,3}}{_NUMBER}{_UNIT}\s{{0,3}}DIA\b(?!\.?\s{{0,3}}{_KIND})"
    rf"|{_NUMBER}{_UNIT}{_DIAMETER_WORD}\s{{1,3}}{_QUANTITY}{_NO_NUMBER}",
    re.IGNORECASE,
)
"""A number that is no diameter of the tool, with the word that says what it is."""
_SIZES: Final = tuple(
    re.compile(pattern, re.IGNORECASE)
    for pattern in (
        rf"\b(?:DIA(?:METER\b|\b\.?)\s*(?:[=:-]\s*)?|D\s*[=:]\s*){_NUMBER}{_UNIT}(?!\s*[\d/,-]\d|\s*FL)",
        rf"{_NUMBER}{_UNIT}\s*DIA(?:METER)?\b(?!\.?\s*[=:-])",
        # a whole number without a unit may be what is left of a fraction
        rf"(?=[\d/]{{0,8}}[./]|\d{{1,8}}\s?(?:MM|IN)\b){_NUMBER}{_UNIT}\s*{_KIND}",
    )
)
"""A diameter and its unit; a D without an equal sign is an offset number."""


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
    return table_of(*tools), tuple(findings)
