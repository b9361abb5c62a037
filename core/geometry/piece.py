"""Pieces: single lines and arcs as plain numbers, as a person types them and a drawing dimensions them.

A point is a pair (x, y) in millimeters.  This module and `construct` do not need numpy, so that a form can
be solved and shown before numpy is loaded; whole paths are `core.geometry.path.Path`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from math import atan2, cos, hypot, sin, tau
from typing import Final

Point = tuple[float, float]


def point_of(place: complex) -> Point:
    """Return a complex number x + iy as a point."""
    return float(place.real), float(place.imag)


ANGLE_ROUNDING: Final = 1e-9
"""Radians by which rounding moves an angle: directions nearer than this are parallel, and an arc that is short of a
full turn by less is an empty one."""


class Turn(IntEnum):
    """The direction in which an arc is traveled; NONE is a line."""

    CW = -1
    NONE = 0
    CCW = 1


@dataclass(frozen=True, slots=True)
class Line:
    """A straight piece from `start` to `end`."""

    start: Point
    end: Point

    @property
    def length(self) -> float:
        """Length in millimeters."""
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])

    def point_at(self, part: float) -> Point:
        """Return the point after a part of the length, 0 to 1."""
        (x0, y0), (x1, y1) = self.start, self.end
        return x0 + part * (x1 - x0), y0 + part * (y1 - y0)

    def direction_at(self, _at: Point) -> Point:
        """Return the unit vector of travel, the same at any point; the line must have a length."""
        size = self.length
        return (self.end[0] - self.start[0]) / size, (self.end[1] - self.start[1]) / size

    def reversed(self) -> Line:
        """Return the line traveled the other way."""
        return Line(self.end, self.start)


@dataclass(frozen=True, slots=True)
class Arc:
    """A circular piece from `start` to `end` about `center`; equal ends mean the full circle."""

    start: Point
    end: Point
    center: Point
    turn: Turn

    @property
    def radius(self) -> float:
        """Distance of the start from the center in millimeters."""
        return hypot(self.start[0] - self.center[0], self.start[1] - self.center[1])

    @property
    def sweep(self) -> float:
        """Angle traveled in radians, positive counterclockwise, at most a full turn."""
        if self.start == self.end:
            return int(self.turn) * tau
        (x0, y0), (x1, y1), (cx, cy) = self.start, self.end, self.center
        first, last = atan2(y0 - cy, x0 - cx), atan2(y1 - cy, x1 - cx)
        swept = (int(self.turn) * (last - first)) % tau
        return int(self.turn) * (0.0 if swept > tau - ANGLE_ROUNDING else swept)

    @property
    def length(self) -> float:
        """Length in millimeters."""
        return self.radius * abs(self.sweep)

    def point_at(self, part: float) -> Point:
        """Return the point after a part of the length, 0 to 1."""
        (cx, cy), angle = self.center, part * self.sweep
        dx, dy = self.start[0] - cx, self.start[1] - cy
        return cx + dx * cos(angle) - dy * sin(angle), cy + dx * sin(angle) + dy * cos(angle)

    def direction_at(self, at: Point) -> Point:
        """Return the unit vector of travel at one of the arc's points."""
        dx, dy = at[0] - self.center[0], at[1] - self.center[1]
        size = hypot(dx, dy)
        return -dy / size * self.turn, dx / size * self.turn

    def reversed(self) -> Arc:
        """Return the arc traveled the other way."""
        return Arc(self.end, self.start, self.center, Turn(-self.turn))


Piece = Line | Arc


def signed_area(pieces: Iterable[Piece]) -> float:
    """Return the area inside a closed chain in square millimeters, positive if it is traveled counterclockwise.

    Green's formula: the polygon of the chords, plus for each arc the circular segment over its chord.
    """
    total, origin = 0.0, None
    for piece in pieces:
        (x0, y0), (x1, y1) = piece.start, piece.end
        ox, oy = origin = origin or piece.start
        total += ((x0 - ox) * (y1 - oy) - (x1 - ox) * (y0 - oy)) / 2.0
        if isinstance(piece, Arc):
            sweep = piece.sweep
            total += piece.radius**2 * (sweep - sin(sweep)) / 2.0
    return total


class Side(StrEnum):
    """LEFT or RIGHT of the contour, seen along the travel."""

    LEFT = "LEFT"
    RIGHT = "RIGHT"

    @property
    def sign(self) -> int:
        """+1 for LEFT: the left normal of a direction (dx, dy) is (-dy, dx)."""
        return 1 if self is Side.LEFT else -1
