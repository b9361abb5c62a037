"""A screen that is still being made: what is said, and how far work is, ends nothing."""

from __future__ import annotations

from app.screens.base import BaseScreen
from app.session.work import Work
from tests.app.widget_pilot import operator


async def test_what_is_said_to_it_ends_nothing() -> None:
    async with operator("pocket") as at:
        form = at.app.screen
        for action in ("home", "tools", "draw", "post", "program", "save_as", "lookahead"):
            await at.app.run_action(f"app.{action}")
            screen = at.app.screen
            assert isinstance(screen, BaseScreen)
            assert screen is not form, action
            screen.show_work(Work(lambda: None))
            screen.say("Something.")
            await at.settle()
            assert at.app.is_running, action
            await at.app.run_action("app.contour")
            await at.settle()
