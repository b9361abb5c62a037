"""The App itself under a pilot, with clock and memory frozen and everything calculated before the next picture."""

from __future__ import annotations

from asyncio import sleep
from collections.abc import Callable, Iterable
from math import inf
from pathlib import Path

from textual.pilot import Pilot

from app.documents.files import load
from app.documents.programs import empty_program, example
from app.painted.application import CutcompApp
from app.painted.engine import Engine
from app.painted.session import Session
from app.painted.widgets.painted import Rows
from app.painted.widgets.rows import text_of
from core.program.model import Program
from tests.app.operator import FROZEN


def app_on(program: Program | str | None = None) -> CutcompApp:
    """The App on a program, on an example by its name, or on an empty program."""
    if isinstance(program, str):
        return CutcompApp(Session.of(load(example(program)), Path(f"{program}.toml")), FROZEN, Engine(limit=inf))
    return CutcompApp(Session.of(program or empty_program()), FROZEN, Engine(limit=inf))


async def loaded(pilot: Pilot[int]) -> None:
    """Wait until the numeric library is there and the first verdict stands."""
    app = pilot.app
    assert isinstance(app, CutcompApp)
    for _ in range(500):
        if app.engine.ready:
            return
        await pilot.pause(0.02)
    raise AssertionError("the numeric library did not come")


async def rested(pilot: Pilot[int]) -> None:
    """Wait until no thread calculates any more, and what they found stands."""
    app = pilot.app
    assert isinstance(app, CutcompApp)
    while any(desk.busy for desk in app.behind):
        await sleep(0.001)
    await pilot.pause()


async def typed(pilot: Pilot[int], texts: Iterable[str]) -> None:
    """Texts, each followed by Enter."""
    for text in texts:
        await pilot.press(*text, "enter")


async def until(pilot: Pilot[int], true: Callable[[], bool]) -> None:
    """Wait for what follows a key."""
    for _ in range(1000):
        if true():
            return
        await pilot.pause(0.01)
    raise AssertionError("it never came")


async def at_rest(pilot: Pilot[int], app: CutcompApp) -> None:
    """Nothing is calculated any more."""
    await until(pilot, lambda: not (app.advice.tabling.busy or app.advice.noting.busy or app.advice.needing.busy))
    await pilot.pause()


def lines(app: CutcompApp) -> str:
    return "\n".join(text_of(row) for row in app.screen.query_one(Rows).rows)
