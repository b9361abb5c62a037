"""A transform turns, scales and mirrors what a program describes, before the tool radius is added."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos, radians
from typing import Final

from core.controls.moves import Plane, Point3, flat, solid
from core.geometry.piece import Point

UNSCALED: Final = (1.0, 1.0, 1.0)
"""The factors of the axes without scaling."""

_HERE: Final = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Transform:
    """Converts programmed points to work coordinates: rotation, then scaling, then the mirror image.

    So the center of a rotation is scaled and mirrored too, and one mirrored axis reverses its direction.  `mirror` has
    the mirror's coordinate by axis; `factors` of one size scale about `fixed`, and mirror there if they are negative;
    `angle` rotates about `center` in `plane`, degrees counterclockwise.
    """

    mirror: Mapping[int, float] = field(default_factory=dict)
    factors: Point3 = UNSCALED
    fixed: Point3 = _HERE
    angle: float = 0.0
    center: Point = (0.0, 0.0)
    plane: Plane = Plane.XY

    def __bool__(self) -> bool:
        return bool(self.mirror) or self.factors != UNSCALED or self.angle != 0.0

    def applied(self, point: Point3) -> Point3:
        """Return a programmed point in work coordinates."""
        if not self:
            return point
        scaled = [
            fixed + (value - fixed) * factor
            for value, fixed, factor in zip(self._turned(point, self.angle), self.fixed, self.factors, strict=True)
        ]
        return self._mirrored(scaled)

    def undone(self, point: Point3) -> Point3:
        """Return the programmed point of a point in work coordinates: the inverse of `applied`."""
        if not self:
            return point
        x, y, z = (
            fixed + (value - fixed) / factor
            for value, fixed, factor in zip(self._mirrored(point), self.fixed, self.factors, strict=True)
        )
        return self._turned((x, y, z), -self.angle)

    def _mirrored(self, point: Sequence[float]) -> Point3:
        x, y, z = (2 * self.mirror[axis] - value if axis in self.mirror else value for axis, value in enumerate(point))
        return x, y, z

    def _turned(self, point: Point3, angle: float) -> Point3:
        if not angle:
            return point
        (cx, cy), (first, second, third) = self.center, flat(point, self.plane)
        x, y = rotated((first - cx, second - cy), angle)
        return solid(cx + x, cy + y, third, self.plane)

    def vector(self, vector: Point3) -> Point3:
        """Return a programmed vector in work coordinates."""
        about_zero = Transform(dict.fromkeys(self.mirror, 0.0), self.factors, angle=self.angle, plane=self.plane)
        return about_zero.applied(vector)

    def flips(self, plane: Plane) -> bool:
        """True if clockwise becomes counterclockwise in a plane."""
        return sum((axis in self.mirror) != (self.factors[axis] < 0.0) for axis in plane.axes[:2]) == 1


def rotated(vector: Point, angle: float) -> Point:
    """Return a vector turned counterclockwise by an angle in degrees; multiples of 90 degrees are exact."""
    quarter = angle / 90.0
    if quarter.is_integer():
        c, s = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarter) % 4]
    else:
        c, s = cos(radians(angle)), cos(radians(angle - 90.0))
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]
