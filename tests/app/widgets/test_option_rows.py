"""Lists on a terminal too small for them."""

from __future__ import annotations

import pytest

from app.screens.palette import Palette
from app.widgets.findings_list import FindingsList
from tests.app.widget_pilot import operator


@pytest.mark.parametrize(("key", "size"), [("f10", (20, 5)), ("ctrl+k", (1, 1))])
async def test_page_keys_in_a_list_without_room_do_not_end_the_program(key: str, size: tuple[int, int]) -> None:
    async with operator() as user:
        await user.press(key)
        await user.pilot.resize_terminal(*size)
        await user.press("pagedown", "pageup", "down", "pagedown")
        await user.pilot.resize_terminal(80, 24)
        await user.press("pageup")
        assert isinstance(user.app.screen, Palette) or isinstance(user.app.focused, FindingsList)
