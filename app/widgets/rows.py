"""Rows: lines of styled text, and the one widget that paints them.

A *span* is a text and its look, a *row* a tuple of spans.  What a screen shows is calculated as rows by pure
functions; the widget compares them with what stands on the terminal and repaints only the cells that differ.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar

from rich.cells import cell_len
from rich.segment import Segment
from textual.geometry import Region
from textual.strip import Strip
from textual.widget import Widget


class Look(StrEnum):
    """The role of a piece of text; `app.tcss` gives each role its colours and its style."""

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


@dataclass(frozen=True, slots=True)
class Span:
    """A piece of text with one look."""

    text: str
    look: Look = Look.PLAIN


Row = tuple[Span, ...]


def plain(text: str, look: Look = Look.PLAIN) -> Row:
    """A row of one span."""
    return (Span(text, look),)


def text_of(row: Row) -> str:
    """A row's text without its looks."""
    return "".join(span.text for span in row)


def padded(row: Row, width: int) -> Row:
    """The row cut or filled with blanks to exactly `width` cells; every character of it is one cell wide."""
    spans: list[Span] = []
    left = width
    for span in row:
        if left <= 0:
            break
        spans.append(span if len(span.text) <= left else Span(span.text[:left], span.look))
        left -= len(span.text)
    return (*spans, Span(" " * left)) if left > 0 else tuple(spans)


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
    return [
        (character, span.look) for span in row for character in span.text for _ in range(max(cell_len(character), 1))
    ]


class Rows(Widget):
    """Shows rows.  Where there is less height than rows, it keeps the row `focus` in sight."""

    COMPONENT_CLASSES: ClassVar[set[str]] = {f"rows--{look}" for look in Look}

    def __init__(self, id: str) -> None:
        super().__init__(id=id)
        self.rows: tuple[Row, ...] = ()
        self.focus_row = 0
        self.area: object = None

    def show(self, rows: tuple[Row, ...], focus: int = 0) -> None:
        """Put these rows on the screen; cells that stay the same are not painted again."""
        old, top = self.rows, self._top
        self.rows, self.focus_row = rows, focus
        if top != self._top:
            self.refresh()
            return
        regions = self._differences(old, top)
        if regions:
            self.refresh(*regions)

    @property
    def _top(self) -> int:
        """The first row shown."""
        return max(0, min(self.focus_row, len(self.rows) - 1) - self.size.height + 1)

    def _differences(self, old: tuple[Row, ...], top: int) -> list[Region]:
        regions = []
        for number in range(top, min(max(len(old), len(self.rows)), top + self.size.height)):
            before = old[number] if number < len(old) else ()
            after = self.rows[number] if number < len(self.rows) else ()
            if (difference := changed(before, after)) is not None:
                regions.append(Region(difference[0], number - top, difference[1], 1))
        return regions

    def render_line(self, y: int) -> Strip:
        """One line of the terminal, as Textual asks for it."""
        number, width = self._top + y, self.size.width
        row = self.rows[number] if number < len(self.rows) else ()
        segments = [Segment(span.text, self.get_component_rich_style(f"rows--{span.look}")) for span in row]
        return Strip(segments).adjust_cell_length(width, self.rich_style).crop(0, width)
