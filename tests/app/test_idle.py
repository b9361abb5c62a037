"""A terminal at rest gets no bytes: no cursor of any line blinks."""

from __future__ import annotations

import pytest
from textual.widgets import Input

from tests.app.widget_pilot import operator


@pytest.mark.parametrize(
    "action",
    ["save_as", "open_path", "post", "sheet", "import_tools", "command_palette", "shift_block", "repeat_rotated"],
)
async def test_no_cursor_blinks(action: str) -> None:
    async with operator("pocket") as at:
        await at.app.run_action(f"app.{action}")
        await at.settle()
        lines = list(at.app.screen.query(Input))
        assert lines
        assert not any(line.cursor_blink for line in lines)
