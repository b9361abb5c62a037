"""A wide terminal says below the list what the block or file with the cursor is."""

from __future__ import annotations

from dataclasses import replace

from textual.widgets import OptionList

from app.documents.files import load
from app.documents.programs import example
from app.screens.contour import ContourScreen
from app.widgets.block_summary import BlockSummary
from core.program.model import Number
from tests.app.screens.test_list_keys import run
from tests.app.widget_pilot import Operator, operator


def lines(user: Operator) -> list[str]:
    return str(user.screen.query_one(BlockSummary).content).split("\n")


async def test_program_says_what_the_block_is_and_lists_its_findings_where_there_is_room():
    async with operator(size=(200, 50)) as user:
        await run(user, "app.program")
        await user.finish()
        assert lines(user)[:4] == [
            "BLOCK 1   MILL CONTOUR  LEFT  CAL 8",
            "CONTOUR   11 segments, closed, 15.4560 long",
            "TOOL 1    END MILL  0.5000",
            "LIMITS    X 0.2500 to 4.7500   Y 0.2500 to 3.5000",
        ]
        assert "DELETED 9" in lines(user)[4]
        assert lines(user)[5].startswith("TIME      cut ")
        findings = user.screen.query_one("#program-findings", OptionList)
        assert findings.option_count == 3
        findings.focus()
        await user.press("enter")
        assert isinstance(user.screen, ContourScreen)
        assert user.session.place.segment == 8


async def test_home_says_what_the_program_is():
    async with operator(size=(132, 43)) as user:
        await run(user, "app.home")
        await user.press("p", "o")
        await user.finish()
        assert lines(user)[1] == "CONTOUR   11 segments, closed, 15.4560 long"


async def test_a_verdict_with_uncut_area_is_not_cut_off():
    flange = load(example("flange"))
    too_big = tuple(replace(tool, diameter=Number(60.0)) for tool in flange.tools)
    async with operator(replace(flange, tools=too_big), size=(132, 43)) as user:
        await run(user, "app.program")
        await user.press("down")
        await user.finish()
        verdict = lines(user)[4]
        assert "UNCUT 6.2832 long" in verdict
        assert "DELETED none" in verdict
        assert len(verdict) <= user.screen.query_one(BlockSummary).content_size.width


async def test_the_lines_are_hidden_on_small_terminals():
    async with operator() as user:
        await run(user, "app.program")
        assert not user.screen.query_one(BlockSummary).display
