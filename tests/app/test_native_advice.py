"""Advice on the screens: it follows the verdict after a pause in typing and says what would help."""

from __future__ import annotations

from dataclasses import replace
from threading import Event

import pytest

import app.derivation_actions as app_module
from app.derivation_actions import ADVICE_DELAY
from app.screens.contour import ContourScreen
from core.program.model import Block, CutterComp, LineSegment, Number, Program, Tool
from core.progress import Stopped
from tests.app.widget_pilot import Operator, operator


def slot() -> Program:
    """A slot 0.4 wide, cut by a tool of 0.5."""
    ends = ((0.0, 0.0), (0.4, 0.0), (0.4, 2.0))
    segments = tuple(LineSegment(x_end=Number(x), y_end=Number(y)) for x, y in ends)
    block = Block(
        tool=Number(1.0),
        cutter_comp=CutterComp.LEFT,
        x_start=Number(0.0),
        y_start=Number(2.0),
        z_start=Number(0.0),
        z_bottom=Number(-0.25),
        plunge_feed=Number(5.0),
        speed=Number(3000.0),
        segments=segments,
    )
    return replace(Program(), tools=(Tool(1, diameter=Number(0.5)),), blocks=(block,))


async def advised(user: Operator) -> list[str]:
    """The texts of all findings once the search for advice has ended."""
    for _ in range(200):
        table = user.session.lookahead_table
        if table is not None and table.complete:
            break
        await user.pilot.pause(ADVICE_DELAY / 10)
    await user.settle()
    assert isinstance(user.screen, ContourScreen)
    return [entry.text for entry in user.screen.entries]


async def test_the_list_names_a_clean_look_ahead_and_enter_goes_to_it():
    async with operator("notch", size=(132, 43)) as user:
        findings = await advised(user)
        advice = "CAL 2 gouges. Enter look-ahead 3, which does not gouge but leaves 0.9000 uncut."
        assert advice in findings
        await user.press("f10", *["down"] * findings.index(advice), "enter")
        assert (user.at, user.session.place.segment) == ("lookahead", 0)
        assert user.prompt.replace("\n", " ") == advice
        await user.press("3", "enter")
        assert not user.session.derived_block.errors


async def test_the_largest_tool_that_fits_is_named_in_the_list_and_on_tool():
    async with operator(slot()) as user:
        fits = "Tool too big; the largest that does not gouge: 0.3318, with look-ahead 1."
        findings = await advised(user)
        gouges = [text for text in findings if text.startswith("GOUGE")]
        assert findings[: len(gouges) + 1] == [*gouges, fits]
        assert "none is clean, F10 says why" in str(user.screen.query_one("#strip").render())
        await user.press("tab")
        assert (user.at, user.prompt) == ("tool", fits)


async def test_a_key_ends_the_search_for_advice(monkeypatch):
    searches, go = [], Event()

    def searching(_, __, table, progress):
        searches.append(progress)
        assert go.wait(10)
        yield replace(table, complete=True)

    monkeypatch.setattr(app_module, "advised", searching)
    async with operator(slot()) as user:
        while not searches:
            await user.pilot.pause(ADVICE_DELAY / 10)
        await user.press("tab", "2")
        with pytest.raises(Stopped):
            searches[0](0.0)
        go.set()
        await user.pilot.pause(ADVICE_DELAY / 10)
        assert not user.session.lookahead_table.complete
