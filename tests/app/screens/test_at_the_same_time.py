"""Events that overlap: a result while the program ends, and rows that the cursor has left."""

from __future__ import annotations

import time
from asyncio import sleep
from typing import Any

import app.derivation_actions as owner
from app.session.work import derived
from tests.app.widget_pilot import operator


async def test_a_result_that_arrives_while_the_program_ends_is_ignored(monkeypatch):
    running = []
    async with operator("notch") as user:

        def late(*arguments: Any) -> Any:
            while user.app.is_running:
                time.sleep(0.001)
            running.append(user.app.is_running)
            return derived(*arguments)

        monkeypatch.setattr(owner, "derived", late)
        await user.pilot.press("tab", "tab", "tab", "tab", "5")
        before = user.session
        assert running == []
    while not running:
        await sleep(0.01)
    assert running == [False]
    assert user.session is before


async def test_the_segment_list_opens_on_the_segment_of_the_form_and_stays_there():
    async with operator("pocket") as user:
        await user.press(*["pagedown"] * 4)
        places = []
        user.screen.watch(user.app, "session", lambda session: places.append(session.place.segment))
        await user.press("f9")
        assert set(places) == {4}
        await user.press("down")
        assert user.session.place.segment == 5


async def test_deleting_a_segment_in_the_list_keeps_the_cursor_there():
    async with operator("pocket") as user:
        await user.press("f9", *["down"] * 4)
        await user.press("delete")
        assert (user.session.place.segment, len(user.session.block.segments)) == (4, 10)
        assert user.app.focused is user.screen.query_one("#segments")
        await user.press("down")
        assert user.session.place.segment == 5
