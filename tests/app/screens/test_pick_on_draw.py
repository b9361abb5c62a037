"""The pick on DRAW: a cross, or typed X and Y, for a run that its data alone do not determine."""

from __future__ import annotations

from math import dist

import pytest

from app.screens.draw import DrawScreen
from core.program.model import Number
from tests.app.widget_pilot import Operator
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import case_of, ccw, cw, line

pytestmark = pytest.mark.asyncio(loop_scope="module")

TANGENT_ARC = case_of(line(length=40), ccw(tangent=True, x_end=60, y_end=20, sweep=90))
"""The line runs to (40, 0)."""
TWO_ANSWERS = case_of(line(length=57), cw(x_end=135, y_end=60, sweep=181, y_center=37), start=(20, 34))


def cross(user: Operator) -> tuple[float, float]:
    assert isinstance(user.screen, DrawScreen)
    assert user.screen.cross is not None
    return user.screen.cross


async def drawn(user: Operator) -> None:
    await user.finish()


async def test_the_form_names_f7_and_draw_opens_with_the_cross(user: Operator):
    await user.begin(program_of(TANGENT_ARC))
    await user.press("pagedown")
    assert user.prompt.endswith("enter one end, or a center. Or F7: point to the end of segment 1.")
    await user.press("f7")
    assert user.prompt.startswith("Point near the end of segment 1: X 30.000 Y 10.000.")
    await drawn(user)
    assert isinstance(user.screen, DrawScreen)
    picture = user.screen.drawing.drawn
    assert picture is not None
    assert any("+" in row for row in picture.picture.rows)
    await user.press("escape")
    assert isinstance(user.screen, DrawScreen)
    assert user.screen.cross is None, "Esc first removes the cross"
    await user.press("f7")
    assert user.screen.cross is not None
    await user.press("escape", "escape")
    assert type(user.screen).__name__ == "ContourScreen"


async def test_taking_the_cross_moved_by_arrows_calculates_the_run(user: Operator):
    await user.begin(program_of(TANGENT_ARC))
    await user.press("pagedown", "f7")
    await drawn(user)
    while dist(cross(user), (40.0, 0.0)) > 4.0:
        x, y = cross(user)
        await user.press("right" if x < 38.0 else "left" if x > 42.0 else "down" if y > 0.0 else "up")
        await drawn(user)
    await user.press("enter")
    assert user.prompt == "Segments 1 to 2 calculated. Esc goes back to the form."
    assert user.session.derived_block.solved.segments[0].end is not None
    assert dist(user.session.derived_block.solved.segments[0].end, (40.0, 0.0)) < 1e-6
    await user.press("escape")
    assert (user.value("x_end"), user.tag("x_end")) == ("40.000", "CAL")
    await user.press("ctrl+z")
    assert user.session.block.segments[0].pick_x is None
    assert user.prompt.startswith("Undone: PICK JOINT of segments 1 to 2.")


async def test_a_pick_too_far_away_is_refused_until_nearer_numbers_are_typed(user: Operator):
    await user.begin(program_of(TANGENT_ARC))
    await user.press("pagedown", "f7", "x", "'-500", "enter", "'300", "enter")
    assert "pick" in user.prompt
    assert user.session.derived_block.solved.runs[0].taken is None
    assert cross(user) == (-500.0, 300.0)
    await user.press("x", "'38", "enter", "'1+1", "enter")
    assert "calculated" in user.prompt
    assert (user.session.block.segments[0].pick_x, user.session.block.segments[0].pick_y) == (Number(38), Number(2))


async def test_a_pick_between_two_solutions_asks_for_a_nearer_pick_or_solution(user: Operator):
    await user.begin(program_of(TWO_ANSWERS))
    await user.press("pagedown", "f7", "x", "'21", "enter", "'13.5", "enter")
    assert user.prompt == ("2 solutions fit: set the pick nearer to the end of segment 1, or pick one on SOLUTION.")
    await user.press("escape", "escape")
    while user.at != "choice":
        await user.press("tab")
    ends = []
    for _ in range(2):
        await user.press("space")
        ends.append(user.value("x_end"))
    assert len(set(ends)) == 2
    assert user.session.derived_block.solved.fully_determined


async def test_a_run_that_needs_no_pick_offers_none(user: Operator):
    await user.begin(program_of(case_of(line(angle=30), line(x_end=100, y_end=0, angle=300))))
    await user.press("pagedown", "f7", "f7")
    assert user.prompt == "This segment needs no pick."
    await user.press("x")
    assert isinstance(user.screen, DrawScreen)
