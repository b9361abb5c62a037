"""Every screen on every terminal, down to one cell."""

from __future__ import annotations

from itertools import product

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.engine import Engine
from app.painted.screens.frame import picture
from app.painted.session import Session
from app.painted.widgets.rows import text_of
from tests.app.operator import FROZEN, Operator

SCREENS = {
    "start": (),
    "line": ("1", "enter"),
    "arc": ("2", "enter", "tab"),
    "blend": ("4", "enter", "tab", "1", "."),
    "new": ("ctrl+end", "right"),
    "unreadable": ("tab", "tab", "tab", "tab", "1", ".", ".", "enter"),
    "missing tool": ("tab", "9", "enter"),
    "draw": ("f7", "+", "right"),
    "findings": ("f7", "f3"),
    "table": (*["tab"] * 11, "f4"),
    "tools": ("f6", "f2"),
    "setup": ("f5",),
    "parameters": ("f4",),
    "units": ("f4", "right"),
    "program": ("f8",),
    "post": ("tab", "9", "f8", "f6"),
    "post override": ("tab", "9", "f8", "f6", "enter"),
    "save as": ("ctrl+s", "x"),
    "leave": ("tab", "9", "ctrl+q"),
    "help": ("tab", "?"),
}
SIZES = [*product((1, 2, 5, 20, 40, 59, 79), (1, 2, 3, 5, 8, 12, 23)), (80, 24), (110, 24), (132, 43), (200, 60)]


@pytest.fixture(scope="module")
def engine() -> Engine:
    engine = Engine()
    engine.load(load(example("pocket")))
    engine.ready = True
    return engine


@pytest.mark.parametrize("name", SCREENS)
def test_a_screen_fills_every_terminal_exactly(name: str, engine: Engine) -> None:
    operator = Operator(Desk(Session.of(load(example("pocket"))))).press(*SCREENS[name])
    derived = engine.derive(operator.session.program, operator.session.derived)
    desk = operator.desk.knowing(derived)
    if desk.session.found.paths is not None:
        engine.keep_table(desk.session.found, desk.session.program)
    known = engine.known(desk.session.found, None)
    for width, height in SIZES:
        rows = picture(desk, known, FROZEN, width, height)
        assert [len(text_of(row)) for row in rows] == [width] * height


@pytest.mark.parametrize("name", SCREENS)
def test_at_the_native_size_no_sentence_runs_into_the_softkeys(name: str) -> None:
    operator = Operator(Desk(Session.of(load(example("pocket"))))).press(*SCREENS[name])
    assert all(line[58] == " " and line[59] == "│" for line in operator.screen()[:21])
