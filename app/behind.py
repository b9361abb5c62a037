"""Work behind the screens: one thread at a time, and of what is asked for meanwhile only the last is done."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

from textual.app import App

from core.records import dataclass

Result = TypeVar("Result")


@dataclass(slots=True)
class Behind(Generic[Result]):
    """A desk for one kind of work; `done` is called in the App's own thread with what came of it."""

    app: App[int]
    done: Callable[[Result], None]
    waiting: Callable[[], Result] | None = None
    busy: bool = False

    def ask(self, work: Callable[[], Result]) -> None:
        """Have this done, in place of what was asked for and not begun."""
        self.waiting = work
        if not self.busy:
            self._begin()

    def forget(self) -> None:
        """What was asked for and not begun is not wanted any more."""
        self.waiting = None

    def _begin(self) -> None:
        work, self.waiting = self.waiting, None
        if work is None:
            return
        self.busy = True
        self.app.run_worker(lambda: self._run(work), thread=True)

    def _run(self, work: Callable[[], Result]) -> None:
        self.app.call_from_thread(self._finished, work())

    def _finished(self, result: Result) -> None:
        self.busy = False
        self.done(result)
        self._begin()
