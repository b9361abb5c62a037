"""Listing shows the lines of an NC text, read-only until edited, each colored by its most severe finding."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from rich.text import Text
from textual.binding import Binding, BindingType
from textual.reactive import reactive
from textual.widgets import TextArea

from core.finding import Severity

ROLES = {Severity.ERROR: "c-err", Severity.WARNING: "c-warn", Severity.INFO: "c-label"}
"""The color role of each severity."""


class Listing(TextArea, inherit_bindings=False):
    """The text; while it is read-only, letters are commands of the screen."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("up", "cursor_up", "Up", show=False),
        Binding("down", "cursor_down", "Down", show=False),
        Binding("left", "cursor_left", "Left", show=False),
        Binding("right", "cursor_right", "Right", show=False),
        Binding("ctrl+left", "cursor_word_left", "Word left", show=False),
        Binding("ctrl+right", "cursor_word_right", "Word right", show=False),
        Binding("home", "cursor_line_start", "Begin of line", show=False),
        Binding("end", "cursor_line_end", "End of line", show=False),
        Binding("pageup", "cursor_page_up", "Page up", show=False),
        Binding("pagedown", "cursor_page_down", "Page down", show=False),
        Binding("backspace", "delete_left", "Delete left", show=False),
        Binding("delete", "delete_right", "Delete right", show=False),
    ]

    marks: reactive[Mapping[int, Severity]] = reactive({}, repaint=True)
    """The most severe finding of each line, counted from 1."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(
            id=id, read_only=True, show_line_numbers=True, soft_wrap=False, compact=True, max_checkpoints=0
        )
        self.cursor_blink = False

    def on_resize(self) -> None:
        """Keep the line with the cursor in view."""
        self.call_after_refresh(self.scroll_cursor_visible)

    def watch_marks(self) -> None:
        """Repaint the lines that Textual has cached."""
        self.notify_style_update()

    def get_line(self, line_index: int) -> Text:
        """Return a line in the color of its most severe finding."""
        line = super().get_line(line_index)
        severity = self.marks.get(line_index + 1)
        if severity is not None:
            color = self.app.theme_variables.get(ROLES[severity], "").removeprefix("ansi_")
            line.stylize(f"bold {color}".strip() if color != "default" else "bold")
        return line

    @property
    def row(self) -> int:
        """The index of the line with the cursor, from 0."""
        return int(self.cursor_location[0])

    def go_to_row(self, row: int) -> None:
        """Move the cursor to the beginning of a line."""
        self.move_cursor((min(max(row, 0), self.document.line_count - 1), 0), center=True)
