"""An idle terminal gets no bytes: no input cursor blinks."""

from __future__ import annotations

from textual.widgets import Input

from tests.app.widget_pilot import operator

ACTIONS = ("save_as", "open_path", "post", "sheet", "import_tools", "command_palette", "shift_block", "repeat_rotated")
"""All that open a line to type in."""


async def test_no_input_cursor_blinks() -> None:
    async with operator("pocket") as user:
        for action in ACTIONS:
            await user.app.run_action(f"app.{action}")
            await user.settle()
            lines = list(user.app.screen.query(Input))
            assert lines, action
            assert not any(line.cursor_blink for line in lines), action
            await user.press("escape")
