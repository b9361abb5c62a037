"""ContourTable lists the contours of a drawing, one per row; circles of one size fold into one row."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import ClassVar, Final

from textual.binding import Binding, BindingType
from textual.content import Content
from textual.coordinate import Coordinate

from app.session.formats import length
from app.widgets.rows import RowTable
from core.importing.contour import Contour, ContourKind
from core.importing.listing import Row, cells_of
from core.units import Unit

COLUMNS: Final = (("chain", 6), ("kind", 10), ("layer", 8), ("pieces", 6), ("length", 9), ("size", 20))
"""Headings and widths; they add up to 59, the room for the table in 80 columns."""

MAX_INDENT: Final = 2
"""The most columns by which a contour inside others is indented."""

TAKEN_MARK: Final = "*"


class ContourTable(RowTable[Content]):
    """The rows given to `fill`, with a row cursor."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("space", "screen.mark", "Mark", show=False),
        Binding("right", "screen.unfold(True)", "Open row", show=False),
        Binding("left", "screen.unfold(False)", "Close row", show=False),
    ]

    def __init__(self, *, id: str) -> None:
        super().__init__([(_heading(label, width), width) for label, width in COLUMNS], id=id, cell_padding=0)
        self.rows_shown: tuple[Row, ...] = ()

    def fill(self, rows: Sequence[Row], unit: Unit, marked: Collection[int], at: int = 0) -> None:
        """Replace the rows; put the cursor on the row with contour number `at`, else on the first."""
        self.rows_shown = tuple(rows)
        self.clear()
        self.add_rows(_cells(row, unit, marked) for row in rows)
        here = (number for number, row in enumerate(rows) if any(contour.number == at for contour in row))
        self.move_cursor(row=next(here, 0))

    def show_marks(self, marked: Collection[int]) -> None:
        """Update the marks."""
        for number, row in enumerate(self.rows_shown):
            cell = _first_cell(row, marked)
            if self.get_cell_at(Coordinate(number, 0)).plain != cell.plain:
                self.update_cell_at(Coordinate(number, 0), cell)

    @property
    def current(self) -> Row | None:
        """The row with the cursor; None if there are no rows."""
        return self.rows_shown[self.cursor_row] if 0 <= self.cursor_row < len(self.rows_shown) else None


def _heading(label: str, width: int) -> str:
    return f" {label}" if label in ("kind", "layer", "size") else label.rjust(width)


def _first_cell(row: Row, marked: Collection[int]) -> Content:
    count = sum(contour.number in marked for contour in row)
    sign = TAKEN_MARK if count == len(row) else "-" if count else " "
    return Content(f"{sign}{row[0].number:>5}")


def _cells(row: Row, unit: Unit, marked: Collection[int]) -> tuple[Content, ...]:
    contour = row[0]
    _, _, layer, pieces, length, size, more = cells_of(row, unit)
    kind = f" {' ' * min(contour.depth, MAX_INDENT)}{contour.kind}"
    texts = (kind, f" {layer}"[: COLUMNS[2][1]], pieces.rjust(COLUMNS[3][1]), length.rjust(COLUMNS[4][1]))
    return (_first_cell(row, marked), *(Content(text) for text in texts), Content(_size(contour, size, more, unit)))


def _size(contour: Contour, size: str, more: str, unit: Unit) -> str:
    """Return the width and height, the diameter and number of circles, or an open contour's gap and to which."""
    if contour.kind is ContourKind.OPEN and contour.open_gap is not None:
        return f" gap {length(contour.open_gap, unit)} to {contour.open_gap_to or '-'}"
    if contour.circle is not None:
        size = size.replace("diameter", "dia.")
    return f" {size} {more}".rstrip()
