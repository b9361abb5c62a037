"""A RowTable is a table in which the cursor is on a whole row."""

from __future__ import annotations

from typing import TypeVar

from textual.widgets import DataTable

Cell = TypeVar("Cell")


class RowTable(DataTable[Cell]):
    """A table of rows; Home and End go to the first and the last row, where Textual's scrolls sideways."""

    def action_scroll_home(self) -> None:
        """Go to the first row."""
        self.action_scroll_top()

    def action_scroll_end(self) -> None:
        """Go to the last row."""
        self.action_scroll_bottom()
