"""Pictures of the start screen and of the guide at 80x24."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from textual.pilot import Pilot

from app.painted.application import CutcompApp
from app.painted.guide import begin
from app.painted.screens.program import ProgramPage
from app.painted.screens.start import Entry, Group, StartPage
from app.painted.survey import Facts
from app.painted.widgets.rows import Look
from tests.app.pilots import app_on, loaded, rested

SHOP = Path("/shop")
FACTS = (
    Facts(SHOP / "bracket.toml", (1, 1), "2026-01-02", "2", "1 3", "clean", Look.GOOD),
    Facts(SHOP / "cover.toml", (1, 1), "2025-12-30", "1", "1", "GOUGE", Look.ERROR),
    Facts(SHOP / "notes.toml", (1, 1), "2025-11-05", word="unreadable", trouble="notes.toml: no program."),
)


def start() -> StartPage:
    """The start screen in a shop's folder, everything known of its files."""
    files = [Entry(Group.FOLDER, one.path, one.path.stem) for one in FACTS]
    entries = (
        Entry(Group.RECENT, FACTS[0].path, "bracket"),
        Entry(Group.FOLDER, SHOP.parent, "..", folder=True),
        *files,
        Entry(Group.FOLDER, SHOP / "old", "old", folder=True),
    )
    return StartPage(SHOP, entries, first=True, row=3, facts={one.path: one for one in FACTS})


async def at_start(pilot: Pilot[int]) -> None:
    await loaded(pilot)
    app = pilot.app
    assert isinstance(app, CutcompApp)
    app.desk = replace(app.desk, pages=(ProgramPage(), start()))
    app.refresh_screen()
    await pilot.pause()


async def guided(pilot: Pilot[int]) -> None:
    await loaded(pilot)
    app = pilot.app
    assert isinstance(app, CutcompApp)
    app.desk = begin(app.desk)
    await pilot.press("enter", "enter", "l", "tab", "tab", "1", "enter", "0", "enter", "0", "enter")
    await pilot.press(*"-.25", "enter", "pagedown")


@pytest.mark.parametrize("screen", [at_start, guided])
def test_picture(screen: Callable[[Pilot[int]], Any], snap_compare: Callable[..., Any]) -> None:
    assert snap_compare(app_on(), terminal_size=(80, 24), run_before=screen)


async def test_verdicts_come_by_themselves_behind_the_screen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from app.painted.starting import begun

    monkeypatch.chdir(tmp_path)
    app = app_on()
    app.desk = begun(app.desk)
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        for _ in range(100):
            await rested(pilot)
            page = app.desk.page
            assert isinstance(page, StartPage)
            if page.wanted is None:
                break
        assert isinstance(page, StartPage)
        assert {facts.path.stem: facts.word for facts in page.facts.values()} == {
            "flange": "clean",
            "notch": "GOUGE",
            "overrun-square": "clean",
            "plate-mm": "clean",
            "pocket": "uncut",
        }
