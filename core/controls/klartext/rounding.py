"""RND and CHF: an arc or a line put between two programmed elements, tangent to both or of equal legs."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, radians

from core.controls.compensation import corners
from core.controls.compensation.corners import Element, arc_element, line_element
from core.geometry.piece import Point
from core.tolerance import JOINED


@dataclass(frozen=True, slots=True)
class NoRoom:
    """Why two elements cannot be rounded or chamfered; a sentence."""

    text: str


Joined = tuple[Element, Element, Element]
"""The first element cut short, what is between, and the second element cut short."""


def rounding(first: Element, second: Element, radius: float) -> Joined | NoRoom:
    """An arc of `radius` millimeters tangent to both elements; the arc has the first one's feed, line and column."""
    angle = corners.turning(first, second)
    if abs(angle) < corners.WHOLE or not _level(first, second):
        return NoRoom("There is no corner to round: both blocks must lie in the working plane and meet at an angle.")
    aside = radius if angle > 0.0 else -radius
    ending = first._replace(start=first.end) if first.turn else first
    center = corners.meeting(ending, second, aside)
    if center is None:
        return NoRoom("No arc of this radius touches both blocks; write a smaller R.")
    start, end = _touch(ending, center, aside), _touch(second, center, aside)
    if not _on(first, start) or not _on(second, end):
        return NoRoom("The rounding is longer than the blocks it joins; write a smaller R.")
    turn = 1 if angle > 0.0 else -1
    arc = arc_element(start, end, center, turn, first.high, first.high, first.feed, first.line, first.column)
    return _cut_end(first, start), arc, _cut_start(second, end)


def chamfer(first: Element, second: Element, leg: float) -> Joined | NoRoom:
    """A line that cuts `leg` millimeters off both elements; they must be straight."""
    if first.turn or second.turn or not _level(first, second):
        return NoRoom("A chamfer stands between two straight blocks in the working plane only; use RND.")
    start, end = corners.beyond(first.end, first.arriving, -leg), corners.beyond(first.end, second.leaving, leg)
    if not _on(first, start) or not _on(second, end):
        return NoRoom("The chamfer is longer than the blocks it joins; write a shorter one.")
    high, line = first.high, first.line
    between = line_element(start, end, high, high, first.rapid, first.feed, line, first.column)
    return _cut_end(first, start), between, _cut_start(second, end)


def _level(first: Element, second: Element) -> bool:
    return first.low == first.high == second.low == second.high


def _touch(element: Element, center: Point, aside: float) -> Point:
    """Where a circle about `center`, `aside` to the left of the element, touches it."""
    if not element.turn:
        return corners.square(center, element.leaving, -aside)
    (x, y), (cx, cy) = center, element.center
    share = element.radius / hypot(x - cx, y - cy)
    return cx + (x - cx) * share, cy + (y - cy) * share


def _on(element: Element, at: Point) -> bool:
    if not element.turn:
        (x, y), way = element.start, element.leaving
        along = (at[0] - x) * way[0] + (at[1] - y) * way[1]
        return -JOINED <= along <= hypot(element.end[0] - x, element.end[1] - y) + JOINED
    return corners.sweep(element.start, at, element.center, element.turn) <= corners.element_sweep(element)


def _cut_end(element: Element, end: Point) -> Element:
    if not element.turn:
        return element._replace(end=end)
    return element._replace(end=end, arriving=corners.tangent(end, element.center, element.turn))


def _cut_start(element: Element, start: Point) -> Element:
    if not element.turn:
        return element._replace(start=start, center=start)
    return element._replace(start=start, leaving=corners.tangent(start, element.center, element.turn))


def tangent_center(start: Point, end: Point, way: Point) -> tuple[Point, int] | NoRoom:
    """Center and turn of the arc from start to end that sets off in direction `way`."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    cross, chord = way[0] * dy - way[1] * dx, hypot(dx, dy)
    if chord <= JOINED:
        return NoRoom("A tangent arc needs an end point away from its start.")
    if abs(cross) <= chord * corners.WHOLE:
        return NoRoom("The end point lies straight ahead or behind: no tangent arc leads there; write L.")
    return corners.square(start, way, chord * chord / (2.0 * cross)), 1 if cross > 0.0 else -1


def polar(pole: Point, radius: float, angle: float) -> Point:
    """The point at a distance and an angle in degrees from a pole; multiples of 90 degrees are exact."""
    quarter = angle / 90.0
    if quarter.is_integer():
        x, y = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarter) % 4]
    else:
        x, y = cos(radians(angle)), cos(radians(angle - 90.0))
    return pole[0] + radius * x, pole[1] + radius * y
