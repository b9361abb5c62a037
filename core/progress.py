"""Progress: long calculations report how far they are, and can be stopped."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float], None]
"""Takes the share of the work that is done, from 0 to 1; raises Stopped if the rest is no longer needed."""


class Stopped(Exception):
    """The work was canceled because its result is no longer needed."""


def silent(_: float) -> None:
    """Ignore progress: the default."""


def part(progress: Progress, first: float, last: float) -> Progress:
    """Return the progress function of a part of the work that goes from `first` to `last` of the whole."""
    return lambda done: progress(first + (last - first) * done)
