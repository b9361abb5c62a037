"""TOOL SETUP without a tool: no key ends the program."""

from __future__ import annotations

from tests.app.widget_pilot import operator

KEYS = ("tab", "down", "shift+tab", "up", "enter", "escape", "f1", "home", "end", "pagedown", "7", "space")


async def test_no_key_on_an_empty_tool_table_ends_the_program() -> None:
    async with operator("pocket") as user:
        await user.press("f6")
        while user.session.program.tools:
            await user.press("f1")
        for key in KEYS:
            await user.press(key)
            if key == "escape":
                await user.press("f6")
        await user.press("f2")
        assert len(user.session.program.tools) == 1


async def test_undoing_a_coolant_blanks_it() -> None:
    """The screen was opened with the coolant set; its list has a blank entry all the same."""
    async with operator("pocket") as user:
        await user.press("f6", "shift+tab", "right", "f8", "f6")
        coolant = user.session.program.tools[-1].coolant
        assert coolant is not None
        await user.press("ctrl+z")
        assert user.session.program.tools[-1].coolant is None
        await user.press("ctrl+y")
        assert user.session.program.tools[-1].coolant is coolant
        await user.press("ctrl+home", "shift+tab", "space", "home", "enter")
        assert user.session.program.tools[-1].coolant is None
