"""Self-crossings: where a surface crosses or touches itself away from its joints."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from core.geometry.distance import distance, distances_at, foot, nearest_fractions
from core.geometry.nearby import near_pairs_within, sorted_pairs
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, direction
from core.tolerance import JOINED

HALF_TURN_GAP: Final = 1e-6
"""Radians: an angle this little short of half a turn counts as half a turn."""

PAIRS_AT_A_TIME: Final = 2_500
"""Pairs that are examined at a time, which bounds the memory in use."""


@dataclass(frozen=True, eq=False, slots=True)
class SelfCrossings:
    """The `points` (m,) where a surface meets itself, in order, and both lengths traveled to each, `places` (m, 2)."""

    places: Floats
    points: Points

    def __len__(self) -> int:
        return len(self.points)


NO_CROSSINGS: Final = SelfCrossings(np.zeros((0, 2)), np.zeros(0, np.complex128))
"""The crossings of a surface that does not meet itself."""


def self_crossings(surface: PieceArrays, *, closed: bool) -> SelfCrossings:
    """Find where pieces come within JOINED of each other; neighbors only away from their joint."""
    i, j = _candidates(surface, closed=closed)
    batches = [slice(first, first + PAIRS_AT_A_TIME) for first in range(0, len(i), PAIRS_AT_A_TIME)]
    met = [NO_CROSSINGS, *(_meetings(surface, i[batch], j[batch], closed=closed) for batch in batches)]
    places, points = (np.concatenate(column) for column in zip(*((m.places, m.points) for m in met), strict=True))
    order = np.argsort(places[:, 0], kind="stable")
    return SelfCrossings(places[order], points[order])


def _meetings(surface: PieceArrays, i: Rows, j: Rows, *, closed: bool) -> SelfCrossings:
    """Return where these pairs of pieces meet, unordered."""
    consecutive = j == i + 1
    over_start = (i == 0) & (j == len(surface) - 1) if closed else np.zeros(len(i), np.bool_)
    piece, other = surface.take(i), surface.take(j)
    fractions = np.vstack((nearest_fractions(piece, other), np.full(len(piece), 0.5)))
    points = at(piece, fractions)
    meets = (distance(other, points) <= JOINED) & _away(piece, other, fractions, points, consecutive, over_start)
    k, pair = np.nonzero(meets)
    on_other = foot(other.take(pair), points[k, pair])
    stations = surface.stations
    first = stations[i[pair]] + fractions[k, pair] * piece.length[pair]
    second = stations[j[pair]] + on_other * other.length[pair]
    return SelfCrossings(np.stack((first, second), axis=1), points[k, pair])


def _candidates(surface: PieceArrays, *, closed: bool) -> tuple[Rows, Rows]:
    """Return pairs i < j that may meet away from a joint: any near pieces, and neighbors that may turn back."""
    i, j = sorted_pairs(near_pairs_within(surface.boxes, JOINED))
    # a curve must turn through half a turn to come back
    back = _turned(surface, i, i + 1) > pi - HALF_TURN_GAP
    may_meet = (j - i >= 2) | back
    if closed and len(surface) > 2:
        seam = (i == 0) & (j == len(surface) - 1)
        may_meet &= ~seam | (_turned(surface, j, i) > pi - HALF_TURN_GAP)
    return i[may_meet], j[may_meet]


def _turned(surface: PieceArrays, rows: Rows, following: Rows) -> Floats:
    """Return by how much these pieces, the following ones and the joints between them turn in all, radians."""
    end, begin = at_joints(surface, rows, following)
    turned: Floats = np.abs(np.angle(begin * np.conj(end)))
    return turned + surface.angle[rows] + surface.angle[following]


def at_joints(surface: PieceArrays, rows: Rows, following: Rows) -> Points:
    """Return (2, m) the directions at the ends of these pieces and the starts of the following ones, of any length."""
    both = np.array((rows, following))
    vector, turn, arm = surface.vector[both], surface.turn[both], surface.arm[both]
    arm[0] += vector[0]
    return np.where(turn == 0.0, vector, 1j * turn * arm)


def _away(
    piece: PieceArrays, other: PieceArrays, fractions: Floats, points: Points, consecutive: Flags, over_start: Flags
) -> Flags:
    """Return (9, m) True for places that do not belong to a joint.

    Pieces that leave a joint smoothly stay within any tolerance of each other for a while; they meet again
    only if they are apart in between, or if the later one runs back over the earlier one.
    """
    away = np.ones(points.shape, np.bool_)
    for joint, own_end, other_end in ((consecutive, 1.0, 0.0), (over_start, 0.0, 1.0)):
        corner = at(piece, np.full(len(piece), own_end))
        separated = distances_at(piece, other, (fractions + own_end) / 2.0) > 2.0 * JOINED
        turn = direction(piece, np.full(len(piece), own_end)) * np.conj(
            direction(other, np.full(len(piece), other_end))
        )
        elsewhere = (np.abs(points - corner) > 10.0 * JOINED) & (separated | (turn.real < -1.0 + 1e-9))
        away &= ~joint | elsewhere
    return away
