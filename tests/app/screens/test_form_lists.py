"""The lists of the form and of the look-ahead table: what Enter, Space and the softkeys do on them."""

from __future__ import annotations

from dataclasses import replace

from textual.widgets import DataTable, OptionList

from app.screens.contour import ContourScreen
from app.screens.lookahead import LookaheadScreen
from app.widgets.drawing import Drawing
from app.widgets.findings_list import FindingsList
from app.widgets.segment_list import SegmentList
from core.program.model import Number
from tests.app.widget_pilot import operator


async def test_the_next_finding_is_found_from_the_form_itself():
    """On START the loupe shows the first finding already, so that the next one is the second."""
    async with operator() as user:
        loupe = user.screen.query_one("#loupe", Drawing)
        headings = []
        for key in ("ctrl+n", "ctrl+n", "ctrl+n", "ctrl+p"):
            await user.press(key)
            headings.append(next(word for word in loupe.heading.split() if "/" in word))
        assert headings == ["2/3", "3/3", "1/3", "3/3"]
        assert user.screen.query_one(FindingsList).highlighted == 2
        await user.press("pagedown", "ctrl+p")
        assert isinstance(user.screen, ContourScreen)
        assert user.screen.selected_finding is not None


async def test_without_findings_the_key_says_so():
    async with operator("plate-mm") as user:
        await user.press("ctrl+n")
        assert user.prompt == "There are no findings."


async def test_enter_in_the_list_of_segments_goes_to_the_first_field_of_the_segment():
    async with operator() as user:
        await user.press("f9", "down", "down", "enter")
        assert user.session.place.segment == 2
        assert user.at == "direction", "segment 2 is an ARC"


async def test_keys_in_a_burst_all_move_the_cursor_of_the_two_lists_that_the_program_follows():
    """The program follows one key while the next one moves the cursor on; no key may be taken back."""
    async with operator() as user:
        await user.begin(replace(user.session.program, blocks=user.session.program.blocks * 6))
        await user.press("f9")
        for _ in range(6):
            await user.press("home", *["down"] * 5, "up")
            assert user.session.place.segment == 4
            assert user.screen.query_one(SegmentList).cursor_row == 4
        await user.app.run_action("app.program")
        await user.settle()
        for _ in range(6):
            await user.press("home", *["down"] * 5, "up")
            assert user.session.place.block == 5
            assert user.screen.query_one("#blocks", DataTable).cursor_row == 4


async def test_the_list_of_finish_tools_offers_no_finish_pass_first():
    async with operator() as user:
        await user.begin(user.session.program, field="finish_tool")
        await user.press("space")
        rows = user.app.screen.query_one(OptionList)
        assert str(rows.get_option_at_index(0).prompt) == "no finish pass"
        await user.press("down", "enter")
        assert user.session.program.blocks[0].finish_tool == Number(1.0)
        await user.press("space", "home", "enter")
        assert user.session.program.blocks[0].finish_tool == Number(0.0)


async def test_the_table_restores_the_calculated_look_ahead():
    async with operator() as user:
        await user.begin(user.session.program, field="lookahead")
        await user.press("7", "enter")
        assert user.session.derived_block.lookahead.tag == "USR"
        await user.app.run_action("app.lookahead")
        await user.settle()
        assert isinstance(user.screen, LookaheadScreen)
        await user.press("f3")
        assert user.session.derived_block.lookahead.tag == "CAL"
        assert user.session.program.blocks[0].lookahead is None
