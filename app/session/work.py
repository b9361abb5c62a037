"""Work tracks a calculation in a thread: its progress, and whether it is to stop."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic
from typing import Final

from textual.worker import get_current_worker

from core.progress import Progress, Stopped

SECONDS_BEFORE_PROGRESS: Final = 0.3
"""Seconds after which the progress of work is shown."""
SECONDS_BEFORE_STOP: Final = 1.0
"""Seconds after which Esc stops work."""


@dataclass(eq=False, slots=True)
class Work:
    """One piece of work; the thread calls it with the fraction done, the screen reads that and may stop it.

    `on_stop` is called when Esc stops the work, so that nothing waits for the result.
    """

    on_stop: Callable[[], None]
    begun: float = field(default_factory=monotonic)
    done: float = 0.0
    stopped: bool = False

    def __call__(self, done: float) -> None:
        """Record the fraction done, 0 to 1; raise Stopped if the work has been stopped."""
        if self.stopped:
            raise Stopped
        self.done = done

    @property
    def long(self) -> bool:
        """True if the work has run long enough for its progress to be shown."""
        return monotonic() - self.begun >= SECONDS_BEFORE_PROGRESS

    @property
    def stoppable(self) -> bool:
        """True if the work has run long enough for Esc to stop it."""
        return monotonic() - self.begun >= SECONDS_BEFORE_STOP

    @property
    def text(self) -> str:
        """The progress, and whether Esc stops the work."""
        stops = ", Esc stops" if self.stoppable else ""
        return f"working {round(100 * min(self.done, 1.0))} %{stops}"


def while_wanted() -> Progress:
    """Return a progress callback that raises Stopped once the current worker is canceled."""
    worker = get_current_worker()

    def check(_: float) -> None:
        if worker.is_cancelled:
            raise Stopped

    return check
