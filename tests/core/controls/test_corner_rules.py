"""Corner constructions and joints calculated by hand, with radius 1 on the left unless stated."""

from __future__ import annotations

from math import cos, dist, pi, radians, sin, sqrt, tan

import pytest

from core.controls.compensation.corner_rules import (
    CornerKind,
    CornerRules,
    Inside,
    Joint,
    Outside,
    corner_kind,
    join,
)
from core.controls.compensation.elements import (
    Element,
    arc_element,
    element_sweep,
    fits,
    line_element,
    meeting,
    meetings,
    miter,
    offset_end,
    offset_radius,
    offset_start,
    runs_back,
    turn_angle,
)
from core.geometry.construct import rotated


def line(ax: float, ay: float, bx: float, by: float) -> Element:
    return line_element((ax, ay), (bx, by), 0.0, 0.0, rapid=False, feed=1.0, line=1)


def arc(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, turn: int) -> Element:
    return arc_element((ax, ay), (bx, by), (cx, cy), turn, 0.0, 0.0, 1.0, 1)


EAST, NORTH, SOUTH = line(0, 0, 4, 0), line(4, 0, 4, 4), line(4, 0, 4, -4)


def test_offset_points_are_on_the_side_of_the_tool() -> None:
    assert offset_end(EAST, 1) == (4, 1)
    assert offset_start(NORTH, 1) == (3, 0)
    assert offset_start(NORTH, -1) == (5, 0)


def test_turns_are_positive_to_the_left() -> None:
    assert turn_angle(EAST, NORTH) == pytest.approx(pi / 2)
    assert turn_angle(EAST, SOUTH) == pytest.approx(-pi / 2)


def test_the_miter_is_the_intersection_of_extended_offsets() -> None:
    assert miter((4, 0), (1, 0), -pi / 2, 1) == pytest.approx((5, 1))
    assert miter((4, 0), (1, 0), pi / 2, -1) == pytest.approx((5, -1))


def test_offsets_of_lines_meet_at_an_inside_corner() -> None:
    assert meeting(EAST, NORTH, 1) == pytest.approx((3, 1))


def test_offsets_of_a_line_and_an_arc_meet_nearest_to_the_corner() -> None:
    inside = arc(4, 0, 4, 6, 4, 3, 1)
    assert meeting(EAST, inside, 1) == pytest.approx((4, 1))
    hill = arc(4, 0, 8, 0, 6, 0, -1)
    point = meeting(EAST, hill, 1)
    assert point == pytest.approx((6 - sqrt(9 - 1), 1))


def test_offsets_of_two_arcs_meet() -> None:
    first, second = arc(1, 0, 1.4, -0.8, 2, 0, 1), arc(1.4, -0.8, 1.8, 0, 0.8, 0, 1)
    assert meeting(first, second, 0.25) == pytest.approx((1.4, -0.45))
    assert len(meetings(first, second, 0.25, 0.25)) == 2


def test_offsets_that_do_not_meet_have_no_intersection() -> None:
    assert meeting(EAST, line(4, 0, 8, 0), 1) is None
    assert meeting(EAST, arc(4, 0, 4, 1, 4, 0.5, 1), 1) is None
    assert meeting(arc(0, 0, 2, 0, 1, 0, 1), arc(9, 0, 11, 0, 10, 0, 1), -1) is None


def test_offset_radii_shrink_inside_and_grow_outside() -> None:
    circle = arc(2, 0, 2, 0, 0, 0, 1)
    assert (offset_radius(circle, 0.5), offset_radius(circle, -0.5)) == (1.5, 2.5)
    assert fits(circle, 1.99)
    assert not fits(circle, 2.0)
    assert not fits(circle, 2.0 - 1e-9)
    assert element_sweep(circle) == pytest.approx(2 * pi)


def test_backward_lines_and_arcs_are_recognized() -> None:
    assert runs_back(EAST, (3, 1), (2, 1))
    assert not runs_back(EAST, (2, 1), (3, 1))
    quarter = arc(2, 0, 0, 2, 0, 0, 1)
    assert runs_back(quarter, rotated((1, 0), (0, 0), 1.0), rotated((1, 0), (0, 0), 0.9))
    assert not runs_back(quarter, rotated((1, 0), (0, 0), 0.9), rotated((1, 0), (0, 0), 1.0))
    assert not runs_back(quarter, rotated((1, 0), (0, 0), -0.5), rotated((1, 0), (0, 0), 2.0))


@pytest.mark.parametrize("turn", [1, -1])
@pytest.mark.parametrize(
    ("start", "end", "back"), [(200, 30, True), (200, 190, True), (30, 240, False), (190, 200, False)]
)
def test_an_arc_trimmed_past_itself_runs_backwards(turn: int, start: int, end: int, back: bool) -> None:
    three_quarters = arc(2, 0, 0, -2 * turn, 0, 0, turn)
    first, last = (rotated((2, 0), (0, 0), turn * radians(angle)) for angle in (start, end))
    assert runs_back(three_quarters, first, last) is back


def round_corner(angle: float, offset: float, rules: CornerRules, *, rapid: bool = False) -> Joint:
    """The joint of a line east to 4, 0 and a line that continues at an angle."""
    second = line_element((4, 0), (4 + 4 * cos(angle), 4 * sin(angle)), 0.0, 0.0, rapid=rapid, feed=1.0, line=2)
    return join(EAST, second, offset, rules)


@pytest.mark.parametrize("angle", [radians(degrees) for degrees in (-175, -120, -90, -30, 30, 90, 120, 175)])
@pytest.mark.parametrize("offset", [-1.0, 1.0])
def test_the_default_rules_round_outside_corners_and_meet_at_inside_corners(angle: float, offset: float) -> None:
    joint = round_corner(angle, offset, CornerRules())
    if angle * offset > 0.0:
        reach = tan(abs(angle) / 2)
        assert joint.corner is CornerKind.INSIDE
        assert joint.end == joint.start == pytest.approx((4 - reach, offset))
    else:
        assert joint.corner is CornerKind.OUTSIDE
        assert joint.center == (4, 0)
        assert joint.end == pytest.approx((4, offset))
        assert joint.start == pytest.approx((4 - offset * sin(angle), offset * cos(angle)))
        assert joint.moves == 1


@pytest.mark.parametrize(("angle", "moves"), [(-60, 0), (-90, 0), (-120, 1)])
def test_generated_lines_extend_both_offsets(angle: float, moves: int) -> None:
    joint = round_corner(radians(angle), 1.0, CornerRules(outside=Outside.LINES))
    assert joint.end == pytest.approx((4 + (tan(radians(-angle) / 2) if angle >= -90 else 1.0), 1.0))
    assert joint.moves == moves
    assert joint.center is None


def test_an_arc_replaces_generated_lines_between_lines_only() -> None:
    rules = CornerRules(outside=Outside.MITER_OR_ARC)
    assert round_corner(radians(-120), 1.0, rules).center == (4, 0)
    assert round_corner(radians(-60), 1.0, rules).center is None
    sharp = join(EAST, arc(4, 0, 4, 2, 4, 1, 1), -1.0, rules)
    assert sharp.center is None
    assert join(EAST, arc(4, 0, 0, 0, 2, -2, -1), 1.0, rules).center is None


def test_outside_corners_may_meet_and_inside_corners_may_stay_open() -> None:
    met = round_corner(radians(-60), 1.0, CornerRules(outside=Outside.MEETING))
    assert met.end == met.start == pytest.approx((4 + tan(radians(30)), 1.0))
    opened = round_corner(radians(60), 1.0, CornerRules(inside=Inside.OPEN))
    assert opened.end == (4, 1)
    assert opened.start == pytest.approx((4 - sin(radians(60)), 0.5))
    assert opened.moves == 1


def test_a_rapid_may_go_straight_across_an_outside_corner() -> None:
    rules = CornerRules(rapid_straight=True)
    assert round_corner(radians(-90), 1.0, rules, rapid=True).center is None
    assert round_corner(radians(-90), 1.0, rules, rapid=True).moves == 1
    assert round_corner(radians(-90), 1.0, rules).center == (4, 0)


@pytest.mark.parametrize(
    ("angle", "kind"), [(0.04, CornerKind.TANGENT), (-0.04, CornerKind.TANGENT), (0.06, CornerKind.INSIDE)]
)
def test_a_corner_below_the_tangent_angle_is_tangent(angle: float, kind: CornerKind) -> None:
    joint = round_corner(angle, 1.0, CornerRules(tangent=0.05))
    assert joint.corner is kind
    assert joint.end == joint.start


def test_a_reversal_is_an_outside_corner_except_onto_an_arc_with_hooks() -> None:
    back = line(4, 0, 0, 0)
    assert [join(EAST, back, offset, CornerRules()).corner for offset in (1.0, -1.0)] == [CornerKind.OUTSIDE] * 2
    onto = arc(4, 0, 3, 1, 4, 1, -1)
    hooks = CornerRules(reversal=0.05, hooks=True, inside=Inside.BY_SIDE)
    assert join(EAST, onto, 1.0, hooks).corner is CornerKind.INSIDE
    assert join(EAST, onto, 1.0, hooks._replace(hooks=False)).corner is CornerKind.OUTSIDE


def test_offsets_that_miss_each_other_at_an_inside_corner_are_marked() -> None:
    joint = join(EAST, arc(4, 0, 4, 1, 4, 0.5, 1), 1.0, CornerRules(tangent=0.0))
    assert joint.corner is CornerKind.TANGENT
    missed = join(EAST, arc(4, 0, 4, 1, 3.9, 0.5, 1), 1.0, CornerRules())
    assert missed.missed
    assert missed.end == (4, 1)


def test_two_arcs_of_one_circle_with_rounded_centers_join_at_their_common_point() -> None:
    """The offsets meet 0.134 mm along the circle; both run through the same point to a tenth of a micrometer."""
    first = arc(46.752, -21.963, 40.496, -31.554, -13.37, 10.421, -1)
    second = arc(40.496, -31.554, 38.683, -33.783, -13.371, 10.419, -1)
    assert dist(meeting(first, second, 3.0) or (0.0, 0.0), offset_end(first, 3.0)) > 0.1
    joint = join(first, second, 3.0, CornerRules())
    assert joint.end == joint.start == offset_end(first, 3.0)
    assert joint.corner is corner_kind(first, second, 3.0, CornerRules()) is CornerKind.INSIDE
    assert dist(joint.end, offset_start(second, 3.0)) < 1e-4
