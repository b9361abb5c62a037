"""LOOKAHEAD TABLE: what every value from 1 to 20 does to the path, one of them drawn, one of them taken."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Final

from app.painted.messages import Close, Edit
from app.painted.screens.page import Answer, Layout, Page, Sketch, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.rows import Look, Row, Span, padded, plain
from app.painted.widgets.strip import mark_of
from app.painted.widgets.words import length, numbers
from core.comp.lookahead import HIGHEST, LOWEST
from core.program.edit import FormPlace, recalculate_lookahead, type_field
from core.program.model import Number
from core.units import Unit

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row as Fate
    from core.advice.lookahead_table import Table

HALF: Final = (HIGHEST - LOWEST + 1) // 2
"""The table stands in two columns of ten values."""
HEADING: Final = f"{'value':>6}{'gouge':>8}{'uncut':>9} {'del.':5}"
ERASED: Final = 4
"""Cells for the deleted segments; the lines below the table name those of the value under the cursor in full."""
NOTHING: Final = (
    "There is nothing to compare yet: a tool, a side and a",
    "determined contour are needed.",
)
PROMPT: Final = (
    "Up and down show what a value does. Enter takes it as USR. ! gouges, * deletes segments, < recommended."
)
STEPS: Final = {"up": -1, "down": 1, "left": -HALF, "right": HALF, "pageup": -HALF, "pagedown": HALF}


@dataclass(frozen=True, eq=False, slots=True)
class LookaheadTable(Page):
    """The table with the cursor on `at`, whose path is drawn."""

    layout: ClassVar[Layout] = Layout.TABLE
    tabled: ClassVar[bool] = True
    at: int

    def softkeys(self, session: Session) -> Softkeys:
        """Taking the value, or going back to CAL."""
        program, block = session.program, session.where.block
        # an undo made here may have gone to a segment, which has no such field
        usr = type_field(program, FormPlace(block), "lookahead", Number(float(self.at)))
        taken = Edit(usr, f"CUTCOMP LOOKAHEAD {self.at}")
        cal = Edit(recalculate_lookahead(program, block), "RECALCULATE LOOKAHEAD")
        return {
            1: Softkey(f"TAKE {self.at} AS USR", (taken, Close())),
            3: Softkey("RECALCULATE LOOKAHEAD", (cal, Close())),
            8: Softkey("EXIT", (Close(),)),
        }

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """The arrows step over the values, Enter takes one."""
        if key == "enter":
            return Answer(self, self.softkeys(session)[1].messages)
        if key in ("home", "end"):
            return Answer(replace(self, at=LOWEST if key == "home" else HIGHEST))
        if key in STEPS:
            return Answer(replace(self, at=min(max(self.at + STEPS[key], LOWEST), HIGHEST)))
        return None

    def escape(self, session: Session) -> Answer | None:
        """Back without taking a value."""
        return Answer(self, (Close(),))

    def look(self) -> int:
        """The value under the cursor."""
        return self.at

    def view(self, session: Session, surface: Surface) -> View:
        """The table, or why there is none yet."""
        ahead = session.found.lookahead
        title = f"BLOCK{session.where.block:>8}   LOOKAHEAD TABLE   {ahead.tag} {ahead.value}"
        heading = plain(HEADING * 2 if surface.table else "", Look.LABEL)
        body = self._body(session.program.unit, surface.table)
        return View((plain(f" {title}", Look.HEAD), heading), body, Said(PROMPT), 0, Sketch(self.at))

    def _body(self, unit: Unit, table: Table | None) -> tuple[Row, ...]:
        if table is None:
            return tuple(plain(f" {line}", Look.LABEL) for line in NOTHING)
        lines = []
        for line in range(HALF):
            pair = (_fate(table, LOWEST + line + half, self.at, unit) for half in (0, HALF))
            lines.append(tuple(span for row in pair for span in padded(row, 29)))
        return tuple(lines)


def _fate(table: Table, value: int, at: int, unit: Unit) -> Row:
    fate = table.row(value)
    look = Look.CURSOR if value == at else Look.TYPED
    mark = "<" if value == table.recommended else " "
    return (Span(" "), Span(f"{value:>3}{mark_of(fate) or ' '}{mark}", look), *_numbers(fate, unit))


def _numbers(fate: Fate, unit: Unit) -> Row:
    gouge = Span(f"{'none':>8}", Look.GOOD) if fate.clean else Span(f"{length(fate.gouge, unit):>8}", Look.ERROR)
    erased = numbers(fate.deleted)
    short = erased if len(erased) <= ERASED else f"{erased[: ERASED - 1]}…"
    return (gouge, Span(f"{length(fate.uncut, unit):>9}", Look.TYPED), Span(f" {short}", Look.WARNING))
