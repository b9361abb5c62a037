"""Uncut: the stretches of surface that the cutter does not reach from any point of its path, and their thickness."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, isnan, nan
from typing import Final

import numpy as np

from core.geometry.distance import band_fractions, feet, foot
from core.geometry.path import Flags, Floats, Path, Points, Rows
from core.geometry.piece import Side, point_of
from core.geometry.piece_arrays import PieceArrays, at, batches_by_kind, fraction
from core.tolerance import CLOSED, ON_PATH, STOCK
from core.verify.farthest import farthest
from core.verify.pairs import Intervals, Pairs, concentric, nearest, other_within, pairs_of, rounding_of, within
from core.verify.verdict import Uncut

MAX_POINT_LENGTH: Final = 1e-6
"""Millimeters: a part of a piece no longer than this counts as one point."""

ON_EDGE: Final = 1e-7
"""Millimeters: the end of a gap that is no farther from the cutter's edge counts as on it."""


@dataclass(frozen=True, eq=False, slots=True)
class Gaps:
    """k stretches of a path that the other path does not reach.

    (2, k): the first and the last `pieces` of each, the points at its `ends`, and which ends are `reached`.  (k,): the
    point `farthest` from the other path, and its `distance`.  `corner` is the only place from which both ends are
    reached, `area` lies between the stretch and the circle of the radius about `corner`, positive if the stretch runs
    counterclockwise; both are NaN without such a place."""

    intervals: Intervals
    pieces: Rows
    ends: Points
    reached: Flags
    farthest: Points
    distance: Floats
    corner: Points
    area: Floats


def covered_walls(pairs: Pairs, radius: float, *, closed: bool) -> Flags:
    """Return (n,) True for walls with nothing uncut worth reporting, by their pairs with the center path's pieces."""
    fully_reached = np.zeros(len(pairs.others), np.bool_)
    fully_reached[pairs.j[other_within(pairs, radius + pairs.tolerance)]] = True
    return fully_reached | _in_thin_runs(pairs, fully_reached, radius, closed=closed)


def uncut(
    walls: PieceArrays, moves: PieceArrays, covered: Flags, radius: float, surface: Path, side: Side, *, closed: bool
) -> tuple[Uncut, ...]:
    """Return the stretches farther than the radius from the moves, in the contour's order and across joints.

    Walls that are `covered` are known to be reached.  In a closed contour a stretch that runs over START comes last.
    Intervals that are nowhere thicker than STOCK are left out.
    """
    if covered.all():
        return ()
    pairs = pairs_of(walls, moves, rounding_of(walls), (~covered).nonzero()[0])
    gaps = gaps_of(pairs, covered, radius)
    if not len(gaps.intervals):
        return ()
    intervals, corner = gaps.intervals, gaps.corner
    area = np.where(gaps.area * side.sign > 0.0, np.abs(gaps.area), nan)
    area[~gaps.reached.all(axis=0)] = nan
    parts = stretches(gaps, surface.numbers[walls.rows], radius, area)
    if closed and intervals.first[0] == 0.0 and intervals.last[-1] == walls.stations[-1] and len(parts) > 1:
        joint_area = float(gaps.area[0] + gaps.area[-1]) * side.sign if abs(corner[0] - corner[-1]) <= CLOSED else nan
        parts = [*parts[1:-1], _over_start(parts[-1], parts[0], joint_area if joint_area > 0.0 else None)]
    return tuple(stretch for stretch in parts if stretch.thickness > STOCK)


def stretches(gaps: Gaps, numbers: Floats, radius: float, area: Floats | None = None) -> list[Uncut]:
    """Return the first and the last gap, and those thicker than STOCK; `numbers` (n,) are those of the pieces.

    A gap is as thick as its largest distance exceeds the radius; `area` (k,) is NaN where it is not defined.
    """
    length, thick = gaps.intervals.last - gaps.intervals.first, gaps.distance - radius
    wanted = thick > STOCK
    wanted[:1] = wanted[-1:] = True
    areas = np.full(len(thick), nan) if area is None else area
    columns = (*numbers[gaps.pieces], *gaps.ends, length, thick, gaps.farthest, areas)
    return [
        Uncut(first, last, point_of(start), point_of(end), size, most, point_of(at), None if isnan(over) else over)
        for first, last, start, end, size, most, at, over in zip(
            *(column[wanted].tolist() for column in columns), strict=True
        )
    ]


def _over_start(before: Uncut, after: Uncut, area: float | None) -> Uncut:
    """Merge a closed contour's last and first stretch, which join over START."""
    thicker = max(before, after, key=lambda stretch: stretch.thickness)
    return replace(
        thicker,
        first_number=before.first_number,
        last_number=after.last_number,
        start=before.start,
        end=after.end,
        length=before.length + after.length,
        area=area,
    )


def _in_thin_runs(pairs: Pairs, fully_reached: Flags, radius: float, *, closed: bool) -> Flags:
    """True for walls between two fully reached ones (or an open end), if no wall between these leaves more than STOCK:
    fine chords of a curve leave that little at every joint, and it is not reported."""
    thick = ~fully_reached
    thick[pairs.j[other_within(pairs, np.full(len(pairs.j), radius + STOCK))]] = False
    runs = fully_reached.cumsum()
    if closed and not fully_reached[-1]:
        # a run may go on over START
        runs[runs == runs[-1]] = 0
    reported = np.zeros(len(fully_reached) + 1, np.bool_)
    reported[runs[thick]] = True
    thin: Flags = ~reported[runs]
    return thin


def gaps_of(pairs: Pairs, fully_reached: Flags, radius: float) -> Gaps:
    """Return the stretches of `pairs.pieces` farther than `radius` (mm) from the other path, if longer than STOCK.

    `fully_reached` (n,) marks the pieces that are known to be reached from end to end.
    """
    pieces, stations = pairs.pieces, pairs.stations
    cut = _reached(pairs, fully_reached, radius)
    first, last = np.append(0.0, cut.last), np.append(cut.first, stations[-1])
    wide = (last - first > STOCK).nonzero()[0]
    gaps = Intervals(first[wide], last[wide])
    inward = np.array((gaps.first + ON_PATH, gaps.last - ON_PATH))
    index = stations[1:-1].searchsorted(inward, side="right")
    t = fraction(np.array((gaps.first, gaps.last)) - stations[index], pieces.length[index])
    ends = at(pieces.take(index.ravel()), t.ravel()).reshape(2, -1)
    if not len(pairs.others):
        unknown = np.full(len(gaps), nan)
        nothing = np.zeros(ends.shape, np.bool_)
        return Gaps(gaps, index, ends, nothing, ends[0], np.full(len(gaps), inf), unknown + 0j, unknown)
    far, (corner, reached) = farthest(pairs, gaps), _corners(pairs, index, ends, radius)
    return Gaps(gaps, index, ends, reached, far.point, far.distance, corner, _areas(pairs, gaps, corner, radius))


def _reached(pairs: Pairs, fully_reached: Flags, radius: float) -> Intervals:
    """Return the stretches of the pieces within the radius of the others.

    The tolerance for rounding and uneven arcs helps to decide whether a place is reached; where a stretch ends is then
    settled with the radius alone.
    """
    stations, limit = pairs.stations, radius + pairs.tolerance
    rows = (pairs.least <= limit).nonzero()[0]
    begin, end = np.empty((2, len(rows)))
    for batch in batches_by_kind(pairs.pieces.arcs[pairs.i[rows]], pairs.others.arcs[pairs.j[rows]]):
        begin[batch], end[batch] = _between_feet(pairs, rows[batch], limit[rows[batch]])
    piece = pairs.i[rows]
    curved = pairs.pieces.arcs[piece] | pairs.others.arcs[pairs.j[rows]]
    unsure = curved & ((end - begin) * pairs.pieces.length[piece] > MAX_POINT_LENGTH)
    unsure[unsure] = ~concentric(pairs.keep(rows[unsure]))
    unsure |= pairs.least[rows] < radius - pairs.tolerance[rows]
    sure = (~unsure & (begin <= end)).nonzero()[0]
    start, length = stations[piece[sure]], pairs.pieces.length[piece[sure]]
    known = fully_reached.nonzero()[0]
    measured = within(pairs, rows[unsure], limit[rows[unsure]])
    was_measured = np.zeros(len(pairs.i) + 1, np.bool_)
    was_measured[measured.pair] = True
    first = np.concatenate((stations[known], start + begin[sure] * length, measured.first))
    last = np.concatenate((stations[known + 1], start + end[sure] * length, measured.last))
    pair = np.concatenate((np.full(len(known), -1), rows[sure], measured.pair))
    del limit, begin, end, piece, curved, unsure, sure, start, length, measured
    return _joined_stretches(pairs, first, last, pair, was_measured, radius)


def _between_feet(pairs: Pairs, rows: Rows, limit: Floats) -> tuple[Floats, Floats]:
    """Return the first and the last fraction of these pairs' pieces within the limit, among their ends and the feet of
    the other piece's ends; the first one is the larger if there is none.

    The distance from a line is convex along another line, so all that lies between is within the limit too.
    """
    near = np.concatenate((pairs.from_piece[::2, rows], pairs.from_other[:, rows])) <= limit
    fractions = np.zeros((4, len(rows)))
    fractions[1] = 1.0
    doubtful = (near[2:].any(axis=0) & ~(near[0] & near[1])).nonzero()[0]
    piece, other = pairs.pieces.take(pairs.i[rows[doubtful]]), pairs.others.take(pairs.j[rows[doubtful]])
    fractions[2:, doubtful] = foot(piece, np.array((other.start, other.end)))
    near[2:] &= ~(near[0] & near[1])
    return np.where(near, fractions, 2.0).min(axis=0), np.where(near, fractions, -2.0).max(axis=0)


def _joined_stretches(
    pairs: Pairs, first: Floats, last: Floats, pair: Rows, was_measured: Flags, radius: float
) -> Intervals:
    """Join the parts from `first` to `last` to stretches.

    Ends of pairs with `was_measured` move inward to where the pair is exactly the radius apart.
    """
    order = first.argsort(kind="stable")
    first, last = first[order], last[order]
    furthest = np.maximum.accumulate(last)
    begins = np.ones(len(first), np.bool_)
    begins[1:] = first[1:] > furthest[:-1]
    begin = begins.nonzero()[0]
    if not len(begin):
        return Intervals(first, last)
    reaching = np.maximum.accumulate(np.where(last == furthest, np.arange(len(last)), 0))
    end = reaching[np.append(begin[1:], len(first)) - 1]
    pair = pair[order[np.concatenate((begin, end))]]
    ends = np.concatenate((first[begin], last[end]))
    movable = was_measured[pair].nonzero()[0]
    inward = np.repeat((1.0, -1.0), len(begin))
    ends[movable] += inward[movable] * _overshoot(pairs, pair[movable], ends[movable], inward[movable], radius)
    low, high = ends[: len(begin)], ends[len(begin) :]
    return Intervals(low, np.maximum(low, high))


def _overshoot(pairs: Pairs, pair: Rows, ends: Floats, inward: Floats, radius: float) -> Floats:
    """Return how far `inward` (+1 or -1 along the path) from these ends the distance is the radius, or least.

    The tolerance moves an end by up to sqrt(2 r tolerance) if the reach ends in a circle about the end of a
    piece; the end stops at the foot of that end if the piece is exactly a radius away.
    """
    i, j, tolerance = pairs.i[pair], pairs.j[pair], pairs.tolerance[pair]
    piece, other = pairs.pieces.take(i), pairs.others.take(j)
    fractions = np.concatenate((band_fractions(piece, other, np.full(len(pair), radius)), feet(piece, other)))
    moved = (pairs.stations[i] + fractions * piece.length - ends) * inward
    widest = 2.0 * np.sqrt(2.0 * (radius + tolerance) * tolerance)
    least: Floats = np.where((moved > 0.0) & (moved < widest), moved, inf).min(axis=0)
    return np.where(np.isinf(least), 0.0, least)


def _corners(pairs: Pairs, index: Rows, ends: Points, radius: float) -> tuple[Points, Flags]:
    """Return (k,) the places of the others from which both ends of each gap are reached, and (2, k) which ends are."""
    near = [nearest(pairs, rows, points) for rows, points in zip(index, ends, strict=True)]
    reached = np.array([match.distance[match.first] <= radius + 4.0 * ON_PATH for match in near])
    corner = np.full(len(index[0]), complex(nan, nan))
    for end in (1, 0):
        k, other = near[end].k, pairs.others.take(near[end].j)
        centers = at(other, foot(other, ends[end, k]))
        is_off = np.abs(np.abs(ends[:, k] - centers) - radius) > ON_EDGE
        on_edge = reached[end, k] & ~(is_off & reached[:, k]).any(axis=0)
        corner[k[on_edge]] = centers[on_edge]
    return corner, reached


def _areas(pairs: Pairs, gaps: Intervals, corner: Points, radius: float) -> Floats:
    """Return the (k,) areas between each gap and the circle about its corner."""
    parts = gaps.cut(pairs.stations[1:-1])
    owner, piece = gaps.index(parts.middle), pairs.stations[1:-1].searchsorted(parts.middle, side="right")
    areas, sectors, arcs = np.zeros(len(gaps)), np.empty(len(piece)), pairs.pieces.arcs[piece]
    for rows in batches_by_kind(arcs, arcs):
        part, on = parts.keep(rows), piece[rows]
        sectors[rows] = _sectors(pairs.pieces.take(on), part, pairs.stations[on], corner[owner[rows]], radius)
    np.add.at(areas, owner, sectors)
    return areas


def _sectors(pieces: PieceArrays, parts: Intervals, starts: Floats, corner: Points, radius: float) -> Floats:
    """Return the (m,) areas between each part of a piece and the circle about its corner, positive counterclockwise."""
    t = fraction(np.array((parts.first, parts.middle, parts.last)) - starts, pieces.length)
    first, middle, last = at(pieces, t) - corner
    angle = np.angle(np.conj(first) * middle) + np.angle(np.conj(middle) * last)
    swept = (t[2] - t[0]) * pieces.angle
    bow = pieces.turn * pieces.radius**2 * (swept - np.sin(swept))
    areas: Floats = 0.5 * ((np.conj(first) * last).imag + bow - radius * radius * angle)
    return areas
