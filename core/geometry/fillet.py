"""The arc that blends two pieces at their common corner, tangent to both.

The center of an arc that runs the way both pieces run lies one radius to the same side of both: on the left
for an arc traveled counterclockwise, on the right for a clockwise one.
"""

from __future__ import annotations

from cmath import phase, rect
from dataclasses import dataclass, replace
from enum import Enum, auto
from math import acos, inf, sqrt, tan, tau
from typing import NamedTuple

from core.geometry.piece import SLIVER, Arc, Line, Piece, Point, Turn
from core.tolerance import JOINED, ON_PATH


@dataclass(frozen=True, slots=True)
class Fillet:
    """Two pieces shortened (None where nothing of one is left) and the arc between them."""

    before: Piece | None
    arc: Arc
    after: Piece | None


class Reason(Enum):
    """Why two pieces cannot be blended."""

    TANGENT = auto()
    """They already run smoothly into each other."""
    REVERSAL = auto()
    """The second goes straight back."""
    TOO_LARGE = auto()
    """The radius does not fit between them."""


@dataclass(frozen=True, slots=True)
class NoFillet:
    """No blend; `largest` is the largest radius that fits, None where that takes more than a formula."""

    reason: Reason
    largest: float | None = None


def fillet(before: Piece, after: Piece, radius: float) -> Fillet | NoFillet:
    """The blend nearest to the corner where `before` ends and `after` starts, which must have length.

    Nearest is the one that takes the least off both pieces together.
    """
    arriving, leaving = complex(*before.direction_at(before.end)), complex(*after.direction_at(after.start))
    turned = phase(leaving * arriving.conjugate())
    if abs(turned) * radius <= JOINED:
        return NoFillet(Reason.TANGENT)
    lines = isinstance(before, Line) and isinstance(after, Line)
    if lines and abs(turned) > tau / 2 - SLIVER:
        return NoFillet(Reason.REVERSAL)
    turns = (Turn.CCW if turned > 0 else Turn.CW,) if lines else (Turn.CCW, Turn.CW)
    fits = [fit for turn in turns for fit in _touching(before, after, radius, turn)]
    if fits:
        return _cut(before, after, min(fits, key=lambda fit: fit.removed).arc)
    largest = min(before.length, after.length) / tan(abs(turned) / 2) if lines else None
    return NoFillet(Reason.TOO_LARGE, largest)


class _Fit(NamedTuple):
    """A blend arc that touches within both pieces, and the length it takes off them together."""

    arc: Arc
    removed: float


def _touching(before: Piece, after: Piece, radius: float, turn: Turn) -> list[_Fit]:
    fits, left = [], turn * radius
    for center in meeting_places(_shifted(before, left), _shifted(after, left)):
        first, last = _foot(before, center, left), _foot(after, center, left)
        if first is None or last is None or abs(first - last) <= JOINED:
            continue
        kept, removed = _travel(before, first), _travel(after, last)
        if -ON_PATH <= kept <= before.length + ON_PATH and -ON_PATH <= removed <= after.length + ON_PATH:
            arc = Arc(_point(first), _point(last), _point(center), turn)
            fits.append(_Fit(arc, before.length - kept + removed))
    return fits


class Carrier(NamedTuple):
    """A point of an endless line and its direction, or the center of a whole circle, direction 0, and its radius."""

    at: complex
    along: complex
    radius: float


def _shifted(piece: Piece, left: float) -> Carrier:
    """The carrier of a piece moved by `left` to its left."""
    if isinstance(piece, Arc):
        return Carrier(complex(*piece.center), 0j, abs(piece.radius - piece.turn * left))
    along = complex(*piece.direction_at(piece.start))
    return Carrier(complex(*piece.start) + 1j * along * left, along, 0.0)


def _foot(piece: Piece, center: complex, left: float) -> complex | None:
    """Where a circle about `center`, `left` to the left of a piece's carrier, touches it; None about its own center."""
    if isinstance(piece, Line):
        return center - 1j * complex(*piece.direction_at(piece.start)) * left
    shifted, middle = piece.radius - piece.turn * left, complex(*piece.center)
    return None if abs(shifted) <= JOINED else middle + (center - middle) * (piece.radius / shifted)


def _travel(piece: Piece, at: complex) -> float:
    """Length traveled from a piece's start to a point of its carrier; of an arc's two ways to it, the one on it."""
    start = complex(*piece.start)
    if isinstance(piece, Line):
        return ((at - start) * complex(*piece.direction_at(piece.start)).conjugate()).real
    center = complex(*piece.center)
    angle = piece.turn * phase((at - center) * (start - center).conjugate()) % tau
    return piece.radius * (angle - tau if angle > tau - JOINED / piece.radius else angle)


def meeting_places(first: Carrier, second: Carrier) -> list[complex]:
    """Where two carriers meet: none, one or two points."""
    if first.along and second.along:
        cross = (first.along.conjugate() * second.along).imag
        reach = ((second.at - first.at).conjugate() * second.along).imag
        return [] if abs(cross) < SLIVER else [first.at + first.along * reach / cross]
    if second.along:
        return _line_meets_circle(second, first)
    return _line_meets_circle(first, second) if first.along else _circles_meet(first, second)


def carriers_meet(first: Piece, second: Piece) -> list[Point]:
    """The meetings of the endless lines or whole circles of two pieces."""
    return [_point(place) for place in meeting_places(_shifted(first, 0.0), _shifted(second, 0.0))]


def _line_meets_circle(line: Carrier, circle: Carrier) -> list[complex]:
    seen = (circle.at - line.at) * line.along.conjugate()
    height = abs(seen.imag)
    if height > circle.radius:
        return []
    half = sqrt((circle.radius - height) * (circle.radius + height))
    return [line.at + line.along * (seen.real + way) for way in (-half, half)]


def _circles_meet(first: Carrier, second: Carrier) -> list[complex]:
    apart = abs(second.at - first.at)
    if apart <= JOINED or apart > first.radius + second.radius or apart < abs(first.radius - second.radius):
        return []
    ratio = (apart * apart + first.radius * first.radius - second.radius * second.radius) / (
        2 * apart * (first.radius or inf)
    )
    base, angle = phase(second.at - first.at), acos(max(-1.0, min(1.0, ratio)))
    return [first.at + rect(first.radius, base + way) for way in (angle, -angle)]


def _cut(before: Piece, after: Piece, arc: Arc) -> Fillet:
    kept, removed = _travel(before, complex(*arc.start)), _travel(after, complex(*arc.end))
    return Fillet(
        replace(before, end=arc.start) if kept > JOINED else None,
        arc,
        replace(after, start=arc.end) if after.length - removed > JOINED else None,
    )


def _point(place: complex) -> Point:
    return place.real, place.imag
