"""The one widget: paints rows, and of new rows only the cells that differ from those on the terminal."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rich.segment import Segment
from textual.geometry import Region
from textual.strip import Strip
from textual.widget import Widget

from app.painted.widgets.looks import style_of
from app.painted.widgets.rows import Look, Row, changed


class Written(dict[Look, str]):
    """The parameters of the control sequence for each look, asked for once."""

    def __init__(self, codes: Callable[[Look], str]) -> None:
        self.codes = codes

    def __missing__(self, look: Look) -> str:
        self[look] = self.codes(look)
        return self[look]


class Rows(Widget, inherit_css=False):
    """Shows rows from its top on.

    A driver that knows what stands on the terminal is given the rows that have changed; the way through Textual's
    compositor, which takes longer than everything else between a key and its picture, is for the first picture, for
    another size, and for terminals of which nothing is known.
    """

    def __init__(self, rows: tuple[Row, ...] = ()) -> None:
        super().__init__()
        self.rows = rows
        self.written = Written(self._codes)

    def show(self, rows: tuple[Row, ...]) -> None:
        """Put these rows on the screen; cells that stay the same are not painted again."""
        old, self.rows = self.rows, rows
        if len(old) != len(rows):
            self.refresh()
            return
        both = enumerate(zip(old, rows, strict=True))
        differing = [(number, before, after) for number, (before, after) in both if before != after]
        if not differing or self._straight([(number, after) for number, _, after in differing]):
            return
        spans = ((number, changed(before, after)) for number, before, after in differing)
        regions = [Region(span[0], number, span[1], 1) for number, span in spans if span is not None]
        if regions:
            self.refresh(*regions)

    def _straight(self, rows: list[tuple[int, Row]]) -> bool:
        """Give these lines to the driver; False where it cannot paint them by themselves."""
        # not the driver's class: a terminal's is not known in a browser, nor in tests without a terminal
        paint: Any = getattr(self.app._driver, "paint", None)
        if paint is None or self.size != self.app.size:
            return False
        codes = self.written
        lines = [(number, [(text, codes[look]) for text, look in row]) for number, row in rows]
        return bool(paint(lines))

    def _codes(self, look: Look) -> str:
        """The parameters of the control sequence for a look, as Textual writes it to this terminal."""
        text = self._filtered(Strip([self._segment("x", look)])).render(self.app.console)
        return text.partition("x")[0].removeprefix("\x1b[").removesuffix("m")

    def render_lines(self, crop: Region) -> list[Strip]:
        """Lines of the terminal, as Textual asks for them; none is kept, since rows change without its being told."""
        return [self._filtered(self.render_line(y)).crop(*crop.column_span) for y in crop.line_range]

    def render_line(self, y: int) -> Strip:
        """One line, in all colors."""
        row, width = self.rows[y] if y < len(self.rows) else (), self.size.width
        segments = [self._segment(span.text, span.look) for span in row]
        return Strip(segments).adjust_cell_length(width, self.rich_style).crop(0, width)

    def _segment(self, text: str, look: Look) -> Segment:
        return Segment(text, style_of(look, few_colors=self.app.native_ansi_color))

    def _filtered(self, strip: Strip) -> Strip:
        """As this terminal has it: without colors where it has none."""
        for one in self.get_line_filters():
            strip = strip.apply_filter(one, self.background_colors[1])
        return strip
