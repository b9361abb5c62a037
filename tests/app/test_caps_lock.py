"""Caps Lock may be on: every letter key also works as a capital."""

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
    """The letters of each key binding of the program, by class and action."""
    letters_by_binding: dict[str, set[str]] = {}
    for module in pkgutil.walk_packages(app.__path__, "app."):
        for member in vars(importlib.import_module(module.name)).values():
            if isinstance(member, type) and issubclass(member, DOMNode) and member.__module__.startswith("app."):
                letters_by_binding |= {
                    f"{member.__name__} {binding.action}": letters_of(binding)
                    for binding in vars(member).get("BINDINGS", ())
                }
    return {name: letters for name, letters in letters_by_binding.items() if letters}


def test_every_bound_letter_is_also_bound_as_a_capital() -> None:
    bindings = bound()
    assert len(bindings) > 10
    for name, letters in bindings.items():
        assert letters == {letter.swapcase() for letter in letters}, name


async def test_a_capital_n_steps_through_the_findings_on_draw():
    async with operator("pocket") as user:
        await user.press("f7", "N")
        assert isinstance(user.screen, DrawScreen)
        first = user.screen.query_one(Drawing).heading
        await user.press("N")
        assert user.screen.query_one(Drawing).heading != first
