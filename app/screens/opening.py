"""OpeningScreen stands in front while the screen of an NC text or a drawing is being loaded."""

from __future__ import annotations

from typing import ClassVar

from textual.app import ComposeResult
from textual.containers import Horizontal

from app.screens.base import BaseScreen
from app.session.messages import Sentence
from app.widgets.plain import PlainLabel
from app.widgets.status import Status


class OpeningScreen(BaseScreen):
    """The file's name, and no field: nobody can type into a form that is not meant."""

    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = ()

    def __init__(self, name: str) -> None:
        super().__init__()
        self._name_of_file = name

    def compose_body(self) -> ComposeResult:
        """Lay out the title."""
        with Horizontal(classes="head"):
            yield PlainLabel(self._name_of_file, classes="head-title")

    def show_state_on(self, status: Status) -> None:
        """Show no unit: the file's is not known yet."""

    def prompt_text(self) -> Sentence:
        """Return what is going on."""
        return Sentence("The file is being opened.")
