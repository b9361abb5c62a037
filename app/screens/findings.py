"""FINDINGS: everything the program has to say about the block, each finding in full."""

from __future__ import annotations

from typing import ClassVar, Final

from app.screens.page import Surface
from app.screens.text import TextPage, paragraph
from app.session import Session
from app.widgets.rows import Look, Row, plain, text_of
from app.widgets.verdict import UNKNOWN, deepest_gouge, finding_row, nearest_place, verdict_rows
from core.records import dataclass

MORE: Final = plain(" Whether there is more to say is being calculated.", Look.WARNING)
"""Where a better path has not been looked for yet, nor what the contour needs."""


@dataclass(frozen=True, eq=False, slots=True)
class FindingsPage(TextPage):
    """The verdict's lines, all of them, wrapped: of the path in force, or of that which another look-ahead makes."""

    tabled: ClassVar[bool] = True
    value: int | None = None

    def title(self, session: Session) -> str:
        """Which block's, and at which look-ahead where it is not the one in force."""
        at = "" if self.value is None else f" AT LOOK-AHEAD {self.value}"
        return f"BLOCK{session.where.block:>8}   FINDINGS{at}"

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """The strip, then every finding."""
        if self.value is not None:
            return self._of_value(self.value, session, surface)
        found, unit = session.found, session.program.unit
        rows = verdict_rows(found, surface.table, unit, None)
        rows[2:2] = deepest_gouge(found, unit)
        uncut = next((place for place, row in enumerate(rows) if text_of(row).startswith(" UNCUT")), 0)
        rows[uncut + 1 : uncut + 1] = nearest_place(found, unit)
        told = [one for row in rows[1:] for one in _wrapped(row, surface.width)]
        if found.work is not None and found.side is not None and (surface.table is None or not surface.table.complete):
            told.append(MORE)
        return (rows[0], (), *(told or [plain(" Nothing to report.") if found.known else UNKNOWN]))

    def _of_value(self, value: int, session: Session, surface: Surface) -> tuple[Row, ...]:
        """What the path of a look-ahead value does, in short and then finding by finding."""
        from core.verify.report import findings

        found, unit, table = session.found, session.program.unit, surface.table
        if table is None or found.work is None:
            return (UNKNOWN,)
        first, *rows = verdict_rows(found, table, unit, value)
        rows += [finding_row(one, unit) for one in findings(table.row(value).verdict, found.work.surface)]
        return (first, (), *(line for row in rows for line in _wrapped(row, surface.width)))


def _wrapped(row: Row, width: int) -> tuple[Row, ...]:
    text = text_of(row)
    return (row,) if len(text) < width else paragraph(text.strip(), width, row[-1].look, "   ")
