"""Chords of what areas are bounded by."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, pi
from random import Random

import numpy as np
import pytest

from core.draw.areas import material
from core.geometry.chords import chords_of
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn


def test_lines_have_their_own_points_and_no_others() -> None:
    path = Path.from_pieces([Line((0.0, 0.0), (4.0, 0.0)), Line((4.0, 0.0), (4.0, 3.0)), Line((4.0, 3.0), (0.0, 0.0))])
    assert chords_of(path, 0.01).tolist() == [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 0.0]]
    assert chords_of(Path.from_pieces([]), 0.01).shape == (0, 2)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
@pytest.mark.parametrize("sag", [0.1, 0.001])
def test_the_chords_of_an_arc_are_no_farther_from_it_than_the_sag(turn: Turn, sag: float) -> None:
    half = Path.from_pieces([Arc((0.0, turn * -5.0), (0.0, turn * 5.0), (0.0, 0.0), turn)])
    points = chords_of(half, sag)
    assert points[0] == pytest.approx((0.0, turn * -5.0))
    assert points[-1] == pytest.approx((0.0, turn * 5.0))
    assert (points[1:-1, 0] > 0.0).all(), "on the side to which it turns"
    assert np.hypot(*points.T) == pytest.approx(5.0)
    middles = (points[1:] + points[:-1]) / 2.0
    assert 5.0 - min(hypot(*middle) for middle in middles) <= sag
    assert np.hypot(*np.diff(points, axis=0).T).sum() == pytest.approx(5.0 * pi, rel=sag)


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
