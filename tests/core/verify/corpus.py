"""Correct center paths to spoil: outlines of lines and arcs, compensated, and kept when dense points find no fault."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import hypot, inf, tan, tau
from random import Random

import numpy as np
from shapely import LinearRing

from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.tolerance import CLOSED, GOUGE
from tests.core.verify import oracle

MATTERS = 1e-4
"""Millimeters of gouge or stock from which a mutant must be caught."""

STEP = 0.02


@dataclass(frozen=True)
class Chain:
    """A path by its points and the bulges between them: the tangent of a quarter of each sweep, 0 for a line."""

    points: tuple[Point, ...]
    bulges: tuple[float, ...]

    def path(self) -> Path:
        pairs = zip(self.points, self.points[1:], self.bulges, strict=False)
        return Path.from_pieces([_piece(a, b, bulge) for a, b, bulge in pairs if a != b])

    @staticmethod
    def of(path: Path) -> Chain:
        bulges = [0.0 if isinstance(piece, Line) else tan(piece.sweep / 4.0) for piece in path]
        return Chain(tuple((x, y) for x, y in path.points.tolist()), tuple(bulges))

    def moved(self, index: int, x: float, y: float) -> Chain:
        """The chain with one point elsewhere; arcs keep their sweeps."""
        points = list(self.points)
        points[index] = (x, y)
        return Chain(tuple(points), self.bulges)

    def bent(self, index: int, bulge: float) -> Chain:
        """The chain with another bulge."""
        return Chain(self.points, (*self.bulges[:index], bulge, *self.bulges[index + 1 :]))


def _piece(a: Point, b: Point, bulge: float) -> Piece:
    if bulge == 0.0:
        return Line(a, b)
    (x0, y0), (x1, y1) = a, b
    rise = (1.0 - bulge * bulge) / (4.0 * bulge)
    center = ((x0 + x1) / 2.0 - rise * (y1 - y0), (y0 + y1) / 2.0 + rise * (x1 - x0))
    return Arc(a, b, center, Turn.CCW if bulge > 0.0 else Turn.CW)


@dataclass(frozen=True)
class Case:
    """A contour and its correct center path; `other` is the path at another radius or on the other side."""

    surface: Path
    side: Side
    radius: float
    closed: bool
    path: Chain

    @cached_property
    def has_sides(self) -> bool:
        """The contour is closed and its chords do not cross, by shapely: any other contour has no inside."""
        return self.closed and bool(LinearRing(oracle.chords(self.surface).coords[:-1]).is_simple)

    def other(self, side: Side, radius: float) -> Chain:
        return Chain.of(_compensated(self.surface, side, radius, closed=self.closed))


def _compensated(surface: Path, side: Side, radius: float, *, closed: bool) -> Path:
    return compensate(surface, side, radius, 20, closed=closed).path


def _outline(random: Random) -> tuple[Path, bool]:
    """A closed outline started in the middle of a side, or an open one; lines, and arcs bent in or out."""
    count, closed = random.randint(3, 8), random.random() < 0.7
    spread = random.choice((0.0, 0.3, 0.6))
    points = []
    for k in range(count):
        angle = tau * (k + random.uniform(-0.3, 0.3)) / count
        size = random.choice((5.0, 20.0)) * (1.0 - spread * random.random())
        points.append((size * np.cos(angle).item(), size * np.sin(angle).item()))
    bulges = [random.choice((0.0, 0.0, 0.0, 0.1, 0.3, -0.1, -0.3)) for _ in points]
    bulges[-1] = 0.0
    if closed:
        middle = ((points[-1][0] + points[0][0]) / 2.0, (points[-1][1] + points[0][1]) / 2.0)
        points, bulges = [middle, *points, middle], [0.0, *bulges]
    else:
        bulges = bulges[:-1]
    if random.random() < 0.5:
        points, bulges = points[::-1], [-bulge for bulge in reversed(bulges)]
    return Chain(tuple(points), tuple(bulges)).path(), closed


def corpus(seed: int, count: int) -> Iterator[Case]:
    """`count` contours whose path at look-ahead 20 neither gouges nor leaves its side by dense points."""
    random = Random(seed)
    while count:
        surface, closed = _outline(random)
        side, radius = random.choice(list(Side)), random.choice((0.25, 0.7, 1.5))
        path = _compensated(surface, side, radius, closed=closed)
        if len(path) and closed == (hypot(*(surface.points[0] - surface.points[-1])) <= CLOSED):
            case = Case(surface, side, radius, closed, Chain.of(path))
            if _simple(surface) and Truth.of(case, path).harmless:
                count -= 1
                yield case


def _simple(surface: Path) -> bool:
    """Points of each piece keep off all others but its neighbors."""
    shares = np.linspace(0.0, 1.0, 60)
    count = len(surface)
    for k in range(count):
        others = [j for j in range(count) if (j - k) % count not in (0, 1, count - 1)]
        inner = oracle.along(surface[k], shares)
        if any(oracle.apart(inner, surface.part(j, j + 1)).min() < 0.05 for j in others):
            return False
        for j in {(k + 1) % count, (k - 1) % count} - {k}:
            far = oracle.apart(oracle.along(surface[k], np.array((0.1, 0.25, 0.5, 0.75, 0.9))), surface.part(j, j + 1))
            if far.min() < 0.02:
                return False
    return True


@dataclass(frozen=True)
class Truth:
    """What dense points measure: the depth of the deepest gouge, the thickness left, the length of surface with more
    than MATTERS left, and how far behind a closed surface the path gets."""

    depth: float
    stock: float
    left: float
    behind: float

    @property
    def wrong_side(self) -> bool:
        return self.behind > MATTERS

    @property
    def harmless(self) -> bool:
        return self.depth < 1e-6 and not self.wrong_side

    @property
    def gouges(self) -> bool:
        return self.depth > MATTERS or self.wrong_side

    @staticmethod
    def of(case: Case, path: Path) -> Truth:
        behind = oracle.deepest(path, case.surface, STEP, room_inside=room_is_inside(case)) if case.closed else -inf
        depth = gouged(case.radius, oracle.extreme(path, case.surface, STEP, -1.0), behind)
        stock = oracle.extreme(case.surface, path, STEP, 1.0) - case.radius
        total = float(case.surface.lengths.sum())
        left = total - oracle.length_near(case.surface, path, case.radius + MATTERS, STEP)
        return Truth(depth, stock, left, behind)


def gouged(radius: float, least: float, behind: float) -> float:
    """Depth of the deepest gouge of a path that is `least` from the surface and gets `behind` millimeters behind it."""
    return min(radius + max(behind, -least), 2.0 * radius) if least < radius - GOUGE else 0.0


def room_is_inside(case: Case) -> bool:
    """The cutter of a closed contour's case is inside it."""
    return (oracle.turning(case.surface) > 0.0) == (case.side is Side.LEFT)
