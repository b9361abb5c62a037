"""The line that cuts off the corner of two pieces, the same length from both.

The length is measured along a line, and of an arc along its tangent at the corner: as on a drawing, square to the
other edge of a dimension.
"""

from __future__ import annotations

from cmath import phase
from dataclasses import dataclass, replace
from enum import Enum, auto
from math import asin, cos, pi, sin

from core.geometry.piece import Arc, Line, Piece, Point
from core.tolerance import JOINED


@dataclass(frozen=True, slots=True)
class Chamfer:
    """Two pieces shortened (None where nothing of one is left) and the line between them."""

    before: Piece | None
    line: Line
    after: Piece | None


class ChamferReason(Enum):
    """Why a corner cannot be cut off."""

    TANGENT = auto()
    """The pieces already run smoothly into each other."""
    REVERSAL = auto()
    """The second goes straight back."""
    TOO_LARGE = auto()
    """The length is not there on one of them."""


@dataclass(frozen=True, slots=True)
class NoChamfer:
    """No chamfer; `largest` is the largest length that fits, 0 where none does."""

    reason: ChamferReason
    largest: float = 0.0


def chamfer(before: Piece, after: Piece, length: float) -> Chamfer | NoChamfer:
    """The corner where `before` ends and `after` starts, which must have length, cut off by `length` (mm) on both."""
    arriving, leaving = complex(*before.direction_at(before.end)), complex(*after.direction_at(after.start))
    turned = abs(phase(leaving * arriving.conjugate()))
    if turned * length <= JOINED:
        return NoChamfer(ChamferReason.TANGENT)
    largest = min(_reach(before), _reach(after))
    if length > largest + JOINED:
        return NoChamfer(ChamferReason.TOO_LARGE, largest)
    first, last = _back(before, length, at_end=True), _back(after, length, at_end=False)
    if abs(complex(*first) - complex(*last)) <= JOINED:
        return NoChamfer(ChamferReason.REVERSAL)
    return Chamfer(
        replace(before, end=first) if abs(complex(*first) - complex(*before.start)) > JOINED else None,
        Line(first, last),
        replace(after, start=last) if abs(complex(*last) - complex(*after.end)) > JOINED else None,
    )


def _reach(piece: Piece) -> float:
    """The largest length along the tangent at the corner that a piece has: of an arc at most its radius."""
    if isinstance(piece, Line):
        return piece.length
    return piece.radius * sin(min(abs(piece.sweep), pi / 2))


def _back(piece: Piece, length: float, *, at_end: bool) -> Point:
    """The point of a piece at this length along its tangent at its end, or at its start."""
    if isinstance(piece, Line):
        part = min(length / piece.length, 1.0)
        return piece.point_at(1.0 - part if at_end else part)
    angle = asin(min(length / piece.radius, 1.0))
    if angle >= abs(piece.sweep):
        return piece.start if at_end else piece.end
    return _turned(piece, piece.end if at_end else piece.start, -angle if at_end else angle)


def _turned(arc: Arc, point: Point, angle: float) -> Point:
    """A point of an arc moved on by an angle, in the direction of its travel."""
    turn, (cx, cy) = int(arc.turn) * angle, arc.center
    dx, dy = point[0] - cx, point[1] - cy
    return cx + dx * cos(turn) - dy * sin(turn), cy + dx * sin(turn) + dy * cos(turn)
