"""Elements are programmed lines and arcs in a plane, with their offset points and the meetings of their offsets.

The tool radius is signed: positive with the tool on the left.  P is the programmed corner, E1 the offset point at the
end of the first element, E2 the one at the start of the second, each at right angles to its element.
"""

from __future__ import annotations

from itertools import pairwise
from math import atan2, hypot, pi, tan, tau
from typing import Final, NamedTuple

from core.geometry.carrier import Carrier, meeting_points
from core.geometry.piece import Point
from core.tolerance import ROUNDING

SAME_DIRECTION: Final = 1e-9
"""Radians within which two directions are equal, and by which rounding may carry an arc past its end."""


class Element(NamedTuple):
    """A programmed line or arc in its plane, with the data that its control needs later.

    Start, end and center (for a line its start); `turn` 0, +1 or -1; unit directions at start and end ((0, 0) without
    length); coordinates across the plane at both ends; feed in millimeters per minute, source line and column.
    """

    start: Point
    end: Point
    center: Point
    turn: int
    start_direction: Point
    end_direction: Point
    start_height: float
    end_height: float
    rapid: bool
    feed: float
    line: int
    column: int

    @property
    def radius(self) -> float:
        """The radius of an arc, at its start."""
        return hypot(self.start[0] - self.center[0], self.start[1] - self.center[1])

    @property
    def moves(self) -> bool:
        """True if the element moves in the plane."""
        return self.turn != 0 or self.start != self.end


def line_element(
    start: Point, end: Point, start_height: float = 0.0, end_height: float = 0.0, rapid: bool = False,
    feed: float = 0.0, line: int = 0, column: int = 1,
) -> Element:  # fmt: skip
    """Return a line; height, feed and source are optional."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    size = hypot(dx, dy)
    direction = (dx / size, dy / size) if size else (0.0, 0.0)
    return Element(start, end, start, 0, direction, direction, start_height, end_height, rapid, feed, line, column)


def arc_element(
    start: Point, end: Point, center: Point, turn: int, start_height: float = 0.0, end_height: float = 0.0,
    feed: float = 0.0, line: int = 0, column: int = 1,
) -> Element:  # fmt: skip
    """Return an arc, a full circle if its ends are equal; height, feed and source are optional."""
    start_direction, end_direction = tangent(start, center, turn), tangent(end, center, turn)
    return Element(
        start, end, center, turn, start_direction, end_direction, start_height, end_height, False, feed, line, column
    )


def tangent(at: Point, center: Point, turn: int) -> Point:
    """Return the unit direction of travel at a point of an arc."""
    dx, dy = at[0] - center[0], at[1] - center[1]
    size = hypot(dx, dy) or 1.0
    return -turn * dy / size, turn * dx / size


def offset_point(at: Point, direction: Point, offset: float) -> Point:
    """Return the offset point of `at`, which is `offset` to the left of a direction."""
    return at[0] - offset * direction[1], at[1] + offset * direction[0]


def offset_start(element: Element, offset: float) -> Point:
    """Return E2, the offset point at an element's start."""
    return offset_point(element.start, element.start_direction, offset)


def offset_end(element: Element, offset: float) -> Point:
    """Return E1, the offset point at an element's end."""
    return offset_point(element.end, element.end_direction, offset)


def element_point(element: Element, point: Point, offset: float) -> Point:
    """Return the point of an element that belongs to a point of its offset, the inverse of `offset_point`."""
    if not element.turn:
        return offset_point(point, element.start_direction, -offset)
    share = element.radius / offset_radius(element, offset)
    (x, y), (cx, cy) = point, element.center
    return cx + (x - cx) * share, cy + (y - cy) * share


def turn_angle(first: Element, second: Element) -> float:
    """Return the angle from the end of one element to the start of the next, radians, positive to the left."""
    (ax, ay), (bx, by) = first.end_direction, second.start_direction
    return atan2(ax * by - ay * bx, ax * bx + ay * by)


def miter(corner: Point, direction: Point, angle: float, offset: float) -> Point:
    """Return M, where the offsets of two straight directions meet outside the corner; `angle` is from `turn_angle`."""
    x, y = offset_point(corner, direction, offset)
    reach = abs(offset) * tan(abs(angle) / 2)
    return x + reach * direction[0], y + reach * direction[1]


def point_along(at: Point, direction: Point, distance: float) -> Point:
    """Return the point `distance` further along a direction."""
    return at[0] + distance * direction[0], at[1] + distance * direction[1]


def offset_radius(element: Element, offset: float) -> float:
    """Return the radius of an arc's offset; 0 or less if the tool is too large to run inside it."""
    return element.radius - element.turn * offset


def meeting(
    first: Element, second: Element, offset: float, other: float | None = None, *, beyond_center: bool = False
) -> Point | None:  # fmt: skip
    """Return the meeting of the offsets of two elements that is nearest to P; None if there is none.

    Lines count beyond their ends and arcs as whole circles: the control must check whether the point lies on what is
    left of the elements.  `other` is the second element's offset if it differs from the first one's.  `beyond_center`:
    an inside arc smaller than the tool has its offset on the other side of its center.
    """
    points = meetings(first, second, offset, offset if other is None else other, beyond_center=beyond_center)
    corner = first.end
    return min(points, key=lambda at: hypot(at[0] - corner[0], at[1] - corner[1]), default=None)


def meetings(
    first: Element, second: Element, offset: float, other: float, *, beyond_center: bool = False
) -> tuple[Point, ...]:  # fmt: skip
    """Return every meeting of the offsets of two elements; none if an inside arc has no offset."""
    if not beyond_center and not (fits(first, offset) and fits(second, other)):
        return ()
    return tuple((place.real, place.imag) for place in meeting_points(_carrier(first, offset), _carrier(second, other)))


def _carrier(element: Element, offset: float) -> Carrier:
    """Return the endless line or the whole circle of an element's offset."""
    if element.turn:
        return Carrier(complex(*element.center), 0j, abs(offset_radius(element, offset)))
    return Carrier(complex(*offset_end(element, offset)), complex(*element.end_direction), 0.0)


def fits(element: Element, offset: float) -> bool:
    """True if the tool can run along an element; inside an arc it must be smaller than the arc, beyond rounding."""
    return not element.turn or offset_radius(element, offset) > ROUNDING


def sweep(start: Point, end: Point, center: Point, turn: int) -> float:
    """Return the angle traveled from start to end, 0 <= sweep < a full turn; 0 for equal ends."""
    first = atan2(start[1] - center[1], start[0] - center[0])
    last = atan2(end[1] - center[1], end[0] - center[0])
    angle = (turn * (last - first)) % tau
    return 0.0 if angle > tau - SAME_DIRECTION else angle


def element_sweep(element: Element) -> float:
    """Return the angle an arc travels; a full turn for a full circle."""
    return sweep(element.start, element.end, element.center, element.turn) or tau


def single_turns(element: Element, turns: int) -> list[Element]:
    """Return an arc of several turns as full circles and the arc itself; its height changes evenly."""
    part = (element.end_height - element.start_height) * tau / (element_sweep(element) + tau * (turns - 1))
    heights = [element.start_height + part * turn for turn in range(turns)]
    circles = [
        element._replace(end=element.start, end_direction=element.start_direction, start_height=low, end_height=high)
        for low, high in pairwise(heights)
    ]
    return [*circles, element._replace(start_height=heights[-1])]


def _trim(programmed: Point, actual: Point, center: Point, turn: int) -> float:
    """Return the angle by which an arc's end lies inside the programmed arc, -pi / 2 if it extends it by a quarter."""
    angle = sweep(programmed, actual, center, turn)
    return angle - tau if angle > 1.5 * pi else angle


def runs_back(element: Element, start: Point, end: Point) -> bool:
    """True if a compensated element from `start` to `end` runs against the programmed one.

    A line does if it points the other way; an arc if its trims, or extensions of at most a quarter turn, have crossed.
    """
    if element.turn:
        cut_before = _trim(element.start, start, element.center, element.turn)
        cut_after = _trim(element.end, end, element.center, -element.turn)
        return element_sweep(element) - cut_before - cut_after < -SAME_DIRECTION
    direction = element.start_direction
    return (end[0] - start[0]) * direction[0] + (end[1] - start[1]) * direction[1] < -SAME_DIRECTION
