"""TOOL SETUP without a tool: no key ends the program."""

from __future__ import annotations

from tests.app.widget_pilot import operator

KEYS = ("tab", "down", "shift+tab", "up", "enter", "escape", "f1", "home", "end", "pagedown", "7", "space")


async def test_keys_on_an_empty_tool_table() -> None:
    async with operator("pocket") as at:
        await at.press("f6")
        while at.session.program.tools:
            await at.press("f1")
        for key in KEYS:
            await at.press(key)
            if key == "escape":
                await at.press("f6")
        await at.press("f2")
        assert len(at.session.program.tools) == 1


async def test_a_coolant_that_is_undone_is_blank_again() -> None:
    """On a screen that was opened with the coolant, whose list has a blank line then too."""
    async with operator("pocket") as at:
        await at.press("f6", "shift+tab", "right", "f8", "f6")
        coolant = at.session.program.tools[-1].coolant
        assert coolant is not None
        await at.press("ctrl+z")
        assert at.session.program.tools[-1].coolant is None
        await at.press("ctrl+y")
        assert at.session.program.tools[-1].coolant is coolant
        await at.press("ctrl+home", "shift+tab", "space", "home", "enter")
        assert at.session.program.tools[-1].coolant is None
