"""Wrong input stays to be corrected, missing input is asked for, and nothing is accepted unasked."""

from __future__ import annotations

import json
from asyncio import sleep
from dataclasses import replace

import pytest
from textual import events
from textual.widgets import Input, Static

from app.documents.files import load
from app.documents.programs import empty_program, example
from app.screens.contour import ContourScreen
from app.screens.dialogs import Question
from app.screens.tools import ToolRow, ToolsScreen
from app.widgets.field import NumberField
from core.program.file.read import loads
from core.program.model import CutterComp, Number
from core.units import Unit
from tests.app.widget_pilot import Operator
from tests.core.program.parts import arc
from tests.core.program.parts import program as arcs

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_a_number_out_of_range_stays_marked_as_an_error(user: Operator):
    await user.press(*["down"] * 9, "'-5", "enter")
    assert (user.at, user.value("speed"), user.tag("speed")) == ("speed", "-5", "ERR")
    assert user.prompt == "SPEED (RPM) must be a whole number from 1 to 100000, not -5."
    assert user.session.derived_block.errors
    await user.press("'2400", "enter")
    assert user.tag("speed") == ""


async def test_an_impossible_speed_stays_marked_on_tool_setup(user: Operator):
    await user.press("f6", "tab", "tab", "tab")
    assert user.at == "speed@0"
    for text in ("-5", "1x"):
        await user.press(f"'{text}", "enter")
        assert (user.at, user.app.focused.value) == ("speed@0", text)
        assert text in user.prompt
        await user.press("tab")
        speed = next(field for field in user.screen.query(NumberField) if field.name == "speed@0")
        assert speed.styles.color.hex == user.app.theme_variables["c-err"].upper()
        use = str(user.screen.query_one("#tool-use", Static).content)
        assert f"ERR tool 1 SPEED (RPM){' must be' if text == '-5' else ': 1x'}" in use
        await user.press("shift+tab")
    await user.press("'3000", "enter")
    assert user.session.program.tools[0].speed == Number(3000.0)


async def test_a_number_typed_as_a_tools_type_is_refused(user: Operator):
    await user.press("f6", "tab", "'.25", "enter")
    assert user.at == "type@0"
    assert user.prompt == (
        "TYPE takes a name such as END MILL, not a number such as .25. Esc brings END MILL back; DIAMETER is next."
    )
    assert user.session.program.tools[0].type == "END MILL"
    await user.press("escape", "'1/4 end mill", "enter")
    assert user.session.program.tools[0].type == "1/4 end mill"


async def test_a_calculation_that_ends_at_once_leaves_the_cursor_on_the_diameter_of_a_new_tool(user: Operator):
    await user.press("f6")
    assert isinstance(user.screen, ToolsScreen)
    user.screen.action_add_tool()
    while len(user.screen.query(ToolRow)) == 1:
        await sleep(0)
    user.screen.show_session(user.session)
    await user.settle()
    assert user.at == "diameter@1"
    assert user.prompt.startswith("Tool 2 added. Type its DIAMETER.")


async def test_a_mistyped_speed_of_tool_setup_is_named_on_start_and_stays_marked_while_another_tool_has_the_cursor(
    user: Operator,
):
    await user.press("f6", "tab", "tab", "tab", "'3o00", "enter", "f2")
    assert user.at == "diameter@1"
    assert "ERR tool 1 SPEED (RPM): 3o00 cannot be read." in str(user.screen.query_one("#tool-use", Static).content)
    await user.press("f8", *["down"] * 9, "delete", "enter")
    assert user.session.block.speed is None
    assert (user.at, user.value("speed")) == ("speed", "?")
    assert user.prompt == (
        "SPEED (RPM) of tool 1 on TOOL SETUP: 3o00 cannot be read. o is not a unit here: type a whole number."
    )


async def test_missing_values_are_asked_for_and_the_verdict_names_the_judged_segments(user: Operator):
    await user.press("'7", "enter", "tab", "delete", "down", "delete", "enter")
    assert user.session.block.segments[6].y_end is None
    title = str(user.screen.query_one("#verdict").border_title)
    assert "segments 1-6 only" in title
    chips = str(user.screen.query_one("#chips").render())
    assert "GOUGE" in chips
    await user.press("f10")
    assert isinstance(user.screen, ContourScreen)
    assert "Segments 7 and 8 need 1 more value: XY ANGLE of 7, or an end (X END or Y END)." in [
        entry.text for entry in user.screen.entries
    ]


DEPTHS = {
    "0": "▲ Z BOTTOM is at Z START: nothing is cut.",
    "2": "✖ Z BOTTOM 2.0000 is above Z START 0.0000.",
    "-2": " START is complete: Page Down for segment 1.",
}


async def test_a_new_start_without_depth_says_so_once_z_bottom_is_taken(user: Operator):
    program, zero = empty_program(), Number(0.0)
    block = replace(program.blocks[0], tool=Number(1.0), x_start=zero, y_start=zero, z_start=zero)
    block = replace(block, cutter_comp=CutterComp.LEFT, plunge_feed=Number(5.0), speed=Number(1000.0))
    for bottom, text in DEPTHS.items():
        await user.begin(replace(program, blocks=(block,)), 0, "z_bottom")
        await user.press(f"'{bottom}", "tab")
        assert str(user.screen.query_one("#chips").render()) == text


async def test_enter_stays_once_on_a_z_bottom_that_is_not_below_z_start(user: Operator):
    """Also where Z BOTTOM is the last value that START lacks."""
    program = load(example("pocket"))
    for z_bottom in (program.blocks[0].z_bottom, None):
        block = replace(program.blocks[0], z_bottom=z_bottom)
        await user.begin(replace(program, blocks=(block, *program.blocks[1:])), 0, "z_bottom")
        await user.press("'0", "enter")
        assert user.at == "z_bottom"
        assert user.prompt == "Z BOTTOM is at Z START: nothing is cut."
        await user.press("enter")
        assert user.at != "z_bottom"
        assert user.prompt != "Z BOTTOM is at Z START: nothing is cut."


async def test_enter_goes_from_a_new_z_start_to_a_z_bottom_above_it(user: Operator):
    """The next number typed is Z BOTTOM, which is to be corrected."""
    await user.begin("pocket", 0, "z_start")
    await user.press("'-1", "enter")
    assert user.at == "z_bottom"
    assert user.prompt == "Z BOTTOM -0.2500 is above Z START -1.0000: it must be below."
    await user.press("'-1.5", "enter")
    assert user.session.block.z_bottom == Number(-1.5)


async def test_enter_stays_on_a_last_segment_whose_numbers_contradict_each_other(user: Operator):
    """Circle of 10 about X 40 Y 25, typed with the START of another one."""
    circle = arc("CW", x_end=30, y_end=25, x_center=40, y_center=25)
    await user.begin(arcs(circle, x=30.0, y=20.0), 1, "radius")
    await user.press("enter")
    assert len(user.session.block.segments) == 1
    assert user.at == "x_center"
    assert user.prompt.startswith("The arc's radius is 11.180 at its start and 10.000 at its end")
    await user.press("pagedown")
    assert len(user.session.block.segments) == 2, "Page Down goes on"


async def test_the_only_block_cannot_be_deleted(user: Operator):
    await user.press("f8", "f1")
    assert len(user.session.program.blocks) == 1
    assert user.session.history.undo_count == 0


async def test_pasted_text_fills_no_field_and_presses_no_key(user: Operator):
    await user.press("tab", "tab", "tab", "tab")
    user.app.post_message(events.Paste("3.5\nf1\n7"))
    await user.settle()
    assert user.at == "x_start"
    assert user.session.history.undo_count == 0
    assert len(user.session.block.segments) == 11


async def test_the_cursor_can_leave_fields_whose_text_has_surrounding_blanks(user: Operator):
    for text in (" b ", "b\u2028", "\tb"):
        unread = f"[block.unread]\nfinish_tool = {json.dumps(text)}\nx_start = {json.dumps(text)}\n"
        head = 'format = 1\nunits = "IN"\n[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "ON"\n'
        await user.begin(loads(head + unread, "part"), 0, "finish_tool")
        await user.press("tab")
        assert user.at == "x_start", text
        await user.press("shift+tab")
        assert user.at == "finish_tool", text
        assert user.session.history.undo_count == 0


async def test_a_unit_is_typed_whole_and_enter_opens_its_question_once(user: Operator):
    await user.press("f4", "'mm")
    assert (user.at, user.value("unit"), user.session.program.unit) == ("unit", "MM", Unit.IN)
    assert user.prompt == "Enter converts every typed length and feed to MM."
    await user.press("enter")
    assert isinstance(user.app.screen, Question)
    await user.press("enter")
    assert (user.at, user.value("unit"), user.prompt) == ("unit", "IN", "UNITS stays IN.")
    await user.press("m", "escape")
    assert (user.at, user.value("unit"), user.prompt) == ("unit", "IN", "UNITS stays IN.")
    await user.press("m", "left")
    assert user.prompt.startswith("Unit of the program.")
    await user.press("'mm", "enter", "c")
    assert (user.at, user.value("unit"), user.session.program.unit) == ("unit", "MM", Unit.MM)
    await user.press("enter")
    assert user.at == "blend_offset"


async def test_a_unit_left_by_a_click_stays(user: Operator):
    await user.press("f4", "m")
    await user.pilot.click(user.row("finish_xy"), offset=(20, 0))
    await user.settle()
    assert (user.at, user.value("unit"), user.prompt) == ("finish_xy", "IN", "UNITS stays IN.")


async def test_a_tool_that_may_be_in_the_other_unit_is_a_warning_where_it_is_typed_and_called(user: Operator):
    await user.begin("pocket")
    await user.press("f6", "tab", "tab", *(f"'{sign}" for sign in "2400"), "enter")
    await user.finish()
    text = "Tool 1 is 2400.0000 across, more than any usual cutter. Is its unit right? The program is in INCH."
    assert f"WARNING: {text}" in str(user.screen.query_one("#tool-use", Static).content)
    await user.press("f8")
    await user.begin(user.session.program)
    await user.press("tab", "tab", "shift+tab")
    await user.finish()
    assert user.prompt == f"{text} F6 is TOOL SETUP."


async def test_escape_brings_a_changed_file_name_back_before_it_leaves(user: Operator):
    for action, name in (("app.post", "part.nc"), ("app.sheet", "part.html"), ("app.save_as", "part.toml")):
        before = user.screen
        await user.app.run_action(action)
        await user.settle()
        await user.press("'plate", "escape")
        entry = user.screen.query_one("#entry", Input)
        assert (entry.value, entry.selected_text) == (name, name)
        await user.press("escape")
        assert user.screen is before


async def test_escape_in_the_list_of_controls_leads_back_to_the_name(user: Operator):
    await user.app.run_action("app.post")
    await user.press("f2", "escape")
    assert user.app.focused is not None
    assert user.app.focused.id == "entry"
