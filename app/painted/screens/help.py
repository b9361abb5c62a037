"""HELP: what the field under the cursor takes, and every key."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.painted.screens.page import Surface
from app.painted.screens.text import TextPage, paragraph
from app.painted.session import Session
from app.painted.widgets.rows import Look, Row, Span, plain

KEYS: Final[tuple[tuple[str, str], ...]] = (
    ("Enter", "take the field and go on"),
    ("Tab, up, down", "from field to field"),
    ("Esc", "the old value back, also in place of ERR;"),
    ("", "out of a dialog"),
    ("left, right", "change the text; step a choice; walk"),
    ("Del, Backspace", "empty the field; Enter makes it blank"),
    ("Page Up, Down", "segment before, next or new segment"),
    ("Ctrl+Home, End", "START, the last segment"),
    ("Ctrl+F", "every finding of the block in full"),
    ("Ctrl+Z, Ctrl+Y", "undo, redo"),
    ("Ctrl+S, Ctrl+O", "save, open"),
    ("Ctrl+Q", "leave the program"),
    ("Ctrl+L", "paint the screen again if it was spoilt"),
    ("F1 to F8", "the softkeys; also Esc, then the digit"),
    ("", "within 2 seconds; a digit without a"),
    ("", "softkey is typed. Ctrl+K does the same"),
    ("", "on any screen"),
    ("? or Ctrl+G", "this help (Ctrl+G in the middle of a text)"),
)
"""Key and what it does, each short enough for one line."""
MARKS: Final[tuple[tuple[str, str], ...]] = (
    ("CAL", "calculated, follows every edit"),
    ("USR", "a look-ahead that was typed"),
    ("DEF", "blank: the usual value is in force"),
    ("ERR", "cannot be read; blocks posting"),
    ("?", "one more of these fields is needed"),
    ("3! 3* [3]", "look-ahead 3 gouges; erases; in force"),
    ("S > o", "START, direction, plunge point"),
    ("! x", "gouge; where segments were erased"),
    ("Free: n", "kilobytes of memory that are free"),
)


@dataclass(frozen=True, eq=False, slots=True)
class HelpPage(TextPage):
    """Sentences about the field, then the key sheet; a line that begins with two blanks is of a picture."""

    about: tuple[str, ...] = ()
    file: str = ""

    def about_file(self) -> str:
        """That of the page below."""
        return self.file

    def title(self, session: Session) -> str:
        """HELP."""
        return "HELP"

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """The field's own help first."""
        told: tuple[Row, ...] = ()
        for index, text in enumerate(self.about):
            look = Look.PLAIN if index else Look.HEAD
            told += (plain(text, Look.TYPED),) if text.startswith("  ") else paragraph(text, surface.width, look)
        sheet = (*map(_key, KEYS), (), *map(_key, MARKS))
        return (*told, (), *sheet) if told else sheet


def _key(pair: tuple[str, str]) -> Row:
    return (Span(f" {pair[0]:<15}", Look.KEY), Span(pair[1], Look.LABEL))
