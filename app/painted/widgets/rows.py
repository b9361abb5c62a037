"""Rows: lines of styled text.

A *span* is a text and its look, a *row* a tuple of spans.  What a screen shows is calculated as rows by pure
functions; `app.painted.widgets.painted` puts them on the terminal.
Every character of a row takes one cell: others are replaced before they get here.
"""

from __future__ import annotations

from enum import StrEnum
from functools import lru_cache
from re import compile
from typing import Final, NamedTuple

from rich.cells import cell_len


class Look(StrEnum):
    """The role of a piece of text; `app.painted.widgets.looks` gives each role its colors."""

    # an enumeration's own is written in Python, and a row is looked up by the looks of all its spans
    __hash__ = str.__hash__

    PLAIN = "plain"
    LABEL = "label"
    HEAD = "head"
    DIM = "dim"
    TYPED = "typed"
    CALCULATED = "calculated"
    READ_ONLY = "read-only"
    TAG = "tag"
    CURSOR = "cursor"
    CARET = "caret"
    ERROR = "error"
    WARNING = "warning"
    GOOD = "good"
    KEY = "key"
    SOFTKEY = "softkey"
    FRAME = "frame"
    AXIS = "axis"
    SURFACE = "surface"
    PATH = "path"
    LEAD = "lead"
    RAPID = "rapid"
    DELETED = "deleted"
    GOUGE = "gouge"
    UNCUT = "uncut"
    CUTTER = "cutter"
    START = "start"
    CURRENT = "current"
    SCALE = "scale"


class Span(NamedTuple):
    """A piece of text with one look."""

    text: str
    look: Look = Look.PLAIN


Row = tuple[Span, ...]
NARROW: Final = compile("[ -~⠀-⣿]*")
"""What takes one cell a character and needs no look at each: letters and braille."""


def plain(text: str, look: Look = Look.PLAIN) -> Row:
    """A row of one span."""
    return (Span(text, look),)


def text_of(row: Row) -> str:
    """A row's text without its looks."""
    return "".join(span.text for span in row)


@lru_cache(2048)
def padded(row: Row, width: int) -> Row:
    """The row cut or filled with blanks to exactly `width` cells; most rows of a picture were in the one before."""
    text = text_of(row)
    if len(text) == width and NARROW.fullmatch(text):
        return row
    spans: list[Span] = []
    left = width
    for span in row:
        if left <= 0:
            break
        text = single(span.text)[:left]
        spans.append(Span(text, span.look))
        left -= len(text)
    return (*spans, Span(" " * left)) if left > 0 else tuple(spans)


def shortened(text: str, room: int) -> str:
    """A name in so many cells: what is too long loses its middle, since names of one shop begin alike."""
    if len(text) <= room:
        return text
    head = max(room - 1, 0) // 2
    tail = max(room - 1 - head, 0)
    return f"{text[:head]}…{text[len(text) - tail :]}"


def single(text: str) -> str:
    """The text with a question mark for every character that does not take exactly one cell."""
    if NARROW.fullmatch(text):
        return text
    return "".join(one if one.isprintable() and cell_len(one) == 1 else "?" for one in text)


def changed(old: Row, new: Row) -> tuple[int, int] | None:
    """First changed column and how many, or None where the rows look the same."""
    if old == new:
        return None
    before, after = _cells(old), _cells(new)
    width = max(len(before), len(after))
    before += [(" ", Look.PLAIN)] * (width - len(before))
    after += [(" ", Look.PLAIN)] * (width - len(after))
    differing = [column for column in range(width) if before[column] != after[column]]
    return (differing[0], differing[-1] - differing[0] + 1) if differing else None


def _cells(row: Row) -> list[tuple[str, Look]]:
    return [(character, span.look) for span in row for character in span.text]


class Area(NamedTuple):
    """Cells of the terminal: left, top, width, height; nothing is shown where one of the latter is 0."""

    x: int
    y: int
    width: int
    height: int


NOWHERE: Final = Area(0, 0, 0, 0)
"""The area of a part that is not shown."""


class Part(NamedTuple):
    """Rows in an area; where there is less height than rows, the row `focus` stays in sight."""

    area: Area
    rows: tuple[Row, ...]
    focus: int = 0


def composed(parts: list[Part], width: int, height: int) -> tuple[Row, ...]:
    """The whole terminal: every part in its area, blanks elsewhere.  Areas do not overlap."""
    lines: list[list[tuple[int, int, Row]]] = [[] for _ in range(height)]
    for (x, y, across, down), rows, focus in sorted(parts, key=lambda part: part.area.x):
        if across <= 0:
            continue
        top = max(0, min(focus, len(rows) - 1) - down + 1)
        shown = (*rows[top : top + down], *[()] * down)
        for line, row in zip(lines[y : y + down], shown, strict=False):
            line.append((x, across, row))
    return tuple(_side_by_side(tuple(line), width) for line in lines)


@lru_cache(128)
def _side_by_side(rows: tuple[tuple[int, int, Row], ...], width: int) -> Row:
    """Rows from a column on, so many cells wide; most lines of a picture were in the one before."""
    spans, column = list[Span](), 0
    for x, across, row in rows:
        if x > column:
            spans.append(Span(" " * (x - column)))
        spans += padded(row, across)
        column = x + across
    return (*spans, Span(" " * (width - column))) if width > column else tuple(spans)
