"""Keys and pasted text take effect in the order in which they came, whatever way they take to the desk."""

from __future__ import annotations

import pytest
from textual.events import Key, Paste
from textual.pilot import Pilot

from app.application import CutcompApp
from app.screens.forms import FormPage
from app.widgets.field import Editing
from tests.app.pilots import app_on, at_rest, loaded

TO_X_END = ("1", "enter", "tab")


async def _typing(pilot: Pilot[int], app: CutcompApp) -> None:
    await loaded(pilot)
    await at_rest(pilot, app)
    await pilot.press(*TO_X_END)


@pytest.mark.parametrize("first", ["2.", "."])
async def test_a_key_behind_pasted_text_is_typed_behind_it(first: str) -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await _typing(pilot, app)
        for character in first:
            app.post_message(Key(character, character))
        app.post_message(Paste("12"))
        app.post_message(Key("3", "3"))
        app.post_message(Paste("45"))
        app.post_message(Key("6", "6"))
        app.post_message(Key("enter", None))
        await pilot.pause()
        await at_rest(pilot, app)
        entry = app.desk.session.block.segments[0].x_end
        assert entry is not None
        assert getattr(entry, "value", None) == pytest.approx(float(f"{first}123456"))


async def test_a_key_takes_no_turn_in_the_screen_s_queue() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await _typing(pilot, app)
        key = Key("7", "7")
        await app.on_event(key)
        assert not key.is_forwarded
        page = app.desk.page
        assert isinstance(page, FormPage)
        assert page.editing == Editing.of("7")
