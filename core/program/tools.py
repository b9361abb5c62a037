"""This module finds called tools in the program's tool table and reads LinuxCNC's (others: `controls.control_tools`).

A LinuxCNC table has one tool per line, `T1 P1 Z0.5 D0.25 Q0 ;remark`: words of a letter and a number, in any order, and
a remark after the semicolon.  Lengths are in machine units, which the table does not name.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from typing import Final

from core.finding import Finding, Severity
from core.program.fields import TOOL, Form, field_of, typed_trouble, value_refusal
from core.program.model import Number, Program, Tool, Typed
from core.tolerance import LARGEST_COORDINATE
from core.units import Unit, convert, printable, to_mm


@dataclass(frozen=True, slots=True)
class CalledTool:
    """A tool as a block calls it: `diameter` in millimeters, None if the table has no usable one."""

    tool: Tool | None = None
    diameter: float | None = None
    findings: tuple[Finding, ...] = ()

    @property
    def type(self) -> str:
        """The type of the tool, empty if none is called."""
        return "" if self.tool is None else self.tool.type


def find_tool(program: Program, number: float) -> Tool | None:
    """Return the tool with a number, None if the table has none."""
    return next((tool for tool in program.tools if tool.number == number), None)


def called_tool(program: Program, typed: Typed, name: str, severity: Severity = Severity.ERROR) -> CalledTool:
    """Return the tool that field `name` (`tool` or `finish_tool`) calls.

    A blank or unreadable text calls no tool and is reported elsewhere; 0 means no finish tool.
    `severity` applies to an unusable diameter, which matters less if the tool center runs on the contour.
    """
    if not isinstance(typed, Number) or (name == "finish_tool" and typed.value == 0.0):
        return CalledTool()
    tool = find_tool(program, typed.value)
    if tool is None:
        text = f"Tool {typed.value:g} is not in the tool table: add it on TOOL SETUP, or call another."
        return CalledTool(findings=(Finding("TOOL_MISSING", Severity.ERROR, text, 0, name),))
    if tool.diameter is None:
        trouble = "enter its diameter on TOOL SETUP; it is blank."
    elif (fault := typed_trouble(field_of(Form.TOOL, "diameter"), tool.diameter, program.unit)) is not None:
        trouble = fault[1]
    else:
        assert isinstance(tool.diameter, Number)
        return CalledTool(tool, to_mm(tool.diameter.value, program.unit))
    text = f"Tool {tool.number}: {trouble}"
    return CalledTool(tool, None, (Finding("TOOL_DIAMETER", severity, text, 0, name),))


LARGEST_USUAL_DIAMETER: Final = {Unit.IN: 508.0, Unit.MM: 500.0}
"""Millimeters: hardly a cutter is larger than 20 in or 500 mm."""
INCH_STEPS: Final = 64
"""Steps of an inch in which inch cutters are made."""
MAX_DEPTH_IN_DIAMETERS: Final = 10.0
"""A cutter seldom goes deeper than this many times its diameter."""


def unusual_size(tool: str, diameter: float, unit: Unit, depth: float = 0.0) -> Finding | None:
    """Return the warning that a diameter (mm) may be in the wrong unit for a program in `unit`; None if it is usual.

    `tool` is how the sentence begins, `depth` how deep it cuts (mm).  A diameter below 1 mm counts as typed in inches
    if it is a usual inch size and either no usual one in millimeters, as .375, or far too thin for the depth.
    """
    text = ""
    if abs(diameter) > LARGEST_USUAL_DIAMETER[unit]:
        text = f"{tool} is {{value}} across, more than any usual cutter. Is its unit right?"
    elif unit is Unit.MM and _is_inch_size(diameter, depth):
        text = f"{tool} is {{value}} across. Was {Fraction(diameter)} in meant?"
    meant = f"The program is in {'INCH' if unit is Unit.IN else 'MM'}."
    return Finding("TOOL_SIZE", Severity.WARNING, f"{text} {meant}", value=diameter) if text else None


def _is_inch_size(diameter: float, depth: float) -> bool:
    """True if a diameter in millimeters looks as if it was typed in inches, for a cut of this depth."""
    if not 0.0 < diameter < 1.0 or not (diameter * INCH_STEPS).is_integer():
        return False
    usual_in_mm = (diameter * 4.0).is_integer()
    return not usual_in_mm or depth > MAX_DEPTH_IN_DIAMETERS * diameter


TOOL_TABLE: Final = "TOOLTABLE"
EXAMPLE: Final = "write T1 P1 D.25 Z0"
TABLE_LETTERS: Final = "TPXYZABCUVWDIJQ"
"""The letters of the words in a LinuxCNC table."""
MAX_TABLE_LINES: Final = 10_000
"""A file with more lines is not a tool table."""
MAX_TABLE_FAULTS: Final = 3
"""The most faults that are listed."""
_WORD: Final = re.compile(r"\s*([A-Za-z])\s*([-+]?(?:\d+(?:\.\d*)?|\.\d+))(?=[\sA-Za-z]|$)")
_BREAK: Final = re.compile(r"\r\n|\n|\r")


@dataclass(frozen=True, slots=True)
class TableLine:
    """One line of a table, in its own unit: its words by letter, the column of each from 1, and its remark."""

    line: int
    number: int
    words: Mapping[str, float]
    columns: Mapping[str, int]
    remark: str = ""

    def finding(self, severity: Severity, letter: str, text: str) -> Finding:
        """Return a finding on one word of this line."""
        return Finding(TOOL_TABLE, severity, text, line=self.line, column=self.columns.get(letter, 1))


@dataclass(frozen=True, slots=True)
class ImportedTools:
    """The tools of a table in the program's unit, sorted by number; none if there is any error."""

    tools: tuple[Tool, ...] = ()
    findings: tuple[Finding, ...] = ()

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The errors that prevent the import."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)


def table_faults(name: str, findings: Sequence[Finding]) -> str:
    """List the first few faults of a table with this name, one per line, and the number of further ones."""
    listed = findings[:MAX_TABLE_FAULTS]
    lines = [f"{name}, line {finding.line}, column {finding.column}: {finding.text}" for finding in listed]
    if more := len(findings) - len(listed):
        lines.append(f"{name}: {more} more fault{'s' if more > 1 else ''}.")
    return "\n".join(lines)


def decode_table(data: bytes) -> str:
    """Decode a table as UTF-8, or as Latin-1 if it is not UTF-8."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def table_lines(lines: Iterable[str]) -> Iterator[TableLine | Finding]:
    """Yield every line that has words, or its fault; skip blank lines and lines with only a remark."""
    for number, text in enumerate(lines, 1):
        words, _, remark = text.partition(";")
        if words.strip():
            yield _line(number, words, remark.strip())


def read_tool_table(text: str, unit: Unit, program: Unit) -> ImportedTools:
    """Return the tools of a table with lengths in `unit`, for a program in unit `program`.

    The remark becomes the tool's type.  A tool without a diameter gets a blank one and a warning.
    """
    rows: list[TableLine] = []
    findings: list[Finding] = []
    lines = _BREAK.split(text)
    if len(lines) > MAX_TABLE_LINES:
        findings.append(_fault(f"This has more than {MAX_TABLE_LINES} lines: it is not a tool table."))
    for row in table_lines(lines[:MAX_TABLE_LINES]):
        if isinstance(row, Finding):
            findings.append(row)
        else:
            rows.append(row)
    findings += [finding for row in rows for finding in _objections(row, unit, program)] + list(_duplicates(rows))
    if not rows and not findings:
        findings.append(_fault("There is no tool in this table."))
    findings.sort(key=lambda finding: (finding.line or 0, finding.column or 0))
    if any(finding.severity is Severity.ERROR for finding in findings):
        return ImportedTools((), tuple(findings))
    tools = sorted((_tool(row, unit, program) for row in rows), key=lambda tool: tool.number)
    return ImportedTools(tuple(tools), tuple(findings))


def _fault(text: str, line: int = 1, column: int = 1) -> Finding:
    return Finding(TOOL_TABLE, Severity.ERROR, text, line=line, column=column)


def _line(line: int, text: str, remark: str) -> TableLine | Finding:
    end, words, columns = 0, dict[str, float](), dict[str, int]()
    while word := _WORD.match(text, end):
        letter, column = word[1].upper(), word.start(1) + 1
        trouble = _word_trouble(letter, float(word[2]), words)
        if trouble is not None:
            return _fault(trouble, line, column)
        words[letter], columns[letter], end = float(word[2]), column, word.end()
    if rest := text[end:].strip():
        column = end + len(text[end:]) - len(text[end:].lstrip()) + 1
        return _fault(f"{_quoted(rest)} is not a word of a tool table; {EXAMPLE}.", line, column)
    if "T" not in words or not words["T"].is_integer():
        return _fault(f"A tool table's line needs a whole tool number; {EXAMPLE}.", line, columns.get("T", 1))
    return TableLine(line, int(words["T"]), words, columns, remark)


def _quoted(text: str) -> str:
    """Quote text of the table for a message; replace braces, which would be taken for placeholders of lengths."""
    return printable(text).replace("{", "?").replace("}", "?")


def _word_trouble(letter: str, value: float, words: Mapping[str, float]) -> str | None:
    if letter not in TABLE_LETTERS:
        return f"{letter} is not a word of a tool table; {EXAMPLE}."
    if letter in words:
        return f"{letter} appears twice in this line."
    if not isfinite(value) or abs(value) > LARGEST_COORDINATE:
        return "A number of this line is too large for any tool."
    return None


def _objections(row: TableLine, unit: Unit, program: Unit) -> Iterator[Finding]:
    """Yield findings on values that the program's tool table does not accept, although a control may."""
    number, _, size, *_ = TOOL
    if (trouble := value_refusal(number, row.number, program)) is not None:
        yield row.finding(Severity.ERROR, "T", trouble)
    value = row.words.get("D", 0.0)
    if value == 0.0:
        yield row.finding(Severity.WARNING, "D", f"Tool {row.number} has no diameter: it stays blank.")
    elif (trouble := value_refusal(size, convert(value, unit, program), program)) is not None:
        yield row.finding(Severity.ERROR, "D", trouble)


def _duplicates(rows: Iterable[TableLine]) -> Iterator[Finding]:
    lines_of: dict[int, int] = {}
    for row in rows:
        first_line = lines_of.setdefault(row.number, row.line)
        if first_line != row.line:
            yield row.finding(Severity.ERROR, "T", f"Tool {row.number} is already on line {first_line}.")


def _tool(row: TableLine, unit: Unit, program: Unit) -> Tool:
    value = row.words.get("D", 0.0)
    size = Number(convert(value, unit, program)) if value else None
    tool_type = "".join(character for character in row.remark if character.isprintable())[:40].strip()
    return Tool(row.number, tool_type or Tool(row.number).type, size)
