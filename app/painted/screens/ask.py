"""Ask: a question with a few answers, each a softkey and a letter; Esc answers nothing."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import wrap
from typing import ClassVar

from app.painted.messages import Close, Message, Say
from app.painted.screens.page import Answer, Page, Softkey, Softkeys, Surface, View, unseen
from app.painted.session import Said, Session
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, Span, plain

Option = tuple[str, str, tuple[Message, ...]]
"""Letter, label, and what is asked of the App."""


@dataclass(frozen=True, eq=False, slots=True)
class Ask(Page):
    """A question; `options` stand on F1, F2 ... and F8 goes back, and nothing changes.

    `about` is a file's name where the question is not about the program's own file.
    """

    asks: ClassVar[bool] = True
    title: str
    lines: tuple[str, ...]
    options: tuple[Option, ...]
    about: str = ""

    def softkeys(self, session: Session) -> Softkeys:
        """The answers."""
        keys = {number: Softkey(label, messages) for number, (_, label, messages) in enumerate(self.options, 1)}
        return {**keys, 8: Softkey("CANCEL", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """An answer's letter; whatever else is typed answers nothing, and is told so."""
        for letter, _, messages in self.options:
            if character is not None and character.lower() == letter:
                return Answer(self, messages)
        typed = key == "enter" or (character is not None and character.isalnum())
        return Answer(self, (Say(self.way_out()),)) if typed else None

    def way_out(self) -> str:
        """The letters that answer, as a sentence."""
        return f"Press {letters(self.options)}; Esc goes back and nothing changes."

    def escape(self, session: Session) -> Answer | None:
        """No answer."""
        return Answer(self, (Close(),))

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """The program behind is neither changed nor saved unseen."""
        return unseen(self, key)

    def view(self, session: Session, surface: Surface) -> View:
        """The question and its answers."""
        asked = tuple(plain(f" {part}") for line in self.lines for part in wrap(line, max(surface.width - 3, 8)))
        answers = tuple(_answer(letter, label) for letter, label, _ in self.options)
        return View(
            header(self.title, plain(""), session, surface.width, self.about),
            ((), *asked, (), *answers, _answer("Esc", "back, nothing changes")),
            Said("Press the softkey or the letter of an answer."),
        )


def letters(options: tuple[Option, ...]) -> str:
    """The letters that answer."""
    return " or ".join(letter.upper() if len(letter) == 1 else letter for letter, _, _ in options)


def _answer(letter: str, label: str) -> Row:
    return (Span(f"  {letter.upper() if len(letter) == 1 else letter:<4}", Look.KEY), Span(label, Look.LABEL))
