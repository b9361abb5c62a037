"""A half-typed text never gets into another field than the one it was typed for."""

from __future__ import annotations

from app.painted.screens.contour import Contour
from core.program.edit import FormPlace, Refused, type_field
from core.program.model import CutterComp, Number
from tests.app.operator import Operator


def edited() -> Operator:
    """CUTTER COMP. changed, then Z BOTTOM; half a number stands in the feed."""
    operator = Operator.at().press("tab", "tab", "right", "tab", "tab", "tab", "tab", "tab").type("-.5")
    return operator.press("7", "7")


def test_undo_behind_the_help_forgets_the_half_typed_text() -> None:
    operator = edited()
    assert operator.session.field == "plunge_feed"
    operator.press("ctrl+g", "ctrl+z", "ctrl+z", "escape")
    assert operator.session.field == "cutter_comp"
    operator.press("tab", "shift+tab", "tab", "tab")
    assert operator.block.cutter_comp is CutterComp.ON
    assert operator.block.finish_tool == Number(0.0)
    assert "77" not in "\n".join(operator.screen())


def test_redo_behind_the_help_forgets_it_too() -> None:
    operator = edited().press("escape", "ctrl+z", "up", "9", "ctrl+g", "ctrl+y", "escape")
    assert isinstance(operator.desk.page, Contour)
    assert operator.desk.page.editing is None
    assert operator.block.z_bottom == Number(-0.5)


def test_a_tool_that_is_undone_leaves_no_text_to_another() -> None:
    operator = Operator.at().press("f6", "f2", "tab", "9", "ctrl+g", "ctrl+z", "escape", "enter")
    assert [tool.diameter for tool in operator.session.program.tools] == [Number(0.5)]


def test_undo_on_the_form_takes_back_the_half_typed_text_first() -> None:
    operator = edited().press("ctrl+z")
    assert operator.session.field == "plunge_feed"
    assert operator.block.z_bottom == Number(-0.5)
    assert operator.said == "What was half typed is gone. Ctrl+Z again undoes a change."
    assert operator.press("ctrl+z").said.startswith("Undone:")


def test_a_choice_takes_no_number_and_no_blank() -> None:
    program = Operator.at().session.program
    for typed in (None, Number(1.0)):
        refused = type_field(program, FormPlace(1, 0), "cutter_comp", typed)
        assert isinstance(refused, Refused)
        assert "ON" in refused.text
