"""Caps Lock may be on: a letter that does something does it as a capital too."""

from __future__ import annotations

import importlib
import pkgutil

from textual.binding import Binding
from textual.dom import DOMNode

import app
from app.screens.draw import DrawScreen
from app.widgets.drawing import Drawing
from tests.app.widget_pilot import operator


def letters_of(binding: object) -> set[str]:
    keys = binding.key.split(",") if isinstance(binding, Binding) else []
    return {key for key in keys if len(key) == 1 and key.isalpha()}


def bound() -> dict[str, set[str]]:
    """The letters of each binding of the program, by its class and its action."""
    found: dict[str, set[str]] = {}
    for module in pkgutil.walk_packages(app.__path__, "app."):
        for each in vars(importlib.import_module(module.name)).values():
            if isinstance(each, type) and issubclass(each, DOMNode) and each.__module__.startswith("app."):
                found |= {f"{each.__name__} {one.action}": letters_of(one) for one in vars(each).get("BINDINGS", ())}
    return {name: letters for name, letters in found.items() if letters}


def test_every_letter_is_bound_as_a_capital_too() -> None:
    found = bound()
    assert len(found) > 10
    for name, letters in found.items():
        assert letters == {letter.swapcase() for letter in letters}, name


async def test_capitals_go_from_finding_to_finding_on_draw():
    async with operator("pocket") as user:
        await user.press("f7", "N")
        assert isinstance(user.screen, DrawScreen)
        first = user.screen.query_one(Drawing).heading
        await user.press("N")
        assert user.screen.query_one(Drawing).heading != first
