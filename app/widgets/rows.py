"""OptionRows and RowTable are Textual's list and table, adapted to terminals of every size and with any colors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeVar

from rich.segment import Segment
from rich.style import Style
from textual import events
from textual.content import Content
from textual.message import Message
from textual.strip import Strip
from textual.widgets import DataTable, OptionList
from textual.widgets.option_list import Option

if TYPE_CHECKING:
    from core.controls.control_names import ControlChoice

Cell = TypeVar("Cell")
REVERSED = Style(reverse=True, underline=False)
LETTERS_TOGETHER: Final = 1.0
"""Longest pause in seconds between two letters of one name."""


@dataclass(slots=True)
class TypedLetters:
    """The letters typed one soon after the other; they name the next row with that name, or that begins with them."""

    letters: str = ""
    last: float = 0.0
    unknown: str = ""
    """The letters, if no name begins with them."""

    def row(self, event: events.Key, names: Sequence[tuple[str, ...]], here: int) -> int | None:
        """Return that row, `here` if there is none; None for a key that is not part of a name.

        Letters that no name begins with start over with the last one.
        """
        letter = (event.character or "").lower()
        together = self.letters if event.time - self.last < LETTERS_TOGETHER else ""
        if not (letter.isalnum() or (together and letter and letter in "-_.: ")):
            return None
        self.last, self.unknown = event.time, ""
        for letters, step in ((together + letter, 0 if together else 1), (letter, 1)):
            rows = [(here + step + more) % len(names) for more in range(len(names))]
            begun = (row for row in rows if any(name.startswith(letters) for name in names[row]))
            row = next((row for row in rows if letters in names[row]), next(begun, None))
            if row is not None:
                self.letters = letters
                return row
        self.unknown = together + letter
        return here


class OptionRows(OptionList):
    """The list; its cursor line has one text color, or is reversed if the terminal has few colors or none.

    Textual gives options no reverse, so the style sheet says underline instead.  While the list has no room, page up
    and down do nothing: Textual's own fail then.  Brackets in an option are not markup, since a file may have them.
    """

    def __init__(self, *options: Option | None, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(*options, id=id, classes=classes, compact=True, markup=False)

    def render_line(self, y: int) -> Strip:
        """Return a line; while the list has the focus, the cursor line has the cursor's look."""
        strip = super().render_line(y)
        cursor = self.get_component_rich_style("option-list--option-highlighted")
        if not self.has_focus:
            return strip
        if cursor.underline:
            return Strip(
                Segment(text, style + REVERSED if style and style.underline else style, control)
                for text, style, control in strip
            )
        ink = Style(color=cursor.color)
        return Strip(
            Segment(text, style + ink if style and style.bgcolor == cursor.bgcolor else style, control)
            for text, style, control in strip
        )

    def action_cursor_up(self) -> None:
        """Go up a line, but not from the first one to the last."""
        if self.highlighted != 0:
            super().action_cursor_up()

    def action_cursor_down(self) -> None:
        """Go down a line, but not from the last one to the first."""
        if self.highlighted != self.option_count - 1:
            super().action_cursor_down()

    def action_page_up(self) -> None:
        """Go up a page, if the list has room."""
        if self.scrollable_content_region:
            super().action_page_up()  # type: ignore[no-untyped-call]  # Textual gives it no types

    def action_page_down(self) -> None:
        """Go down a page, if the list has room."""
        if self.scrollable_content_region:
            super().action_page_down()  # type: ignore[no-untyped-call]  # as above


class NamedRows(OptionRows):
    """A list in which letters and digits move the cursor to the next option whose text or id begins with them."""

    @dataclass
    class Unknown(Message):
        """Letters were typed with which no option begins."""

        letters: str

    def __init__(self, *options: Option, id: str) -> None:
        super().__init__(*options, id=id)
        self._typed = TypedLetters()

    def on_key(self, event: events.Key) -> None:
        """Go to the next option that begins with the letters typed."""
        names = [(str(option.prompt).strip().lower(), option.id or "") for option in self.options]
        row = self._typed.row(event, names, self.highlighted or 0)
        if row is not None and names:
            event.stop()
            self.highlighted = row
            if self._typed.unknown:
                self.post_message(self.Unknown(self._typed.unknown.upper()))


def control_rows(choices: Sequence[ControlChoice]) -> list[Option]:
    """Return a row for each control: its name, then what it is, in a second column."""
    width = max(len(choice.name) for choice in choices) + 2
    return [
        Option(Content.assemble(f"{choice.name:<{width}}", (choice.about, "$c-label")), id=choice.control)
        for choice in choices
    ]


class RowTable(DataTable[Cell]):
    """A table with the cursor on a whole row and columns of these headings and widths; the heading is the column's key.

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
        self.program_row = 0
        """The row of the program's place, as it was last shown or chosen here."""

    def follow(self, program_row: int, cursor_row: int) -> None:
        """Put the cursor on the row of the program's place, if the program did not get there by this table.

        Otherwise keep it on `cursor_row`: another key may have moved it there before the program has followed.
        """
        row = cursor_row if program_row == self.program_row else program_row
        self.program_row = program_row
        if self.cursor_row != row:
            self.move_cursor(row=row)

    def action_scroll_home(self) -> None:
        """Go to the first row."""
        self.action_scroll_top()

    def action_scroll_end(self) -> None:
        """Go to the last row."""
        self.action_scroll_bottom()
