"""Reach: which places of one path lie within a radius of another, as exact stretches of length traveled.

The one question behind gouges (the center path within the radius of the surface), uncut stretches (the surface not
within the radius of the center path) and moves away from the part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from core.geometry.boxes import nearest_boxes
from core.geometry.distance import band_places, between, distance
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, blocks
from core.geometry.remembered import remembered
from core.tolerance import ON_PATH

FEW: Final = 400
"""Pairs of points and pieces all of which are measured: looking for the near ones costs more."""


@dataclass(frozen=True, eq=False, slots=True)
class Stretches:
    """k stretches of a path, apart from each other and in order: lengths traveled (k,) at `first` and `last`."""

    first: Floats
    last: Floats

    def __len__(self) -> int:
        return len(self.first)

    def index(self, s: Floats) -> Rows:
        """The stretch each place `s` is in or follows; -1 before the first."""
        return self.first.searchsorted(s, side="right") - 1

    def keep(self, chosen: Flags) -> Stretches:
        """The stretches for which `chosen` (k,) is True."""
        return Stretches(self.first[chosen], self.last[chosen])


@dataclass(frozen=True, eq=False, slots=True)
class Parts:
    """m parts of pieces: lengths traveled at both ends and in the middle, the distance there, and whose pair it is."""

    first: Floats
    last: Floats
    middle: Floats
    apart: Floats
    pair: Rows


def within(pieces: PieceArrays, i: Rows, others: PieceArrays, j: Rows, reach: Floats) -> Parts:
    """All parts of pieces `i` that are nearer to their partners `j` than `reach` (m,).

    The pieces are parted wherever the distance can pass `reach`, and the middle of each part decides.
    """
    starts = pieces.stations[i]
    found = [
        _within_block(pieces.take(i[rows]), others.take(j[rows]), starts[rows], reach[rows], rows)
        for rows in blocks(pieces.arcs[i], others.arcs[j])
    ]
    return joined(found)


def joined(found: Sequence[Parts]) -> Parts:
    """All of these parts."""
    if len(found) == 1:
        return found[0]
    columns = zip(*((one.first, one.last, one.middle, one.apart) for one in found), strict=True)
    first, last, middle, apart = (np.concatenate(column) for column in columns) if found else np.zeros((4, 0))
    return Parts(first, last, middle, apart, np.concatenate((np.zeros(0, np.intp), *(one.pair for one in found))))


def _within_block(pieces: PieceArrays, others: PieceArrays, starts: Floats, reach: Floats, rows: Rows) -> Parts:
    places, middles, apart = _bands(pieces, others, reach)
    part, pair = ((apart < reach) & (places[1:] > places[:-1])).nonzero()
    start, length, spot = starts.take(pair), pieces.length.take(pair), part * len(rows) + pair
    first, last, middle = places.take(spot), places.take(spot + len(rows)), middles.take(spot)
    return Parts(start + first * length, start + last * length, start + middle * length, apart.take(spot), rows[pair])


@remembered
def _bands(pieces: PieceArrays, others: PieceArrays, reach: Floats) -> tuple[Floats, Floats, Floats]:
    """(10, m) where the pieces are parted, and (9, m) middles of the parts and their distances from the partners."""
    places = band_places(pieces, others, reach)
    middles = (places[1:] + places[:-1]) / 2.0
    return places, middles, between(pieces, others, middles)


def changes(owner: Rows) -> Rows:
    """Where each run of equal values begins."""
    begins = np.ones(len(owner), np.bool_)
    np.not_equal(owner[1:], owner[:-1], out=begins[1:])
    return begins.nonzero()[0]


def union(first: Floats, last: Floats) -> Stretches:
    """Overlapping and touching parts as stretches."""
    order = first.argsort(kind="stable")
    first, furthest = first[order], np.maximum.accumulate(last[order])
    begins = np.ones(len(first), np.bool_)
    begins[1:] = first[1:] > furthest[:-1] + ON_PATH
    starts = begins.nonzero()[0]
    ends = np.concatenate((starts[1:], (len(first),))) - 1
    return Stretches(first[starts], furthest[ends[: len(starts)]])


@dataclass(frozen=True, eq=False, slots=True)
class Nearest:
    """All pieces nearest to points: pairs of point `k` and piece `j` in rising order of k, ties included."""

    k: Rows
    j: Rows
    apart: Floats

    def followed(self, other: Nearest, count: int) -> Nearest:
        """These pairs, of `count` points, and then the other ones, whose points come behind."""
        k, j = np.concatenate((self.k, count + other.k)), np.concatenate((self.j, other.j))
        return Nearest(k, j, np.concatenate((self.apart, other.apart)))


def nearest(
    points: Points, pieces: PieceArrays, bounds: Floats, *, tie: float = 0.0, known: Floats | None = None
) -> Nearest:
    """For each point the pieces no farther than the nearest one and `tie`.

    `bounds` are the pieces' boxes, `known` (n,) distances within which there is a piece for sure.
    """
    if 0 < len(points) * len(pieces) <= FEW:
        apart = distance(pieces, points[:, None] + np.zeros(len(pieces)))
        k, j = (apart <= apart.min(axis=1)[:, None] + tie).nonzero()
        return Nearest(k, j, apart[k, j])
    within = np.full(len(points), np.inf) if known is None else known
    k, j = nearest_boxes(points, bounds, within, tie + ON_PATH)
    apart = distance(pieces.take(j), points[k])
    return least_of(k, j, apart, k.searchsorted(np.arange(len(points))), tie)


def least_of(k: Rows, j: Rows, apart: Floats, starts: Rows, tie: float) -> Nearest:
    """The pairs of each k (0 ... rising by 1, from `starts` on each) with the least distance, and ties."""
    keep = (apart <= np.minimum.reduceat(apart, starts)[k] + tie).nonzero()[0]
    return Nearest(k[keep], j[keep], apart[keep])
