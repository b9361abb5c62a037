"""The one widget: paints rows, and of new rows only the cells that differ from those on the terminal."""

from __future__ import annotations

from rich.segment import Segment
from textual.geometry import Region
from textual.strip import Strip
from textual.widget import Widget

from app.widgets.looks import style_of
from app.widgets.rows import Row, changed


class Rows(Widget, inherit_css=False):
    """Shows rows from its top on."""

    def __init__(self, rows: tuple[Row, ...] = ()) -> None:
        super().__init__()
        self.rows = rows

    def show(self, rows: tuple[Row, ...]) -> None:
        """Put these rows on the screen; cells that stay the same are not painted again."""
        old, self.rows = self.rows, rows
        if len(old) != len(rows):
            self.refresh()
            return
        regions = [
            Region(difference[0], number, difference[1], 1)
            for number, (before, after) in enumerate(zip(old, rows, strict=True))
            if (difference := changed(before, after)) is not None
        ]
        if regions:
            self.refresh(*regions)

    def render_line(self, y: int) -> Strip:
        """One line of the terminal, as Textual asks for it."""
        row, width = self.rows[y] if y < len(self.rows) else (), self.size.width
        few = self.app.native_ansi_color
        segments = [Segment(span.text, style_of(span.look, few_colours=few)) for span in row]
        return Strip(segments).adjust_cell_length(width, self.rich_style).crop(0, width)
