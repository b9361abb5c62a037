"""Wrong side: which pieces of a center path run on the part's side of the surface, and how far inside they get.

A path changes sides where it meets the surface and, along an open contour, where it passes the normal at a free end,
beyond which there is no side.  Split at these places, each part of the path is on one side: that of its middle.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Final

import numpy as np

from core.geometry.distance import foot, fractions_on_line
from core.geometry.nearby import changes
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece import Side
from core.geometry.piece_arrays import PAIRS_PER_BATCH, PieceArrays, at, direction, piece_at
from core.tolerance import GOUGE, JOINED, ON_PATH
from core.verify.farthest import DISTANCE_TOLERANCE, farthest
from core.verify.gouge import Gouging, approaches
from core.verify.pairs import NO_INTERVALS, Intervals, Nearest, Pairs, merged, near_ends_and_middle, nearest
from core.verify.self_crossings import SelfCrossings, at_joints

MIN_SIDE_SINE: Final = 1e-6
"""A point whose angle to the surface's tangent has a smaller sine is on neither side."""

TESTED_SHARES: Final = np.linspace(0.0, 1.0, 65)[1:-1, None]
"""(63, 1) shares of a part at which its side is tested where walls may contradict each other."""

PARTS_AT_A_TIME: Final = 256
"""Parts that are tested at a time, which bounds the memory in use."""

MAX_HALVINGS: Final = 40
"""Bisections that locate a change of side: enough for the last digit of any part's length."""


@dataclass(frozen=True, eq=False, slots=True)
class SidedSurface:
    """A surface with sides; the cutter belongs on `side`.

    `stations` are lengths traveled at its pieces' starts and at the end.  The surface has a side only between `first`
    and `last`, exclusive, unless it is `endless`.  If it is `crossed`, the sides of two of its walls may
    contradict each other near both.
    """

    side: Side
    stations: Floats
    first: float
    last: float
    endless: bool
    crossed: bool


def with_sides(side: Side, walls: PieceArrays, crossings: SelfCrossings, *, closed: bool) -> SidedSurface:
    """Return the surface with its sides; an over-run bounds no material and has no side.

    An over-run is the stretch from an open contour's end to its outermost self-crossing, if it is shorter than the
    stretch between the outermost self-crossings.
    """
    stations = walls.stations
    first, last = 0.0, float(stations[-1])
    if len(crossings) and not closed:
        low, high = float(crossings.places.min()), float(crossings.places.max())
        first, last = low if low < high - low else first, high if last - high < high - low else last
    return SidedSurface(side, stations, first, last, closed, len(crossings) > 0)


def wrong_side(pairs: Pairs, hits: Gouging, surface: SidedSurface, radius: float) -> tuple[Flags, Gouging]:
    """Return (n,) True for pieces of the center path on the part's side, and the gouges with their depth there.

    A gouge that reaches the part's side is reported at its place farthest inside.  Every piece is tested at its middle,
    one away from the surface also at its ends, and gouging stretches in each part between possible changes of side.
    An open contour has no side where one of its ends is the nearest point; elsewhere the nearest wall decides.  There
    every piece that does not keep to one wall is tested at its ends, and a gouge at its ends, its middle and its
    deepest place; a piece that meets no wall may still be on another side between these places.
    """
    if not len(pairs.pieces):
        return np.zeros(0, np.bool_), hits
    parts = _parts(pairs, hits, surface, radius)
    index, t = np.arange(len(pairs.pieces)), np.full(len(pairs.pieces), 0.5)
    tested = (~(_near_surface(pairs, radius) if surface.endless else _on_one_wall(pairs, hits, radius))).nonzero()[0]
    index, t = np.concatenate((index, tested, tested)), np.concatenate((t, np.zeros(len(tested)), np.ones(len(tested))))
    spots = np.concatenate((_gouge_positions(hits, surface), parts.middle))
    owners, shares = piece_at(pairs.pieces, pairs.stations, spots)
    count, index, t = len(index), np.concatenate((index, owners)), np.concatenate((t, shares))
    on_part = _on_part_side(pairs, index, t, surface)
    if surface.crossed:
        s = np.concatenate((pairs.stations[index[:count]] + t[:count] * pairs.pieces.length[index[:count]], spots))
        on_part &= ~hits.intervals.holds(s)
    wrong = np.zeros(len(pairs.pieces), np.bool_)
    moves, inside = on_part[: len(on_part) - len(parts)], on_part[len(on_part) - len(parts) :]
    wrong[index[: len(moves)][moves]] = True
    return _with_depth(pairs, parts.keep(inside), hits, wrong, radius)


def _on_part_side(pairs: Pairs, index: Rows, t: Floats, surface: SidedSurface) -> Flags:
    """True for places, at fractions `t` of pieces `index`, that are on the part's side."""
    on_part = np.zeros(len(index), np.bool_)
    for first in range(0, len(index), PAIRS_PER_BATCH):
        batch = slice(first, first + PAIRS_PER_BATCH)
        points = at(pairs.pieces.take(index[batch]), t[batch])
        on_part[batch] = on_part_side(pairs.others, points, nearest(pairs, index[batch], points), surface)
    return on_part


def _with_depth(pairs: Pairs, inside: Intervals, hits: Gouging, wrong: Flags, radius: float) -> tuple[Flags, Gouging]:
    """Mark in `wrong` the pieces that go deeper than GOUGE in the parts `inside`, and update the gouges' depths.

    On the part's side a gouge's distance is negative.  A gouge ends where the path is the radius away again, less GOUGE
    and the slack of uneven arcs: if its farthest place is such an end, the whole cutter is inside the part there.
    """
    inside = inside.cut(pairs.stations[1:-1])
    # a gouge is nowhere farther from the surface
    largest_possible = radius - GOUGE if radius > GOUGE else inf
    far = farthest(pairs, inside, largest_possible)
    deep = (far.distance > GOUGE).nonzero()[0]
    middle, spots, distances, wall = inside.middle[deep], far.place[deep], far.distance[deep], far.near[deep]
    index = pairs.stations[1:-1].searchsorted(middle, side="right")
    wrong[index] = True
    in_gouge = hits.intervals.holds(middle).nonzero()[0]
    if not len(in_gouge):
        return wrong, hits
    slack = float(pairs.pieces.slack.max() + pairs.others.slack.max())
    owner, spots, distances = hits.intervals.index(middle[in_gouge]), spots[in_gouge], distances[in_gouge]
    distances = np.where(distances >= radius - GOUGE - slack - 2.0 * DISTANCE_TOLERANCE, radius, distances)
    order = np.lexsort((spots, -np.round(distances / ON_PATH), owner))
    best = order[changes(owner[order])]
    gouge, deepest = owner[best], in_gouge[best]
    places, distance, i, j = hits.place.copy(), hits.distance.copy(), hits.i.copy(), hits.j.copy()
    places[gouge], distance[gouge], i[gouge], j[gouge] = spots[best], -distances[best], index[deepest], wall[deepest]
    return wrong, Gouging(hits.intervals, places, distance, i, j)


def _near_surface(pairs: Pairs, radius: float) -> Flags:
    """True for pieces whose middle is no farther from the surface than the radius."""
    middle = np.minimum.reduceat(pairs.from_piece[1], pairs.begins[:-1])
    return middle <= radius + 10.0 * GOUGE


def _on_one_wall(pairs: Pairs, hits: Gouging, radius: float) -> Flags:
    """True for pieces that do not gouge and keep to one inner wall from end to end: they stay on one side of it.

    A piece could only change sides around the wall's end, where it would meet the next wall; the first and the last
    wall, which lack such a neighbor, do not count as inner walls.
    """
    inner = near_ends_and_middle(pairs, radius) & (pairs.j > 0) & (pairs.j < len(pairs.others) - 1)
    on_one_wall = np.zeros(len(pairs.pieces), np.bool_)
    on_one_wall[pairs.i[inner]] = True
    if len(hits):
        owner = np.searchsorted(hits.intervals.first, pairs.stations[1:]) - 1
        on_one_wall &= (owner < 0) | (hits.intervals.last[owner] <= pairs.stations[:-1])
    return on_one_wall


def _gouge_positions(hits: Gouging, surface: SidedSurface) -> Floats:
    """Return the places along the center path that represent the gouges; none for a closed, uncrossed contour."""
    if not len(hits) or (surface.endless and not surface.crossed):
        return np.zeros(0)
    return np.concatenate((hits.intervals.first, hits.intervals.last, hits.intervals.middle, hits.place))


def _parts(pairs: Pairs, hits: Gouging, surface: SidedSurface, radius: float) -> Intervals:
    """Return the gouging stretches, split where the center path may change sides.

    A cutter of radius 0 gouges nothing: for it, test the pieces that meet walls without running along one.
    If the surface crosses itself, the sides of its walls contradict each other, and there is nothing to test.
    """
    if surface.crossed or not (len(hits) or radius <= GOUGE):
        return NO_INTERVALS
    met, intervals = _pairs_that_meet(pairs, radius), hits.intervals
    if radius <= GOUGE:
        intervals = merged(pairs.stations[pairs.i[met]], pairs.stations[pairs.i[met] + 1])
    # a wall exactly JOINED away counts as met
    spots, _, _ = approaches(pairs, met, np.full(len(met), np.nextafter(JOINED, 1.0)))
    joints = pairs.stations[1:-1]
    if surface.endless:
        # along a closed contour the side may change only at gaps of the path
        joints = joints[np.abs(pairs.pieces.end[:-1] - pairs.pieces.start[1:]) > JOINED]
    parts = intervals.cut(np.concatenate((spots, _ends_passed(pairs, intervals, surface), joints)))
    return parts if surface.endless else parts.cut(_between_arms(pairs, parts, surface))


def _pairs_that_meet(pairs: Pairs, radius: float) -> Rows:
    """Return the pairs whose pieces meet; for radius 0, without pieces that run along a wall and meet it everywhere."""
    meets = pairs.least <= JOINED
    if radius <= GOUGE:
        near = np.zeros(len(pairs.pieces), np.bool_)
        near[pairs.i[near_ends_and_middle(pairs, radius)]] = True
        meets &= ~near[pairs.i]
    return meets.nonzero()[0]


def _ends_passed(pairs: Pairs, intervals: Intervals, surface: SidedSurface) -> Floats:
    """Return where the intervals' pieces pass the normals at an open surface's ends, or are nearest to an open seam."""
    walls, moves = pairs.others, pairs.pieces
    if surface.endless and abs(walls.end[-1] - walls.start[0]) <= ON_PATH:
        return np.zeros(0)
    begin, _ = piece_at(moves, pairs.stations, intervals.first)
    end, _ = piece_at(moves, pairs.stations, intervals.last)
    steps = np.zeros(len(moves) + 1, np.intp)
    np.add.at(steps, begin, 1)
    np.add.at(steps, end + 1, -1)
    rows = (steps.cumsum()[:-1] > 0).nonzero()[0]
    pieces, crossings = moves.take(rows), []
    for wall, t in ((0, 0.0), (len(walls) - 1, 1.0)):
        edge, share = walls.take(np.full(len(rows), wall)), np.full(len(rows), t)
        corner = at(edge, share)
        met = (
            foot(pieces, corner)[None]
            if surface.endless
            else fractions_on_line(pieces, corner, 1j * direction(edge, share))
        )
        k, row = np.nonzero((met > 0.0) & (met < 1.0))
        crossings.append(pairs.stations[rows[row]] + met[k, row] * pieces.length[row])
    return np.concatenate(crossings)


def _between_arms(pairs: Pairs, parts: Intervals, surface: SidedSurface) -> Floats:
    """Return where these parts change sides without meeting a wall: halfway between two arms of an open contour, from
    the part's side of one arm to the cutter's side of the other."""
    batches = [parts.keep(slice(first, first + PARTS_AT_A_TIME)) for first in range(0, len(parts), PARTS_AT_A_TIME)]
    return np.concatenate((np.zeros(0), *(_changes_of_side(pairs, batch, surface) for batch in batches)))


def _changes_of_side(pairs: Pairs, parts: Intervals, surface: SidedSurface) -> Floats:
    """Return where the side changes between two neighbors of `TESTED_SHARES`, to the last digit."""
    s = parts.first + TESTED_SHARES * (parts.last - parts.first)
    wrong = _is_wrong(pairs, s.ravel(), surface).reshape(s.shape)
    changed = wrong[1:] != wrong[:-1]
    low: Floats = s[:-1][changed]
    high, begins = s[1:][changed], wrong[:-1][changed]
    for _ in range(MAX_HALVINGS if len(low) else 0):
        middle = (low + high) / 2.0
        same = _is_wrong(pairs, middle, surface) == begins
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low


def _is_wrong(pairs: Pairs, s: Floats, surface: SidedSurface) -> Flags:
    """True for places `s` along the center path that are on the part's side."""
    return _on_part_side(pairs, *piece_at(pairs.pieces, pairs.stations, s), surface)


def on_part_side(walls: PieceArrays, points: Points, near: Nearest, surface: SidedSurface) -> Flags:
    """True for points that are clearly on the part's side of all walls nearest to them."""
    if not len(points):
        return np.zeros(0, np.bool_)
    wall, spots = walls.take(near.j), points[near.k]
    t, from_start = foot(wall, spots), spots - wall.start
    left = _left_of_walls(wall, from_start) * (near.distance >= ON_PATH)
    joints = ((t == 0.0) | (t == 1.0)).nonzero()[0]
    if len(joints):
        fractions = t[joints]
        from_joint = from_start[joints] - fractions * wall.vector[joints]
        before = near.j[joints] - (fractions == 0.0)
        left[joints] = _left_of_joints(walls, before, from_joint, near.distance[joints])
    wrong: Flags = np.logical_and.reduceat(left * surface.side.sign < -MIN_SIDE_SINE, near.first)
    if not surface.endless:
        foot_at = surface.stations[near.j] + t * wall.length
        outside = (foot_at <= surface.first + JOINED) | (foot_at >= surface.last - JOINED)
        wrong &= ~np.logical_or.reduceat(outside, near.first)
    return wrong


def _left_of_walls(walls: PieceArrays, from_start: Points) -> Floats:
    """Return 1 for points left of their walls, -1 for those on the right; `from_start` are vectors from walls' starts.

    The left of an arc is the inside of its circle if the arc turns left, the outside if it turns right.
    """
    across = (np.conj(walls.vector) * from_start).imag
    bent = walls.turn * (walls.radius - np.abs(from_start + walls.arm))
    return np.sign(np.where(walls.turn == 0.0, across, bent))


def _left_of_joints(walls: PieceArrays, before: Rows, from_joint: Points, distances: Floats) -> Floats:
    """Return a positive number for points on the left; each point's nearest place is the joint after wall `before`, at
    the vector `from_joint` and the distance `distance`.

    The points lie beyond the ends of both walls, so they are on the left if the joint turns right.  If the surface
    turns back there, the sines to both walls nearly cancel each other, and the turn alone decides; walls that are
    tangent there turn to the side on which the second wall runs back.
    """
    after = (before + 1) % len(walls)
    along = at_joints(walls, before, after)
    size = np.abs(along)
    arriving, leaving = along / np.where(size == 0.0, 1.0, size)
    from_joint = from_joint / np.where(distances < ON_PATH, np.inf, distances)
    left: Floats = (np.conj(arriving + leaving) * from_joint).imag
    turn = np.conj(arriving) * leaving
    reversals = (turn.real < 0.0).nonzero()[0]
    if len(reversals):
        rows, turning = np.array((before[reversals], after[reversals])), turn.imag[reversals]
        radius = walls.radius[rows]
        bend = (walls.turn[rows] / np.where(radius == 0.0, 1.0, radius)).sum(axis=0)
        sense = np.sign(np.where(np.abs(turning) < MIN_SIDE_SINE, -bend, turning))
        left[reversals] = -sense * (np.abs(from_joint[reversals]) > 0.0)
    return left
