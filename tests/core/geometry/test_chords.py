"""Paths as chords."""

from __future__ import annotations

from math import hypot, pi

import numpy as np
import pytest

from core.geometry.path import Path, chords_of
from core.geometry.piece import Arc, Line, Turn


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
