"""TOOL SETUP: a number that is refused is as easily mended as one in error on START."""

from __future__ import annotations

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.screens.tools import ToolsPage
from tests.app.operator import Operator


def refused(text: str = "0") -> Operator:
    """An operator whose number for tool 1 was not taken; there is a tool 2."""
    operator = Operator.at(load(example("pocket"))).press("f6", "f2", "up", "shift+tab", "shift+tab")
    page = operator.desk.page
    assert isinstance(page, ToolsPage)
    assert (page.row, page.name) == (0, "number")
    return operator.press("delete", *text, "enter")


def numbers(operator: Operator) -> list[int]:
    return [tool.number for tool in operator.session.program.tools]


def first_row(operator: Operator) -> list[str]:
    return operator.part("body").splitlines()[2].split()


@pytest.mark.parametrize("text", ["0", "", "2", "1.5", "x"])
def test_typing_replaces_a_refused_number(text: str) -> None:
    operator = refused(text)
    assert "Esc brings 1 back, F1 deletes tool 1." in operator.said
    operator.press("3")
    assert first_row(operator)[0] == "3"
    operator.press("enter")
    assert numbers(operator) == [2, 3]


def test_a_refused_number_is_marked_and_stays_until_it_is_mended() -> None:
    operator = refused()
    assert first_row(operator)[:2] == ["0", "ERR"]
    for key in ("enter", "down", "f8", "f2"):
        assert first_row(operator.press(key))[:2] == ["0", "ERR"]
        assert "from 1 to 9999" in operator.said
    assert first_row(operator.press("?", "escape"))[0] in ("0", "1")


@pytest.mark.parametrize("key", ["backspace", "delete"])
def test_backspace_and_delete_empty_a_refused_number(key: str) -> None:
    operator = refused("20000").press(key, "7", "enter")
    assert numbers(operator) == [2, 7]


def test_the_arrows_take_a_refused_number_to_change_it() -> None:
    assert numbers(refused("0").press("left", "4", "enter")) == [2, 40]


@pytest.mark.parametrize("text", ["0", "2"])
def test_what_the_prompt_says_of_delete_tool_is_so(text: str) -> None:
    operator = refused(text).press("f1")
    assert numbers(operator) == [2]
    assert operator.said == "Deleted tool 1. Ctrl+Z brings it back."
    assert numbers(operator.press("ctrl+z")) == [1, 2]


def test_what_the_prompt_says_of_escape_is_so() -> None:
    operator = refused().press("escape")
    assert first_row(operator)[0] == "1"
    assert numbers(operator.press("9", "enter")) == [2, 9]


def test_delete_tool_still_waits_for_a_number_that_nobody_has_judged() -> None:
    operator = refused().press("escape", "0", "f1")
    assert numbers(operator) == [1, 2]
    assert "F1 deletes tool 1" in operator.said
    assert numbers(operator.press("f1")) == [2]
