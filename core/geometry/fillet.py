"""The arc that blends two pieces at their common corner, tangent to both.

The center of an arc that runs the way both pieces run lies one radius to the same side of both: on the left
for an arc traveled counter-clockwise, on the right for a clockwise one.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from math import acos, atan2, cos, hypot, inf, sin, sqrt, tan, tau

from core.geometry.piece import SLIVER, Arc, Line, Piece, Point, Turn
from core.tolerance import JOINED, ON_PATH


@dataclass(frozen=True, slots=True)
class Fillet:
    """Two pieces shortened (None where nothing of one is left) and the arc between them."""

    before: Piece | None
    arc: Arc
    behind: Piece | None


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


def direction(piece: Piece, at: Point) -> Point:
    """Unit vector of travel at a point of a piece."""
    if isinstance(piece, Line):
        (x0, y0), (x1, y1) = piece.start, piece.end
        return (x1 - x0) / piece.length, (y1 - y0) / piece.length
    dx, dy = at[0] - piece.center[0], at[1] - piece.center[1]
    size = hypot(dx, dy)
    return -dy / size * piece.turn, dx / size * piece.turn


def fillet(before: Piece, behind: Piece, radius: float) -> Fillet | NoFillet:
    """The blend nearest to the corner where `before` ends and `behind` starts, which must have length.

    Nearest is the one that takes the least off both pieces together.
    """
    corner = behind.start
    (ax, ay), (bx, by) = direction(before, before.end), direction(behind, corner)
    turned = atan2(ax * by - ay * bx, ax * bx + ay * by)
    if abs(turned) * radius <= JOINED:
        return NoFillet(Reason.TANGENT)
    lines = isinstance(before, Line) and isinstance(behind, Line)
    if lines and abs(turned) > tau / 2 - SLIVER:
        return NoFillet(Reason.REVERSAL)
    ways = (Turn.CCW if turned > 0 else Turn.CW,) if lines else (Turn.CCW, Turn.CW)
    fits = [found for turn in ways for found in _touching(before, behind, radius, turn)]
    if fits:
        return _cut(before, behind, min(fits, key=lambda fit: fit.taken))
    largest = min(before.length, behind.length) / tan(abs(turned) / 2) if lines else None
    return NoFillet(Reason.TOO_LARGE, largest)


@dataclass(frozen=True, slots=True)
class _Fit:
    """A blend arc that touches within both pieces, and the length it takes off them together."""

    arc: Arc
    taken: float


def _touching(before: Piece, behind: Piece, radius: float, turn: Turn) -> list[_Fit]:
    fits = []
    for center in _meetings(_shifted(before, turn * radius), _shifted(behind, turn * radius)):
        first, last = _foot(before, center, turn * radius), _foot(behind, center, turn * radius)
        if first is None or last is None:
            continue
        kept, taken = _travel(before, first), _travel(behind, last)
        if kept < -ON_PATH or kept > before.length + ON_PATH or taken < -ON_PATH or taken > behind.length + ON_PATH:
            continue
        if hypot(first[0] - last[0], first[1] - last[1]) > JOINED:
            fits.append(_Fit(Arc(first, last, center, turn), before.length - kept + taken))
    return fits


@dataclass(frozen=True, slots=True)
class _Straight:
    """An endless line through a point in a unit direction."""

    point: Point
    along: Point


@dataclass(frozen=True, slots=True)
class _Round:
    """A whole circle."""

    center: Point
    radius: float


def _shifted(piece: Piece, left: float) -> _Straight | _Round:
    """The carrier of a piece moved by `left` to its left."""
    if isinstance(piece, Line):
        dx, dy = direction(piece, piece.start)
        return _Straight((piece.start[0] - dy * left, piece.start[1] + dx * left), (dx, dy))
    return _Round(piece.center, abs(piece.radius - piece.turn * left))


def _foot(piece: Piece, center: Point, left: float) -> Point | None:
    """Where a circle about `center`, `left` to the left of a piece's carrier, touches it; None about its own center."""
    if isinstance(piece, Line):
        dx, dy = direction(piece, piece.start)
        return center[0] + dy * left, center[1] - dx * left
    shifted = piece.radius - piece.turn * left
    if abs(shifted) <= JOINED:
        return None
    scale = piece.radius / shifted
    (ox, oy), (cx, cy) = piece.center, center
    return ox + (cx - ox) * scale, oy + (cy - oy) * scale


def _travel(piece: Piece, at: Point) -> float:
    """Length traveled from a piece's start to a point of its carrier; of an arc's two ways to it, the one on it."""
    if isinstance(piece, Line):
        dx, dy = direction(piece, piece.start)
        return (at[0] - piece.start[0]) * dx + (at[1] - piece.start[1]) * dy
    (cx, cy), (sx, sy) = piece.center, piece.start
    angle = piece.turn * (atan2(at[1] - cy, at[0] - cx) - atan2(sy - cy, sx - cx)) % tau
    return piece.radius * (angle - tau if angle > tau - JOINED / piece.radius else angle)


def _meetings(one: _Straight | _Round, other: _Straight | _Round) -> list[Point]:
    """Where two carriers meet: none, one or two points."""
    if isinstance(one, _Straight) and isinstance(other, _Straight):
        return _lines_meet(one, other)
    if isinstance(one, _Straight):
        assert isinstance(other, _Round)
        return _line_meets_circle(one, other)
    if isinstance(other, _Straight):
        return _line_meets_circle(other, one)
    return _circles_meet(one, other)


def _lines_meet(one: _Straight, other: _Straight) -> list[Point]:
    (ax, ay), (bx, by) = one.along, other.along
    cross = ax * by - ay * bx
    if abs(cross) < SLIVER:
        return []
    dx, dy = other.point[0] - one.point[0], other.point[1] - one.point[1]
    travel = (dx * by - dy * bx) / cross
    return [(one.point[0] + ax * travel, one.point[1] + ay * travel)]


def _line_meets_circle(line: _Straight, circle: _Round) -> list[Point]:
    (px, py), (dx, dy) = line.point, line.along
    ahead = (circle.center[0] - px) * dx + (circle.center[1] - py) * dy
    fx, fy = px + ahead * dx, py + ahead * dy
    beside = hypot(fx - circle.center[0], fy - circle.center[1])
    if beside > circle.radius:
        return []
    half = sqrt((circle.radius - beside) * (circle.radius + beside))
    return [(fx + dx * way, fy + dy * way) for way in (-half, half)]


def _circles_meet(one: _Round, other: _Round) -> list[Point]:
    dx, dy = other.center[0] - one.center[0], other.center[1] - one.center[1]
    apart = hypot(dx, dy)
    if apart <= JOINED or apart > one.radius + other.radius or apart < abs(one.radius - other.radius):
        return []
    ratio = (apart * apart + one.radius * one.radius - other.radius * other.radius) / (2 * apart * (one.radius or inf))
    angle, base = acos(max(-1.0, min(1.0, ratio))), atan2(dy, dx)
    ways = (base + angle, base - angle)
    return [(one.center[0] + one.radius * cos(way), one.center[1] + one.radius * sin(way)) for way in ways]


def _cut(before: Piece, behind: Piece, fit: _Fit) -> Fillet:
    first, last = fit.arc.start, fit.arc.end
    return Fillet(
        _between(before, before.start, first) if _travel(before, first) > JOINED else None,
        fit.arc,
        _between(behind, last, behind.end) if behind.length - _travel(behind, last) > JOINED else None,
    )


def _between(piece: Piece, start: Point, end: Point) -> Piece:
    return Line(start, end) if isinstance(piece, Line) else Arc(start, end, piece.center, piece.turn)
