"""Lines and arcs as plain numbers."""

from __future__ import annotations

from math import pi, tau

import pytest

from core.geometry.piece import Arc, Line, Turn


def test_line_length():
    assert Line((1, 1), (4, 5)).length == 5


@pytest.mark.parametrize(
    ("end", "turn", "sweep"),
    [
        ((0, 2), Turn.CCW, pi / 2),
        ((0, 2), Turn.CW, -1.5 * pi),
        ((-2, 0), Turn.CCW, pi),
        ((-2, 0), Turn.CW, -pi),
        ((0, -2), Turn.CW, -pi / 2),
        ((2, 0), Turn.CCW, tau),
        ((2, 0), Turn.CW, -tau),
    ],
)
def test_arc_from_three_o_clock(end, turn, sweep):
    arc = Arc((2, 0), end, (0, 0), turn)
    assert arc.radius == 2
    assert arc.sweep == pytest.approx(sweep)
    assert arc.length == pytest.approx(2 * abs(sweep))


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_end_that_rounding_carries_past_the_start_is_no_full_circle(turn):
    assert Arc((2, 0), (2, -turn * 1e-15), (0, 0), turn).sweep == 0


def test_nearly_full_circle_is_long():
    assert Arc((2, 0), (2, -1e-6), (0, 0), Turn.CCW).sweep == pytest.approx(tau, abs=1e-6)


def test_the_middle_of_a_piece_lies_on_it():
    assert Arc((1, 0), (-1, 0), (0, 0), Turn.CCW).point_at(0.5) == pytest.approx((0, 1))
    assert Arc((1, 0), (-1, 0), (0, 0), Turn.CW).point_at(0.5) == pytest.approx((0, -1))
    assert Arc((1, 0), (1, 0), (0, 0), Turn.CW).point_at(0.5) == pytest.approx((-1, 0))
    assert Arc((6, 3), (4, 3), (5, 3), Turn.CCW).point_at(0.5) == pytest.approx((5, 4))
    assert Line((1, 2), (3, 6)).point_at(0.25) == (1.5, 3.0)
