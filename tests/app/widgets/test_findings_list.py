"""The list of findings: each title names its segments; the rest of the sentence follows."""

from __future__ import annotations

import pytest

from app.screens.contour import ContourScreen
from app.screens.draw import DrawScreen
from app.session.block_findings import Entry, EntryKind
from app.widgets.findings_list import FindingsList
from tests.app.widget_pilot import operator


async def test_the_second_line_of_a_finding_continues_its_title():
    async with operator(size=(132, 43)) as user:
        findings = user.screen.query_one(FindingsList)
        first = str(findings.get_option_at_index(0).prompt).split("\n")
        assert first == ["▲ 1 UNCUT 0.3624 thick  segment 8-10", "    1.2296 long, segments 8-10 at X 0.2500 Y 3.5000."]


async def test_the_sentences_leave_room_for_a_scroll_bar_when_it_comes():
    async with operator() as user:
        await user.press("f10")
        findings = user.screen.query_one(FindingsList)
        width, height = findings.content_region.size
        sentence = f"{'x' * (width - 7)} y."
        entry = Entry(EntryKind.NOTE, sentence, "", sentence)
        for count, wrapped in ((1, f"i 1 {'x' * (width - 7)} y."), (height + 1, f"i 1 {'x' * (width - 7)}\n    y.")):
            findings.entries = (entry,) * count
            assert str(findings.get_option_at_index(0).prompt) == wrapped


@pytest.mark.parametrize("key", ["", "f7"], ids=["form", "DRAW"])
async def test_a_list_that_becomes_shorter_forgets_a_step_to_a_finding_that_is_gone(key: str):
    async with operator(size=(132, 43)) as user:
        await user.press(*([key] if key else []))
        screen = user.screen
        assert isinstance(screen, ContourScreen | DrawScreen)
        findings = screen.query_one(FindingsList)
        findings.focus()
        await user.settle()
        findings.highlighted = len(findings.entries) - 1
        findings.action_select()
        screen.entries = findings.entries = findings.entries[:1]
        await user.settle()
        assert findings.highlighted == 0
