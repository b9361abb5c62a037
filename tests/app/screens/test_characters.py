"""The drawings of all screens use the character set of the terminal or the chosen one."""

from __future__ import annotations

from textual.geometry import Region
from textual.widget import Widget

from app.app import CutcompApp
from app.widgets.drawing import Drawing
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator, session_on


async def test_an_ascii_terminal_gets_ascii_on_every_screen():
    app = CutcompApp(session_on("pocket"), surroundings=SURROUNDINGS, character_sets=("ascii",))
    async with Operator.of(app) as user:
        for action in ("draw", "lookahead", "program", "home"):
            await app.run_action(f"app.{action}")
            await user.settle()
            assert {drawing.characters for drawing in app.screen.query(Drawing)} == {"ascii"}, action


async def test_a_chosen_character_set_applies_at_once():
    async with operator() as user:
        await user.press("f7", "m")
        assert user.screen.query_one("#full-drawing", Drawing).characters == "block"


async def test_signs_change_with_the_characters_on_the_screen_in_front():
    async with operator("pocket", size=(132, 43)) as user:
        for action in ("contour", "draw", "lookahead", "program"):
            await user.app.run_action(f"app.{action}")
            await user.settle()
            assert _signs(user) & set("✖▲×✓"), action
            for _ in range(2):
                await user.app.run_action("app.next_characters")
                await user.settle()
            assert user.app.characters == "ascii"
            assert not _signs(user), action
            await user.app.run_action("app.next_characters")
            await user.app.run_action("app.contour")
            await user.settle()


def _signs(user: Operator) -> set[str]:
    """The signs on the screen that belong only to the first character set."""
    shown = [widget for widget in user.screen.walk_children(Widget) if widget.display and not widget.children]
    rows = [row for widget in shown for row in widget.render_lines(Region(0, 0, *widget.size))]
    return {sign for row in rows for sign in row.text} & set("✖▲×✓")
