"""Sides: which pieces of a centre path run on the part's side of the surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.geometry.distance import nearest_and_along
from core.geometry.measured import Flags, Floats, Measured, Points, Rows, at, direction, place
from core.geometry.side import Side
from core.tolerance import JOINED, ON_PATH
from core.verify.crossing import Crossings
from core.verify.gouge import Gouging
from core.verify.pairs import Pairs
from core.verify.reach import Nearest, changes, least_of, nearest

CLEARLY: Final = 1e-6
"""Sine of an angle to the surface's tangent below which a point is on neither side."""


@dataclass(frozen=True, eq=False, slots=True)
class Sided:
    """A surface that has a side: `side` is the cutter's.

    `first` and `last` are lengths travelled; before and behind them, and at them, the surface has no side unless it
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


def wrong_side(pairs: Pairs, found: Gouging, surface: Sided, reach: float, known: Rows) -> tuple[int, ...]:
    """Rows of the centre path of which some point is clearly on the part's side, in rising order.

    `known` are the pieces of which a part is found behind the surface: all that meet it.  A piece that does not is on
    one side of a closed contour.  It is judged in its middle if that is within `reach` of a closed one, or if it keeps
    to an inner wall of an open one; any other piece in its middle and at its ends.  Beside an open contour, which has
    a side only as far as something is nearest to more than its ends, the nearest wall decides: a gouge is asked at its
    ends too, in its middle and where it is deepest, and a piece that meets no wall may be on another side between
    these places.
    """
    if not len(pairs.surface) or not len(pairs.centre):
        return ()
    rows, near = _contact(pairs, reach, ON_PATH)
    stations = pairs.centre_stations
    settled, count = pairs.own.settled(len(pairs.centre)), len(rows)
    settled[rows] |= surface.endless | _kept(pairs, found)[rows]
    s, t = (stations[rows] + stations[rows + 1]) / 2.0, np.full(count, 0.5)
    index, more = _samples(pairs, (~settled).nonzero()[0], found, surface)
    if len(more):
        length = pairs.centre.length[index]
        share = (more - stations[index]) / np.where(length == 0.0, 1.0, length)
        share = np.minimum(np.maximum(share, 0.0), 1.0)
        s, t, rows = np.concatenate((s, more)), np.concatenate((t, share)), np.concatenate((rows, index))
    points = at(pairs.centre.take(rows), t)
    if len(more):
        near = near.followed(nearest(points[count:], pairs.surface, pairs.surface_boxes, tie=ON_PATH), count)
    wrong = np.zeros(len(pairs.centre), np.bool_)
    told = on_part_side(pairs, points, near, surface)
    if surface.crossed:
        told &= ~_inside(found, s)
    wrong[rows[told]], wrong[known] = True, True
    return tuple(pairs.centre.rows[wrong].tolist())


def _kept(pairs: Pairs, found: Gouging) -> Flags:
    """Pieces that gouge nothing and keep to one inner wall from end to end: they are on one side of it.

    From the one side to the other they could only go about the wall's end, where the next wall would be met; beyond
    the first and the last one there is none.
    """
    touch, stations, gouge = pairs.touch, pairs.centre_stations, found.stretches
    kept = np.zeros(len(pairs.centre), np.bool_)
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
    walls, bent = (own.piece >= 0).nonzero()[0], (own.corner >= 0).nonzero()[0]
    if not len(walls):
        return pairs.i[close], pairs.j[close], middle[close]
    piece = np.concatenate((own.piece[walls], own.corner[bent], own.corner[bent]))
    wall = np.concatenate((walls, bent, bent + 1))
    apart = np.concatenate((own.apart[walls], own.apart[bent], own.apart[bent]))
    nearest = np.full(len(pairs.centre), np.inf)
    nearest[piece] = apart
    close = close[middle[close] <= nearest[pairs.i[close]] + tie]
    asked = np.zeros(len(pairs.centre), np.bool_)
    asked[pairs.i[close]] = True
    chosen = asked[piece].nonzero()[0]
    i, j = np.concatenate((pairs.i[close], piece[chosen])), np.concatenate((pairs.j[close], wall[chosen]))
    order = np.argsort(i, kind="stable")
    return i[order], j[order], np.concatenate((middle[close], apart[chosen]))[order]


def _samples(pairs: Pairs, rows: Rows, found: Gouging, surface: Sided) -> tuple[Rows, Floats]:
    """Pieces and places along the centre path that stand for these pieces, and beside an open contour for the gouges.

    The end of a piece is its own, though the next one begins there.
    """
    first, last = pairs.centre_stations[rows], pairs.centre_stations[rows + 1]
    index, samples = np.concatenate((rows, rows, rows)), np.concatenate((first, (first + last) / 2.0, last))
    if surface.endless and not surface.crossed:
        return index, samples
    gouge = found.stretches
    more = np.concatenate((gouge.first, gouge.last, (gouge.first + gouge.last) / 2.0, found.place))
    owners, _ = place(pairs.centre, pairs.centre_stations, more)
    return np.concatenate((index, owners)), np.concatenate((samples, more))


def on_part_side(pairs: Pairs, points: Points, near: Nearest, surface: Sided) -> Flags:
    """Which of the points are clearly on the part's side of all that is nearest to them."""
    if not len(points):
        return np.zeros(0, np.bool_)
    spots = points[near.k]
    t, touched, along = nearest_and_along(pairs.surface.take(near.j), spots)
    off = (spots - touched) / np.where(near.apart < ON_PATH, np.inf, near.apart)
    sine = (np.conj(along) * off).imag
    joints = ((t == 0.0) | (t == 1.0)).nonzero()[0]
    if len(joints):
        sine[joints] = _off_joints(pairs.surface, near.j[joints] - (t[joints] == 0.0), off[joints])
    starts = changes(near.k)
    wrong: Flags = np.logical_and.reduceat(sine * surface.side.sign < -CLEARLY, starts)
    if not surface.endless:
        foot_at = pairs.surface_stations[near.j] + t * pairs.surface.length[near.j]
        outside = (foot_at <= surface.first + JOINED) | (foot_at >= surface.last - JOINED)
        wrong &= ~np.logical_or.reduceat(outside, starts)
    return wrong


def _off_joints(walls: Measured, before: Rows, off: Points) -> Floats:
    """For points to which the joint behind wall `before` is nearest, in the direction `off`, a number that is positive
    for those on the left.

    They lie beyond the ends of both walls, so that they are on the left where it turns right.  Where it turns back on
    itself the sines of both walls may all but cancel each other, and the turn alone is asked; walls that touch there
    turn to the side on which the way back runs.
    """
    one, other = walls.take(before), walls.take((before + 1) % len(walls))
    arriving, leaving = direction(one, np.ones(len(before))), direction(other, np.zeros(len(before)))
    turn = np.conj(arriving) * leaving
    bend = sum(wall.turn / np.where(wall.radius == 0.0, 1.0, wall.radius) for wall in (one, other))
    back = -np.sign(np.where(np.abs(turn.imag) < CLEARLY, -bend, turn.imag)) * (np.abs(off) > 0.0)
    sines = (np.conj(arriving + leaving) * off).imag
    left: Floats = np.where(turn.real < 0.0, back, sines)
    return left


def _inside(found: Gouging, s: Floats) -> Flags:
    """Places strictly inside a gouge."""
    stretches = found.stretches
    if not len(stretches):
        return np.zeros(len(s), np.bool_)
    owner = stretches.index(s)
    inside: Flags = (owner >= 0) & (s > stretches.first[owner]) & (s < stretches.last[owner])
    return inside
