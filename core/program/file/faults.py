"""This module locates faults in a program file's text: the line of a key, a cut-off text, and TOML syntax errors.

A truncated file can still be a valid, different program: `y_end = 3.5` becomes `y_end = 3`.  The first line of a file
that this program writes therefore announces its last line.  Both are comments: a file without the first, such as one
written by hand, needs no last one, and a file with text added after the last one is complete.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final

from core.program.file.write import LAST_LINE, LAST_LINE_NOTICE

KeyPath = tuple[str | int, ...]
"""The path to a value: table names, indices from 0 in arrays of tables, the key."""

LONGEST_QUOTE: Final = 40
"""The most characters of a line that a sentence quotes."""

_HEADER: Final = re.compile(r"\s*(\[\[?)\s*([\w.\s\"'-]+?)\s*\]\]?\s*(?:#.*)?$")
_KEY: Final = re.compile(r"\s*([\w.\s\"'-]+?)\s*=")
_BARE_KEY: Final = re.compile(r"\s*([A-Za-z_]+)\s*=")
_PROMISED: Final = re.compile(rf"^[ \t]*format[ \t]*=[^\n]*{re.escape(LAST_LINE_NOTICE)}", re.MULTILINE)
_ENDED: Final = re.compile(rf"^[ \t]*{LAST_LINE}[ \t]*\r?$", re.MULTILINE)
_TOML_FAULT: Final = re.compile(r"(.*) \(at (?:(line (\d+), column \d+)|end of document)\)", re.DOTALL)


def key_lines(text: str) -> Mapping[KeyPath, int]:
    """Return the line (from 1) of each table's header and of each key that starts a line."""
    lines: dict[KeyPath, int] = {(): 1}
    counts: dict[KeyPath, int] = {}
    table: KeyPath = ()
    for number, line in enumerate(text.splitlines(), 1):
        if header := _HEADER.match(line):
            table = _entered(_names(header[2]), counts, array=header[1] == "[[")
            lines.setdefault(table, number)
        elif key := _KEY.match(line):
            lines.setdefault((*table, *_names(key[1])), number)
    return lines


def _names(dotted: str) -> list[str]:
    return [name.strip().strip("\"'") for name in dotted.split(".")]


def _entered(names: list[str], counts: dict[KeyPath, int], *, array: bool) -> KeyPath:
    """Return the path of the table that a header opens, through the last element of each array of tables."""
    path: KeyPath = ()
    for name in names[:-1]:
        path = (*path, name)
        if path in counts:
            path = (*path, counts[path])
    path = (*path, names[-1])
    if not array:
        return path
    counts[path] = counts.get(path, -1) + 1
    return (*path, counts[path])


def line_of(lines: Mapping[KeyPath, int], path: KeyPath) -> int:
    """Return the line of a key, or of the nearest enclosing table that has one."""
    while path not in lines:
        path = path[:-1]
    return lines[path]


def truncation(text: str) -> str | None:
    """Return line and sentence for a text that announces a last line but lacks it, None for any other text."""
    if _PROMISED.search(text) is None or _ENDED.search(text) is not None:
        return None
    lines = text.rstrip().splitlines()
    return (
        f'line {len(lines)}: cut off after "{_quoted(lines[-1])}": the last line, "{LAST_LINE}", is missing. '
        "Open a saved copy or an earlier version; if nothing is missing, add that line."
    )


def _quoted(line: str) -> str:
    plain = "".join(character if character.isprintable() else "?" for character in " ".join(line.split()))
    return plain if len(plain) <= LONGEST_QUOTE else f"{plain[:LONGEST_QUOTE]}..."


def syntax_fault(fault: str, text: str) -> str:
    """Return a TOML reader's fault, with its line in front and a remedy at the end.

    A text that stops in the middle of its last line may be cut off there; the key of that line is named.
    """
    parts = _TOML_FAULT.fullmatch(fault)
    if parts is None:
        return "somewhere in it: a number has too many digits. Correct it there, or open a saved copy."
    problem, place, line = parts.groups()
    lines = text.splitlines() or [""]
    stops_in_last_line = line is None or (int(line) >= len(lines) and not text.endswith("\n"))
    if not stops_in_last_line:
        repeated_key = _BARE_KEY.match(lines[int(line) - 1]) if problem == "Cannot overwrite a value" else None
        if repeated_key is not None:
            return f"{place.partition(',')[0]}: {repeated_key[1]} appears twice: remove one."
        return f"{place}: {problem}. Correct it there, or open a saved copy."
    key = _BARE_KEY.match(lines[-1])
    where = f"line {len(lines)}{f', {key[1]}' if key else ''}"
    remedy = "The file may be cut off there: open a saved copy or an earlier version, or fix the line."
    return f"{where}: {problem}. {remedy}"
