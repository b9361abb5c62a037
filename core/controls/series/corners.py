"""Where many elements meet: `controls.corners` on arrays, formula by formula; row i of one meets row i of the other."""

from __future__ import annotations

from math import tau

import numpy as np

from core.controls.compensation.corners import WHOLE
from core.controls.moves import Floats
from core.controls.series.elements import Elements, Points, angles, hypots, squares
from core.controls.series.words import Flags
from core.geometry.piece import Point

Meetings = tuple[Points, Points, Flags]
"""Of each two elements the first and the second meeting, of two lines the same one twice; and whether there is any."""


def radii(elements: Elements) -> Floats:
    """Radii of arcs at their starts, 0 for lines."""
    found, arcs = np.zeros(elements.size), np.flatnonzero(elements.turn)
    some = elements.of(arcs)
    found[arcs] = hypots(some.start_x - some.center_x, some.start_y - some.center_y)
    return found


def turnings(first: Elements, second: Elements) -> Floats:
    """The angles from the ends of elements to the starts of the next: `turning`."""
    (ax, ay), (bx, by) = first.arriving, second.leaving
    return angles(ax * by - ay * bx, ax * bx + ay * by)


def square_starts(elements: Elements, offset: float) -> Points:
    """E2: beside the starts."""
    return squares(elements.start, elements.leaving, offset)


def square_ends(elements: Elements, offset: float) -> Points:
    """E1: beside the ends."""
    return squares(elements.end, elements.arriving, offset)


def meetings(first: Elements, second: Elements, offset: float) -> Meetings:
    """Where the offsets of each two elements meet: `meetings`."""
    count = first.size
    one, two = (np.zeros(count), np.zeros(count)), (np.zeros(count), np.zeros(count))
    radius = radii(first) - first.turn * offset
    other = radii(second) - second.turn * offset
    fits = ((first.turn == 0.0) | (radius > 0.0)) & ((second.turn == 0.0) | (other > 0.0))
    found = np.zeros(count, np.bool_)
    for bent, curved in ((False, False), (False, True), (True, False), (True, True)):
        at = np.flatnonzero(fits & ((first.turn != 0.0) == bent) & ((second.turn != 0.0) == curved))
        a, b = first.of(at), second.of(at)
        if not bent and not curved:
            made = _line_line(square_ends(a, offset), a.arriving, square_starts(b, offset), b.leaving)
        elif not bent:
            made = _line_circle(square_ends(a, offset), a.arriving, b.center, other[at])
        elif not curved:
            made = _line_circle(square_starts(b, offset), b.leaving, a.center, radius[at])
        else:
            made = _circle_circle(a.center, radius[at], b.center, other[at])
        (one[0][at], one[1][at]), (two[0][at], two[1][at]), found[at] = made
    return one, two, found


def _beyond(at: Points, way: Points, distance: Floats) -> Points:
    return at[0] + distance * way[0], at[1] + distance * way[1]


def _line_line(at: Points, way: Points, other: Points, heading: Points) -> Meetings:
    cross = way[0] * heading[1] - way[1] * heading[0]
    met = ~(np.abs(cross) < WHOLE)
    over = (other[0] - at[0]) * heading[1] - (other[1] - at[1]) * heading[0]
    point = _beyond(at, way, over / np.where(met, cross, 1.0))
    return point, point, met


def _line_circle(at: Points, way: Points, center: Points, radius: Floats) -> Meetings:
    dx, dy = center[0] - at[0], center[1] - at[1]
    along, aside = dx * way[0] + dy * way[1], dy * way[0] - dx * way[1]
    half = radius * radius - aside * aside
    met = ~(half < 0.0)
    reach = np.sqrt(np.where(met, half, 0.0))
    return _beyond(at, way, along - reach), _beyond(at, way, along + reach), met


def _circle_circle(first: Points, radius: Floats, second: Points, other: Floats) -> Meetings:
    dx, dy = second[0] - first[0], second[1] - first[1]
    apart = hypots(dx, dy)
    met = ~(apart < WHOLE)
    apart = np.where(met, apart, 1.0)
    way = dx / apart, dy / apart
    along = (apart * apart + radius * radius - other * other) / (2 * apart)
    half = radius * radius - along * along
    met &= ~(half < 0.0)
    reach = np.sqrt(np.where(met, half, 0.0))
    foot = _beyond(first, way, along)
    return squares(foot, way, reach), squares(foot, way, -reach), met


def after(started: Point | None, starts: Points) -> Points:
    """Where each element before a corner starts: the first one there, if known, the others behind the corner before."""
    x, y = started or (np.nan, np.nan)
    return np.concatenate(((x,), starts[0][:-1])), np.concatenate(((y,), starts[1][:-1]))


def sweeps(start: Points, end: Points, center: Points, turn: Floats) -> Floats:
    """The angles traveled; equal ends are 0: `sweep`."""
    first = angles(start[1] - center[1], start[0] - center[0])
    last = angles(end[1] - center[1], end[0] - center[0])
    angle = (turn * (last - first)) % tau
    return np.where(angle > tau - WHOLE, 0.0, angle)
