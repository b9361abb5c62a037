"""Prune: the conversational control's walk along the raw chain, which trims, bridges and deletes under the look-ahead.

The walk takes the pieces b in order.  Each is first joined to its predecessor; then it is tested against the remaining
parts of earlier pieces a within the look-ahead, and the earliest that crosses it wins: a ends there, b starts there,
and everything between is deleted (LOOK_AHEAD.md).  The rest of a piece is a range of distances along it, and all
crossings are known beforehand, so the walk only compares numbers and visits only pieces that are not settled.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from math import inf
from typing import NamedTuple

import numpy as np

from core.comp.compensated import NO_DELETIONS, Deletions
from core.comp.crossings import Crossings
from core.comp.offset import RawChain, RawPart
from core.geometry.path import EMPTY, Flags, Floats, Path, Points, Rows, as_complex, coordinates
from core.tolerance import JOINED, ON_PATH


@dataclass(frozen=True, eq=False, slots=True)
class Pruned:
    """The result of the walk: the path, a flag for each of its `bridged` pieces (len(path),), and the deleted segments.

    `bridges` are the chain's rows of the bridges that remain.
    """

    path: Path
    bridged: Flags
    bridges: Rows
    deleted: Deletions


class _Remainder(NamedTuple):
    """The rest of the chain's m pieces: from `low` to `high` (m,) millimeters along them, `high` infinite if the end is
    untrimmed; the points `starts` (m,) where they start; `remains` (m,) is True for pieces that remain."""

    low: Floats
    high: Floats
    starts: Points
    remains: Flags


def prune(chain: RawChain, joints: Crossings, others: Crossings, *, last_wins: bool) -> Pruned:
    """Walk the chain, given the crossings at its joints and those of other pieces that the look-ahead tests.

    With `last_wins` a joint takes the last point along the earlier piece (closed contours of two segments).
    """
    same_joint, wins = joints.b[1:] == joints.b[:-1], np.ones(len(joints), np.bool_)
    (wins[:-1] if last_wins else wins[1:])[same_joint] = False
    walk = _Walk(len(chain), joints.take(wins), joints, others)
    walk.run()
    remainder, deleting_rows = walk.remainder(chain), np.array(walk.deleting_rows, np.intp)
    path, bridges, rows = _pruned_path(chain, remainder)
    deletions = _deletions(chain, others, deleting_rows, np.frombuffer(walk.deleted, np.bool_))
    return Pruned(path, chain.parts[rows] >= RawPart.BRIDGE, bridges, deletions)


class _Walk:
    """One walk along a chain of `count` pieces.

    `trims` cut the inside corners before the walk begins; it then redoes only the joints of pieces whose start is past
    their end.
    """

    def __init__(self, count: int, trims: Crossings, joints: Crossings, others: Crossings) -> None:
        low, high = np.zeros(count), np.full(count, np.inf)
        high[trims.a], low[trims.b] = trims.along_a, trims.along_b
        self._agenda: list[int] = ((low > high + ON_PATH).nonzero()[0] + 2)[::-1].tolist()
        self._low: list[float] = low.tolist()
        self._high: list[float] = high.tolist()
        self._trims, self._joints, self._others = trims, joints, others
        self._joint_pieces: list[int] = joints.b.tolist()
        self._bridged: list[int] = []
        self._rejoined: list[int] = []
        self.deleted = bytearray(count)
        self.deleting_rows: list[int] = []
        """Rows of `others` that deleted something, in order."""

    def run(self) -> None:
        """Test every piece's crossings and take the first one that lies on the remaining parts of both pieces.

        The earlier piece then ends there, the later one starts there, and everything between is deleted.  A point at
        the very end of one piece and the very start of the other is not a crossing.
        """
        low, high, deleted, agenda, others = self._low, self._high, self.deleted, self._agenda, self._others
        columns = others.b, others.a, others.along_a, others.along_b, others.a_ends, others.b_ends
        rows = zip(*(column.tolist() for column in columns), strict=True)
        piece, crossing_taken = -1, True
        for row, (b, a, along_a, along_b, a_ends, b_ends) in enumerate(rows):
            if b != piece:
                self._settle(b)
                piece, crossing_taken = b, False
            start, first, last = low[b], low[a], high[a]
            if crossing_taken or deleted[a] or along_b < start - ON_PATH:
                continue
            if along_a < first - ON_PATH or along_a > last + ON_PATH or (b_ends and along_a <= first + ON_PATH):
                continue
            if along_b <= start + ON_PATH and (a_ends or along_a >= last - ON_PATH):
                continue
            high[a], low[b], crossing_taken = along_a, along_b, True
            deleted[a + 1 : b] = b"\1" * (b - a - 1)
            self.deleting_rows.append(row)
            if high[b] < along_b - ON_PATH:
                agenda.append(b + 2)
        self._settle(len(low))

    def _settle(self, until: int) -> None:
        """Redo the joints that no longer hold, up to the joint of piece `until` with its predecessor."""
        low, high, agenda = self._low, self._high, self._agenda
        while agenda and agenda[-1] <= until:
            piece = agenda.pop()
            start = low[piece - 2] - ON_PATH
            if high[piece - 2] < start:
                # join the pieces at their other crossing if it remains, else by a bridge
                row = bisect_right(self._joint_pieces, piece) - 1
                along = float(self._joints.along_a[row])
                if along >= start:
                    high[piece - 2], low[piece] = along, float(self._joints.along_b[row])
                    self._rejoined.append(row)
                else:
                    high[piece - 2], low[piece] = inf, 0.0
                    self._bridged.append(piece)
            if piece < until and high[piece] < low[piece] - ON_PATH:
                agenda.append(piece + 2)

    def remainder(self, chain: RawChain) -> _Remainder:
        """Return what the walk leaves of the chain."""
        raw_starts, bridged = as_complex(chain.raw.points)[:-1], np.array(self._bridged, np.intp)
        starts, remains = raw_starts.copy(), np.ones(len(chain), np.bool_)
        starts[self._trims.b], remains[self._trims.b - 1] = self._trims.points, False
        starts[bridged], remains[bridged - 1] = raw_starts[bridged], True
        starts[self._joints.b[self._rejoined]] = self._joints.points[self._rejoined]
        starts[self._others.b[self.deleting_rows]] = self._others.points[self.deleting_rows]
        remains &= ~np.frombuffer(self.deleted, np.bool_)
        return _Remainder(np.array(self._low), np.array(self._high), starts, remains)


def _pruned_path(chain: RawChain, remainder: _Remainder) -> tuple[Path, Rows, Rows]:
    """Return the path of the remaining pieces, the rows of the bridges among them, and the rows of all of them."""
    remaining = remainder.remains.nonzero()[0]
    starts = np.append(remainder.starts[remaining], as_complex(chain.raw.points)[-1:])
    has_length = _with_length(chain, remainder, remaining, starts)
    remaining, starts = remaining[has_length], starts[np.append(has_length, True)]
    bridges = remaining[chain.parts[remaining] >= RawPart.BRIDGE]
    if not len(remaining):
        return EMPTY, bridges, remaining
    raw = chain.raw
    path = Path.of(coordinates(starts), raw.centers[remaining], raw.turns[remaining], raw.numbers[remaining])
    return path, bridges, remaining


def _with_length(chain: RawChain, remainder: _Remainder, remaining: Rows, starts: Points) -> Flags:
    """True for pieces that still have a length: an arc trimmed to a point must not become a full circle.

    An arc that remains a full turn within rounding gets equal ends in `starts`, and so stays a full circle.
    """
    has_length = np.abs(starts[1:] - starts[:-1]) > JOINED
    for row in (~has_length & (chain.raw.turns[remaining] != 0)).nonzero()[0].tolist():
        piece = int(remaining[row])
        length = min(float(remainder.high[piece]), chain.raw[piece].length) - float(remainder.low[piece])
        if length > JOINED:
            starts[row + 1], has_length[row] = starts[row], True
    return has_length


def _deletions(chain: RawChain, others: Crossings, deleting_rows: Rows, is_deleted: Flags) -> Deletions:
    """Return the deleted segments, each with the first event, a row in `deleting_rows`, that spans it."""
    if not len(deleting_rows):
        return NO_DELETIONS
    deleted = is_deleted.nonzero()[0]
    deleted = deleted[chain.half_steps[deleted] % 2 == 0]
    a, b = others.a[deleting_rows], others.b[deleting_rows]
    # events come in the order of b: the first that ends after a piece spans it, unless it also begins after it
    event = b.searchsorted(deleted, side="right")
    while (late := a[event] >= deleted).any():
        event[late] += 1
    numbers = chain.raw.numbers
    by = np.stack((numbers[a[event]], numbers[b[event]]), axis=1)
    return Deletions(numbers[deleted], by, coordinates(others.points[deleting_rows[event]]))
