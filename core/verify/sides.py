"""Sides: which pieces of a center path run on the part's side of the surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.geometry.distance import foot
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece import Side
from core.geometry.piece_arrays import PieceArrays, at, place
from core.tolerance import ARC_RADII, CLOSED, JOINED, ON_PATH
from core.verify.crossing import Crossings, at_joints
from core.verify.gouge import Gouging
from core.verify.pairs import Pairs
from core.verify.reach import Nearest, Stretches, changes, least_of, nearest

CLEARLY: Final = 1e-6
"""Sine of an angle to the surface's tangent below which a point is on neither side."""


NARROW: Final = 2.0 * (CLOSED + ARC_RADII)
"""Millimeters within which a path may slip through a closed contour: twice how far its ends, and the ends of uneven
arcs from the circles taken for them, may be apart."""


@dataclass(frozen=True, eq=False, slots=True)
class Sided:
    """A surface that has a side: `side` is the cutter's.

    `first` and `last` are lengths traveled; before and behind them, and at them, the surface has no side unless it
    is `endless`.  Where it is `crossed` the sides of two of its walls may contradict each other near both.
    """

    side: Side
    first: float
    last: float
    endless: bool
    crossed: bool


def sided(side: Side, crossings: Crossings, total: float, *, closed: bool) -> Sided:
    """An over-run bounds no material and has no side.

    It is the run from an open contour's end to the outermost crossing with itself, when it is shorter than what lies
    between the outermost crossings.
    """
    first, last = 0.0, total
    if len(crossings) and not closed:
        low, high = float(crossings.places.min()), float(crossings.places.max())
        first = low if low < high - low else first
        last = high if total - high < high - low else last
    return Sided(side, first, last, closed, len(crossings) > 0)


def wrong_side(pairs: Pairs, found: Gouging, surface: Sided, reach: float, parts: Stretches) -> tuple[Flags, Flags]:
    """(n,) pieces of the center path of which some point is clearly on the part's side, and which of the `parts` of it,
    that have one side each, are there.

    The parts stand for all pieces that meet the surface.  A piece that does not is on one side of a closed contour.  It
    is judged in its middle if that is within `reach` of a closed one, or if it keeps to an inner wall of an open one;
    any other piece in its middle and at its ends, or with the others of a path that is on one side.  Beside an open
    contour, which has a side only as far as something is nearest to more than its ends, the nearest wall decides: a
    gouge is asked at its ends too, in its middle and where it is deepest, and a piece that meets no wall may be on
    another side between these places.
    """
    wrong = np.zeros(len(pairs.center), np.bool_)
    if not len(pairs.surface) or not len(pairs.center):
        return wrong, np.zeros(len(parts), np.bool_)
    rows, near = _contact(pairs, reach, ON_PATH)
    count, settled = len(rows), pairs.own.settled(len(pairs.center))
    settled[rows] = True if surface.endless else _kept(pairs, found)[rows] | settled[rows]
    asked, gouged = (~settled).nonzero()[0], _gouged(found, surface)
    alike = count > 0 and len(asked) > 0 and _on_one_side(pairs, surface, reach)
    index, t = _samples(rows, asked[:0] if alike else asked)
    places = np.concatenate((gouged, (parts.first + parts.last) / 2.0))
    if len(places):
        owners, shares = place(pairs.center, pairs.center_stations, places)
        index, t = np.concatenate((index, owners)), np.concatenate((t, shares))
    points = at(pairs.center.take(index), t)
    if len(index) > count:
        near = near.followed(nearest(points[count:], pairs.surface, pairs.surface_boxes, tie=ON_PATH), count)
    told = on_part_side(pairs, points, near, surface)
    if surface.crossed:
        s = pairs.center_stations[index] + t * pairs.center.length[index]
        s[len(s) - len(places) :] = places
        told &= ~_inside(found, s)
    moves, behind = told[: len(told) - len(parts)], told[len(told) - len(parts) :]
    wrong[index[: len(moves)][moves]] = True
    wrong[asked] |= alike and moves.any()
    return wrong, behind


def _on_one_side(pairs: Pairs, surface: Sided, reach: float) -> bool:
    """The whole path is on one side of the surface: that is closed and does not cross itself, the path is one, and it
    comes nowhere near enough to slip through where the surface's ends are apart, or its arcs miss their ends.

    Whatever is not among the pairs is farther away than `reach`.
    """
    if surface.crossed or not surface.endless or reach <= NARROW:
        return False
    if min(pairs.touch.apart.min(initial=np.inf), pairs.own.apart.min(initial=np.inf)) <= NARROW:
        return False
    start, vector = pairs.center.start, pairs.center.vector
    return bool(np.abs(start[:-1] + vector[:-1] - start[1:]).max(initial=0.0) <= JOINED)


def _kept(pairs: Pairs, found: Gouging) -> Flags:
    """Pieces that gouge nothing and keep to one inner wall from end to end: they are on one side of it.

    From the one side to the other they could only go about the wall's end, where the next wall would be met; beyond
    the first and the last one there is none.
    """
    touch, stations, gouge = pairs.touch, pairs.center_stations, found.stretches
    kept = np.zeros(len(pairs.center), np.bool_)
    kept[pairs.i[touch.along & (pairs.j > 0) & (pairs.j < len(pairs.surface) - 1)]] = True
    if len(gouge):
        owner = np.searchsorted(gouge.first, stations[1:]) - 1
        kept &= (owner < 0) | (gouge.last[owner] <= stations[:-1])
    return kept


def _contact(pairs: Pairs, reach: float, tie: float) -> tuple[Rows, Nearest]:
    """Pieces whose middle is within reach, rising, and for each the surface pieces nearest to it there.

    Own pieces and corners are on the cutter's side of their walls, and only there if other walls are as near.
    """
    i, j, middle = _as_near_as_own(pairs, reach, tie)
    if not len(i):
        return i, Nearest(i, i, middle)
    begins = np.ones(len(i), np.bool_)
    np.not_equal(i[1:], i[:-1], out=begins[1:])
    starts = begins.nonzero()[0]
    return i[starts], least_of(begins.cumsum() - 1, j, middle, starts, tie)


def _as_near_as_own(pairs: Pairs, reach: float, tie: float) -> tuple[Rows, Rows, Floats]:
    """Pieces, rising, walls and distances of the pieces' middles from them, within reach.

    A piece that has walls of its own is there, with these too, if another wall is as near.
    """
    own, middle = pairs.own, pairs.touch.middle
    close = (middle <= reach).nonzero()[0]
    if not len(own.piece):
        return pairs.i[close], pairs.j[close], middle[close]
    walls, bent = (own.piece >= 0).nonzero()[0], (own.corner >= 0).nonzero()[0]
    piece = np.concatenate((own.piece[walls], own.corner[bent], own.corner[bent]))
    wall = np.concatenate((walls, bent, bent + 1))
    apart = np.concatenate((own.apart[walls], own.apart[bent], own.apart[bent]))
    nearest = np.full(len(pairs.center), np.inf)
    nearest[piece] = apart
    close = close[middle[close] <= nearest[pairs.i[close]] + tie]
    asked = np.zeros(len(pairs.center), np.bool_)
    asked[pairs.i[close]] = True
    chosen = asked[piece].nonzero()[0]
    i, j = np.concatenate((pairs.i[close], piece[chosen])), np.concatenate((pairs.j[close], wall[chosen]))
    order = np.argsort(i, kind="stable")
    return i[order], j[order], np.concatenate((middle[close], apart[chosen]))[order]


def _gouged(found: Gouging, surface: Sided) -> Floats:
    """Places along the center path that stand for the gouges: of a closed contour that does not cross itself none."""
    if not len(found.i) or (surface.endless and not surface.crossed):
        return found.place[:0]
    first, last = found.stretches.first, found.stretches.last
    return np.concatenate((first, last, (first + last) / 2.0, found.place))


def _samples(middles: Rows, rows: Rows) -> tuple[Rows, Floats]:
    """Pieces and fractions of them: the middles of some, the ends and middles of others.

    The end of a piece is its own, though the next one begins there.
    """
    count = len(rows)
    index = np.concatenate((middles, rows, rows, rows))
    t = np.full(len(index), 0.5)
    t[len(middles) : len(middles) + count], t[len(middles) + 2 * count :] = 0.0, 1.0
    return index, t


def on_part_side(pairs: Pairs, points: Points, near: Nearest, surface: Sided) -> Flags:
    """Which of the points are clearly on the part's side of all that is nearest to them."""
    if not len(points):
        return np.zeros(0, np.bool_)
    walls, spots = pairs.surface.take(near.j), points[near.k]
    t, off = foot(walls, spots), spots - walls.start
    left = _left(walls, off) * (near.apart >= ON_PATH)
    joints = ((t == 0.0) | (t == 1.0)).nonzero()[0]
    if len(joints):
        share = t[joints]
        away = off[joints] - share * walls.vector[joints]
        before = near.j[joints] - (share == 0.0)
        left[joints] = _off_joints(pairs.surface, before, away, near.apart[joints])
    starts = changes(near.k)
    wrong: Flags = np.logical_and.reduceat(left * surface.side.sign < -CLEARLY, starts)
    if np.count_nonzero(wrong) and not surface.endless:
        foot_at = pairs.surface_stations[near.j] + t * walls.length
        outside = (foot_at <= surface.first + JOINED) | (foot_at >= surface.last - JOINED)
        wrong &= ~np.logical_or.reduceat(outside, starts)
    return wrong


def _left(walls: PieceArrays, off: Points) -> Floats:
    """1 for points that are on the left of their walls, in the direction `off` from the walls' starts, -1 on the right.

    Those on the left of an arc are within its circle where it turns left, and without where it turns right.
    """
    across = (np.conj(walls.vector) * off).imag
    if np.count_nonzero(walls.turn):
        across = np.where(walls.turn == 0.0, across, walls.turn * (walls.radius - np.abs(off + walls.arm)))
    return np.sign(across)


def _off_joints(walls: PieceArrays, before: Rows, off: Points, apart: Floats) -> Floats:
    """For points to which the joint behind wall `before` is nearest, `off` from it and so `apart`, a number that is
    positive for those on the left.

    They lie beyond the ends of both walls, so that they are on the left where it turns right.  Where it turns back on
    itself the sines of both walls may all but cancel each other, and the turn alone is asked; walls that touch there
    turn to the side on which the way back runs.
    """
    behind = (before + 1) % len(walls)
    along = at_joints(walls, before, behind)
    size = np.abs(along)
    arriving, leaving = along / np.where(size == 0.0, 1.0, size)
    off = off / np.where(apart < ON_PATH, np.inf, apart)
    left: Floats = (np.conj(arriving + leaving) * off).imag
    turn = np.conj(arriving) * leaving
    back = (turn.real < 0.0).nonzero()[0]
    if len(back):
        rows, turning = np.array((before[back], behind[back])), turn.imag[back]
        radius = walls.radius[rows]
        bend = (walls.turn[rows] / np.where(radius == 0.0, 1.0, radius)).sum(axis=0)
        way = np.sign(np.where(np.abs(turning) < CLEARLY, -bend, turning))
        left[back] = -way * (np.abs(off[back]) > 0.0)
    return left


def _inside(found: Gouging, s: Floats) -> Flags:
    """Places strictly inside a gouge."""
    stretches = found.stretches
    if not len(stretches):
        return np.zeros(len(s), np.bool_)
    owner = stretches.index(s)
    inside: Flags = (owner >= 0) & (s > stretches.first[owner]) & (s < stretches.last[owner])
    return inside
