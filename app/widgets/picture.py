"""Picture: the drawings of a block: the whole part, and the loupe on the finding in hand or the segment."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from textual.app import ComposeResult
from textual.containers import Horizontal

from app.session.block_findings import Entry, Kind
from app.session.session import Session
from app.widgets.drawing import Drawing
from app.widgets.findings_list import heading
from app.widgets.verdict import MARKS
from core.program.fields import form_of
from core.program.solve.solution import solution_at

if TYPE_CHECKING:
    from core.draw.scene import Mark
    from core.geometry.piece import Point

MAX_NUMBERED: Final = 9
"""Findings that have a number in PART: a number is one character."""


class Picture(Horizontal):
    """PART, a small outline, or the whole part where there is room, and the loupe; only what is seen is drawn."""

    def compose(self) -> ComposeResult:
        """Three drawings, of which the style sheet shows two."""
        yield Drawing(id="outline", classes="-outline")
        yield Drawing(id="whole")
        yield Drawing(id="loupe")

    def on_mount(self) -> None:
        """The titles that stay."""
        self.query_one("#outline", Drawing).heading = "PART"
        self.query_one("#whole", Drawing).heading = "DRAWING  whole part"

    def show(self, session: Session, entries: Sequence[Entry], in_hand: int | None, characters: str) -> None:
        """Draw the block with the cursor; the loupe is on the finding in hand, or on the segment where that is None.

        `entries` are the findings that have a place.
        """
        from core.pipeline.plot import Subject

        block, unit, segment = session.derived_block, session.program.unit, session.place.segment
        near, title, kind = _loupe(session, entries, in_hand, characters)
        subjects = {
            "outline": Subject(block, unit, segment, outline=True, trouble=_numbers(entries)),
            "whole": Subject(block, unit, segment),
            "loupe": Subject(block, unit, segment, near=near),
        }
        for name, subject in subjects.items():
            drawing = self.query_one(f"#{name}", Drawing)
            drawing.subject = subject
        loupe = self.query_one("#loupe", Drawing)
        loupe.heading = title
        loupe.set_class(kind is Kind.GOUGE, "-gouge")
        loupe.set_class(kind is Kind.UNCUT, "-uncut")


def _numbers(entries: Sequence[Entry]) -> tuple[Mark, ...]:
    """The number of each finding at its place; of several at one place the gravest is seen, which is drawn last."""
    from core.draw.scene import Mark, Style, Symbol

    marks = [
        Mark(entry.at, Style.GOUGE if entry.kind is Kind.GOUGE else Style.UNCUT, Symbol.NUMBER, text=str(number))
        for number, entry in enumerate(entries[:MAX_NUMBERED], 1)
        if entry.at is not None
    ]
    return tuple(reversed(marks))


def _loupe(
    session: Session, entries: Sequence[Entry], in_hand: int | None, characters: str
) -> tuple[Point | None, str, Kind | None]:
    """What the loupe is on, its title, and the kind of the finding."""
    if in_hand is not None and in_hand < len(entries):
        entry = entries[in_hand]
        return entry.at, heading(entries, in_hand, MARKS[characters]), entry.kind
    number = session.place.segment
    solved = session.derived_block.solved.segments
    solution = solution_at(session.derived_block.solved, number)
    if solution is not None:
        # all solutions are to be seen
        return None, f"SEGMENT {number} {form_of(session.block.segments[number - 1])}   SOLUTION {solution.label}", None
    if number and number <= len(solved):
        piece, segment = solved[number - 1].piece, session.block.segments[number - 1]
        turn = f" {direction}" if (direction := getattr(segment, "direction", None)) else ""
        return None if piece is None else piece.point_at(0.5), f"SEGMENT {number} {form_of(segment)}{turn}", None
    return solved[0].start if solved else None, "START", None
