"""The set of characters that a terminal has, or that was chosen, holds for the drawing of every screen."""

from __future__ import annotations

import pytest

from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.session.session import Session
from app.widgets.drawing import Drawing
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator


@pytest.mark.parametrize("action", ["draw", "lookahead", "program", "home"])
async def test_a_terminal_of_ascii_gets_ascii_on_every_screen(action):
    app = CutcompApp(Session.of(load(example("pocket"))), surroundings=SURROUNDINGS, character_sets=("ascii",))
    async with app.run_test(size=(80, 24)) as pilot:
        one = Operator(app, pilot)
        await one.settle()
        await app.run_action(f"app.{action}")
        await one.settle()
        assert {drawing.characters for drawing in app.screen.query(Drawing)} == {"ascii"}


async def test_another_set_is_taken_up_at_once_where_it_is_chosen():
    async with operator() as one:
        await one.press("f7", "m")
        assert one.screen.query_one("#full-drawing", Drawing).characters == "block"
