"""Crossing: where a surface crosses or touches itself, other than its neighbors at their joint."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from core.geometry.aligned import aligned_pairs
from core.geometry.boxes import near_pairs
from core.geometry.distance import between, distance, foot, nearest_places
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, direction
from core.tolerance import JOINED
from core.verify.course import Course
from core.verify.unproved import clear

TURN: Final = 1e-6
"""Radians short of half a turn that are taken for one."""


@dataclass(frozen=True, eq=False, slots=True)
class Crossings:
    """m places (m, 2) in length traveled at which a surface meets itself, in order, and the points (m,)."""

    places: Floats
    points: Points

    def __len__(self) -> int:
        return len(self.points)


NOWHERE: Final = Crossings(np.zeros((0, 2)), np.zeros(0, np.complex128))
"""A surface that does not meet itself."""


def crossings(course: Course, *, closed: bool, free: Course | None = None) -> Crossings:
    """Where pieces that are not neighbors come within JOINED of each other, and neighbors away from their joint.

    `free` is a course, closed as this one is, that does not meet itself: where nothing meets what is not in it, neither
    does this one.
    """
    surface, stations = course.pieces, course.stations
    rows = None if free is None else _altered(surface, free.pieces)
    i, j = _unclear(course, closed=closed, rows=rows)
    if len(i) and rows is not None:
        i, j = _unclear(course, closed=closed)
    if not len(i):
        return NOWHERE
    following = j == i + 1
    around = (i == 0) & (j == len(surface) - 1) if closed else np.zeros(len(i), np.bool_)
    one, other = surface.take(i), surface.take(j)
    places = np.vstack((nearest_places(one, other), np.full(len(one), 0.5)))
    points = at(one, places)
    apart = distance(other, points)
    met = (apart <= JOINED) & _away(one, other, places, points, following, around)
    k, pair = np.nonzero(met)
    on_other = foot(other.take(pair), points[k, pair])
    first = stations[i[pair]] + places[k, pair] * one.length[pair]
    second = stations[j[pair]] + on_other * other.length[pair]
    order = np.argsort(first, kind="stable")
    return Crossings(np.stack((first, second), axis=1)[order], points[k, pair][order])


def _altered(pieces: PieceArrays, before: PieceArrays) -> Rows | None:
    """The pieces that are not what those of the same index were before; None where these are many."""
    if len(pieces) != len(before):
        return None
    other = pieces.start != before.start
    other |= pieces.vector != before.vector
    other |= pieces.arm != before.arm
    other |= pieces.turn != before.turn
    rows: Rows = other.nonzero()[0]
    return rows if 4 * len(rows) < len(pieces) else None


def _unclear(course: Course, *, closed: bool, rows: Rows | None = None) -> tuple[Rows, Rows]:
    """Candidates of which the sides of lines do not tell that they are apart, which takes a tenth of the steps."""
    surface = course.pieces
    i, j = _candidates(surface, course.boxes, closed=closed, rows=rows)
    unclear = (~clear(surface, i, surface, j, 2.0 * JOINED)).nonzero()[0]
    return i[unclear], j[unclear]


def _candidates(surface: PieceArrays, bounds: Floats, *, closed: bool, rows: Rows | None) -> tuple[Rows, Rows]:
    """Pairs i < j that may meet elsewhere than at a joint: any near ones, and neighbors that come back.

    Only those of which one is among `rows`, where these are given; both are told twice then.
    """
    i, j = aligned_pairs(bounds, bounds, JOINED, 2, both=False) if rows is None else _near(bounds, rows)
    again = (_overlapping(bounds) & _may_come_back(surface)).nonzero()[0]
    if rows is not None:
        asked = np.zeros(len(surface), np.bool_)
        asked[rows] = True
        again = again[asked[again] | asked[again + 1]]
    if len(again):
        again = again[_turned(surface, again, again + 1) > pi - TURN]
        i, j = np.concatenate((i, again)), np.concatenate((j, again + 1))
    if closed and len(surface) > 2:
        seam = (i == 0) & (j == len(surface) - 1)
        if seam.any() and not _turns_half_round(surface):
            i, j = i[~seam], j[~seam]
    return i, j


def _near(bounds: Floats, rows: Rows) -> tuple[Rows, Rows]:
    """Pairs i < j of near boxes that are no neighbors, one of which is among `rows`."""
    one, other = near_pairs(bounds.take(rows, axis=1), bounds, JOINED)
    one = rows.take(one)
    far = (np.abs(one - other) >= 2).nonzero()[0]
    return np.minimum(one[far], other[far]), np.maximum(one[far], other[far])


def _may_come_back(surface: PieceArrays) -> Flags:
    """(n - 1,) pieces and the next ones that are not both straight, or that go back by all but half a turn."""
    vector, length, bent = surface.vector, surface.length, surface.arcs
    back: Flags = (np.conj(vector[:-1]) * vector[1:]).real < -0.99 * length[:-1] * length[1:]
    back |= bent[:-1] | bent[1:]
    return back


def _turned(surface: PieceArrays, rows: Rows, following: Rows) -> Floats:
    """How much these pieces, the following ones and the joints between them turn, radians."""
    end, begin = at_joints(surface, rows, following)
    corner = begin * np.conj(end)
    turned: Floats = np.abs(np.arctan2(corner.imag, corner.real))
    turned += surface.angle[rows] + surface.angle[following]
    return turned


def at_joints(surface: PieceArrays, rows: Rows, following: Rows) -> Points:
    """(2, m) the directions in which these pieces end and the following ones begin, of any length."""
    both = np.array((rows, following))
    vector, turn = surface.vector[both], surface.turn[both]
    if not np.count_nonzero(turn):
        return vector
    arm = surface.arm[both]
    arm[0] += vector[0]
    return np.where(turn == 0.0, vector, 1j * turn * arm)


def _overlapping(bounds: Floats) -> Flags:
    """(n - 1,) boxes that share more with the next one than the surroundings of a joint, where neighbors are one."""
    shared = np.minimum(bounds[2:, 1:], bounds[2:, :-1]) - np.maximum(bounds[:2, 1:], bounds[:2, :-1])
    wide = shared > 5.0 * JOINED
    either: Flags = wide[0] | wide[1]
    return either


def _turns_half_round(surface: PieceArrays) -> bool:
    """The last and the first piece can meet elsewhere than at START: a curve must turn half round to come back."""
    return _turned(surface, np.array([-1]), np.array([0])).item() > pi - TURN


def _away(
    one: PieceArrays, other: PieceArrays, places: Floats, points: Points, following: Flags, around: Flags
) -> Flags:
    """(9, m) places that are no part of a joint.

    Pieces that leave a joint smoothly stay within any tolerance of each other for a while; they meet again
    only if they are apart in between, or if the later one runs back over the earlier one.
    """
    away = np.ones(points.shape, np.bool_)
    for joint, mine, theirs in ((following, 1.0, 0.0), (around, 0.0, 1.0)):
        corner = at(one, np.full(len(one), mine))
        parted = between(one, other, (places + mine) / 2.0) > 2.0 * JOINED
        turn = direction(one, np.full(len(one), mine)) * np.conj(direction(other, np.full(len(one), theirs)))
        elsewhere = (np.abs(points - corner) > 10.0 * JOINED) & (parted | (turn.real < -1.0 + 1e-9))
        away &= ~joint | elsewhere
    return away
