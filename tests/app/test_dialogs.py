"""Dialogs: what is typed into them, and what they keep away from the program behind them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.messages import Close, Open
from app.painted.screens.decide import Decide
from app.painted.screens.help import HelpPage
from app.painted.screens.new_segment import NewSegment
from app.painted.screens.page import UNANSWERED
from app.painted.screens.post import PostPage
from app.painted.session import Session
from core.program.model import Number
from tests.app.operator import Operator


def gouging() -> Operator:
    """An operator before a path that gouges: it is posted if the words are said."""
    from core.pipeline.derive import derive

    program = load(example("notch"))
    return Operator(Desk(Session.of(program)).knowing(derive(program)))


def refused() -> Operator:
    """The dialog of POST NC, a wrong sentence behind it."""
    operator = gouging().press("f8", "f6", "enter").type("POST ANYWAY")
    assert "Nothing was written" in operator.said
    return operator


def sentence(operator: Operator) -> str:
    line = next(line for line in operator.part("body").splitlines() if line.startswith(" SAY"))
    return line.removeprefix(" SAY").strip()


def test_typing_replaces_a_wrong_sentence() -> None:
    assert sentence(refused().press(*"POST")) == "POST"


@pytest.mark.parametrize("key", ["delete", "backspace"])
def test_delete_and_backspace_empty_a_wrong_sentence(key: str) -> None:
    assert sentence(refused().press(key)) == ""


def test_the_softkey_post_asks_for_the_sentence_as_enter_does() -> None:
    operator = gouging().press("f8", "f6", "f1")
    assert isinstance(operator.desk.page, PostPage)
    assert operator.desk.page.path is not None


@pytest.mark.parametrize("keys", [("f8", "f6"), ("ctrl+s",), ("ctrl+q",), ("pagedown",)])
def test_undo_and_redo_in_a_dialog_leave_the_program_alone(keys: tuple[str, ...]) -> None:
    operator = Operator.at().press("tab", "down", "down", "down").type("2.5").press("ctrl+home", *keys)
    page = operator.desk.page
    operator.press("ctrl+z", "ctrl+y", "ctrl+z")
    assert operator.block.x_start == Number(2.5)
    assert operator.desk.page is page
    assert "Esc leaves this question first" in operator.said


@pytest.mark.parametrize("keys", [("ctrl+s",), ("pagedown",), ("f4", "right")])
@pytest.mark.parametrize("over", ["ctrl+g", "ctrl+f"])
def test_undo_and_redo_over_a_dialog_leave_the_program_alone(keys: tuple[str, ...], over: str) -> None:
    operator = Operator.at().press("tab", "down", "down", "down").type("2.5").press("ctrl+home", *keys, over)
    operator.press("ctrl+z")
    assert operator.said.endswith(("Esc goes back first: what this changes is not seen here.", UNANSWERED))
    operator.press("ctrl+y", "ctrl+z")
    assert operator.block.x_start == Number(2.5)


def test_leaving_says_in_one_meaning_of_the_word_what_becomes_of_the_work() -> None:
    operator = Operator.at().press("tab", "9", "ctrl+q")
    assert operator.part("body").split("\n")[3:] == [
        "  S   SAVE AND LEAVE",
        "  L   LEAVE UNSAVED",
        "  Esc back, nothing changes",
    ]
    assert "F2 LEAVE UNSAVED" in operator.part("softkeys")
    assert "It was never saved: leaving unsaved gives it all up." in operator.part("body")
    assert operator.press("l").desk.exit


def test_the_new_page_closes_before_undo_acts() -> None:
    operator = Operator.at().press("tab", "down", "down", "down").type("2.5").press("ctrl+home", "pagedown")
    assert isinstance(operator.desk.page, NewSegment)
    assert operator.press("escape", "ctrl+z").block.x_start is None


@pytest.mark.parametrize("keys", [("f3", "escape"), ("f7", "f3", "escape"), ("enter", "f8")])
def test_the_first_softkeys_stand_whenever_the_list_is_seen_again(keys: tuple[str, ...]) -> None:
    operator = Operator.at().press("f8", "f7")
    assert "DELETE BLOCK" not in operator.part("softkeys")
    assert "DELETE BLOCK" in operator.press(*keys).part("softkeys")


@pytest.mark.parametrize("keys", [("ctrl+s",), ("f5",)])
def test_a_question_mark_in_the_first_place_of_a_text_asks_for_help(keys: tuple[str, ...]) -> None:
    operator = Operator.at().press(*keys, "?")
    assert isinstance(operator.desk.page, HelpPage)
    operator.press("escape", "a", "?")
    assert not isinstance(operator.desk.page, HelpPage)
    assert "a?" in "\n".join(operator.screen())


@pytest.mark.parametrize("question", [("f4", "right"), ("ctrl+q",)])
@pytest.mark.parametrize("over", [(), ("ctrl+g",)])
@pytest.mark.parametrize("key", ["ctrl+s", "ctrl+o"])
def test_nothing_is_saved_or_opened_before_a_question_is_answered(
    question: tuple[str, ...], over: tuple[str, ...], key: str, tmp_path: Path
) -> None:
    operator = Operator.at().press("tab", "down", "down", "down").type("2.5").press("ctrl+home")
    file = tmp_path / "part.toml"
    operator.desk = replace(operator.desk, session=replace(operator.session, file=file))
    operator.press(*question, *over)
    pages = operator.desk.pages
    operator.press(key)
    assert operator.said == "!! Answer the question first."
    assert operator.desk.pages == pages
    assert not file.exists()


def test_a_question_without_a_way_around_is_answered_before_anything_else() -> None:
    operator = Operator.at().press("tab", "down", "down", "down").type("2.5")
    question = Decide("WORK THAT WAS NOT SAVED", (), (("k", "KEEP", (Close(),)),))
    operator.desk = operator.desk.take(Open(question))
    for key in ("ctrl+s", "ctrl+o", "ctrl+z", "ctrl+y"):
        assert operator.press(key).said == "!! Answer the question first."
    assert operator.desk.page is question
    assert operator.block.x_start == Number(2.5)
