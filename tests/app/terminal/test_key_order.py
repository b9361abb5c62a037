"""Keys that arrive together: each goes to the field that has the cursor after all earlier keys."""

from __future__ import annotations

import asyncio
from pathlib import Path
from random import Random
from time import monotonic, sleep

import pytest
from textual import events
from textual.message_pump import MessagePump

from app.app import CutcompApp
from app.documents.document_service import DocumentService
from app.file_actions import session_of
from app.terminal import key_order
from app.terminal.key_order import KeyOrder
from app.terminal.split_keys import TORN, UNENDED
from core.program.model import Number
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def burst(user: Operator, *keys: str) -> None:
    """Send all keys at once, as a slow link or a paste does."""
    order = KeyOrder(user.app)
    for key in keys:
        order.take(events.Key(key, key if len(key) == 1 else None))
    while order.busy:
        await asyncio.sleep(0.001)
    await user.settle()


async def test_numbers_typed_at_once_fill_the_fields_in_order(user: Operator):
    await burst(user, "pagedown", "tab", "5", "enter", "1", ".", "2", "5", "enter", "pagedown")
    segment = user.session.block.segments[0]
    assert (segment.x_end, segment.y_end) == (Number(5.0), Number(1.25))
    assert user.session.place.segment == 3, "Enter on Y END goes to segment 2, Page Down to the next one"
    count = len(user.session.block.segments)
    await burst(user, "ctrl+end", "a", "tab", "3", "enter", "4", "enter")
    segment = user.session.block.segments[count]
    assert (segment.x_end, segment.y_end) == (Number(3.0), Number(4.0)), "the new segment of the letter"


async def test_a_torn_key_and_an_unended_paste_are_reported_and_keep_half_typed_text(user: Operator):
    await user.press("tab", "1")
    for key, begins in ((TORN, "The link split a key"), (UNENDED, "Pasted text came without its end")):
        user.app.post_message(events.Key(key, None))
        await user.settle()
        assert user.prompt.startswith(begins)
    await user.press("2", "enter")
    assert user.session.block.tool == Number(12.0)


async def test_keys_after_the_one_that_opens_a_file_go_to_that_file(part: Path, state: Path):
    service = DocumentService(state=state)
    app = CutcompApp(session_of(service.new().document), surroundings=SURROUNDINGS, service=service, home=True)
    async with Operator.of(app) as user:
        await burst(user, "enter", "pagedown", "tab", "5", "enter")
        assert user.session.file == part
        assert user.session.place.segment == 1
        segment = user.session.block.segments[0]
        assert segment.x_end == Number(5.0)
        service.stop()


async def test_numbers_after_a_command_of_the_palette_go_to_the_form_that_it_opens():
    async with operator() as user:
        await user.press("f8", "ctrl+k", *"shift block")
        await burst(user, "enter", "3", "enter", "1", "enter")
        assert user.session.block.x_start == Number(5.0)
        assert user.session.block.y_start == Number(1.25)


@pytest.mark.parametrize("typed", ["8", "12"])
async def test_a_click_right_after_keys_moves_the_cursor_after_them(user: Operator, typed: str):
    await user.press("tab")
    x, y = user.row("x_start").input.region.offset
    order = KeyOrder(user.app)
    for key in typed:
        order.take(events.Key(key, key))
    kinds: tuple[type[events.MouseEvent], ...] = (events.MouseDown, events.MouseUp)
    for kind in kinds:
        order.take(kind(None, x, y, 0, 0, 1, False, False, False))
    order.take(events.Key("9", "9"))
    while order.busy:
        await asyncio.sleep(0.001)
    await user.press("enter")
    block = user.session.block
    assert (block.tool, block.x_start) == (Number(float(typed)), Number(9.0))


async def test_random_keys_sent_at_once_act_as_when_sent_one_by_one():
    random = Random(20261123)
    keys = ("pagedown", "pageup", "tab", "down", "up", "enter", "1", "2", "5", "escape", "ctrl+z", "backspace")
    async with operator() as slow, operator() as fast:
        for _ in range(2):
            chosen = random.choices(keys, k=30)
            for key in chosen:
                await slow.press(key)
            await burst(fast, *chosen)
            assert fast.session.program == slow.session.program
            assert (fast.session.place, fast.at) == (slow.session.place, slow.at), chosen
        assert slow.session.history.undo_count > 0


async def test_a_slow_machine_keeps_the_keys_in_their_fields(monkeypatch):
    """Each turn of the event loop is so slow that a key takes longer than the wait for it."""
    monkeypatch.setattr(key_order, "CHECK_SECONDS", 0.01)
    async with operator() as user:
        loop, end = asyncio.get_running_loop(), monotonic() + 4.0

        def busy() -> None:
            sleep(0.04)
            if monotonic() < end and user.session.block.tool != Number(7.0):
                loop.call_soon(busy)

        busy()
        await burst(user, "ctrl+home", "tab", "7", "enter")
        assert user.session.block.tool == Number(7.0)


async def test_keys_for_an_ending_program_are_dropped(user: Operator, monkeypatch: pytest.MonkeyPatch):
    order = KeyOrder(user.app)
    with monkeypatch.context() as patch:
        patch.setattr(MessagePump, "post_message", lambda *_: False)
        patch.setattr(MessagePump, "message_queue_size", 1)
        order.take(events.Key("5", "5"))
        while order.busy:
            await asyncio.sleep(0)
    assert not order.waiting
