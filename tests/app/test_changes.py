"""Undo and redo lead the cursor to what they change."""

from __future__ import annotations

from app.painted.session import SEGMENT
from app.session.changes import changed
from core.program.edit import FormPlace
from core.program.model import Number
from tests.app.operator import Operator
from tests.app.squares import square


def place(operator: Operator) -> tuple[FormPlace, str]:
    return operator.session.where, operator.session.field


def test_a_field_of_a_segment() -> None:
    operator = square().type("3").press("tab", "tab").type("2.5").press("ctrl+home", "ctrl+z")
    assert place(operator) == (FormPlace(1, 3), "y_end")
    assert operator.segments[2].y_end == Number(2.0)
    assert place(operator.press("ctrl+home", "ctrl+y")) == (FormPlace(1, 3), "y_end")


def test_a_field_of_start_and_a_choice() -> None:
    operator = square().press("tab", "tab", "l").press("ctrl+end", "ctrl+z")
    assert place(operator) == (FormPlace(1, 0), "cutter_comp")


def test_a_deleted_segment() -> None:
    operator = square().type("2").press("f1", "ctrl+home", "ctrl+z")
    assert place(operator) == (FormPlace(1, 2), SEGMENT)


def test_a_block_of_several() -> None:
    operator = square().press("f8", "f3", "f2", "tab").type("7").press("f8", "home", "ctrl+z")
    assert operator.session.where == FormPlace(3, 0)


def test_what_is_no_blocks_matter_leaves_the_cursor() -> None:
    operator = square().type("2").press("tab", "f5").type("plate").press("escape", "ctrl+z")
    assert place(operator) == (FormPlace(1, 2), "x_end")


def test_equal_programs_differ_nowhere() -> None:
    program = square().session.program
    assert changed(program, program) is None
