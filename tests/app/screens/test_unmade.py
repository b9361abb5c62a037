"""Messages and progress for a screen that is still being composed do not end the program."""

from __future__ import annotations

from app.screens.base import BaseScreen
from app.screens.contour import ContourScreen
from app.session.work import Work
from tests.app.widget_pilot import operator


async def test_a_message_to_a_screen_being_composed_does_not_end_the_program() -> None:
    async with operator("pocket") as user:
        form = user.app.screen
        for action in ("home", "tools", "draw", "post", "program", "save_as", "lookahead"):
            await user.app.run_action(f"app.{action}")
            screen = user.app.screen
            assert isinstance(screen, BaseScreen)
            assert screen is not form, action
            screen.show_work(Work(lambda: None))
            screen.say("Something.")
            await user.settle()
            assert user.app.is_running, action
            await user.app.run_action("app.contour")
            await user.settle()


async def test_progress_for_a_form_that_is_not_composed_does_not_end_the_program() -> None:
    """On a busy machine the first calculation lasts long before the form is there."""
    async with operator("pocket") as user:
        user.app.push_screen(form := ContourScreen())
        form.show_work(Work(lambda: None))
        await user.settle()
        assert user.app.is_running
