"""A LINE from its own fields and its start.

Order of two solutions (one end coordinate and XY LENGTH): the one with the greater other coordinate first.
"""

from __future__ import annotations

from math import atan2, cos, pi, sin, tau
from typing import assert_never

from core.finding import Finding
from core.geometry import construct
from core.geometry.construct import BehindStart, OnePoint, OutOfReach, TwoPoints
from core.geometry.piece import Line, Piece, Point
from core.program.fields import Form
from core.program.solve.rules import Answer, Beside, Known, Rule, Task, lines_to, wrong
from core.tolerance import AGREES, ARC_RADII
from core.units import Kind, Unit, from_radians, show

_END = ("x_end", "y_end")


def _to_end(start: Point, known: Known) -> Answer:
    return (Line(start, (known["x_end"], known["y_end"])),)


def _polar(start: Point, known: Known) -> Answer:
    return (Line(start, construct.polar(start, known["angle"], known["length"])),)


def _along(axis: int, start: Point, known: Known) -> Answer:
    """Along the angle to one end coordinate."""
    value, angle = known[_END[axis]], known["angle"]
    end = construct.reach(start, angle, axis, value)
    label = f"{'XY'[axis]} END"
    match end:
        case OnePoint():
            return lines_to(start, end)
        case construct.NotDetermined() if "length" in known or abs(value - start[axis]) <= ARC_RADII:
            return Beside()
        case construct.NotDetermined():
            kept = f"XY ANGLE {degrees(angle)} keeps {'XY'[axis]} at {{0}} and never comes to {label} {{1}}"
            return wrong("CONTRADICTION", f"{kept}: correct one of them.", "angle", start[axis], value)
        case BehindStart():
            text = f"XY ANGLE {degrees(angle)} leads away from {label} {{0}}: correct one of them."
            return wrong("CONTRADICTION", text, "angle", value)
        case _:
            assert_never(end)


def _long(axis: int, start: Point, known: Known) -> Answer:
    """As long as typed, to one end coordinate."""
    value, length = known[_END[axis]], known["length"]
    ends = construct.on_circle(start, length, axis, value)
    match ends:
        case OnePoint() | TwoPoints():
            return lines_to(start, ends)
        case OutOfReach(least):
            text = f"XY LENGTH {{0}} does not reach {'XY'[axis]} END {{1}}: it takes at least {{2}}."
            return wrong("CONTRADICTION", text, "length", length, value, least)
        case _:
            assert_never(ends)


def degrees(angle: float) -> str:
    """An angle as the form shows it."""
    return show(from_radians(angle), Kind.ANGLE, Unit.IN)


def heading(line: Line) -> float:
    """Direction of a line in radians, from 0 up to a full turn."""
    angle = atan2(line.end[1] - line.start[1], line.end[0] - line.start[0])
    return angle + tau if angle < 0.0 else angle


def between(one: float, other: float) -> float:
    """The angle between two directions, at most half a turn."""
    return abs((one - other + pi) % tau - pi)


def _disagrees(piece: Piece, name: str, value: float) -> Finding | None:
    assert isinstance(piece, Line)
    if name == "angle":
        off = between(heading(piece), value)
        if off <= AGREES or (piece.length * off <= ARC_RADII):
            return None
        return wrong("CONTRADICTION", f"XY ANGLE is {degrees(value)}, but {degrees(heading(piece))}", name)
    found = piece.length if name == "length" else piece.end[_END.index(name)]
    if abs(found - value) <= ARC_RADII:
        return None
    return wrong("CONTRADICTION", f"{TASK.label(name)} is {{0~1}}, but {{1~0}}", name, value, found)


TASK = Task(
    Form.LINE,
    ("x_end", "y_end", "length", "angle"),
    (
        Rule(frozenset(("x_end", "y_end")), _to_end),
        Rule(frozenset(("x_end", "angle")), lambda start, known: _along(0, start, known)),
        Rule(frozenset(("y_end", "angle")), lambda start, known: _along(1, start, known)),
        Rule(frozenset(("length", "angle")), _polar),
        Rule(frozenset(("x_end", "length")), lambda start, known: _long(0, start, known)),
        Rule(frozenset(("y_end", "length")), lambda start, known: _long(1, start, known)),
    ),
    _disagrees,
    "enter X END and Y END, or XY LENGTH and XY ANGLE, or one end and one of these",
)


def sketch(start: Point, known: Known) -> Line | None:
    """What to draw dashed of a line that is not determined: towards what is typed of its end."""
    end = (known.get("x_end", start[0]), known.get("y_end", start[1]))
    if end == start and "length" in known and "angle" in known:
        end = (start[0] + known["length"] * cos(known["angle"]), start[1] + known["length"] * sin(known["angle"]))
    return None if end == start else Line(start, end)
