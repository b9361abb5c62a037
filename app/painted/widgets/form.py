"""The two columns of fields as rows: labels, tags, values, and the cursor on one of them."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from functools import lru_cache
from typing import Final, NamedTuple

from app.painted.widgets.field import Editing, window
from app.painted.widgets.rows import Look, Row, Span, padded

WIDTH: Final = 59
"""Cells from the left edge to the softkeys' frame."""
LINES: Final = 7
"""Lines of fields a form has."""


class State(StrEnum):
    """What a value is; the tag and the look say it, each alone is enough."""

    TYPED = "typed"
    CALCULATED = "calculated"
    UNREAD = "unread"
    NEEDED = "needed"
    READ_ONLY = "read-only"


class Cell(NamedTuple):
    """One field of a form: where it stands (column 0 left, 1 right, 2 across; line from 0) and what it shows.

    `text` is the value as shown; `tag` stands to the left of it.  A choice takes no text.
    """

    name: str
    label: str
    text: str
    column: int
    line: int
    state: State = State.TYPED
    tag: str = ""
    choice: bool = False


class Place(NamedTuple):
    """A column of the form: first cell, width, and the narrowest room its values get."""

    first: int
    width: int
    value: int


PLACES: Final = (Place(1, 26, 10), Place(29, 28, 10), Place(1, 56, 40))
"""The left and the right column at 80 cells, and a line across both."""
TAG: Final = 3
"""Letters of every tag: CAL, USR, DEF, ERR."""
NUMBER: Final = 10
"""The longest number a form shows; it is never cut, a longer text is."""

_LOOKS: Final = {
    State.TYPED: Look.TYPED,
    State.CALCULATED: Look.CALCULATED,
    State.UNREAD: Look.ERROR,
    State.NEEDED: Look.WARNING,
    State.READ_ONLY: Look.READ_ONLY,
}


def form_rows(cells: Sequence[Cell], cursor: str, editing: Editing | None, width: int) -> tuple[Row, ...]:
    """The form's lines, in two columns, or in one where the terminal is too narrow for two."""
    if width < WIDTH:
        narrow = Place(0, width, min(10, max(width - 6, 1)))
        ordered = sorted(cells, key=lambda cell: (cell.column, cell.line))
        return tuple(_on_form(cell, narrow, cursor, editing) for cell in ordered)
    by_place = {(cell.column, cell.line): cell for cell in cells}
    lines = range(max([LINES, *(cell.line + 1 for cell in cells)]))
    places = tuple(_aligned(place, cells, column) for column, place in enumerate(PLACES))
    rows = []
    for line in lines:
        across = by_place.get((0, line)), by_place.get((1, line)), by_place.get((2, line))
        on_it = any(cell is not None and cell.name == cursor for cell in across)
        rows.append(_line(across, places, cursor if on_it else "", editing if on_it else None))
    return tuple(rows)


def cursor_line(cells: Sequence[Cell], cursor: str, width: int) -> int:
    """The row of `form_rows` in which the cursor stands; 0 when it is on none."""
    if width < WIDTH:
        cells = sorted(cells, key=lambda cell: (cell.column, cell.line))
        return next((row for row, cell in enumerate(cells) if cell.name == cursor), 0)
    return next((cell.line for cell in cells if cell.name == cursor), 0)


def _aligned(place: Place, cells: Sequence[Cell], column: int) -> Place:
    """The column with values as narrow as its longest label asks for, so that its tags stand in one line.

    Whatever can bear a tag counts, with or without one: else the others would move when a number is typed into it.
    """
    taggable = [cell for cell in cells if cell.column == column and not cell.choice]
    beside = [place.width - len(cell.label) - TAG - 2 for cell in taggable if cell.state is not State.READ_ONLY]
    return Place(place.first, place.width, min([place.value, *beside]))


@lru_cache(64)
def _line(
    cells: tuple[Cell | None, Cell | None, Cell | None],
    places: tuple[Place, ...],
    cursor: str,
    editing: Editing | None,
) -> Row:
    """The fields side by side, or one across; a key leaves most lines as they were."""
    left, right, across = cells
    first, second, whole = places
    if across is not None:
        return (Span(" " * whole.first), *_on_form(across, whole, cursor, editing))
    row = (Span(" " * first.width),) if left is None else _on_form(left, first, cursor, editing)
    # the bracket that closes a read-only value stands one cell behind the column
    tight = left is not None and left.state is State.READ_ONLY
    gap = Span(" " * (second.first - first.first - first.width - tight))
    behind = () if right is None else (gap, *_on_form(right, second, cursor, editing))
    return (Span(" " * first.first), *row, *behind)


def _on_form(cell: Cell, place: Place, cursor: str, editing: Editing | None) -> Row:
    on_it = cell.name == cursor
    return _cell(cell, place, editing if on_it else None, on_it=on_it)


@lru_cache(256)
def _cell(cell: Cell, place: Place, editing: Editing | None, *, on_it: bool) -> Row:
    """A field as a key leaves most of them: as they were."""
    if cell.state is State.READ_ONLY:
        return _read_only(cell, place)
    tag = Span(f"{cell.tag} " if cell.tag else "", Look.ERROR if cell.state is State.UNREAD else Look.TAG)
    room = _room(cell, place, len(tag.text), editing)
    value = _value(cell, room, editing, on_it=on_it)
    label = padded((Span(cell.label, Look.HEAD if on_it else Look.LABEL),), place.width - room - len(tag.text))
    return (*label, tag, *value)


def _room(cell: Cell, place: Place, tag: int, editing: Editing | None) -> int:
    """Cells for the value: the label gives way to a number and to a text being typed, never the other way round."""
    beside = place.width - len(cell.label) - 1 - tag
    wanted = place.value if editing is None else max(place.value, len(editing.text) + 1)
    least = min(max(len(cell.text), 1), NUMBER, place.width - tag)
    if editing is not None:
        beside = max(beside, min(wanted, place.width - tag - 6))
    # on a terminal of a few cells there may be no room at all
    return max(least, min(max(wanted, len(cell.text)), beside), 1)


def _value(cell: Cell, room: int, editing: Editing | None, *, on_it: bool) -> Row:
    if editing is not None:
        return typed_spans(editing, room, right=True)
    text = f"{cell.text:>{room}}" if len(cell.text) <= room else f"{cell.text[: room - 1]}…"
    if on_it:
        return (Span(text, Look.CURSOR),)
    bare = text.lstrip()
    return (Span(" " * (room - len(bare))), Span(bare, _LOOKS[cell.state]))


def typed_spans(editing: Editing, room: int, *, right: bool) -> Row:
    """A half-typed text with its caret, at the right of its room as a number or at the left as a word."""
    text, caret = window(editing, room)
    blank = max(room - len(text) - 1, 0) if right else 0
    text = f"{' ' * blank}{text:<{room - blank}}"[:room]
    caret += blank
    return (
        Span(text[:caret], Look.CURSOR),
        Span(text[caret : caret + 1], Look.CARET),
        Span(text[caret + 1 :], Look.CURSOR),
    )


def _read_only(cell: Cell, place: Place) -> Row:
    room = max(place.width - len(cell.label) - 1, 0)
    return (Span(f"({cell.label}{cell.text[:room]:>{room}})", Look.READ_ONLY),)
