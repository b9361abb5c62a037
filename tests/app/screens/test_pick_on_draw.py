"""The pick on DRAW: a cross, or typed X and Y, for a run that cannot be calculated from its data alone."""

from __future__ import annotations

from math import dist

from app.screens.draw import DrawScreen
from core.program.model import Number
from tests.app.widget_pilot import Operator, operator
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import case_of, ccw, cw, line

TANGENT_ARC = case_of(line(length=40), ccw(tangent=True, x_end=60, y_end=20, sweep=90))
"""The line runs to (40, 0)."""
TWO_ANSWERS = case_of(line(length=57), cw(x_end=135, y_end=60, sweep=181, y_center=37), start=(20, 34))


def cross(one: Operator) -> tuple[float, float]:
    assert isinstance(one.screen, DrawScreen)
    assert one.screen.cross is not None
    return one.screen.cross


async def drawn(one: Operator) -> None:
    await one.app.workers.wait_for_complete()
    await one.pilot.pause()


async def test_the_form_names_the_key_and_draw_begins_with_the_cross():
    async with operator(program_of(TANGENT_ARC)) as one:
        await one.press("pagedown")
        assert one.prompt.endswith("enter one end, or a center. Or F7: point to the end of segment 1.")
        await one.press("f7")
        assert one.prompt.startswith("Point near the end of segment 1: X 30.000 Y 10.000.")
        await drawn(one)
        assert isinstance(one.screen, DrawScreen)
        shown = one.screen.drawing.drawn
        assert shown is not None
        assert any("+" in row for row in shown.picture.rows)


async def test_the_cross_moved_by_arrows_and_taken_calculates_the_run():
    async with operator(program_of(TANGENT_ARC)) as one:
        await one.press("pagedown", "f7")
        await drawn(one)
        while dist(cross(one), (40.0, 0.0)) > 4.0:
            x, y = cross(one)
            await one.press("right" if x < 38.0 else "left" if x > 42.0 else "down" if y > 0.0 else "up")
            await drawn(one)
        await one.press("enter")
        assert one.prompt == "Segments 1 to 2 calculated. Esc goes back to the form."
        assert one.session.derived_block.solved.segments[0].end is not None
        assert dist(one.session.derived_block.solved.segments[0].end, (40.0, 0.0)) < 1e-6
        await one.press("escape")
        assert (one.value("x_end"), one.tag("x_end")) == ("40.000", "CAL")
        await one.press("ctrl+z")
        assert one.session.block.segments[0].pick_x is None
        assert one.prompt.startswith("Undone: PICK JOINT of segments 1 to 2.")


async def test_a_pick_too_far_away_is_said_and_typed_numbers_mend_it():
    async with operator(program_of(TANGENT_ARC)) as one:
        await one.press("pagedown", "f7", "x", "'-500", "enter", "'300", "enter")
        assert "pick" in one.prompt
        assert one.session.derived_block.solved.runs[0].taken is None
        assert cross(one) == (-500.0, 300.0)
        await one.press("x", "'38", "enter", "'1+1", "enter")
        assert "calculated" in one.prompt
        assert (one.session.block.segments[0].pick_x, one.session.block.segments[0].pick_y) == (Number(38), Number(2))


async def test_a_pick_between_two_answers_asks_for_a_nearer_one_or_solution():
    async with operator(program_of(TWO_ANSWERS)) as one:
        await one.press("pagedown", "f7", "x", "'21", "enter", "'13.5", "enter")
        assert one.prompt == ("2 solutions fit: set the pick nearer to the end of segment 1, or pick one on SOLUTION.")
        await one.press("escape", "escape")
        while one.at != "choice":
            await one.press("tab")
        ends = []
        for _ in range(2):
            await one.press("space")
            ends.append(one.value("x_end"))
        assert len(set(ends)) == 2
        assert one.session.derived_block.solved.whole


async def test_escape_takes_the_cross_away_first_and_f7_brings_it_back():
    async with operator(program_of(TANGENT_ARC)) as one:
        await one.press("pagedown", "f7", "escape")
        assert isinstance(one.screen, DrawScreen)
        assert one.screen.cross is None
        await one.press("f7")
        assert one.screen.cross is not None
        await one.press("escape", "escape")
        assert type(one.screen).__name__ == "ContourScreen"


async def test_a_run_that_needs_no_pick_takes_none():
    async with operator(program_of(case_of(line(angle=30), line(x_end=100, y_end=0, angle=300)))) as one:
        await one.press("pagedown", "f7", "f7")
        assert one.prompt == "This segment needs no pick."
        await one.press("x")
        assert isinstance(one.screen, DrawScreen)
