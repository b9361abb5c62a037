"""Areas of material, gouges and uncut stock."""

from __future__ import annotations

from itertools import pairwise
from math import asin, inf, pi, sqrt
from random import Random

import numpy as np
import pytest

from core.draw.areas import gouged, inside, material, swept, uncut
from core.geometry.path import Path
from core.geometry.piece import Line, Point, Side


def lines(*points: Point) -> Path:
    """A path of lines."""
    return Path.from_pieces([Line(*pair) for pair in pairwise(points)])


SQUARE = lines((0, 0), (10, 0), (10, 10), (0, 10), (0, 0))


@pytest.mark.parametrize(
    ("surface", "side", "area"),
    [
        (SQUARE, Side.RIGHT, 100.0),
        (SQUARE.reversed(), Side.LEFT, 100.0),
        # outside of the square as far as 4 radii
        (SQUARE, Side.LEFT, 18.0**2 - 100.0),
        (SQUARE.reversed(), Side.RIGHT, 18.0**2 - 100.0),
        (lines((0, 0), (10, 0), (0, 0)), Side.LEFT, 0.0),
    ],
)
def test_the_material_of_a_closed_contour_is_on_the_other_side_of_the_cutter(
    surface: Path, side: Side, area: float
) -> None:
    assert material(surface, side, 1.0, closed=True, sag=0.01).area == pytest.approx(area)


@pytest.mark.parametrize(("side", "y"), [(Side.LEFT, -1.9), (Side.RIGHT, 1.9)])
def test_the_material_behind_an_open_contour_is_two_radii_thick(side: Side, y: float) -> None:
    wall = material(lines((0, 0), (10, 0)), side, 1.0, closed=False, sag=0.01)
    assert wall.area == pytest.approx(20.0)
    assert inside(wall, *(np.array([value]) for value in (5.0, y))).all()


def test_a_cutter_sweeps_a_slot_with_round_ends() -> None:
    paths = [lines((0, 0), (10, 0)), lines(), lines((0, 5), (10, 5))]
    assert swept(paths, 1.0, 0.01).area == pytest.approx(2 * (20.0 + pi), rel=1e-3)


def test_the_gouged_area_is_the_part_of_the_material_that_is_swept() -> None:
    """The cutter of radius 2 runs 1.5 away from the wall: it gouges 0.5 deep, of which the sag is not shaded."""
    part = material(SQUARE, Side.RIGHT, 2.0, closed=True, sag=0.1)
    area = gouged(part, [lines((-5, -1.5), (15, -1.5))], 2.0, 0.1)
    assert area.bounds == pytest.approx((0.0, 0.0, 10.0, 0.4))


def test_the_uncut_area_is_as_thick_as_it_was_judged() -> None:
    """0.5 is left on half a wall, with the sag 0.51; on other walls what is left is too thin or unknown."""
    part = material(SQUARE, Side.RIGHT, 1.0, closed=True, sag=0.01)
    stretches = [lines((5, 0), (10, 0)), lines((10, 0), (10, 10)), lines((10, 10), (0, 10)), lines()]
    area = uncut(part, stretches, [0.5, 0.005, inf, 0.5], [lines((0, -1), (5, -1))], 1.0, 0.01)
    assert area.bounds == pytest.approx((5.0, -0.51, 10.51, 0.51))
    # a round end at (10, 0), and without the round end of the cutter at (5, -1)
    cut = (pi / 2 - 0.49 * sqrt(1 - 0.49**2) - asin(0.49)) / 2
    assert area.area == pytest.approx(5.0 * 0.51 + pi * 0.51**2 / 2 - cut, rel=1e-3)


def test_a_contour_that_crosses_itself_has_a_region_too() -> None:
    """Shapely cannot buffer about one in thirty of such lines on one side; each of these was one or is like it."""
    corners = [(-5, 5), (-6, -2), (-8, 7), (-4, 0), (-2, 6), (4, 2), (0, 0), (-1, -1), (-7, -3)]
    lines = [Path.from_pieces([Line(*pair) for pair in pairwise([(6.35 * x, 6.35 * y) for x, y in corners])])]
    chance = Random(7)
    for _ in range(200):
        points = [(6.35 * chance.randint(-8, 8), 6.35 * chance.randint(-8, 8)) for _ in range(chance.randint(3, 9))]
        pieces = [Line(*pair) for pair in pairwise(points) if pair[0] != pair[1]]
        if pieces:
            lines.append(Path.from_pieces(pieces))
    for surface in lines:
        for side in Side:
            assert material(surface, side, 6.35, closed=False, sag=0.1).area > 0.0
