"""What an operator is told and led to: choices, the first segment, deletions, the way back."""

from __future__ import annotations

import pytest

from app.painted.screens.contour import Contour
from app.painted.screens.new_segment import NewSegment
from app.painted.screens.program import ProgramPage
from app.painted.session import SEGMENT
from core.program.edit import FormPlace
from core.program.model import Number
from tests.app.operator import Operator
from tests.app.squares import square


def test_a_choice_names_its_choices() -> None:
    said = Operator.at().press("tab", "tab").said
    assert said.endswith("Space steps, letters spell: ON, LEFT, RIGHT, PROFILE LEFT, PROFILE RIGHT.")
    assert Operator.at().press("f4").said.endswith("Space steps, letters spell: IN, MM.")


def test_the_path_parameter_names_its_choices() -> None:
    assert Operator.at().press("f4", "up", "up").said.endswith("Space steps, letters spell: CONTROL, BEST.")


def test_enter_on_the_last_field_of_start_leads_to_the_first_segment() -> None:
    operator = Operator.at().press("tab", "up", "up")
    assert operator.session.field == "peck_depth"
    assert isinstance(operator.press("enter").desk.page, NewSegment)


def test_enter_on_the_last_field_of_start_goes_round_where_there_are_segments() -> None:
    operator = square().press("up", "enter")
    assert operator.session.field == SEGMENT
    assert isinstance(operator.desk.page, Contour)


def test_segment_says_how_the_first_segment_is_made() -> None:
    assert "right arrow or Page Down for the first segment" in Operator.at().said


@pytest.mark.parametrize("text", ["-1", "abc", "1.5", "²"])
def test_what_is_no_segment_number_is_told_and_opens_nothing(text: str) -> None:
    operator = square().type(text)
    assert operator.session.where == FormPlace(1, 0)
    assert operator.session.field == SEGMENT
    assert f"{text} is no segment number" in operator.said


def test_deleting_says_how_to_get_it_back() -> None:
    operator = square().press("ctrl+end", "f1")
    assert "Deleted segment 4, LINE; 3 left. Ctrl+Z brings it back." in operator.said
    assert "Deleted tool 1. Ctrl+Z brings it back." in operator.press("ctrl+home", "f6", "f1").said
    operator.press("escape", "f8", "f3", "f1")
    assert operator.said == "Deleted block 2. Ctrl+Z brings it back."


def test_a_refused_deletion_says_nothing_of_the_kind() -> None:
    assert "Deleted" not in square().press("f1").said
    assert "Deleted" not in square().press("f8", "f1").said


def test_a_block_at_the_end_of_the_list_stays_and_says_so() -> None:
    operator = square().press("f8", "f7", "f1")
    assert operator.said == "Block 1 is the first one: it cannot move up."
    assert operator.press("f2").said == "Block 1 is the last one: it cannot move down."


@pytest.mark.parametrize("softkey", ["f4", "f5", "f6"])
def test_escape_first_forgets_the_text_then_leaves(softkey: str) -> None:
    operator = Operator.at().press("f8", "f7", softkey)
    field = ("down",) if softkey == "f4" else ()
    operator.press(*field, "7", "escape")
    assert not isinstance(operator.desk.page, ProgramPage)
    assert isinstance(operator.press("escape").desk.page, ProgramPage)


def test_the_drawing_names_the_kind_of_the_segment() -> None:
    assert "SEGMENT     3   LINE" in square().press("3", "enter", "f7").part("header")


@pytest.mark.parametrize(("letter", "field"), [("l", "x_end"), ("b", "radius")])
def test_an_enter_directly_behind_the_letter_skips_no_field(letter: str, field: str) -> None:
    operator = square().press("3", "enter", "pageup", "right", "ctrl+end", "right", letter, "enter")
    assert operator.session.field == field
    assert "Enter again goes on" in operator.said
    assert operator.press("enter").session.field != field


@pytest.mark.parametrize("back", ["up", "shift+tab"])
def test_back_over_that_enter_stays_on_the_field_and_only_then_leaves_it(back: str) -> None:
    operator = square().press("ctrl+end", "right", "l", "enter", back)
    assert operator.session.field == "x_end"
    assert "X END has the cursor" in operator.said
    assert square().press("ctrl+end", "right", "l", "enter", back).type("7").typed("x_end")[-1] == Number(7.0)
    assert operator.press(back).session.field == SEGMENT
    assert square().press("ctrl+end", "right", "l", back).session.field == SEGMENT
    assert square().press("ctrl+end", "right", "l", "enter", "enter", back).session.field == "x_end"


@pytest.mark.parametrize(("width", "height"), [(20, 5), (30, 4), (40, 10), (79, 24)])
def test_on_a_small_terminal_a_message_is_told_in_full_until_the_next_key(width: int, height: int) -> None:
    operator = square().press("9", "9", "enter")
    told = "!! There is no segment 99: the last one is 4. Right arrow past the last adds one."
    assert told in " ".join(" ".join(operator.screen(width, height)).split())
    assert told not in " ".join(" ".join(operator.press("tab").screen(width, height)).split())
    assert len(operator.screen(width, height)) == height


def test_an_enter_behind_something_typed_goes_on() -> None:
    operator = square().press("ctrl+end", "right", "l").type("2")
    assert operator.session.field == "y_end"


def test_enter_counts_after_any_other_key() -> None:
    assert square().press("ctrl+end", "right", "l", "tab", "enter").session.field == "z_end"
