"""Closed golden contours, with coordinates found by hand."""

from __future__ import annotations

from math import sqrt

from core.geometry.piece import Side
from tests.core.comp.contours import lines
from tests.core.comp.golden import HALF, LONG, MISSED, SEAM, Expected, Golden

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
