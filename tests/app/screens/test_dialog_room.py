"""Dialogs fit on the smallest terminal: nothing is cut off."""

from __future__ import annotations

from textual.widgets import OptionList

from app.documents.questions import Answer
from app.screens.dialogs import Question
from core.program.model import Number
from tests.app.widget_pilot import operator


async def test_a_question_with_many_lines_shows_all_its_answers_at_60x20() -> None:
    lines = ["part.toml was changed by somebody else, 23:37 today.", *(f"difference {number}" for number in range(11))]
    answers = [
        Answer("YOURS", "the other one is kept under another name"),
        Answer("THEIRS", f"saved as {'x' * 33}.toml"),
    ]
    async with operator("pocket", (60, 20)) as user:
        user.app.push_screen(Question("CHANGED MEANWHILE", lines, answers, "GO BACK"))
        await user.settle()
        box, options = user.app.screen.query_one("#question"), user.app.screen.query_one(OptionList)
        assert box.region.height <= 20
        assert options.region.bottom < box.region.bottom, "the answers are cut off"
        assert options.region.height >= 3


async def test_the_second_line_of_an_answer_begins_below_its_word() -> None:
    answers = [
        Answer("DISCARD", "kept as a backup; Ctrl+O lists it"),
        Answer("KEEP BOTH", "yours is saved as left-hand-jaw.mine-2025-03-04-140509.toml"),
    ]
    async with operator("pocket") as user:
        user.app.push_screen(Question("UNSAVED WORK FOUND", ["No name, 1 edit."], answers, "GO BACK"))
        await user.settle()
        options = user.app.screen.query_one(OptionList)
        rows = ["".join(segment.text for segment in options.render_line(y)).rstrip() for y in range(5)]
        assert rows == [
            " D   DISCARD, kept as a backup; Ctrl+O lists",
            "     it",
            " K   KEEP BOTH, yours is saved as",
            "     left-hand-jaw.mine-2025-03-04-140509.toml",
            " Esc GO BACK, nothing changes",
        ]


async def test_a_too_small_terminal_is_reported_and_takes_numbers() -> None:
    async with operator("pocket", (40, 12)) as user:
        await user.press("tab")
        assert user.prompt == "Window is 40x12; it needs 60x20."
        await user.press("7", "enter")
        assert user.session.block.tool == Number(7.0)
        await user.pilot.resize_terminal(60, 20)
        await user.press("tab")
        assert "Window is" not in user.prompt


async def test_the_key_for_characters_explains_why_there_is_only_ascii() -> None:
    async with operator("pocket") as user:
        user.app.character_sets = ("ascii",)
        await user.app.run_action("app.next_characters")
        assert user.prompt.startswith("LANG or TERM says that there is no UTF-8")


async def test_keys_and_resizes_are_harmless_while_a_dialog_closes() -> None:
    async with operator("pocket") as user:
        question = Question("LEAVE?", ["part is not saved."], [Answer("DISCARD", "")], "GO BACK")
        user.app.push_screen(question)
        await user.settle()
        await question.query_one("#question").remove()
        await user.pilot.resize_terminal(70, 22)
        await user.press("d")
        assert not question.readable
