"""Crossing: where a surface crosses or touches itself, other than its neighbours at their joint."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from core.geometry.boxes import near_pairs_within
from core.geometry.distance import between, distance, foot, nearest_places
from core.geometry.measured import Flags, Floats, Measured, Points, Rows, at, direction
from core.tolerance import JOINED

TURN: Final = 1e-6
"""Radians short of half a turn that are taken for one."""


@dataclass(frozen=True, eq=False, slots=True)
class Crossings:
    """m places (m, 2) in length travelled at which a surface meets itself, in order, and the points (m,)."""

    places: Floats
    points: Points

    def __len__(self) -> int:
        return len(self.points)


def crossings(surface: Measured, stations: Floats, bounds: Floats, *, closed: bool) -> Crossings:
    """Where pieces that are not neighbours come within JOINED of each other, and neighbours away from their joint."""
    i, j = _candidates(surface, bounds, closed=closed)
    if not len(i):
        return Crossings(np.zeros((0, 2)), np.zeros(0, np.complex128))
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


def _candidates(surface: Measured, bounds: Floats, *, closed: bool) -> tuple[Rows, Rows]:
    """Pairs i < j that may meet elsewhere than at a joint: any near ones, and neighbours that come back."""
    i, j = near_pairs_within(bounds, JOINED)
    first = np.flatnonzero(_overlapping(bounds))
    if closed and len(surface) > 2:
        others: Flags = (i > 0) | (j < len(surface) - 1)
        i, j, first = i[others], j[others], np.append(first, -1)
    if len(first):
        rows = np.stack((first % len(surface), first + 1))
        ends = np.sort(rows, axis=0)
        again = _may_meet_again(surface, ends[0], ends[1], rows[0] < rows[1])
        i, j = np.concatenate((i, ends[0][again])), np.concatenate((j, ends[1][again]))
    return i, j


def _overlapping(bounds: Floats) -> Flags:
    """(n - 1,) boxes that share more with the next one than the surroundings of a joint, where neighbours are one."""
    shared = np.minimum(bounds[2:, 1:], bounds[2:, :-1]) - np.maximum(bounds[:2, 1:], bounds[:2, :-1])
    wide: Flags = np.any(shared > 5.0 * JOINED, axis=0)
    return wide


def _may_meet_again(surface: Measured, i: Rows, j: Rows, following: Flags) -> Flags:
    """Neighbours that can meet elsewhere than at their joint: a curve must turn half round to come back to itself."""
    one, other = surface.take(np.where(following, i, j)), surface.take(np.where(following, j, i))
    leaving, arriving = direction(other, np.zeros(len(i))), direction(one, np.ones(len(i)))
    turned = one.angle + other.angle + np.abs(np.angle(leaving * np.conj(arriving)))
    again: Flags = turned > pi - TURN
    return again


def _away(one: Measured, other: Measured, places: Floats, points: Points, following: Flags, around: Flags) -> Flags:
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
