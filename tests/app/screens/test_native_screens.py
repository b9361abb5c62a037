"""The screens beside MILL CONTOUR: keys in, session and files out."""

from __future__ import annotations

import gc
from dataclasses import replace
from weakref import ref

import pytest
from textual.widgets import DataTable, Input, OptionList, Static

from app.documents.files import load
from app.documents.programs import example
from app.screens.contour import ContourScreen
from app.screens.draw import DrawScreen
from app.screens.form_screen import FormScreen
from app.screens.help import HelpScreen
from app.screens.lookahead import LookaheadScreen
from app.screens.palette import NOTHING_FOUND
from app.screens.post import PostScreen
from app.screens.program import ProgramScreen
from app.screens.tools import ToolsScreen
from app.session.posting import nc_text
from app.widgets.drawing import Drawing
from core.program.model import Coolant, Number
from core.units import Unit
from tests.app.widget_pilot import Operator, operator


async def run(one: Operator, action: str) -> None:
    await one.app.run_action(action)
    await everything(one)


async def everything(one: Operator) -> None:
    """Wait for every worker, also those that draw and post."""
    for _ in range(3):
        await one.app.workers.wait_for_complete()
        await one.pilot.pause()


async def test_the_look_ahead_table_draws_the_row_with_the_cursor_and_enter_takes_it():
    async with operator() as one:
        await run(one, "app.lookahead")
        assert isinstance(one.app.screen, LookaheadScreen)
        table = one.screen.query_one(DataTable)
        assert (table.row_count, table.cursor_row) == (20, 1)
        assert table.virtual_size.width <= table.scrollable_content_region.width, "no column is cut off"
        await one.press("up")
        await everything(one)
        assert one.screen.query_one(Drawing).heading == "LOOK-AHEAD 1"
        await one.press("enter")
        assert one.session.block.lookahead == Number(1.0)
        assert (one.value("lookahead"), one.tag("lookahead")) == ("1", "USR")


async def test_draw_goes_from_finding_to_finding_and_back_to_the_form():
    async with operator() as one:
        await run(one, "app.draw")
        screen = one.app.screen
        assert isinstance(screen, DrawScreen)
        whole = screen.drawing.drawn.view
        await one.press("n")
        await everything(one)
        assert screen.drawing.drawn.view.scale < whole.scale
        assert "1/3" in screen.drawing.heading
        assert screen.entries[0].text == one.prompt
        await one.press("n", "p")
        assert "1/3" in screen.drawing.heading
        await one.press("0")
        await everything(one)
        assert screen.drawing.drawn.view == whole
        await one.press("f8")
        assert one.at == "segment"


async def test_another_unit_is_asked_about_and_converts_every_length():
    async with operator() as one:
        await run(one, "app.parameters")
        await one.press("right", "c")
        await everything(one)
        assert one.session.program.unit is Unit.MM
        assert one.session.block.x_start == Number(50.8)


async def test_another_unit_that_is_not_wanted_changes_nothing():
    async with operator() as one:
        await run(one, "app.parameters")
        await one.press("right", "escape")
        await everything(one)
        assert one.session.program.unit is Unit.IN
        assert one.value("unit") == "IN"


async def test_a_blank_parameter_shows_its_usual_value():
    async with operator() as one:
        await run(one, "app.parameters")
        assert (one.value("pocket_overlap"), one.tag("pocket_overlap")) == ("50.0", "DEF")


async def test_tools_are_added_typed_renumbered_and_deleted():
    async with operator() as one:
        await run(one, "app.tools")
        assert isinstance(one.app.screen, ToolsScreen)
        await one.press("f2")
        await everything(one)
        assert one.at == "diameter@1"
        await one.press("'.25", "enter")
        await everything(one)
        assert [tool.number for tool in one.session.program.tools] == [1, 2]
        assert one.session.program.tools[1].diameter == Number(0.25)
        assert one.at == "speed@1"
        assert "Not used by any block" in str(one.screen.query_one("#tool-use", Static).content)
        await one.press("f1")
        await everything(one)
        assert [tool.number for tool in one.session.program.tools] == [1]


async def test_speed_feeds_and_coolant_of_a_tool_are_proposals():
    async with operator() as one:
        await run(one, "app.tools")
        await one.press("tab", "tab", "tab", "'2400", "tab", "'12", "tab", "'5", "tab", "f")
        await everything(one)
        tool = one.session.program.tools[0]
        assert (tool.speed, tool.feed, tool.plunge_feed) == (Number(2400.0), Number(12.0), Number(5.0))
        assert tool.coolant is Coolant.FLOOD


async def test_a_number_that_another_tool_has_is_refused_and_stays_to_be_mended():
    async with operator() as one:
        await run(one, "app.tools")
        await one.press("f2", "shift+tab", "shift+tab", "'1", "enter")
        await everything(one)
        assert "exists already" in one.prompt
        assert [tool.number for tool in one.session.program.tools] == [1, 2]


async def test_posting_writes_the_text_that_was_shown(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator() as one:
        await run(one, "app.post")
        screen = one.app.screen
        assert isinstance(screen, PostScreen)
        assert screen.made.against == ()
        await one.press("enter")
        await everything(one)
        written = (tmp_path / "part.nc").read_text()
        assert written == nc_text(one.session.program, "part", "center path").text
        assert not isinstance(one.app.screen, PostScreen)


async def test_the_control_of_the_last_post_is_chosen_again(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator("plate-mm") as one:
        await run(one, "app.post")
        screen = one.app.screen
        assert isinstance(screen, PostScreen)
        assert screen.choice == "center path"
        await one.press("f2", "down")
        assert one.prompt == "Up and down choose the control. Enter goes back to the name."
        chosen = screen.choice
        await one.press("enter")
        await everything(one)
        assert "Enter posts" in one.prompt
        await one.press("enter")
        await everything(one)
        assert chosen in (tmp_path / "part.nc").read_text()
        await run(one, "app.post")
        again = one.app.screen
        assert isinstance(again, PostScreen)
        assert again.choice == chosen != "center path"
        assert again.query_one("#post-controls", OptionList).highlighted == 1


async def test_a_gouge_is_posted_only_after_the_phrase_that_says_so(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator("notch") as one:
        await run(one, "app.post")
        await one.press("enter", "'post", "enter")
        await everything(one)
        assert not list(tmp_path.iterdir())
        assert "NOT POSTED" in one.prompt
        await one.press("enter", *"post", "space", *"anyway", "enter")
        await everything(one)
        assert "OVERRIDDEN" in (tmp_path / "part.nc").read_text()


async def test_blocks_are_copied_moved_and_deleted_on_the_program_screen():
    async with operator() as one:
        await run(one, "app.program")
        assert isinstance(one.app.screen, ProgramScreen)
        await one.press("c")
        assert len(one.session.program.blocks) == 2
        assert one.session.place.block == 2
        await one.press("ctrl+up")
        assert one.session.place.block == 1
        await one.press("f1", "ctrl+z")
        assert len(one.session.program.blocks) == 2


async def test_help_tells_of_the_field_with_the_cursor():
    async with operator() as one:
        await one.press("tab", "question_mark")
        assert isinstance(one.app.screen, HelpScreen)
        assert "TOOL" in str(one.app.screen.query_one("#help-text").query_one(Static).content)
        await one.press("escape")
        assert one.at == "tool"


async def test_the_palette_presses_a_softkey_by_its_digit_and_finds_actions_by_name():
    async with operator() as one:
        await one.press("ctrl+k", "7")
        assert isinstance(one.app.screen, DrawScreen)
        await one.press("f8", "ctrl+k", *"lookahead", "space", *"table")
        await everything(one)
        await one.press("enter")
        await everything(one)
        assert isinstance(one.app.screen, LookaheadScreen)


async def test_the_palette_says_at_once_that_no_action_has_that_name():
    """A notice that came later, as Textual's own does, found its list gone where the palette had been left."""
    async with operator() as one:
        await one.press("ctrl+k", *"qqqq")
        listed = one.app.screen.query_one(OptionList)
        assert [str(option.prompt).splitlines()[0] for option in listed.options] == [NOTHING_FOUND]
        await one.press("enter")
        assert isinstance(one.app.screen, ContourScreen)
        assert one.prompt == NOTHING_FOUND


@pytest.mark.parametrize("screen", [DrawScreen, HelpScreen, LookaheadScreen, ToolsScreen, ProgramScreen])
async def test_a_screen_that_is_still_being_made_waits_with_what_has_changed(screen):
    async with operator() as one:
        opened = screen()
        pushed = one.app.push_screen(opened)
        changed = replace(one.session, title="changed")
        one.app.session = one.app.shown = changed
        one.app.show_work()
        await pushed
        await one.settle()
        assert opened.session is one.app.session
        assert one.session.title == "changed"


@pytest.mark.parametrize("size", [(60, 20), (100, 30), (132, 43), (200, 60)])
async def test_every_screen_opens_at_every_size(size):
    async with operator(size=size) as one:
        form = one.screen
        for name in ("draw", "lookahead", "tools", "parameters", "part_setup", "post", "program"):
            await run(one, f"app.{name}")
            assert one.screen is not form, name
            assert one.screen.query("#softkeys"), name
            await run(one, "app.contour")
            assert one.screen is form, name
        assert load(example("pocket")) == one.session.program


@pytest.mark.parametrize(("there", "back"), [("f6", "f8"), ("f7", "f8"), ("question_mark", "escape")])
async def test_screens_that_were_left_take_no_memory(there, back):
    async with operator() as one:
        left = []
        for _ in range(5):
            await one.press(there)
            left.append(ref(one.app.screen))
            await one.press(back)
        await one.press("down", "up")
        gc.collect()
        # Textual may hold the last one
        assert sum(screen() is not None for screen in left) <= 1


async def test_the_setup_sheet_is_shown_and_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator() as one:
        await run(one, "app.sheet")
        shown = str(one.screen.query_one("#sheet-text", Static).content)
        assert "POCKET" in shown
        await one.press("f3", "enter")
        await everything(one)
        assert (tmp_path / "part.txt").read_text().splitlines()[5:] == shown.splitlines()[5:]


async def test_a_tool_table_is_read_in_its_own_unit_and_asked_about(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tool.tbl").write_text("T7 P7 D6.35 ;slot drill\n")
    async with operator() as one:
        await run(one, "app.import_tools")
        await one.press("f2", "enter")
        assert one.app.screen.query("#question")
        await one.press("i")
        await everything(one)
        assert [tool.number for tool in one.session.program.tools] == [1, 7]
        assert one.session.program.tools[1].diameter == Number(0.25)


async def test_a_block_is_mirrored_from_the_palette_as_one_edit():
    async with operator() as one:
        before = one.session.program
        await one.press("ctrl+k", *"mirror", "space", *"block")
        await everything(one)
        await one.press("enter")
        await one.press("enter", "enter", "enter")
        await everything(one)
        assert one.session.block.cutter_comp == "RIGHT"
        assert one.session.block.x_start == Number(-2.0)
        await one.press("ctrl+z")
        assert one.session.program == before


async def test_a_number_that_cannot_be_read_keeps_the_small_form_open():
    async with operator() as one:
        await one.app.run_action("app.shift_block")
        await one.pilot.pause()
        await one.press(*"1a5", "enter")
        assert one.app.screen.query("#number-trouble")
        assert "type a number" in str(one.app.screen.query_one("#number-trouble", Static).content)
        await one.press("escape")
        assert one.session.history.undo_count == 0


async def test_numbers_that_do_not_go_together_keep_the_small_form_open():
    async with operator() as one:
        await one.app.run_action("app.repeat_shifted")
        await one.pilot.pause()
        for number in ("3", "2", "1", "0", "1"):
            await one.press("home", "delete", *number, "enter")
        trouble = one.app.screen.query_one("#number-trouble", Static)
        assert str(trouble.content) == "The last segment, 2, is before the first, 3."
        await one.press("up", "up", "up", "home", "delete", "3", *("enter",) * 4)
        await everything(one)
        assert isinstance(one.app.screen, FormScreen)
        assert one.session.history.undo_count == 1


async def test_a_new_segment_without_a_number_is_no_segment_to_repeat():
    async with operator() as one:
        await one.press("ctrl+end", "pagedown")
        count = len(one.session.block.segments) - 1
        await one.app.run_action("app.repeat_shifted")
        await one.pilot.pause()
        first = one.app.screen.query_one("#number-0", Input)
        assert first.value == str(count)
        await one.press("up", "escape")
        await one.app.run_action("app.shift_block")
        await one.pilot.pause()
        await one.press("1", "enter", "home", "delete", "0", "enter")
        await everything(one)
        assert isinstance(one.app.screen, FormScreen)
        assert len(one.session.block.segments) == count


async def test_what_was_undone_is_no_longer_told_after_the_next_edit():
    async with operator() as one:
        await one.press("f1", "ctrl+z")
        await one.press("pagedown", "f1", "ctrl+z")
        assert one.prompt.startswith("Undone: DELETE SEGMENT 1")
        await one.app.run_action("app.shift_block")
        await one.pilot.pause()
        await one.press("1", "enter", "home", "delete", "0", "enter")
        await everything(one)
        assert "Undone" not in one.prompt


async def test_a_tool_of_four_digits_is_shown_with_all_of_them():
    async with operator() as one:
        await run(one, "app.tools")
        await one.press(*"2000", "enter")
        field = one.screen.query_one(".tool-number NumberField, NumberField.tool-number")
        assert "2000" in "".join(segment.text for segment in field.render_line(0))


async def test_enter_in_draw_without_a_finding_in_hand_goes_to_the_form():
    async with operator() as one:
        await one.press("pagedown")
        await run(one, "app.draw")
        await one.press("enter")
        await everything(one)
        assert isinstance(one.app.screen, ContourScreen)
        assert one.session.place.segment == 1


async def test_space_lists_the_tools_the_choices_and_the_look_ahead_values():
    async with operator("flange") as one:
        await one.press("tab", "space", "down", "enter")
        await everything(one)
        assert one.session.block.tool == Number(2.0)
        assert one.at == "tool"
        await one.press("ctrl+z")
        form = one.app.screen
        assert isinstance(form, FormScreen)
        form.focus_field("lookahead")
        await one.press("space")
        await everything(one)
        assert isinstance(one.app.screen, LookaheadScreen)
        await one.press("f8")
        assert one.value("lookahead") != ""
        form.focus_field("cutter_comp")
        await one.press("space", "down", "enter")
        await everything(one)
        assert one.session.block.cutter_comp == "RIGHT"


@pytest.mark.parametrize(("key", "count"), [("delete", 10), ("insert", 12)])
async def test_del_and_ins_in_the_segment_list_are_delete_and_insert_segment(key, count):
    async with operator() as one:
        await one.press("f9", "down", "down", key)
        assert len(one.session.block.segments) == count


async def test_a_row_of_tool_setup_has_room_for_what_is_in_it():
    async with operator() as one:
        await run(one, "app.tools")
        await one.press(*"2000", "enter", "'BALL MILL", "enter")
        await everything(one)
        shown = {}
        for name in ("number", "type"):
            field = one.screen.query_one(f"NumberField.tool-{name}")
            shown[name] = "".join(segment.text for segment in field.render_line(0)).strip()
        assert shown == {"number": "2000", "type": "BALL MILL"}
