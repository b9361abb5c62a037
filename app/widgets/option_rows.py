"""OptionRows: Textual's option list for terminals of every size."""

from __future__ import annotations

from textual.widgets import OptionList


class OptionRows(OptionList):
    """The list; while it has no room, a page up or down is no step: Textual's own fails then."""

    def action_page_up(self) -> None:
        """A page up, where there is one."""
        if self.scrollable_content_region:
            super().action_page_up()  # type: ignore[no-untyped-call]  # Textual gives it no types

    def action_page_down(self) -> None:
        """A page down, where there is one."""
        if self.scrollable_content_region:
            super().action_page_down()  # type: ignore[no-untyped-call]
