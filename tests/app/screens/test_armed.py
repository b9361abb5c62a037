"""Esc, then a digit: the softkey, for terminals without function keys."""

from __future__ import annotations

import pytest

from app.screens import form_screen
from app.screens.parameters import ParametersScreen
from app.screens.tools import ToolsScreen
from core.program.model import Number
from tests.app.widget_pilot import operator


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Time enough for a busy machine."""
    monkeypatch.setattr(form_screen, "SOFTKEY_WAIT", 60.0)


async def test_esc_then_a_digit_is_the_softkey() -> None:
    async with operator("pocket") as at:
        await at.press("tab", "escape")
        assert at.prompt == "1 to 8 press the softkey now, as F1 to F8 do."
        await at.press("4")
        assert isinstance(at.screen, ParametersScreen)


async def test_another_key_in_between_makes_the_digit_a_digit() -> None:
    async with operator("pocket") as at:
        await at.press("tab", "escape", "tab", "tab", "4", "enter")
        assert at.session.block.finish_tool == Number(4.0)


async def test_after_the_time_it_is_a_digit(monkeypatch: pytest.MonkeyPatch) -> None:
    async with operator("pocket") as at:
        monkeypatch.setattr(form_screen, "SOFTKEY_WAIT", 0.01)
        await at.press("tab", "escape")
        await at.pilot.pause(0.1)
        await at.press("4", "enter")
        assert at.session.block.tool == Number(4.0)


async def test_esc_that_takes_a_half_typed_number_back_arms_nothing() -> None:
    async with operator("pocket") as at:
        await at.press("tab", "7", "escape")
        assert at.prompt == "The old number is back. Esc again, then 1 to 8, is a softkey."
        await at.press("6", "enter")
        assert at.session.block.tool == Number(6.0)


async def test_an_armed_digit_is_not_typed_into_a_field_later() -> None:
    async with operator("pocket") as at:
        await at.press("tab", "escape", "6")
        assert isinstance(at.screen, ToolsScreen)
        await at.press("f8", "6", "enter")
        assert at.session.block.tool == Number(6.0)


async def test_esc_behind_what_cannot_be_read_takes_it_back() -> None:
    async with operator("pocket") as at:
        before = at.session.block.x_start
        at.screen.focus_field("x_start")  # type: ignore[attr-defined]
        await at.press("1", "a", "5", "enter")
        assert at.tag("x_start") == "ERR"
        await at.press("escape")
        assert at.session.block.x_start == before
        assert at.at == "x_start"
        assert at.prompt == "The old number is back. Esc again, then 1 to 8, is a softkey."
        await at.press("3", "enter")
        assert at.session.block.x_start == Number(3.0)


async def test_esc_on_what_could_not_be_read_long_ago_leaves_the_edits_behind_it() -> None:
    async with operator("pocket") as at:
        at.screen.focus_field("x_start")  # type: ignore[attr-defined]
        await at.press("1", "a", "5", "enter", "tab", "3", "tab", "shift+tab", "shift+tab", "escape")
        assert at.prompt == "1 to 8 press the softkey now, as F1 to F8 do."
        assert at.session.block.y_start == Number(3.0)
