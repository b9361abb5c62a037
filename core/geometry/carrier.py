"""Carriers: the endless line or the whole circle that a piece lies on, and the points where two of them meet."""

from __future__ import annotations

from cmath import phase, rect
from math import acos, inf, sqrt
from typing import NamedTuple

from core.geometry.piece import ANGLE_ROUNDING, Arc, Piece, Point
from core.tolerance import JOINED


class Carrier(NamedTuple):
    """An endless line: a point, its direction, radius 0.  A whole circle: its center, direction 0, its radius."""

    at: complex
    along: complex
    radius: float


def carrier(piece: Piece, left: float = 0.0) -> Carrier:
    """Return the carrier of a piece, offset by `left` to its left."""
    if isinstance(piece, Arc):
        return Carrier(complex(*piece.center), 0j, abs(piece.radius - piece.turn * left))
    along = complex(*piece.direction_at(piece.start))
    return Carrier(complex(*piece.start) + 1j * along * left, along, 0.0)


def meeting_points(first: Carrier, second: Carrier) -> list[complex]:
    """Return the points where two carriers meet: none, one or two."""
    if first.along and second.along:
        cross = (first.along.conjugate() * second.along).imag
        across = ((second.at - first.at).conjugate() * second.along).imag
        return [] if abs(cross) < ANGLE_ROUNDING else [first.at + first.along * across / cross]
    if second.along:
        return _line_meets_circle(second, first)
    return _line_meets_circle(first, second) if first.along else _circles_meet(first, second)


def carriers_meet(first: Piece, second: Piece) -> list[Point]:
    """Return the points where the endless lines or whole circles of two pieces meet."""
    return [(place.real, place.imag) for place in meeting_points(carrier(first), carrier(second))]


def _line_meets_circle(line: Carrier, circle: Carrier) -> list[complex]:
    center_from_line = (circle.at - line.at) * line.along.conjugate()
    height = abs(center_from_line.imag)
    if height > circle.radius:
        return []
    half = sqrt((circle.radius - height) * (circle.radius + height))
    return [line.at + line.along * (center_from_line.real + signed_half) for signed_half in (-half, half)]


def _circles_meet(first: Carrier, second: Carrier) -> list[complex]:
    distance = abs(second.at - first.at)
    if distance <= JOINED or distance > first.radius + second.radius or distance < abs(first.radius - second.radius):
        return []
    ratio = (distance * distance + first.radius * first.radius - second.radius * second.radius) / (
        2 * distance * (first.radius or inf)
    )
    base, angle = phase(second.at - first.at), acos(max(-1.0, min(1.0, ratio)))
    return [first.at + rect(first.radius, base + swing) for swing in (angle, -angle)]
