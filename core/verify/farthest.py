"""Farthest finds where along intervals of one path the distance to another path is largest.

The distance to a path is the least of the distances to its pieces.  Along a span, the largest distance to any one
piece, which has a formula, is therefore an upper bound, and the distance at any place a lower bound.  A span whose
upper bound exceeds the best value known on its interval is divided where the nearest pieces of its two ends are
equally far, or where a piece that is nearest to both ends is farthest, until both bounds agree within
`DISTANCE_TOLERANCE`.  If no other piece is nearer there, this takes one step.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Final, NamedTuple

import numpy as np

from core.geometry.distance import distance, distances_at, farthest_fractions
from core.geometry.nearby import changes
from core.geometry.path import Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, fraction
from core.tolerance import ON_PATH
from core.verify.pairs import Intervals, Pairs, nearest

DISTANCE_TOLERANCE: Final = 1e-8
"""Millimeters: a largest distance counts as known once its bounds are this close."""

BAND_PIECES: Final = 1_000
"""Pieces of intervals that are examined at a time."""

MAX_DIVISIONS: Final = 100
"""Divisions after which doubles cannot split a span of any size further."""

SECTION_SHARES: Final = np.linspace(0.0, 1.0, 17)[:, None]
"""(17, 1) shares of a span at which both nearest pieces are compared."""

MAX_NARROWINGS: Final = 3
"""Times that a span is narrowed to the section in which the other piece becomes the nearer one."""

LEAST_SHARE: Final = 1e-3
"""A span is not divided closer to its ends than this share of it."""


class Farthest(NamedTuple):
    """(k,) for each interval: the place, in length traveled, that is farthest from the other path, its point, its
    distance and the first piece of the other path nearest to it."""

    place: Floats
    point: Points
    distance: Floats
    near: Rows


@dataclass(frozen=True, eq=False, slots=True)
class _Spans:
    """m parts of single pieces `index`, each within interval `owner`; (2, m) fractions, distances and nearest pieces at
    both ends."""

    owner: Rows
    index: Rows
    t: Floats
    distance: Floats
    near: Rows

    def take(self, rows: Rows) -> _Spans:
        return _Spans(self.owner[rows], self.index[rows], self.t[:, rows], self.distance[:, rows], self.near[:, rows])


def farthest(pairs: Pairs, intervals: Intervals, largest_possible: float = inf) -> Farthest:
    """Find the largest distance of each interval of the pieces from the others.

    No distance is larger than `largest_possible`, so the search of an interval ends at a place that far away.
    """
    # intervals are independent of each other: some at a time bound the memory in use
    index = pairs.stations[1:-1].searchsorted(np.array((intervals.first, intervals.last)))
    begins = changes((index[1] - index[0] + 1).cumsum() // BAND_PIECES).tolist()
    edges = [0, *begins[1:], len(intervals)]
    batches = [_farthest(pairs, intervals.keep(slice(*rows)), largest_possible) for rows in pairwise(edges)]
    return Farthest._make(map(np.concatenate, zip(*batches, strict=True)))


def _farthest(pairs: Pairs, intervals: Intervals, largest_possible: float) -> Farthest:
    spans, best = _begin(pairs, intervals)
    for division in range(MAX_DIVISIONS):
        spans = spans.take((best.distance[spans.owner] < largest_possible - DISTANCE_TOLERANCE).nonzero()[0])
        bounds, peaks = _bounds(pairs, spans)
        rows = (bounds > best.distance[spans.owner] + DISTANCE_TOLERANCE).nonzero()[0]
        if not len(rows):
            break
        spans = spans.take(rows)
        share = _shares(pairs, spans, peaks[rows]) if division % 3 < 2 else np.full(len(rows), 0.5)
        spans, best = _divide(pairs, spans, share, best)
    return best


def _nearest_at(pairs: Pairs, index: Rows, t: Floats) -> tuple[Points, Floats, Rows]:
    """Return points of the pieces, their distances from the other path and the first piece nearest to each."""
    points = at(pairs.pieces.take(index), t)
    near = nearest(pairs, index, points)
    first = near.first
    return points, np.minimum.reduceat(near.distance, first) if len(first) else near.distance, near.j[first]


def _begin(pairs: Pairs, intervals: Intervals) -> tuple[_Spans, Farthest]:
    """Split the intervals at the joints within them; return the parts and the farthest of their ends."""
    parts = intervals.cut(pairs.stations[1:-1])
    owner, index = intervals.index(parts.middle), pairs.stations[1:-1].searchsorted(parts.middle, side="right")
    t = fraction(np.array((parts.first, parts.last)) - pairs.stations[index], pairs.pieces.length[index])
    none = np.full(len(intervals), -1)
    best = Farthest(intervals.first, none.astype(np.complex128), np.full(len(intervals), -inf), none)
    twice = np.tile(index, 2)
    points, distances, near = _nearest_at(pairs, twice, t.ravel())
    best = _better(pairs, best, np.tile(owner, 2), twice, t.ravel(), (points, distances, near))
    return _Spans(owner, index, t, distances.reshape(2, -1), near.reshape(2, -1)), best


def _better(
    pairs: Pairs, best: Farthest, owner: Rows, index: Rows, t: Floats, measured: tuple[Points, Floats, Rows]
) -> Farthest:
    """Return `best`, updated with the places `t` on pieces `index` of intervals `owner` that are farther."""
    points, distances, near = measured
    s = pairs.stations[index] + t * pairs.pieces.length[index]
    # in each interval the largest comes first, among equal ones the earliest
    order = np.lexsort((s, -np.round(distances / ON_PATH), owner))
    first = order[changes(owner[order])]
    first = first[distances[first] > best.distance[owner[first]]]
    columns = [column.copy() for column in best]
    for column, new in zip(columns, (s, points, distances, near), strict=True):
        column[owner[first]] = new[first]
    return Farthest._make(columns)


def _bounds(pairs: Pairs, spans: _Spans) -> tuple[Floats, Floats]:
    """Return an upper bound of the distance on each span, and the share of it where the piece nearest to its beginning
    may be farthest, arbitrary if that is at an end."""
    t, count = spans.t, len(spans.index)
    piece, near = pairs.pieces.take(np.tile(spans.index, 2)), pairs.others.take(spans.near.ravel())
    across = distance(near, at(piece, t[::-1].ravel()))
    highest, peaks = _within_span(piece, near, np.concatenate((t, t), axis=1))
    highest = np.maximum(np.maximum(highest, across), spans.distance.ravel())
    return np.minimum(highest[:count], highest[count:]), (peaks[:count] - t[0]) / (t[1] - t[0])


def _within_span(piece: PieceArrays, near: PieceArrays, t: Floats) -> tuple[Floats, Floats]:
    """Return the largest distance to one nearest piece among the extremes inside the span `t` (2, m), and its fraction;
    0 and the span's start without an extreme."""
    fractions = farthest_fractions(piece, near)
    inside = (fractions > t[0]) & (fractions < t[1])
    if not inside.any():
        return np.zeros(len(piece)), t[0]
    distances = np.where(inside, distances_at(piece, near, fractions), 0.0)
    best, columns = distances.argmax(axis=0), np.arange(len(piece))
    return distances[best, columns], fractions[best, columns]


def _shares(pairs: Pairs, spans: _Spans, peaks: Floats) -> Floats:
    """Return where to divide each span, at its peak if one piece is nearest to both ends, never close to an end."""
    share, several = peaks, (spans.near[0] != spans.near[1]).nonzero()[0]
    if len(several):
        share[several] = _equally_far(pairs, spans.take(several))
    share[np.isnan(share)] = 0.5
    return np.clip(share, LEAST_SHARE, 1.0 - LEAST_SHARE)


def _equally_far(pairs: Pairs, spans: _Spans) -> Floats:
    """Return the share of each span at which the nearest pieces of its two ends are equally far."""
    piece, (first_wall, last_wall) = pairs.pieces.take(spans.index), (pairs.others.take(near) for near in spans.near)
    begin, end = spans.t
    low, high, columns = begin, end, np.arange(len(begin))
    for _ in range(MAX_NARROWINGS):
        fractions = low + SECTION_SHARES * (high - low)
        points = at(piece, fractions)
        nearer = distance(last_wall, points) - distance(first_wall, points)
        after = np.maximum(np.argmax(nearer < 0.0, axis=0), 1)
        (low, high), (more, less) = ((of[after - 1, columns], of[after, columns]) for of in (fractions, nearer))
    meeting = low + (high - low) * np.where(more > less, more / (more - less), 0.5)
    shares: Floats = (meeting - begin) / (end - begin)
    return shares


def _divide(pairs: Pairs, spans: _Spans, share: Floats, best: Farthest) -> tuple[_Spans, Farthest]:
    """Divide every span in two at `share` of its length; return the halves and `best`, updated with the new places."""
    t = spans.t[0] + share * (spans.t[1] - spans.t[0])
    points, distances, near = _nearest_at(pairs, spans.index, t)
    halves = [
        np.array((np.concatenate((ends[0], new)), np.concatenate((new, ends[1]))))
        for ends, new in ((spans.t, t), (spans.distance, distances), (spans.near, near))
    ]
    best = _better(pairs, best, spans.owner, spans.index, t, (points, distances, near))
    return _Spans(np.tile(spans.owner, 2), np.tile(spans.index, 2), *halves), best
