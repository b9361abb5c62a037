"""The list of blocks, the tool table, PART SETUP and PROGRAM PARAMETERS, the look-ahead table and DRAW."""

from __future__ import annotations

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.screens.contour import Contour
from app.painted.screens.program import ProgramPage
from app.painted.session import Session
from core.program.edit import FormPlace
from core.program.fields import TOOL, read_typed
from core.program.model import CutterComp, Number, PathChoice, Tool, Unread
from core.units import Unit
from tests.app.operator import Operator


def opened(name: str = "pocket") -> Operator:
    return Operator(Desk(Session.of(load(example(name)))))


def at_list() -> Operator:
    return opened().press("f8")


def test_exit_goes_to_the_list_and_enter_back_into_the_block() -> None:
    operator = at_list()
    assert isinstance(operator.desk.page, ProgramPage)
    assert "MILL CONTOUR  LEFT" in operator.part("body")
    assert isinstance(operator.press("enter").desk.page, Contour)


@pytest.mark.parametrize("key", ["enter", "right"])
def test_a_block_is_entered_on_segment_wherever_it_was_left(key: str) -> None:
    operator = opened().press("up")
    assert operator.session.field == "lookahead"
    operator.press("f8", key).type("4")
    assert operator.block.lookahead is None
    assert operator.session.where == FormPlace(1, 4)
    operator.press("f8", key)
    assert (operator.session.where, operator.session.field) == (FormPlace(1, 4), "segment")


def test_blocks_are_inserted_copied_moved_and_deleted() -> None:
    operator = at_list().press("f2")
    assert operator.session.where == FormPlace(2, 0)
    operator.press("tab", "tab", "r", "f8")
    assert [block.cutter_comp for block in operator.session.program.blocks] == [CutterComp.LEFT, CutterComp.RIGHT]
    operator.press("f3")
    assert operator.session.where.block == 3
    operator.press("up", "up", "f7", "f2", "f7", "f7")
    assert [block.cutter_comp for block in operator.session.program.blocks] == [
        CutterComp.RIGHT,
        CutterComp.LEFT,
        CutterComp.RIGHT,
    ]
    assert operator.session.where.block == 2
    operator.press("f1")
    assert [block.cutter_comp for block in operator.session.program.blocks] == [CutterComp.RIGHT, CutterComp.RIGHT]
    assert operator.press(*["ctrl+z"] * 5).session.program == load(example("pocket"))


def test_the_only_block_stays() -> None:
    operator = at_list().press("f1")
    assert "only block" in operator.said
    assert len(operator.session.program.blocks) == 1


def test_many_blocks_scroll_with_the_cursor() -> None:
    operator = at_list().press(*["f3"] * 30)
    assert ">    31  MILL CONTOUR" in operator.part("body")
    assert len(operator.part("body").splitlines()) <= 9


def test_a_tool_is_added_edited_and_deleted() -> None:
    operator = opened().press("f6", "f2").type("3/8")
    assert operator.session.program.tools == (Tool(1, diameter=Number(0.5)), Tool(2, diameter=Number(0.375)))
    operator.press("up", "tab").press("delete").type("BALL")
    assert "BALL" in operator.part("body")
    operator.press("up")
    operator.press("f1")
    assert len(operator.session.program.tools) == 1


def test_a_tool_gets_another_number_and_the_cursor_follows_it() -> None:
    operator = opened().press("f6", "f2", "shift+tab", "shift+tab").type("12")
    assert [tool.number for tool in operator.session.program.tools] == [1, 12]
    operator.press("shift+tab").type("1")
    assert operator.said.startswith("!! There is a tool 1 already. Type another one.")


@pytest.mark.parametrize("text", ["0", "-1"])
def test_a_diameter_must_be_above_zero(text: str) -> None:
    operator = opened().press("f6", "tab", "tab").type(text)
    assert "above 0" in operator.said
    assert operator.session.program.tools[0].diameter == read_typed(text, TOOL[2], Unit.IN)
    assert "ERR" in operator.part("body")
    operator.press("escape")
    assert operator.session.program.tools[0].diameter == Number(0.5)


def test_an_unreadable_diameter_stays_visible() -> None:
    operator = opened().press("f6", "tab", "tab").type("1/")
    assert isinstance(operator.session.program.tools[0].diameter, Unread)
    assert "ERR" in operator.part("body")
    assert "cannot be read" in operator.said


def test_a_missing_tool_is_named() -> None:
    operator = opened().press("tab").type("7").press("up")
    assert operator.said.startswith("!! Tool 7 is not in the tool table")
    assert "(TOOL DIAMETER" in operator.part("body")


def test_parameters_show_defaults_until_they_are_typed() -> None:
    operator = opened().press("f4")
    assert "BLEND OFFSET   DEF  0.1250" in operator.part("body")
    operator.press("tab").type(".2")
    assert operator.session.program.parameters.blend_offset == Number(0.2)
    assert "BLEND OFFSET        0.2000" in operator.part("body")
    operator.press("up", "delete", "enter")
    assert operator.session.program.parameters.blend_offset is None
    operator.press("shift+tab", "shift+tab", "shift+tab", "shift+tab", "b")
    assert operator.session.program.parameters.path is PathChoice.BEST


def test_another_unit_is_asked_about_and_converts() -> None:
    operator = opened().press("f4", "m")
    assert operator.session.program.unit is Unit.IN
    assert "Convert every typed length" in operator.part("body")
    assert operator.press("escape").session.program.unit is Unit.IN
    assert operator.press("m", "c").session.program.unit is Unit.MM
    assert operator.block.x_start == Number(50.8)
    assert "Prog Units: MM" in operator.part("status")
    assert operator.press("ctrl+z").session.program.unit is Unit.IN


def test_part_setup_takes_a_name_and_numbers() -> None:
    operator = opened().press("f5").type("BRACKET 7?", "55", "2.5")
    setup = operator.session.program.setup
    assert (setup.name, setup.work_offset, setup.safe_z) == ("BRACKET 7?", Number(55.0), Number(2.5))
    assert "54 to 59" in operator.press("down").type("60").said


def test_the_draw_screen_says_where_the_cutter_is_on_a_deleted_segment_and_why_there_is_none() -> None:
    from core.pipeline.derive import derive

    operator = opened()
    operator.desk = operator.desk.knowing(derive(operator.session.program))
    operator.press("9", "enter", "f7")
    assert "Segment 9 is deleted: the cutter stands where the path passes it, 8 meeting 10." in operator.said
    assert "# deleted" in operator.said
    operator.press("p")
    assert "egment" not in operator.said
    operator.press("f8", "7", "enter", "tab", "backspace", "enter", "f7", "n", "n")
    assert "Segment 9 is not determined yet: no cutter is drawn." in operator.said


def test_the_draw_screen_zooms_pans_walks_and_fits() -> None:
    operator = opened().press("f7", "+", "+", "left", "up")
    assert operator.sketch.zoom == pytest.approx(1.5625)
    assert (operator.sketch.dx, operator.sketch.dy) == (-0.125, 0.125)
    operator.press("n", "n")
    assert operator.session.where.segment == 2
    operator.press("0", "p", "m")
    assert operator.sketch.zoom == 1.0
    assert operator.session.where.segment == 1
    assert operator.desk.mode == "block"
    assert isinstance(operator.press("escape").desk.page, Contour)


def test_zooming_keeps_the_middle_where_the_arrows_have_moved_it() -> None:
    operator = opened().press("f7", "right", "right", *["+"] * 8, *["-"] * 8)
    assert operator.sketch.dx == pytest.approx(0.25)
    assert operator.sketch.middle == pytest.approx(1.0)


def test_the_look_ahead_table_is_stepped_over_and_one_value_taken() -> None:
    operator = opened().press(*["tab"] * 11, "f4", "down", "right")
    assert "TAKE 19 AS USR" in " ".join(operator.part("softkeys").split())
    operator.press("left", "up", "enter")
    assert operator.block.lookahead == Number(8.0)
    assert isinstance(operator.desk.page, Contour)
    operator.press("f4", "f3")
    assert operator.block.lookahead is None


def test_help_tells_about_the_field_and_the_keys() -> None:
    operator = opened().press("tab", "tab", "tab", "tab", "?")
    assert "X START" in operator.part("body")
    assert "1 1/2" in operator.part("body")
    operator.press("pagedown")
    assert "Ctrl+Q" in operator.part("body")
    assert isinstance(operator.press("escape").desk.page, Contour)


@pytest.mark.parametrize("keys", [("f8",), ("f6",), ("f5",), ("f4",), ("f7",), ("f7", "f3"), ("f8", "f6"), ("?",)])
def test_every_screen_says_how_to_leave(keys: tuple[str, ...]) -> None:
    operator = opened().press(*keys)
    assert operator.part("prompt").strip()
    assert "F8" in operator.part("softkeys")


def test_a_pasted_text_accepts_nothing() -> None:
    operator = opened().press("tab", "tab", "tab", "tab")
    operator.desk = operator.desk.paste("3.5\n\x1b[31m4.5\n")
    assert operator.block.x_start == Number(2.0)
    assert operator.press("enter").block.x_start == Number(3.5)
