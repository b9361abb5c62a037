"""Lines with a heading: what two of them share."""

from __future__ import annotations

from math import pi

import pytest
from numpy.testing import assert_allclose

from core.geometry.oriented import Circle, OrientedLine, headings_at_distances, line_through, meeting, touch_point
from core.geometry.piece import Point


def test_a_line_traveled_backwards_is_the_same_line() -> None:
    assert meeting(OrientedLine(0.0, 5.0), OrientedLine(pi, -5.0)).coincident


def test_parallel_lines_are_apart_by_their_distance_whichever_way_they_are_traveled() -> None:
    for other in (OrientedLine(0.0, 2.0), OrientedLine(pi, -2.0)):
        met = meeting(OrientedLine(0.0, 5.0), other)
        assert not met.coincident
        assert met.distance == pytest.approx(3.0)


def test_circles_share_the_point_left_of_the_way_between_their_centers_first() -> None:
    met = meeting(Circle((1.0, 2.0), 5.0), Circle((9.0, 2.0), 5.0))
    assert_allclose(met.points, [(5.0, 5.0), (5.0, -1.0)])


@pytest.mark.parametrize(("distance", "touching"), [(7.0, (6.0, 2.0)), (3.0, (6.0, 2.0))])
def test_circles_that_touch_from_outside_or_inside_share_one_point(distance: float, touching: Point) -> None:
    met = meeting(Circle((1.0, 2.0), 5.0), Circle((1.0 + distance, 2.0), 2.0))
    assert met.grazing
    assert_allclose(met.points, [touching])


@pytest.mark.parametrize("distance", [7.5, 2.5])
def test_circles_beside_or_within_each_other_share_nothing(distance: float) -> None:
    assert meeting(Circle((1.0, 2.0), 5.0), Circle((1.0 + distance, 2.0), 2.0)).points == ()


def test_circles_about_one_center_are_the_same_or_share_nothing() -> None:
    met = [meeting(Circle((1.0, 2.0), 5.0), Circle((1.0, 2.0), radius)) for radius in (5.0, 4.0)]
    assert [(one.points, one.coincident) for one in met] == [((), True), ((), False)]


def test_shifted_loci_meet_at_the_shifted_point() -> None:
    line, circle = line_through((3.0, 4.0), 0.5), Circle((3.0, 4.0 + 5.0), 5.0)
    shifted = meeting(line.shifted(10.0, 20.0), circle.shifted(10.0, 20.0)).points
    assert_allclose(shifted, [(x + 10.0, y + 20.0) for x, y in meeting(line, circle).points])


def test_lines_meet_where_both_equations_hold() -> None:
    # y = 5, traveled to the right, and x = 3, traveled up: its left normal is (-1, 0)
    assert_allclose(meeting(OrientedLine(0.0, 5.0), OrientedLine(pi / 2, -3.0)).points, [(3.0, 5.0)])


def test_lines_through_a_point_meet_there() -> None:
    assert_allclose(meeting(line_through((1.0, 2.0), 0.3), line_through((1.0, 2.0), 1.4)).points, [(1.0, 2.0)])


def test_a_line_at_distances_from_two_points_has_one_heading_each_way() -> None:
    headings, grazing = headings_at_distances((1.0, 2.0), 0.0, (11.0, 2.0), 5.0)
    # the second point is 5 further to the left of a line at 30 degrees below the way between them
    assert not grazing
    assert_allclose(headings, [-pi / 6, -5 * pi / 6])


def test_points_that_are_as_far_apart_as_their_distances_differ_leave_one_heading() -> None:
    headings, grazing = headings_at_distances((1.0, 2.0), 0.0, (11.0, 2.0), 10.0)
    assert grazing
    assert_allclose(headings, [-pi / 2])
    assert headings_at_distances((1.0, 2.0), 0.0, (11.0, 2.0), 10.1) == ((), False)


def test_circles_traveled_the_same_way_touch_on_the_line_through_their_centers() -> None:
    touch = touch_point((1.0, 2.0), 5.0, (4.0, 2.0), 2.0)
    assert touch is not None
    assert_allclose((*touch[0], touch[1]), (6.0, 2.0, pi / 2))
    assert touch_point((1.0, 2.0), 5.0, (4.0, 6.0), 5.0) is None


def test_a_line_touches_a_circle_in_one_point_and_crosses_it_in_two() -> None:
    circle = Circle((3.0, 4.0), 5.0)
    touch = meeting(OrientedLine(0.0, 9.0), circle)
    assert touch.grazing
    assert_allclose(touch.points, [(3.0, 9.0)])
    crossed = meeting(OrientedLine(0.0, 8.0), circle)
    assert_allclose(crossed.points, [(0.0, 8.0), (6.0, 8.0)], atol=1e-12)
    assert not crossed.grazing
    assert meeting(OrientedLine(0.0, 9.5), circle).points == ()
