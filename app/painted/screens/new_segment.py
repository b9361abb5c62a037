"""A new segment: which kind, before which one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.painted.messages import Close, Edit, Message, Move, Swap
from app.painted.screens.contour import Contour
from app.painted.screens.page import Answer, Page, Softkey, Softkeys, Surface, View, unseen
from app.painted.session import Said, Session
from app.painted.widgets.header import block_line, header, segment_line
from app.painted.widgets.rows import Look, Row, Span
from app.painted.widgets.verdict import before_first
from core.program.edit import FormPlace, Refused, insert_segment
from core.program.fields import TABLES, Form, form_of
from core.program.model import ArcSegment, BlendSegment, LineSegment, Segment

KINDS: Final[tuple[tuple[str, Form, type[Segment], str], ...]] = (
    ("l", Form.LINE, LineSegment, "to a point, or by length and angle"),
    ("a", Form.ARC, ArcSegment, "about a center, or by radius"),
    ("b", Form.BLEND, BlendSegment, "tangent to the segments on both sides"),
)
"""Letter, form, type and a word about each kind of segment."""


@dataclass(frozen=True, eq=False, slots=True)
class NewSegment(Page):
    """Offers the kinds of segment that can stand before segment `number`, or behind the last."""

    number: int

    def softkeys(self, session: Session) -> Softkeys:
        """F1 LINE, F2 ARC, F3 BLEND ARC."""
        keys = {index: Softkey(form, self._added(session, index - 1)) for index, (_, form, _, _) in enumerate(KINDS, 1)}
        return {**keys, 8: Softkey("EXIT", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """The letters L, A, B choose; left goes back."""
        letters = [letter for letter, _, _, _ in KINDS]
        if character is not None and character.lower() in letters:
            added = self._added(session, letters.index(character.lower()))
            return Answer(self, added if len(added) == 1 else (*added, Swap(Contour(added=True))))
        return Answer(self, (Close(),)) if key in ("left", "pageup", "backspace") else None

    def escape(self, session: Session) -> Answer | None:
        """Nothing is added."""
        return Answer(self, (Close(),))

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """The program behind is not to change unseen."""
        return unseen(self, key)

    def _added(self, session: Session, index: int) -> tuple[Message, ...]:
        _, form, kind, _ = KINDS[index]
        where = FormPlace(session.where.block, self.number)
        outcome = insert_segment(session.program, where, kind())
        edit = Edit(outcome, f"new {form} {self.number}, block {where.block}")
        return (edit,) if isinstance(outcome, Refused) else (edit, Close(), Move(where, TABLES[form][0].name))

    def view(self, session: Session, surface: Surface) -> View:
        """The three kinds."""
        last = len(session.block.segments)
        title = "NEW" if self.number > last else f"NEW, before {form_name(session.block.segments[self.number - 1])}"
        number = segment_line(str(self.number), title, cursor=True)
        rows = [_kind_row(letter, form, words) for letter, form, _, words in KINDS]
        return View(
            header(block_line(session), number, session, surface.width),
            ((), *rows),
            Said("Press the softkey or the letter of the new segment, or left arrow to go back."),
            told=before_first(session.found, session.program.unit),
        )


def _kind_row(letter: str, form: str, words: str) -> Row:
    return (Span(f" {letter.upper()}  ", Look.KEY), Span(f"{form:<11}", Look.HEAD), Span(words, Look.LABEL))


def form_name(segment: Segment) -> str:
    """LINE, ARC or BLEND ARC."""
    return form_of(segment)
