"""How NC PROOF looks, at 80x24 and at 132x43."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from textual.pilot import Pilot

from app.documents.nc_text import NcText
from app.painted.application import CutcompApp
from app.painted.screens.proof import ProofPage
from tests.app.pilots import app_on, loaded, rested
from tests.tool_tables import end_mills

DATA = Path(__file__).parents[1] / "data"
SCREENS = {
    "proof": ("nc/threeblock-square.nc", "threeblock", ("down", "down")),
    "proof_findings": ("nc/threeblock-square.nc", "threeblock", ("tab", "down")),
    "proof_typing": ("nc/rosettacnc-window.ngc", "rosettacnc:normal", ("down", "down", "i", "G", "1")),
    "proof_compare": ("nc/threeblock-outside.nc", "threeblock", ("v", "down")),
    "proof_tool": ("nc/threeblock-square.nc", "threeblock", ("t",)),
    "proof_large": ("klartext/part.h", "klartext", ("d", "n")),
}


def app(file: str, control: str) -> CutcompApp:
    """The App on a program under proof, with a half-inch tool 1."""
    path = DATA / file
    page = ProofPage.of(NcText.read(path.read_bytes()), Path(path.name), control=control, alone=True)
    page = replace(page, asked=replace(page.asked, tools=end_mills({1: 0.5})))
    made = app_on()
    made.desk = replace(made.desk, pages=(page,))
    return made


@pytest.mark.parametrize("size", [(80, 24), (132, 43)], ids=["80x24", "132x43"])
@pytest.mark.parametrize("name", SCREENS)
def test_screen(name: str, size: tuple[int, int], snap_compare: Callable[..., Any]) -> None:
    file, control, keys = SCREENS[name]

    async def to_the_screen(pilot: Pilot[int]) -> None:
        await loaded(pilot)
        for key in keys:
            await pilot.press(key)
        await rested(pilot)

    assert snap_compare(app(file, control), terminal_size=size, run_before=to_the_screen)


async def test_an_answer_from_a_thread_arrives() -> None:
    made = app("nc/threeblock-square.nc", "threeblock")
    made.engine.limit = 0.0
    async with made.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        for key in ("c", "c", "C", "C"):
            await pilot.press(key)
        for _ in range(100):
            page = made.desk.page
            if isinstance(page, ProofPage) and page.fresh:
                break
            await pilot.pause(0.05)
        assert isinstance(page, ProofPage)
        assert page.fresh
        assert page.told.answer.control == "threeblock"
