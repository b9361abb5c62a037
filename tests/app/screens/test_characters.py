"""The drawings of all screens use the character set of the terminal or the chosen one."""

from __future__ import annotations

import pytest
from textual.geometry import Region
from textual.widget import Widget

from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.session.session import Session
from app.widgets.drawing import Drawing
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator


@pytest.mark.parametrize("action", ["draw", "lookahead", "program", "home"])
async def test_an_ascii_terminal_gets_ascii_on_every_screen(action):
    app = CutcompApp(Session.of(load(example("pocket"))), surroundings=SURROUNDINGS, character_sets=("ascii",))
    async with app.run_test(size=(80, 24)) as pilot:
        user = Operator(app, pilot)
        await user.settle()
        await app.run_action(f"app.{action}")
        await user.settle()
        assert {drawing.characters for drawing in app.screen.query(Drawing)} == {"ascii"}


async def test_a_chosen_character_set_applies_at_once():
    async with operator() as user:
        await user.press("f7", "m")
        assert user.screen.query_one("#full-drawing", Drawing).characters == "block"


@pytest.mark.parametrize("action", ["form", "draw", "lookahead", "program"])
async def test_signs_change_with_the_characters_on_the_screen_in_front(action):
    async with operator("pocket", size=(132, 43)) as user:
        if action != "form":
            await user.app.run_action(f"app.{action}")
            await user.settle()
        assert _signs(user) & set("✖▲×✓")
        for _ in range(2):
            await user.app.run_action("app.next_characters")
            await user.settle()
        assert user.app.characters == "ascii"
        assert not _signs(user)


def _signs(user: Operator) -> set[str]:
    """The signs on the screen that belong only to the first character set."""
    shown = [widget for widget in user.screen.walk_children(Widget) if widget.display and not widget.children]
    rows = [row for widget in shown for row in widget.render_lines(Region(0, 0, *widget.size))]
    return {sign for row in rows for sign in row.text} & set("✖▲×✓")
