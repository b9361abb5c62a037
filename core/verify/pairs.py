"""Pairs: pieces of two paths that are nearest to each other at some point, and the exact distance of each pair.

Intervals are parts of a path, each from one length traveled to another, such as those nearer than a limit to a path.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import tau, ulp
from typing import Final, NamedTuple

import numpy as np

from core.geometry.distance import band_fractions, distance, distances_at, nearest_fractions
from core.geometry.nearby import changes, nearest_pairs
from core.geometry.path import Flags, Floats, Path, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, batches_by_kind
from core.tolerance import GOUGE, LARGEST_COORDINATE, ON_PATH, STOCK, UNCUT

MIN_SEPARATE_ANGLE: Final = 1e-6
"""Radians that two concentric arcs must stay apart at one of the two places where they could be side by side."""


@dataclass(frozen=True, eq=False, slots=True)
class Pairs:
    """m pairs of a piece `i` and another path's piece `j`, by rising i: every j that is nearest to some place of its i.

    Distances are in millimeters.
    """

    pieces: PieceArrays
    others: PieceArrays
    stations: Floats
    """(n + 1,) lengths traveled at the pieces' starts and at the end."""
    i: Rows
    j: Rows
    tolerance: Floats
    """(m,) tolerance of each pair for rounding and for the uneven radii of arcs."""
    least: Floats
    """(m,) least distance between the two pieces."""
    from_piece: Floats
    """(3, m) distances of the piece's start, middle and end from the other one."""
    from_other: Floats
    """(2, m) distances of the other one's start and end from the piece."""

    @property
    def begins(self) -> Rows:
        """(n + 1,) the row where the pairs of each piece begin, and the row after the last pair."""
        return self.i.searchsorted(np.arange(len(self.pieces) + 1))

    def keep(self, rows: Rows) -> Pairs:
        """Return the pairs of these indices."""
        i, j, tolerance, least = self.i[rows], self.j[rows], self.tolerance[rows], self.least[rows]
        from_piece, from_other = self.from_piece[:, rows], self.from_other[:, rows]
        return Pairs(self.pieces, self.others, self.stations, i, j, tolerance, least, from_piece, from_other)


class NotMeasurableError(ArithmeticError):
    """A distance is not a number, and comparisons would silently ignore it."""


def measurable(radius: float, *paths: Path) -> bool:
    """True if all coordinates and the radius are lengths that a machine could have."""
    return 0.0 <= radius <= LARGEST_COORDINATE and all(path.reachable for path in paths)


def pairs_of(pieces: PieceArrays, others: PieceArrays, rounding: float, rows: Rows | None = None) -> Pairs:
    """Pair the pieces, or only those in `rows`, with the others that are nearest to them at some point.

    Others that are farther by no more than `rounding` and the slack of uneven arcs count as nearest too.
    """
    slack = float(pieces.slack.max(initial=0.0) + others.slack.max(initial=0.0))
    i, j = nearest_pairs(pieces if rows is None else pieces.take(rows), others, 4.0 * (rounding + slack) + ON_PATH)
    if rows is not None:
        i = rows[i]
    tolerance = rounding + uneven_slack(pieces, i, others, j)
    return Pairs(pieces, others, pieces.stations, i, j, tolerance, *_measured(pieces, i, others, j))


def measured(distances: Floats) -> Floats:
    """Return these distances; raise NotMeasurableError if one is not a number."""
    if np.isnan(distances).any():
        raise NotMeasurableError
    return distances


def uneven_slack(pieces: PieceArrays, i: Rows, others: PieceArrays, j: Rows) -> Floats:
    """Return the (m,) uncertainty of each pair's distance that comes from the uneven radii of its arcs.

    It counts once if one arc is the offset of the other about the same center: both then deviate alike.
    """
    first, second = pieces.slack[i], others.slack[j]
    slack: Floats = first + second
    rows = ((first > 0.0) & (np.abs(first - second) <= GOUGE)).nonzero()[0]
    if len(rows):
        piece, other = pieces.take(i[rows]), others.take(j[rows])
        gaps = np.abs(piece.start - other.start) - np.abs(piece.end - other.end)
        about = (piece.turn == other.turn) & (np.abs(piece.center - other.center) <= piece.slack)
        slack[rows] = np.where(about & (np.abs(gaps) <= GOUGE), np.maximum(piece.slack, other.slack), slack[rows])
    return slack


def rounding_of(*paths: PieceArrays) -> float:
    """Return what counts as rounding: UNCUT plus 4 units in the last place of the largest coordinate or radius."""
    largest = max(float(max(np.abs(path.start.view(np.float64)).max(), path.radius.max())) for path in paths)
    return UNCUT + 4.0 * ulp(largest)


def _measured(pieces: PieceArrays, i: Rows, others: PieceArrays, j: Rows) -> tuple[Floats, Floats, Floats]:
    least, from_piece, from_other = np.empty(len(i)), np.empty((3, len(i))), np.empty((2, len(i)))
    for rows in batches_by_kind(pieces.arcs[i], others.arcs[j]):
        piece, other = pieces.take(i[rows]), others.take(j[rows])
        middle = at(piece, np.full(len(rows), 0.5))
        from_piece[:, rows] = distance(other, np.array((piece.start, middle, piece.end)))
        from_other[:, rows] = distance(piece, np.array((other.start, other.end)))
        least[rows] = distances_at(piece, other, nearest_fractions(piece, other)).min(axis=0)
    return least, from_piece, from_other


def near_ends_and_middle(pairs: Pairs, radius: float) -> Flags:
    """True for pairs whose other piece is no farther than the radius from the piece's ends and its middle."""
    near: Flags = pairs.from_piece.max(axis=0) <= radius + pairs.tolerance + STOCK
    return near


def piece_within(pairs: Pairs, limit: Floats) -> Flags:
    """True for pairs whose other piece is surely within the limit of all of the piece: its start, middle and end are
    within the limit, and both are lines or concentric arcs."""
    near: Flags = (pairs.from_piece.max(axis=0) <= limit) & _same_kind(pairs)
    return near


def other_within(pairs: Pairs, limit: Floats) -> Flags:
    """True for pairs whose piece is surely within the limit of all of the other piece."""
    near: Flags = (pairs.from_other.max(axis=0) <= limit) & _same_kind(pairs)
    return near


def _same_kind(pairs: Pairs) -> Flags:
    """True for pairs of lines and for pairs of concentric arcs."""
    return ~(pairs.pieces.arcs[pairs.i] | pairs.others.arcs[pairs.j]) | concentric(pairs)


def concentric(pairs: Pairs) -> Flags:
    """True for pairs of concentric arcs that are side by side in only one place."""
    first, second = pairs.pieces.arcs[pairs.i], pairs.others.arcs[pairs.j]
    matching = first & second
    for rows in batches_by_kind(first, second):
        if matching[rows].any():
            matching[rows] &= _about_one_center(pairs.pieces.take(pairs.i[rows]), pairs.others.take(pairs.j[rows]))
    return matching


def _about_one_center(piece: PieceArrays, other: PieceArrays) -> Flags:
    middles = [arc.arm * np.exp(0.5j * arc.turn * arc.angle) for arc in (piece, other)]
    between = np.abs(np.angle(middles[0] * np.conj(middles[1])))
    once = (piece.angle + other.angle) / 2.0 + between < tau - MIN_SEPARATE_ANGLE
    alike: Flags = (np.abs(piece.center - other.center) <= ON_PATH) & once
    return alike


@dataclass(frozen=True, eq=False, slots=True)
class Nearest:
    """All pieces nearest to each point: pairs of point `k` and piece `j` in rising order of k, ties included."""

    k: Rows
    j: Rows
    distance: Floats

    @property
    def first(self) -> Rows:
        """(n,) the row of each point's first piece."""
        return changes(self.k)


def nearest(pairs: Pairs, index: Rows, points: Points) -> Nearest:
    """Find the other path's pieces nearest to these points, each on piece `index`; ties within ON_PATH included."""
    begins = pairs.i.searchsorted(index)
    counts = pairs.i.searchsorted(index, side="right") - begins
    starts = counts.cumsum() - counts
    k = np.repeat(np.arange(len(index)), counts)
    j = pairs.j[np.arange(len(k)) + (begins - starts)[k]]
    distances = np.empty(len(k))
    for batch in batches_by_kind(*[pairs.others.arcs[j]] * 2):
        distances[batch] = distance(pairs.others.take(j[batch]), points[k[batch]])
    keep = (distances <= np.minimum.reduceat(distances, starts)[k] + ON_PATH).nonzero()[0] if len(k) else k
    return Nearest(k[keep], j[keep], distances[keep])


@dataclass(frozen=True, eq=False, slots=True)
class Intervals:
    """k disjoint intervals of a path in order: the lengths traveled (k,) at their starts `first` and ends `last`."""

    first: Floats
    last: Floats

    def __len__(self) -> int:
        return len(self.first)

    @property
    def middle(self) -> Floats:
        """(k,) lengths traveled at the middle of each."""
        return (self.first + self.last) / 2.0

    def index(self, s: Floats) -> Rows:
        """Return the index of the interval that each place `s` is in or follows; -1 before the first."""
        return self.first.searchsorted(s, side="right") - 1

    def holds(self, s: Floats) -> Flags:
        """True for places strictly inside an interval."""
        owner = self.index(s)
        inside = owner >= 0
        inside[inside] = (s[inside] > self.first[owner[inside]]) & (s[inside] < self.last[owner[inside]])
        return inside

    def keep(self, chosen: Flags | Rows | slice) -> Intervals:
        """Return the intervals for which `chosen` (k,) is True, or those of these indices."""
        return Intervals(self.first[chosen], self.last[chosen])

    def cut(self, cuts: Floats) -> Intervals:
        """Split the intervals at these places."""
        s = np.sort(np.concatenate((self.first, self.last, cuts[self.holds(cuts)])))
        parts = Intervals(s[:-1], s[1:])
        return parts.keep((parts.last > parts.first + ON_PATH) & self.holds(parts.middle))


NO_INTERVALS = Intervals(np.zeros(0), np.zeros(0))
"""No part of a path."""


class Parts(NamedTuple):
    """m parts of pieces: lengths traveled at both ends and at a place between, the distance there, the pair's row."""

    first: Floats
    last: Floats
    middle: Floats
    distance: Floats
    pair: Rows


def within(pairs: Pairs, rows: Rows, limit: Floats) -> Parts:
    """Return all parts of these pairs' pieces that are nearer to the others than `limit` (m,), one limit for each pair.

    The pieces are split wherever the distance can pass the limit, and the middle of each part decides.
    """
    batches = [
        _within(pairs, rows[batch], limit[batch])
        for batch in batches_by_kind(pairs.pieces.arcs[pairs.i[rows]], pairs.others.arcs[pairs.j[rows]])
    ]
    return joined(batches)


def _within(pairs: Pairs, rows: Rows, limit: Floats) -> Parts:
    pieces, others = pairs.pieces.take(pairs.i[rows]), pairs.others.take(pairs.j[rows])
    fractions = band_fractions(pieces, others, limit)
    middles = (fractions[1:] + fractions[:-1]) / 2.0
    distances = measured(distances_at(pieces, others, middles))
    part, pair = ((distances < limit) & (fractions[1:] > fractions[:-1])).nonzero()
    start, length = pairs.stations[pairs.i[rows[pair]]], pieces.length[pair]
    first, last, middle = fractions[part, pair], fractions[part + 1, pair], middles[part, pair]
    return Parts(
        start + first * length, start + last * length, start + middle * length, distances[part, pair], rows[pair]
    )


def joined(batches: Sequence[Parts]) -> Parts:
    """Concatenate these parts."""
    none = np.zeros(0)
    return Parts._make(
        map(np.concatenate, zip(Parts(none, none, none, none, np.zeros(0, np.intp)), *batches, strict=True))
    )


def merged(first: Floats, last: Floats) -> Intervals:
    """Merge overlapping and touching parts into intervals."""
    order = first.argsort(kind="stable")
    first, furthest = first[order], np.maximum.accumulate(last[order])
    begins = np.ones(len(first), np.bool_)
    begins[1:] = first[1:] > furthest[:-1] + ON_PATH
    starts = begins.nonzero()[0]
    ends = np.append(starts[1:], len(first)) - 1
    return Intervals(first[starts], furthest[ends[: len(starts)]])
