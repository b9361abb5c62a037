"""A question that a small terminal has no room for waits: it says so, and no key answers it unread."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.painted.application import CutcompApp
from app.painted.desk import Desk
from app.painted.messages import Close, Open, Say
from app.painted.screens.ask import Ask
from app.painted.screens.decide import Decide
from app.painted.widgets.painted import Rows
from app.painted.widgets.rows import text_of
from tests.app.pilots import app_on

OPTIONS = (("l", "LOOK", (Close(), Say("looked"))), ("t", "TAKE OVER", (Close(), Say("taken"))))
LOCKED = Decide(
    "OPEN ALREADY",
    (
        "part.toml is open on another terminal, process 4711 of anna on mill-3, since 7:15.",
        "You can look at it and save a copy under another name. Or take it over: the other one is told before saving.",
    ),
    OPTIONS,
)
WAITS = "A question waits: make it larger to read and answer it."


def asked(question: Ask) -> CutcompApp:
    app = app_on("pocket")
    app.desk = app.desk.take(Open(question))
    return app


def text(app: CutcompApp) -> str:
    rows = app.screen.query_one(Rows).rows
    return " ".join(" ".join(text_of(row) for row in rows).split())


def asking(desk: Desk) -> bool:
    return isinstance(desk.page, Ask)


@pytest.mark.parametrize("size", [(1, 1), (20, 5), (30, 12), (79, 9), (132, 8)])
async def test_what_cannot_be_read_is_not_answered(size: tuple[int, int]) -> None:
    app = asked(LOCKED)
    async with app.run_test(size=size) as pilot:
        await pilot.press("l", "t", "f1", "f2", "enter", "ctrl+k", "1", "alt+1", "escape", "2", "?")
        app.paste("l")
        assert asking(app.desk)
        assert "LOOK" not in text(app) or "F1" not in text(app)
        if size[0] >= 20:
            assert WAITS in text(app)
        await pilot.resize_terminal(80, 24)
        await pilot.pause()
        assert WAITS not in text(app)
        assert "T TAKE OVER" in text(app)
        await pilot.press("l")
        assert not asking(app.desk)
        assert "looked" in text(app)


async def test_a_question_that_is_shown_whole_on_a_small_terminal_is_answered_there() -> None:
    app = asked(LOCKED)
    async with app.run_test(size=(40, 24)) as pilot:
        assert WAITS not in text(app)
        await pilot.press("t")
        assert "taken" in text(app)


async def test_one_can_go_back_from_it_unread_where_that_answers_nothing_and_leave() -> None:
    app = asked(Ask(LOCKED.title, LOCKED.lines, OPTIONS))
    async with app.run_test(size=(20, 5)) as pilot:
        await pilot.press("l")
        assert asking(app.desk)
        await pilot.press("escape")
        assert not asking(app.desk)
    app = asked(LOCKED)
    app.desk = replace(app.desk, session=replace(app.desk.session, saved=app.desk.session.program))
    async with app.run_test(size=(20, 5)) as pilot:
        await pilot.press("ctrl+q")
    assert app.return_code == 0
