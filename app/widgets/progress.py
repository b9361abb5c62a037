"""Progress shows long work as a bar in the place of the prompt."""

from __future__ import annotations

from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.widgets import ProgressBar

from app.session.work import Work
from app.widgets.plain import PlainLabel


class Progress(Horizontal):
    """The bar of the fraction done, and the key that stops the work; in view only while there is work."""

    def compose(self) -> ComposeResult:
        """Yield the bar and the key."""
        yield ProgressBar(total=1.0, show_eta=False)
        yield PlainLabel("Esc stops")

    def show(self, work: Work) -> None:
        """Show how much of the work is done, and the key as soon as it acts."""
        if not self.children:
            # not composed yet
            return
        self.query_one(ProgressBar).progress = min(work.done, 1.0)
        self.query_one(PlainLabel).visible = work.stoppable
