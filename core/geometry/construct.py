"""Constructions: points and centers from the dimensions of a drawing, every solution in a documented order.

Plain numbers, millimeters and radians, angles counterclockwise from +X.  `axis` 0 is X and 1 is Y.  No point, or None,
means that the dimensions do not fix it; `OutOfReach` that it is too far away.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin, sqrt
from typing import TYPE_CHECKING, TypeVar

from core.geometry.piece import ANGLE_ROUNDING, Arc, Point, Turn
from core.tolerance import ARC_RADII, CLOSED, GRAZE, JOINED, MIN_INDEPENDENT_SINE, ON_PATH

if TYPE_CHECKING:
    from core.geometry.path import Points

Place = TypeVar("Place", complex, "Points")
"""A point as a complex number, or (n,) points."""


@dataclass(frozen=True, slots=True)
class OutOfReach:
    """No solution: the length or radius would have to be at least `least`."""

    least: float


def polar(start: Point, angle: float, length: float) -> Point:
    """Return the point at `length` from `start` in direction `angle`."""
    return start[0] + length * cos(angle), start[1] + length * sin(angle)


def ray_to_coordinate(start: Point, angle: float, axis: int, value: float) -> tuple[Point, bool] | None:
    """Find where a line reaches the coordinate `value`, and whether that is ahead of the start in direction `angle`.

    None if that coordinate is constant along the line, or if only the rounding of the start and the angle makes it
    change.
    """
    along = (cos(angle), sin(angle))
    rounded = abs(along[axis]) < MIN_INDEPENDENT_SINE and abs(value - start[axis]) <= ARC_RADII
    if rounded or abs(along[axis]) < ANGLE_ROUNDING:
        return None
    travel = (value - start[axis]) / along[axis]
    return _point_with_coordinate(axis, value, start[1 - axis] + travel * along[1 - axis]), travel >= 0.0


def points_on_circle(center: Point, radius: float, axis: int, value: float) -> tuple[Point, ...] | OutOfReach:
    """Find the points of a circle whose coordinate `axis` is `value`, the one with the greater other coordinate first.

    A coordinate outside the circle by no more than `ARC_RADII`, or inside by no more than `GRAZE`, gives one point, at
    the circle's center in the other coordinate.
    """
    distance = abs(value - center[axis])
    if distance > radius + ARC_RADII:
        return OutOfReach(distance)
    middle = center[1 - axis]
    if radius - distance <= GRAZE:
        return (_point_with_coordinate(axis, value, middle),)
    half = sqrt((radius - distance) * (radius + distance))
    return _point_with_coordinate(axis, value, middle + half), _point_with_coordinate(axis, value, middle - half)


def _point_with_coordinate(axis: int, value: float, other: float) -> Point:
    return (value, other) if axis == 0 else (other, value)


def centers(start: Point, end: Point, radius: float, turn: Turn) -> tuple[Point, ...] | OutOfReach:
    """Find the centers of arcs from `start` to `end`: first of the arc under half a turn, then of the longer one.

    A radius too small by no more than `ARC_RADII`, or too large by no more than `GRAZE`, gives the half circle; equal
    ends give no center.
    """
    chord = hypot(end[0] - start[0], end[1] - start[1])
    if chord <= ON_PATH:
        return ()
    if chord / 2 > radius + ARC_RADII:
        return OutOfReach(chord / 2)
    if radius - chord / 2 <= GRAZE:
        return (_on_bisector_at_height(start, end, 0.0),)
    height = sqrt((radius - chord / 2) * (radius + chord / 2))
    return _on_bisector_at_height(start, end, turn * height), _on_bisector_at_height(start, end, -turn * height)


def _on_bisector_at_height(start: Point, end: Point, height: float) -> Point:
    """Return the point on the bisector of start and end, `height` to the left of the line from start to end."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    chord = hypot(dx, dy)
    return (start[0] + end[0]) / 2 - dy / chord * height, (start[1] + end[1]) / 2 + dx / chord * height


def center_by_sweep(start: Point, end: Point, sweep: float, turn: Turn) -> Point | None:
    """Find the center of the arc from `start` to `end` that turns by `sweep` (0 < sweep < a full turn) toward `turn`.

    Height of the center over the chord c: c / 2 / tan(sweep / 2).
    """
    chord = hypot(end[0] - start[0], end[1] - start[1])
    half = sin(sweep / 2)
    if chord <= ON_PATH or abs(half) < ANGLE_ROUNDING:
        return None
    return _on_bisector_at_height(start, end, turn * chord / 2 * cos(sweep / 2) / half)


def center_by_coordinate(start: Point, end: Point, axis: int, value: float) -> Point | None:
    """Find the point equally far from `start` and `end` whose coordinate `axis` is `value`.

    Not if the chord runs along that axis: rounding of the ends would then decide where the point is.
    """
    across, along = end[1 - axis] - start[1 - axis], end[axis] - start[axis]
    if abs(across) <= max(CLOSED, MIN_INDEPENDENT_SINE * abs(along)):
        return None
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    return _point_with_coordinate(axis, value, middle[1 - axis] - (value - middle[axis]) * along / across)


def rotated(point: Point, center: Point, angle: float) -> Point:
    """Return a point turned about `center` by `angle`, positive counterclockwise."""
    dx, dy = point[0] - center[0], point[1] - center[1]
    return center[0] + dx * cos(angle) - dy * sin(angle), center[1] + dx * sin(angle) + dy * cos(angle)


def on_bisector(start: Place, end: Place, center: Place) -> Place:
    """Return the point nearest to `center` that is equally far from `start` and `end`; complex, single or (n,) each."""
    chord = end - start
    from_middle: Place = center - (start + end) / 2.0
    return center - (chord.conjugate() * from_middle).real * chord / abs(chord) ** 2


def exact_arc(start: Point, end: Point, center: Point, turn: Turn) -> Arc:
    """Return an exact arc close to ends and a center whose radii agree within `ARC_RADII`.

    Ends that are one point make a full circle.  Otherwise the center moves onto the bisector of the ends; if
    that is farther than `ARC_RADII`, as on a chord much shorter than the radius, the end moves onto the circle.
    """
    radius = hypot(start[0] - center[0], start[1] - center[1])
    end_radius = hypot(end[0] - center[0], end[1] - center[1])
    chord = hypot(end[0] - start[0], end[1] - start[1])
    if chord <= JOINED:
        return Arc(start, start, center, turn)
    if abs(end_radius - radius) <= ON_PATH:
        return Arc(start, end, center, turn)
    moved = on_bisector(complex(*start), complex(*end), complex(*center))
    if abs(moved - complex(*center)) <= ARC_RADII:
        return Arc(start, end, (moved.real, moved.imag), turn)
    scale = radius / end_radius if end_radius else 0.0
    end_on_circle = (center[0] + (end[0] - center[0]) * scale, center[1] + (end[1] - center[1]) * scale)
    # rounding must not decide between a full circle and an empty arc
    same = hypot(end_on_circle[0] - start[0], end_on_circle[1] - start[1]) <= JOINED
    return Arc(start, start if same else end_on_circle, center, turn)


def chord_factor(sweep: float) -> float:
    """Return the chord of an arc of radius 1 that turns by `sweep`: 2 sin(sweep / 2)."""
    return 2.0 * sin(sweep / 2)
