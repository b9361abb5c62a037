"""Constructions: cases calculated by hand, and properties of any drawing."""

from __future__ import annotations

from math import cos, dist, inf, pi, sin, sqrt, tau
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.geometry import construct
from core.geometry.construct import OutOfReach
from core.geometry.piece import Arc, Point, Turn
from core.tolerance import ARC_RADII

NEAR = 1e-9

coordinates = st.floats(-100, 100)
points = st.tuples(coordinates, coordinates)
angles = st.floats(0, tau)
turns = st.sampled_from((Turn.CW, Turn.CCW))
laws = settings(derandomize=True, max_examples=200)


def near(first: Point, second: Point, tolerance: float = NEAR) -> bool:
    return dist(first, second) <= tolerance


def test_polar_gives_the_point_at_an_angle_and_distance():
    assert near(construct.polar((1.0, 2.0), pi / 2, 3.0), (1.0, 5.0))
    assert near(construct.polar((1.0, 2.0), pi, 3.0), (-2.0, 2.0))


def test_a_ray_reaches_a_coordinate():
    result = construct.ray_to_coordinate((1.0, 1.0), pi / 4, 0, 3.0)
    assert result is not None
    assert near(result[0], (3.0, 3.0))
    assert result[1]
    result = construct.ray_to_coordinate((1.0, 1.0), pi / 6, 1, 2.0)
    assert result is not None
    assert near(result[0], (1 + sqrt(3), 2.0))
    assert result[0][1] == 2.0
    assert result[1]


def test_a_ray_that_does_not_reach_a_coordinate_gives_the_reason():
    assert construct.ray_to_coordinate((1.0, 1.0), pi / 2, 0, 1.0) is None
    assert construct.ray_to_coordinate((1.0, 1.0), pi, 1, 5.0) is None
    behind = construct.ray_to_coordinate((1.0, 1.0), pi / 4, 0, 0.0)
    assert behind is not None
    assert near(behind[0], (0.0, 0.0))
    assert not behind[1]


def test_on_circle_finds_the_points_at_a_coordinate():
    assert construct.points_on_circle((1.0, 1.0), 5.0, 0, 4.0) == ((4.0, 5.0), (4.0, -3.0))
    assert construct.points_on_circle((1.0, 1.0), 5.0, 1, -2.0) == ((5.0, -2.0), (-3.0, -2.0))
    assert construct.points_on_circle((1.0, 1.0), 5.0, 0, 6.0) == ((6.0, 1.0),)
    assert construct.points_on_circle((1.0, 1.0), 5.0, 0, 7.0) == OutOfReach(6.0)


def test_on_circle_accepts_a_coordinate_rounded_outwards():
    assert construct.points_on_circle((0.0, 0.0), 5.0, 1, 5.0 + ARC_RADII) == ((0.0, 5.0 + ARC_RADII),)
    assert construct.points_on_circle((0.0, 0.0), 5.0, 1, 5.01) == OutOfReach(5.01)


@pytest.mark.parametrize(
    ("turn", "first", "second"),
    [(Turn.CCW, (0.0, 3.0), (0.0, -3.0)), (Turn.CW, (0.0, -3.0), (0.0, 3.0))],
)
def test_the_center_of_the_shorter_arc_comes_first(turn, first, second):
    result = construct.centers((-4.0, 0.0), (4.0, 0.0), 5.0, turn)
    assert isinstance(result, tuple)
    assert len(result) == 2
    assert near(result[0], first)
    assert near(result[1], second)


def _count(result: tuple[Point, ...] | OutOfReach) -> int:
    assert isinstance(result, tuple)
    return len(result)


def test_a_typed_chord_equal_to_the_diameter_has_one_center():
    rng = Random(2)
    for _ in range(300):
        radius, x = round(rng.uniform(1, 20), 3), round(rng.uniform(-50, 100), 3)
        end = round(x - 2 * radius, 3)
        assert _count(construct.centers((x, 10.0), (end, 10.0), radius, Turn.CCW)) == 1
        assert _count(construct.points_on_circle((x, 10.0), radius, 0, round(x + radius, 3))) == 1
        # one more digit makes two different arcs
        assert _count(construct.centers((x, 10.0), (end, 10.0), radius + 0.0001, Turn.CCW)) == 2


def test_half_circles_have_one_center_and_short_radii_none():
    assert construct.centers((-4.0, 0.0), (4.0, 0.0), 4.0, Turn.CW) == ((0.0, 0.0),)
    assert construct.centers((-4.0, 0.0), (4.0, 0.0), 4.0 - ARC_RADII, Turn.CW) == ((0.0, 0.0),)
    assert construct.centers((-4.0, 0.0), (4.0, 0.0), 3.9, Turn.CW) == OutOfReach(4.0)
    assert construct.centers((1.0, 1.0), (1.0, 1.0), 3.9, Turn.CW) == ()


@laws
@given(points, points, st.floats(0.1, 500), turns)
def test_centers_are_the_radius_away_with_the_shorter_arc_first(start, end, radius, turn):
    assume(dist(start, end) > 0.01)
    match construct.centers(start, end, radius, turn):
        case (first, second):
            for center in (first, second):
                assert dist(center, start) == pytest.approx(radius, abs=1e-7)
                assert dist(center, end) == pytest.approx(radius, abs=1e-7)
            assert abs(Arc(start, end, first, turn).sweep) <= pi + 1e-6
            assert abs(Arc(start, end, second, turn).sweep) >= pi - 1e-6
        case (center,):
            assert dist(center, start) == pytest.approx(dist(start, end) / 2)
        case OutOfReach(least):
            assert least == dist(start, end) / 2
            assert least > radius
        case other:
            pytest.fail(f"unexpected {other}")


def test_the_sweep_determines_the_center():
    result = construct.center_by_sweep((1.0, 0.0), (0.0, 1.0), pi / 2, Turn.CCW)
    assert result is not None
    assert near(result, (0.0, 0.0))
    result = construct.center_by_sweep((1.0, 0.0), (0.0, 1.0), 3 * pi / 2, Turn.CCW)
    assert result is not None
    assert near(result, (1.0, 1.0))
    result = construct.center_by_sweep((1.0, 0.0), (0.0, 1.0), pi / 2, Turn.CW)
    assert result is not None
    assert near(result, (1.0, 1.0))
    assert construct.center_by_sweep((1.0, 0.0), (1.0, 0.0), pi, Turn.CW) is None
    assert construct.center_by_sweep((1.0, 0.0), (0.0, 1.0), tau, Turn.CW) is None


@laws
@given(points, st.floats(0.5, 100), angles, st.floats(0.05, tau - 0.05), turns)
def test_the_center_is_found_again_from_the_sweep(center, radius, angle, sweep, turn):
    start = (center[0] + radius * cos(angle), center[1] + radius * sin(angle))
    end = construct.rotated(start, center, turn * sweep)
    assert abs(Arc(start, end, center, turn).sweep) == pytest.approx(sweep, abs=1e-9)
    result = construct.center_by_sweep(start, end, sweep, turn)
    assert result is not None
    assert near(result, center, 1e-7)


@laws
@given(points, st.floats(0.5, 100), angles, st.floats(0.5, tau - 0.5), st.sampled_from((0, 1)))
def test_the_center_is_found_again_from_one_of_its_coordinates(center, radius, angle, sweep, axis):
    start = (center[0] + radius * cos(angle), center[1] + radius * sin(angle))
    end = construct.rotated(start, center, sweep)
    assume(abs(end[1 - axis] - start[1 - axis]) > 0.01 * dist(start, end))
    result = construct.center_by_coordinate(start, end, axis, center[axis])
    assert result is not None
    assert near(result, center, 1e-6)


def test_a_center_coordinate_along_the_chord_determines_nothing():
    assert construct.center_by_coordinate((0.0, 0.0), (4.0, 0.0), 0, 2.0) is None
    assert construct.center_by_coordinate((0.0, 0.0), (0.0, 0.0), 0, 2.0) is None
    assert construct.center_by_coordinate((0.0, 0.0), (4.0, 0.0), 1, 7.0) == (2.0, 7.0)


def test_even_arc_keeps_a_center_that_fits():
    assert construct.exact_arc((1.0, 0.0), (0.0, 1.0), (0.0, 0.0), Turn.CCW) == Arc(
        (1.0, 0.0), (0.0, 1.0), (0.0, 0.0), Turn.CCW
    )


def test_an_arc_that_is_even_but_for_rounding_keeps_its_center():
    end, center = (50.0 * cos(2.0) + 1e-9, 50.0 * sin(2.0)), (0.0, 0.0)
    assert construct.exact_arc((50.0, 0.0), end, center, Turn.CCW) == Arc((50.0, 0.0), end, center, Turn.CCW)


def test_even_arc_moves_the_center_onto_the_bisector():
    arc = construct.exact_arc((0.0, 0.0), (2.0, 0.0), (1.001, 0.5), Turn.CW)
    assert near(arc.center, (1.0, 0.5))
    assert (arc.start, arc.end) == ((0.0, 0.0), (2.0, 0.0))
    off_center = (4.0 + 0.001 * 0.8, 4.0 + 0.001 * 0.6)
    arc = construct.exact_arc((3.0, -3.0), (11.0, 3.0), off_center, Turn.CCW)
    assert near(arc.center, (4.0, 4.0))
    assert (arc.start, arc.end) == ((3.0, -3.0), (11.0, 3.0))


def test_even_arc_closes_a_circle_that_ends_at_its_start():
    arc = construct.exact_arc((1.0, 0.0), (1.0, 1e-9), (0.0, 0.0), Turn.CCW)
    assert arc == Arc((1.0, 0.0), (1.0, 0.0), (0.0, 0.0), Turn.CCW)
    assert arc.sweep == tau


@pytest.mark.parametrize("off", [0.001, -0.002])
@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_even_arc_closes_a_circle_that_ends_on_the_ray_of_its_start(off, turn):
    """Rounding may move the end onto the circle after or before the start; the circle must not vanish."""
    for x in (0.1, 0.3, -0.7):
        center = (x, -10.0)
        size = dist((0.0, 0.0), center)
        end = (x - x * (size + off) / size, -10.0 + 10.0 * (size + off) / size)
        arc = construct.exact_arc((0.0, 0.0), end, center, turn)
        assert arc == Arc((0.0, 0.0), (0.0, 0.0), center, turn)


def test_even_arc_keeps_a_tiny_arc_tiny():
    """An arc of two microns is no full circle."""
    arc = construct.exact_arc((1.0, 0.0), (1.0, 0.002), (0.0, 0.0), Turn.CCW)
    assert arc.sweep == pytest.approx(0.002, abs=1e-5)


def test_even_arc_moves_the_end_if_the_center_would_move_far():
    """On a chord of 0.1, radii of 50 that differ by 0.002 would move the center by a millimeter."""
    end = (50.002 * cos(0.002), 50.002 * sin(0.002))
    arc = construct.exact_arc((50.0, 0.0), end, (0.0, 0.0), Turn.CCW)
    assert arc.center == (0.0, 0.0)
    assert dist(arc.end, arc.center) == pytest.approx(50.0)
    assert near(arc.end, end, ARC_RADII)


@laws
@given(points, st.floats(0.1, 200), angles, angles, st.floats(-ARC_RADII, ARC_RADII), turns)
def test_even_arc_is_exact_and_moves_points_within_the_tolerance(center, radius, first, last, off, turn):
    start = (center[0] + radius * cos(first), center[1] + radius * sin(first))
    end = (center[0] + (radius + off) * cos(last), center[1] + (radius + off) * sin(last))
    arc = construct.exact_arc(start, end, center, turn)
    assert arc.start == start
    assert dist(arc.start, arc.center) == pytest.approx(dist(arc.end, arc.center), abs=2e-9)
    assert near(arc.end, end, ARC_RADII + NEAR)
    assert near(arc.center, center, ARC_RADII + NEAR)


def test_chord_factor_is_the_chord_of_a_unit_arc():
    assert construct.chord_factor(pi) == 2.0
    assert construct.chord_factor(pi / 3) == pytest.approx(1.0)


def test_an_infinite_coordinate_is_out_of_reach():
    assert construct.points_on_circle((0.0, 0.0), 1.0, 0, inf) == OutOfReach(inf)
