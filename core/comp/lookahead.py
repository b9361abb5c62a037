"""Look-ahead: the calculated value (CAL) and the range of typed values (USR); `prune` applies it."""

from __future__ import annotations

from typing import Final

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
