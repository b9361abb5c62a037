"""The calculator: each case against hand calculation, and what it refuses."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin, sqrt
from typing import Any

import pytest

from core.program.calculator import CASES, Case, Refusal, calculate, field_text, outputs_for
from core.units import Kind, Unit


def case(name: str) -> Case:
    return next(each for each in CASES if each.name == name)


def answers(name: str, unit: Unit = Unit.MM, /, **typed: Any) -> list[dict[str, float]]:
    results = calculate(case(name), {key: str(value) for key, value in typed.items()}, unit)
    assert not isinstance(results, Refusal), results
    return [dict(answer) for answer in results]


def refusal(name: str, **typed: Any) -> str:
    refused = calculate(case(name), {key: str(value) for key, value in typed.items()}, Unit.MM)
    assert isinstance(refused, Refusal)
    return refused.text


CIRCLE = {"x_center": 0, "y_center": 0, "radius": 5}
HOLE = {"x_center": 0, "y_center": 0, "diameter": 9, "count": 6, "start_angle": 0, "hole": 1}
FULL = {"adjacent": 4.0, "opposite": 3.0, "hypotenuse": 5.0, "angle": 36.86989764584402}


@pytest.mark.parametrize(
    "names",
    [
        ("adjacent", "opposite"),
        ("adjacent", "hypotenuse"),
        ("opposite", "hypotenuse"),
        ("adjacent", "angle"),
        ("opposite", "angle"),
        ("hypotenuse", "angle"),
    ],
)
def test_any_two_give_the_right_triangle(names: tuple[str, str]) -> None:
    (found,) = answers("RIGHT TRIANGLE", Unit.MM, **{name: FULL[name] for name in names})
    assert found == pytest.approx(FULL)


def test_an_arc_of_radius_and_chord_is_short_or_long() -> None:
    short, long = answers("ARC", radius=5, chord=8)
    assert (short["height"], long["height"]) == pytest.approx((2.0, 8.0))
    assert answers("ARC", chord=8, height=2)[0]["radius"] == pytest.approx(5.0)
    assert answers("ARC", radius=5, height=2)[0]["chord"] == pytest.approx(8.0)
    assert answers("ARC", height=2, sweep=short["sweep"])[0]["radius"] == pytest.approx(5.0)
    assert answers("ARC", radius=5, sweep=180)[0] == pytest.approx(
        {"radius": 5.0, "chord": 10.0, "height": 5.0, "sweep": 180.0, "length": 5.0 * pi}
    )
    assert answers("ARC", chord=8, sweep=short["sweep"])[0]["radius"] == pytest.approx(5.0)


def test_a_height_over_a_sweep_next_to_none_gives_its_arc() -> None:
    (flat,) = answers("ARC", height=0.001, sweep="0.000001")
    assert flat["radius"] == pytest.approx(0.001 / (2.0 * (radians(1e-6) / 4.0) ** 2), rel=1e-9)
    assert flat["height"] == pytest.approx(0.001, rel=1e-9)


@pytest.mark.parametrize(("x", "y"), [(0, 0), (7, -3)])
def test_both_tangents_from_a_point_touch_the_circle_at_a_right_angle(x: int, y: int) -> None:
    left, right = answers("TANGENT FROM A POINT", x=x, y=y, x_center=x + 50, y_center=y + 20, radius=15)
    for found in (left, right):
        way = (found["x_touch"] - x, found["y_touch"] - y)
        assert hypot(way[0] - 50, way[1] - 20) == pytest.approx(15)
        assert way[0] * (way[0] - 50) + way[1] * (way[1] - 20) == pytest.approx(0.0, abs=1e-9)
        assert found["length"] == pytest.approx(sqrt(50**2 + 20**2 - 15**2))
        assert (cos(radians(found["angle"])), sin(radians(found["angle"]))) == pytest.approx(
            (way[0] / found["length"], way[1] / found["length"])
        )
    assert (left["x_touch"], left["y_touch"]) == pytest.approx((x + 51.471076, y + 5.072310), abs=1e-6)


def test_a_hole_of_a_bolt_circle() -> None:
    (found,) = answers("POINT ON A BOLT CIRCLE", x_center=10, y_center=0, diameter=100, count=6, start_angle=30, hole=2)
    assert (found["x_hole"], found["y_hole"], found["angle"]) == pytest.approx((10, 50, 90))


def test_lines_and_circles_meet() -> None:
    (found,) = answers("TWO LINES MEET", x=0, y=0, angle=30, x2=100, y2=0, angle2=300)
    assert (found["x_meet"], found["y_meet"]) == pytest.approx((75, 43.301270), abs=1e-6)
    first, second = answers("LINE MEETS CIRCLE", x=0, y=0, angle=0, x_center=60, y_center=0, radius=15)
    assert (first["x_meet"], second["x_meet"]) == pytest.approx((45, 75))
    left, right = answers("TWO CIRCLES MEET", x_center=0, y_center=0, radius=5, x_center2=8, y_center2=0, radius2=5)
    assert (left["y_meet"], right["y_meet"]) == pytest.approx((3, -3))


def test_sums_and_units_are_typed_as_in_a_field() -> None:
    (found,) = answers("POINT BY ANGLE AND LENGTH", Unit.IN, x="1 1/2", y="25.4mm", angle="45*2", length=".5+.25")
    assert (found["x_end"], found["y_end"]) == pytest.approx((1.5, 1.75))


@pytest.mark.parametrize(
    ("name", "typed", "text"),
    [
        ("RIGHT TRIANGLE", {"adjacent": 3}, "Enter two of the four"),
        ("RIGHT TRIANGLE", {"adjacent": 6, "hypotenuse": 5}, "The hypotenuse is the longest side."),
        ("RIGHT TRIANGLE", {"adjacent": 6, "angle": 90}, "The angle of a right triangle is below 90."),
        ("RIGHT TRIANGLE", {"adjacent": "x", "angle": 3}, "SIDE AT THE ANGLE: "),
        ("ARC", {"radius": 3, "chord": 7}, "The chord is longer than the diameter."),
        ("TANGENT FROM A POINT", {"x": 0, "y": 0, "x_center": 1, "y_center": 0, "radius": 2}, "The point lies inside"),
        ("TANGENT FROM A POINT", {"x": 0}, "Y OF THE POINT is blank: enter it."),
        ("TWO LINES MEET", {"x": 0, "y": 0, "angle": 3, "x2": 0, "y2": 9, "angle2": 183}, "They never meet."),
        ("RIGHT TRIANGLE", {"adjacent": 0, "opposite": 3}, "Each must be above 0."),
        ("ARC", {"radius": 3}, "Enter two of the four"),
        ("ARC", {"radius": 3, "sweep": 360}, "The sweep is below 360."),
        ("ARC", {"radius": 3, "height": 6}, "The height is below the diameter."),
        ("TANGENT FROM A POINT", {"x": 9, "y": 0, **CIRCLE, "radius": 0}, "RADIUS must be above 0."),
        ("POINT ON A BOLT CIRCLE", HOLE | {"count": 0}, "HOLES must be from 1 to 9999."),
        ("POINT ON A BOLT CIRCLE", HOLE | {"count": 10000}, "HOLES must be from 1 to 9999."),
        ("POINT ON A BOLT CIRCLE", HOLE | {"hole": 0}, "HOLE must be from 1 to 6."),
        ("POINT ON A BOLT CIRCLE", HOLE | {"hole": 7}, "HOLE must be from 1 to 6."),
        ("POINT ON A BOLT CIRCLE", HOLE | {"diameter": 0}, "DIAMETER must be above 0."),
        ("LINE MEETS CIRCLE", {"x": 0, "y": 0, "angle": 0, **CIRCLE, "radius": 0}, "RADIUS must be above 0."),
        ("TWO CIRCLES MEET", {**CIRCLE, "x_center2": 8, "y_center2": 0, "radius2": 0}, "RADIUS must be above 0."),
        ("TWO CIRCLES MEET", {**CIRCLE, "x_center2": 0, "y_center2": 0, "radius2": 5}, "Both are the same"),
        ("TWO CIRCLES MEET", {**CIRCLE, "x_center2": 0, "y_center2": 0, "radius2": 4}, "They never meet."),
    ],
)
def test_what_cannot_be_is_refused_with_its_reason(name: str, typed: dict[str, Any], text: str) -> None:
    assert refusal(name, **typed).startswith(text)


def test_an_answer_goes_into_a_field_as_text() -> None:
    assert field_text(1.0 / 3.0, Unit.MM) == "0.33333333"
    assert field_text(-0.0, Unit.IN) == "0"
    assert field_text(12.5, Unit.IN) == "12.5"
    assert [quantity.name for quantity in outputs_for(case("TANGENT FROM A POINT"), Kind.ANGLE)] == ["angle"]
