"""The walk over the events of a chain: the pieces that cross others, and the joints that do not hold.

What is left of a piece is a range of distances along it and all crossings are known, so that the walk only compares
numbers.  Pieces at which nothing happens are never visited.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain as one_by_one
from math import inf
from typing import Final, cast

import numpy as np
from numpy.typing import NDArray

from core.comp.crossings import Crossings
from core.comp.offset import Chain
from core.geometry.path import Floats, Rows, as_complex
from core.tolerance import ON_PATH

_GONE: Final = b"\1"
_STRETCH: Final = 4096


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


class Walk:
    """One walk along a chain whose inside corners are trimmed at their first crossings already."""

    def __init__(self, chain: Chain, left: Left, joints: Crossings, others: Crossings) -> None:
        self._chain, self._left, self._joints, self._others = chain, left, joints, others
        self._low, self._high = _numbers(left.low), _numbers(left.high)
        self._joint, self._along_a, self._along_b = joints.b.data, _numbers(joints.along_a), _numbers(joints.along_b)
        self._bridged: list[int] = []
        self._rejoined: list[int] = []

    def visit(self, unsettled: Rows) -> Rows:
        """Visit in order all crossings, and the joints of the `unsettled` pieces with their predecessors.

        Returns the rows of the crossings that deleted something, in order.
        """
        met = np.array(self._meet(unsettled.tolist()[::-1]), np.intp)
        left, joints, others = self._left, self._joints, self._others
        bridged, rejoined = np.array(self._bridged, np.intp), np.array(self._rejoined, np.intp)
        left.standing[bridged - 1] = 1
        left.starts[bridged] = as_complex(self._chain.raw.points)[bridged]
        left.starts[joints.b[rejoined]] = joints.points[rejoined]
        left.starts[others.b[met]] = others.points[met]
        return met

    def _meet(self, agenda: list[int]) -> list[int]:
        """Test every piece by its crossings: it takes the first that lies on what is left of both pieces.

        One's very end at the other's very start is no crossing.  The earlier piece then ends there, the later one
        starts there, everything between is gone.  `agenda` holds pieces whose joint is to be made anew, last first.
        """
        low, high, gone = self._low, self._high, self._left.gone
        met: list[int] = []
        piece, over = -1, True
        for row, (b, a, at, on, a_ends, b_ends) in enumerate(_rows(self._others)):
            if b != piece:
                if agenda and agenda[-1] <= b:
                    self._settle(b, agenda)
                piece, start, over = b, low[b], False
            if over or gone[a] or on < start - ON_PATH:
                continue
            first, last = low[a], high[a]
            if at < first - ON_PATH or at > last + ON_PATH or (b_ends and at <= first + ON_PATH):
                continue
            if on <= start + ON_PATH and (a_ends or at >= last - ON_PATH):
                continue
            high[a], low[b], over = at, on, True
            gone[a + 1 : b] = _GONE * (b - a - 1)
            met.append(row)
            if high[b] < on - ON_PATH:
                agenda.append(b + 2)
        self._settle(len(self._chain), agenda)
        return met

    def _settle(self, until: int, agenda: list[int]) -> None:
        """Join anew what no longer holds, up to the joint of piece `until` with its predecessor."""
        low, high = self._low, self._high
        while agenda and agenda[-1] <= until:
            piece = agenda.pop()
            start = low[piece - 2] - ON_PATH
            if high[piece - 2] < start:
                # at their other crossing, if they have one that is left, else by a bridge
                row = bisect_right(self._joint, piece) - 1
                along = self._along_a[row]
                if along >= start:
                    high[piece - 2], low[piece] = along, self._along_b[row]
                    self._rejoined.append(row)
                else:
                    high[piece - 2], low[piece] = inf, 0.0
                    self._bridged.append(piece)
            if piece < until and high[piece] < low[piece] - ON_PATH:
                agenda.append(piece + 2)


def _numbers(values: Floats) -> memoryview[float]:
    """The same numbers, quicker to read and write one by one than the array."""
    return cast("memoryview[float]", values.data)


def _rows(crossings: Crossings) -> Iterator[tuple[int, int, float, float, bool, bool]]:
    """The crossings' b, a, along_a, along_b, a_ends, b_ends one by one, made plain numbers a stretch at a time."""
    columns = crossings.b, crossings.a, crossings.along_a, crossings.along_b, crossings.a_ends, crossings.b_ends
    stretches = (slice(first, first + _STRETCH) for first in range(0, len(crossings), _STRETCH))
    return one_by_one.from_iterable(
        zip(*(column[some].tolist() for column in columns), strict=True) for some in stretches
    )
