"""Crossing: where a surface crosses or touches itself, other than its neighbours at their joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.boxes import near_pairs
from core.geometry.distance import between, distance, foot, nearest_places
from core.geometry.measured import Flags, Floats, Measured, Points, Rows, at, direction
from core.tolerance import JOINED


@dataclass(frozen=True, eq=False, slots=True)
class Crossings:
    """m places (m, 2) in length travelled at which a surface meets itself, in order, and the points (m,)."""

    places: Floats
    points: Points

    def __len__(self) -> int:
        return len(self.points)


def crossings(surface: Measured, stations: Floats, bounds: Floats, *, closed: bool) -> Crossings:
    """Where pieces that are not neighbours come within JOINED of each other, and neighbours away from their joint."""
    i, j = near_pairs(bounds, bounds, JOINED)
    later = j > i
    i, j = i[later], j[later]
    following = j == i + 1
    around = (i == 0) & (j == len(surface) - 1) if closed else np.zeros(len(i), np.bool_)
    joint = following | around
    keep = ~joint | _may_meet_again(surface, i, j, following)
    i, j, following, around = i[keep], j[keep], following[keep], around[keep]
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


def _may_meet_again(surface: Measured, i: Rows, j: Rows, following: Flags) -> Flags:
    """Neighbours that can meet elsewhere than at their joint: one is an arc, or the later runs straight back."""
    arcs = surface.arcs
    one, other = np.where(following, i, j), np.where(following, j, i)
    back = (np.conj(surface.unit[one]) * surface.unit[other]).real < -0.5
    again: Flags = arcs[i] | arcs[j] | back
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
