"""FINDINGS of NC PROOF: everything that was found in the program, each finding whole."""

from __future__ import annotations

from dataclasses import dataclass, replace
from textwrap import wrap
from typing import TYPE_CHECKING, ClassVar, Final

from app.painted.messages import Close, Do, Message, Say
from app.painted.screens.page import Answer, Layout, Page, Question, Softkey, Softkeys, Surface, View
from app.painted.screens.proof_rows import BEFORE, LOOKS, MARKS, count_of, place, told
from app.painted.screens.proof_tool import proof_page, put, unit_of
from app.painted.session import Said, Session
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, Span, plain

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from app.painted.screens.proof import ProofPage

STEPS: Final = {"up": -1, "down": 1, "p": -1, "n": 1, "pageup": -5, "pagedown": 5, "home": -(10**9), "end": 10**9}
BACK: Final = "Esc goes back to the listing first."
FIRST: Final = 15
"""Cells before the text of a finding: its mark, its severity, its place."""


@dataclass(frozen=True, eq=False, slots=True)
class ProofFindings(Page):
    """`proof` is the page below as far as its findings go: it hears the answers that come meanwhile."""

    layout: ClassVar[Layout] = Layout.TEXT
    proof: ProofPage

    @property
    def question(self) -> Question | None:
        """What is not known yet of the text below."""
        return self.proof.question

    def hearing(self, answer: object) -> Page:
        """The findings of the text as it is now."""
        heard = self.proof.hearing(answer)
        return self if heard is self.proof else replace(self, proof=heard)

    def softkeys(self, session: Session) -> Softkeys:
        """Go to the finding's line, or back."""
        return {1: Softkey("GO TO FINDING", self._gone()), 8: Softkey("EXIT", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Up and down from finding to finding, Enter goes to the line of one."""
        if key in STEPS:
            at = min(max(self.proof.at + STEPS[key], 0), max(len(self.proof.findings) - 1, 0))
            return Answer(replace(self, proof=replace(self.proof, at=at)))
        return Answer(self, self._gone()) if key == "enter" else None

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """What changes the text, or saves it, waits until it is seen; the findings are here already."""
        if key == "ctrl+f":
            return Answer(self)
        return Answer(self, (Say(BACK),)) if key in ("ctrl+z", "ctrl+y", "ctrl+s") else None

    def escape(self, session: Session) -> Answer | None:
        """Back."""
        return Answer(self, (Close(),))

    def about_file(self) -> str:
        """The NC program."""
        return self.proof.about_file()

    def _gone(self) -> tuple[Message, ...]:
        at = self.proof.at
        return (Close(), Do(lambda desk: _gone_to(desk, at)))

    def view(self, session: Session, surface: Surface) -> View:
        """All lines of the finding with the mark, and as many before and behind it as there is room for."""
        page = self.proof
        second = plain(f" {f'on {page.control}' if page.fresh else BEFORE}", Look.DIM)
        first = header(f"NC PROOF  FINDINGS  {count_of(page)}", second, session, surface.width, self.about_file())
        rows = [self._rows(index, surface.across) for index in range(len(page.findings))]
        begin = sum(map(len, rows[: page.at]))
        last = begin + (len(rows[page.at]) if rows else 0)
        top = min(begin, max(0, last - max(surface.body, 1)))
        body = [row for one in rows for row in one][top : top + max(surface.body, 1)]
        return View(first, tuple(body), Said("Enter goes to the finding with >, up and down to others, Esc goes back."))

    def _rows(self, index: int, width: int) -> list[Row]:
        """A finding's lines, wrapped between words: no number is cut."""
        one = self.proof.findings[index]
        on_it, look = index == self.proof.at, LOOKS[one.severity]
        lines = wrap(told(one, unit_of(self.proof)), max(width - FIRST - 1, 8), break_on_hyphens=False)
        mark = Span(" > " if on_it else "   ", Look.TAG)
        begin = (mark, Span(f"{MARKS[one.severity]} {place(one):>8} ", look), Span(lines[0], look))
        return [begin, *(plain(f"{'':{FIRST}}{line}", look) for line in lines[1:])]


def _gone_to(desk: Desk, at: int) -> Desk:
    return put(desk, replace(proof_page(desk), telling=False).at_finding(at))
