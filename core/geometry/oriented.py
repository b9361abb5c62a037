"""Oriented lines and circles: every point where two of them meet or touch, in a fixed order.

A line of heading t has the left normal n = (-sin t, cos t) and the points X with n.X = p.  A circle has a center c and
a signed radius rho, positive counterclockwise; travel has heading t at its point c - rho n.  A point is a circle of rho
0.  One equation covers every smooth joint (CALCULATED_RUNS.md, section 1).  Millimeters and radians.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan2, cos, hypot, sin, sqrt, tau

from core.geometry.piece import ANGLE_ROUNDING, Point
from core.tolerance import ARC_RADII, GRAZE


@dataclass(frozen=True, slots=True)
class OrientedLine:
    """All points X with n.X = `offset`, traveled in direction `heading`."""

    heading: float
    offset: float

    @property
    def normal(self) -> Point:
        """The unit vector to the left."""
        return normal(self.heading)

    def shifted(self, dx: float, dy: float) -> OrientedLine:
        """Return the line moved by a vector."""
        nx, ny = self.normal
        return OrientedLine(self.heading, self.offset + nx * dx + ny * dy)


@dataclass(frozen=True, slots=True)
class Circle:
    """All points at `radius` (not negative) from `center`."""

    center: Point
    radius: float

    def shifted(self, dx: float, dy: float) -> Circle:
        """Return the circle moved by a vector."""
        return Circle((self.center[0] + dx, self.center[1] + dy), self.radius)


Locus = OrientedLine | Circle
"""Where a point may lie."""


@dataclass(frozen=True, slots=True)
class Meeting:
    """The points that two loci share: none, one or two; `grazing` if two have merged into one.

    `coincident`: both are the same.  Without points, `distance` (mm) is that between two parallel lines, from a line to
    a circle's center, or between two centers."""

    points: tuple[Point, ...] = ()
    grazing: bool = False
    coincident: bool = False
    distance: float = 0.0


def direction(heading: float) -> Point:
    """Return the unit vector of a heading."""
    return cos(heading), sin(heading)


def normal(heading: float) -> Point:
    """Return the unit vector to the left of a heading."""
    return -sin(heading), cos(heading)


def line_through(point: Point, heading: float) -> OrientedLine:
    """Return the line of a heading through a point."""
    nx, ny = normal(heading)
    return OrientedLine(heading, nx * point[0] + ny * point[1])


def meeting(first: Locus, second: Locus) -> Meeting:
    """Find the points that two loci share.

    The first point of a line and a circle comes first along the line; that of two circles is on the left, seen from the
    first center to the second."""
    if isinstance(first, OrientedLine):
        return _lines(first, second) if isinstance(second, OrientedLine) else _line_circle(first, second)
    return _line_circle(second, first) if isinstance(second, OrientedLine) else _circles(first, second)


def _lines(first: OrientedLine, second: OrientedLine) -> Meeting:
    (ax, ay), (bx, by) = first.normal, second.normal
    across = ax * by - ay * bx
    if abs(across) < ANGLE_ROUNDING:
        distance = abs(first.offset - (second.offset if ax * bx + ay * by > 0.0 else -second.offset))
        return Meeting(coincident=distance <= ARC_RADII, distance=distance)
    x = (first.offset * by - second.offset * ay) / across
    return Meeting(((x, (ax * second.offset - bx * first.offset) / across),))


def _line_circle(line: OrientedLine, circle: Circle) -> Meeting:
    (nx, ny), (tx, ty), (cx, cy) = line.normal, direction(line.heading), circle.center
    height = nx * cx + ny * cy - line.offset
    foot = (cx - height * nx, cy - height * ny)
    gap = abs(height) - circle.radius
    if gap > ARC_RADII:
        return Meeting(distance=abs(height))
    if gap >= -GRAZE:
        return Meeting((foot,), grazing=True)
    half = sqrt((circle.radius - height) * (circle.radius + height))
    return Meeting(((foot[0] - half * tx, foot[1] - half * ty), (foot[0] + half * tx, foot[1] + half * ty)))


def _circles(first: Circle, second: Circle) -> Meeting:
    (ax, ay), (bx, by), r, s = first.center, second.center, first.radius, second.radius
    between = hypot(bx - ax, by - ay)
    if between <= ARC_RADII:
        return Meeting(coincident=abs(r - s) <= ARC_RADII, distance=between)
    ux, uy = (bx - ax) / between, (by - ay) / between
    along = (between * between + r * r - s * s) / (2.0 * between)
    gap = max(between - r - s, abs(r - s) - between)
    if gap > ARC_RADII:
        return Meeting(distance=between)
    if gap >= -GRAZE:
        reach = r if along > 0.0 else -r
        return Meeting(((ax + reach * ux, ay + reach * uy),), grazing=True)
    half = sqrt(max(0.0, (r - along) * (r + along)))
    x, y = ax + along * ux, ay + along * uy
    return Meeting(((x - half * uy, y + half * ux), (x + half * uy, y - half * ux)))


def headings_at_distances(first: Point, r: float, second: Point, s: float) -> tuple[tuple[float, ...], bool]:
    """Find the headings of lines with n.first - p = r and n.second - p = s; the flag is True if two merged into one.

    n.(second - first) = s - r.  The first heading runs from the first point's foot to the second's, the second one
    the other way.  There is none if the points are closer together than the distances differ.
    """
    dx, dy = second[0] - first[0], second[1] - first[1]
    between, rise = hypot(dx, dy), s - r
    if between <= ANGLE_ROUNDING or abs(rise) - between > ARC_RADII:
        return (), False
    toward = atan2(dy, dx)
    # the normal of a heading t is t + a quarter turn: sin(toward - t) = rise / between
    tilt = tau / 4.0 - acos(max(-1.0, min(1.0, rise / between)))
    if between - abs(rise) <= GRAZE:
        return (toward - (tau / 4.0 if rise > 0.0 else -tau / 4.0),), True
    return (toward - tilt, toward - (tau / 2.0 - tilt)), False


def touch_point(first: Point, rho: float, second: Point, sigma: float) -> tuple[Point, float] | None:
    """Find where two circles traveled alike touch, and the heading there; None for one center or equal radii.

    c - rho n = c' - sigma n, so that n = (c - c') / (rho - sigma).
    """
    dx, dy = first[0] - second[0], first[1] - second[1]
    size = hypot(dx, dy)
    if size <= ARC_RADII or rho == sigma:
        return None
    side = 1.0 if rho > sigma else -1.0
    nx, ny = side * dx / size, side * dy / size
    return (first[0] - rho * nx, first[1] - rho * ny), atan2(-nx, ny)
