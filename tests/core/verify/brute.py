"""A slow judge: exact distances between all pieces of both paths by plain formulas, and what dense points show.

It shares nothing with the code under test.  Arcs are held by their center, radius, middle direction and half angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import atan2, cos, hypot, inf, sin, sqrt

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point
from tests.core.verify import oracle


def point_to(piece: Piece, x: float, y: float) -> float:
    """Distance of a point from a piece."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    ends = min(hypot(x - x0, y - y0), hypot(x - x1, y - y1))
    if isinstance(piece, Line):
        size = hypot(x1 - x0, y1 - y0)
        share = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / size**2 if size else 0.0
        return abs((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) / size if 0.0 < share < 1.0 else ends
    cx, cy = piece.center
    return abs(hypot(x - cx, y - cy) - hypot(x0 - cx, y0 - cy)) if _on(piece, x - cx, y - cy) else ends


def _on(arc: Arc, x: float, y: float) -> bool:
    """Whether a direction from the center meets the arc."""
    half = oracle.swept(arc) / 2.0
    middle = atan2(arc.start[1] - arc.center[1], arc.start[0] - arc.center[0]) + int(arc.turn) * half
    return abs(atan2(x * sin(middle) - y * cos(middle), x * cos(middle) + y * sin(middle))) <= half + 1e-12


def apart(one: Piece, other: Piece) -> float:
    """Least distance of two pieces."""
    found = [point_to(other, *end) for end in (one.start, one.end)] + [
        point_to(one, *end) for end in (other.start, other.end)
    ]
    found += [point_to(other, *spot) for spot in _spots(one, other)]
    found += [point_to(one, *spot) for spot in _spots(other, one)]
    return min(found)


def _spots(one: Piece, other: Piece) -> list[Point]:
    """Points of `one`, apart from its ends, that may be nearest to `other`: crossings, feet and antifeet."""
    spots = []
    if isinstance(one, Line):
        (x0, y0), (x1, y1) = one.start, one.end
        size2 = (x1 - x0) ** 2 + (y1 - y0) ** 2
        shares = []
        if isinstance(other, Arc):
            cx, cy = other.center
            foot = ((cx - x0) * (x1 - x0) + (cy - y0) * (y1 - y0)) / size2
            height = abs((cx - x0) * (y1 - y0) - (cy - y0) * (x1 - x0)) / sqrt(size2)
            radius = hypot(other.start[0] - cx, other.start[1] - cy)
            shares.append(foot)
            if height < radius:
                step = sqrt((radius - height) * (radius + height) / size2)
                shares += [foot - step, foot + step]
        else:
            vx, vy = other.end[0] - other.start[0], other.end[1] - other.start[1]
            turn = (x1 - x0) * vy - (y1 - y0) * vx
            if turn:
                shares.append(((other.start[0] - x0) * vy - (other.start[1] - y0) * vx) / turn)
        return [(x0 + t * (x1 - x0), y0 + t * (y1 - y0)) for t in shares if 0.0 <= t <= 1.0]
    cx, cy = one.center
    radius = hypot(one.start[0] - cx, one.start[1] - cy)
    for x, y in _directions(other, cx, cy, radius):
        size = hypot(x, y)
        if size and _on(one, x, y):
            spots.append((cx + radius * x / size, cy + radius * y / size))
    return spots


def _directions(other: Piece, cx: float, cy: float, radius: float) -> list[Point]:
    """Directions from a circle's center in which it may be nearest to another piece or meet it."""
    if isinstance(other, Line):
        vx, vy = other.end[0] - other.start[0], other.end[1] - other.start[1]
        off = ((other.start[0] - cx) * -vy + (other.start[1] - cy) * vx) / hypot(vx, vy)
        ways = [(-vy, vx), (vy, -vx)]
        if abs(off) < radius:
            along = sqrt((radius - abs(off)) * (radius + abs(off)))
            size = hypot(vx, vy)
            ways += [((-vy * off + s * vx * along) / size, (vx * off + s * vy * along) / size) for s in (-1.0, 1.0)]
        return ways
    dx, dy = other.center[0] - cx, other.center[1] - cy
    ways, size = [(dx, dy), (-dx, -dy)], hypot(dx, dy)
    theirs = hypot(other.start[0] - other.center[0], other.start[1] - other.center[1])
    if size and abs(radius - theirs) < size < radius + theirs:
        share = (size * size + radius * radius - theirs * theirs) / (2.0 * size)
        rise = sqrt(max(radius * radius - share * share, 0.0))
        ways += [((share * dx - s * rise * dy) / size, (share * dy + s * rise * dx) / size) for s in (-1.0, 1.0)]
    return ways


@dataclass(frozen=True)
class Slow:
    """Least distance of both paths; on dense points the length of path too near, and of surface left by more than
    `left`; the largest distance of the surface from the path."""

    clearance: float
    gouging: float
    left: float
    farthest: float
    step: float


def slow(surface: Path, radius: float, center: Path, stock: float) -> Slow:
    """The slow judge's findings; lengths are right to a few `step`s for each stretch."""
    clearance = min((apart(a, b) for a, b in product(center, surface)), default=inf)
    step = float(max(surface.lengths.sum(), center.lengths.sum())) / 600.0
    points, weights = oracle.samples(center, step)
    gouging = float(weights[oracle.apart(points, surface) < radius - 1e-6].sum())
    points, weights = oracle.samples(surface, step)
    left = float(weights[oracle.apart(points, center) > radius + stock].sum())
    return Slow(clearance, gouging, left, oracle.extreme(surface, center, step, 1.0), step)
