"""This module is the calculator of a length or angle field: it gets a missing number from those on a drawing.

Each case of everyday shop work accepts texts as a field does (`1 1/2`, `25.4/2`, `12.7mm`), so that they stay as typed,
and returns every answer in a fixed order.  Lengths are in program units, angles in degrees, counterclockwise from +X.
Formulas: the right triangle; the tangent from a point to a circle, of length sqrt(d^2 - r^2); the division of a circle;
the intersections of lines and circles.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import asin, atan, atan2, cos, degrees, hypot, inf, radians, sin, sqrt, tan, tau
from typing import Final

from core.geometry.oriented import Circle, Locus, headings_at_distances, line_through, meeting
from core.geometry.piece import Point
from core.units import KEPT_DECIMALS, Kind, Unit, Unreadable, from_mm, parse, to_mm

Numbers = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of a case: its name, the label that the operator reads, and its kind."""

    name: str
    label: str
    kind: Kind


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why there is no answer: the sentence, and the name of the input at fault, None for all of them."""

    text: str
    name: str | None = None


Answers = tuple[Numbers, ...]
"""Every answer of a case: each maps output names to values, in program units and degrees."""


@dataclass(frozen=True, slots=True)
class Case:
    """One case: its inputs, its outputs, and how to calculate them."""

    name: str
    inputs: tuple[Quantity, ...]
    outputs: tuple[Quantity, ...]
    solve: Callable[[Numbers], Answers | Refusal]
    """Takes and returns millimeters and radians."""
    optional: bool = False
    """True if inputs may stay blank: for a triangle or an arc, any two are typed."""


def _lengths(**labels: str) -> tuple[Quantity, ...]:
    return tuple(Quantity(name, label, Kind.LENGTH) for name, label in labels.items())


def _angle(name: str, label: str) -> Quantity:
    return Quantity(name, label, Kind.ANGLE)


def calculate(case: Case, typed: Mapping[str, str], unit: Unit) -> Answers | Refusal:
    """Return the answers of a case for these input texts, or why there are none; blanks may be left out."""
    known: dict[str, float] = {}
    for quantity in case.inputs:
        text = typed.get(quantity.name, "")
        if not text.strip():
            if not case.optional:
                return Refusal(f"{quantity.label} is blank: enter it.", quantity.name)
            continue
        value = parse(text, quantity.kind, unit)
        if isinstance(value, Unreadable):
            return Refusal(f"{quantity.label}: {value.reason}", quantity.name)
        known[quantity.name] = _inside(value, quantity.kind, unit)
    if not case.optional and min(known.get("radius", 1.0), known.get("radius2", 1.0)) <= 0.0:
        return Refusal("RADIUS must be above 0.", "radius")
    answers = case.solve(known)
    return answers if isinstance(answers, Refusal) else tuple(_outside(case, answer, unit) for answer in answers)


def _inside(value: float, kind: Kind, unit: Unit) -> float:
    return to_mm(value, unit) if kind is Kind.LENGTH else radians(value) if kind is Kind.ANGLE else value


def _outside(case: Case, answer: Numbers, unit: Unit) -> Numbers:
    kinds = {quantity.name: quantity.kind for quantity in case.outputs}
    return {
        name: from_mm(value, unit) if kinds[name] is Kind.LENGTH else degrees(value)
        for name, value in answer.items()
        if name in kinds
    }


def field_text(value: float, unit: Unit) -> str:
    """Format an answer for a field, with as many decimals as a unit conversion keeps, without trailing zeros."""
    text = f"{value:.{KEPT_DECIMALS[unit]}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


# the right triangle and the arc


def _triangle(known: Numbers) -> Answers | Refusal:
    """Solve a right triangle from two of its legs, its hypotenuse and the angle between first leg and hypotenuse."""
    fault = _two_of("Enter two of the four: two sides, or a side and the angle.", known)
    if fault is not None:
        return fault
    if known.get("angle", 0.0) >= tau / 4.0:
        return Refusal("The angle of a right triangle is below 90.", "angle")
    if max(known.get("adjacent", 0.0), known.get("opposite", 0.0)) >= known.get("hypotenuse", inf):
        return Refusal("The hypotenuse is the longest side.", "hypotenuse")
    a, b = _legs(known)
    return ({"adjacent": a, "opposite": b, "hypotenuse": hypot(a, b), "angle": atan2(b, a)},)


def _two_of(advice: str, known: Numbers) -> Refusal | None:
    if len(known) != 2:
        return Refusal(advice)
    return Refusal("Each must be above 0.") if min(known.values()) <= 0.0 else None


def _legs(known: Numbers) -> tuple[float, float]:
    """Return the adjacent and the opposite leg of a right triangle, from two of its four numbers."""
    match known:
        case {"adjacent": a, "opposite": b}:
            return a, b
        case {"hypotenuse": c, "adjacent": a}:
            return a, sqrt((c - a) * (c + a))
        case {"hypotenuse": c, "opposite": b}:
            return sqrt((c - b) * (c + b)), b
        case {"adjacent": a, "angle": t}:
            return a, a * tan(t)
        case {"opposite": b, "angle": t}:
            return b / tan(t), b
        case _:
            return known["hypotenuse"] * cos(known["angle"]), known["hypotenuse"] * sin(known["angle"])


def _arc(known: Numbers) -> Answers | Refusal:
    """Solve an arc from two of radius, chord, height over the chord and sweep; a radius and a chord fit two arcs."""
    fault = _two_of("Enter two of the four: radius, chord, height, sweep.", known)
    if fault is not None:
        return fault
    if known.get("sweep", 0.0) >= tau:
        return Refusal("The sweep is below 360.", "sweep")
    diameter = 2.0 * known.get("radius", inf)
    if known.get("chord", 0.0) > diameter:
        return Refusal("The chord is longer than the diameter.", "chord")
    if known.get("height", 0.0) >= diameter:
        return Refusal("The height is below the diameter.", "height")
    return tuple(_arc_numbers(radius, sweep) for radius, sweep in dict.fromkeys(_radii_and_sweeps(known)))


def _radii_and_sweeps(known: Numbers) -> tuple[tuple[float, float], ...]:
    """Return each radius and sweep that fit two of an arc's four numbers."""
    match known:
        case {"radius": r, "chord": c}:
            half = asin(c / (2.0 * r))
            return (r, 2.0 * half), (r, tau - 2.0 * half)
        case {"radius": r, "height": h}:
            return ((r, 4.0 * asin(sqrt(h / (2.0 * r)))),)
        case {"chord": c, "height": h}:
            return ((h / 2.0 + c * c / (8.0 * h), 4.0 * atan(2.0 * h / c)),)
        case {"radius": r, "sweep": s}:
            return ((r, s),)
        case {"chord": c, "sweep": s}:
            return ((c / (2.0 * sin(s / 2.0)), s),)
        case _:
            return ((known["height"] / (2.0 * sin(known["sweep"] / 4.0) ** 2), known["sweep"]),)


def _arc_numbers(radius: float, sweep: float) -> Numbers:
    half = sweep / 2.0
    chord, height = 2.0 * radius * sin(half), 2.0 * radius * sin(half / 2.0) ** 2
    return {"radius": radius, "chord": chord, "height": height, "sweep": sweep, "length": radius * sweep}


# points


def _tangent(known: Numbers) -> Answers | Refusal:
    """Return the two tangents from a point to a circle: first the one with the circle on its left."""
    point, center, radius = _point(known, "x", "y"), _point(known, "x_center", "y_center"), known["radius"]
    answers = []
    for rho in (radius, -radius):
        headings, _ = headings_at_distances(point, 0.0, center, rho)
        if not headings:
            return Refusal("The point lies inside the circle: no line from it is tangent.", "x")
        heading = headings[0]
        x, y = center[0] + rho * sin(heading), center[1] - rho * cos(heading)
        length = hypot(x - point[0], y - point[1])
        answers.append({"x_touch": x, "y_touch": y, "angle": heading % tau, "length": length})
    return tuple(answers)


def _polar(known: Numbers) -> Answers | Refusal:
    """Return the point at a length and an angle from a point."""
    x, y = _point(known, "x", "y")
    angle, length = known["angle"], known["length"]
    return ({"x_end": x + length * cos(angle), "y_end": y + length * sin(angle)},)


def _bolt_circle(known: Numbers) -> Answers | Refusal:
    """Return one hole of a bolt circle; hole 1 is at the start angle, the others follow counterclockwise."""
    count, hole = known["count"], known["hole"]
    if not 1 <= count <= 9999:
        return Refusal("HOLES must be from 1 to 9999.", "count")
    if not 1 <= hole <= count:
        return Refusal(f"HOLE must be from 1 to {count:.0f}.", "hole")
    if known["diameter"] <= 0.0:
        return Refusal("DIAMETER must be above 0.", "diameter")
    angle = known["start_angle"] + tau * (hole - 1.0) / count
    x, y = _point(known, "x_center", "y_center")
    radius = known["diameter"] / 2.0
    return ({"x_hole": x + radius * cos(angle), "y_hole": y + radius * sin(angle), "angle": angle % tau},)


def _two_lines(known: Numbers) -> Answers | Refusal:
    first = line_through(_point(known, "x", "y"), known["angle"])
    return _meetings(first, line_through(_point(known, "x2", "y2"), known["angle2"]))


def _line_and_circle(known: Numbers) -> Answers | Refusal:
    circle = Circle(_point(known, "x_center", "y_center"), known["radius"])
    return _meetings(line_through(_point(known, "x", "y"), known["angle"]), circle)


def _two_circles(known: Numbers) -> Answers | Refusal:
    first = Circle(_point(known, "x_center", "y_center"), known["radius"])
    return _meetings(first, Circle(_point(known, "x_center2", "y_center2"), known["radius2"]))


def _point(known: Numbers, x: str, y: str) -> Point:
    return known[x], known[y]


def _meetings(first: Locus, second: Locus) -> Answers | Refusal:
    met = meeting(first, second)
    if met.coincident:
        return Refusal("Both are the same: they meet everywhere.")
    if not met.points:
        return Refusal("They never meet.")
    return tuple({"x_meet": x, "y_meet": y} for x, y in met.points)


_MEET: Final = _lengths(x_meet="X", y_meet="Y")
_LINE: Final = (*_lengths(x="X OF A POINT", y="Y OF A POINT"), _angle("angle", "XY ANGLE"))
_CIRCLE: Final = _lengths(x_center="X CENTER", y_center="Y CENTER", radius="RADIUS")
_TRIANGLE: Final = (
    *_lengths(adjacent="SIDE AT THE ANGLE", opposite="SIDE ACROSS", hypotenuse="HYPOTENUSE"),
    _angle("angle", "ANGLE"),
)
_ARC: Final = (*_lengths(radius="RADIUS", chord="CHORD", height="HEIGHT"), _angle("sweep", "SWEEP ANGLE"))

CASES: Final = (
    Case("RIGHT TRIANGLE", _TRIANGLE, _TRIANGLE, _triangle, optional=True),
    Case("ARC", _ARC, (*_ARC, *_lengths(length="ARC LENGTH")), _arc, optional=True),
    Case(
        "TANGENT FROM A POINT",
        (*_lengths(x="X OF THE POINT", y="Y OF THE POINT"), *_CIRCLE),
        (*_lengths(x_touch="X", y_touch="Y"), _angle("angle", "XY ANGLE"), *_lengths(length="XY LENGTH")),
        _tangent,
    ),
    Case(
        "POINT ON A BOLT CIRCLE",
        (
            *_lengths(x_center="X CENTER", y_center="Y CENTER", diameter="DIAMETER"),
            Quantity("count", "HOLES", Kind.COUNT),
            _angle("start_angle", "ANGLE OF HOLE 1"),
            Quantity("hole", "HOLE", Kind.COUNT),
        ),
        (*_lengths(x_hole="X", y_hole="Y"), _angle("angle", "ANGLE")),
        _bolt_circle,
    ),
    Case("POINT BY ANGLE AND LENGTH", (*_LINE, *_lengths(length="XY LENGTH")), _lengths(x_end="X", y_end="Y"), _polar),
    Case(
        "TWO LINES MEET",
        (*_LINE, *_lengths(x2="X ON THE SECOND", y2="Y ON THE SECOND"), _angle("angle2", "ITS XY ANGLE")),
        _MEET,
        _two_lines,
    ),
    Case("LINE MEETS CIRCLE", (*_LINE, *_CIRCLE), _MEET, _line_and_circle),
    Case(
        "TWO CIRCLES MEET",
        (
            *_CIRCLE,
            *_lengths(x_center2="X CENTER OF THE SECOND", y_center2="Y CENTER OF THE SECOND", radius2="ITS RADIUS"),
        ),
        _MEET,
        _two_circles,
    ),
)
"""The cases, in the order that a screen lists them."""


def outputs_for(case: Case, kind: Kind) -> tuple[Quantity, ...]:
    """Return the outputs of a case that a field of this kind accepts: lengths for a length, angles for an angle."""
    return tuple(quantity for quantity in case.outputs if quantity.kind is kind)
