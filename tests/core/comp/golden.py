"""Golden contours, open and closed, with coordinates found by hand, and what each look-ahead makes of them."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from core.geometry.path import Path
from core.geometry.piece import Point, Side
from tests.core.comp.contours import lines

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


OVERRUN_SQUARE = Golden(
    lines((-1, 0), (2, 0), (2, 2), (0, 2), (0, -1)),
    Side.RIGHT,
    False,
    2,
    (
        Expected(
            1,
            [1, 1.5, 2, 2.5, 3, 3.5, 4],
            [(-1, -0.25), (2, -0.25), (2.25, 0), (2.25, 2), (2, 2.25), (0, 2.25), (-0.25, 2), (-0.25, -1)],
        ),
        Expected(3, [1, 4], [(-1, -0.25), (-0.25, -0.25), (-0.25, -1)], (2, 3), (1, 4), (-0.25, -0.25)),
    ),
)
OVERRUN_L = Golden(
    lines((-1, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4), (0, -1), (-1, -1)),
    Side.RIGHT,
    False,
    4,
    (
        Expected(
            1,
            [1, 1.5, 2, 2.5, 3, 4, 4.5, 5, 5.5, 6, 7],
            [
                (-1, -0.25),
                (4, -0.25),
                (4.25, 0),
                (4.25, 2),
                (4, 2.25),
                (2.25, 2.25),
                (2.25, 4),
                (2, 4.25),
                (0, 4.25),
                (-0.25, 4),
                (-0.25, -0.75),
                (-1, -0.75),
            ],
        ),
        Expected(
            5,
            [1, 6, 7],
            [(-1, -0.25), (-0.25, -0.25), (-0.25, -0.75), (-1, -0.75)],
            (2, 3, 4, 5),
            (1, 6),
            (-0.25, -0.25),
        ),
    ),
)
NARROW_NOTCH = Golden(
    lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0)),
    Side.LEFT,
    False,
    2,
    (
        Expected(
            1,
            [1, 1.5, 2, 3, 3.5, 4, 4.5, 5],
            [
                (0, 0.25),
                (2, 0.25),
                (2.25, 0),
                (2.25, -0.05),
                (2.3, -0.05),
                (2.05, -0.3),
                (2.05, 0),
                (2.3, 0.25),
                (5, 0.25),
            ],
            findings=frozenset({MISSED}),
        ),
        Expected(
            3,
            [1, 1.5, 4.5, 5],
            [(0, 0.25), (2, 0.25), (2.15, 0.2), (2.3, 0.25), (5, 0.25)],
            (2, 3, 4),
            (1.5, 4.5),
            (2.15, 0.2),
        ),
    ),
)
SMALL_STEP = Golden(
    lines((0, 0), (2, 0), (2, 0.1), (4, 0.1), (4, 2)),
    Side.LEFT,
    False,
    2,
    (
        Expected(
            1,
            [1, 1.5, 2, 2.5, 3, 4],
            [(0, 0.25), (2, 0.25), (1.75, 0), (1.75, 0.1), (2, 0.35), (3.75, 0.35), (3.75, 2)],
            findings=frozenset({MISSED}),
        ),
        Expected(
            2,
            [1, 2.5, 3, 4],
            [(0, 0.25), (1.8, 0.25), (2, 0.35), (3.75, 0.35), (3.75, 2)],
            (2,),
            (1, 2.5),
            (1.8, 0.25),
        ),
    ),
)
SHORT_CHAMFER = Golden(
    lines((0, 0), (2, 0), (2.05, 0.05), (2.05, 2), (0, 2)),
    Side.LEFT,
    False,
    2,
    (
        Expected(
            1,
            [1, 1.5, 2, 2.5, 3, 4],
            [
                (0, 0.25),
                (2, 0.25),
                (2 - HALF, HALF),
                (2.05 - HALF, 0.05 + HALF),
                (1.8, 0.05),
                (1.8, 1.75),
                (0, 1.75),
            ],
            findings=frozenset({MISSED}),
        ),
        Expected(2, [1, 3, 4], [(0, 0.25), (1.8, 0.25), (1.8, 1.75), (0, 1.75)], (2,), (1, 3), (1.8, 0.25)),
    ),
)


SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
INSIDE_FROM_A_CORNER = Golden(
    SQUARE,
    Side.LEFT,
    True,
    3,
    (
        Expected(
            1,
            [1, 2, 3, 4],
            [(0, 0.25), (1.75, 0.25), (1.75, 1.75), (0.25, 1.75), (0.25, 0)],
            findings=frozenset({SEAM}),
        ),
    ),
)
OUTSIDE_FROM_A_CORNER = Golden(
    SQUARE,
    Side.RIGHT,
    True,
    3,
    (
        Expected(
            1,
            [1, 1.5, 2, 2.5, 3, 3.5, 4],
            [(0, -0.25), (2, -0.25), (2.25, 0), (2.25, 2), (2, 2.25), (0, 2.25), (-0.25, 2), (-0.25, 0)],
        ),
    ),
)
INSIDE_FROM_MID_SIDE = Golden(
    lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0)),
    Side.LEFT,
    True,
    4,
    (
        Expected(
            1,
            [1, 2, 3, 4, 5],
            [(1, 0.25), (1.75, 0.25), (1.75, 1.75), (0.25, 1.75), (0.25, 0.25), (1, 0.25)],
        ),
    ),
)
SEAM_Y = 0.1 + 2 * HALF - 0.25
"""Where the chamfer (0, .1) (.1, 0), one radius inside, meets x = 0.25."""
CHAMFER_AT_THE_SEAM = Golden(
    lines((0.1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0)),
    Side.LEFT,
    True,
    4,
    (
        Expected(
            1,
            [1, 2, 3, 4, 5],
            [(0.1, 0.25), (1.75, 0.25), (1.75, 1.75), (0.25, 1.75), (0.25, SEAM_Y), (0.1 + HALF, HALF)],
            findings=frozenset({SEAM}),
        ),
        Expected(
            3,
            [1, 4, 5],
            [(0.1, 0.25), (0.25, 0.25), (0.25, SEAM_Y), (0.1 + HALF, HALF)],
            (2, 3),
            (1, 4),
            (0.25, 0.25),
            frozenset({SEAM, LONG}),
        ),
    ),
)
CHAMFER_FROM_MID_SIDE = Golden(
    lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0), (1, 0)),
    Side.LEFT,
    True,
    5,
    (
        Expected(
            1,
            [1, 2, 3, 4, 5, 5.5, 6],
            [
                (1, 0.25),
                (1.75, 0.25),
                (1.75, 1.75),
                (0.25, 1.75),
                (0.25, SEAM_Y),
                (0.1 + HALF, HALF),
                (0.1, 0.25),
                (1, 0.25),
            ],
            findings=frozenset({MISSED}),
        ),
        Expected(
            2,
            [1, 2, 3, 4, 6],
            [(1, 0.25), (1.75, 0.25), (1.75, 1.75), (0.25, 1.75), (0.25, 0.25), (1, 0.25)],
            (5,),
            (4, 6),
            (0.25, 0.25),
        ),
    ),
)
SLANT = sqrt(1.5**2 + 2.6**2)
INWARD = (3 * SLANT + 1.5 * 3) / 2.6 / 3
TRIANGLE = Golden(
    lines((0, 0), (3, 0), (1.5, 2.6), (0, 0)),
    Side.LEFT,
    True,
    3,
    (
        Expected(
            1,
            [1, 2, 3],
            [
                (0, 0.25),
                (3 - 0.25 * INWARD, 0.25),
                (1.5, 2.6 - 0.25 * SLANT / 1.5),
                (0.25 * 2.6 / SLANT, -0.25 * 1.5 / SLANT),
            ],
            findings=frozenset({SEAM}),
        ),
    ),
)
