"""This module solves a LINE from its own fields and its start.

If two solutions fit (one end coordinate and XY LENGTH), the one with the greater other coordinate comes first.
"""

from __future__ import annotations

from functools import partial
from math import cos, degrees, pi, sin, tau
from typing import assert_never

from core.finding import Finding
from core.geometry import construct
from core.geometry.construct import OnePoint, OppositeDirection, OutOfReach, TwoPoints
from core.geometry.piece import Line, Piece, Point
from core.program.fields import LINE, Form
from core.program.model import LineSegment, Unread
from core.program.solve.measured import measured
from core.program.solve.rules import Given, Known, Outcome, Rule, Task, contradiction, fault
from core.tolerance import AGREES, ARC_RADII
from core.units import Kind, Unit, show

_END = ("x_end", "y_end")


def _to_end(given: Given) -> Outcome:
    return _lines(given.start, (given.known["x_end"], given.known["y_end"]))


def _polar(given: Given) -> Outcome:
    return _lines(given.start, construct.polar(given.start, given.known["angle"], given.known["length"]))


def _along(axis: int, given: Given) -> Outcome | None:
    """Solve a line along XY ANGLE to one end coordinate; None if the angle leaves the end open."""
    start, known = given.start, given.known
    value, angle = known[_END[axis]], known["angle"]
    end = construct.ray_to_coordinate(start, angle, axis, value)
    label = f"{'XY'[axis]} END"
    match end:
        case OnePoint(point):
            return _lines(start, point)
        case construct.NotDetermined() if "length" in known or abs(value - start[axis]) <= ARC_RADII:
            return None
        case construct.NotDetermined():
            text = f"XY ANGLE {angle_text(angle)} holds {'XY'[axis]} at {{0~1}}: it never reaches {label} {{1~0}}"
            return contradiction(f"{text}. Correct one of them.", "angle", start[axis], value)
        case OppositeDirection():
            text = f"XY ANGLE {angle_text(angle)} leads away from {label} {{0}}. Correct one of them."
            return contradiction(text, "angle", value)
        case _:
            assert_never(end)


def _long(axis: int, given: Given) -> Outcome:
    """Solve a line of the typed XY LENGTH to one end coordinate."""
    value, length = given.known[_END[axis]], given.known["length"]
    ends = construct.on_circle(given.start, length, axis, value)
    if isinstance(ends, OutOfReach):
        text = f"XY LENGTH {{0~2}} does not reach {'XY'[axis]} END {{1}}: it takes at least {{2+}}."
        return contradiction(text, "length", length, value, ends.least)
    return _lines(given.start, *points_of(ends))


def points_of(ends: OnePoint | TwoPoints) -> tuple[Point, ...]:
    """Return the points of a construction, in its documented order."""
    return (ends.point,) if isinstance(ends, OnePoint) else (ends.first, ends.second)


def _lines(start: Point, *ends: Point) -> Outcome:
    return Outcome(tuple(Line(start, end) for end in ends))


def kept_axis(segment: LineSegment) -> int | None:
    """Return the axis (0 is X) whose coordinate a LINE keeps: its only typed shape field is the other end coordinate.

    Return None if any other shape field is typed, or both end coordinates are blank.
    """
    shape = [field.name for field in LINE if field.name not in ("z_end", "feed")]
    typed = [name for name in shape if getattr(segment, name) not in (None, False)]
    if len(typed) != 1 or typed[0] not in _END or isinstance(getattr(segment, typed[0]), Unread):
        return None
    return 1 - _END.index(typed[0])


def angle_text(angle: float) -> str:
    """Format an angle as the form shows it."""
    return show(degrees(angle), Kind.ANGLE, Unit.IN)


def counted_like(angle: float, typed: float) -> float:
    """Return a direction as the angle within half a turn of a typed one: 295 is -65 beside a typed -30."""
    return typed + (angle - typed + pi) % tau - pi


def _disagreement(piece: Piece, name: str, value: float) -> Finding | None:
    solved = measured(piece)[name]
    if name == "angle":
        actual = counted_like(solved, value)
        off = abs(actual - value)
        if off <= AGREES or piece.length * off <= ARC_RADII:
            return None
        return fault("CONTRADICTION", f"XY ANGLE is {angle_text(value)}, but {angle_text(actual)}", name)
    if abs(solved - value) <= ARC_RADII:
        return None
    return fault("CONTRADICTION", f"{LINE_TASK.label(name)} is {{0~1}}, but {{1~0}}", name, value, solved)


LINE_TASK = Task(
    Form.LINE,
    ("x_end", "y_end", "length", "angle"),
    (
        Rule(frozenset(("x_end", "y_end")), _to_end),
        Rule(frozenset(("x_end", "angle")), partial(_along, 0)),
        Rule(frozenset(("y_end", "angle")), partial(_along, 1)),
        Rule(frozenset(("length", "angle")), _polar),
        Rule(frozenset(("x_end", "length")), partial(_long, 0)),
        Rule(frozenset(("y_end", "length")), partial(_long, 1)),
    ),
    _disagreement,
    "type X END and Y END, or XY LENGTH and XY ANGLE, or one end and one of these.",
)


def sketch_of(start: Point, known: Known) -> Line | None:
    """Return the line or chord to draw dashed for an undetermined segment, toward as much of its end as is typed."""
    end = (known.get("x_end", start[0]), known.get("y_end", start[1]))
    if end == start and "length" in known and "angle" in known:
        end = (start[0] + known["length"] * cos(known["angle"]), start[1] + known["length"] * sin(known["angle"]))
    return None if end == start else Line(start, end)
