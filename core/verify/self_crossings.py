"""Self-crossings: where a surface crosses or touches itself elsewhere than at its joints, and its over-runs."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from core.geometry.distance import between, distance, foot, nearest_places
from core.geometry.nearby import near_pairs_within, sorted_pairs
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, direction
from core.tolerance import JOINED

TURN: Final = 1e-6
"""Radians short of half a turn that are taken for one."""


@dataclass(frozen=True, eq=False, slots=True)
class SelfCrossings:
    """m places (m, 2) in length traveled at which a surface meets itself, in order, and the points (m,)."""

    places: Floats
    points: Points

    def __len__(self) -> int:
        return len(self.points)


NO_CROSSINGS: Final = SelfCrossings(np.zeros((0, 2)), np.zeros(0, np.complex128))
"""A surface that does not meet itself."""


def self_crossings(surface: PieceArrays, *, closed: bool) -> SelfCrossings:
    """Where pieces that are not neighbors come within JOINED of each other, and neighbors away from their joint."""
    i, j = _candidates(surface, closed=closed)
    if not len(i):
        return NO_CROSSINGS
    following = j == i + 1
    around = (i == 0) & (j == len(surface) - 1) if closed else np.zeros(len(i), np.bool_)
    piece, other = surface.take(i), surface.take(j)
    fractions = np.vstack((nearest_places(piece, other), np.full(len(piece), 0.5)))
    points = at(piece, fractions)
    met = (distance(other, points) <= JOINED) & _away(piece, other, fractions, points, following, around)
    k, pair = np.nonzero(met)
    on_other = foot(other.take(pair), points[k, pair])
    stations = surface.stations
    first = stations[i[pair]] + fractions[k, pair] * piece.length[pair]
    second = stations[j[pair]] + on_other * other.length[pair]
    order = np.argsort(first, kind="stable")
    return SelfCrossings(np.stack((first, second), axis=1)[order], points[k, pair][order])


def _candidates(surface: PieceArrays, *, closed: bool) -> tuple[Rows, Rows]:
    """Pairs i < j that may meet elsewhere than at a joint: any near ones, and neighbors that come back."""
    bounds = surface.boxes
    i, j = sorted_pairs(near_pairs_within(bounds, JOINED))
    again = (_overlapping(bounds) & _may_come_back(surface)).nonzero()[0]
    again = again[_turned(surface, again, again + 1) > pi - TURN]
    apart = (j - i >= 2).nonzero()[0]
    i, j = np.concatenate((i[apart], again)), np.concatenate((j[apart], again + 1))
    if closed and len(surface) > 2:
        seam = (i == 0) & (j == len(surface) - 1)
        if seam.any() and not _turned(surface, np.array([-1]), np.array([0])).item() > pi - TURN:
            # a curve must turn half round to come back
            i, j = i[~seam], j[~seam]
    return i, j


def _may_come_back(surface: PieceArrays) -> Flags:
    """(n - 1,) pieces and the next ones that are not both straight, or that go back by all but half a turn."""
    vector, length, bent = surface.vector, surface.length, surface.arcs
    back: Flags = (np.conj(vector[:-1]) * vector[1:]).real < -0.99 * length[:-1] * length[1:]
    back |= bent[:-1] | bent[1:]
    return back


def _turned(surface: PieceArrays, rows: Rows, following: Rows) -> Floats:
    """How much these pieces, the following ones and the joints between them turn, radians."""
    end, begin = at_joints(surface, rows, following)
    turned: Floats = np.abs(np.angle(begin * np.conj(end)))
    return turned + surface.angle[rows] + surface.angle[following]


def at_joints(surface: PieceArrays, rows: Rows, following: Rows) -> Points:
    """(2, m) the directions in which these pieces end and the following ones begin, of any length."""
    both = np.array((rows, following))
    vector, turn, arm = surface.vector[both], surface.turn[both], surface.arm[both]
    arm[0] += vector[0]
    return np.where(turn == 0.0, vector, 1j * turn * arm)


def _overlapping(bounds: Floats) -> Flags:
    """(n - 1,) boxes that share more with the next one than the surroundings of a joint, where neighbors are one."""
    shared = np.minimum(bounds[2:, 1:], bounds[2:, :-1]) - np.maximum(bounds[:2, 1:], bounds[:2, :-1])
    wide = shared > 5.0 * JOINED
    either: Flags = wide[0] | wide[1]
    return either


def _away(
    piece: PieceArrays, other: PieceArrays, fractions: Floats, points: Points, following: Flags, around: Flags
) -> Flags:
    """(9, m) places that are no part of a joint.

    Pieces that leave a joint smoothly stay within any tolerance of each other for a while; they meet again
    only if they are apart in between, or if the later one runs back over the earlier one.
    """
    away = np.ones(points.shape, np.bool_)
    for joint, mine, theirs in ((following, 1.0, 0.0), (around, 0.0, 1.0)):
        corner = at(piece, np.full(len(piece), mine))
        parted = between(piece, other, (fractions + mine) / 2.0) > 2.0 * JOINED
        turn = direction(piece, np.full(len(piece), mine)) * np.conj(direction(other, np.full(len(piece), theirs)))
        elsewhere = (np.abs(points - corner) > 10.0 * JOINED) & (parted | (turn.real < -1.0 + 1e-9))
        away &= ~joint | elsewhere
    return away
