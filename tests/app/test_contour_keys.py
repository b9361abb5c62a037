"""Keys on the MILL CONTOUR form: undo, Escape, letters that spell a choice, a whole part keyed in."""

from __future__ import annotations

import pytest

from core.program.edit import FormPlace
from core.program.model import (
    ArcSegment,
    BlendSegment,
    CutterComp,
    Direction,
    Number,
)
from tests.app.operator import Operator
from tests.app.squares import look_ahead, square


def test_choices_step_and_letters_select() -> None:
    operator = square().press("tab", "tab", "right")
    assert operator.block.cutter_comp is CutterComp.PROFILE_LEFT
    assert operator.press("space", "space").block.cutter_comp is CutterComp.ON
    assert operator.press("p", "p").block.cutter_comp is CutterComp.PROFILE_RIGHT


def test_undo_and_redo_reach_over_everything_and_say_what() -> None:
    operator = square()
    before = operator.session.program
    operator.press("tab", "tab", "tab", "tab").type("5").press("ctrl+z")
    assert operator.session.program == before
    assert "X START of START" in operator.said
    operator.press("ctrl+y")
    assert operator.block.x_start == Number(5.0)


def test_undo_first_takes_back_what_is_half_typed() -> None:
    operator = square().press("tab", "tab", "tab", "tab", "7", "ctrl+z")
    assert operator.block.x_start == Number(-1.0)
    assert operator.session.program == square().session.program


def test_undo_of_a_new_segment_brings_the_cursor_to_one_that_exists() -> None:
    operator = square().press("ctrl+end", "right", "l", "ctrl+z")
    assert operator.session.where == FormPlace(1, 4)
    assert len(operator.segments) == 4


def test_escape_then_a_digit_is_a_softkey() -> None:
    operator = square().press("1", "enter", "escape", "1")
    assert len(operator.segments) == 3


def test_escape_that_takes_something_back_does_not_arm_the_digits() -> None:
    operator = square().press("1", "enter", "tab", "9", "escape", "1", "enter")
    assert operator.typed("x_end")[0] == Number(1.0)
    assert len(operator.segments) == 4


POCKET = (
    ("l", ("4.0", "0.25", "", "", "", "12")),
    ("a", ("ccw", "4.75", "1.0", "", "4.0", "1.0")),
    ("l", ("4.75", "3.5")),
    ("b", ("0.5",)),
    ("l", ("3.0", "3.5")),
    ("l", ("2.5", "3.0")),
    ("l", ("1.0", "3.0")),
    ("a", ("cw", "0.5", "3.5", "", "1.0", "3.5")),
    ("l", ("0.25", "3.5")),
    ("l", ("0.25", "0.25")),
    ("l", ("2.0", "0.25")),
)


def pocket() -> Operator:
    """The pocket outline with a boss, from the drawing."""
    operator = Operator.at().press("enter").type("1").press("l")
    operator.type("", "0", "2.0", "0.25", "0", "-0.25", "20", "300", "0.1").press("pagedown")
    for letter, texts in POCKET:
        operator.press(letter)
        for text in texts:
            if text == "ccw":
                operator.press("right", "enter")
            elif text == "cw":
                operator.press("enter")
            else:
                operator.type(text)
        operator.press("pagedown")
    return operator.press("escape", "ctrl+home")


def test_the_pocket_keyed_in_from_the_drawing() -> None:
    operator = pocket()
    found = operator.session.found
    assert len(operator.segments) == 11
    assert found.solved.closed
    assert found.solved.determined == 11
    assert look_ahead(operator) == "CAL 8"
    assert operator.segments[3] == BlendSegment(Number(0.5))
    assert operator.segments[1] == ArcSegment(
        Direction.CCW, Number(4.75), Number(1.0), None, Number(4.0), Number(1.0), None, None, None
    )


@pytest.mark.parametrize("before", ["space", "left", "escape"])
@pytest.mark.parametrize("word", ["on", "left", "right", "profile left", "PROFILE RIGHT"])
def test_a_choice_is_spelled_out(word: str, before: str) -> None:
    operator = Operator.at().press("enter", "tab", before)
    operator.press(*("space" if letter == " " else letter for letter in word))
    assert operator.block.cutter_comp == CutterComp(word.upper())


@pytest.mark.parametrize("word", ["cw", "ccw"])
@pytest.mark.parametrize("first", [(), ("space",)])
def test_a_direction_is_spelled_out(word: str, first: tuple[str, ...]) -> None:
    operator = square().press("ctrl+end", "pagedown", "a", *first, *word)
    segment = operator.block.segments[-1]
    assert isinstance(segment, ArcSegment)
    assert segment.direction == Direction(word.upper())


@pytest.mark.parametrize("key", ["q", "7"])
def test_a_letter_that_begins_no_choice_is_told_and_changes_nothing(key: str) -> None:
    operator = square().press("tab", "tab")
    held = operator.block
    operator.press(key)
    assert operator.block is held
    assert operator.said == (
        f"!! CUTTER COMP. has no choice with {key.upper()}: ON, LEFT, RIGHT, PROFILE LEFT, PROFILE RIGHT."
    )


def test_letters_are_forgotten_where_the_cursor_goes_elsewhere() -> None:
    operator = Operator.at().press("enter", "tab", "p", "tab", "shift+tab", "r")
    assert operator.block.cutter_comp == CutterComp.RIGHT


def test_enter_behind_the_letter_of_an_arc_takes_the_direction_that_is_shown() -> None:
    operator = square().press("ctrl+end", "pagedown", "a", "enter").type("4.75", "1.0")
    segment = operator.block.segments[-1]
    assert isinstance(segment, ArcSegment)
    assert (segment.direction, segment.x_end, segment.y_end) == (Direction.CW, Number(4.75), Number(1.0))


def test_enter_behind_the_letter_of_a_line_still_goes_nowhere() -> None:
    operator = square().press("ctrl+end", "pagedown", "l", "enter")
    assert "The cursor is still on X END" in operator.said
