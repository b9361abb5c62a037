"""Decide: a question that must be answered before the work goes on, leaving the program answers nothing; Choose: one
that need not be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Final

from app.painted.messages import Say
from app.painted.screens.ask import Ask, letters
from app.painted.screens.page import Answer, Layout, Softkey, Softkeys, Surface, View
from app.painted.screens.text import fitting, paragraph
from app.painted.session import Said, Session
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Span, plain

MOST: Final = 6
"""Differences that are told one by one."""


@dataclass(frozen=True, eq=False, slots=True)
class Decide(Ask):
    """A question without a way around it; `details` stand under the lines."""

    layout: ClassVar[Layout] = Layout.TEXT
    details: tuple[str, ...] = ()

    def softkeys(self, session: Session) -> Softkeys:
        """The answers."""
        return {number: Softkey(label, messages) for number, (_, label, messages) in enumerate(self.options, 1)}

    def way_out(self) -> str:
        """There is no way around."""
        return f"Press {letters(self.options)}."

    def escape(self, session: Session) -> Answer | None:
        """No way around."""
        return Answer(self, (Say(self.way_out()),))

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """Nothing of its own: Esc does not leave this question."""
        return None

    def view(self, session: Session, surface: Surface) -> View:
        """The question, what it is about, and the answers."""
        width = surface.width
        asked = [row for line in self.lines for row in paragraph(line, width)]
        told = [row for line in shortened(self.details) for row in paragraph(line, width, Look.LABEL, "  ")]
        answers = [
            (Span(f"  {letter.upper():<4}", Look.KEY), Span(label, Look.LABEL)) for letter, label, _ in self.options
        ]
        return View(
            header(self.title, plain(""), session, width, self.about),
            ((), *asked, (), *told, (), *answers),
            Said("Press the softkey or the letter of an answer."),
        )


@dataclass(frozen=True, eq=False, slots=True)
class Choose(Ask):
    """A question that may be left unanswered; `details` stand under the answers, as far as there is room."""

    layout: ClassVar[Layout] = Layout.TEXT
    details: tuple[str, ...] = ()

    def view(self, session: Session, surface: Surface) -> View:
        """The question, the answers, and what they are about."""
        asked = Ask.view(self, session, surface)
        told = [row for line in self.details for row in paragraph(line, surface.width, Look.LABEL, "  ")]
        return asked._replace(body=(*asked.body, (), *fitting(told, surface.body - len(asked.body) - 1)))


def shortened(details: tuple[str, ...], most: int = MOST) -> tuple[str, ...]:
    """The first few, and how many more there are."""
    if len(details) <= most:
        return details
    return (*details[:most], f"And {len(details) - most} more.")
