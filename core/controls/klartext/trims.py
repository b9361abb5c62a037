"""What the corners leave of a compensated element."""

from __future__ import annotations

from math import hypot, pi, tau

from core.controls.compensation import corners
from core.controls.compensation.corners import Element
from core.geometry.piece import Point


def is_inside(first: Element, second: Element, offset: float) -> bool:
    """Does the path turn towards the tool?  An exact reversal does not, whatever sign its half turn has."""
    (ax, ay), (bx, by) = first.arriving, second.leaving
    back = hypot(ax + bx, ay + by) <= corners.WHOLE
    return not back and corners.turning(first, second) * offset > 0.0


def ending(element: Element) -> Element:
    """The element as it is at its end: an arc's radius there may differ a little from that at its start."""
    return element._replace(start=element.end) if element.turn else element


def advance(element: Element, start: Point, end: Point) -> float:
    """Millimeters along an element from one point of its offset to another, negative backwards, at most half an arc."""
    if not element.turn:
        way = element.leaving
        return (end[0] - start[0]) * way[0] + (end[1] - start[1]) * way[1]
    angle = corners.sweep(start, end, element.center, element.turn)
    return (angle - tau if angle > pi else angle) * hypot(start[0] - element.center[0], start[1] - element.center[1])


def remaining(element: Element, begin: Point, end: Point, offset: float) -> float:
    """Millimeters left of an element's offset between the points its corners trim it to; negative if they cross."""
    if not element.turn:
        return advance(element, begin, end)
    whole = corners.element_sweep(element) * corners.offset_radius(element, offset)
    first, last = corners.square_start(element, offset), corners.square_end(element, offset)
    return whole - advance(element, first, begin) - advance(element, end, last)
