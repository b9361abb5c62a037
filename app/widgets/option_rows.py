"""OptionRows: Textual's option list for terminals of every size and with any colors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.segment import Segment
from rich.style import Style
from textual.content import Content
from textual.strip import Strip
from textual.widgets import OptionList
from textual.widgets.option_list import Option

if TYPE_CHECKING:
    from core.controls.control_names import ControlChoice

REVERSED = Style(reverse=True, underline=False)


class OptionRows(OptionList):
    """The list; its line with the cursor has the cursor's ink alone, or is reversed where there are no colors.

    Textual gives options no reverse: where the style sheet means it, it says underline.  While the list has no room, a
    page up or down is no step: Textual's own fails then.  Brackets in an option are no markup: a file may have them.
    """

    def __init__(self, *options: Option | None, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(*options, id=id, classes=classes, compact=True, markup=False)

    def render_line(self, y: int) -> Strip:
        """A line, that of the cursor in the cursor's looks."""
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

    def action_page_up(self) -> None:
        """A page up, where there is one."""
        if self.scrollable_content_region:
            super().action_page_up()  # type: ignore[no-untyped-call]  # Textual gives it no types

    def action_page_down(self) -> None:
        """A page down, where there is one."""
        if self.scrollable_content_region:
            super().action_page_down()  # type: ignore[no-untyped-call]  # as above


def control_rows(choices: Sequence[ControlChoice]) -> list[Option]:
    """A row for each control: its name, then what it is in a column of its own."""
    width = max(len(choice.name) for choice in choices) + 2
    return [
        Option(Content.assemble(f"{choice.name:<{width}}", (choice.about, "$c-label")), id=choice.control)
        for choice in choices
    ]
