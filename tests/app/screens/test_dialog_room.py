"""A dialog has room on the smallest terminal: nothing of it is cut off."""

from __future__ import annotations

from textual.widgets import OptionList

from app.screens.dialogs import Answer, Question
from tests.app.widget_pilot import operator


async def test_a_question_with_many_lines_shows_all_its_answers_at_60x20() -> None:
    lines = ["part.toml was changed by somebody else at 23:37.", *(f"difference {number}" for number in range(11))]
    answers = [
        Answer("YOURS", "the other one is kept under another name"),
        Answer("THEIRS", f"saved as {'x' * 33}.toml"),
    ]
    async with operator("pocket", (60, 20)) as at:
        at.app.push_screen(Question("CHANGED MEANWHILE", lines, answers, "GO BACK"))
        await at.settle()
        box, listed = at.app.screen.query_one("#question"), at.app.screen.query_one(OptionList)
        assert box.region.height <= 20
        assert listed.region.bottom < box.region.bottom, "the answers are cut off"
        assert listed.region.height >= 3
