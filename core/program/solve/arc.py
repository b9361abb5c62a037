"""An ARC from its own fields and its start.

SWEEP ANGLE is the angle turned through in the arc's DIRECTION, always positive; an end on the start is the full
circle (`core.program.solve.full_circle`).  Order of two solutions: by SWEEP ANGLE, the shorter arc first.
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, tau
from typing import assert_never

from core.finding import Finding
from core.geometry import construct
from core.geometry.construct import OnePoint, OutOfReach, TwoPoints
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.program.fields import Form
from core.program.model import Direction
from core.program.solve.full_circle import center_needed, comes_back
from core.program.solve.line import degrees
from core.program.solve.rules import Answer, Beside, Known, Rule, Task, wrong
from core.tolerance import AGREES, ARC_RADII, CLOSED, JOINED

_END = ("x_end", "y_end")
_CENTER = ("x_center", "y_center")
Solver = Callable[[Turn, Point, Known], Answer]


def turn_of(direction: Direction) -> Turn:
    """The geometry's word for DIRECTION."""
    return Turn.CW if direction is Direction.CW else Turn.CCW


def _end(known: Known) -> Point:
    return known["x_end"], known["y_end"]


def _center(known: Known) -> Point:
    return known["x_center"], known["y_center"]


def _radius(start: Point, center: Point) -> float | Finding:
    radius = hypot(start[0] - center[0], start[1] - center[1])
    if radius > JOINED:
        return radius
    return wrong("CONTRADICTION", "X CENTER and Y CENTER are the start itself: an arc needs a radius.", "x_center")


def _ordered(*arcs: Arc) -> tuple[Piece, ...]:
    return tuple(sorted(arcs, key=lambda arc: abs(arc.sweep)))


def _end_and_center(turn: Turn, start: Point, known: Known) -> Answer:
    end, center = _end(known), _center(known)
    radius = _radius(start, center)
    if isinstance(radius, Finding):
        return radius
    out = hypot(end[0] - center[0], end[1] - center[1])
    if abs(out - radius) > ARC_RADII:
        text = "The arc's radius is {0~1} at its start and {1~0} at its end: correct the end or the center."
        return wrong("RADII_DIFFER", text, "x_center", radius, out)
    return (_arc(turn, start, end, known),)


def _arc(turn: Turn, start: Point, end: Point, known: Known) -> Arc:
    """The arc about a typed center: back at its start it turns by SWEEP ANGLE, without one fully."""
    center = _center(known)
    if not comes_back(start, end):
        return construct.settled(start, end, center, turn)
    if "sweep" in known:
        turned = _turned(turn, start, center, known["sweep"])
        if comes_back(start, turned.end):
            return turned
    return Arc(start, start, center, turn)


def _center_and_coordinate(axis: int, turn: Turn, start: Point, known: Known) -> Answer:
    center, value = _center(known), known[_END[axis]]
    radius = _radius(start, center)
    if isinstance(radius, Finding):
        return radius
    ends = construct.on_circle(center, radius, axis, value)
    match ends:
        case OnePoint(point):
            return (_arc(turn, start, point, known),)
        case TwoPoints(first, second):
            # at the circle's extreme both may be the start itself
            return _ordered(*dict.fromkeys(_arc(turn, start, end, known) for end in (first, second)))
        case OutOfReach():
            text = f"The arc's radius is {{0}}: it does not come to {'XY'[axis]} END {{1}}."
            return wrong("CONTRADICTION", text, _END[axis], radius, value)
        case _:
            assert_never(ends)


def _center_and_sweep(turn: Turn, start: Point, known: Known) -> Answer:
    center, sweep = _center(known), known["sweep"]
    radius = _radius(start, center)
    if isinstance(radius, Finding):
        return radius
    return (_turned(turn, start, center, sweep),)


def _turned(turn: Turn, start: Point, center: Point, sweep: float) -> Arc:
    """The arc that turns by `sweep` about `center`; a full turn, as far as anything shows, ends on the very start."""
    if tau - sweep <= AGREES and (tau - sweep) * hypot(start[0] - center[0], start[1] - center[1]) <= CLOSED:
        return Arc(start, start, center, turn)
    return Arc(start, construct.rotated(start, center, turn * sweep), center, turn)


def _end_and_radius(turn: Turn, start: Point, known: Known) -> Answer:
    end, radius = _end(known), known["radius"]
    if comes_back(start, end):
        return Beside()
    centers = construct.centers(start, end, radius, turn)
    match centers:
        case OnePoint(point):
            return (Arc(start, end, point, turn),)
        case TwoPoints(first, second):
            return _ordered(Arc(start, end, first, turn), Arc(start, end, second, turn))
        case OutOfReach(least):
            return wrong("CONTRADICTION", "RADIUS {0} does not reach the end: it takes {1}.", "radius", radius, least)
        case construct.NotDetermined():
            return Beside()
        case _:
            assert_never(centers)


def _end_and_sweep(turn: Turn, start: Point, known: Known) -> Answer:
    if comes_back(start, _end(known)):
        return Beside()
    center = construct.center_by_sweep(start, _end(known), known["sweep"], turn)
    return (Arc(start, _end(known), center.point, turn),) if isinstance(center, OnePoint) else Beside()


def _end_and_coordinate(axis: int, turn: Turn, start: Point, known: Known) -> Answer:
    """The end and one coordinate of the center."""
    if comes_back(start, _end(known)):
        return Beside()
    center = construct.center_by_coordinate(start, _end(known), axis, known[_CENTER[axis]])
    if not isinstance(center, OnePoint):
        return Beside()
    radius = _radius(start, center.point)
    return radius if isinstance(radius, Finding) else (Arc(start, _end(known), center.point, turn),)


def _radius_sweep_center(axis: int, turn: Turn, start: Point, known: Known) -> Answer:
    """RADIUS, SWEEP ANGLE and one coordinate of the center: its other coordinate greater first."""
    radius, value = known["radius"], known[_CENTER[axis]]
    centers = construct.on_circle(start, radius, axis, value)
    if isinstance(centers, OutOfReach):
        text = f"RADIUS {{0}} does not reach {'XY'[axis]} CENTER {{1}}: it takes at least {{2}}."
        return wrong("CONTRADICTION", text, "radius", radius, value, centers.least)
    points = (centers.point,) if isinstance(centers, OnePoint) else (centers.first, centers.second)
    return tuple(_turned(turn, start, point, known["sweep"]) for point in points)


def _radius_sweep_end(axis: int, turn: Turn, start: Point, known: Known) -> Answer:
    """RADIUS, SWEEP ANGLE and one coordinate of the end: its other coordinate greater first."""
    chord = known["radius"] * construct.chord_factor(known["sweep"])
    if chord <= CLOSED:
        return Beside()
    ends = construct.on_circle(start, chord, axis, known[_END[axis]])
    if isinstance(ends, OutOfReach):
        text = f"RADIUS and SWEEP ANGLE make the end {{0}} from the start: that does not reach {'XY'[axis]} END {{1}}."
        return wrong("CONTRADICTION", text, _END[axis], chord, known[_END[axis]])
    points = (ends.point,) if isinstance(ends, OnePoint) else (ends.first, ends.second)
    arcs = (_by_sweep(turn, start, point, known["sweep"]) for point in points)
    found = tuple(arc for arc in arcs if arc is not None)
    return found or Beside()


def _by_sweep(turn: Turn, start: Point, end: Point, sweep: float) -> Arc | None:
    center = construct.center_by_sweep(start, end, sweep, turn)
    return Arc(start, end, center.point, turn) if isinstance(center, OnePoint) else None


def _disagrees(piece: Piece, name: str, value: float) -> Finding | None:
    assert isinstance(piece, Arc)
    if name == "sweep":
        off = abs(abs(piece.sweep) - value)
        if off <= AGREES or off * piece.radius <= ARC_RADII:
            return None
        return wrong("CONTRADICTION", f"SWEEP ANGLE is {degrees(value)}, but {degrees(abs(piece.sweep))}", name)
    found = _measure(piece, name)
    if abs(found - value) <= ARC_RADII:
        return None
    return wrong("CONTRADICTION", f"{_LABELS[name]} is {{0~1}}, but {{1~0}}", name, value, found)


def _measure(arc: Arc, name: str) -> float:
    """A length or coordinate of an arc by its field's name."""
    if name == "radius":
        return arc.radius
    return arc.end[_END.index(name)] if name in _END else arc.center[_CENTER.index(name)]


_LABELS = {"x_end": "X END", "y_end": "Y END", "x_center": "X CENTER", "y_center": "Y CENTER", "radius": "RADIUS"}

_SOLVERS: tuple[tuple[tuple[str, ...], Solver], ...] = (
    (("x_end", "y_end", "x_center", "y_center"), _end_and_center),
    (("x_center", "y_center", "x_end"), lambda *given: _center_and_coordinate(0, *given)),
    (("x_center", "y_center", "y_end"), lambda *given: _center_and_coordinate(1, *given)),
    (("x_center", "y_center", "sweep"), _center_and_sweep),
    (("x_end", "y_end", "radius"), _end_and_radius),
    (("x_end", "y_end", "sweep"), _end_and_sweep),
    (("x_end", "y_end", "x_center"), lambda *given: _end_and_coordinate(0, *given)),
    (("x_end", "y_end", "y_center"), lambda *given: _end_and_coordinate(1, *given)),
    (("radius", "sweep", "x_center"), lambda *given: _radius_sweep_center(0, *given)),
    (("radius", "sweep", "y_center"), lambda *given: _radius_sweep_center(1, *given)),
    (("radius", "sweep", "x_end"), lambda *given: _radius_sweep_end(0, *given)),
    (("radius", "sweep", "y_end"), lambda *given: _radius_sweep_end(1, *given)),
)


def _task(turn: Turn) -> Task:
    def rule(needs: tuple[str, ...], solver: Solver) -> Rule:
        return Rule(frozenset(needs), lambda start, known: solver(turn, start, known))

    return Task(
        Form.ARC,
        ("x_end", "y_end", "x_center", "y_center", "radius", "sweep"),
        tuple(rule(needs, solver) for needs, solver in _SOLVERS),
        _disagrees,
        "enter the end and the center, the end and RADIUS, or the center and SWEEP ANGLE",
        center_needed,
    )


_CLOCKWISE, _COUNTER = _task(Turn.CW), _task(Turn.CCW)


def task(turn: Turn) -> Task:
    """The rules for an arc of this direction."""
    return _CLOCKWISE if turn is Turn.CW else _COUNTER


def sketch(start: Point, known: Known) -> Line | None:
    """What to draw dashed of an arc that is not determined: the chord to its end, or to what is typed of it."""
    end = (known.get("x_end", start[0]), known.get("y_end", start[1]))
    return None if end == start else Line(start, end)
