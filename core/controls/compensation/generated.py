"""Joints with generated blocks: outside corners of the 9/Series, and its entries and exits of type A and B.

phi is the turn at the corner.  Up to a right angle the offsets are prolonged to M; beyond it each offset is prolonged
by the radius (Q1, Q2) and the two are joined, or an arc goes about the corner (G39.1) where both elements are straight.
The polylines of type B are read from figures and agree with those of other makers: an interpretation.
"""

from __future__ import annotations

from enum import StrEnum
from math import hypot, pi
from typing import Final

from core.controls.compensation.corners import (
    WHOLE,
    Element,
    beyond,
    line_element,
    meeting,
    mitre,
    square_end,
    square_start,
    turning,
)
from core.controls.compensation.offset_chain import Joint
from core.geometry.piece import Point

RIGHT_ANGLE: Final = pi / 2 + 1e-9
"""Turns up to this are prolonged to one point."""

STRAIGHT: Final = 1e-9
"""Turns under this are none."""


class Corners(StrEnum):
    """How sharp outside corners are gone round: generated lines (G39) or an arc (G39.1)."""

    LINES = "g39"
    ARC = "g39.1"


def inward(first: Element, second: Element, sign: int) -> float:
    """The turn at a corner, positive where it is an inside one for a tool on the side of `sign`."""
    angle = turning(first, second) * sign
    return -pi if abs(angle) > pi - WHOLE else angle


def outside(first: Element, second: Element, offset: float, corners: Corners) -> Joint:
    """An outside corner in compensation."""
    angle = turning(first, second)
    end, start = square_end(first, offset), square_start(second, offset)
    if abs(angle) <= RIGHT_ANGLE:
        point = mitre(first.end, first.arriving, angle, offset)
        return _joint(first, second, (end, point, point, start))
    if corners is Corners.ARC and not first.turn and not second.turn:
        return Joint(end, start, center=second.start)
    leaving, coming = _prolonged(first, second, offset)
    return _joint(first, second, (end, leaving, coming, start))


def _prolonged(first: Element, second: Element, offset: float) -> tuple[Point, Point]:
    """Q1 and Q2."""
    reach = abs(offset)
    end, start = square_end(first, offset), square_start(second, offset)
    return beyond(end, first.arriving, reach), beyond(start, second.leaving, -reach)


def _joint(first: Element, second: Element, points: tuple[Point, Point, Point, Point]) -> Joint:
    """The joint over E1, the end of the first one's prolongation, the start of the second one's, E2.

    A line is prolonged itself; an arc ends square and the prolongation is a block of its own.
    """
    end, leaving, coming, start = points
    through = () if not first.turn else (leaving,)
    if second.turn and coming != leaving:
        through = (*through, coming)
    return Joint(leaving if not first.turn else end, start if second.turn else coming, through)


def entry(first: Element, second: Element, offset: float, corners: Corners, *, short: bool) -> Joint:
    """The entry move against the first element: `short` is type A, straight to the square start."""
    start = square_start(second, offset)
    sign = 1 if offset > 0.0 else -1
    if short or inward(first, second, sign) >= 0.0:
        return Joint(start, start)
    angle = turning(first, second)
    end = square_end(first, offset)
    if abs(angle) <= RIGHT_ANGLE:
        return Joint(mitre(first.end, first.arriving, angle, offset), start)
    if corners is Corners.ARC and not second.turn:
        return Joint(end, start, center=second.start)
    return Joint(end, start, _prolonged(first, second, offset))


def exit_points(last: Element, leaving: Element, offset: float, corners: Corners) -> Joint:
    """Type B's way from the last element to where the exit move starts: the mirror image of the entry."""
    end = square_end(last, offset)
    sign = 1 if offset > 0.0 else -1
    if inward(last, leaving, sign) >= 0.0:
        return Joint(end, end)
    angle = turning(last, leaving)
    if abs(angle) <= RIGHT_ANGLE:
        point = mitre(last.end, last.arriving, angle, offset)
        return Joint(end, point)
    start = square_start(leaving, offset)
    if corners is Corners.ARC and not last.turn:
        return Joint(end, start, center=leaving.start)
    return Joint(end, start, _prolonged(last, leaving, offset))


def changed(first: Element, second: Element, old: float, new: float) -> Joint:
    """The radius or the side changes: square end with the old one, square start with the new one.

    Where the side changes at an arc, the meeting of the two offsets is taken if there is one.
    """
    if old * new < 0.0 and (first.turn or second.turn):
        point = meeting(first, second, old, new)
        if point is not None:
            return Joint(point, point)
    return Joint(square_end(first, old), square_start(second, new))


def bent(last: Element, vector: Point, offset: float) -> Point:
    """The last point as the vector of an exit block moves it, by one radius at most.

    The vector's line through the programmed end is offset to the tool's side; where it meets the offset path is the new
    point.  A vector along the path shifts the point against the vector by the radius.
    """
    end, reach, size = square_end(last, offset), abs(offset), hypot(*vector)
    if not size:
        return end
    towards = beyond(last.end, vector, 1.0)
    point = meeting(last, line_element(last.end, towards, 0.0, 0.0, rapid=False, feed=0.0, line=0), offset)
    if point is None:
        return beyond(end, vector, -reach / size)
    apart = hypot(point[0] - end[0], point[1] - end[1])
    return beyond(end, (point[0] - end[0], point[1] - end[1]), 1.0 if apart <= reach else reach / apart)
