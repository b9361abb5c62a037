"""Form lays out fields in two columns."""

from __future__ import annotations

from collections.abc import Sequence

from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from app.widgets.field import Cell, ChoiceField, FieldRow, NumberField


class Form(Horizontal):
    """Fields in two columns, in the order of their cells; the set of names never changes."""

    def __init__(self, cells: Sequence[Cell], *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(id=id, classes=classes)
        self.rows = {cell.name: FieldRow(cell) for cell in cells}

    def compose(self) -> ComposeResult:
        """Yield the columns."""
        last = max(row.cell.column for row in self.rows.values())
        for column in range(1 + last):
            with Vertical(classes=f"column {'-first' if not column else ''} {'-last' if column == last else ''}"):
                yield from (row for row in self.rows.values() if row.cell.column == column)

    def show(self, cells: Sequence[Cell]) -> None:
        """Show these cells; only rows that differ are updated."""
        for cell in cells:
            row = self.rows[cell.name]
            if row.cell != cell:
                row.show(cell)

    def field(self, name: str) -> NumberField | ChoiceField | None:
        """Return the field of this name; None if it is hidden or read-only, or if there is none."""
        row = self.rows.get(name)
        return row.input if row is not None and row.cell.visible else None
