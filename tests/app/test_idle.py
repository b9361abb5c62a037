"""An idle terminal gets no bytes: no input cursor blinks."""

from __future__ import annotations

import pytest
from textual.widgets import Input

from tests.app.widget_pilot import operator


@pytest.mark.parametrize(
    "action",
    ["save_as", "open_path", "post", "sheet", "import_tools", "command_palette", "shift_block", "repeat_rotated"],
)
async def test_no_input_cursor_blinks(action: str) -> None:
    async with operator("pocket") as user:
        await user.app.run_action(f"app.{action}")
        await user.settle()
        lines = list(user.app.screen.query(Input))
        assert lines
        assert not any(line.cursor_blink for line in lines)
