"""An operator at the widget screens: keys go in; fields and sentences come out."""

from __future__ import annotations

import unicodedata
from asyncio import sleep
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from time import monotonic
from typing import Any, Final, Self
from weakref import WeakSet

from textual.app import App
from textual.events import Key
from textual.keys import KEY_NAME_REPLACEMENTS, REPLACED_KEYS
from textual.message_pump import MessagePump
from textual.pilot import Pilot
from textual.screen import ModalScreen, Screen
from textual.worker import WorkerCancelled

from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.screens.base import BaseScreen
from app.session.session import Session
from app.terminal.key_order import KeyOrder
from app.widgets.field import FieldRow
from app.widgets.status import Prompt, Surroundings
from core.program.edit import FormPlace
from core.program.model import Program

QUIET_ROUNDS = 4
"""A wait ends after this many idle rounds; work deferred until after a repaint arrives in the next round."""
PAINTING_ROUND = 2
"""The idle round that paints: until then, what it paints may change again."""
ROUND = 0.005
"""Seconds between two looks at a worker that is not waited for to its end."""
PAINTED_AT_REST: Final[WeakSet[App[Any]]] = WeakSet()
"""Apps whose screens an operator paints."""
UNPAINTED: Final[WeakSet[Screen[Any]]] = WeakSet()
"""Screens that an operator paints once everything is at rest."""
_PAINT: Final = Screen._compositor_refresh
SURROUNDINGS = Surroundings(lambda: "12:00", lambda: 23 * 10**9)


def key_event(key: str) -> Key:
    """The event of a key, by its Textual name or by what it types: "minus" and "-" are the same key."""
    if len(key) == 1:
        name = key if key.isalnum() else unicodedata.name(key).lower().replace("-", "_").replace(" ", "_")
        return Key(KEY_NAME_REPLACEMENTS.get(name, name), key)
    try:
        return Key(key, unicodedata.lookup(REPLACED_KEYS.get(key, key).replace("_", " ").replace("hyphen ", "hyphen-")))
    except KeyError:
        return Key(key, None)


def session_on(start: str | Program) -> Session:
    """An example by its name, or a program."""
    return Session.of(load(example(start)), title=start) if isinstance(start, str) else Session.of(start)


def paint_at_rest(screen: Screen[Any]) -> None:
    """Leave the painting to the operator: a screen is laid out several times as it opens."""
    if screen.app in PAINTED_AT_REST:
        UNPAINTED.add(screen)
    else:
        _PAINT(screen)


class Operator:
    """Presses keys and reads the screen."""

    calculating: tuple[str, ...] = ("derive", "table")
    """The groups of workers that are waited for to their end."""
    patience = 0.5
    """Seconds that `settle` waits for other workers."""

    def __init__(self, app: CutcompApp, pilot: Pilot[int]) -> None:
        self.app, self.pilot = app, pilot

    @classmethod
    @asynccontextmanager
    async def of(cls, app: CutcompApp, size: tuple[int, int] = (80, 24)) -> AsyncIterator[Self]:
        """Start the program, and end it before it closes, as QUIT does: later results from threads are dropped."""
        PAINTED_AT_REST.add(app)
        async with app.run_test(size=size) as pilot:
            user = cls(app, pilot)
            await user.settle()
            try:
                yield user
            finally:
                if app.is_running:
                    app.exit()

    async def press(self, *keys: str) -> None:
        """Press keys and wait for what they start; "'1.25" is typed letter by letter."""
        await self.send(*keys)
        await self.settle()

    async def begin(self, start: str | Program, segment: int = 0, field: str = "segment") -> None:
        """Show the form of another example or program, with the cursor on a field of its first block."""
        self.app._uncover(0)
        self.app.switch_session(session_on(start).at(FormPlace(1, segment), field))
        await self.settle()
        assert self.at == field

    async def send(self, *keys: str) -> None:
        """Press keys in order, as the driver passes them on, and wait until they are taken, not for their work."""
        await sleep(0)
        if self._busy():
            await self.pilot.pause(0)
        order = KeyOrder(self.app)
        for key in keys:
            for name in key[1:] if key.startswith("'") else (key,):
                order.take(key_event(name))
                while order.busy:
                    await sleep(0)

    async def settle(self) -> None:
        """Wait for the calculations in threads, until every widget waits for a message, and paint what has changed.

        Other workers than those that calculate may wait for an answer or a hanging disk: they get only `patience`,
        and only while no question is in front.
        """
        rounds, patience = 0, monotonic() + self.patience
        # a program that has ended, even by a fault, has nothing to wait for
        while rounds < QUIET_ROUNDS and self.app.is_running:
            working = [worker for worker in self.app.workers if worker.group in self.calculating]
            others = len(self.app.workers) > len(working) and not isinstance(self.app.screen, ModalScreen)
            if working:
                # one is canceled when another replaces it
                with suppress(WorkerCancelled):
                    await self.app.workers.wait_for_complete(working)
            else:
                others = others and monotonic() < patience
            busy = self._busy()
            if not busy:
                # as the pilot does: without waiting for the next frame
                self.app.screen._on_timer_update()
                if rounds == PAINTING_ROUND and self.app.screen in UNPAINTED:
                    UNPAINTED.discard(self.app.screen)
                    _PAINT(self.app.screen)
            await sleep(ROUND if others and not busy else 0)
            rounds = 0 if working or others or busy or self._busy() else rounds + 1

    async def finish(self) -> None:
        """Wait for every worker, including those that draw, post and advise, and for what they start."""
        for _ in range(2):
            for worker in list(self.app.workers):
                # one is canceled when another replaces it
                with suppress(WorkerCancelled):
                    await worker.wait()
            await self.settle()

    def _busy(self) -> bool:
        """Whether a widget has a message left or handles one: else its task waits at its queue."""
        pumps: list[MessagePump] = [self.app, *self.app.screen.walk_children(with_self=True)]
        queues: list[Any] = [pump._message_queue for pump in pumps]
        return any(queue.values or not queue.ready_event._waiters for queue in queues)

    @property
    def screen(self) -> BaseScreen:
        """The screen in front."""
        assert isinstance(self.app.screen, BaseScreen)
        return self.app.screen

    @property
    def session(self) -> Session:
        """The session."""
        return self.app.session

    @property
    def prompt(self) -> str:
        """The sentence on the prompt line."""
        return self.screen.query_one(Prompt).sentence.text

    @property
    def at(self) -> str:
        """The name of the field with the cursor."""
        return "" if self.app.focused is None else self.app.focused.name or ""

    def row(self, name: str) -> FieldRow:
        """The row of a displayed field."""
        rows = [row for row in self.screen.query(FieldRow) if row.cell.name == name and row.parent.parent.display]
        assert len(rows) == 1, (name, rows)
        return rows[0]

    def value(self, name: str) -> str:
        """The displayed value of a field."""
        widget: Any = self.row(name).input
        return self.row(name).cell.text if widget is None else str(widget.value)

    def tag(self, name: str) -> str:
        """The tag of a field."""
        return self.row(name).cell.tag


@asynccontextmanager
async def operator(start: str | Program = "pocket", size: tuple[int, int] = (80, 24)) -> AsyncIterator[Operator]:
    """An operator with an example or a program on the form."""
    async with Operator.of(CutcompApp(session_on(start), surroundings=SURROUNDINGS), size) as user:
        yield user
