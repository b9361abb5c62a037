"""The calculator over a form: a case is typed, its answer goes into the field, and the typed values are kept."""

from __future__ import annotations

import pytest
from textual.widgets import Input, OptionList, Static

from core.program.model import Number, Program
from tests.app.widget_pilot import Operator
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import case_of, line

pytestmark = pytest.mark.asyncio(loop_scope="module")


def part() -> Program:
    return program_of(case_of(line(x_end=5, y_end=5)))


async def at_x_end(user: Operator) -> None:
    await user.begin(part(), 1, "x_end")


def answers(user: Operator) -> list[str]:
    options = user.app.screen.query_one("#answers", OptionList)
    return [" ".join(str(options.get_option_at_index(at).prompt).split()) for at in range(options.option_count)]


def trouble(user: Operator) -> str:
    return str(user.app.screen.query_one("#number-trouble", Static).render())


async def test_a_point_on_a_bolt_circle_goes_into_x_end_and_y_end(user: Operator):
    await user.begin(part())
    await at_x_end(user)
    await user.press("equals_sign", *["down"] * 3, "enter")
    await user.press("'10", "enter", "'20", "enter", "'2*25", "enter", "'6", "enter", "'0", "enter", "'2", "enter")
    assert answers(user) == ["X 22.5", "Y 41.65063509"]
    await user.press("enter")
    assert (user.at, user.value("x_end"), user.session.history.undo_count) == ("x_end", "22.5", 0)
    await user.press("enter")
    assert user.session.block.segments[0].x_end == Number(22.5)
    await user.press("equals_sign", *["down"] * 3, "enter")
    typed = [field.value for field in user.app.screen.query(Input)]
    assert typed == ["10", "20", "2*25", "6", "0", "2"]
    await user.press(*["down"] * 6, "enter", "enter")
    assert user.session.block.segments[0].y_end == Number(41.65063509)


async def test_the_answer_that_fits_the_field_is_offered_first(user: Operator):
    await user.begin(part())
    await user.begin(part(), 1, "y_end")
    await user.send("equals_sign", *["down"] * 4)
    await user.press("enter")
    await user.press("'0", "enter", "'0", "enter", "'30", "enter", "'10", "enter", "enter")
    assert (user.at, user.value("y_end")) == ("y_end", "5")
    assert user.app.displayed is not user.session
    await user.begin(part(), 1, "angle")
    await user.press("equals_sign", "enter")
    await user.press("'3", "enter", "'3", "enter")
    assert answers(user) == ["ANGLE 45"], "the angle of a triangle from two sides"
    await user.press("enter")
    assert user.value("angle") == "45"


async def test_the_calculator_explains_errors_and_escape_keeps_the_field_unchanged(user: Operator):
    await user.begin(part())
    await at_x_end(user)
    await user.press("'1 1/", "equals_sign", *["down"] * 2, "enter")
    assert trouble(user) == "X OF THE POINT is blank: enter it."
    await user.press("'1", "enter", "'0", "enter", "'0", "enter", "'0", "enter", "'5", "enter")
    assert trouble(user) == "The point lies inside the circle: no line from it is tangent."
    await user.press("escape")
    assert (user.at, user.value("x_end")) == ("x_end", "1 1/")


async def test_the_equals_sign_opens_no_calculator_on_other_fields(user: Operator):
    await user.begin(part())
    await user.press("equals_sign")
    assert user.prompt == "The calculator works on fields that take a length or an angle."
    await user.press("f5")
    await user.press("delete", "'A", "equals_sign", "'B", "enter")
    assert user.session.program.setup.name == "A=B"


async def test_the_palette_opens_the_calculator(user: Operator):
    await user.begin(part())
    await at_x_end(user)
    await user.press("ctrl+k")
    await user.press(*"calculator")
    await user.finish()
    await user.press("enter")
    assert type(user.app.screen).__name__ == "ChooseLine"
