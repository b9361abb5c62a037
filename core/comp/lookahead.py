"""Look-ahead: the calculated value (CAL), the range of typed values (USR), the recommended one; `prune` applies it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Protocol

from core.tolerance import JOINED

MIN_LOOKAHEAD: Final = 1
"""The smallest look-ahead an operator may type."""

MAX_LOOKAHEAD: Final = 20
"""The largest look-ahead an operator may type."""

_LARGEST_CALCULATED: Final = 8


def calculated(count: int, *, closed: bool) -> int:
    """Return the CAL value for `count` segments, START not counted (LOOK_AHEAD.md).

    Closed: count - 1, at least 3.  Open: count - 3, at least 2.  Never more than 8.
    """
    wanted, least = (count - 1, 3) if closed else (count - 3, 2)
    return min(max(wanted, least), _LARGEST_CALCULATED)


class LookaheadOutcome(Protocol):
    """The effect of one look-ahead value on a contour: lengths in millimeters."""

    @property
    def value(self) -> int:
        """The look-ahead value."""

    @property
    def clean(self) -> bool:
        """True if its path gouges nothing."""

    @property
    def uncut(self) -> float:
        """Length of surface that it leaves uncut."""


def recommended(outcomes: Sequence[LookaheadOutcome]) -> int | None:
    """Return the smallest of the clean values that leave the least uncut; None if no value is clean."""
    clean = [outcome for outcome in outcomes if outcome.clean]
    least = min((outcome.uncut for outcome in clean), default=0.0)
    return min((outcome.value for outcome in clean if outcome.uncut <= least + JOINED), default=None)
