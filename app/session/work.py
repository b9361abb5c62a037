"""Work: what a thread is working out, how far it is, and whether it is to stop."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic
from typing import Final

from core.progress import Stopped

SHOWN_AFTER: Final = 0.3
"""Seconds after which it is shown how far a piece of work is."""
STOPS_AFTER: Final = 1.0
"""Seconds after which Esc stops it."""


@dataclass(eq=False, slots=True)
class Work:
    """One piece of work; the thread calls it with the part that is done, the screen reads that and may stop it.

    `on_stop` tells whoever waits for the result that there is none.
    """

    on_stop: Callable[[], None]
    begun: float = field(default_factory=monotonic)
    done: float = 0.0
    stopped: bool = False

    def __call__(self, done: float) -> None:
        """Tell the part that is done, 0 to 1; raises Stopped where nobody waits for the rest."""
        if self.stopped:
            raise Stopped
        self.done = done

    @property
    def long(self) -> bool:
        """It takes long enough for it to be shown how far it is."""
        return monotonic() - self.begun >= SHOWN_AFTER

    @property
    def stoppable(self) -> bool:
        """It takes so long that Esc stops it."""
        return monotonic() - self.begun >= STOPS_AFTER

    @property
    def text(self) -> str:
        """How far it is, and from when on Esc stops it."""
        stops = ", Esc stops" if self.stoppable else ""
        return f"working {round(100 * min(self.done, 1.0))} %{stops}"
