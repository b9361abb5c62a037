"""A dialog has room on the smallest terminal: nothing of it is cut off."""

from __future__ import annotations

from textual.widgets import OptionList

from app.documents.questions import Answer
from app.screens.dialogs import Question
from core.program.model import Number
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


async def test_a_terminal_that_is_too_small_says_so_and_takes_numbers() -> None:
    async with operator("pocket", (40, 12)) as at:
        await at.press("tab")
        assert at.prompt == "Window is 40x12; it needs 60x20."
        await at.press("7", "enter")
        assert at.session.block.tool == Number(7.0)
        await at.pilot.resize_terminal(60, 20)
        await at.press("tab")
        assert "make it" not in at.prompt


async def test_where_there_is_only_ascii_the_key_for_characters_says_why() -> None:
    async with operator("pocket") as at:
        at.app.character_sets = ("ascii",)
        await at.app.run_action("app.next_characters")
        assert at.prompt.startswith("LANG or TERM says that there is no UTF-8")


async def test_keys_and_sizes_that_come_while_a_dialog_leaves_do_no_harm() -> None:
    async with operator("pocket") as at:
        question = Question("LEAVE?", ["part is not saved."], [Answer("DISCARD", "")], "GO BACK")
        at.app.push_screen(question)
        await at.settle()
        await question.query_one("#question").remove()
        await at.pilot.resize_terminal(70, 22)
        await at.press("d")
        assert not question.readable
