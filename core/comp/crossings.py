"""Crossings: where pieces of the raw chain meet, for every pair a look-ahead allows.

All of it is found before the walk, on whole pieces: trimming a piece never moves where it meets another, it only
decides which of those points are left.  The walk itself then needs no geometry.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from core.comp.offset import BRIDGE, CORNER, Chain, stacked
from core.geometry.intersect import Meeting, Meetings, meet_pieces
from core.geometry.path import Flags, Floats, Pieces, Points, Rows, as_complex, coordinates, pieces_of
from core.tolerance import ON_PATH

_STRETCH: Final = 8192
"""Pieces tested at a time against those before them."""


@dataclass(frozen=True, eq=False, slots=True)
class Crossings:
    """p points where an earlier piece `a` and a later piece `b` of the chain meet, in order of b, then a, then along a.

    `along_a`, `along_b` are distances from the pieces' raw starts in millimeters, `a_ends` marks points at
    a's raw end, `b_ends` at b's.  `points` are complex numbers.
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

    def chosen(self, rows: Flags | Rows) -> Crossings:
        """Those crossings only."""
        return Crossings(*(getattr(self, name)[rows] for name in self.__slots__))


@dataclass(frozen=True, eq=False, slots=True)
class Candidates:
    """All crossings of a chain: `joints` of path neighbors at inside corners, `others` with their reach in places."""

    joints: Crossings
    others: Crossings
    reach: Rows

    def within(self, lookahead: int) -> Crossings:
        """The crossings of pieces that are not neighbors and that this look-ahead tests."""
        rows = self.reach <= 2 * lookahead
        return self.others if rows.all() else self.others.chosen(rows)

    def counts(self, lookaheads: Sequence[int]) -> list[int]:
        """How many each of these look-aheads tests: those of one count test the same."""
        if not len(self.reach):
            return [0] * len(lookaheads)
        counts: list[int] = np.sort(self.reach).searchsorted(2 * np.array(lookaheads), side="right").tolist()
        return counts


def crossings(chain: Chain, lookahead: int, *, closed: bool) -> Candidates:
    """Every crossing that a look-ahead up to `lookahead` may have to know of.

    Tangent touches of pieces that are not neighbors are left out: a cutter that just fits passes.  The first and
    the last segment of a closed contour are never tested against each other, unless they are neighbors.
    """
    pieces, partners = pieces_of(chain.raw), (chain.parts <= CORNER).nonzero()[0]
    bounds = [*range(0, max(len(partners), 1), _STRETCH), len(partners)]
    joints, others = [], []
    for first, last in pairwise(bounds):
        a, b = _pairs(pieces, chain.places, partners, first, last, 2 * lookahead)
        joint = (b - a == 2) & (chain.parts[b - 1] == BRIDGE)
        if closed and chain.places[-1] - chain.places[0] <= 2 * lookahead:
            tested = joint | (a > 0) | (b < len(chain) - 1)
            a, b, joint = a[tested], b[tested], joint[tested]
        met = meet_pieces(pieces, a, pieces, b)
        at_joint, crossed = joint[met.pair], met.kinds[met.pair] == Meeting.CROSS.value
        joints.append(_found(met, a, b, at_joint))
        others.append(_found(met, a, b, crossed & ~at_joint))
    far = _all(others)
    return Candidates(_all(joints), far, chain.places[far.b] - chain.places[far.a])


def _all(parts: list[Crossings]) -> Crossings:
    """The crossings of all parts, one behind the other; takes the list apart."""
    if len(parts) == 1:
        return parts.pop()
    rows = [tuple(getattr(part, name) for name in Crossings.__slots__) for part in parts]
    parts.clear()
    return Crossings(*stacked(rows))


def _found(met: Meetings, a: Rows, b: Rows, chosen: Flags) -> Crossings:
    """Some of the points at which pairs of pieces a, b have met."""
    rows = chosen.nonzero()[0]
    pair = met.pair[rows]
    return Crossings(
        a[pair],
        b[pair],
        met.along_a[rows],
        met.along_b[rows],
        met.rest_a[rows] <= ON_PATH,
        met.rest_b[rows] <= ON_PATH,
        as_complex(met.points)[rows],
    )


def _pairs(pieces: Pieces, every_place: Rows, partners: Rows, first: int, last: int, reach: int) -> tuple[Rows, Rows]:
    """Pairs a < b of `partners`, not next to each other in the chain, within reach and with boxes that meet.

    b are the partners first ... last - 1.  Each row of the comparison is one distance among them, most distant first.
    """
    # no two have the same place: there are no more within reach
    before = min(first, reach)
    rows = partners[first - before : last]
    places = every_place[rows]
    farthest = places.searchsorted(places[before:] - reach)
    window = int((np.arange(before, len(rows)) - farthest).max(initial=0))
    if not window:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    lows, highs = _boxes(pieces.take(rows[max(before - window, 0) :]), max(window - before, 0))
    beside = _shifted(lows, window) <= highs[:, None, window:]
    beside &= _shifted(highs, window) >= lows[:, None, window:]
    meeting = beside[0] & beside[1]
    b, a = np.divmod(meeting.T.ravel().nonzero()[0], window)
    b += before
    a += b - window
    near = places[b] - places[a] <= reach
    a, b = rows[a], rows[b]
    near &= b - a > 1
    return a[near], b[near]


def _shifted(values: Floats, window: int) -> Floats:
    """(2, window, k) view of (2, window + k) values: row i is shifted by i."""
    count = values.shape[1] - window
    step = values.itemsize
    return np.ndarray((2, window, count), np.float64, values, 0, (values.strides[0], step, step))


def _boxes(pieces: Pieces, pad: int) -> tuple[Floats, Floats]:
    """Boxes that hold n pieces: least and largest x and y, each (2, pad + n); the first `pad` are empty."""
    count = len(pieces.turn)
    lows, highs = np.empty((2, pad + count)), np.empty((2, pad + count))
    lows[:, :pad], highs[:, :pad] = np.inf, -np.inf
    low, high, both = lows[:, pad:], highs[:, pad:], (coordinates(pieces.start).T, coordinates(pieces.end).T)
    np.minimum(*both, out=low)
    np.maximum(*both, out=high)
    arcs, beyond = pieces.turn.nonzero()[0], np.zeros(count)
    if len(arcs):
        lift = np.zeros(count, np.complex128)
        lift[arcs], beyond[arcs] = _lifts(pieces.take(arcs))
        up = coordinates(lift).T
        low += np.minimum(up, 0.0)
        high += np.maximum(up, 0.0)
    beyond += ON_PATH
    low -= beyond
    high += beyond
    return lows, highs


def _lifts(arcs: Pieces) -> tuple[Points, Floats]:
    """By how much arcs lie beside their chords, as vectors, and by how much a box must grow on all sides besides.

    An arc of half a turn or less lies in the rectangle of its chord and its height, on the chord's right if
    counter-clockwise; a larger one within a diameter of its ends.  An arc whose radii differ grows by that.
    """
    first, last, run = arcs.start - arcs.center, arcs.end - arcs.center, (arcs.end - arcs.start) / 2.0
    radius, half = np.abs(first), np.abs(run)
    small = ((first.conj() * last).imag * arcs.turn > 0.0) & (half > 0.0)
    height = radius - np.sqrt(np.maximum((radius - half) * (radius + half), 0.0))
    lift = -1j * run * (arcs.turn * height / np.where(small, half, np.inf))
    return lift, np.abs(np.abs(last) - radius) + np.where(small, 0.0, 2.0 * radius)
