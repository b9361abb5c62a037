"""Progress: how long work tells how far it is, and how it is stopped."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float], None]
"""Told the part of the work that is done, from 0 to 1; raises Stopped where nobody waits for the rest."""


class Stopped(Exception):
    """The work was canceled: nobody waits for it any more."""


def silent(_: float) -> None:
    """The default: progress is told to nobody."""


def part(progress: Progress, first: float, last: float) -> Progress:
    """The progress of a part of the work, which goes from `first` to `last` of the whole."""
    return lambda done: progress(first + (last - first) * done)
