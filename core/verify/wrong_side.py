"""Wrong side: which pieces of a center path run on the part's side of the surface, and how far inside they get there.

A path changes sides where it meets the surface, and beside an open contour where it passes the normal at a free end,
beyond which there is no side.  Parted there it has one side in each part: that of the part's middle.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Final

import numpy as np

from core.geometry.distance import foot, on_line
from core.geometry.nearby import changes
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece import Side
from core.geometry.piece_arrays import BLOCK_PAIRS, PieceArrays, at, direction, place
from core.tolerance import GOUGE, JOINED, ON_PATH
from core.verify.farthest import FINE, farthest
from core.verify.gouge import Gouging, approaches
from core.verify.pairs import Nearest, Pairs, keeping, nearest
from core.verify.self_crossings import SelfCrossings, at_joints
from core.verify.stretches import NO_STRETCHES, Stretches, union

CLEARLY: Final = 1e-6
"""Sine of an angle to the surface's tangent below which a point is on neither side."""

SHARES: Final = np.linspace(0.0, 1.0, 65)[1:-1, None]
"""(63, 1) shares of a part at which its side is asked for where walls may contradict each other."""

HALVINGS: Final = 40
"""Times that the place where the side changes is drawn nearer: to the last digit of any part's length."""


@dataclass(frozen=True, eq=False, slots=True)
class Sided:
    """A surface that has a side: `side` is the cutter's.

    `stations` are lengths traveled at its pieces' starts and at the end.  Before `first` and behind `last`, and at
    them, the surface has no side unless it is `endless`.  Where it is `crossed` the sides of two of its walls may
    contradict each other near both.
    """

    side: Side
    stations: Floats
    first: float
    last: float
    endless: bool
    crossed: bool


def sided(side: Side, walls: PieceArrays, crossings: SelfCrossings, *, closed: bool) -> Sided:
    """An over-run bounds no material and has no side.

    It is the run from an open contour's end to the outermost crossing with itself, when it is shorter than what lies
    between the outermost crossings.
    """
    stations = walls.stations
    first, last = 0.0, float(stations[-1])
    if len(crossings) and not closed:
        low, high = float(crossings.places.min()), float(crossings.places.max())
        first, last = low if low < high - low else first, high if last - high < high - low else last
    return Sided(side, stations, first, last, closed, len(crossings) > 0)


def wrong_side(pairs: Pairs, hits: Gouging, surface: Sided, radius: float) -> tuple[Flags, Gouging]:
    """(n,) True where a piece of the center path runs on the part's side; and the gouges, with their depth there.

    A gouge that gets to that side is told by the place farthest inside.  Every piece is tested at its middle, one that
    is away from the surface at its ends too, and each of its parts between the places where it may change sides.
    Beside an open contour, which has a side only as far as something is nearest to more than its ends, the nearest wall
    decides: every piece that does not keep to one wall is tested at its ends, a gouge at its ends, in its middle and
    where it is deepest, and a piece that meets no wall may be on another side between these places.
    """
    if not len(pairs.pieces):
        return np.zeros(0, np.bool_), hits
    parts = _parts(pairs, hits, surface, radius)
    index, t = np.arange(len(pairs.pieces)), np.full(len(pairs.pieces), 0.5)
    asked = (~(_near(pairs, radius) if surface.endless else _kept(pairs, hits, radius))).nonzero()[0]
    index, t = np.concatenate((index, asked, asked)), np.concatenate((t, np.zeros(len(asked)), np.ones(len(asked))))
    spots = np.concatenate((_gouged(hits, surface), parts.middle))
    owners, shares = place(pairs.pieces, pairs.stations, spots)
    count, index, t = len(index), np.concatenate((index, owners)), np.concatenate((t, shares))
    on_part = _on_part_side(pairs, index, t, surface)
    if surface.crossed:
        s = np.concatenate((pairs.stations[index[:count]] + t[:count] * pairs.pieces.length[index[:count]], spots))
        on_part &= ~hits.stretches.holds(s)
    wrong = np.zeros(len(pairs.pieces), np.bool_)
    moves, inside = on_part[: len(on_part) - len(parts)], on_part[len(on_part) - len(parts) :]
    wrong[index[: len(moves)][moves]] = True
    return _with_depth(pairs, parts.keep(inside), hits, wrong, radius)


def _on_part_side(pairs: Pairs, index: Rows, t: Floats, surface: Sided) -> Flags:
    """Which places at the fractions `t` of pieces `index` are on the part's side."""
    on_part = np.zeros(len(index), np.bool_)
    for first in range(0, len(index), BLOCK_PAIRS):
        block = slice(first, first + BLOCK_PAIRS)
        points = at(pairs.pieces.take(index[block]), t[block])
        on_part[block] = on_part_side(pairs.others, points, nearest(pairs, index[block], points), surface)
    return on_part


def _with_depth(pairs: Pairs, inside: Stretches, hits: Gouging, wrong: Flags, radius: float) -> tuple[Flags, Gouging]:
    """With what of these parts, which are on the part's side, is more than GOUGE there.

    A gouge's distance counts as negative there.  It ends where the path is the radius away again, short of which it is
    by GOUGE and what uneven arcs leave open: at the end that is farthest inside all of the cutter is behind the
    surface.
    """
    inside = inside.cut(pairs.stations[1:-1])
    # what gouges is nowhere farther from the surface
    most = radius - GOUGE if radius > GOUGE else inf
    far = farthest(pairs, inside, most)
    deep = (far.apart > GOUGE).nonzero()[0]
    middle, spots, apart, wall = inside.middle[deep], far.place[deep], far.apart[deep], far.near[deep]
    index = pairs.stations[1:-1].searchsorted(middle, side="right")
    wrong[index] = True
    in_gouge = hits.stretches.holds(middle).nonzero()[0]
    if not len(in_gouge):
        return wrong, hits
    slack = float(pairs.pieces.slack.max() + pairs.others.slack.max())
    owner, spots, apart = hits.stretches.index(middle[in_gouge]), spots[in_gouge], apart[in_gouge]
    apart = np.where(apart >= radius - GOUGE - slack - 2.0 * FINE, radius, apart)
    order = np.lexsort((spots, -np.round(apart / ON_PATH), owner))
    best = order[changes(owner[order])]
    gouge, deepest = owner[best], in_gouge[best]
    where, distance, i, j = hits.place.copy(), hits.apart.copy(), hits.i.copy(), hits.j.copy()
    where[gouge], distance[gouge], i[gouge], j[gouge] = spots[best], -apart[best], index[deepest], wall[deepest]
    return wrong, Gouging(hits.stretches, where, distance, i, j)


def _near(pairs: Pairs, radius: float) -> Flags:
    """Pieces whose middles are no farther from the surface than the radius."""
    middle = np.minimum.reduceat(pairs.from_piece[1], pairs.begins[:-1])
    near: Flags = middle <= radius + 10.0 * GOUGE
    return near


def _kept(pairs: Pairs, hits: Gouging, radius: float) -> Flags:
    """Pieces that gouge nothing and keep to one inner wall from end to end: they are on one side of it.

    From the one side to the other they could only go about the wall's end, where the next wall would be met; beyond
    the first and the last one there is none.
    """
    inner = keeping(pairs, radius) & (pairs.j > 0) & (pairs.j < len(pairs.others) - 1)
    kept = np.zeros(len(pairs.pieces), np.bool_)
    kept[pairs.i[inner]] = True
    if len(hits):
        owner = np.searchsorted(hits.stretches.first, pairs.stations[1:]) - 1
        kept &= (owner < 0) | (hits.stretches.last[owner] <= pairs.stations[:-1])
    return kept


def _gouged(hits: Gouging, surface: Sided) -> Floats:
    """Places along the center path that stand for the gouges: of a closed contour that does not cross itself none."""
    if not len(hits) or (surface.endless and not surface.crossed):
        return np.zeros(0)
    return np.concatenate((hits.stretches.first, hits.stretches.last, hits.stretches.middle, hits.place))


def _parts(pairs: Pairs, hits: Gouging, surface: Sided, radius: float) -> Stretches:
    """Gouging stretches parted where the center path may change sides.

    A cutter of no radius gouges nothing: of its path the pieces that meet walls without running along one are asked.
    Where a surface crosses itself the sides of its walls contradict each other, and nothing is asked.
    """
    if surface.crossed or not (len(hits) or radius <= GOUGE):
        return NO_STRETCHES
    met, stretches = _meeting(pairs, radius), hits.stretches
    if radius <= GOUGE:
        stretches = union(pairs.stations[pairs.i[met]], pairs.stations[pairs.i[met] + 1])
    # what is exactly JOINED away is met too
    spots, _, _ = approaches(pairs, met, np.full(len(met), np.nextafter(JOINED, 1.0)))
    cuts = spots, _ends_passed(pairs, stretches, surface), _joints(pairs, surface)
    parts = stretches.cut(np.concatenate(cuts))
    return parts if surface.endless else parts.cut(_between_arms(pairs, parts, surface))


def _meeting(pairs: Pairs, radius: float) -> Rows:
    """Pairs whose pieces meet; along a wall the center of a cutter of no radius does so everywhere."""
    meets = pairs.least <= JOINED
    if radius <= GOUGE:
        held = np.zeros(len(pairs.pieces), np.bool_)
        held[pairs.i[keeping(pairs, radius)]] = True
        meets &= ~held[pairs.i]
    return meets.nonzero()[0]


def _joints(pairs: Pairs, surface: Sided) -> Floats:
    """Places between pieces at which the side may be another one: beside a closed contour those where a path ends."""
    joints, moves = pairs.stations[1:-1], pairs.pieces
    return joints[np.abs(moves.end[:-1] - moves.start[1:]) > JOINED] if surface.endless else joints


def _ends_passed(pairs: Pairs, stretches: Stretches, surface: Sided) -> Floats:
    """Places of these stretches' pieces on the normals at the surface's two ends, or at a closed one's open seam."""
    walls, moves = pairs.others, pairs.pieces
    if surface.endless and abs(walls.end[-1] - walls.start[0]) <= ON_PATH:
        return np.zeros(0)
    begin, _ = place(moves, pairs.stations, stretches.first)
    end, _ = place(moves, pairs.stations, stretches.last)
    steps = np.zeros(len(moves) + 1, np.intp)
    np.add.at(steps, begin, 1)
    np.add.at(steps, end + 1, -1)
    rows = (steps.cumsum()[:-1] > 0).nonzero()[0]
    pieces, crossings = moves.take(rows), []
    for wall, t in ((0, 0.0), (len(walls) - 1, 1.0)):
        edge, share = walls.take(np.full(len(rows), wall)), np.full(len(rows), t)
        corner = at(edge, share)
        met = foot(pieces, corner)[None] if surface.endless else on_line(pieces, corner, 1j * direction(edge, share))
        k, row = np.nonzero((met > 0.0) & (met < 1.0))
        crossings.append(pairs.stations[rows[row]] + met[k, row] * pieces.length[row])
    return np.concatenate(crossings)


def _between_arms(pairs: Pairs, parts: Stretches, surface: Sided) -> Floats:
    """Places where these parts change sides halfway between arms of an open contour, with its part's side of the one
    and the cutter's of the other: nothing is met there."""
    parts = parts.keep(_about_ends(pairs, parts))
    if not len(parts):
        return np.zeros(0)
    s = parts.first + SHARES * (parts.last - parts.first)
    wrong = _wrong(pairs, s.ravel(), surface).reshape(s.shape)
    changed = wrong[1:] != wrong[:-1]
    low: Floats = s[:-1][changed]
    high, begins = s[1:][changed], wrong[:-1][changed]
    for _ in range(HALVINGS if len(low) else 0):
        middle = (low + high) / 2.0
        same = _wrong(pairs, middle, surface) == begins
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low


def _wrong(pairs: Pairs, s: Floats, surface: Sided) -> Flags:
    """Which places along the center path are on the part's side."""
    return _on_part_side(pairs, *place(pairs.pieces, pairs.stations, s), surface)


def _about_ends(pairs: Pairs, parts: Stretches) -> Flags:
    """Parts between whose nearest walls there may be an end of the surface: no other changes sides meeting nothing.

    Let it leave a place nearest to `a` on the left and come to one nearest to `b` on the right.  The way from `a` along
    the surface to `b` and back over the path is a loop that the surface's other two branches leave to different sides,
    and cross nowhere: one of its ends is inside.  The loop runs within the boxes of the walls from the first to the
    last that are nearest to any place of the part's piece, and of what is within their distance of it.  Where an uneven
    arc misses an end of its own a path may slip through all the same, and no part is left out.
    """
    walls, moves = pairs.others, pairs.pieces
    if walls.slack.any():
        return np.ones(len(parts), np.bool_)
    index = pairs.stations[1:-1].searchsorted(parts.middle, side="right")
    begins = pairs.begins
    first = np.minimum.reduceat(pairs.j, begins[:-1])[index]
    last = np.maximum.reduceat(pairs.j, begins[:-1])[index]
    room = np.maximum.reduceat(pairs.from_piece.max(axis=0), begins[:-1])[index] + moves.length[index] + JOINED
    middle = at(moves.take(index), np.full(len(index), 0.5))
    reach, runs = walls.length, np.array((first, last + 1)).T.ravel()
    held = np.zeros(len(parts), np.bool_)
    for end in (walls.start[0], walls.end[-1]):
        outside = np.zeros(len(parts), np.bool_)
        for axis in (1.0, -1.0, 1j, -1j):
            farthest_out = ((walls.start + walls.vector / 2.0) * axis).real + reach
            # a run may end behind the last wall
            along_walls = np.maximum.reduceat(np.append(farthest_out, -inf), runs)[::2]
            outside |= (end * axis).real > np.maximum(along_walls, (middle * axis).real + room)
        held |= ~outside
    return held


def on_part_side(walls: PieceArrays, points: Points, near: Nearest, surface: Sided) -> Flags:
    """Which of the points are clearly on the part's side of all that is nearest to them."""
    if not len(points):
        return np.zeros(0, np.bool_)
    wall, spots = walls.take(near.j), points[near.k]
    t, off = foot(wall, spots), spots - wall.start
    left = _left(wall, off) * (near.apart >= ON_PATH)
    joints = ((t == 0.0) | (t == 1.0)).nonzero()[0]
    if len(joints):
        share = t[joints]
        away = off[joints] - share * wall.vector[joints]
        before = near.j[joints] - (share == 0.0)
        left[joints] = _off_joints(walls, before, away, near.apart[joints])
    wrong: Flags = np.logical_and.reduceat(left * surface.side.sign < -CLEARLY, near.first)
    if not surface.endless:
        foot_at = surface.stations[near.j] + t * wall.length
        outside = (foot_at <= surface.first + JOINED) | (foot_at >= surface.last - JOINED)
        wrong &= ~np.logical_or.reduceat(outside, near.first)
    return wrong


def _left(walls: PieceArrays, off: Points) -> Floats:
    """1 for points that are on the left of their walls, in the direction `off` from the walls' starts, -1 on the right.

    Those on the left of an arc are within its circle where it turns left, and without where it turns right.
    """
    across = (np.conj(walls.vector) * off).imag
    bent = walls.turn * (walls.radius - np.abs(off + walls.arm))
    return np.sign(np.where(walls.turn == 0.0, across, bent))


def _off_joints(walls: PieceArrays, before: Rows, off: Points, apart: Floats) -> Floats:
    """For points to which the joint behind wall `before` is nearest, `off` from it and so `apart`, a number that is
    positive for those on the left.

    They lie beyond the ends of both walls, so that they are on the left where it turns right.  Where it turns back on
    itself the sines of both walls may all but cancel each other, and the turn alone is asked; walls that touch there
    turn to the side on which the way back runs.
    """
    after = (before + 1) % len(walls)
    along = at_joints(walls, before, after)
    size = np.abs(along)
    arriving, leaving = along / np.where(size == 0.0, 1.0, size)
    off = off / np.where(apart < ON_PATH, np.inf, apart)
    left: Floats = (np.conj(arriving + leaving) * off).imag
    turn = np.conj(arriving) * leaving
    back = (turn.real < 0.0).nonzero()[0]
    if len(back):
        rows, turning = np.array((before[back], after[back])), turn.imag[back]
        radius = walls.radius[rows]
        bend = (walls.turn[rows] / np.where(radius == 0.0, 1.0, radius)).sum(axis=0)
        way = np.sign(np.where(np.abs(turning) < CLEARLY, -bend, turning))
        left[back] = -way * (np.abs(off[back]) > 0.0)
    return left
