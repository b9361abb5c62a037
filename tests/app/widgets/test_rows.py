"""Lists on a terminal too small for them."""

from __future__ import annotations

import pytest
from textual.widget import Widget

from app.screens.palette import Palette
from app.widgets.findings_list import FindingsList
from tests.app.widget_pilot import operator


@pytest.mark.parametrize(
    ("key", "size", "expected"), [("f10", (20, 5), FindingsList), ("ctrl+k", (1, 1), Palette)], ids=["f10", "ctrl+k"]
)
async def test_page_keys_in_a_list_without_room_do_not_end_the_program(
    key: str, size: tuple[int, int], expected: type[Widget]
) -> None:
    async with operator() as user:
        await user.press(key)
        await user.pilot.resize_terminal(*size)
        await user.press("pagedown", "pageup", "down", "pagedown")
        await user.pilot.resize_terminal(80, 24)
        await user.press("pageup")
        assert expected in (type(user.app.screen), type(user.app.focused))
