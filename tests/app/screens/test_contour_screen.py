"""MILL CONTOUR, as an operator meets it: fields, walking, undo, softkeys."""

from __future__ import annotations

from threading import Event

import pytest
from textual.events import AppBlur, AppFocus
from textual.widgets import DataTable, OptionList

from app.screens.contour import ContourScreen
from app.screens.lookahead import LookaheadScreen
from app.screens.palette import Palette
from app.screens.program import depths_kept
from app.session.block_findings import block_findings
from app.session.derivation import Request, derived
from app.session.work import Work
from app.widgets.field import ChoiceField
from app.widgets.findings_list import FindingsList
from app.widgets.verdict import Verdict
from core.pipeline.derived import Derived
from core.program.edit import FormPlace
from core.program.model import LineSegment, Number, Unread
from tests.app.widget_pilot import operator


async def test_a_typed_number_is_taken_and_the_cursor_goes_on():
    async with operator() as one:
        await one.press("pagedown", "tab", "'5.5", "enter")
        assert one.session.block.segments[0].x_end == Number(5.5)
        assert (one.value("x_end"), one.at) == ("5.5000", "y_end")
        assert one.session.derived_block.known


async def test_a_text_that_cannot_be_read_stays_marked_and_keeps_the_cursor():
    async with operator() as one:
        await one.press("pagedown", "tab", "'1a5", "enter")
        assert isinstance(one.session.block.segments[0].x_end, Unread)
        assert (one.value("x_end"), one.tag("x_end"), one.at) == ("1a5", "ERR", "x_end")
        assert "1a5" in one.prompt


async def test_a_refused_look_ahead_leaves_the_old_one():
    async with operator() as one:
        await one.press(*["down"] * 11, "'21", "enter")
        assert one.session.block.lookahead is None
        assert (one.value("lookahead"), one.tag("lookahead"), one.at) == ("8", "CAL", "lookahead")


async def test_a_typed_look_ahead_is_usr_and_f3_brings_cal_back():
    async with operator() as one:
        await one.press(*["down"] * 11, "2", "enter")
        assert (one.value("lookahead"), one.tag("lookahead")) == ("2", "USR")
        await one.press("f3")
        assert (one.value("lookahead"), one.tag("lookahead")) == ("8", "CAL")


async def test_escape_brings_the_old_value_back():
    async with operator() as one:
        await one.press("pagedown", "tab", "'77", "escape")
        assert one.value("x_end") == "4.0000"
        assert one.session.history.undo_count == 0


async def test_a_half_typed_number_is_tried_out_and_not_taken():
    async with operator() as one:
        await one.press(*["down"] * 11, "1")
        assert one.app.shown.derived_block.lookahead.value == 1
        assert one.session.derived_block.lookahead.value == 8
        await one.press("escape")
        assert one.app.shown is one.session


async def test_undo_and_redo_put_the_cursor_on_what_they_change():
    async with operator() as one:
        await one.press("pagedown", "tab", "'5.5", "enter", "pagedown", "pagedown", "ctrl+z")
        assert one.session.place == FormPlace(1, 1)
        assert (one.at, one.value("x_end")) == ("x_end", "4.0000")
        await one.press("ctrl+y")
        assert one.value("x_end") == "5.5000"


async def test_undo_forgets_what_is_half_typed():
    async with operator() as one:
        await one.press("pagedown", "tab", "'5.5", "enter", "'9", "ctrl+z")
        assert one.session.history.redo_count == 1
        assert one.value("y_end") == "0.2500"


async def test_walking_shows_the_form_of_each_kind_of_segment():
    async with operator() as one:
        kinds = []
        for _ in range(5):
            await one.press("right")
            kinds.append(str(one.screen.query_one("#segment-kind").render()))
        assert kinds == ["LINE", "ARC", "LINE", "BLEND ARC", "LINE"]
        assert one.at == "segment"


async def test_a_number_on_segment_goes_to_that_segment():
    async with operator() as one:
        await one.press("'8", "enter")
        assert one.session.place.segment == 8
        await one.press("'12", "enter")
        assert one.session.place.segment == 8
        assert "No segment 12" in one.prompt


async def test_deleting_a_segment_can_be_undone():
    async with operator() as one:
        await one.press("'3", "enter", "f1")
        assert len(one.session.block.segments) == 10
        await one.press("ctrl+z")
        assert len(one.session.block.segments) == 11


async def test_f1_on_start_deletes_nothing():
    async with operator() as one:
        await one.press("f1")
        assert one.prompt == "START cannot be deleted."
        assert one.session.history.undo_count == 0


async def test_a_choice_of_two_words_is_spelled_with_its_blank():
    async with operator() as one:
        await one.press("down", "down", *"profile", "space", *"right")
        assert one.value("cutter_comp") == "PROFILE RIGHT"
        assert not one.screen.query_one("#fields ChoiceField", ChoiceField).expanded
        await one.press("up", "down", "space")
        assert one.screen.query_one("#fields ChoiceField", ChoiceField).expanded


async def test_a_choice_is_spelled_stepped_and_listed():
    async with operator() as one:
        await one.press("down", "down", "r")
        assert str(one.session.block.cutter_comp) == "RIGHT"
        await one.press("'p", "'r")
        assert str(one.session.block.cutter_comp) == "PROFILE LEFT"
        await one.press("left")
        assert str(one.session.block.cutter_comp) == "RIGHT"
        await one.press("space", "up", "enter")
        assert str(one.session.block.cutter_comp) == "LEFT"
        await one.press("q")
        assert one.prompt == "Q is not a choice: left and right change it."


async def test_a_block_is_left_and_a_new_one_begun():
    async with operator() as one:
        await one.press("f8")
        assert type(one.screen).__name__ == "ProgramScreen"
        await one.press("f2")
        assert one.session.place == FormPlace(2, 0)
        said = "Tool, feeds and depths as in block 1: Z BOTTOM -0.2500, PECK DEPTH 0.1000."
        assert depths_kept(one.session.program, 2) == said
        assert type(one.screen).__name__ == "ContourScreen"
        await one.press("tab", "'3", "enter")
        assert one.session.block.tool == Number(3.0)


async def test_leaving_unsaved_work_asks_and_going_back_keeps_it():
    async with operator() as one:
        await one.press("tab", "'3", "enter", "ctrl+q")
        assert type(one.app.screen).__name__ == "Question"
        await one.press("escape")
        assert one.session.block.tool == Number(3.0)
        assert type(one.app.screen).__name__ == "ContourScreen"


async def test_a_larger_terminal_brings_the_segment_list_up_with_its_rows():
    async with operator() as one:
        await one.pilot.resize_terminal(132, 43)
        await one.settle()
        assert one.screen.query_one("#segments", DataTable).row_count == 12


async def test_lists_say_what_their_keys_do_and_a_finding_is_told_once():
    async with operator("notch") as one:
        await one.press("f10")
        assert one.prompt.startswith("Up and down show the places of the findings.")
        shown = "".join(str(option.prompt) for option in one.screen.query_one("#findings", OptionList).options)
        assert shown.count("Corner too tight") == 1


@pytest.mark.parametrize("key", ["f9", "f10"])
@pytest.mark.parametrize("close", ["again", "escape"])
async def test_behind_a_list_the_cursor_goes_on_where_it_was(key: str, close: str):
    async with operator("notch") as one:
        await one.press(*["down"] * 3)
        field = one.at
        await one.press(key)
        await one.press(key if close == "again" else close)
        assert one.at == field
        await one.press("3")
        assert isinstance(one.screen, ContourScreen)
        assert (one.at, one.screen.half_typed) == (field, True)
        await one.press("escape")
        await one.press("f9", "down", "f9")
        assert one.at == "segment"


async def test_letters_that_a_message_offers_are_taken():
    async with operator("notch") as one:
        await one.press("ctrl+end", "pagedown", "a")
        assert one.at == "direction"
        await one.press("pagedown")
        assert "L LINE" in one.prompt
        await one.press("l")
        assert isinstance(one.session.segment, LineSegment)


async def test_on_a_tiny_terminal_the_field_with_the_cursor_comes_into_sight():
    async with operator(size=(40, 12)) as one:
        await one.press(*["down"] * 7)
        assert one.at == "z_bottom"
        await one.pilot.pause(0.3)
        assert one.screen.query_one("#desk").region.contains_region(one.screen.focused.region)


@pytest.mark.parametrize("keys", [("7", "escape"), ("4", "tab")], ids=["taken back", "the same"])
async def test_a_number_that_changes_nothing_is_no_longer_shown_once_it_is_not_typed(keys, monkeypatch):
    """The derivation of the half-typed number ends after the key that ends the typing."""
    ends = Event()

    def slow(request: Request, _: Work) -> Derived:
        ends.wait(20)
        return derived(request)

    async with operator() as one:
        await one.press("pagedown", "tab")
        before = one.value("length")
        monkeypatch.setattr("app.derivation_actions.derived", slow)
        await one.pilot.press(*keys)
        ends.set()
        await one.settle()
        assert one.app.shown is one.session
        assert one.value("length") == before


async def test_a_number_tried_out_on_another_screen_is_none_of_the_form_that_is_covered():
    """DRAW moves the cursor to a segment of another kind while two screens stand on the form."""
    async with operator() as one:
        await one.press("f5", "f7", "pagedown", "pagedown", "f8", "tab", "tab", "'2")
        assert type(one.app.screen).__name__ == "PartSetupScreen"
        await one.press("f8")
        assert (one.session.place.segment, one.at) == (2, "segment")
        assert one.row("x_center").display


async def test_a_finding_on_a_field_of_another_screen_puts_the_cursor_on_segment():
    async with operator() as one:
        await one.press("f5", "tab", "'1", "tab", "f8", "pagedown", "tab", "tab")
        entry = next(each for each in one.screen.query_one(FindingsList).entries if each.field == "work_offset")
        one.app.go_to(entry)
        await one.settle()
        assert (one.session.place.segment, one.at) == (0, "segment")


async def test_the_palette_comes_back_at_once():
    """Before the one of a moment ago is gone."""
    async with operator() as one:
        one.app.action_command_palette()
        await one.pilot.pause()
        one.app.pop_screen()
        one.app.action_command_palette()
        await one.settle()
        assert isinstance(one.app.screen, Palette)


async def test_a_look_at_another_window_takes_nothing_that_is_half_typed():
    async with operator() as one:
        await one.press("pagedown", "tab", "'1")
        one.app.post_message(AppBlur())
        await one.settle()
        one.app.post_message(AppFocus())
        await one.settle()
        assert one.session.history.undo_count == 0
        await one.press("'.25")
        assert one.value("x_end") == "1.25"
        await one.press("enter")
        assert one.session.program.blocks[0].segments[0].x_end == Number(1.25)


@pytest.mark.parametrize(
    ("keys", "back"), [(("f6", "tab", "tab", "'1", "enter"), "f8"), (("f4", "tab", "'.1", "enter"), "escape")]
)
async def test_what_was_edited_on_another_screen_shows_in_verdict_and_findings(keys, back):
    async with operator() as one:
        before = one.screen.query_one(Verdict).case
        await one.press(*keys)
        await one.press(back)
        assert one.session.history.undo_count == 1
        verdict = one.screen.query_one(Verdict)
        assert verdict.case is not before
        assert verdict.case.block is one.session.derived_block
        assert isinstance(one.screen, ContourScreen)
        assert one.screen.entries == block_findings(
            one.session.derived_block, one.session.lookahead_table, one.session.program.unit
        )


async def test_a_typed_look_ahead_is_taken_before_the_table_offers_others():
    async with operator("notch") as one:
        await one.press(*("tab",) * 11, "'12", "space")
        assert isinstance(one.app.screen, LookaheadScreen)
        await one.press("home", "enter")
        taken = one.session.block.lookahead
        assert taken != Number(12.0)
        await one.press("tab", "tab")
        assert one.session.block.lookahead == taken


async def test_a_repeated_segment_ends_what_was_said_of_the_undo_before():
    async with operator("notch") as one:
        for keys in ((), ("ctrl+z",)):
            await one.press(*keys)
            await one.app.run_action("app.repeat_shifted")
            await one.press(*("enter",) * 5)
            assert one.session.history.undo_count == 1
            assert "Undone" not in one.prompt
