"""Nearby: which pieces are near which, found by shapely's tree of boxes and by branch and bound over runs of chords.

Boxes are (4, n) arrays: left, bottom, right, top.

What a search yields is exact or a superset, as its docstring says; it never misses a pair.  "Exact" is up to the last
digits of a double.  A superset is made exact by `core.geometry.distance`, pair by pair.  What has a coordinate that is
no number is near everything, so that whoever measures it sees that.

Pairs come in batches of a few hundred thousand at the most: whoever needs them all at once calls `gathered`, whoever
looks at each pair once does not hold them.  With 100,000 chords inside one radius ask what comes nearer than a limit
(`nearer_than`), never what lies in boxes within reach: the answer to the second is all pairs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import shapely

from core.geometry.distance import distance
from core.geometry.path import Flags, Floats, Points, Rows
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
    for a, b in near_pairs(runs, runs, reach):
        once = a <= b
        a, b = a[once], b[once]
        for first in range(0, len(a), BATCH_PAIRS // RUN):
            part = slice(first, first + BATCH_PAIRS // RUN)
            i, j = _members_of_runs(a[part], b[part], boxes.shape[1])
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

    @property
    def boxes(self) -> Floats:
        """(4, n) boxes around everything that the chords stand for."""
        x, y = np.array((self.start.real, self.end.real)), np.array((self.start.imag, self.end.imag))
        low, high = (x.min(axis=0), y.min(axis=0)), (x.max(axis=0), y.max(axis=0))
        return np.concatenate((low - self.slack, high + self.slack))


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


def nearer_than(one: Runs, other: Runs, limit: float) -> Batches:
    """All pairs (i, j) of pieces of `one` and of `other` that come nearer to each other than `limit`, in no order.

    A superset: chords that come as near as that with their slack, seen along either of both.  Between pieces that are
    short against the limit that is next to exact.  Only runs that come so near are opened, and a batch of them at a
    time: the work grows with the answer and with the number of pieces, not with how many lie within the limit's box.
    """
    coarse = len(one) - 1, len(other) - 1
    for i, j in near_pairs(one[-1].boxes, other[-1].boxes, limit):
        stack = [(*coarse, *_near_chords(one[-1], i, other[-1], j, limit))]
        while stack:
            first, second, i, j = stack.pop()
            if not first and not second:
                yield i, j
                continue
            stack += [(first, second, i[BATCH_PAIRS:], j[BATCH_PAIRS:])] if len(i) > BATCH_PAIRS else []
            stack.append(_opened(one, other, (first, second, i[:BATCH_PAIRS], j[:BATCH_PAIRS]), limit))


def _opened(one: Runs, other: Runs, pairs: tuple[int, int, Rows, Rows], limit: float) -> tuple[int, int, Rows, Rows]:
    """These pairs of runs of two levels with the coarser ones of both opened into their members."""
    first, second, i, j = pairs
    if first >= second:
        first -= 1
        i, j = _members(i, j, len(one[first]))
    else:
        second -= 1
        j, i = _members(j, i, len(other[second]))
    return (first, second, *_near_chords(one[first], i, other[second], j, limit))


def _members(runs: Rows, partners: Rows, count: int) -> tuple[Rows, Rows]:
    """The members of these runs, of which there are `count` in all, and the partner of each."""
    members = (runs[:, None] * FAN + np.arange(FAN)).ravel()
    partners = partners.repeat(FAN)
    real = members < count
    return members[real], partners[real]


def _near_chords(one: Chords, i: Rows, other: Chords, j: Rows, limit: float) -> tuple[Rows, Rows]:
    """Of these pairs those that may come nearer than the limit."""
    a, b = one.take(i), other.take(j)
    room = limit + a.slack + b.slack
    near: Flags = ~(_at_least_apart(a, b) >= room)
    i, j, room = i[near], j[near], room[near]
    near = ~(_at_least_apart(other.take(j), one.take(i)) >= room)
    return i[near], j[near]


def _at_least_apart(chord: Chords, other: Chords) -> Floats:
    """Distance between a chord and the box along it around the other one."""
    vector = chord.end - chord.start
    length = np.abs(vector)
    with np.errstate(invalid="ignore"):
        unit = (vector + (length == 0.0)).conj() / np.where(length == 0.0, 1.0, length)
    start, end = (other.start - chord.start) * unit, (other.end - chord.start) * unit
    ahead = np.maximum(np.minimum(start.real, end.real) - length, -np.maximum(start.real, end.real))
    aside = np.maximum(np.minimum(start.imag, end.imag), -np.maximum(start.imag, end.imag))
    apart: Floats = np.hypot(np.maximum(ahead, 0.0), np.maximum(aside, 0.0))
    return apart


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


def closest_pieces(one: PieceArrays, other: PieceArrays) -> tuple[Rows, Rows]:
    """Pairs (i, j), by rising i, then j, among which are all with the least distance between two sets of pieces.

    A superset: what may come so near as two starts come somewhere.  Neither set is empty.
    """
    first, second = runs_of(chords_of(one)), runs_of(chords_of(other))
    level, below = len(first) - 1, len(second) - 1
    i, j = np.divmod(np.arange(len(first[level]) * len(second[below])), len(second[below]))
    while True:
        a, b = first[level].take(i), second[below].take(j)
        least = np.maximum(_at_least_apart(a, b), _at_least_apart(b, a)) - a.slack - b.slack
        near = ~(least > np.fmin.reduce(np.abs(a.start - b.start)) * (1.0 + NEARLY))
        i, j = i[near], j[near]
        if not level and not below:
            return gathered([(i, j)])
        if level >= below:
            level -= 1
            i, j = _members(i, j, len(first[level]))
        else:
            below -= 1
            j, i = _members(j, i, len(second[below]))
