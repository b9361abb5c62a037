"""HELP: what the field under the cursor takes, and every key."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.screens.page import Surface
from app.screens.text import TextPage, paragraph
from app.session import Session
from app.widgets.rows import Look, Row, Span

KEYS: Final[tuple[tuple[str, str], ...]] = (
    ("Enter", "take the field and go on; on SEGMENT: go there, or edit it"),
    ("Tab, up, down", "from field to field"),
    ("Esc", "the field's old value back; out of a dialog"),
    ("left, right", "change the text in the middle; step a choice; walk on SEGMENT"),
    ("Del, Backspace", "empty the field; Enter then makes it blank"),
    ("Page Up, Down", "the segment before, the next one; behind the last a new one"),
    ("Ctrl+Home, End", "START, the last segment"),
    ("Ctrl+Z, Ctrl+Y", "undo, redo"),
    ("Ctrl+S", "save"),
    ("Ctrl+Q", "leave the program"),
    ("F1 to F8", "the softkeys at the right; also Esc, then the digit"),
    ("?", "this help"),
)
MARKS: Final[tuple[tuple[str, str], ...]] = (
    ("CAL", "calculated, follows every edit"),
    ("USR", "a look-ahead that was typed in place of the calculated one"),
    ("DEF", "blank: the usual value is in force"),
    ("ERR", "cannot be read; nothing is posted while it stands"),
    ("?", "one more of the fields marked so is needed"),
    ("3!  3*  [3]", "look-ahead 3 gouges; erases segments; is in force"),
    ("S > ! x", "in the drawing: start, direction, gouge, where segments were erased"),
)


@dataclass(frozen=True, eq=False, slots=True)
class HelpPage(TextPage):
    """Sentences about the field, then the key sheet."""

    about: tuple[str, ...] = ()

    def title(self, session: Session) -> str:
        """HELP."""
        return "HELP"

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """The field's own help first."""
        told: tuple[Row, ...] = ()
        for index, text in enumerate(self.about):
            told += paragraph(text, surface.width, Look.PLAIN if index else Look.HEAD)
        sheet = (*map(_key, KEYS), (), *map(_key, MARKS))
        return (*told, (), *sheet) if told else sheet


def _key(pair: tuple[str, str]) -> Row:
    return (Span(f" {pair[0]:<15}", Look.KEY), Span(pair[1], Look.LABEL))
