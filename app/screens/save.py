"""SAVE AS: the name of the program's file."""

from __future__ import annotations

from pathlib import Path
from typing import Self

from app.messages import Close, Message, Save, Say
from app.naming import typed, with_suffix
from app.screens.entry import EntryPage, entry_row
from app.screens.page import Answer, Softkey, Softkeys, Surface, View
from app.session import Said, Session, Tone
from app.widgets.field import Editing
from app.widgets.header import header
from app.widgets.rows import Look, plain
from core.records import dataclass


@dataclass(frozen=True, eq=False, slots=True)
class SaveAsPage(EntryPage):
    """Asks for a name; `leave` leaves the program after saving."""

    leave: bool = False

    @classmethod
    def of(cls, session: Session, *, leave: bool = False) -> Self:
        """The page with the name the program has."""
        name = Path("part.toml") if session.file is None else session.file
        return cls(Editing.of(str(name)), leave=leave)

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
        return (Save(with_suffix(typed(text), ".toml"), leave=self.leave),)

    def view(self, session: Session, surface: Surface) -> View:
        """The name."""
        return View(
            header("SAVE AS", plain(""), session, surface.width),
            (
                (),
                entry_row("FILE", self.entry, surface.width, fresh=self.replaced),
                (),
                plain(" The folder must exist. .toml is added where nothing is.", Look.LABEL),
            ),
            Said("Type the name of the file, Enter saves. Left arrow changes the name that stands there."),
            1,
        )
