"""FINDINGS: everything the program has to say about the block, each finding in full."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Final

from app.painted.at_value import AtValue, FoundAt
from app.painted.screens.page import Page, Surface
from app.painted.screens.text import TextPage, paragraph
from app.painted.session import Session
from app.painted.widgets.rows import Look, Row, plain, text_of
from app.painted.widgets.verdict import UNKNOWN, deepest_gouge, nearest_place, needed, verdict_rows
from core.pipeline.derived import DerivedBlock
from core.units import Unit

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table

MORE: Final = plain(" Whether there is more to say is being calculated.", Look.WARNING)
"""Where a better path has not been looked for yet, nor what the contour needs."""


@dataclass(frozen=True, eq=False, slots=True)
class FindingsPage(TextPage):
    """The verdict's lines, all of them, wrapped: of the path in force, or of that which another look-ahead makes."""

    tabled: ClassVar[bool] = True
    asked: AtValue | None = None
    at: FoundAt | None = None

    @property
    def question(self) -> AtValue | None:
        """What the other look-ahead makes of the block, until that is known."""
        return self.asked if self.at is None else None

    def hearing(self, answer: object) -> Page:
        """What it makes of it; the answer to another question is not ours."""
        return replace(self, at=answer) if isinstance(answer, FoundAt) and answer.asked is self.asked else self

    def title(self, session: Session) -> str:
        """Which block's, and at which look-ahead where it is not the one in force."""
        at = f" AT LOOK-AHEAD {self.asked.value}" if self.asked is not None and self._ours(session) else ""
        return f"BLOCK{session.where.block:>8}   FINDINGS{at}"

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """The strip, then every finding."""
        if self.asked is None or not self._ours(session):
            return _lines(session.found, surface.table, session.program.unit, surface.width)
        if self.at is None:
            return (UNKNOWN,)
        table = None if surface.table is None else replace(surface.table, notes=tuple(needed(surface.table)))
        return _lines(self.at.found, table, session.program.unit, surface.width)

    def _ours(self, session: Session) -> bool:
        """Whether the question is still about the program: it may have been undone meanwhile."""
        return self.asked is not None and self.asked.session.program is session.program


def _lines(found: DerivedBlock, table: Table | None, unit: Unit, width: int) -> tuple[Row, ...]:
    rows = verdict_rows(found, table, unit, None)
    rows[2:2] = deepest_gouge(found, unit)
    uncut = next((place for place, row in enumerate(rows) if text_of(row).startswith(" UNCUT")), 0)
    rows[uncut + 1 : uncut + 1] = nearest_place(found, unit)
    told = [one for row in rows[1:] for one in _wrapped(row, width)]
    if found.paths is not None and found.side is not None and (table is None or not table.complete):
        told.append(MORE)
    return (rows[0], (), *(told or [plain(" Nothing to report.") if found.known else UNKNOWN]))


def _wrapped(row: Row, width: int) -> tuple[Row, ...]:
    text = text_of(row)
    return (row,) if len(text) < width else paragraph(text.strip(), width, row[-1].look, "   ")
