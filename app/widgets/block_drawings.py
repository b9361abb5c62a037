"""BlockDrawings shows a block in two drawings: the whole part, and the loupe on the selected finding or the segment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final, cast

from textual.app import ComposeResult
from textual.containers import Horizontal

from app.session.block_findings import Entry, EntryKind
from app.session.session import Session
from app.widgets.drawing import Drawing
from app.widgets.findings_list import heading
from app.widgets.verdict import MARKS_OF_CHARACTERS
from core.program.fields import form_of
from core.program.solve.solved import solution_at

if TYPE_CHECKING:
    from core.draw.scene import Mark
    from core.geometry.piece import Point
    from core.pipeline.plot import Subject

MAX_NUMBERED: Final = 9
"""The most findings with a number in PART: a number is one character."""


class BlockDrawings(Horizontal):
    """PART, a small outline, or if there is room the whole part, and the loupe; hidden drawings are not made."""

    def compose(self) -> ComposeResult:
        """Yield three drawings, of which the style sheet shows one or two."""
        yield Drawing(id="outline", classes="-outline")
        yield Drawing(id="whole")
        yield Drawing(id="loupe")

    def on_mount(self) -> None:
        """Set the titles that never change."""
        self.query_one("#outline", Drawing).heading = "PART"
        self.query_one("#whole", Drawing).heading = "DRAWING  whole part"

    def show(self, session: Session, entries: Sequence[Entry], selected_finding: int | None, characters: str) -> None:
        """Draw the block with the cursor; the loupe is on `selected_finding`, or on the segment if that is None.

        `entries` are the findings that have a position.
        """
        from core.pipeline.plot import Subject

        block, unit, segment = session.derived_block, session.program.unit, session.place.segment
        near, title, kind = _loupe(session, entries, selected_finding, characters)
        subjects = {
            "outline": Subject(block, unit, segment, outline=True, trouble=_numbers(entries)),
            "whole": Subject(block, unit, segment),
            "loupe": Subject(block, unit, segment, near=near),
        }
        for name, subject in subjects.items():
            drawing = self.query_one(f"#{name}", Drawing)
            before = cast("Subject | None", drawing.subject)
            drawing.subject = (
                subject if before is None or _moved(before, subject) else replace(subject, view=before.view)
            )
        loupe = self.query_one("#loupe", Drawing)
        loupe.heading = title
        loupe.set_class(kind is EntryKind.GOUGE, "-gouge")
        loupe.set_class(kind is EntryKind.UNCUT, "-uncut")


def _moved(before: Subject, after: Subject) -> bool:
    """Return whether the cursor or the loupe has moved; until then the window that the operator zoomed to stays."""
    return (before.block.number, before.segment, before.near) != (after.block.number, after.segment, after.near)


def _numbers(entries: Sequence[Entry]) -> tuple[Mark, ...]:
    """Return each finding's number at its position; the worst is drawn last, so it shows if several coincide."""
    from core.draw.scene import Mark, Style, Symbol

    marks = [
        Mark(entry.at, Style.GOUGE if entry.kind is EntryKind.GOUGE else Style.UNCUT, Symbol.NUMBER, text=str(number))
        for number, entry in enumerate(entries[:MAX_NUMBERED], 1)
        if entry.at is not None
    ]
    return tuple(reversed(marks))


def _loupe(
    session: Session, entries: Sequence[Entry], selected_finding: int | None, characters: str
) -> tuple[Point | None, str, EntryKind | None]:
    """Return the loupe's center (None for the whole part), its title, and the kind of the finding."""
    if selected_finding is not None and selected_finding < len(entries):
        entry = entries[selected_finding]
        return entry.at, heading(entries, selected_finding, MARKS_OF_CHARACTERS[characters]), entry.kind
    number = session.place.segment
    solved = session.derived_block.solved.segments
    solution = solution_at(session.derived_block.solved, number)
    if solution is not None:
        # show the whole part, so that all solutions are visible
        return None, f"SEGMENT {number} {form_of(session.block.segments[number - 1])}   SOLUTION {solution.label}", None
    if number and number <= len(solved):
        piece, segment = solved[number - 1].piece, session.block.segments[number - 1]
        turn = f" {direction}" if (direction := getattr(segment, "direction", None)) else ""
        return None if piece is None else piece.point_at(0.5), f"SEGMENT {number} {form_of(segment)}{turn}", None
    return solved[0].start if solved else None, "START", None
