"""FINDINGS: everything the program has to say about the block, each finding in full."""

from __future__ import annotations

from typing import ClassVar, Final

from app.screens.page import Surface
from app.screens.text import TextPage, paragraph
from app.session import Session
from app.widgets.rows import Look, Row, plain, text_of
from app.widgets.verdict import UNKNOWN, deepest_gouge, nearest_place, verdict_rows
from core.records import dataclass

MORE: Final = plain(" Whether there is more to say is being calculated.", Look.WARNING)
"""Where a better path has not been looked for yet, nor what the contour needs."""


@dataclass(frozen=True, eq=False, slots=True)
class FindingsPage(TextPage):
    """The verdict's lines, all of them, wrapped."""

    tabled: ClassVar[bool] = True

    def title(self, session: Session) -> str:
        """Which block's."""
        return f"BLOCK{session.where.block:>8}   FINDINGS"

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """The strip, then every finding."""
        found, unit = session.found, session.program.unit
        rows = verdict_rows(found, surface.table, unit, None)
        rows[2:2] = deepest_gouge(found, unit)
        uncut = next((place for place, row in enumerate(rows) if text_of(row).startswith(" UNCUT")), 0)
        rows[uncut + 1 : uncut + 1] = nearest_place(found, unit)
        told = [one for row in rows[1:] for one in _wrapped(row, surface.width)]
        if found.work is not None and found.side is not None and (surface.table is None or not surface.table.complete):
            told.append(MORE)
        return (rows[0], (), *(told or [plain(" Nothing to report.") if found.known else UNKNOWN]))


def _wrapped(row: Row, width: int) -> tuple[Row, ...]:
    text = text_of(row)
    return (row,) if len(text) < width else paragraph(text.strip(), width, row[-1].look, "   ")
