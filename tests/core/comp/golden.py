"""What a golden contour is, and what is expected of it at each look-ahead; radius 0.25 everywhere."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from core.geometry.path import Path
from core.geometry.piece import Point, Side

RADIUS = 0.25
HALF = RADIUS * sqrt(0.5)
"""The parts of a radius that points along a diagonal."""


@dataclass(frozen=True)
class Expected:
    """What becomes of a contour from a look-ahead on: numbers of the path's pieces, its points, what is deleted."""

    since: int
    numbers: list[float]
    points: list[Point]
    deleted: tuple[int, ...] = ()
    by: tuple[float, float] = (0.0, 0.0)
    at: Point = (0.0, 0.0)
    findings: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Golden:
    """A contour, and what is expected of it in order of look-ahead."""

    contour: Path
    side: Side
    closed: bool
    calculated: int
    expected: tuple[Expected, ...]


MISSED, SEAM, LONG = "CORNER_MISSED", "START_INSIDE_CORNER", "LONG_WAY"
