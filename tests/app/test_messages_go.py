"""A message over the screen leaves no trace, whatever else changes as it disappears."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

import pytest

from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.session.session import Session
from tests.app.widget_pilot import SURROUNDINGS, Operator
from tests.terminal import Terminal, cutcomp, running

CTRL_L = b"\x0c"
WHOLE_SCREEN = 500
"""Bytes that a repaint of the screen takes at least."""
PATIENCE = 60.0
"""Seconds that a busy machine may take for a step."""


async def test_the_whole_screen_is_repainted_after_the_last_message(monkeypatch: pytest.MonkeyPatch) -> None:
    program = CutcompApp(Session.of(load(example("notch"))), surroundings=SURROUNDINGS)
    async with program.run_test(notifications=True) as pilot:
        painted: list[int] = []
        refresh = type(program.screen).refresh

        def noted(screen, *regions, **how):
            if not regions and not how:
                painted.append(len(screen.query("Toast")))
            return refresh(screen, *regions, **how)

        monkeypatch.setattr(type(program.screen), "refresh", noted)
        program.notify("Done.", timeout=0.5)
        program.notify("Done, too.", timeout=0.8)
        await pilot.pause(0.1)
        assert len(program.screen.query("Toast")) == 2
        painted.clear()
        deadline = monotonic() + 20.0
        while not painted and monotonic() < deadline:
            await pilot.pause(0.05)
        await pilot.pause(0.2)
        assert set(painted) == {0}


async def test_undo_takes_away_the_message_that_offers_it(monkeypatch: pytest.MonkeyPatch) -> None:
    notify = CutcompApp.notify
    # on a busy machine a key may take longer than the message stays
    monkeypatch.setattr(CutcompApp, "notify", lambda app, text, **how: notify(app, text, **{**how, "timeout": 60.0}))
    program = CutcompApp(Session.of(load(example("notch"))), surroundings=SURROUNDINGS)
    async with program.run_test(notifications=True, size=(80, 24)) as pilot:
        user = Operator(program, pilot)
        await user.settle()
        await user.press("pagedown", "f1")
        await toasts(user, 1)
        await user.press("ctrl+z")
        assert user.prompt.startswith("Undone: DELETE SEGMENT 1")
        await toasts(user, 0)


async def toasts(user: Operator, count: int) -> None:
    """Wait until this many messages are over the screen, for less time than they stay."""
    deadline = monotonic() + 20.0
    while len(user.app.screen.query("Toast")) != count and monotonic() < deadline:
        await user.pilot.pause(0.01)
    assert len(user.app.screen.query("Toast")) == count


async def test_an_ended_program_ignores_the_end_of_a_message() -> None:
    program = CutcompApp(Session.of(load(example("notch"))), surroundings=SURROUNDINGS)
    async with program.run_test(notifications=True):
        later: list[Callable[[], None]] = []
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(program, "set_timer", lambda _seconds, callback: later.append(callback))
            program.notify("Done.")
    assert not program.screen_stack
    assert len(later) == 1
    later[0]()


def test_a_list_closing_with_a_message_leaves_no_trace_of_it() -> None:
    with running(cutcomp("--example", "pocket")) as terminal:
        terminal.until("GOUGE none", longest=30.0)
        for keys, shown in ((b"\x1b[6~\x1b[6~", "of 11"), (b"\x1bOP", "Deleted segment"), (b"\x1b[21~", "FINDINGS ")):
            terminal.send(keys)
            terminal.until(shown)
        since = monotonic()
        while "Deleted segment" in terminal.text and monotonic() - since < 10.0:
            terminal.send(b"\x1b[21~")
            answered(terminal, len(terminal.seen))
        while terminal.read(quiet=1.0).count:
            pass
        before, count = terminal.text, len(terminal.seen)
        terminal.send(CTRL_L)
        answered(terminal, count + WHOLE_SCREEN)
        since = monotonic()
        while terminal.text != before and monotonic() - since < PATIENCE:
            terminal.read(quiet=0.1)
        assert terminal.text == before


def answered(terminal: Terminal, count: int) -> None:
    """Wait until the program has sent more than `count` bytes in all, and a moment for the rest."""
    since = monotonic()
    while len(terminal.seen) <= count:
        assert monotonic() - since < PATIENCE, terminal.text
        terminal.read(quiet=0.1, longest=0.5)
    terminal.read(quiet=0.4, longest=0.5)
