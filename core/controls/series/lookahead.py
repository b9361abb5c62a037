"""Corners between many elements as LinuxCNC's queue makes them: what `LookAhead._corner` does, for all at once.

What a corner does to the elements on its two sides hangs on these two alone: where the first one's offset ends and the
second one's begins.  The check that an element does not run backwards needs the corners at both its ends.  So every
corner is worked out by itself, and the first one that would stop the program, and all behind it, are left to the queue.
"""

from __future__ import annotations

from math import pi, tau
from typing import NamedTuple

import numpy as np

from core.controls.compensation.corners import Element
from core.controls.moves import WIDTH, Floats, Plane
from core.controls.series.corners import after, meetings, radii, square_ends, square_starts, sweeps, turnings
from core.controls.series.elements import Elements, Points, rows
from core.controls.series.words import Flags, leading
from core.geometry.piece import Point


class Terms(NamedTuple):
    """What the corners go by: the signed radius, the angle under which there is none, the slack of an arc's sweep."""

    offset: float
    tangent: float
    slack: float


class Corners(NamedTuple):
    """n corners, the leading ones that stop nothing: where the element before each ends, where the one behind starts.

    `bends`: an arc leads about the corner from the one to the other.
    """

    ends: Points
    starts: Points
    bends: Flags


def corners(front: Element, started: Point | None, elements: Elements, terms: Terms) -> Corners:
    """The leading corners between `front`, which runs from `started`, and the elements behind it, that stop nothing."""
    first, offset = elements.behind(front).part(0, elements.size), terms.offset
    bent = elements.turn != 0.0
    angle = turnings(first, elements) * (1 if offset > 0.0 else -1)
    back = np.abs(angle) > pi - terms.tangent
    hooks = np.where(bent, elements.turn, first.turn) * offset < 0.0
    inside = ((angle > terms.tangent) & ~back) | (back & hooks)
    outside = ~inside & ((angle < -terms.tangent) | back)
    ends, sound = _inside(first, elements, inside, offset)
    begin = square_starts(elements, offset)
    starts = np.where(outside, begin[0], ends[0]), np.where(outside, begin[1], ends[1])
    sound &= elements.moves & ~((elements.turn * offset > 0.0) & (radii(elements) - elements.turn * offset <= 0.0))
    checked = inside | (outside & ~bent)
    sound &= ~(checked & _backwards(first, after(started, starts), ends, terms.slack))
    count = leading(sound)
    return Corners(_cut(ends, count), _cut(starts, count), outside[:count])


def _cut(points: Points, count: int) -> Points:
    return points[0][:count], points[1][:count]


def _inside(first: Elements, second: Elements, inside: Flags, offset: float) -> tuple[Points, Flags]:
    """Where the first of each two ends: at the meeting of an inside corner, elsewhere square; and whether it can."""
    ends, sound = square_ends(first, offset), np.ones(first.size, np.bool_)
    at = np.flatnonzero(inside)
    a, b = first.of(at), second.of(at)
    one, two, sound[at] = meetings(a, b, offset)
    first_in, second_in = a.turn * offset > 0.0, b.turn * offset > 0.0
    later = np.where(a.turn == 0.0, second_in, np.where(b.turn == 0.0, ~first_in, first_in != (b.turn > 0.0)))
    for axis in (0, 1):
        ends[axis][at] = np.where(later, two[axis], one[axis])
    return ends, sound


def _backwards(elements: Elements, start: Points, end: Points, slack: float) -> Flags:
    """Which run backwards from a start to an end, an arc nearly all the way round; not where the start is not known."""
    way = elements.leaving
    found = (end[0] - start[0]) * way[0] + (end[1] - start[1]) * way[1] < 0.0
    at = np.flatnonzero(elements.turn)
    arcs, begin, stop = elements.of(at), (start[0][at], start[1][at]), (end[0][at], end[1][at])
    swept = sweeps(arcs.start, arcs.end, arcs.center, arcs.turn)
    now = sweeps(begin, stop, arcs.center, arcs.turn)
    found[at] = np.where(now == 0.0, tau, now) > np.where(swept == 0.0, tau, swept) + slack
    return found & ~np.isnan(start[0])


def joined(front: Element, elements: Elements, made: Corners, plane: Plane, offset: float) -> Floats:
    """The rows of a tape from `front` on: each element to its end, and what leads about the corner behind it."""
    count = elements.size
    table = np.empty((2 * count, WIDTH))
    run = elements.behind(front).part(0, count)
    table[0::2] = rows(made.ends, run.high, run.center, run, plane)
    turn = np.where(elements.rapid == 1.0, 0.0, -1.0 if offset > 0.0 else 1.0)
    table[1::2] = rows(made.starts, elements.low, elements.start, elements, plane, turn=turn)
    kept = np.ones(2 * count, np.bool_)
    kept[1::2] = made.bends
    return table[kept]
