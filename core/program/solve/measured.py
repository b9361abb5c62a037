"""This module measures a line or an arc: the value that each field of its form would have."""

from __future__ import annotations

from math import atan2, degrees, tau
from typing import Final

from core.geometry.piece import ANGLE_ROUNDING, Line, Piece, Point
from core.units import Unit, from_mm

ANGLE_FIELDS: Final = ("angle", "start_angle", "sweep")
"""The names of the fields in radians."""


def heading_at(piece: Piece, at: Point) -> float:
    """Return the direction of travel at a point of a piece in radians, from -pi to pi; 0 for a line without length."""
    if isinstance(piece, Line):
        return atan2(piece.end[1] - piece.start[1], piece.end[0] - piece.start[0])
    x, y = piece.direction_at(at)
    return atan2(y, x)


def measured(piece: Piece) -> dict[str, float]:
    """Return the values of a piece by field name, in millimeters and radians; names of relative ones end in `_inc`."""
    (x, y), (x_end, y_end) = piece.start, piece.end
    values = {"x_end": x_end, "y_end": y_end, "x_end_inc": x_end - x, "y_end_inc": y_end - y}
    heading = heading_at(piece, piece.start) % tau
    if tau - heading < ANGLE_ROUNDING:
        heading = 0.0
    if isinstance(piece, Line):
        return values | {"length": piece.length, "angle": heading}
    cx, cy = piece.center
    values |= {"x_center": cx, "y_center": cy, "x_center_inc": cx - x, "y_center_inc": cy - y}
    return values | {"radius": piece.radius, "sweep": abs(piece.sweep), "start_angle": heading}


def measured_fields(piece: Piece, unit: Unit) -> dict[str, float]:
    """Return the absolute values of a piece by field name, in program units and degrees."""
    return {
        name: degrees(value) if name in ANGLE_FIELDS else from_mm(value, unit)
        for name, value in measured(piece).items()
        if not name.endswith("_inc")
    }
