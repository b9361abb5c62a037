"""WorkActions shows the progress of long work on the status line and stops it on Esc."""

from __future__ import annotations

from collections.abc import Callable

from textual.app import App
from textual.timer import Timer

from app.screens.base import BaseScreen
from app.session.work import SHOWN_AFTER, Work


class WorkActions(App[int]):
    """The App's part for long work in threads."""

    _works: tuple[Work, ...] = ()
    _work_timer: Timer | None = None

    def begin_work(self, on_stop: Callable[[], None]) -> Work:
        """Register work that starts in a thread; `on_stop` is called if Esc stops it."""
        work = Work(on_stop)
        self._works = (*self._works, work)
        if self._work_timer is None:
            self._work_timer = self.set_interval(SHOWN_AFTER, self.show_work)
        return work

    def end_work(self, work: Work | None) -> None:
        """End work that is done or no longer needed; a running thread stops at its next report.  Ignore None."""
        if work is None:
            return
        work.stopped = True
        self._works = tuple(each for each in self._works if each is not work)
        if not self._works and self._work_timer is not None:
            self._work_timer.stop()
            self._work_timer = None
            self.show_work()

    @property
    def longest_work(self) -> Work | None:
        """The work that has run longest, if it has run long enough to be shown."""
        return next((work for work in self._works if work.long), None)

    def show_work(self) -> None:
        """Show the progress of the longest work on the screen in front."""
        for screen in self.screen_stack[-1:]:
            if isinstance(screen, BaseScreen):
                screen.show_work(self.longest_work)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Let Esc stop work only if some has run long enough; otherwise Esc goes to the screen."""
        if action == "stop_work":
            return any(work.stoppable for work in self._works)
        return super().check_action(action, parameters)

    def action_stop_work(self) -> None:
        """Stop all work that has run long enough."""
        for work in self._works:
            if work.stoppable:
                self.end_work(work)
                work.on_stop()
        self.show_work()
