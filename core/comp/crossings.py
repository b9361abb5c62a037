"""Crossings: where pieces of the raw chain meet, for every pair that a look-ahead allows.

All crossings are found before the walk, on whole pieces: trimming a piece never moves the points where it meets
others, it only decides which of them remain.  The walk itself then needs no geometry.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.comp.offset import RawChain, RawPart
from core.geometry.intersect import MeetingKind, Meetings, meet_pieces
from core.geometry.path import Flags, Floats, Pieces, Points, Rows, boxes, pieces_of
from core.tolerance import ON_PATH


@dataclass(frozen=True, eq=False, slots=True)
class Crossings:
    """p points where an earlier piece `a` and a later piece `b` of the chain meet, in order of b, then a, then along a.

    `along_a`, `along_b` are distances from the pieces' raw starts in millimeters, `a_ends` marks points at
    a's raw end, `b_ends` at b's.
    """

    a: Rows
    b: Rows
    along_a: Floats
    along_b: Floats
    a_ends: Flags
    b_ends: Flags
    points: Points

    def __len__(self) -> int:
        return len(self.a)

    def take(self, rows: Flags | Rows) -> Crossings:
        """Return the crossings of these rows."""
        return Crossings(*(getattr(self, name)[rows] for name in self.__slots__))


@dataclass(frozen=True, eq=False, slots=True)
class Candidates:
    """All crossings of a chain: `joints` of neighbors at inside corners, `others` with their `reach` in half steps."""

    joints: Crossings
    others: Crossings
    reach: Rows

    def within(self, lookahead: int) -> Crossings:
        """Return the crossings of non-neighboring pieces that this look-ahead tests."""
        return self.others.take(self.reach <= 2 * lookahead)

    def count(self, lookahead: int) -> int:
        """Return how many of these this look-ahead tests; look-aheads with equal counts test the same crossings."""
        return int(np.count_nonzero(self.reach <= 2 * lookahead))


def crossings(chain: RawChain, lookahead: int, *, closed: bool) -> Candidates:
    """Find every crossing that a look-ahead up to `lookahead` may need.

    Tangent touches of non-neighboring pieces are left out: a cutter that just fits passes.  The first and
    the last segment of a closed contour are never tested against each other, unless they are neighbors.
    """
    pieces = pieces_of(chain.raw)
    a, b = _near_pairs(chain, pieces, 2 * lookahead)
    at_bridge = (b - a == 2) & (chain.parts[b - 1] == RawPart.BRIDGE)
    if closed:
        tested = at_bridge | (a > 0) | (b < len(chain) - 1)
        a, b, at_bridge = a[tested], b[tested], at_bridge[tested]
    meetings = meet_pieces(pieces, a, pieces, b)
    at_joint, crossed = at_bridge[meetings.pair], meetings.kinds[meetings.pair] == MeetingKind.CROSS
    others = _chosen(meetings, a, b, crossed & ~at_joint)
    return Candidates(
        _chosen(meetings, a, b, at_joint), others, chain.half_steps[others.b] - chain.half_steps[others.a]
    )


def _chosen(met: Meetings, a: Rows, b: Rows, chosen: Flags) -> Crossings:
    """Return the `chosen` points at which pairs of pieces a, b meet."""
    rows = chosen.nonzero()[0]
    pair = met.pair[rows]
    return Crossings(
        a[pair],
        b[pair],
        met.along_a[rows],
        met.along_b[rows],
        met.to_end_a[rows] <= ON_PATH,
        met.to_end_b[rows] <= ON_PATH,
        met.points[rows],
    )


def _near_pairs(chain: RawChain, pieces: Pieces, reach: int) -> tuple[Rows, Rows]:
    """Return pairs a < b, by b, then a, of segments and corner arcs that are not adjacent in the chain, are within
    `reach` half steps and have boxes that meet.

    Each has a half step of its own, so no more than `reach` of them are within reach of one: comparing all of them with
    themselves shifted by 1, 2, ... finds every pair, at the same cost if a thousand pieces lie on top of each other.
    """
    rows = (chain.parts <= RawPart.CORNER).nonzero()[0]
    half_steps, grown = chain.half_steps[rows], _grown_boxes(pieces.take(rows))
    first, second = [np.zeros(0, np.intp)], [np.zeros(0, np.intp)]
    for step in range(1, min(reach, len(rows) - 1) + 1):
        near = half_steps[step:] - half_steps[:-step] <= reach
        if not near.any():
            break
        near &= rows[step:] - rows[:-step] > 1
        near &= (grown[:2, step:] <= grown[2:, :-step]).all(axis=0)
        near &= (grown[2:, step:] >= grown[:2, :-step]).all(axis=0)
        low = near.nonzero()[0]
        first.append(low)
        second.append(low + step)
    a, b = np.concatenate(first), np.concatenate(second)
    order = np.lexsort((a, b))
    return rows[a[order]], rows[b[order]]


def _grown_boxes(pieces: Pieces) -> Floats:
    """Return boxes a hair larger than the pieces, grown for an arc with two different radii by their difference."""
    first, last = np.abs(pieces.start - pieces.center), np.abs(pieces.end - pieces.center)
    grow = ON_PATH + np.where(pieces.turn == 0, 0.0, np.abs(last - first))
    grown = boxes(pieces)
    grown[:2] -= grow
    grown[2:] += grow
    return grown
