"""Esc, then a digit, presses a softkey on terminals without function keys."""

from __future__ import annotations

import pytest

from app.screens import form_screen
from app.screens.parameters import ParametersScreen
from app.screens.tools import ToolsScreen
from core.program.model import Number
from tests.app.widget_pilot import Operator

pytestmark = pytest.mark.asyncio(loop_scope="module")


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wait long enough for a busy machine."""
    monkeypatch.setattr(form_screen, "SOFTKEY_WAIT", 60.0)


async def test_esc_then_a_digit_presses_the_softkey(user: Operator) -> None:
    await user.press("tab", "escape")
    assert user.prompt == "1 to 8 press the softkey now, as F1 to F8 do."
    await user.press("4")
    assert isinstance(user.screen, ParametersScreen)
    await user.press("f8", "escape", "6")
    assert isinstance(user.screen, ToolsScreen)
    await user.press("f8", "6", "enter")
    assert user.session.block.tool == Number(6.0), "a digit that pressed a softkey is not typed later"


async def test_a_digit_after_another_key_is_typed(user: Operator) -> None:
    await user.press("tab", "7", "escape")
    assert user.prompt == "The old number is back. Esc again, then 1 to 8, presses a softkey."
    await user.press("6", "enter")
    assert user.session.block.tool == Number(6.0), "Esc that removes a half-typed number arms no softkey"
    await user.press("escape", "tab", "4", "enter")
    assert user.session.block.finish_tool == Number(4.0)


async def test_a_digit_after_the_waiting_time_is_typed(user: Operator, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(form_screen, "SOFTKEY_WAIT", 0.01)
    await user.press("tab", "escape")
    await user.pilot.pause(0.1)
    await user.press("4", "enter")
    assert user.session.block.tool == Number(4.0)


async def test_esc_after_an_unreadable_text_restores_the_old_value(user: Operator) -> None:
    before = user.session.block.x_start
    assert isinstance(user.screen, form_screen.FormScreen)
    user.screen.focus_field("x_start")
    await user.press("1", "a", "5", "enter")
    assert user.tag("x_start") == "ERR"
    await user.press("escape")
    assert user.session.block.x_start == before
    assert user.at == "x_start"
    assert user.prompt == "The old number is back. Esc again, then 1 to 8, presses a softkey."
    await user.press("3", "enter")
    assert user.session.block.x_start == Number(3.0)


async def test_esc_on_an_older_unreadable_text_keeps_the_later_edits(user: Operator) -> None:
    assert isinstance(user.screen, form_screen.FormScreen)
    user.screen.focus_field("x_start")
    await user.press("1", "a", "5", "enter", "tab", "3", "tab", "shift+tab", "shift+tab", "escape")
    assert user.prompt == "1 to 8 press the softkey now, as F1 to F8 do."
    assert user.session.block.y_start == Number(3.0)


async def test_esc_brings_back_the_last_number_that_can_be_used(user: Operator):
    await user.begin("pocket", 0, "tool")
    before = user.session.program
    await user.press("'0", "enter", "'x", "enter")
    assert user.tag("tool") == "ERR"
    await user.press("escape")
    assert user.prompt == "The old number is back. Esc again, then 1 to 8, presses a softkey."
    assert (user.value("tool"), user.tag("tool")) == ("1", "")
    assert user.session.program == before
    # text that was unusable before stays
    await user.press("'x", "enter")
    broken = user.session.program
    await user.begin(broken, 0, "tool")
    await user.press("'y", "enter", "escape")
    assert user.session.program == broken
