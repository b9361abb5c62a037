"""Nearby finds which pieces are near which, with shapely's tree of boxes and by branch and bound over runs of chords.

Boxes are (4, n) arrays: left, bottom, right, top.

`near_pairs` and `near_pairs_within` are exact for boxes, up to the last digits of a double, and so yield a superset for
the pieces inside: `core.geometry.distance` then measures each pair exactly.  Both yield batches of some ten thousand
pairs; `sorted_pairs` collects them for callers that need all of them at once.  With 100,000 chords inside one radius,
nearly all boxes are within reach of each other: ask for the nearest pieces instead (`nearest_pairs`, a superset).
A piece with a NaN coordinate counts as near everything, so that the code that measures the pair sees the NaN.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import shapely

from core.geometry.path import Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at

MEMBERS_PER_RUN: Final = 4
"""Number of consecutive chords, or of consecutive runs, that make up a run."""

BOXES_PER_RUN: Final = 8
"""Consecutive boxes that one query of the tree covers together."""

MAX_COARSE_RUNS: Final = 32
"""Most runs on the coarsest level, where every run of one path is compared with every run of the other."""

BATCH_PAIRS: Final = 1 << 13
"""Pairs of runs that are opened at a time: few enough to stay in a processor's cache."""

BATCH_QUERIES: Final = 1024
"""Most boxes that are looked up in the tree at a time, where few boxes are near each other."""

MAX_CHORD_LENGTHS: Final = 8.0
"""A piece longer than this many median lengths is split, since no single piece of the other path is nearest to all of
it."""

NEIGHBOR_OFFSETS: Final = range(-MEMBERS_PER_RUN // 2, MEMBERS_PER_RUN + MEMBERS_PER_RUN // 2)
"""Offsets of a run's members and, on either side, of half as many members of the neighboring runs."""

ROUNDING_SHARE: Final = 1e-15
"""Largest rounding error of a difference of coordinates, as a share of the coordinates."""

EVERYWHERE: Final = np.array([[-1e300], [-1e300], [1e300], [1e300]])
"""The box of a piece whose coordinates are not numbers."""

Batches = Iterator[tuple[Rows, Rows]]


@dataclass(frozen=True, eq=False, slots=True)
class BoxTree:
    """Boxes (4, n) with their search tree, for more than one query."""

    boxes: Floats
    tree: shapely.STRtree

    @staticmethod
    def of(boxes: Floats) -> BoxTree:
        """Build the tree of these boxes."""
        return BoxTree(boxes, shapely.STRtree(_diagonals(boxes)))


def near_pairs(first: Floats, second: Floats | BoxTree, reach: float) -> Batches:
    """Yield all pairs (i, j) of a box of `first` and a box of `second` no farther apart than `reach`, by rising i.

    The pairs are exact for the boxes, hence a superset for the pieces inside them.
    """
    boxes = second.boxes if isinstance(second, BoxTree) else second
    if not (first.shape[1] and boxes.shape[1]):
        return
    tree = second.tree if isinstance(second, BoxTree) else BoxTree.of(boxes).tree
    grown = first + np.array([[-reach], [-reach], [reach], [reach]])
    start, count = 0, 64
    while start < first.shape[1]:
        i, j = tree.query(_diagonals(grown[:, start : start + count]))
        i += start
        start += count
        # the grown boxes have square corners, which lie beyond `reach`
        near = ~(_box_distances(first.take(i, axis=1), boxes.take(j, axis=1)) > reach)
        yield i[near], j[near]
        count = min(BATCH_QUERIES, 2 * count) if len(i) < BATCH_PAIRS else max(1, count // 2)


def near_pairs_within(boxes: Floats, reach: float) -> Batches:
    """Yield all pairs (i, j), i < j, of these boxes no farther apart than `reach`, unordered and as exact as above.

    Each query covers a run of consecutive boxes, which lie close together along a path; it takes a quarter of the time.
    """
    if not boxes.shape[1]:
        return
    begins = np.arange(0, boxes.shape[1], BOXES_PER_RUN)
    corners = np.minimum.reduceat(boxes[:2], begins, axis=1), np.maximum.reduceat(boxes[2:], begins, axis=1)
    runs = np.concatenate(corners)
    left, right = np.ascontiguousarray(boxes[0]), np.ascontiguousarray(boxes[2])
    for a, b in near_pairs(runs, runs, reach):
        ordered = a <= b
        a, b = a[ordered], b[ordered]
        for first in range(0, len(a), BATCH_PAIRS // BOXES_PER_RUN):
            part = slice(first, first + BATCH_PAIRS // BOXES_PER_RUN)
            i, j = _members_of_runs(a[part], b[part], boxes.shape[1])
            # most pairs are already too far apart along x
            near = ~(np.maximum(left[i] - right[j], left[j] - right[i]) > reach)
            i, j = i[near], j[near]
            near = ~(_box_distances(boxes.take(i, axis=1), boxes.take(j, axis=1)) > reach)
            yield i[near], j[near]


def _members_of_runs(a: Rows, b: Rows, count: int) -> tuple[Rows, Rows]:
    """Return all pairs i < j of boxes in the paired runs a, b; there are `count` boxes in all."""
    i, j = np.divmod(np.arange(BOXES_PER_RUN * BOXES_PER_RUN), BOXES_PER_RUN)
    i, j = (a[:, None] * BOXES_PER_RUN + i).ravel(), (b[:, None] * BOXES_PER_RUN + j).ravel()
    ordered = (i < j) & (j < count)
    return i[ordered], j[ordered]


def sorted_pairs(batches: Iterable[tuple[Rows, Rows]]) -> tuple[Rows, Rows]:
    """Return all pairs of these batches, sorted by i and then by j."""
    none = np.zeros(0, np.intp)
    columns = list(zip(*batches, strict=True)) or [(none,), (none,)]
    i, j = (np.concatenate(column) for column in columns)
    order = np.lexsort((j, i))
    return i[order], j[order]


def point_boxes(points: Points) -> Floats:
    """Return the (4, k) boxes of points."""
    return np.array((points.real, points.imag, points.real, points.imag))


def changes(values: Rows) -> Rows:
    """Return the row where each run of equal values begins."""
    begins = np.ones(len(values), np.bool_)
    np.not_equal(values[1:], values[:-1], out=begins[1:])
    return begins.nonzero()[0]


def _diagonals(boxes: Floats) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """Return a diagonal line for each box: the tree reads only its bounding box, and a line needs little memory."""
    known = np.where(np.isnan(boxes), EVERYWHERE, boxes)
    lines: np.ndarray[tuple[int], np.dtype[np.object_]] = shapely.linestrings(known.T.reshape(-1, 2, 2))
    return lines


def _box_distances(first: Floats, second: Floats) -> Floats:
    """Return the distances between boxes, 0 where they meet."""
    gaps = np.maximum(np.maximum(first[:2] - second[2:], second[:2] - first[2:]), 0.0)
    distances: Floats = np.hypot(gaps[0], gaps[1])
    return distances


@dataclass(frozen=True, eq=False, slots=True)
class CoarseChords:
    """(n,) straight lines from `middle` - `half` to `middle` + `half`, each standing for a piece or a run of pieces.

    No point of a line is farther than `slack` from its pieces, nor the reverse; `low` and `high` are the corners of the
    box that holds the pieces.  `square` is the square of half the length, never 0.
    """

    middle: Points
    half: Points
    slack: Floats
    low: Points
    high: Points
    square: Floats

    @staticmethod
    def between(start: Points, end: Points, slack: Floats, box: tuple[Points, Points] | None = None) -> CoarseChords:
        """Make the chords from `start` to `end`; without `box`, each gets the box of the chord grown by its slack."""
        middle, half = (start + end) / 2.0, (end - start) / 2.0
        room = np.abs(half.real) + slack + 1j * (np.abs(half.imag) + slack)
        low, high = box or (middle - room, middle + room)
        square = np.maximum((half * half.conj()).real, np.finfo(float).tiny)
        return CoarseChords(middle, half, slack, low, high, square)

    def __len__(self) -> int:
        return len(self.middle)

    @property
    def ends(self) -> tuple[Points, Points]:
        """(n,) first and last points."""
        return self.middle - self.half, self.middle + self.half

    def vectors_to(self, rows: Rows, points: Points) -> Points:
        """Return the vector to each point (m,) from the nearest point of the chord in its row."""
        from_middle, half = points - self.middle.take(rows), self.half.take(rows)
        share = (from_middle * half.conj()).real / self.square.take(rows)
        return from_middle - np.minimum(np.maximum(share, -1.0), 1.0) * half


ChordLevels = tuple[CoarseChords, ...]
"""Chords of the pieces, of runs of `MEMBERS_PER_RUN` pieces, of runs of such runs and so on: the finest level first."""


def chord_levels(chords: CoarseChords) -> ChordLevels:
    """Group consecutive chords into runs, level by level; searching them is fast where neighbors lie close together."""
    levels = [chords]
    while len(levels[-1]) > MAX_COARSE_RUNS:
        levels.append(_grouped(levels[-1]))
    return tuple(levels)


def _grouped(members: CoarseChords) -> CoarseChords:
    """Return one chord for every `MEMBERS_PER_RUN` members, from the start of the first to the end of the last.

    A run without gaps passes abreast of every point of its chord, so its slack is the largest distance of its members
    from the chord; the largest gap adds to it.
    """
    begins = np.arange(0, len(members), MEMBERS_PER_RUN)
    lasts = np.append(begins[1:], len(members)) - 1
    starts, ends = members.ends
    chords = CoarseChords.between(starts[begins], ends[lasts], np.zeros(len(begins)))
    group = np.arange(len(members)) // MEMBERS_PER_RUN
    distances = np.maximum(*(np.abs(chords.vectors_to(group, points)) for points in (starts, ends))) + members.slack
    gaps = np.append(0.0, np.abs(starts[1:] - ends[:-1]))
    gaps[begins] = 0.0
    slack = np.maximum.reduceat(distances, begins) + np.maximum.reduceat(gaps, begins)
    box = _per_axis(np.minimum.reduceat, members.low, begins), _per_axis(np.maximum.reduceat, members.high, begins)
    return CoarseChords.between(starts[begins], ends[lasts], slack, box)


def _per_axis(reduce: Callable[..., Floats], points: Points, begins: Rows) -> Points:
    """Apply `reduce` to the x and the y coordinates of points separately."""
    return reduce(points.view(np.float64).reshape(-1, 2), begins, axis=0).view(np.complex128).ravel()


def nearest_pairs(pieces: PieceArrays, others: PieceArrays, tie: float) -> tuple[Rows, Rows]:
    """Return pairs (i, j), by rising i, then j, including every piece j of `others` nearest to some point of piece i.

    Pieces that are farther by no more than `tie` are included too.
    """
    if not (len(pieces) and len(others)):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    both = len(pieces) + len(others)
    typical = MAX_CHORD_LENGTHS * min(float(np.median(path.length)) for path in (pieces, others))
    first, rows = _split_into_chords(pieces, typical, both)
    second, columns = _split_into_chords(others, typical, both)
    batches = [rows[i] * len(others) + columns[j] for i, j in _nearest_chord_pairs(first, second, tie)]
    pairs = np.concatenate(batches)
    # np.unique takes ten times as long
    pairs.sort()
    return np.divmod(pairs[changes(pairs)], len(others))


def _split_into_chords(pieces: PieceArrays, typical: float, max_extra_parts: int) -> tuple[CoarseChords, Rows]:
    """Return chords of the pieces and the row of each chord's piece; those longer than `typical` are split into at most
    `max_extra_parts` extra parts in all."""
    length = max(typical, float(pieces.length.sum()) / max_extra_parts)
    counts = np.ones(len(pieces), np.intp)
    long = (pieces.length > length).nonzero()[0]
    counts[long] = np.ceil(pieces.length[long] / length) if length > 0.0 else 1
    rows = np.repeat(np.arange(len(pieces)), counts)
    part = np.arange(len(rows)) - (counts.cumsum() - counts)[rows]
    start, end = pieces.start.take(rows), pieces.end.take(rows)
    split_rows = (counts[rows] > 1).nonzero()[0]
    if len(split_rows):
        long_pieces, nth, count = pieces.take(rows[split_rows]), part[split_rows], counts[rows[split_rows]]
        start[split_rows], end[split_rows] = at(long_pieces, nth / count), at(long_pieces, (nth + 1) / count)
    sagitta = pieces.radius[rows] * (1.0 - np.cos(pieces.angle[rows] / counts[rows] / 2.0))
    return CoarseChords.between(start, end, sagitta), rows


def _nearest_chord_pairs(chords: CoarseChords, other_chords: CoarseChords, tie: float) -> Iterator[tuple[Rows, Rows]]:
    """Yield the pairs of chords whose second piece may be nearest to some point of the first one's, in batches."""
    first, second = chord_levels(chords), chord_levels(other_chords)
    within = _within(first, second)
    high, low = len(first) - 1, len(second) - 1
    i, j = np.divmod(np.arange(len(first[high]) * len(second[low])), len(second[low]))
    stack = [(high, low, i, j)]
    while stack:
        high, low, i, j = stack.pop()
        if len(i) > BATCH_PAIRS and i[0] != i[-1]:
            half = max(int(i.searchsorted(i[len(i) // 2])), int(i.searchsorted(i[0], side="right")))
            stack += [(high, low, i[half:], j[half:]), (high, low, i[:half], j[:half])]
            continue
        i, j = _contenders(first[high], i, second[low], j, within[high], tie)
        if not high and not low:
            yield i, j
        elif high >= low:
            members, j = _members(i, j, len(first[high - 1]))
            order = np.argsort(members, kind="stable")
            stack.append((high - 1, low, members[order], j[order]))
        else:
            j, i = _members(j, i, len(second[low - 1]))
            stack.append((high, low - 1, i, j))


def _within(first: ChordLevels, second: ChordLevels) -> list[Floats]:
    """Return, for each run of each level, a distance within which each of its points has a piece of the other path.

    A guess yields it: the search descends from the nearest run to its nearest member, or a member next to those.
    """
    high, low = len(first) - 1, len(second) - 1
    guess = np.abs(first[high].middle[:, None] - second[low].middle).argmin(axis=1)
    while high or low:
        if high >= low:
            high -= 1
            guess = guess[np.arange(len(first[high])) // MEMBERS_PER_RUN]
        else:
            low -= 1
            guess = _closest_member(first[high].middle, second[low].middle, guess)
    chords, other_chords = first[0], second[0]
    distances = np.maximum(*(np.abs(other_chords.vectors_to(guess, end)) for end in chords.ends))
    within = [distances + chords.slack + other_chords.slack[guess]]
    while len(within) < len(first):
        within.append(np.maximum.reduceat(within[-1], np.arange(0, len(within[-1]), MEMBERS_PER_RUN)))
    return within


def _closest_member(points: Points, middles: Points, runs: Rows) -> Rows:
    """Return, for each point, the closest among the middles of its run's members and those around them."""
    closest, least = np.zeros(len(points), np.intp), np.full(len(points), np.inf)
    for step in NEIGHBOR_OFFSETS:
        members = np.minimum(np.maximum(runs * MEMBERS_PER_RUN + step, 0), len(middles) - 1)
        distances = np.abs(points - middles.take(members))
        closer = distances < least
        closest, least = np.where(closer, members, closest), np.where(closer, distances, least)
    return closest


def _contenders(
    chords: CoarseChords, i: Rows, other: CoarseChords, j: Rows, within: Floats, tie: float
) -> tuple[Rows, Rows]:
    """Keep the pairs, by rising i, whose j may be nearest to some point of i; no point of i is farther than `within`.

    Along chord i the distance to another chord is convex.  So the distance to j is bounded from below by its tangent at
    i's middle, and the distance to the j closest there is bounded from above by the line between its values at i's
    ends.  Both bounds are straight, so a j that is farther at both ends is farther everywhere.
    """
    limit = within.take(i) + tie
    after, before = chords.low.take(i) - other.high.take(j), other.low.take(j) - chords.high.take(i)
    gaps = np.maximum(after.view(np.float64), before.view(np.float64))
    keep = (~(np.abs(np.maximum(gaps, 0.0, out=gaps).view(np.complex128)) > limit)).nonzero()[0]
    i, j, limit = i[keep], j[keep], limit[keep]
    middle, half = chords.middle.take(i), chords.half.take(i)
    vectors = other.vectors_to(j, middle)
    # a NaN counts as nearest, and then no other chord is known to be farther
    distances = np.fmax(np.abs(vectors), np.finfo(float).tiny)
    slope = (vectors.conj() * half).real / distances
    # a vector as short as the rounding of coordinates has no direction
    rounding = ROUNDING_SHARE * np.abs(middle) * np.abs(half) / distances
    nearest_possible = distances - rounding - chords.slack.take(i) - other.slack.take(j)
    keep = (~(nearest_possible - np.abs(slope) > limit)).nonzero()[0]
    i, j, distances, nearest_possible, slope = i[keep], j[keep], distances[keep], nearest_possible[keep], slope[keep]
    if not len(i):
        return i, j
    begins = changes(i)
    counts = np.diff(begins, append=len(i))
    best = (distances == np.minimum.reduceat(distances, begins).repeat(counts)).nonzero()[0]
    best = best[changes(i[best])]
    nearest, allowance = j[best], tie + chords.slack.take(i[best]) + other.slack.take(j[best])
    middle, half = chords.middle.take(i[best]), chords.half.take(i[best])
    at_start, at_end = (np.abs(other.vectors_to(nearest, end)) + allowance for end in (middle - half, middle + half))
    farther = (nearest_possible - slope > at_start.repeat(counts)) & (nearest_possible + slope > at_end.repeat(counts))
    return i[~farther], j[~farther]


def _members(runs: Rows, partners: Rows, count: int) -> tuple[Rows, Rows]:
    """Return the members of these runs and the partner of each; there are `count` members in all."""
    members = (runs[:, None] * MEMBERS_PER_RUN + np.arange(MEMBERS_PER_RUN)).ravel()
    partners = partners.repeat(MEMBERS_PER_RUN)
    existing = members < count
    return members[existing], partners[existing]
