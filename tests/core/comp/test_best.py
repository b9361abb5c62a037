"""The best path of contours small enough to check by hand: corners, starts, ends, slots."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests.core.comp.best_truth import CLOSE, only
from tests.core.comp.contours import lines

SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
MID_SIDE = lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))


def test_inside_a_square_the_corners_are_trimmed_across_the_start_too():
    loop = only(SQUARE, Side.LEFT, 0.25)
    expected = [(0.25, 0.25), (1.75, 0.25), (1.75, 1.75), (0.25, 1.75), (0.25, 0.25)]
    assert loop.points == pytest.approx(np.array(expected), abs=CLOSE)
    assert loop.numbers.tolist() == [1, 2, 3, 4]


def test_outside_a_square_every_corner_has_its_arc_the_last_at_the_start():
    loop = only(SQUARE, Side.RIGHT, 0.25)
    assert loop.numbers.tolist() == [1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5]
    assert loop.turns.tolist() == [0, 1] * 4
    assert loop.points[0] == pytest.approx((0, -0.25), abs=CLOSE)
    assert loop.lengths.sum() == pytest.approx(8 + pi / 2, abs=CLOSE)


def test_the_loop_starts_at_the_image_of_start():
    loop = only(MID_SIDE, Side.LEFT, 0.25)
    assert loop.points[0] == pytest.approx((1, 0.25), abs=CLOSE)
    assert loop.numbers.tolist() == [1, 2, 3, 4, 5]


def test_where_the_image_of_start_is_lost_the_loop_starts_with_its_first_segment():
    chamfer = lines((0.1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0))
    loop = only(chamfer, Side.LEFT, 0.25)
    assert loop.numbers.tolist() == [1, 2, 3, 4]
    assert loop.points[0] == pytest.approx((0.25, 0.25), abs=CLOSE)


def test_inside_corner_of_an_open_l():
    path = only(lines((0, 0), (3, 0), (3, 2)), Side.LEFT, 0.5, closed=False)
    assert path.points == pytest.approx(np.array([(0, 0.5), (2.5, 0.5), (2.5, 2)]), abs=CLOSE)


def test_outside_corner_of_an_open_l():
    path = only(lines((0, 0), (3, 0), (3, 2)), Side.RIGHT, 0.5, closed=False)
    assert path.points == pytest.approx(np.array([(0, -0.5), (3, -0.5), (3.5, 0), (3.5, 2)]), abs=CLOSE)
    assert path.numbers.tolist() == [1, 1.5, 2]


def test_a_notch_narrower_than_the_cutter_is_passed_on_its_corners():
    path = only(lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0)), Side.LEFT, 0.25, closed=False)
    assert path.numbers.tolist() == [1, 1.5, 4.5, 5]
    assert path.points[2] == pytest.approx((2.15, sqrt(0.25**2 - 0.15**2)), abs=CLOSE)


def test_a_slot_as_wide_as_the_cutter_is_entered_and_left_on_one_line():
    path = only(lines((0, 0), (2, 0), (2, -1), (2.5, -1), (2.5, 0), (5, 0)), Side.LEFT, 0.25, closed=False)
    assert path.numbers.tolist() == [1, 1.5, 2, 4, 4.5, 5]
    assert path.points[2:5] == pytest.approx(np.array([(2.25, 0), (2.25, -0.75), (2.25, 0)]), abs=CLOSE)


def test_a_slot_with_a_round_end_as_wide_as_the_cutter():
    bottom = Arc((2.0, -1.0), (2.5, -1.0), (2.25, -1.0), Turn.CCW)
    before = [Line((0.0, 0.0), (2.0, 0.0)), Line((2.0, 0.0), (2.0, -1.0))]
    behind = [Line((2.5, -1.0), (2.5, 0.0)), Line((2.5, 0.0), (5.0, 0.0))]
    path = only(Path.from_pieces([*before, bottom, *behind]), Side.LEFT, 0.25, closed=False)
    assert path.numbers.tolist() == [1, 1.5, 2, 4, 4.5, 5]
    assert path.points[3] == pytest.approx((2.25, -1), abs=CLOSE)


def test_both_ends_of_an_open_line_are_left_as_they_are():
    for side, y in ((Side.LEFT, 0.5), (Side.RIGHT, -0.5)):
        path = only(lines((0, 0), (3, 0)), side, 0.5, closed=False)
        assert path.points.tolist() == [[0, y], [3, y]]


def test_an_exact_reversal_is_gone_around_with_a_half_circle():
    path = only(lines((0, 0), (3, 0), (0, 0)), Side.LEFT, 0.5, closed=False)
    assert path.numbers.tolist() == [1, 1.5, 2]
    assert path.lengths[1] == pytest.approx(pi / 2, abs=CLOSE)
