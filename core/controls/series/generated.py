"""Joints with generated blocks between many elements: what `NineSeries.joint` and `controls.generated` make of them."""

from __future__ import annotations

from math import pi, tan
from typing import Final, NamedTuple

import numpy as np

from core.controls.compensation.corners import WHOLE
from core.controls.compensation.generated import RIGHT_ANGLE, STRAIGHT, Corners
from core.controls.compensation.offset_chain import SAME
from core.controls.moves import WIDTH, Floats, Plane
from core.controls.series.corners import Meetings, meetings, square_ends, square_starts, turnings
from core.controls.series.elements import Elements, Points, hypots, rows
from core.controls.series.words import Flags

_MOST: Final = 4
"""Moves of an element and its joint: itself, two that prolong, the way to where the next one starts."""


class Joints(NamedTuple):
    """n joints as `Joint` has them.

    `leaving` and `coming` are the points between, each where `leaves` and `comes`; `bends`: the last of the way is an
    arc about the corner; `outside` of the turn; `met`: there is a joint.
    """

    ends: Points
    starts: Points
    leaving: Points
    coming: Points
    leaves: Flags
    comes: Flags
    bends: Flags
    outside: Flags
    met: Flags

    def first(self, count: int) -> Joints:
        """The first of them only."""
        ends, starts, leaving, coming = ((x[:count], y[:count]) for x, y in self[:4])
        leaves, comes, bends, outside, met = (one[:count] for one in self[4:])
        return Joints(ends, starts, leaving, coming, leaves, comes, bends, outside, met)

    @property
    def generated(self) -> Flags:
        """Where the control makes blocks of its own."""
        between = self.leaves | self.comes | self.bends | _unlike(self.ends, self.starts)
        return self.outside & between


def joints(first: Elements, second: Elements, offset: float, corners: Corners, tangent: float) -> Joints:
    """How elements meet the next ones under one radius; inside corners under `tangent` may miss each other."""
    turn = turnings(first, second)
    inward = turn * (1 if offset > 0.0 else -1)
    inward = np.where(np.abs(inward) > pi - WHOLE, -pi, inward)
    even = np.abs(inward) < STRAIGHT
    outside, inside = ~even & (inward < 0.0), ~even & (inward >= 0.0)
    bent, curved = first.turn != 0.0, second.turn != 0.0
    bends = outside & (np.abs(turn) > RIGHT_ANGLE) & ~bent & ~curved & (corners is Corners.ARC)
    square, begin = square_ends(first, offset), square_starts(second, offset)
    leaving, coming = _prolonged(first, second, turn, offset, (square, begin))
    longer = outside & ~bends
    point, found = _nearest(meetings(first, second, offset), first.end)
    ends = _either(longer & ~bent, leaving, _either(inside & found, point, square))
    starts = _either((longer & curved) | bends, begin, _either(longer, coming, ends))
    comes = longer & curved & _unlike(coming, leaving)
    met = ~inside | found | (inward < tangent)
    return Joints(ends, starts, leaving, coming, longer & bent, comes, bends, outside, met)


def _prolonged(
    first: Elements, second: Elements, turn: Floats, offset: float, square: tuple[Points, Points]
) -> tuple[Points, Points]:  # fmt: skip
    """Of outside corners M twice up to a right angle, else Q1 and Q2."""
    (ex, ey), (bx, by) = square
    reach = np.full(first.size, abs(offset))
    blunt = np.flatnonzero(np.abs(turn) <= RIGHT_ANGLE)
    half = np.abs(turn[blunt]) / 2
    reach[blunt] = abs(offset) * np.fromiter(map(tan, half.tolist()), np.float64, len(blunt))
    leaving = ex + reach * first.arriving_x, ey + reach * first.arriving_y
    coming = bx + -reach * second.leaving_x, by + -reach * second.leaving_y
    coming[0][blunt], coming[1][blunt] = leaving[0][blunt], leaving[1][blunt]
    return leaving, coming


def _nearest(meeting: Meetings, corner: Points) -> tuple[Points, Flags]:
    """The meetings nearest to the corners, and where there are any: see `meeting`."""
    one, two, found = meeting
    away, other = (hypots(x - corner[0], y - corner[1]) for x, y in (one, two))
    return _either(other < away, two, one), found


def _either(where: Flags, one: Points, other: Points) -> Points:
    return np.where(where, one[0], other[0]), np.where(where, one[1], other[1])


def _unlike(one: Points, other: Points) -> Flags:
    unlike: Flags = (one[0] != other[0]) | (one[1] != other[1])
    return unlike


def chained(first: Elements, second: Elements, made: Joints, plane: Plane, offset: float) -> Floats:
    """The rows of a tape: each element to its end, and what leads to the start of the next one."""
    table = np.empty((_MOST * first.size, WIDTH))
    straight = np.zeros(first.size)
    bends = np.where(made.bends, -1.0 if offset > 0.0 else 1.0, 0.0)
    here = _either(made.comes, made.coming, _either(made.leaves, made.leaving, made.ends))
    apart = (np.abs(here[0] - made.starts[0]) > SAME) | (np.abs(here[1] - made.starts[1]) > SAME)
    table[0::_MOST] = rows(made.ends, first.high, first.center, first, plane)
    ways = ((made.leaving, straight), (made.coming, straight), (made.starts, bends))
    for index, (points, turn) in enumerate(ways, 1):
        table[index::_MOST] = rows(points, second.low, second.start, second, plane, turn=turn)
    kept = np.column_stack((np.ones(first.size, np.bool_), made.leaves, made.comes, made.bends | apart))
    packed: Floats = table[kept.ravel()]
    return packed
