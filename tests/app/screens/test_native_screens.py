"""The screens other than MILL CONTOUR: keys in, session and files out."""

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
from app.screens.home import HomeScreen
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
from tests.core.program.parts import line, program
from tests.core.program.run_files import program_of

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def run(user: Operator, action: str) -> None:
    await user.app.run_action(action)
    await user.finish()


async def test_the_look_ahead_table_draws_the_cursor_row_and_enter_takes_it(user: Operator):
    await run(user, "app.lookahead")
    assert isinstance(user.app.screen, LookaheadScreen)
    table = user.screen.query_one(DataTable)
    assert (table.row_count, table.cursor_row) == (20, 1)
    assert "TAKE 2 AS USR" in str(user.screen.query_one("#f1", Static).content)
    assert table.virtual_size.width <= table.scrollable_content_region.width, "no column is cut off"
    await user.press("up")
    await user.finish()
    assert user.screen.query_one(Drawing).heading == "LOOK-AHEAD 1"
    await user.press("enter")
    assert user.session.block.lookahead == Number(1.0)
    assert (user.value("lookahead"), user.tag("lookahead")) == ("1", "USR")


async def test_the_best_look_ahead_is_marked_in_full_while_it_is_in_force(user: Operator):
    await user.press(*["tab"] * 11, "'2", "enter")
    await run(user, "app.lookahead")
    table = user.screen.query_one(DataTable)
    assert table.get_row_at(1)[4].plain == "best in force"
    assert all(
        cell.cell_length <= column.width
        for cell, column in zip(table.get_row_at(1), table.columns.values(), strict=True)
    )
    assert table.virtual_size.width <= table.scrollable_content_region.width, "no column is cut off"


async def test_draw_steps_through_the_findings_and_returns_to_the_form(user: Operator):
    await run(user, "app.draw")
    screen = user.app.screen
    assert isinstance(screen, DrawScreen)
    whole = screen.drawing.drawn.view
    await user.press("n")
    await user.finish()
    assert screen.drawing.drawn.view.scale < whole.scale
    assert "1/3" in screen.drawing.heading
    assert screen.entries[0].text == user.prompt
    await user.press("n", "p")
    assert "1/3" in screen.drawing.heading
    await user.press("0")
    await user.finish()
    assert screen.drawing.drawn.view == whole
    await user.press("f8")
    assert user.at == "segment"
    await user.press("pagedown")
    await run(user, "app.draw")
    await user.press("enter")
    await user.finish()
    assert isinstance(user.app.screen, ContourScreen), "Enter without a chosen finding returns to the form"
    assert user.session.place.segment == 1


async def test_changing_the_unit_asks_first_and_converts_the_lengths(user: Operator):
    await run(user, "app.parameters")
    assert (user.value("pocket_overlap"), user.tag("pocket_overlap")) == ("50.0", "DEF"), "a blank parameter"
    await user.press("right", "escape")
    await user.finish()
    assert (user.session.program.unit, user.value("unit")) == (Unit.IN, "IN"), "refused"
    await user.press("right", "enter", "c")
    await user.finish()
    assert user.session.program.unit is Unit.MM
    assert user.session.block.x_start == Number(50.8)


async def test_tools_are_added_typed_renumbered_and_deleted(user: Operator):
    await run(user, "app.tools")
    assert isinstance(user.app.screen, ToolsScreen)
    await user.press("f2")
    await user.finish()
    assert user.at == "diameter@1"
    await user.press("'.25", "enter")
    await user.finish()
    assert [tool.number for tool in user.session.program.tools] == [1, 2]
    assert user.session.program.tools[1].diameter == Number(0.25)
    assert user.at == "speed@1"
    assert "Not used by any block" in str(user.screen.query_one("#tool-use", Static).content)
    await user.press("f1")
    await user.finish()
    assert [tool.number for tool in user.session.program.tools] == [1]


async def test_the_cursor_follows_a_tool_whose_new_number_moves_it(user: Operator):
    await run(user, "app.tools")
    await user.press("f2", "'.25", "enter", "f2", "'.125", "enter")
    await user.finish()
    before = user.session.program
    for key, row in (("enter", 2), ("tab", 2), ("up", 1)):
        assert isinstance(user.app.screen, ToolsScreen)
        user.app.screen.focus_field("number@0")
        await user.press("'9", key)
        await user.finish()
        assert [tool.number for tool in user.session.program.tools] == [2, 3, 9], key
        assert user.at.partition("@")[2] == str(row), key
        await user.press("ctrl+z")
        assert user.session.program == before, key


async def test_speed_feeds_and_coolant_of_a_tool_can_be_typed(user: Operator):
    await run(user, "app.tools")
    await user.send("tab", "tab", "tab", "'2400", "tab", "'12", "tab", "'5", "tab", "f")
    await user.finish()
    tool = user.session.program.tools[0]
    assert (tool.speed, tool.feed, tool.plunge_feed) == (Number(2400.0), Number(12.0), Number(5.0))
    assert tool.coolant is Coolant.FLOOD


async def test_a_tool_number_in_use_is_refused_and_one_of_four_digits_is_shown_in_full(user: Operator):
    await run(user, "app.tools")
    await user.press("f2", "shift+tab", "shift+tab", "'1", "enter")
    await user.finish()
    assert "exists already" in user.prompt
    assert [tool.number for tool in user.session.program.tools] == [1, 2]
    await user.press("ctrl+z", "up")
    assert isinstance(user.app.screen, ToolsScreen)
    user.app.screen.focus_field("number@0")
    await user.press("'2000", "enter", "'BALL MILL", "enter")
    await user.finish()
    shown = {}
    for name in ("number", "type"):
        field = user.screen.query_one(f"NumberField.tool-{name}")
        shown[name] = "".join(segment.text for segment in field.render_line(0)).strip()
    assert shown == {"number": "2000", "type": "BALL MILL"}


async def test_posting_writes_the_text_that_was_shown(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator() as user:
        await run(user, "app.post")
        screen = user.app.screen
        assert isinstance(screen, PostScreen)
        assert screen.made.against == ()
        await user.press("enter")
        await user.finish()
        written = (tmp_path / "part.nc").read_text()
        assert written == nc_text(user.session.program, "part", "center path").text
        assert not isinstance(user.app.screen, PostScreen)


async def test_klartext_is_posted_to_a_file_that_the_control_lists(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator("plate-mm") as user:
        await run(user, "app.post")
        await user.press("f2", *"hei", "enter")
        await user.finish()
        entry = user.screen.query_one("#entry", Input)
        assert entry.value == "part.h"
        await user.press("f1")
        await user.finish()
        assert (tmp_path / "part.h").read_text().startswith("0 BEGIN PGM part MM")
        await run(user, "app.post")
        entry = user.screen.query_one("#entry", Input)
        assert entry.value == "part.h"
        await user.press("'plate", "f2", "home", "enter")
        await user.finish()
        await user.press("f1")
        await user.finish()
        assert (tmp_path / "plate.nc").exists()
        await run(user, "app.post")
        entry = user.screen.query_one("#entry", Input)
        await user.press("'plate.tap", "f2", *"hei", "enter")
        assert entry.value == "plate.tap", "another suffix that was typed stays"


async def test_post_preselects_the_control_of_the_last_post(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator("plate-mm") as user:
        await run(user, "app.post")
        screen = user.app.screen
        assert isinstance(screen, PostScreen)
        assert screen.choice == "center path"
        await user.press("f2", "down")
        assert user.prompt.startswith(
            "fanuc:a, type A, corners by lines; 0i, 16-21, 30i-32i. Up, down or letters choose"
        )
        chosen = screen.choice
        await user.press("enter")
        await user.finish()
        assert "Enter posts" in user.prompt
        await user.press("enter")
        await user.finish()
        assert chosen in (tmp_path / "part.nc").read_text()
        await run(user, "app.post")
        again = user.app.screen
        assert isinstance(again, PostScreen)
        assert again.choice == chosen != "center path"
        assert again.query_one("#post-controls", OptionList).highlighted == 1


async def test_a_gouge_is_posted_only_after_the_override_phrase(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator("notch") as user:
        await run(user, "app.post")
        await user.press("enter", "'post", "enter")
        await user.finish()
        assert not list(tmp_path.iterdir())
        assert "NOT POSTED" in user.prompt
        await user.press("enter", *"post", "space", *"anyway", "enter")
        await user.finish()
        assert "OVERRIDDEN" in (tmp_path / "part.nc").read_text()


async def test_letters_that_begin_no_control_are_said_to_on_post(user: Operator):
    await run(user, "app.post")
    await user.press("f2", "q")
    assert user.prompt.startswith("No control begins with Q.")
    await user.press("h")
    await user.finish()
    assert user.prompt.startswith("haas:a, ")


async def test_more_findings_than_have_room_are_reached_by_page_down(user: Operator):
    """Eight blocks without a speed or a depth: 16 reasons, of which the area on 24 rows shows less than half."""
    blank = program(line(x_end=50.0, y_end=0.0), start={"speed": None, "z_bottom": None})
    await user.begin(replace(blank, blocks=blank.blocks * 8))
    await run(user, "app.post")
    await user.finish()
    screen = user.app.screen
    assert isinstance(screen, PostScreen)
    assert user.prompt.endswith("must be corrected. Page Down: more findings.")
    reasons = screen.query_one("#post-reasons")
    assert reasons.vertical_scrollbar.display
    await user.press("pagedown", "pagedown", "pagedown")
    assert reasons.scroll_y == reasons.max_scroll_y > 0
    await user.press("pageup", "pageup", "pageup")
    assert reasons.scroll_y == 0
    await user.begin(replace(blank, blocks=blank.blocks))
    await run(user, "app.post")
    await user.finish()
    assert user.prompt.endswith("must be corrected.")


async def test_a_reason_too_long_for_the_prompt_is_pointed_to(user: Operator):
    """The prompt has two lines; the findings above it hold the whole sentence."""
    climbing = program(line(x_end=50.0, y_end=0.0, z_end=-0.125, feed=90.0))
    await user.begin(climbing)
    await run(user, "app.post")
    await user.press("f2", "down", "enter")
    await user.finish()
    await user.press("enter")
    await user.finish()
    assert user.prompt == "NOT POSTED: the reason stands above, at the first ✖. F10 goes to block 1."
    screen = user.app.screen
    assert isinstance(screen, PostScreen)
    assert "choose CUTTER COMP. ON." in " ".join(str(screen.query_one("#post-findings", Static).content).split())
    # a short reason is in the prompt itself
    await user.begin(program(line(x_end=50.0, y_end=0.0), start={"speed": None}))
    await run(user, "app.post")
    await user.press("enter")
    await user.finish()
    assert user.prompt == "NOT POSTED: Block 1, START: SPEED (RPM) is blank: enter it on START."


@pytest.mark.parametrize("key", ["f10", "ctrl+n"])
async def test_the_findings_keys_on_post_go_to_the_block_that_stops_it(user: Operator, key: str):
    part = program(line(x_end=50.0, y_end=0.0, feed=90.0))
    unfinished = replace(part.blocks[0], segments=(line(length=10.0),))
    await user.begin(replace(part, blocks=(*part.blocks, unfinished)))
    await run(user, "app.post")
    await user.press(key)
    await user.finish()
    assert isinstance(user.app.screen, ContourScreen)
    assert user.session.place.block == 2
    assert user.app.screen.query_one("#findings").has_focus == (key == "f10")


async def test_blocks_are_copied_moved_and_deleted_on_the_program_screen(user: Operator):
    await run(user, "app.program")
    assert isinstance(user.app.screen, ProgramScreen)
    await user.press("c")
    assert len(user.session.program.blocks) == 2
    assert user.session.place.block == 2
    await user.press("ctrl+up")
    assert user.session.place.block == 1
    await user.press("f1", "ctrl+z")
    assert len(user.session.program.blocks) == 2


@pytest.mark.parametrize(("answer", "speed"), [(0, 99.0), (1, 77.0)])
async def test_the_values_of_a_block_go_into_the_others(user: Operator, answer: int, speed: float):
    part = user.session.program
    source = replace(part.blocks[0], speed=Number(99.0))
    other = replace(part.blocks[0], speed=Number(77.0), z_bottom=None)
    await user.begin(replace(part, blocks=(source, other)))
    await run(user, "app.program")
    await user.app.run_action("screen.share_values")
    await user.press("home", *["down"] * answer, "enter")
    await user.finish()
    second = user.session.program.blocks[1]
    assert (second.speed, second.z_bottom) == (Number(speed), source.z_bottom)
    assert any("have the values of block 1 now." in message.message for message in user.app._notifications)


async def test_help_explains_the_field_with_the_cursor(user: Operator):
    await user.press("tab", "question_mark")
    assert isinstance(user.app.screen, HelpScreen)
    assert "TOOL" in str(user.app.screen.query_one("#help-text").query_one(Static).content)
    await user.press("escape")
    assert user.at == "tool"


async def test_the_palette_presses_a_softkey_by_its_digit_and_finds_actions_by_name(user: Operator):
    await user.press("ctrl+k", "7")
    assert isinstance(user.app.screen, DrawScreen)
    await user.press("f8", "ctrl+k", *"lookahead")
    await user.finish()
    options = user.app.screen.query_one(OptionList).options
    assert [str(option.prompt).splitlines()[0] for option in options[:2]] == [
        "LOOKAHEAD TABLE",
        "RECALCULATE LOOKAHEAD",
    ]
    await user.press("enter")
    await user.finish()
    assert isinstance(user.app.screen, LookaheadScreen)


async def test_a_number_with_a_leading_zero_in_the_palette_goes_to_its_segment(user: Operator):
    await user.press("ctrl+k", "0", "2")
    await user.finish()
    await user.press("enter")
    await user.finish()
    assert isinstance(user.app.screen, ContourScreen)
    assert user.session.place.segment == 2


async def test_the_palette_says_at_once_that_no_action_has_that_name(user: Operator):
    """A delayed notice, such as Textual's, finds its list gone when the palette has been closed."""
    await user.press("ctrl+k", *"qqqq")
    options = user.app.screen.query_one(OptionList)
    assert [str(option.prompt).splitlines()[0] for option in options.options] == [NOTHING_FOUND]
    await user.press("enter")
    assert isinstance(user.app.screen, ContourScreen)
    assert user.prompt == NOTHING_FOUND
    await user.press("ctrl+k", "escape")
    assert user.prompt != NOTHING_FOUND


OTHER_WORDS = {
    "transform": {"SHIFT BLOCK", "ROTATE BLOCK", "MIRROR BLOCK"},
    "flip block": {"MIRROR BLOCK"},
    "dxf": {"IMPORT DRAWING"},
    "exit": {"QUIT"},
    "copy": {"REPEAT SEGMENTS, SHIFTED", "REPEAT SEGMENTS, ROTATED"},
}


async def test_the_palette_finds_actions_by_other_words_of_the_shop(user: Operator):
    for word, actions in OTHER_WORDS.items():
        await user.send("ctrl+k", f"'{word}")
        await user.finish()
        options = user.app.screen.query_one(OptionList).options
        assert actions <= {str(option.prompt).splitlines()[0] for option in options}, word
        await user.press("escape")


async def test_a_screen_being_composed_shows_the_latest_session_once_ready(user: Operator):
    for screen in (DrawScreen, HelpScreen, LookaheadScreen, ToolsScreen, ProgramScreen):
        new_screen = screen()
        pushed = user.app.push_screen(new_screen)
        changed = replace(user.session, title=screen.__name__)
        user.app.session = user.app.displayed = changed
        user.app.show_work()
        await pushed
        await user.settle()
        assert new_screen.session is user.app.session, screen
        assert user.session.title == screen.__name__
        user.app.pop_screen()
        await user.settle()


async def test_every_screen_opens_at_every_size():
    """Those of 80x24 and 132x43 are in pictures."""
    async with operator(size=(60, 20)) as user:
        form = user.screen
        for size in ((60, 20), (100, 30), (200, 60)):
            await user.pilot.resize_terminal(*size)
            for name in ("draw", "lookahead", "tools", "parameters", "part_setup", "post", "program"):
                await run(user, f"app.{name}")
                assert user.screen is not form, (name, size)
                assert user.screen.query("#softkeys"), (name, size)
                await run(user, "app.contour")
                assert user.screen is form, (name, size)
        assert load(example("pocket")) == user.session.program


async def test_closed_screens_are_freed(user: Operator, monkeypatch):
    # the timer that paints a screen holds it until its period ends
    monkeypatch.setattr("textual.screen.UPDATE_PERIOD", 0.01)
    opened = []
    for open_key, close_key in (("f6", "f8"), ("f7", "f8"), ("question_mark", "escape")):
        for _ in range(3):
            await user.press(open_key)
            opened.append((open_key, ref(user.app.screen)))
            await user.press(close_key)
        await user.press("down", "up")
    gc.collect()
    held = [open_key for open_key, screen in opened if screen() is not None]
    assert len(held) == len(set(held)), "Textual may hold the last one of each"


async def test_the_setup_sheet_is_shown_and_written(user: Operator, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    await run(user, "app.sheet")
    shown = str(user.screen.query_one("#sheet-text", Static).content)
    assert "POCKET" in shown
    await user.press("f3", "enter")
    await user.finish()
    assert (tmp_path / "part.txt").read_text().splitlines()[5:] == shown.splitlines()[5:]


async def test_importing_a_tool_table_asks_for_its_unit(user: Operator, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tool.tbl").write_text("T7 P7 D6.35 ;slot drill\n")
    await run(user, "app.import_tools")
    await user.press("f2", "enter")
    assert user.app.screen.query("#question")
    await user.press("i")
    await user.finish()
    assert [tool.number for tool in user.session.program.tools] == [1, 7]
    assert user.session.program.tools[1].diameter == Number(0.25)


async def test_the_palette_mirrors_a_block_in_one_edit(user: Operator):
    before = user.session.program
    await user.press("ctrl+k", *"mirror", "space", *"block")
    await user.finish()
    await user.press("enter")
    await user.press("enter", "enter", "enter")
    await user.finish()
    assert user.session.block.cutter_comp == "RIGHT"
    done = "MIRROR BLOCK 1 is done. CUTTER COMP. is RIGHT now. Ctrl+Z undoes it."
    assert done in [message.message for message in user.app._notifications]
    assert user.session.block.x_start == Number(-2.0)
    await user.press("ctrl+z")
    assert user.session.program == before


async def test_the_palette_names_segments_whose_data_do_not_turn_with_the_block():
    kept, lost = {"angle": 30, "length": 50}, {"angle": 30, "x_end": 50}
    for segment, said in ((lost, " Typed points replace the data of segments 1."), (kept, "")):
        part = {"start": [0, 0], "segments": [{"kind": "LINE", **segment}]}
        async with operator(program_of(part)) as user:
            await user.app.run_action("app.rotate_block")
            await user.settle()
            await user.press("enter", "enter", *"10", "enter")
            await user.finish()
            done = f"ROTATE BLOCK 1 is done.{said} Ctrl+Z undoes it."
            assert done in [message.message for message in user.app._notifications]


async def test_tool_setup_names_all_blocks_that_use_a_tool(user: Operator):
    await user.press("f8", "f2", "f6")
    assert str(user.screen.query_one("#tool-use", Static).content) == "TOOL 1\nTOOL of blocks 1, 2"


async def test_tool_setup_draws_a_block_that_uses_the_tool_where_there_is_room():
    async with operator("flange", size=(132, 43)) as user:
        await run(user, "app.tools")
        drawing = user.screen.query_one("#tool-drawing", Drawing)
        assert (drawing.heading, drawing.drawn is None) == ("BLOCK 1", False)
        await user.press("down")
        await user.finish()
        assert drawing.heading == "BLOCK 2"
        await user.press("f2")
        await user.finish()
        assert (drawing.heading, drawing.drawn) == ("DRAWING", None), "a new tool is not used"


async def test_unreadable_and_inconsistent_numbers_keep_the_small_form_open(user: Operator):
    await user.app.run_action("app.shift_block")
    await user.settle()
    await user.press(*"1a5", "enter")
    assert user.app.screen.query("#number-trouble")
    assert "type a number" in str(user.app.screen.query_one("#number-trouble", Static).content)
    await user.press("home", *("delete",) * 4, "1", "enter")
    assert str(user.app.screen.query_one("#number-trouble", Static).content) == ""
    await user.press("escape")
    assert user.session.history.undo_count == 0

    await user.app.run_action("app.repeat_shifted")
    await user.settle()
    for number in ("3", "2", "1", "0", "1"):
        await user.send("home", "delete", *number, "enter")
    await user.settle()
    trouble = user.app.screen.query_one("#number-trouble", Static)
    assert str(trouble.content) == "The last segment, 2, is before the first, 3."
    await user.press("up", "up", "up", "home", "delete", "3", *("enter",) * 4)
    await user.finish()
    assert isinstance(user.app.screen, FormScreen)
    assert user.session.history.undo_count == 1


async def test_repeat_does_not_offer_a_new_empty_segment(user: Operator):
    await user.press("ctrl+end", "pagedown")
    count = len(user.session.block.segments) - 1
    await user.app.run_action("app.repeat_shifted")
    await user.settle()
    first = user.app.screen.query_one("#number-0", Input)
    assert first.value == str(count)
    await user.press("up", "escape")
    await user.app.run_action("app.shift_block")
    await user.settle()
    await user.press("1", "enter", "home", "delete", "0", "enter")
    await user.finish()
    assert isinstance(user.app.screen, FormScreen)
    assert len(user.session.block.segments) == count


async def test_the_undo_message_disappears_after_the_next_edit(user: Operator):
    await user.press("f1", "ctrl+z")
    await user.press("pagedown", "f1", "ctrl+z")
    assert user.prompt.startswith("Undone: DELETE SEGMENT 1")
    await user.app.run_action("app.shift_block")
    await user.settle()
    await user.press("1", "enter", "home", "delete", "0", "enter")
    await user.finish()
    assert "Undone" not in user.prompt


async def test_space_lists_tools_choices_and_look_ahead_values(user: Operator):
    await user.begin("flange")
    await user.press("tab", "space", "down", "enter")
    await user.finish()
    assert user.session.block.tool == Number(2.0)
    assert user.at == "tool"
    await user.press("ctrl+z")
    form = user.app.screen
    assert isinstance(form, FormScreen)
    form.focus_field("lookahead")
    await user.press("space")
    await user.finish()
    assert isinstance(user.app.screen, LookaheadScreen)
    await user.press("f8")
    assert user.value("lookahead") != ""
    form.focus_field("cutter_comp")
    await user.press("space", "down", "enter")
    await user.finish()
    assert user.session.block.cutter_comp == "RIGHT"


async def test_del_and_ins_delete_and_insert_segments_in_the_list(user: Operator):
    await user.press("f9", "down", "down", "delete")
    assert len(user.session.block.segments) == 10
    await user.press("f9", "ctrl+z", "f9", "insert")
    assert len(user.session.block.segments) == 12


async def test_a_block_deleted_by_a_second_press_of_a_softkey_is_reported_and_restored(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    async with operator("pocket") as user:
        await user.press("f8", "c")
        user.app.action_post()
        await user.settle()
        await user.press("f1")
        await user.finish()
        await user.press("f1")
        assert len(user.session.program.blocks) == 1
        assert "Deleted block 2. Ctrl+Z brings it back." in [each.message for each in user.app._notifications]
        await user.press("f1")
        assert user.prompt.startswith("The only block cannot be deleted")
        await user.press("ctrl+z")
        assert len(user.session.program.blocks) == 2


async def test_undo_puts_the_cursor_on_the_tool_that_comes_back(user: Operator):
    await user.begin("plate-mm")
    user.app.action_tools()
    await user.settle()
    await user.press("down")
    tools = user.screen
    assert isinstance(tools, ToolsScreen)
    assert tools.tool is not None
    number = tools.tool.number
    await user.press("f1")
    await user.settle()
    assert number not in [tool.number for tool in user.session.program.tools]
    await user.press("ctrl+z")
    await user.settle()
    assert tools.tool.number == number


async def test_next_finding_on_draw_goes_through_those_without_a_place_too(user: Operator):
    part = load(example("notch"))
    # an allowance without a finish tool is a warning on START
    await user.begin(replace(part, parameters=replace(part.parameters, finish_xy=Number(0.02))))
    user.app.action_draw()
    await user.settle()
    draw = user.screen
    assert isinstance(draw, DrawScreen)
    entries = draw.entries
    assert any(entry.at is None for entry in entries)
    seen = []
    for _ in entries:
        await user.press("n")
        seen.append(draw.at)
    assert seen == list(range(len(entries)))


async def test_home_opens_with_the_cursor_on_the_open_file(user: Operator, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a", "b", "c"):
        user.app.save_as(name)
        await user.finish()
    await run(user, "app.home")
    assert isinstance(user.app.screen, HomeScreen)
    assert user.app.screen.chosen.path == tmp_path / "c.toml"
