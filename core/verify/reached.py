"""Reached: the stretches of a surface that are within the radius of a center path, and the gaps between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.distance import band_places, feet
from core.geometry.path import Floats, Rows
from core.tolerance import STOCK
from core.verify.pairs import Pairs
from core.verify.reach import Parts, Stretches, joined, within


@dataclass(frozen=True, eq=False, slots=True)
class Reached:
    """Stretches of surface that are reached, and the pieces of the center path that reach their two ends."""

    stretches: Stretches
    begin: Rows
    end: Rows

    def gaps(self, total: float) -> tuple[Stretches, Rows]:
        """What is not reached and longer than STOCK, and (2, k) the center pieces at its ends, -1 at the contour's."""
        first, last = np.zeros((2, len(self.stretches) + 1))
        first[1:], last[:-1], last[-1] = self.stretches.last, self.stretches.first, total
        near = np.full((2, len(first)), -1)
        near[0, 1:], near[1, :-1] = self.end, self.begin
        wide = (last - first > STOCK).nonzero()[0]
        return Stretches(first[wide], last[wide]), near.take(wide, axis=1)


def covered(pairs: Pairs) -> bool:
    """Every wall is reached from end to end by a single piece of the center path, for sure."""
    touch, whole = pairs.touch, np.zeros(len(pairs.surface), np.bool_)
    whole[: len(pairs.own.last)] = (pairs.own.first <= 0.0) & (pairs.own.last >= 1.0)
    whole[pairs.j[~touch.unsure & (touch.first <= 0.0) & (touch.last >= 1.0)]] = True
    return bool(whole.all())


def reached(pairs: Pairs, radius: float) -> Reached:
    """The stretches of surface within the radius of the center path.

    What is granted for rounding and for uneven arcs decides whether a place is reached; where a stretch ends is then
    settled with the radius alone.
    """
    touch = pairs.touch
    sure = (~touch.unsure & (touch.first <= touch.last)).nonzero()[0]
    walls = pairs.j.take(sure)
    start, length = pairs.surface_stations.take(walls), pairs.surface.length.take(walls)
    first, last = start + touch.first.take(sure) * length, start + touch.last.take(sure) * length
    parts = Parts(first, last, first, first, sure)
    own = (pairs.own.piece >= 0).nonzero()[0]
    if len(own):
        parts = joined((_by_own(pairs, own), parts))
    unsure = touch.unsure.nonzero()[0]
    if len(unsure):
        more = within(pairs.surface, pairs.j[unsure], pairs.center, pairs.i[unsure], radius + pairs.grant[unsure])
        parts = joined((parts, Parts(more.first, more.last, more.middle, more.apart, unsure[more.pair])))
    return _settled(pairs, parts, radius)


def _by_own(pairs: Pairs, walls: Rows) -> Parts:
    """What own pieces reach of their walls; their pairs count on from the measured ones."""
    start, length = pairs.surface_stations[walls], pairs.surface.length[walls]
    first, last = start + pairs.own.first[walls] * length, start + pairs.own.last[walls] * length
    return Parts(first, last, first, first, len(pairs.i) + walls)


def _settled(pairs: Pairs, parts: Parts, radius: float) -> Reached:
    """Parts as stretches; their ends drawn in to where an unsure pair reaches them with the radius alone."""
    order = parts.first.argsort(kind="stable")
    first, last = parts.first.take(order), parts.last.take(order)
    furthest = np.maximum.accumulate(last)
    begins = np.ones(len(first), np.bool_)
    begins[1:] = first[1:] > furthest[:-1]
    begin = begins.nonzero()[0]
    if not len(begin):
        return Reached(Stretches(first, last), order, order)
    holder = np.maximum.accumulate(np.where(last == furthest, np.arange(len(last)), 0))
    end = holder[np.concatenate((begin[1:], (len(first),))) - 1]
    pair = parts.pair[order[np.concatenate((begin, end))]]
    ends = np.concatenate((first[begin], last[end]))
    measured = (pair < len(pairs.i)).nonzero()[0]
    loose = measured[pairs.touch.unsure[pair[measured]]]
    if len(loose):
        inward = np.repeat((1.0, -1.0), len(begin))
        ends[loose] = _draw_in(pairs, pair[loose], ends[loose], inward[loose], radius)
    low, high = ends[: len(begin)], ends[len(begin) :]
    i = np.concatenate((pairs.i, pairs.own.piece))[pair]
    return Reached(Stretches(low, np.maximum(low, high)), i[: len(begin)], i[len(begin) :])


def _draw_in(pairs: Pairs, pair: Rows, ends: Floats, inward: Floats, radius: float) -> Floats:
    """Ends moved `inward` (+1 or -1 along the surface) to where the distance is the radius, or least.

    What is granted moves an end by as much as sqrt(2 r grant) where the reach ends in a circle about the end of a
    move beside the wall; the foot of that end is where it stops when the wall is exactly a radius away.
    """
    i, j, grant = pairs.i[pair], pairs.j[pair], pairs.grant[pair]
    piece, other = pairs.surface.take(j), pairs.center.take(i)
    places = np.concatenate((band_places(piece, other, np.full(len(pair), radius)), feet(piece, other)))
    moved = (pairs.surface_stations[j] + places * piece.length - ends) * inward
    widest = 2.0 * np.sqrt(2.0 * (radius + grant) * grant)
    least = np.where((moved > 0.0) & (moved < widest), moved, np.inf).min(axis=0)
    return ends + inward * np.where(np.isinf(least), 0.0, least)
