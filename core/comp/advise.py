"""Which look-ahead value to recommend, given what each one does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from core.tolerance import JOINED


class Outcome(Protocol):
    """What one look-ahead value does to a contour: lengths in millimeters."""

    @property
    def value(self) -> int:
        """The look-ahead value."""

    @property
    def clean(self) -> bool:
        """Whether its path gouges nothing."""

    @property
    def uncut(self) -> float:
        """Length of surface it leaves."""


def recommended(outcomes: Sequence[Outcome]) -> int | None:
    """The clean value that leaves least uncut, of those the smallest; None when no value is clean."""
    clean = [(outcome.uncut, outcome.value) for outcome in outcomes if outcome.clean]
    if not clean:
        return None
    least, _ = min(clean)
    return min(value for uncut, value in clean if uncut <= least + JOINED)
