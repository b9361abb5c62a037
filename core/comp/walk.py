"""The walk over the events of a chain: the pieces that cross others, and the joints that do not hold.

What is left of a piece is a range of distances along it and all crossings are known, so that the walk only compares
numbers.  Pieces at which nothing happens are never visited.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from typing import Final, cast

import numpy as np
from numpy.typing import NDArray

from core.comp.crossings import Crossings
from core.comp.offset import Chain, Part
from core.geometry.intersect import Indices, planes
from core.geometry.path import Floats
from core.tolerance import ON_PATH

_NOBODY: Final = -1
_GONE: Final = b"\1"


@dataclass(frozen=True, eq=False, slots=True)
class Left:
    """What is left of the chain's m pieces while the walk goes on; the arrays change under it.

    `low`, `high` (m,) bound what is left along each piece, infinite where its end is whole; `starts` (m,) are the
    points where pieces start, `standing` (m,) is 0 for bridges that a joint has replaced, `gone` (m,) 1 for pieces
    that were deleted.
    """

    low: Floats
    high: Floats
    starts: NDArray[np.complex128]
    standing: NDArray[np.uint8]
    gone: bytearray


def _numbers(values: Floats) -> memoryview[float]:
    """The same numbers, quicker to read and write one by one than the array."""
    return cast("memoryview[float]", values.data)


class Walk:
    """One walk along a chain whose inside corners are trimmed at their first crossings already."""

    def __init__(self, chain: Chain, left: Left, joints: Crossings, others: Crossings, *, last_wins: bool) -> None:
        self._chain, self._left, self._joints, self._last_wins = chain, left, joints, last_wins
        self._low, self._high, self._others = _numbers(left.low), _numbers(left.high), others
        self._a = others.a.data
        self._along_a, self._along_b = _numbers(others.along_a), _numbers(others.along_b)
        self._a_ends = cast("memoryview[bool]", others.a_ends.data)
        self._b_ends = cast("memoryview[bool]", others.b_ends.data)
        self._events: list[int] = []

    def visit(self, unsettled: Indices) -> list[int]:
        """Visit in order all pieces with crossings and the unsettled ones; the crossings that deleted, in order."""
        pieces = np.union1d(self._others.b, unsettled)
        begin = np.searchsorted(self._others.b, pieces).tolist()
        end = np.searchsorted(self._others.b, pieces, "right").tolist()
        follower = _NOBODY
        for piece, first, last in zip(pieces.tolist(), begin, end, strict=True):
            while _NOBODY < follower < piece:
                follower = self._arrive(follower, 0, 0)
            follower = self._arrive(piece, first, last)
        while follower > _NOBODY:
            follower = self._arrive(follower, 0, 0)
        return self._events

    def _arrive(self, piece: int, first: int, last: int) -> int:
        """Join a piece to its predecessor, test it by crossings first ... last - 1.

        Returns the next piece if its joint with this one no longer lies on what is left of it.
        """
        before = piece - 2
        if before >= 0 and self._high[before] < self._low[before] - ON_PATH:
            self._join(piece)
        for row in range(first, last):
            if self._is_left(piece, row):
                self._meet(piece, row)
                break
        return piece + 2 if self._high[piece] < self._low[piece] - ON_PATH else _NOBODY

    def _join(self, piece: int) -> None:
        """Trim predecessor and piece at another of their crossings that is left, else let the bridge stand."""
        before, joints, left = piece - 2, self._joints, self._left
        if self._chain.parts[piece - 1] != Part.BRIDGE.value:
            return
        first = bisect_left(joints.b.data, piece)
        rows = [row for row in range(first, min(first + 2, len(joints))) if joints.b[row] == piece]
        rows = [row for row in rows if joints.along_a[row] >= self._low[before] - ON_PATH]
        if not rows:
            left.standing[piece - 1] = 1
            self._high[before], self._low[piece] = np.inf, 0.0
            left.starts[piece] = planes(self._chain.raw.points)[piece]
            return
        row = rows[-1 if self._last_wins else 0]
        self._high[before], self._low[piece] = joints.along_a[row], joints.along_b[row]
        left.starts[piece] = joints.points[row]

    def _is_left(self, piece: int, row: int) -> bool:
        """Does a crossing lie on what is left of both pieces?  One's very end at the other's very start is none."""
        a = self._a[row]
        if self._left.gone[a]:
            return False
        at, on, low, high, start = self._along_a[row], self._along_b[row], self._low[a], self._high[a], self._low[piece]
        if at < low - ON_PATH or at > high + ON_PATH or on < start - ON_PATH:
            return False
        if on <= start + ON_PATH and (self._a_ends[row] or at >= high - ON_PATH):
            return False
        return not (self._b_ends[row] and at <= low + ON_PATH)

    def _meet(self, piece: int, row: int) -> None:
        """End the earlier piece and start the later one at their crossing; delete everything between."""
        a = self._a[row]
        self._high[a], self._low[piece] = self._along_a[row], self._along_b[row]
        self._left.starts[piece] = self._others.points[row]
        self._left.gone[a + 1 : piece] = _GONE * (piece - a - 1)
        self._events.append(row)
