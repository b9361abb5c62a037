"""LinuxCNC tool tables: one reader for the shop's own tools and for those of a control.

A table has a tool a line, `T1 P1 Z0.5 D0.25 Q0 ;remark`: a letter and a number at a time, in any order, and a remark
behind the semicolon.  It does not say its unit: lengths are in the machine's.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Final

from core.finding import Finding, Severity
from core.program.fields import TOOL, check
from core.program.model import Entry, Tool
from core.tolerance import LARGEST
from core.units import Unit, convert, printable

CODE: Final = "TOOLTABLE"
HOW: Final = "write T1 P1 D.25 Z0"
LETTERS: Final = "TPXYZABCUVWDIJQ"
"""The words a LinuxCNC table knows."""
MOST_LINES: Final = 10_000
"""A table with more lines is none."""
MOST_FAULTS: Final = 3
"""Faults that are told one by one."""
_WORD: Final = re.compile(r"\s*([A-Za-z])\s*([-+]?(?:\d+(?:\.\d*)?|\.\d+))(?=[\sA-Za-z]|$)")
_BREAK: Final = re.compile(r"\r\n|\n|\r")


@dataclass(frozen=True, slots=True)
class Listed:
    """One line of a table, in its own unit: its words by letter, where each stands (column from 1), and its remark."""

    line: int
    number: int
    words: Mapping[str, float]
    columns: Mapping[str, int]
    remark: str = ""

    def finding(self, severity: Severity, letter: str, text: str) -> Finding:
        """Trouble with one word of this line."""
        return Finding(CODE, severity, text, line=self.line, column=self.columns.get(letter, 1))


@dataclass(frozen=True, slots=True)
class Imported:
    """A whole table's tools in the program's unit, in order of number; none at all while there is an error."""

    tools: tuple[Tool, ...] = ()
    findings: tuple[Finding, ...] = field(default_factory=tuple)

    @property
    def errors(self) -> tuple[Finding, ...]:
        """What stands against importing it."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)


def faults(name: str, findings: Sequence[Finding]) -> str:
    """What stands against a table of this name: the first few faults, a line each, and how many more there are."""
    told = [f"{name}, line {one.line}, column {one.column}: {one.text}" for one in findings[:MOST_FAULTS]]
    if more := len(findings) - len(told):
        told.append(f"{name}: {more} more fault{'s' if more > 1 else ''}.")
    return "\n".join(told)


def decoded(data: bytes) -> str:
    """A table's text: UTF-8, or byte for byte where it is none."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def listed(lines: Iterable[str]) -> Iterator[Listed | Finding]:
    """Every line that has words, or what is wrong with it; blank lines and remarks alone are passed over."""
    for number, text in enumerate(lines, 1):
        words, _, remark = text.partition(";")
        if words.strip():
            yield _line(number, words, remark.strip())


def read_tool_table(text: str, unit: Unit, program: Unit) -> Imported:
    """The tools of a table whose lengths are in `unit`, for a program that is in `program`.

    The remark becomes the tool's type.  A tool without a diameter comes with a blank one and a warning.
    """
    rows: list[Listed] = []
    findings: list[Finding] = []
    lines = _BREAK.split(text)
    if len(lines) > MOST_LINES:
        findings.append(_whole(f"This has more than {MOST_LINES} lines: it is no tool table."))
    for one in listed(lines[:MOST_LINES]):
        if isinstance(one, Finding):
            findings.append(one)
        else:
            rows.append(one)
    findings += [finding for one in rows for finding in _objections(one, unit, program)] + list(_twice(rows))
    if not rows and not findings:
        findings.append(_whole("There is no tool in this table."))
    findings.sort(key=lambda finding: (finding.line or 0, finding.column or 0))
    if any(finding.severity is Severity.ERROR for finding in findings):
        return Imported((), tuple(findings))
    tools = sorted((_tool(one, unit, program) for one in rows), key=lambda tool: tool.number)
    return Imported(tuple(tools), tuple(findings))


def _whole(text: str) -> Finding:
    return Finding(CODE, Severity.ERROR, text, line=1, column=1)


def _line(line: int, text: str, remark: str) -> Listed | Finding:
    end, words, columns = 0, dict[str, float](), dict[str, int]()
    while found := _WORD.match(text, end):
        letter, column = found[1].upper(), found.start(1) + 1
        trouble = _word_trouble(letter, float(found[2]), words)
        if trouble is not None:
            return Finding(CODE, Severity.ERROR, trouble, line=line, column=column)
        words[letter], columns[letter], end = float(found[2]), column, found.end()
    if rest := text[end:].strip():
        column = end + len(text[end:]) - len(text[end:].lstrip()) + 1
        text = f"{_quoted(rest)} is no word of a tool table; {HOW}."
        return Finding(CODE, Severity.ERROR, text, line=line, column=column)
    if "T" not in words or not words["T"].is_integer():
        text = f"A tool table's line needs a whole tool number; {HOW}."
        return Finding(CODE, Severity.ERROR, text, line=line, column=columns.get("T", 1))
    return Listed(line, int(words["T"]), words, columns, remark)


def _quoted(text: str) -> str:
    """A piece of the table as a message repeats it; braces would be taken for the place of a length."""
    return printable(text).replace("{", "?").replace("}", "?")


def _word_trouble(letter: str, value: float, words: Mapping[str, float]) -> str | None:
    if letter not in LETTERS:
        return f"{letter} is no word of a tool table; {HOW}."
    if letter in words:
        return f"{letter} stands twice in this line."
    if not isfinite(value) or abs(value) > LARGEST:
        return "A number of this line is too large for any tool."
    return None


def _objections(one: Listed, unit: Unit, program: Unit) -> Iterator[Finding]:
    """What the shop's own table cannot take, though a control may."""
    number, _, size = TOOL
    if (trouble := check(number, one.number, program)) is not None:
        yield one.finding(Severity.ERROR, "T", trouble)
    value = one.words.get("D", 0.0)
    if value == 0.0:
        yield one.finding(Severity.WARNING, "D", f"Tool {one.number} has no diameter: it stays blank.")
    elif (trouble := check(size, convert(value, unit, program), program)) is not None:
        yield one.finding(Severity.ERROR, "D", trouble)


def _twice(rows: Iterable[Listed]) -> Iterator[Finding]:
    first: dict[int, int] = {}
    for one in rows:
        before = first.setdefault(one.number, one.line)
        if before != one.line:
            yield one.finding(Severity.ERROR, "T", f"Tool {one.number} stands in line {before} already.")


def _tool(one: Listed, unit: Unit, program: Unit) -> Tool:
    value = one.words.get("D", 0.0)
    size = Entry(convert(value, unit, program)) if value else None
    kind = "".join(sign for sign in one.remark if sign.isprintable())[:40].strip()
    return Tool(one.number, kind or Tool(one.number).type, size)
