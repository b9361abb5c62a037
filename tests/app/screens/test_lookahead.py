"""LOOKAHEAD TABLE: what of it has room in its columns."""

from __future__ import annotations

from dataclasses import replace

from app.painted.messages import Open
from app.painted.screens.lookahead import LookaheadTable
from app.painted.screens.page import Surface
from app.painted.widgets.rows import text_of
from core.pipeline.derive import derive, look_ahead_table
from core.program.model import CutterComp, LineSegment, Number, Program
from tests.app.operator import Operator
from tests.app.squares import square

SAW = tuple((2.0 + 0.1 * step, -0.3 * (step % 2)) for step in range(9))
"""Eight short teeth that the cutter cannot enter."""


def saw() -> Operator:
    """Ten lines straight on, the teeth, and a line."""
    operator = square()
    points = (*((0.2 * step, 0.0) for step in range(10)), *SAW, (6.0, 0.0))
    segments = tuple(LineSegment(x_end=Number(x), y_end=Number(y), feed=Number(10.0)) for x, y in points)
    block = replace(operator.block, cutter_comp=CutterComp.LEFT, segments=segments, lookahead=None)
    return Operator.at(replace(operator.session.program, blocks=(block,)))


def lines(program: Program, operator: Operator) -> list[str]:
    (found,) = derive(program).blocks
    view = LookaheadTable(1).view(operator.session, Surface(80, 24, look_ahead_table(found, program)))
    return [text_of(row) for row in (*view.header, *view.body)]


def test_deleted_segments_that_have_no_room_are_marked_as_cut_short() -> None:
    operator = saw()
    told = lines(operator.session.program, operator)
    assert told[1] == " value   gouge    uncut del.  value   gouge    uncut del. "
    assert [told[1].index(name) + 5 for name in ("gouge", "uncut")] == [14, 23]
    last = told[-1][29:].split()
    assert (last[0], last[3]) == ("20*", "12-…")
    assert all(len(line) <= 59 for line in told)


def test_a_value_is_taken_though_an_undo_in_the_table_has_gone_to_a_segment() -> None:
    operator = square()
    operator.press("pagedown", "tab").type("2.5").press("ctrl+home")
    operator.desk = operator.desk.take(Open(LookaheadTable(2)))
    operator.press("ctrl+z")
    assert isinstance(operator.desk.page, LookaheadTable)
    assert operator.session.where.segment == 1
    operator.press("down", "enter")
    assert operator.block.lookahead == Number(3.0)
