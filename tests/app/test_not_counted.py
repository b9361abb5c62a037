"""While a text that is no number stands in a field, the prompt says whose path and verdict are shown."""

from __future__ import annotations

import pytest

from app.documents.files import load
from app.documents.programs import example
from tests.app.operator import Operator


def on_x_end() -> Operator:
    """The pocket's first LINE, X END 4.0000 under the cursor."""
    return Operator.at(load(example("pocket"))).press("right", "tab")


def prompt(operator: Operator) -> str:
    return " ".join(operator.part("prompt").split())


@pytest.mark.parametrize(("keys", "told"), [("-", "-"), ("-.x", "-.x"), ("1/", "1/")])
def test_half_a_number_does_not_count(keys: str, told: str) -> None:
    operator = on_x_end().press(*keys)
    assert prompt(operator) == f"{told} does not count: path and verdict are still those of 4.0000."


def test_nor_does_a_field_that_was_emptied() -> None:
    operator = on_x_end().press("backspace")
    assert prompt(operator) == "A blank does not count before Enter: path and verdict are still those of 4.0000."


@pytest.mark.parametrize("keys", ["4", "3.5", "1 1/2"])
def test_a_number_is_tried_and_nothing_is_said(keys: str) -> None:
    operator = on_x_end().press(*("space" if key == " " else key for key in keys))
    assert "count" not in prompt(operator)


def test_a_diameter_of_nothing_does_not_count() -> None:
    operator = Operator.at(load(example("pocket"))).press("f6", "tab", "tab", "0", ".", "0")
    assert prompt(operator) == "0.0 does not count: path and verdict are still those of 0.5000."
    assert "count" not in prompt(operator.press("5"))


def test_in_a_blank_field_the_verdict_is_that_of_before() -> None:
    operator = on_x_end().press(
        "tab", "backspace", "enter", "shift+tab", "shift+tab", "backspace", "enter", "shift+tab", "-"
    )
    assert prompt(operator) == "- does not count: path and verdict are still those of before."


def test_in_a_field_that_keeps_its_coordinate_the_verdict_is_that_of_the_coordinate() -> None:
    operator = on_x_end().press("backspace", "enter", "shift+tab", "-")
    assert prompt(operator) == "- does not count: path and verdict are still those of 2.0000."


def test_what_is_marked_already_says_why() -> None:
    operator = on_x_end().press(*"-.x", "enter", "-")
    assert "cannot be read" in prompt(operator)
