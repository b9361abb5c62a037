"""A RowTable is a table in which the cursor is on a whole row."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from textual.widgets import DataTable

Cell = TypeVar("Cell")


class RowTable(DataTable[Cell]):
    """A table with columns of these headings and widths; the heading is the column's key.

    Home and End go to the first and the last row, where Textual's scrolls sideways.
    """

    def __init__(
        self,
        columns: Sequence[tuple[str, int]] = (),
        *,
        id: str | None = None,
        classes: str | None = None,
        cell_padding: int = 1,
    ) -> None:
        super().__init__(id=id, classes=classes, cursor_type="row", cell_padding=cell_padding)
        for heading, width in columns:
            self.add_column(heading, width=width, key=heading)

    def action_scroll_home(self) -> None:
        """Go to the first row."""
        self.action_scroll_top()

    def action_scroll_end(self) -> None:
        """Go to the last row."""
        self.action_scroll_bottom()
