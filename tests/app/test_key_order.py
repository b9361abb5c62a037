"""Keys and pasted text take effect in the order in which they came, whatever way they take to the desk."""

from __future__ import annotations

from math import inf
from pathlib import Path

import pytest
from textual.events import Event, Key, Paste
from textual.pilot import Pilot

from app.documents.programs import example
from app.painted.application import CutcompApp
from app.painted.engine import Engine
from app.painted.opened import opened
from app.painted.screens.forms import FormPage
from app.painted.widgets.field import Editing
from tests.app.operator import FROZEN
from tests.app.pilots import app_on, at_rest, loaded, until

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
        await app.on_event(Key("7", "7"))
        page = app.desk.page
        assert isinstance(page, FormPage)
        assert page.editing == Editing.of("7")


@pytest.mark.parametrize("behind", [Key("s", "s"), Paste("s")])
async def test_what_comes_behind_the_key_that_leaves_does_nothing(tmp_path: Path, behind: Event) -> None:
    path = tmp_path / "p.toml"
    path.write_text(example("pocket").read_text())
    app = CutcompApp(opened(path), FROZEN, Engine(limit=inf))
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("enter", "tab", "tab", "tab", "9", "enter")
        assert app.desk.session.unsaved
        for message in (Key("ctrl+q", None), Key("l", "l"), behind):
            app.post_message(message)
        await until(pilot, lambda: app.return_code is not None)
        desk = app.desk
        app.key("s", "s")
        app.paste("s")
        assert app.desk is desk
    assert path.read_text() == example("pocket").read_text()
