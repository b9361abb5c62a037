"""COMPARE CONTROLS: what every control does with the program under proof, one of them taken."""

from __future__ import annotations

from dataclasses import dataclass, replace
from textwrap import wrap
from typing import TYPE_CHECKING, ClassVar

from app.painted.messages import Close, Do, Message, Say
from app.painted.proving import Question, Told
from app.painted.screens.page import Answer, Layout, Page, Softkey, Softkeys, Surface, View
from app.painted.screens.proof_findings import BACK
from app.painted.session import Said, Session
from app.painted.widgets.rows import Look, Row, Span, plain

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from core.pipeline.checking import Answer as Fate


@dataclass(frozen=True, eq=False, slots=True)
class ComparePage(Page):
    """A row for each control; `here` is the one under proof, `at` the row with the cursor."""

    layout: ClassVar[Layout] = Layout.TEXT
    asked: Question
    here: str = ""
    rows: tuple[Fate, ...] = ()
    at: int = 0

    @property
    def question(self) -> Question | None:
        """All controls, until they have answered."""
        return None if self.rows else self.asked

    def hearing(self, answer: object) -> Page:
        """The table; the cursor on the control under proof."""
        if not isinstance(answer, Told) or answer.question is not self.asked:
            return self
        at = next((index for index, row in enumerate(answer.rows) if row.control == self.here), 0)
        return replace(self, rows=answer.rows, at=at)

    def softkeys(self, session: Session) -> Softkeys:
        """Take a control, or go back."""
        taken = {1: Softkey("TAKE THIS CONTROL", self._taken())} if self.rows else {}
        return {**taken, 8: Softkey("EXIT", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Up and down over the controls, Enter takes one."""
        steps = {"up": -1, "down": 1, "home": -len(self.rows), "end": len(self.rows)}
        if key in steps:
            return Answer(replace(self, at=min(max(self.at + steps[key], 0), max(len(self.rows) - 1, 0))))
        return Answer(self, self._taken()) if key == "enter" and self.rows else None

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """What changes the listing, or saves it, waits until it is seen."""
        return Answer(self, (Say(BACK),)) if key in ("ctrl+z", "ctrl+y", "ctrl+s") else None

    def escape(self, session: Session) -> Answer | None:
        """Back."""
        return Answer(self, (Close(),))

    def _taken(self) -> tuple[Message, ...]:
        control = self.rows[self.at].control
        return (Close(), Do(lambda desk: _tried_on(desk, control)))

    def view(self, session: Session, surface: Surface) -> View:
        """The table; the parting of the paths stands below the control it belongs to."""
        title = (plain(" COMPARE CONTROLS", Look.HEAD), plain(f" {'control':<18} what it does", Look.LABEL))
        if not self.rows:
            return View(title, ((), plain("   calculating ...", Look.DIM)), Said("Esc goes back."))
        told = [self._row(index, surface.across) for index in range(len(self.rows))]
        body = [row for rows in told for row in rows]
        one = self.rows[self.at]
        focus = 1 + sum(len(rows) for rows in told[: self.at])
        return View(title, ((), *body), Said(f"Enter tries {one.control}: {_said(one)}"), focus)

    def _row(self, index: int, width: int) -> tuple[Row, ...]:
        """A control's lines, wrapped between words: no number is cut."""
        one = self.rows[index]
        on_it = index == self.at
        name = Span(f"{one.control:<17}", Look.CURSOR if on_it else Look.TYPED)
        outcome, *more = wrap(one.outcome, max(width - 22, 8))
        first: Row = (Span(" > " if on_it else "   ", Look.TAG), name, Span(f" {outcome}", _look(one)))
        rest = [plain(f"{'':21}{line}", _look(one)) for line in more]
        parts = wrap(one.parts, max(width - 6, 8), subsequent_indent="  ")
        return (first, *rest, *(plain(f"{'':5}{line}", Look.LABEL) for line in parts))


def _said(one: Fate) -> str:
    """What a control stops for, in a sentence; else what the row says."""
    if one.why is not None:
        return one.why_said
    return f"{one.outcome}; {one.parts}." if one.parts else f"{one.outcome}."


def _look(one: Fate) -> Look:
    if one.errors:
        return Look.ERROR
    return Look.DIM if one.moves is None else Look.WARNING if one.uncompensated else Look.GOOD


def _tried_on(desk: Desk, control: str) -> Desk:
    from app.painted.screens.proof_tool import proof_page, put

    return put(desk, proof_page(desk).asking(control=control))
