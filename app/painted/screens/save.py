"""SAVE AS: the name of the program's file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

from app.documents.folders import folder_in_words
from app.documents.naming import typed
from app.painted.messages import Close, Message, Save, Say
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Softkey, Softkeys, Surface, View
from app.painted.screens.text import paragraph
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, plain

HOW: Final = "The folder must exist. A name that does not end in .toml gets it."


@dataclass(frozen=True, eq=False, slots=True)
class SaveAsPage(EntryPage):
    """Asks for a name; `leave` leaves the program after saving, `leads` is the folder of a name without one."""

    leave: bool = False
    leads: str = ""

    @classmethod
    def of(cls, session: Session, *, leave: bool = False) -> Self:
        """The page with the name the program has."""
        name = Path("part.toml") if session.file is None else session.file
        return cls(Editing.of(str(name)), leave=leave, leads=folder_in_words(session.file))

    def softkeys(self, session: Session) -> Softkeys:
        """Save, or not."""
        return {1: Softkey("SAVE", self._saved()), 8: Softkey("CANCEL", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter saves."""
        return self.accepted(self._saved()) if key == "enter" else self.typed(key, character)

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """SAVE is Enter."""
        return self.accepted(messages) if number == 1 else Answer(self, messages)

    def _saved(self) -> tuple[Message, ...]:
        text = self.entry.text.strip()
        if not text:
            return (Say("Type a name for the file.", Tone.ERROR),)
        return (Save(typed(text), leave=self.leave),)

    def view(self, session: Session, surface: Surface) -> View:
        """The name."""
        lines = (HOW, f"A name without a folder goes into {self.leads}")
        return View(
            header("SAVE AS", plain(""), session, surface.width),
            (
                (),
                entry_row("FILE", self.entry, surface.width, fresh=self.replaced),
                (),
                *(row for line in lines for row in paragraph(line, surface.width, Look.LABEL, "  ")),
            ),
            Said("Type the name of the file, Enter saves. Left arrow changes the name that stands there."),
            1,
        )
