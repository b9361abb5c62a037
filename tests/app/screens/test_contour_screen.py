"""MILL CONTOUR for the operator: fields, moving between segments, undo, softkeys."""

from __future__ import annotations

import re
from dataclasses import replace
from threading import Event

import pytest
from textual.events import AppBlur, AppFocus
from textual.widgets import DataTable, OptionList

from app.screens.block_actions import depths_kept
from app.screens.contour import NEW_SEGMENTS, ContourScreen
from app.screens.dialogs import Question
from app.screens.lookahead import LookaheadScreen
from app.screens.palette import Palette
from app.screens.parameters import ParametersScreen, PartSetupScreen
from app.session.block_findings import block_findings
from app.session.work import Work, derived
from app.widgets.field import ChoiceField
from app.widgets.findings_list import FindingsList
from app.widgets.verdict import Verdict
from core.pipeline.derived import Derived
from core.program.edit import FormPlace
from core.program.model import ArcSegment, BlendSegment, LineSegment, Number, Program, Unread
from tests.app.widget_pilot import Operator, operator

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_an_unreadable_text_stays_marked_and_escape_restores_the_old_value(user: Operator):
    await user.press("pagedown", "tab", "'77", "escape")
    assert user.value("x_end") == "4.0000"
    assert user.session.history.undo_count == 0
    await user.press("'1a5", "enter")
    assert isinstance(user.session.block.segments[0].x_end, Unread)
    assert (user.value("x_end"), user.tag("x_end"), user.at) == ("1a5", "ERR", "x_end")
    assert "1a5" in user.prompt


async def test_a_typed_look_ahead_is_previewed_refused_above_20_and_restored_by_f3(user: Operator):
    await user.send(*["down"] * 11)
    await user.press("1")
    assert user.app.displayed.derived_block.lookahead.value == 1
    assert user.session.derived_block.lookahead.value == 8, "a half-typed number is not taken"
    await user.press("escape")
    assert user.app.displayed is user.session
    await user.press("'21", "enter")
    assert user.session.block.lookahead is None, "a refused one keeps the old value"
    assert (user.value("lookahead"), user.tag("lookahead"), user.at) == ("8", "CAL", "lookahead")
    await user.press("2", "enter")
    assert (user.value("lookahead"), user.tag("lookahead")) == ("2", "USR")
    await user.press("f3")
    assert (user.value("lookahead"), user.tag("lookahead")) == ("8", "CAL")


async def test_undo_and_redo_move_the_cursor_to_what_they_change(user: Operator):
    await user.press("pagedown", "tab", "'5.5", "enter")
    assert user.session.block.segments[0].x_end == Number(5.5)
    assert (user.value("x_end"), user.at) == ("5.5000", "y_end")
    assert user.session.derived_block.complete
    await user.press("pagedown", "pagedown", "ctrl+z")
    assert user.session.place == FormPlace(1, 1)
    assert (user.at, user.value("x_end")) == ("x_end", "4.0000")
    await user.press("ctrl+y")
    assert user.value("x_end") == "5.5000"
    await user.press("tab", "'9", "ctrl+z")
    assert user.session.history.redo_count == 1, "a half-typed number is discarded"
    assert user.value("y_end") == "0.2500"


async def test_moving_between_segments_shows_the_form_of_each_kind(user: Operator):
    kinds = []
    for _ in range(5):
        await user.press("right")
        kinds.append(str(user.screen.query_one("#segment-kind").render()))
    assert kinds == ["LINE", "ARC", "LINE", "BLEND ARC", "LINE"]
    assert user.at == "segment"


async def test_a_number_on_segment_goes_to_that_segment(user: Operator):
    for typed in ("I1.2", "2,400.5", "1-2"):
        await user.press(f"'{typed}", "enter")
        assert user.prompt == f"{typed} is not a segment number: type digits only, such as 3, then Enter."
        assert user.session.place.segment == 0
        await user.begin("pocket")
    await user.press("'8", "enter")
    assert user.session.place.segment == 8
    await user.press("'12", "enter")
    assert user.session.place.segment == 8
    assert "No segment 12" in user.prompt


async def test_f1_deletes_a_segment_but_not_start(user: Operator):
    await user.press("f1")
    assert user.prompt == "START cannot be deleted."
    assert user.session.history.undo_count == 0
    await user.press("'3", "enter", "f1")
    assert len(user.session.block.segments) == 10
    await user.press("ctrl+z")
    assert len(user.session.block.segments) == 11


async def test_a_choice_of_two_words_is_typed_with_its_space(user: Operator):
    await user.press("down", "down", *"profile", "space", *"right")
    assert user.value("cutter_comp") == "PROFILE RIGHT"
    assert not user.screen.query_one("#fields ChoiceField", ChoiceField).expanded
    await user.press("up", "down", "space")
    assert user.screen.query_one("#fields ChoiceField", ChoiceField).expanded


async def test_enter_after_text_that_is_no_choice_stays_once_and_names_all_of_it(user: Operator):
    await user.press("tab", "tab", "'33")
    assert user.prompt == "33 is not a choice. Left and right change it."
    await user.press("enter")
    assert (user.at, user.value("cutter_comp")) == ("cutter_comp", "LEFT")
    assert user.prompt == "33 is not a choice. Left and right change it."
    await user.press("enter")
    assert user.at == "x_start"
    await user.press("up", "up", "'-.5", "right", "enter")
    assert (user.at, user.value("cutter_comp")) == ("x_start", "RIGHT")


async def test_a_choice_can_be_typed_stepped_or_listed(user: Operator):
    await user.press("down", "down", "r")
    assert str(user.session.block.cutter_comp) == "RIGHT"
    await user.press("'p", "'r")
    assert str(user.session.block.cutter_comp) == "PROFILE LEFT"
    await user.press("left")
    assert str(user.session.block.cutter_comp) == "RIGHT"
    await user.press("space", "up", "enter")
    assert str(user.session.block.cutter_comp) == "LEFT"
    await user.press("q")
    assert user.prompt == "Q is not a choice. Left and right change it."
    await user.press("'right", "ctrl+z", "5")
    assert user.prompt == "5 is not a choice. Left and right change it."


async def from_palette(user: Operator, words: str) -> None:
    """Run an action by its name."""
    await user.press("ctrl+k", *("space" if sign == " " else f"'{sign}" for sign in words))
    await user.press("enter")


async def test_the_block_actions_of_program_are_on_mill_contour_too(user: Operator):
    first = user.session.program.blocks[0]
    await user.begin("pocket", 3, "x_end")
    await from_palette(user, "copy block")
    assert list(user.session.program.blocks) == [first, first]
    assert (type(user.screen).__name__, user.session.place) == ("ContourScreen", FormPlace(2, 0))
    assert user.prompt == "Block 2 is a copy of block 1."
    await user.press("ctrl+z")
    assert list(user.session.program.blocks) == [first]
    await from_palette(user, "insert block")
    assert (user.session.place, user.at) == (FormPlace(2, 0), "tool")
    await from_palette(user, "move block up")
    assert user.session.program.blocks[1] == first
    assert (user.session.place, user.prompt) == (FormPlace(1, 0), "Block 2 is block 1 now.")
    await from_palette(user, "move block up")
    assert user.prompt == "Block 1 is the first one."
    await from_palette(user, "delete block")
    assert list(user.session.program.blocks) == [first]
    await from_palette(user, "delete block")
    assert "The only block cannot be deleted" in user.prompt


async def test_a_copied_block_leaves_out_a_segment_that_is_still_empty(user: Operator):
    first = user.session.program.blocks[0]
    await user.press("ctrl+end", "right")
    assert len(user.session.block.segments) == len(first.segments) + 1
    await from_palette(user, "copy block")
    assert list(user.session.program.blocks) == [first, first]


async def test_a_half_typed_number_is_taken_before_its_block_is_copied(user: Operator):
    first = user.session.program.blocks[0]
    typed = replace(first, x_start=Number(2.5))
    await user.begin("pocket", 0, "x_start")
    await user.press("'2", "'.", "'5")
    await from_palette(user, "copy block")
    assert list(user.session.program.blocks) == [typed, typed]
    await user.press("ctrl+z", "ctrl+z")
    await user.begin("pocket", 0, "x_start")
    await user.press("'2", "'x")
    await from_palette(user, "delete block")
    assert len(user.session.program.blocks) == 1
    assert "2x cannot be read" in user.prompt


@pytest.mark.parametrize("action", ["shift_block", "repeat_shifted"])
async def test_a_half_typed_number_is_taken_before_a_block_is_transformed(user: Operator, action: str):
    await user.begin("pocket", 0, "x_start")
    await user.press("'2", "'.", "'5")
    await user.app.run_action(f"app.{action}")
    await user.settle()
    assert user.session.block.x_start == Number(2.5)
    await user.press("escape", "ctrl+z")
    assert user.session.block.x_start == Number(2.0)
    await user.begin("pocket", 0, "x_start")
    await user.press("'2", "'x")
    await user.app.run_action(f"app.{action}")
    await user.settle()
    assert isinstance(user.screen, ContourScreen)
    assert "2x cannot be read" in user.prompt


async def test_a_half_typed_number_moves_with_its_block(user: Operator):
    await user.begin("pocket", 0, "x_start")
    await user.press("'2", "'.", "'5")
    await user.app.run_action("app.shift_block")
    await user.settle()
    await user.press("backspace", "'1", "'0", "enter", "'0", "enter")
    assert user.session.block.x_start == Number(12.5)
    await user.press("enter")
    assert user.session.block.x_start == Number(12.5)


async def test_a_new_block_keeps_tool_feeds_and_depths(user: Operator):
    await user.press("f8")
    assert type(user.screen).__name__ == "ProgramScreen"
    await user.press("f2")
    assert user.session.place == FormPlace(2, 0)
    message = "Tool, feeds and depths as in block 1: Z BOTTOM -0.2500, PECK DEPTH 0.1000."
    assert depths_kept(user.session.program, 2) == message
    assert type(user.screen).__name__ == "ContourScreen"
    assert user.at == "tool"
    await user.press("'3", "enter")
    assert user.session.block.tool == Number(3.0)
    await user.press("ctrl+home", "'3", "enter")
    assert user.prompt == "No segment 3 yet. ENTER edits START, right arrow adds segment 1."


async def test_going_back_from_quit_leaves_the_text_half_typed():
    async with operator() as user:
        await user.press("tab", "'33", "ctrl+q")
        assert isinstance(user.app.screen, Question)
        assert user.app.screen.lines == ("33 in TOOL is not taken yet.",)
        await user.press("escape")
        assert (user.at, user.value("tool"), user.session.history.undo_count) == ("tool", "33", 0)
        await user.press("4", "enter")
        assert user.session.block.tool == Number(334.0)
        await user.press("ctrl+q")
        assert isinstance(user.app.screen, Question), "unsaved work is asked about, too"
        await user.press("escape")
        assert (user.session.block.tool, user.at) == (Number(334.0), "cutter_comp")
        await user.press("ctrl+z")
        user.app.move(FormPlace(1), "tool")
        await user.press("'33", "ctrl+q", "d")
        assert user.session.block.tool == Number(1.0)
        assert not user.app.is_running


async def test_an_unconfirmed_segment_number_does_not_keep_quit_waiting():
    async with operator() as user:
        await user.press("3", "ctrl+q")
        assert not user.app.is_running


async def test_a_larger_terminal_shows_the_segment_list_with_its_rows(user: Operator):
    await user.pilot.resize_terminal(132, 43)
    await user.settle()
    assert user.screen.query_one("#segments", DataTable).row_count == 12


async def test_the_findings_list_explains_its_keys_and_shows_each_finding_once(user: Operator):
    await user.begin("notch")
    await user.press("f10")
    assert user.prompt.startswith("Up and down show the places of the findings.")
    shown = "".join(str(option.prompt) for option in user.screen.query_one("#findings", OptionList).options)
    assert shown.count("Corner too tight") == 1
    await user.press("escape")


async def test_closing_a_list_returns_the_cursor_to_its_field():
    async with operator("notch") as user:
        await user.press(*["down"] * 3)
        field = user.at
        for key in ("f9", "f10"):
            # the key of the findings first makes their list taller
            again = (key,) if key == "f9" else (key, key)
            for close in (again, ("escape",)):
                await user.press(key)
                await user.press(*close)
                assert user.at == field, (key, close)
                await user.press("3")
                assert isinstance(user.screen, ContourScreen)
                assert (user.at, user.screen.half_typed) == (field, True), (key, close)
                await user.press("escape")
        await user.press("f9", "down", "f9")
        assert user.at == "segment"


async def test_the_letters_a_message_offers_work(user: Operator):
    await user.begin("notch")
    await user.press("ctrl+end", "pagedown", "a")
    assert user.at == "direction"
    await user.press("pagedown")
    assert "L LINE" in user.prompt
    await user.press("l")
    assert isinstance(user.session.segment, LineSegment)


async def test_a_number_is_taken_if_its_trial_is_shown_just_when_a_click_leaves_the_field(user: Operator):
    await user.press("tab", "8")
    await user.finish()
    trial = user.app.displayed
    assert trial.program.blocks[0].tool == Number(8.0)
    user.screen.set_focus(user.row("x_start").input)
    user.app.displayed = replace(trial)
    await user.settle()
    assert (user.at, user.session.block.tool) == ("x_start", Number(8.0))


async def test_a_letter_leads_back_from_every_empty_kind_of_segment(user: Operator):
    await user.begin("notch")
    await user.press("ctrl+end", "pagedown")
    for letter, field in (("a", "direction"), ("l", "x_end"), ("b", "radius"), ("c", "length"), ("l", "x_end")):
        await user.press(letter)
        assert type(user.session.segment) is NEW_SEGMENTS[letter]
        assert user.at == field
    await user.press("a", "b")
    assert isinstance(user.session.segment, BlendSegment)
    await user.press("a")
    assert "Or: L LINE, B BLEND ARC." in user.prompt
    await user.press("x")
    assert user.prompt == "X is not a choice. Left and right change it."
    await user.press("right")
    assert isinstance(user.session.segment, ArcSegment)
    await user.press("l")
    assert isinstance(user.session.segment, ArcSegment), "a DIRECTION has been chosen: the segment is not empty"
    assert user.prompt == "L is not a choice. Left and right change it."


async def test_page_down_to_a_segment_that_is_still_empty_leads_to_its_first_field(user: Operator):
    await user.begin("notch")
    await user.press("ctrl+end", "pagedown", "a", "pageup")
    assert user.at == "segment"
    # on SEGMENT its first letter would make a CHAMFER of the ARC
    await user.press("pagedown", "'ccw")
    assert (user.at, user.value("direction")) == ("direction", "CCW")


async def test_the_field_with_the_cursor_scrolls_into_view_on_a_tiny_terminal():
    async with operator(size=(40, 12)) as user:
        await user.press(*["down"] * 7)
        assert user.at == "z_bottom"
        await user.pilot.pause(0.3)
        assert user.screen.query_one("#desk").region.contains_region(user.screen.focused.region)


async def test_the_preview_of_a_half_typed_number_ends_with_the_typing(user: Operator, monkeypatch):
    """The derivation of the half-typed number ends only after the typing does."""
    may_end = Event()

    def slow(program: Program, _: Work) -> Derived:
        may_end.wait(20)
        return derived(program)

    await user.press("pagedown", "tab")
    before = user.value("length")
    monkeypatch.setattr("app.derivation_actions.derived", slow)
    for end, keys in {"taken back": ("7", "escape"), "the same": ("4", "tab")}.items():
        may_end.clear()
        await user.send(*keys)
        may_end.set()
        await user.settle()
        assert user.app.displayed is user.session, end
        assert user.value("length") == before, end


async def test_a_number_half_typed_on_another_screen_leaves_the_covered_form_alone(user: Operator):
    """DRAW moves the cursor to a segment of another kind while two screens cover the form."""
    await user.press("f5", "f7", "pagedown", "pagedown", "f8", "tab", "tab", "'2")
    assert type(user.app.screen).__name__ == "PartSetupScreen"
    await user.press("f8")
    assert (user.session.place.segment, user.at) == (2, "segment")
    assert user.row("x_center").display


async def test_going_to_a_finding_on_another_screen_opens_it_with_the_cursor_on_the_field(user: Operator):
    await user.press("f5", "tab", "'1", "tab", "f8", "pagedown", "tab", "tab")
    entry = next(finding for finding in user.screen.query_one(FindingsList).entries if finding.field == "work_offset")
    user.app.go_to(entry)
    await user.settle()
    assert isinstance(user.app.screen, PartSetupScreen)
    assert user.at == "work_offset"
    await user.press("f8")
    assert isinstance(user.screen, ContourScreen)
    assert (user.session.place.segment, user.at) == (1, "y_end")


async def test_enter_on_the_finding_of_a_blend_arc_goes_to_blend_offset_which_names_what_fits(user: Operator):
    await user.press("f4", "tab", "'2", "enter", "f8")
    await user.finish()
    await user.press("f10")
    findings = user.screen.query_one("#findings", FindingsList)
    row = next(at for at, entry in enumerate(findings.entries) if entry.field == "blend_offset")
    await user.press(*["down"] * (row - (findings.highlighted or 0)), "enter")
    assert isinstance(user.app.screen, ParametersScreen)
    assert user.at == "blend_offset"
    named = re.search(r"the largest that fits here is (\d\.\d+)\.$", user.prompt)
    assert named is not None
    await user.press(*(f"'{sign}" for sign in named[1]), "enter", "f8")
    await user.finish()
    assert isinstance(user.screen, ContourScreen)
    assert not [entry for entry in user.screen.entries if entry.field == "blend_offset"]


async def test_the_palette_can_be_reopened_at_once(user: Operator):
    """It opens even before the closing palette is gone."""
    user.app.action_command_palette()
    await user.settle()
    user.app.pop_screen()
    user.app.action_command_palette()
    await user.settle()
    assert isinstance(user.app.screen, Palette)


async def test_switching_windows_does_not_take_a_half_typed_number(user: Operator):
    await user.press("pagedown", "tab", "'1")
    user.app.post_message(AppBlur())
    await user.settle()
    user.app.post_message(AppFocus())
    await user.settle()
    assert user.session.history.undo_count == 0
    await user.press("'.25")
    assert user.value("x_end") == "1.25"
    await user.press("enter")
    assert user.session.program.blocks[0].segments[0].x_end == Number(1.25)


@pytest.mark.parametrize(
    ("keys", "close_key"), [(("f6", "tab", "tab", "'1", "enter"), "f8"), (("f4", "tab", "'.1", "enter"), "escape")]
)
async def test_edits_on_another_screen_show_in_verdict_and_findings(user: Operator, keys, close_key):
    before = user.screen.query_one(Verdict).case
    await user.press(*keys)
    await user.press(close_key)
    assert user.session.history.undo_count == 1
    verdict = user.screen.query_one(Verdict)
    assert verdict.case is not before
    assert verdict.case.block is user.session.derived_block
    assert isinstance(user.screen, ContourScreen)
    assert user.screen.entries == block_findings(
        user.session.derived_block, user.session.lookahead_table, user.session.program.unit
    )


async def test_a_typed_look_ahead_is_taken_before_the_table_opens(user: Operator):
    await user.begin("notch")
    await user.press(*("tab",) * 11, "'12", "space")
    assert isinstance(user.app.screen, LookaheadScreen)
    await user.press("home", "enter")
    taken = user.session.block.lookahead
    assert taken != Number(12.0)
    await user.press("tab", "tab")
    assert user.session.block.lookahead == taken


async def test_repeating_a_segment_removes_the_undo_message(user: Operator):
    await user.begin("notch")
    for keys in ((), ("ctrl+z",)):
        await user.press(*keys)
        await user.app.run_action("app.repeat_shifted")
        await user.press(*("enter",) * 5)
        assert user.session.history.undo_count == 1
        assert "Undone" not in user.prompt


async def test_a_number_out_of_range_is_reported_with_its_range_while_typed(user: Operator):
    assert isinstance(user.screen, ContourScreen)
    user.screen.focus_field("plunge_feed")
    await user.press("'-6")
    assert user.prompt == "PLUNGE FEED must be above 0, at most 10000, not -6. Still using 5.0."
