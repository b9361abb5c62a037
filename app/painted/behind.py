"""Work behind the screens: one thread at a time, and of what is asked for meanwhile only the last is done."""

from __future__ import annotations

from asyncio import get_running_loop
from collections.abc import Callable
from contextlib import suppress
from contextvars import copy_context
from dataclasses import dataclass
from functools import partial
from time import sleep
from typing import Final, Generic, TypeVar

from textual.app import App

Result = TypeVar("Result")
AFTER: Final = 0.001
"""Seconds in which what has just been painted goes out, before a thread calculates beside the one that sends it."""


def in_thread(work: Callable[[], Callable[[], None]]) -> None:
    """Do this in a thread of the loop's own, behind the key and its picture; what it returns is called in this one.

    Textual's workers tell of each of their states and come back by way of two other tasks, which takes as long again
    as all else between a table and its picture.
    """
    loop, context = get_running_loop(), copy_context()

    def later() -> None:
        sleep(AFTER)
        loop.call_soon_threadsafe(work(), context=context)

    def begin() -> None:
        # a program that has just been left has no threads any more
        with suppress(RuntimeError):
            loop.run_in_executor(None, later)

    loop.call_soon(begin)


def raised(error: BaseException) -> None:
    """For the App's queue: it ends of the error and shows it."""
    raise error


@dataclass(slots=True)
class Behind(Generic[Result]):
    """A desk for one kind of work; `done` is called in the App's own thread with what came of it.

    `doing` is what the work under way is about.  Work that raises ends the program with its error.  `begin` has the
    work done, and called what it returns.
    """

    app: App[int]
    done: Callable[[Result], None]
    waiting: tuple[Callable[[], Result], object] | None = None
    busy: bool = False
    doing: object = None
    begin: Callable[[Callable[[], Callable[[], None]]], None] = in_thread

    def ask(self, work: Callable[[], Result], about: object = None) -> None:
        """Have this done, in place of what was asked for and not begun."""
        self.waiting = work, about
        if not self.busy:
            self._begin()

    def forget(self) -> None:
        """What was asked for and not begun is not wanted any more."""
        self.waiting = None

    def _begin(self) -> None:
        if self.waiting is None:
            return
        (work, self.doing), self.waiting = self.waiting, None
        self.busy = True
        self.begin(lambda: self._run(work))

    def _run(self, work: Callable[[], Result]) -> Callable[[], None]:
        try:
            return partial(self._finished, work())
        except BaseException as error:  # noqa: BLE001  # raised again in the App
            return partial(self._failed, error)

    def _failed(self, error: BaseException) -> None:
        # whoever waits for this desk meanwhile must not wait for ever
        self._over()
        if not self._left:
            self.app.call_later(raised, error)

    @property
    def _left(self) -> bool:
        """The program has been left, and waits for nothing but its threads."""
        return self.app.return_code is not None

    def _over(self) -> None:
        self.busy, self.doing = False, None

    def _finished(self, result: Result) -> None:
        self._over()
        if self._left:
            return
        try:
            self.done(result)
        except Exception as error:  # noqa: BLE001  # raised again in the App
            self._failed(error)
        else:
            self._begin()
