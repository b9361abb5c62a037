"""TextPage: lines to read, a screenful at a time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from textwrap import wrap
from typing import ClassVar

from app.painted.messages import Close
from app.painted.screens.page import Answer, Layout, Page, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, plain

SCREENFUL = 16


@dataclass(frozen=True, eq=False, slots=True)
class TextPage(Page):
    """Text that begins at line `top`; a line that begins with two blanks keeps its columns."""

    layout: ClassVar[Layout] = Layout.TEXT
    top: int = 0

    def title(self, session: Session) -> str:
        """The first header line."""
        raise NotImplementedError

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """The whole text."""
        raise NotImplementedError

    def softkeys(self, session: Session) -> Softkeys:
        """Only the way back."""
        return {8: Softkey("EXIT", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Scrolling; Enter goes back."""
        steps = {"up": -1, "down": 1, "pageup": -SCREENFUL, "pagedown": SCREENFUL, "space": SCREENFUL}
        if key in steps:
            return Answer(replace(self, top=max(0, self.top + steps[key])))
        if key == "home":
            return Answer(replace(self, top=0))
        return Answer(self, (Close(),)) if key in ("enter", "question_mark") else None

    def escape(self, session: Session) -> Answer | None:
        """Back."""
        return Answer(self, (Close(),))

    def view(self, session: Session, surface: Surface) -> View:
        """The part of the text that fits."""
        lines = self.lines(session, surface)
        room = max(surface.body - 1, 1)
        top = min(self.top, max(len(lines) - room, 0))
        behind = len(lines) - top - room
        prompt = (
            f"{behind} more lines: down or Page Down shows them. Esc goes back." if behind > 0 else "Esc goes back."
        )
        first = header(self.title(session), plain(""), session, surface.width, self.about_file())
        return View(first, ((), *lines[top : top + room]), Said(prompt))


def fitting(rows: Sequence[Row], room: int, more: str = "And more.") -> tuple[Row, ...]:
    """The rows for which there is room, the last of them saying that there are more where there are."""
    if len(rows) <= room:
        return tuple(rows)
    return (*rows[: room - 1], plain(f" {more}", Look.LABEL)) if room > 0 else ()


def paragraph(text: str, width: int, look: Look = Look.PLAIN, indent: str = "") -> tuple[Row, ...]:
    """A sentence wrapped to the width; further lines are indented."""
    lines = wrap(text, max(width - 2, 8), subsequent_indent=indent) or [""]
    return tuple(plain(f" {line}", look) for line in lines)
