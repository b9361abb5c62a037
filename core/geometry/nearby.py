"""Nearby: which pieces are near which, found by shapely's tree of boxes and by branch and bound over runs of chords.

Boxes are (4, n) arrays: left, bottom, right, top.

`near_pairs` and `near_pairs_within` are exact for boxes, up to the last digits of a double, and so a superset for what
is inside them: `core.geometry.distance` makes it exact, pair by pair.  They come in batches of some ten thousand pairs:
whoever needs them all at once calls `gathered`, whoever looks at each pair once does not hold them.  With 100,000
chords inside one radius ask what is nearest (`nearest_pairs`, a superset), never what lies in boxes within reach: that
is all pairs.  What has a coordinate that is no number is near everything, so that whoever measures it sees that.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import shapely

from core.geometry.path import Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at

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

MAX_CHORD_LENGTHS: Final = 8.0
"""Median lengths of the pieces from which on a piece is parted: what is long has no piece that is nearest to all of
it."""

EVERYWHERE: Final = np.array([[-1e300], [-1e300], [1e300], [1e300]])
"""The box of what has no known place."""

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


def nearest_pairs(pieces: PieceArrays, others: PieceArrays, tie: float) -> tuple[Rows, Rows]:
    """Pairs (i, j), by rising i, then j, among which is each of `others` that is nearest to any place of each piece.

    So are those that are farther by no more than `tie`.
    """
    if not (len(pieces) and len(others)):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    both = len(pieces) + len(others)
    typical = MAX_CHORD_LENGTHS * min(float(np.median(path.length)) for path in (pieces, others))
    one, rows = _parted(pieces, typical, both)
    other, columns = _parted(others, typical, both)
    batches = [rows[i] * len(others) + columns[j] for i, j in _searched(one, other, tie)]
    pairs = np.concatenate(batches)
    # np.unique takes ten times as long
    pairs.sort()
    first = np.ones(len(pairs), np.bool_)
    np.not_equal(pairs[1:], pairs[:-1], out=first[1:])
    return np.divmod(pairs[first], len(others))


def _parted(pieces: PieceArrays, typical: float, most: int) -> tuple[Chords, Rows]:
    """Chords of the pieces, those longer than `typical` in parts, but not of more than `most` parts in all; and the
    pieces that they are of."""
    length = max(typical, float(pieces.length.sum()) / most)
    counts = np.ones(len(pieces), np.intp)
    long = (pieces.length > length).nonzero()[0]
    counts[long] = np.ceil(pieces.length[long] / length) if length > 0.0 else 1
    rows = np.repeat(np.arange(len(pieces)), counts)
    part = np.arange(len(rows)) - (counts.cumsum() - counts)[rows]
    start, end = pieces.start.take(rows), pieces.end.take(rows)
    inner = (counts[rows] > 1).nonzero()[0]
    if len(inner):
        parted, count = pieces.take(rows[inner]), counts[rows[inner]]
        start[inner], end[inner] = at(parted, part[inner] / count), at(parted, (part[inner] + 1) / count)
    bow = pieces.radius[rows] * (1.0 - np.cos(pieces.angle[rows] / counts[rows] / 2.0))
    return Chords(start, end, bow), rows


def _searched(one: Chords, other: Chords, tie: float) -> Iterator[tuple[Rows, Rows]]:
    """The pairs of chords of which one may hold what is nearest to a place of the other's curve, in batches.

    `within` are for each run lengths within which all of its places have something of the other path.
    """
    first, second = runs_of(one), runs_of(other)
    jumps = _jumps(second)
    within = [np.full(len(level), np.inf) for level in first]
    high, low = len(first) - 1, len(second) - 1
    i, j = np.divmod(np.arange(len(first[high]) * len(second[low])), len(second[low]))
    stack = [(high, low, i, j)]
    while stack:
        high, low, i, j = stack.pop()
        if len(i) > BATCH_PAIRS and i[0] != i[-1]:
            half = max(int(i.searchsorted(i[len(i) // 2])), int(i.searchsorted(i[0], side="right")))
            stack += [(high, low, i[half:], j[half:]), (high, low, i[:half], j[:half])]
            continue
        i, j = _contenders(first[high], i, second[low], j, jumps[low], within[high], tie)
        if not high and not low:
            yield i, j
        elif high >= low:
            members, j = _members(i, j, len(first[high - 1]))
            within[high - 1][members] = np.minimum(within[high - 1][members], within[high][members // FAN])
            order = np.argsort(members, kind="stable")
            stack.append((high - 1, low, members[order], j[order]))
        else:
            j, i = _members(j, i, len(second[low - 1]))
            stack.append((high, low - 1, i, j))


def _jumps(runs: Runs) -> list[Floats]:
    """For each run of each level the largest gap between chords in it: no place of it is so near to its chord."""
    chords = runs[0]
    gap = np.zeros(len(chords))
    gap[:-1] = np.abs(chords.start[1:] - chords.end[:-1])
    levels = [np.zeros(len(chords))]
    for level in runs[1:]:
        size = FAN ** len(levels)
        inner = gap.copy()
        # the gap after the last member belongs to no run
        inner[size - 1 :: size] = 0.0
        levels.append(np.maximum.reduceat(inner, np.arange(0, len(chords), size))[: len(level)])
    return levels


def _contenders(
    one: Chords, i: Rows, other: Chords, j: Rows, jump: Floats, within: Floats, tie: float
) -> tuple[Rows, Rows]:
    """Pairs, by rising i, that come as near as some run does to all of the other; updates `within`.

    Seen along the line through both middles, chords take up room by how far they reach along it.
    """
    half, reach = (one.end - one.start) / 2.0, (other.end - other.start) / 2.0
    between = (other.start + reach).take(j) - (one.start + half).take(i)
    apart = np.abs(between)
    toward = np.conj(between)
    taken = np.abs((half.take(i) * toward).real) + np.abs((reach.take(j) * toward).real)
    least = apart - taken / np.where(apart == 0.0, 1.0, apart) - one.slack.take(i) - other.slack.take(j)
    keep = ~(least > within.take(i) + tie)
    i, j, apart, least = i[keep], j[keep], apart[keep], least[keep]
    if not len(i):
        return i, j
    starts = np.flatnonzero(np.concatenate(([True], i[1:] != i[:-1])))
    closest = np.minimum.reduceat(apart, starts).repeat(np.diff(starts, append=len(i)))
    best = (apart == closest).nonzero()[0]
    a, b = i[best], j[best]
    start, end = other.start.take(b), other.end.take(b)
    ends = np.maximum(_off_chord(start, end, one.start.take(a)), _off_chord(start, end, one.end.take(a)))
    np.minimum.at(within, a, ends + one.slack.take(a) + other.slack.take(b) + jump.take(b))
    keep = ~(least > within.take(i) + tie)
    return i[keep], j[keep]


def _members(runs: Rows, partners: Rows, count: int) -> tuple[Rows, Rows]:
    """The members of these runs, of which there are `count` in all, and the partner of each."""
    members = (runs[:, None] * FAN + np.arange(FAN)).ravel()
    partners = partners.repeat(FAN)
    real = members < count
    return members[real], partners[real]
