"""Work behind the screens: one thread at a time, and of what is asked for meanwhile only the last is done."""

from __future__ import annotations

from collections.abc import Callable
from time import sleep
from typing import Final, Generic, TypeVar

from textual.app import App

from core.records import dataclass

Result = TypeVar("Result")
AFTER: Final = 0.001
"""Seconds in which what has just been painted goes out, before a thread calculates beside the one that sends it."""


@dataclass(slots=True)
class Behind(Generic[Result]):
    """A desk for one kind of work; `done` is called in the App's own thread with what came of it.

    `doing` is what the work under way is about.  Work that raises ends the program with its error.
    """

    app: App[int]
    done: Callable[[Result], None]
    waiting: tuple[Callable[[], Result], object] | None = None
    busy: bool = False
    doing: object = None

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
        self.app.run_worker(lambda: self._run(work), thread=True)

    def _run(self, work: Callable[[], Result]) -> None:
        sleep(AFTER)
        try:
            result = work()
        except BaseException:
            # the App ends of it and shows it; whoever waits for this desk meanwhile must not wait for ever
            self._over()
            raise
        self.app.call_from_thread(self._finished, result)

    def _over(self) -> None:
        self.busy, self.doing = False, None

    def _finished(self, result: Result) -> None:
        self._over()
        self.done(result)
        self._begin()
