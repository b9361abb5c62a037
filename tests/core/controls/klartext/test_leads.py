"""APPR and DEP as plain geometry: every form, side and sign by hand, and what holds for all of them."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin, sqrt, tau

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core.controls.klartext.lead_curves import Curve, Lead, LeadShape, approach, departure
from core.geometry.piece import Point

EAST = (1.0, 0.0)
HERE = (0.0, 0.0)
FAR = (-30.0, 40.0)
QUARTER = radians(90)


def near(curve: Curve | None, point: Point, center: Point, turn: int) -> bool:
    assert curve is not None
    told = (*curve.point, *curve.center, curve.turn)
    return told == pytest.approx((*point, *center, turn), abs=1e-9)


@pytest.mark.parametrize("hand", [1, -1])
def test_lt_begins_before_the_contour_on_either_side(hand: int) -> None:
    assert near(approach(Lead(LeadShape.LT, 15), FAR, HERE, EAST, hand), (-15, 0), (-15, 0), 0)
    assert near(departure(Lead(LeadShape.LT, 15), HERE, FAR, EAST, hand), (15, 0), (15, 0), 0)


@pytest.mark.parametrize(("hand", "y"), [(1, 15), (-1, -15)])
def test_ln_begins_next_to_the_contour_on_the_tools_side(hand: int, y: float) -> None:
    assert near(approach(Lead(LeadShape.LN, 15), FAR, HERE, EAST, hand), (0, y), (0, y), 0)
    assert near(departure(Lead(LeadShape.LN, 15), HERE, FAR, EAST, hand), (0, y), (0, y), 0)


@pytest.mark.parametrize(
    ("hand", "radius", "point", "center", "turn"),
    [
        (1, 8, (-8, 8), (0, 8), 1),
        (1, -8, (-8, -8), (0, -8), -1),
        (-1, 8, (-8, -8), (0, -8), -1),
        (-1, -8, (-8, 8), (0, 8), 1),
    ],
)
def test_ct_by_side_and_sign_of_r(hand: int, radius: float, point: Point, center: Point, turn: int) -> None:
    lead = Lead(LeadShape.CT, radius=radius, angle=QUARTER)
    assert near(approach(lead, FAR, HERE, EAST, hand), point, center, turn)
    assert near(departure(lead, HERE, FAR, EAST, hand), (-point[0], point[1]), center, turn)


def test_ct_over_a_full_turn_begins_exactly_where_it_ends() -> None:
    curve = approach(Lead(LeadShape.CT, radius=8, angle=tau), FAR, (1 / 3, 1 / 7), (sqrt(0.5), sqrt(0.5)), 1)
    assert curve is not None
    assert curve.point == (1 / 3, 1 / 7)
    assert curve.turn == 1


@pytest.mark.parametrize(("hand", "y"), [(1, 10), (-1, -10)])
def test_lct_from_the_tangent_before_its_circle(hand: int, y: float) -> None:
    # Seen from the center (0, y) the start lies 10 sqrt 2 away at 180 degrees, so that PH is 45 degrees on.
    start = (-10 * sqrt(2), y)
    point = (-10 * cos(pi / 4), y - hand * 10 * sin(pi / 4))
    assert near(approach(Lead(LeadShape.LCT, radius=10), start, HERE, EAST, hand), point, (0, y), hand)
    back = (-start[0], start[1])
    assert near(departure(Lead(LeadShape.LCT, radius=10), HERE, back, EAST, hand), (-point[0], point[1]), (0, y), hand)


def test_lct_from_straight_before_the_contour_needs_no_arc() -> None:
    curve = approach(Lead(LeadShape.LCT, radius=10), (-40.0, 0.0), HERE, EAST, 1)
    assert curve == Curve(HERE, HERE, 0)


def test_lct_inside_its_circle_has_no_line() -> None:
    assert approach(Lead(LeadShape.LCT, radius=10), (-3.0, 9.0), HERE, EAST, 1) is None
    assert departure(Lead(LeadShape.LCT, radius=10), HERE, (3.0, 9.0), EAST, 1) is None


def test_lct_on_its_circle_has_only_the_arc() -> None:
    assert near(approach(Lead(LeadShape.LCT, radius=10), (-10.0, 10.0), HERE, EAST, 1), (-10, 10), (0, 10), 1)


@pytest.mark.parametrize("heading", [0.0, 0.7, 2.0, 4.0])
@pytest.mark.parametrize(("start", "turn"), [((-30.0, 20.0), 1), ((-30.0, -20.0), -1)])
def test_lct_without_compensation_curves_on_the_side_of_its_start(start: Point, turn: int, heading: float) -> None:
    along, across = (cos(heading), sin(heading)), (-sin(heading), cos(heading))
    turned = tuple(start[0] * along[axis] + start[1] * across[axis] for axis in (0, 1))
    curve = approach(Lead(LeadShape.LCT, radius=10), (turned[0], turned[1]), HERE, along, 0)
    assert curve is not None
    assert curve.turn == turn


SPOT = st.floats(-50, 50)
LCT = Lead(LeadShape.LCT, radius=7.0)


@given(SPOT, SPOT, st.floats(0, tau), st.sampled_from([1, -1]))
def test_an_lct_is_smooth_wherever_it_starts(x: float, y: float, heading: float, hand: int) -> None:
    way = (cos(heading), sin(heading))
    curve = approach(LCT, (x, y), HERE, way, hand)
    assume(curve is not None)
    assert curve is not None
    assume(curve.turn)
    (px, py), (cx, cy) = curve.point, curve.center
    assert hypot(px - cx, py - cy) == pytest.approx(7.0)
    assert hypot(cx, cy) == pytest.approx(7.0)
    line, tangent = (px - x, py - y), (-curve.turn * (py - cy), curve.turn * (px - cx))
    assert line[0] * tangent[1] - line[1] * tangent[0] == pytest.approx(0.0, abs=1e-6)
    assert line[0] * tangent[0] + line[1] * tangent[1] >= -1e-6
    arriving = (curve.turn * cy, -curve.turn * cx)
    assert (arriving[0] / 7, arriving[1] / 7) == pytest.approx(way, abs=1e-9)


@given(st.sampled_from(list(LeadShape)), st.floats(0.1, 6.2), st.floats(0, tau), st.sampled_from([1, -1]))
def test_a_departure_is_an_approach_in_the_mirror(form: LeadShape, angle: float, heading: float, hand: int) -> None:
    lead, start = Lead(form, 9.0, 4.0, angle), (-31.0, 17.0)
    way = (cos(heading), sin(heading))
    come = approach(lead, start, HERE, way, hand)
    # In the mirror of the Y axis the contour runs the other way with the tool on the other hand.
    gone = departure(lead, HERE, (31.0, 17.0), (way[0], -way[1]), hand)
    assert come is not None
    assert gone is not None
    assert gone.point == pytest.approx((-come.point[0], come.point[1]), abs=1e-9)
    assert gone.turn == come.turn
