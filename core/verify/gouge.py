"""Gouges: the stretches of a center path nearer to the surface than the radius, each with its deepest point."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import Final

import numpy as np

from core.geometry.distance import distances_at, foot, nearest_fractions
from core.geometry.nearby import changes
from core.geometry.path import Floats, Path, Rows
from core.geometry.piece import point_of
from core.geometry.piece_arrays import PieceArrays, at, batches_by_kind, fraction
from core.tolerance import GOUGE, JOINED, ON_PATH
from core.verify.pairs import NO_INTERVALS, Intervals, Pairs, Parts, joined, measured, merged, uneven_slack, within
from core.verify.verdict import Approach, Gouge

PAIRS_AT_A_TIME: Final = 2_000
"""Gouging pairs that are processed at a time, which bounds the memory in use."""

LOOP_GAP: Final = 1.0
"""Millimeters inserted between two loops, far more than the rounding between ends that touch."""


@dataclass(frozen=True, eq=False, slots=True)
class Gouging:
    """k stretches of the center path that gouge, and for each the deepest place, its distance and its pair (i, j)."""

    intervals: Intervals
    place: Floats
    distance: Floats
    i: Rows
    j: Rows

    def __len__(self) -> int:
        return len(self.intervals)


def gouging(pairs: Pairs, limit: float) -> Gouging:
    """Find where the center path is nearer to the surface than the limit, less the slack of uneven arcs.

    Raises NotMeasurableError if a distance is not a number.
    """
    limits = limit - uneven_slack(pairs.pieces, pairs.i, pairs.others, pairs.j)
    near = (pairs.least < limits).nonzero()[0]
    if not len(near):
        none = np.zeros(0)
        return Gouging(NO_INTERVALS, none, none, near, near)
    gaps = LOOP_GAP * _loops(pairs.pieces).astype(np.float64)
    some_at_a_time = (near[first : first + PAIRS_AT_A_TIME] for first in range(0, len(near), PAIRS_AT_A_TIME))
    deepest = []
    for rows in some_at_a_time:
        # the parts nearer than the limit, and the places where they may be nearest
        spots, distances, pair = approaches(pairs, rows, limits[rows])
        near_parts = joined((within(pairs, rows, limits[rows]), Parts(spots, spots, spots, distances, pair)))
        deepest.append(_deepest(pairs, near_parts, gaps))
    parts = _deepest(pairs, joined(deepest), gaps)
    intervals = Intervals(parts.first, parts.last)
    return Gouging(intervals, parts.middle, parts.distance, pairs.i[parts.pair], pairs.j[parts.pair])


def approaches(pairs: Pairs, rows: Rows, limit: Floats) -> tuple[Floats, Floats, Rows]:
    """Return the places, in length traveled, where these pairs' pieces may be nearest to the others, if nearer than
    `limit` (m,); also the distance and the pair of each place."""
    batches = [np.zeros((3, 0))]
    for batch in batches_by_kind(pairs.pieces.arcs[pairs.i[rows]], pairs.others.arcs[pairs.j[rows]]):
        pair = rows[batch]
        pieces, others = pairs.pieces.take(pairs.i[pair]), pairs.others.take(pairs.j[pair])
        fractions = nearest_fractions(pieces, others)
        distances = measured(distances_at(pieces, others, fractions))
        new = (fractions > 0.0) & (fractions < 1.0)
        # the first two are the ends
        new[:2] = True
        k, row = np.nonzero(new & (distances < limit[batch]))
        spots = pairs.stations[pairs.i[pair[row]]] + fractions[k, row] * pieces.length[row]
        batches.append(np.array((spots, distances[k, row], pair[row])))
    spots, distances, pair = np.concatenate(batches, axis=1)
    return spots, distances, pair.astype(np.intp)


def closest(pairs: Pairs, surface: Path) -> Approach | None:
    """Find where the path comes nearest to the surface; distances that differ by no more than GOUGE count as equal."""
    if not len(pairs.i):
        return None
    least = pairs.least.min()
    near = pairs.least <= least + GOUGE
    rows = (near & (pairs.i == pairs.i[near.argmax()])).nonzero()[0]
    spots, distances, pair = approaches(pairs, rows, np.full(len(rows), inf))
    first = np.lexsort((pairs.j[pair], np.round(spots / ON_PATH), distances > least + GOUGE))[:1]
    piece, wall = pairs.pieces.take(pairs.i[pair[first]]), pairs.others.take(pairs.j[pair[first]])
    center = at(piece, fraction(spots[first] - pairs.stations[pairs.i[pair[first]]], piece.length))
    cut = at(wall, foot(wall, center))
    return Approach(float(least), point_of(center[0]), point_of(cut[0]), float(surface.numbers[wall.rows[0]]))


def _loops(moves: PieceArrays) -> Rows:
    """Return (n,) the loop that each move belongs to; a loop begins where a move does not join the one before it."""
    return np.append(0, (np.abs(moves.start[1:] - moves.end[:-1]) > JOINED).cumsum())


def _deepest(pairs: Pairs, parts: Parts, gaps: Floats) -> Parts:
    """Join the parts to stretches, each with the least distance measured in it; the first pair wins a tie.

    For the joining, parts move on by the `gaps` (n,) of their pieces, so that those of two loops do not touch.
    """
    gap = gaps[pairs.i[parts.pair]]
    intervals = merged(parts.first + gap, parts.last + gap)
    owner, distances = intervals.index(parts.middle + gap), np.round(parts.distance / ON_PATH)
    order = np.lexsort((parts.pair, distances, owner))
    best = order[changes(owner[order])]
    first, last = intervals.first - gap[best], intervals.last - gap[best]
    return Parts(first, last, parts.middle[best], parts.distance[best], parts.pair[best])


def gouges(hits: Gouging, pairs: Pairs, radius: float, surface: Path, numbers: Floats) -> tuple[Gouge, ...]:
    """Return the stretches as `Gouge`s, deepest first; `numbers` are those of the center path's pieces."""
    if not len(hits):
        return ()
    piece, wall = pairs.pieces.take(hits.i), pairs.others.take(hits.j)
    points = at(piece, fraction(hits.place - pairs.stations[hits.i], piece.length))
    cut = at(wall, foot(wall, points))
    columns = (
        radius - hits.distance,
        points.real,
        points.imag,
        cut.real,
        cut.imag,
        piece.rows,
        numbers[piece.rows],
        surface.numbers[wall.rows],
        hits.intervals.last - hits.intervals.first,
    )
    every = [
        Gouge(depth, (x, y), (u, v), row, number, segment, extent)
        for depth, x, y, u, v, row, number, segment, extent in zip(
            *(column.tolist() for column in columns), strict=True
        )
    ]
    for first, last in reversed(_over_seams(hits, pairs)):
        less, deeper = sorted((every.pop(last), every[first]), key=lambda gouge: gouge.depth)
        every[first] = replace(deeper, extent=deeper.extent + less.extent)
    # among equally deep gouges the earliest along the path comes first, whatever the last digits say
    return tuple(sorted(every, key=lambda gouge: -round(gouge.depth / ON_PATH)))


def _over_seams(hits: Gouging, pairs: Pairs) -> list[tuple[int, int]]:
    """Return the first and the last stretch of each closed loop that gouges across its start: these two are one."""
    moves, stations, loops = pairs.pieces, pairs.stations, _loops(pairs.pieces)
    owner = loops[hits.i]
    first = changes(owner)
    last = owner.searchsorted(owner[first], side="right") - 1
    begin, end = loops.searchsorted(owner[first]), loops.searchsorted(owner[first], side="right") - 1
    closed = np.abs(moves.end[end] - moves.start[begin]) <= JOINED
    at_start = hits.intervals.first[first] <= stations[begin] + JOINED
    at_end = hits.intervals.last[last] >= stations[end + 1] - JOINED
    over = closed & at_start & at_end & (first < last)
    return list(zip(first[over].tolist(), last[over].tolist(), strict=True))
