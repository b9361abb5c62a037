"""Corner constructions by hand; the tool's radius is 1 on the left unless said."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from core.controls.compensation.corners import (
    Element,
    arc_element,
    element_sweep,
    fits,
    line_element,
    meeting,
    meetings,
    miter,
    offset_radius,
    runs_back,
    square_end,
    square_start,
    turned,
    turning,
)


def line(ax: float, ay: float, bx: float, by: float) -> Element:
    return line_element((ax, ay), (bx, by), 0.0, 0.0, rapid=False, feed=1.0, line=1)


def arc(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, turn: int) -> Element:
    return arc_element((ax, ay), (bx, by), (cx, cy), turn, 0.0, 0.0, 1.0, 1)


EAST, NORTH, SOUTH = line(0, 0, 4, 0), line(4, 0, 4, 4), line(4, 0, 4, -4)


def test_square_points_stand_on_the_tool_s_side() -> None:
    assert square_end(EAST, 1) == (4, 1)
    assert square_start(NORTH, 1) == (3, 0)
    assert square_start(NORTH, -1) == (5, 0)


def test_turns_are_positive_to_the_left() -> None:
    assert turning(EAST, NORTH) == pytest.approx(pi / 2)
    assert turning(EAST, SOUTH) == pytest.approx(-pi / 2)


def test_the_miter_is_where_prolonged_offsets_meet() -> None:
    assert miter((4, 0), (1, 0), -pi / 2, 1) == pytest.approx((5, 1))
    assert miter((4, 0), (1, 0), pi / 2, -1) == pytest.approx((5, -1))


def test_lines_meet_inside() -> None:
    assert meeting(EAST, NORTH, 1) == pytest.approx((3, 1))


def test_line_and_arc_meet_nearest_to_the_corner() -> None:
    inside = arc(4, 0, 4, 6, 4, 3, 1)
    assert meeting(EAST, inside, 1) == pytest.approx((4, 1))
    hill = arc(4, 0, 8, 0, 6, 0, -1)
    point = meeting(EAST, hill, 1)
    assert point == pytest.approx((6 - sqrt(9 - 1), 1))


def test_two_arcs_meet() -> None:
    first, second = arc(1, 0, 1.4, -0.8, 2, 0, 1), arc(1.4, -0.8, 1.8, 0, 0.8, 0, 1)
    assert meeting(first, second, 0.25) == pytest.approx((1.4, -0.45))
    assert len(meetings(first, second, 0.25, 0.25)) == 2


def test_what_does_not_meet_has_no_meeting() -> None:
    assert meeting(EAST, line(4, 0, 8, 0), 1) is None
    assert meeting(EAST, arc(4, 0, 4, 1, 4, 0.5, 1), 1) is None
    assert meeting(arc(0, 0, 2, 0, 1, 0, 1), arc(9, 0, 11, 0, 10, 0, 1), -1) is None


def test_offset_radii_shrink_inside_and_grow_outside() -> None:
    circle = arc(2, 0, 2, 0, 0, 0, 1)
    assert (offset_radius(circle, 0.5), offset_radius(circle, -0.5)) == (1.5, 2.5)
    assert fits(circle, 1.99)
    assert not fits(circle, 2.0)
    assert element_sweep(circle) == pytest.approx(2 * pi)


def test_backwards_is_told_of_lines_and_arcs() -> None:
    assert runs_back(EAST, (3, 1), (2, 1))
    assert not runs_back(EAST, (2, 1), (3, 1))
    quarter = arc(2, 0, 0, 2, 0, 0, 1)
    assert runs_back(quarter, turned((1, 0), (0, 0), 1.0), turned((1, 0), (0, 0), 0.9))
    assert not runs_back(quarter, turned((1, 0), (0, 0), 0.9), turned((1, 0), (0, 0), 1.0))
