"""A setup sheet as plain text, 78 columns wide, nothing in it a printer or a terminal would obey."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from textwrap import wrap
from typing import Final

from core.output.sheet import Section, Sheet

WIDTH: Final = 78
LABEL: Final = 18
READY: Final = "READY: nothing stands against posting."
NOT_READY: Final = "NOT READY. DO NOT RUN THIS PROGRAM AS IT IS:"


def as_text(sheet: Sheet) -> str:
    """The sheet, lines ended by a line feed."""
    lines = ["SETUP SHEET", "=" * WIDTH, *_pairs(sheet.head), ""]
    if sheet.against:
        lines += [NOT_READY, *(line for text in sheet.against for line in _wrapped(f"!! {text}", "     "))]
    else:
        lines.append(READY)
    for section in (sheet.tools, *sheet.blocks):
        lines += ["", section.title, "-" * WIDTH, *_section(section)]
    return "\n".join(plain(line).rstrip() for line in lines) + "\n"


def plain(text: str) -> str:
    """Text on one line, every sign of it one that is seen."""
    return "".join(sign if sign.isprintable() else "?" for sign in text)


def _section(section: Section) -> Iterator[str]:
    yield from _pairs(section.pairs)
    if section.table:
        yield from ("",) if section.pairs else ()
        yield from _table(section.table)
    if section.findings:
        yield ""
        yield "FINDINGS"
        for text in section.findings:
            yield from _wrapped(text, "     ")


def _pairs(pairs: Sequence[tuple[str, str]]) -> Iterator[str]:
    for label, text in pairs:
        first, *rest = wrap(plain(text), WIDTH - LABEL - 1) or [""]
        yield f"{label:<{LABEL}} {first}"
        yield from (f"{'':<{LABEL}} {line}" for line in rest)


def _table(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Columns as wide as their longest text, numbers under their headings' right end."""
    widths = [max(len(plain(row[column])) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        yield "  ".join(f"{plain(text):>{width}}" for text, width in zip(row, widths, strict=True))


def _wrapped(text: str, indent: str) -> list[str]:
    return wrap(plain(text), WIDTH - 2, initial_indent="  ", subsequent_indent=indent)
