"""The MILL CONTOUR form, keyed as an operator keys it."""

from __future__ import annotations

import pytest

from app.painted.screens.new_segment import NewSegment
from app.painted.session import SEGMENT
from core.program.edit import FormPlace
from core.program.model import (
    ArcSegment,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    Unread,
)
from tests.app.operator import Operator
from tests.app.squares import look_ahead, square


def test_the_notes_own_screen() -> None:
    assert square().part("header") + "\n" + square().part("body") == "\n".join(
        (
            " BLOCK       1   MILL CONTOUR",
            " SEGMENT >   0   START                        new program*",
            "",
            " TOOL                     1  PLUNGE FEED             20.0",
            " CUTTER COMP.         RIGHT  SPEED (RPM)              300",
            " FINISH TOOL              0  PECK DEPTH            0.0000",
            " X START            -1.0000  CUTCOMP LOOKAHEAD CAL      2",
            " Y START             0.0000  (TOOL DIAMETER        0.5000)",
            " Z START             0.0000  (TYPE               END MILL)",
            " Z BOTTOM           -0.2500",
            "",
        )
    )


def to_look_ahead(operator: Operator) -> Operator:
    return operator.press(*["tab"] * 11)


def test_cal_2_usr_4_and_f3_back_to_cal_2() -> None:
    operator = to_look_ahead(square())
    assert look_ahead(operator) == "CAL 2"
    assert "Not recommended unless necessary" in operator.said
    assert look_ahead(operator.type("4")) == "USR 4"
    assert operator.block.lookahead == Number(4.0)
    assert look_ahead(operator.press("f3")) == "CAL 2"
    assert operator.block.lookahead is None


def test_f3_recalculates_from_any_field_of_start() -> None:
    operator = to_look_ahead(square()).type("4").press("up", "up", "f3")
    assert operator.block.lookahead is None
    assert "CAL 2" in operator.said


def test_usr_stays_through_edits_and_cal_follows_them() -> None:
    operator = square()
    assert look_ahead(operator) == "CAL 2"
    operator.press("ctrl+end", "right", "l").type("5", "5", "", "", "", "10").press("escape", "ctrl+end", "right")
    operator.press("l").type("6", "5", "", "", "", "10").press("escape", "ctrl+home")
    assert look_ahead(operator) == "CAL 3"
    assert look_ahead(to_look_ahead(operator).type("7")) == "USR 7"
    operator.press("ctrl+end", "f1", "ctrl+home")
    assert look_ahead(operator) == "USR 7"


@pytest.mark.parametrize("text", ["0", "21", "x", "2.5", "-3"])
def test_a_look_ahead_out_of_range_is_refused_and_the_old_one_stays(text: str) -> None:
    operator = to_look_ahead(square()).type("4").press("up").type(text)
    assert look_ahead(operator) == "USR 4"
    assert "from 1 to 20" in operator.said
    assert operator.session.field == "lookahead"


def test_comp_on_hides_the_field_and_keeps_its_value() -> None:
    operator = to_look_ahead(square()).type("4").press("ctrl+home", "tab", "tab", "o")
    assert operator.block.cutter_comp is CutterComp.ON
    assert "LOOKAHEAD" not in operator.part("body")
    assert look_ahead(operator.press("l")) == "USR 4"


def test_the_look_ahead_field_has_its_own_softkeys() -> None:
    operator = square()
    assert "DELETE SEGMENT" in operator.part("softkeys")
    assert "RECALCULATE" not in operator.part("softkeys")
    to_look_ahead(operator)
    assert "RECALCULATE" in operator.part("softkeys")
    assert "DELETE SEGMENT" not in operator.part("softkeys")
    assert "TOOL SETUP" not in operator.part("softkeys")


def test_digits_and_enter_go_to_a_segment() -> None:
    operator = square().press("3", "enter")
    assert operator.session.where == FormPlace(1, 3)
    assert operator.session.field == SEGMENT


def test_a_segment_that_does_not_exist_is_told() -> None:
    operator = square().press("9", "enter")
    assert operator.session.where == FormPlace(1, 0)
    assert operator.said == "!! There is no segment 9: the last one is 4. Right arrow past the last adds one."


def test_arrows_walk_and_the_last_one_offers_a_new_segment() -> None:
    operator = square().press("right", "right", "left")
    assert operator.session.where.segment == 1
    operator.press("right", "right", "right", "right")
    assert isinstance(operator.desk.page, NewSegment)
    assert "NEW" in operator.part("header")
    assert "LINE" in operator.part("softkeys")
    operator.press("escape")
    assert operator.session.where.segment == 4


def test_deleting_a_segment_joins_its_neighbors() -> None:
    operator = square().press("2", "enter", "f1")
    assert operator.typed("x_end") == [Number(2.0), Number(0.0), Number(0.0)]
    assert "(X START            2.0000)" in operator.part("body")


def test_start_cannot_be_deleted_and_nothing_goes_before_it() -> None:
    operator = square().press("f1")
    assert operator.said == "!! START cannot be deleted."
    assert operator.press("f2").said == "!! START comes first: nothing goes before it."
    assert len(operator.segments) == 4


def test_a_segment_is_inserted_before() -> None:
    operator = square().press("2", "enter", "f2", "a")
    assert isinstance(operator.segments[1], ArcSegment)
    assert operator.session.where.segment == 2
    assert operator.session.field == "direction"


@pytest.mark.parametrize(
    ("text", "value"),
    [("1 1/2", 1.5), ("2.5-.125", 2.375), ("25.4/2", 12.7), ("12.7mm", 0.5), (".5in", 0.5), ("-0", 0.0)],
)
def test_what_a_field_takes(text: str, value: float) -> None:
    operator = square().press("tab", "tab", "tab", "tab").type(text)
    assert operator.block.x_start == Number(value)


def test_unreadable_text_stays_in_the_field_marked_with_the_reason() -> None:
    operator = square().press("tab", "tab", "tab", "tab").type("1..5")
    assert isinstance(operator.block.x_start, Unread)
    assert operator.session.field == "x_start"
    assert operator.said.startswith("!! 1..5 is not a number")
    operator.press("enter")
    assert "X START     ERR       1..5" in operator.part("body")
    assert operator.session.field == "y_start"
    assert operator.press("up").said.startswith("!! 1..5 is not a number")


def test_escape_brings_the_old_value_back() -> None:
    operator = square().press("tab", "tab", "tab", "tab", "7", "7", "escape")
    assert operator.block.x_start == Number(-1.0)
    assert "X START            -1.0000" in operator.part("body")
    assert operator.session.history.undo_count == square().session.history.undo_count


def test_a_text_is_changed_in_the_middle() -> None:
    operator = square().press("tab", "tab", "tab", "tab", "home", "right", "delete", "3", "enter")
    assert operator.block.x_start == Number(-3.0)


def test_looking_at_a_rounded_number_does_not_round_it() -> None:
    operator = square().press("tab", "tab", "tab", "tab").type("1/3").press("up", "left", "right", "enter")
    assert operator.block.x_start == Number(1 / 3)


@pytest.mark.parametrize("key", ["delete", "backspace"])
def test_an_emptied_field_becomes_blank(key: str) -> None:
    operator = square().press("1", "enter", "tab", key, "enter")
    assert operator.segments[0] == LineSegment(None, Number(0.0), None, None, None, Number(10.0))


def test_a_calculated_value_is_tagged_and_follows_an_edit_upstream() -> None:
    operator = square().press("2", "enter")
    assert "XY LENGTH     CAL     2.0000" in operator.part("body")
    operator.press("1", "enter", "tab", "tab").type("1").press("ctrl+home", "2", "enter")
    assert "XY LENGTH     CAL     1.0000" in operator.part("body")
    assert operator.segments[1] == LineSegment(Number(2.0), Number(2.0), None, None, None, Number(10.0))


def test_a_segment_not_determined_marks_what_is_needed() -> None:
    operator = square().press("ctrl+end", "right", "l", "enter")
    assert "X END                    ?" in operator.part("body")
    assert "Y END                    ?" in operator.part("body")
    assert "Y END                    ?" not in operator.press("4", "enter").part("body")


def test_two_solutions_are_picked_by_softkey_or_field() -> None:
    operator = square().press("ctrl+end", "right", "a", "c")
    assert operator.block.segments[-1] == ArcSegment(Direction.CCW)
    operator.press("enter").type("1", "-1", "", "", "", "1")
    assert "SOLUTION                   ?" in operator.part("body")
    assert "SOLUTION 1" in operator.part("softkeys")
    operator.press("f2")
    assert operator.typed("choice")[-1] == 1
    assert "2 of 2" in operator.part("body")


def test_two_solutions_about_one_center_are_told_apart_by_their_ends() -> None:
    operator = square().press("ctrl+end", "right", "a", "c", "enter").type("", "0.5", "", "0.5", "0")
    labels = " ".join(operator.part("softkeys").replace("│", " ").split())
    ends = sorted(piece.end[0] / 25.4 for piece in operator.session.found.solved.segments[-1].choices)
    assert ends == pytest.approx([-0.5, 1.5])
    for number, piece in enumerate(operator.session.found.solved.segments[-1].choices, 1):
        assert f"SOLUTION {number} {piece.end[0] / 25.4:.4f} 0.5000" in labels
