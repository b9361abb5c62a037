"""Lines with a heading: what two of them share."""

from __future__ import annotations

from math import pi

import pytest

from core.geometry.oriented import OrientedLine, meeting


def test_a_line_traveled_backwards_is_the_same_line() -> None:
    assert meeting(OrientedLine(0.0, 5.0), OrientedLine(pi, -5.0)).coincident


def test_parallel_lines_are_apart_by_their_distance_whichever_way_they_are_traveled() -> None:
    for other in (OrientedLine(0.0, 2.0), OrientedLine(pi, -2.0)):
        met = meeting(OrientedLine(0.0, 5.0), other)
        assert (met.coincident, met.apart) == (False, pytest.approx(3.0))


def test_lines_meet_where_both_equations_hold() -> None:
    # y = 5, traveled to the right, and x = 3, traveled up: its left normal is (-1, 0)
    assert meeting(OrientedLine(0.0, 5.0), OrientedLine(pi / 2, -3.0)).points == (pytest.approx((3.0, 5.0)),)
