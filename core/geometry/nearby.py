"""Nearby: which pieces are near which, found by shapely's tree of boxes and by branch and bound over runs of chords.

Boxes are (4, n) arrays: left, bottom, right, top.

`near_pairs` and `near_pairs_within` are exact for boxes, up to the last digits of a double, and so a superset for what
is inside them: `core.geometry.distance` makes it exact, pair by pair.  They come in batches of some ten thousand pairs:
whoever needs them all at once calls `gathered`, whoever looks at each pair once does not hold them.  With 100,000
chords inside one radius ask what is nearest (`nearest_pieces`, exact), never what lies in boxes within reach: that is
all pairs.  What has a coordinate that is no number is near everything, so that whoever measures it sees that.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import shapely

from core.geometry.distance import distance
from core.geometry.path import Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays

FAN: Final = 4
"""Consecutive chords, or runs of them, in one run."""

RUN: Final = 8
"""Consecutive boxes that the tree is asked about at once."""

MAX_COARSE_RUNS: Final = 32
"""Runs on the coarsest level, which the tree of boxes holds against each other."""

BATCH_PAIRS: Final = 1 << 14
"""Pairs of runs that are opened at a time: few enough to stay in a processor's cache."""

BATCH_QUERIES: Final = 1024
"""Boxes that the tree is asked about at a time, where few are near each other."""

EVERYWHERE: Final = np.array([[-1e300], [-1e300], [1e300], [1e300]])
"""The box of what has no known place."""

NEARLY: Final = 1e-12
"""Share of a distance that rounding may take off it or add to it."""

Batches = Iterator[tuple[Rows, Rows]]


def near_pairs(first: Floats, second: Floats, reach: float) -> Batches:
    """All pairs (i, j) of a box of `first` and one of `second` no farther apart than `reach`, in rising order of i.

    Exact for the boxes, hence a superset for what is inside them.
    """
    if not (first.shape[1] and second.shape[1]):
        return
    tree = shapely.STRtree(_diagonals(second))
    grown = first + np.array([[-reach], [-reach], [reach], [reach]])
    start, count = 0, 64
    while start < first.shape[1]:
        i, j = tree.query(_diagonals(grown[:, start : start + count]))
        i += start
        start += count
        # the tree's boxes are square at their corners
        near = ~(_apart(first.take(i, axis=1), second.take(j, axis=1)) > reach)
        yield i[near], j[near]
        count = min(BATCH_QUERIES, 2 * count) if len(i) < BATCH_PAIRS else max(1, count // 2)


def near_pairs_within(boxes: Floats, reach: float) -> Batches:
    """All pairs (i, j), i < j, of these boxes no farther apart than `reach`, in no order; exact as above.

    The tree is asked about runs of consecutive boxes, which along a path lie together: a quarter of the time.
    """
    if not boxes.shape[1]:
        return
    begins = np.arange(0, boxes.shape[1], RUN)
    corners = np.minimum.reduceat(boxes[:2], begins, axis=1), np.maximum.reduceat(boxes[2:], begins, axis=1)
    runs = np.concatenate(corners)
    left, right = np.ascontiguousarray(boxes[0]), np.ascontiguousarray(boxes[2])
    for a, b in near_pairs(runs, runs, reach):
        once = a <= b
        a, b = a[once], b[once]
        for first in range(0, len(a), BATCH_PAIRS // RUN):
            part = slice(first, first + BATCH_PAIRS // RUN)
            i, j = _members_of_runs(a[part], b[part], boxes.shape[1])
            # most of them are apart along x
            near = ~(np.maximum(left[i] - right[j], left[j] - right[i]) > reach)
            i, j = i[near], j[near]
            near = ~(_apart(boxes.take(i, axis=1), boxes.take(j, axis=1)) > reach)
            yield i[near], j[near]


def _members_of_runs(a: Rows, b: Rows, count: int) -> tuple[Rows, Rows]:
    """All pairs i < j of the boxes in paired runs, of `count` boxes in all."""
    i, j = np.divmod(np.arange(RUN * RUN), RUN)
    i, j = (a[:, None] * RUN + i).ravel(), (b[:, None] * RUN + j).ravel()
    once = (i < j) & (j < count)
    return i[once], j[once]


def gathered(batches: Iterable[tuple[Rows, Rows]]) -> tuple[Rows, Rows]:
    """All pairs of these batches, sorted by i and then by j."""
    none = np.zeros(0, np.intp)
    columns = list(zip(*batches, strict=True)) or [(none,), (none,)]
    i, j = (np.concatenate(column) for column in columns)
    order = np.lexsort((j, i))
    return i[order], j[order]


def _diagonals(boxes: Floats) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """A line in each box from corner to corner: the tree looks at nothing but its box, and it is small."""
    known = np.where(np.isnan(boxes), EVERYWHERE, boxes)
    lines: np.ndarray[tuple[int], np.dtype[np.object_]] = shapely.linestrings(known.T.reshape(-1, 2, 2))
    return lines


def _apart(first: Floats, second: Floats) -> Floats:
    """Distances between boxes, 0 where they meet."""
    gaps = np.maximum(np.maximum(first[:2] - second[2:], second[:2] - first[2:]), 0.0)
    apart: Floats = np.hypot(gaps[0], gaps[1])
    return apart


@dataclass(frozen=True, eq=False, slots=True)
class Chords:
    """(n,) straight lines, each of which has a piece, or a run of pieces, within `slack` of it."""

    start: Points
    end: Points
    slack: Floats

    def __len__(self) -> int:
        return len(self.start)

    def take(self, rows: Rows) -> Chords:
        """The chords of these indices."""
        return Chords(self.start.take(rows), self.end.take(rows), self.slack.take(rows))


def chords_of(pieces: PieceArrays) -> Chords:
    """The chord of each piece; an arc is within its height over the chord, however far it turns."""
    return Chords(pieces.start, pieces.end, pieces.radius * (1.0 - np.cos(pieces.angle / 2.0)))


Runs = tuple[Chords, ...]
"""Chords of the pieces, of runs of FAN pieces, of FAN such runs and so on: the finest level first."""


def runs_of(chords: Chords) -> Runs:
    """Runs of consecutive chords, which are good for a search where what follows each other lies near each other."""
    levels = [chords]
    while len(levels[-1]) > MAX_COARSE_RUNS:
        levels.append(_grouped(levels[-1]))
    return tuple(levels)


def _grouped(members: Chords) -> Chords:
    """The chords from the start of every FAN members to their end, with all of these within their slack."""
    begins = np.arange(0, len(members), FAN)
    ends = np.append(begins[1:], len(members)) - 1
    start, end = members.start[begins], members.end[ends]
    group = np.arange(len(members)) // FAN
    off = [_off_chord(start[group], end[group], points) for points in (members.start, members.end)]
    return Chords(start, end, np.maximum.reduceat(np.maximum(*off) + members.slack, begins))


def _off_chord(start: Points, end: Points, points: Points) -> Floats:
    """Distance of each point from its chord."""
    chord, away = end - start, points - start
    square = np.maximum((chord * chord.conj()).real, np.finfo(float).tiny)
    share = np.minimum(np.maximum((away * chord.conj()).real / square, 0.0), 1.0)
    off: Floats = np.abs(away - share * chord)
    return off


def nearest_pieces(points: Points, pieces: PieceArrays, tie: float = 0.0) -> tuple[Rows, Rows, Floats]:
    """Triples (k, j, distance), by rising k, then j: for each point the pieces no farther than the nearest and `tie`.

    Exact.  Every point has one, if there is a piece at all.
    """
    runs = runs_of(chords_of(pieces))
    if not len(pieces):
        points = points[:0]
    parts = [_nearest_part(points, start, pieces, runs, tie) for start in range(0, len(points), BATCH_QUERIES)]
    if not parts:
        return np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0)
    k, j, apart = zip(*parts, strict=True)
    return np.concatenate(k), np.concatenate(j), np.concatenate(apart)


def _nearest_part(points: Points, first: int, pieces: PieceArrays, runs: Runs, tie: float) -> tuple[Rows, Rows, Floats]:
    """The triples of BATCH_QUERIES points from `first` on."""
    points = points[first : first + BATCH_QUERIES]
    k, j = np.divmod(np.arange(len(points) * len(runs[-1])), len(runs[-1]))
    known = np.full(len(points), np.inf)
    for level in range(len(runs) - 1, -1, -1):
        chords = runs[level].take(j)
        apart = distance(pieces.take(j), points[k]) if not level else np.abs(points[k] - chords.start)
        known = np.fmin(known, np.fmin.reduceat(apart, k.searchsorted(np.arange(len(points)))))
        least = _off_chord(chords.start, chords.end, points[k]) - chords.slack if level else apart
        # a hair more than what is known: nothing that is exactly as near must be lost
        near = ~(least > known[k] * (1.0 + NEARLY) + tie)
        k, j = k[near], j[near]
        if level:
            j, k = _members(j, k, len(runs[level - 1]))
    return k + first, j, apart[near]


def _members(runs: Rows, partners: Rows, count: int) -> tuple[Rows, Rows]:
    """The members of these runs, of which there are `count` in all, and the partner of each."""
    members = (runs[:, None] * FAN + np.arange(FAN)).ravel()
    partners = partners.repeat(FAN)
    real = members < count
    return members[real], partners[real]
