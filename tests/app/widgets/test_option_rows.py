"""Lists on a terminal that has no room for them."""

from __future__ import annotations

import pytest

from app.screens.palette import Palette
from app.widgets.findings_list import FindingsList
from tests.app.widget_pilot import operator


@pytest.mark.parametrize(("key", "size"), [("f10", (20, 5)), ("ctrl+k", (1, 1))])
async def test_a_page_in_a_list_without_room_is_no_step(key: str, size: tuple[int, int]) -> None:
    async with operator() as user:
        await user.press(key)
        await user.pilot.resize_terminal(*size)
        await user.press("pagedown", "pageup", "down", "pagedown")
        await user.pilot.resize_terminal(80, 24)
        await user.press("pageup")
        assert isinstance(user.app.screen, Palette) or isinstance(user.app.focused, FindingsList)
