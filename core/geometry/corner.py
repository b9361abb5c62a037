"""Corners: `fillet` rounds the corner of two pieces with an arc tangent to both, `chamfer` cuts it off with a line.

The fillet's center lies one radius to the same side of both pieces, seen along their travel: on the left
for an arc traveled counterclockwise, on the right for a clockwise one.  A chamfer takes the same length off both
pieces, measured along a line or along an arc's tangent at the corner, as a drawing dimensions it square
to the other edge.
"""

from __future__ import annotations

from cmath import phase
from dataclasses import dataclass, replace
from enum import Enum, auto
from math import asin, pi, sin, tan, tau
from typing import Final

from core.geometry.carrier import carrier, meeting_points
from core.geometry.construct import rotated
from core.geometry.piece import ANGLE_ROUNDING, Arc, Line, Piece, Point, Turn, point_of
from core.tolerance import JOINED, ON_PATH

TRIED_RADII: Final = 32
"""Radii, evenly spaced below one that does not fit, that are tried before the search for the largest that fits."""
HALVINGS: Final = 48
"""Bisections between a radius that fits and one that does not."""


@dataclass(frozen=True, slots=True)
class Corner:
    """Two shortened pieces (None if nothing is left of one) and the arc or line between them."""

    before: Piece | None
    between: Piece
    after: Piece | None


class Reason(Enum):
    """The reason why a corner takes neither fillet nor chamfer."""

    TANGENT = auto()
    """The pieces already run smoothly into each other."""
    REVERSAL = auto()
    """The second piece goes straight back along the first."""
    TOO_LARGE = auto()
    """The radius or the length does not fit between the pieces."""


@dataclass(frozen=True, slots=True)
class NoCorner:
    """No fillet or chamfer is possible; `largest` is the largest size that fits, None if none was found."""

    reason: Reason
    largest: float | None = None


def fillet(before: Piece, after: Piece, radius: float) -> Corner | NoCorner:
    """Round the corner where `before` ends and `after` starts (both with a length) with an arc of `radius` mm.

    Of several arcs that fit, take the one that removes the least length from both pieces together.
    """
    turn_angle = _turn_angle(before, after)
    if abs(turn_angle) * radius <= JOINED:
        return NoCorner(Reason.TANGENT)
    lines = isinstance(before, Line) and isinstance(after, Line)
    if lines and abs(turn_angle) > tau / 2 - ANGLE_ROUNDING:
        return NoCorner(Reason.REVERSAL)
    turns = (Turn.CCW if turn_angle > 0 else Turn.CW,) if lines else (Turn.CCW, Turn.CW)
    fits = [fit for turn in turns for fit in _rounded_corners(before, after, radius, turn)]
    if fits:
        return min(fits, key=lambda fit: fit[0])[1]
    if lines:
        return NoCorner(Reason.TOO_LARGE, min(before.length, after.length) / tan(abs(turn_angle) / 2))
    return NoCorner(Reason.TOO_LARGE, _largest_radius(before, after, radius))


def _largest_radius(before: Piece, after: Piece, too_large: float) -> float | None:
    """Return the largest radius below `too_large` at which an arc touches both pieces, None if none was found.

    Between two arcs a radius may fit, a smaller one fail and a still smaller one fit again: several are tried first.
    """

    def fits(radius: float) -> bool:
        return any(_rounded_corners(before, after, radius, turn) for turn in (Turn.CCW, Turn.CW))

    fitting = 0.0
    for tried in (too_large * share / TRIED_RADII for share in range(TRIED_RADII - 1, 0, -1)):
        if fits(tried):
            fitting = tried
            break
        too_large = tried
    for _ in range(HALVINGS):
        middle = (fitting + too_large) / 2.0
        fitting, too_large = (middle, too_large) if fits(middle) else (fitting, middle)
    return fitting if fitting > JOINED else None


def _rounded_corners(before: Piece, after: Piece, radius: float, turn: Turn) -> list[tuple[float, Corner]]:
    """Return the corners whose arc touches both pieces between their ends, each after the length that it removes."""
    fits, left = [], turn * radius
    for center in meeting_points(carrier(before, left), carrier(after, left)):
        first, last = _touch_point(before, center, left), _touch_point(after, center, left)
        if first is None or last is None or abs(first - last) <= JOINED:
            continue
        kept, removed = _travel(before, first), _travel(after, last)
        if -ON_PATH <= kept <= before.length + ON_PATH and -ON_PATH <= removed <= after.length + ON_PATH:
            arc = Arc(point_of(first), point_of(last), point_of(center), turn)
            shortened = replace(before, end=arc.start) if kept > JOINED else None
            rest = replace(after, start=arc.end) if after.length - removed > JOINED else None
            fits.append((before.length - kept + removed, Corner(shortened, arc, rest)))
    return fits


def _touch_point(piece: Piece, center: complex, left: float) -> complex | None:
    """Return where a circle about `center`, `left` to the left of a carrier, touches it; None about its own center."""
    if isinstance(piece, Line):
        return center - 1j * complex(*piece.direction_at(piece.start)) * left
    shifted, middle = piece.radius - piece.turn * left, complex(*piece.center)
    return None if abs(shifted) <= JOINED else middle + (center - middle) * (piece.radius / shifted)


def _travel(piece: Piece, at: complex) -> float:
    """Return the length traveled from a piece's start to a point of its carrier, in an arc's own direction."""
    start = complex(*piece.start)
    if isinstance(piece, Line):
        return ((at - start) * complex(*piece.direction_at(piece.start)).conjugate()).real
    center = complex(*piece.center)
    angle = piece.turn * phase((at - center) * (start - center).conjugate()) % tau
    return piece.radius * (angle - tau if angle > tau - JOINED / piece.radius else angle)


def chamfer(before: Piece, after: Piece, length: float) -> Corner | NoCorner:
    """Cut off the corner where `before` ends and `after` starts (both with a length) by `length` mm on both pieces."""
    if abs(_turn_angle(before, after)) * length <= JOINED:
        return NoCorner(Reason.TANGENT)
    largest = min(_largest_setback(before), _largest_setback(after))
    if length > largest + JOINED:
        return NoCorner(Reason.TOO_LARGE, largest)
    first, last = _setback_point(before, length, at_end=True), _setback_point(after, length, at_end=False)
    if abs(complex(*first) - complex(*last)) <= JOINED:
        return NoCorner(Reason.REVERSAL)
    return Corner(
        replace(before, end=first) if abs(complex(*first) - complex(*before.start)) > JOINED else None,
        Line(first, last),
        replace(after, start=last) if abs(complex(*last) - complex(*after.end)) > JOINED else None,
    )


def _turn_angle(before: Piece, after: Piece) -> float:
    """Return the angle from the direction at the end of `before` to that at the start of `after`, left positive."""
    arriving, leaving = complex(*before.direction_at(before.end)), complex(*after.direction_at(after.start))
    return phase(leaving * arriving.conjugate())


def _largest_setback(piece: Piece) -> float:
    """Return the largest length along the tangent at the corner that fits a piece: for an arc at most its radius."""
    if isinstance(piece, Line):
        return piece.length
    return piece.radius * sin(min(abs(piece.sweep), pi / 2))


def _setback_point(piece: Piece, length: float, *, at_end: bool) -> Point:
    """Return the point of a piece that is `length` away along the tangent at its end, or at its start."""
    if isinstance(piece, Line):
        part = min(length / piece.length, 1.0)
        return piece.point_at(1.0 - part if at_end else part)
    angle = asin(min(length / piece.radius, 1.0))
    if angle >= abs(piece.sweep):
        return piece.start if at_end else piece.end
    return rotated(piece.end if at_end else piece.start, piece.center, piece.turn * (-angle if at_end else angle))
