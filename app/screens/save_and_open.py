"""SAVE AS and OPEN A PATH ask for the name of a file."""

from __future__ import annotations

from typing import ClassVar

from app.documents.paths import typed
from app.screens.entry_screen import EntryScreen
from app.session.guide import SAVE_NAME
from app.session.messages import Sentence
from app.widgets.softkeys import Softkey
from app.widgets.status import Status


class SaveAsScreen(EntryScreen):
    """SAVE AS asks for the file name of the program or NC text."""

    TITLE: ClassVar[str] = "SAVE AS"
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("SAVE", "enter", "SAVE"),
        *(None,) * 6,
        Softkey("BACK", "app.back", "BACK"),
    )

    def entered(self, text: str) -> None:
        """Save under this name."""
        self.host.save_as(text)

    def show_state_on(self, status: Status) -> None:
        """Show the state of the screen below."""
        self.show_state_of_below_on(status)

    def guide_text(self) -> str:
        """Return the guide's step for naming the plate."""
        return SAVE_NAME

    def prompt_text(self) -> Sentence:
        """Return what to type."""
        return Sentence("Name of the program file, Enter saves. Without a folder it goes beside the open program.")


class OpenPathScreen(EntryScreen):
    """OPEN A PATH asks for a program, an NC file, a drawing, or a folder."""

    TITLE: ClassVar[str] = "OPEN A PATH"
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("OPEN", "enter", "OPEN"),
        *(None,) * 6,
        Softkey("BACK", "app.back", "BACK"),
    )

    def entered(self, text: str) -> None:
        """Open the file, or show the folder."""
        self.host.open_file(typed(text))

    def prompt_text(self) -> Sentence:
        """Return what to type."""
        return Sentence("Path of a program (.toml), an NC file, a drawing (.dxf), or a folder. Enter opens it.")
