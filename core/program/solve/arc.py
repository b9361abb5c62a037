"""This module solves an ARC from its own fields and its start.

SWEEP ANGLE is the angle the arc turns through in its DIRECTION, always positive.  If two solutions fit, the arc with
the smaller SWEEP ANGLE comes first; if both have the typed one, the greater coordinate that was not typed.

A full circle is an arc about a typed center whose end is typed as its start (`is_start`).  An end that only comes
within 0.0001 in (0.00254 mm) of the start may belong to a full circle or to an arc a few micrometers long: SWEEP ANGLE
decides, and without it the arc is not determined.  A center calculated from such an end would depend on how the end
is rounded, so the center must be typed.
"""

from __future__ import annotations

from decimal import Decimal
from functools import partial
from math import degrees, dist, tau
from typing import Final

from core.finding import Finding, Severity
from core.geometry import construct
from core.geometry.construct import NotDetermined, OnePoint, OutOfReach
from core.geometry.piece import Arc, Piece, Point, Turn
from core.program.fields import Form, field_of
from core.program.solve.line import angle_text, points_of
from core.program.solve.measured import measured
from core.program.solve.rules import Given, Known, Outcome, Rule, Task, contradiction, either, fault
from core.tolerance import AGREES, ARC_RADII, CLOSED, JOINED
from core.units import Kind, Unit, convert, decimals_shown, from_mm, to_mm

_END_FIELDS: Final = ("x_end", "y_end")
_CENTER_FIELDS: Final = ("x_center", "y_center")

DOUBTFUL_GAP: Final = 10.0 * CLOSED
"""An arc whose end is within this distance of its start may be a full circle typed with too few digits."""

MAX_SILENT_ADJUSTMENT: Final = 5e-6
"""Millimeters by which an arc's numbers may disagree without a message: half of the last posted digit."""

MAX_ANGLE_DECIMALS: Final = 12
"""Decimals that an angle field accepts."""


def is_start(value: float, start: float, start_typed: float | None, unit: Unit) -> bool:
    """True if a coordinate of an end, typed as `value`, is typed as the same coordinate of the start.

    Both are compared as typed, in program units.  If the start is calculated (`start_typed` is None, or the typed value
    is not where the segment before ends), its calculated value, `start` in millimeters, is compared: rounded to the
    digits that are typed, and at least to those that a form shows, it must equal the end.  Agreement in either unit
    is enough, so that a change of units leaves every part as it was.  Points too close to be distinguished are always
    the same.
    """
    if abs(to_mm(value, unit) - start) <= JOINED or value == start_typed:
        return True
    if start_typed is not None and abs(to_mm(start_typed, unit) - start) <= JOINED:
        return False
    return any(_reads_like(convert(value, unit, other), from_mm(start, other), other) for other in Unit)


def _reads_like(value: float, start: float, unit: Unit) -> bool:
    typed = -int(Decimal(repr(value)).normalize().as_tuple().exponent)
    return round(start, max(typed, decimals_shown(Kind.LENGTH, unit))) == value


def _comes_back(start: Point, end: Point) -> bool:
    """True if an end is close enough to the start, in X and in Y, that it may be the start."""
    return max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= CLOSED


def _point(known: Known, names: tuple[str, str]) -> Point:
    return known[names[0]], known[names[1]]


def _ordered(*arcs: Arc) -> Outcome:
    shortest_first: list[Arc] = sorted(dict.fromkeys(arcs), key=lambda arc: abs(arc.sweep))
    return Outcome(tuple(shortest_first))


def _no_radius() -> Outcome:
    return contradiction("X CENTER and Y CENTER are the same as the start: an arc needs a radius.", "x_center")


def _end_and_center(given: Given) -> Outcome:
    end, center = _point(given.known, _END_FIELDS), _point(given.known, _CENTER_FIELDS)
    radius, out = dist(given.start, center), dist(end, center)
    if radius <= JOINED:
        return _no_radius()
    if abs(out - radius) > ARC_RADII:
        text = "The arc's radius is {0~1} at its start and {1~0} at its end: correct the end or the center."
        return Outcome(finding=fault("RADII_DIFFER", text, "x_center", radius, out))
    return _about_center(given, end)


def _center_and_coordinate(axis: int, given: Given) -> Outcome:
    center, value = _point(given.known, _CENTER_FIELDS), given.known[_END_FIELDS[axis]]
    radius = dist(given.start, center)
    if radius <= JOINED:
        return _no_radius()
    ends = construct.on_circle(center, radius, axis, value)
    if isinstance(ends, OutOfReach):
        text = f"The arc's radius is {{0}}: it does not reach {'XY'[axis]} END {{1}}."
        return contradiction(text, _END_FIELDS[axis], radius, value)
    return _about_center(given, *points_of(ends))


def _about_center(given: Given, *ends: Point) -> Outcome:
    """Return the arcs about a typed center to each end; SWEEP ANGLE decides what an end close to the start means."""
    start, center, sweep = given.start, _point(given.known, _CENTER_FIELDS), given.known.get("sweep")
    close = [end for end in ends if _comes_back(start, end)]
    arcs = [construct.even_arc(start, end, center, given.turn) for end in close]
    others = [construct.even_arc(start, end, center, given.turn) for end in ends if end not in close]
    full = Arc(start, start, center, given.turn)
    if not close:
        return _ordered(*others)
    if given.back:
        return _ordered(_swept_back(full, given), *others)
    if sweep is None or not any(_turns(arc, sweep) for arc in (full, *arcs, *others)):
        return _question(min(dist(start, end) for end in close), arcs, others, given)
    return _ordered(min(full, *arcs, key=lambda arc: abs(abs(arc.sweep) - sweep)), *others)


def _swept_back(full: Arc, given: Given) -> Arc:
    """Return the arc whose end is typed as its start: turned by SWEEP ANGLE if that also ends there, else `full`."""
    if "sweep" in given.known:
        turned = _turned(full.turn, full.start, full.center, given.known["sweep"])
        if _comes_back(full.start, turned.end):
            return turned
    return full


def _question(gap: float, arcs: list[Arc], others: list[Arc], given: Given) -> Outcome:
    """Ask what an end means that is only `gap` from the start; the operator answers with SWEEP ANGLE."""
    names = {arc: "short arc" if abs(arc.sweep) < tau / 2.0 else "arc to that end" for arc in arcs}
    names = {arc: name for arc, name in names.items() if arc.end != arc.start}
    names |= dict.fromkeys(others, "arc to the other end")
    text = "The end is {value~0} from the start. Type SWEEP ANGLE 360 for the full circle."
    if names:
        answers = either(["360", *(_angle_to_type(abs(arc.sweep)) for arc in names)])
        text = f"The end is {{value~0}} from the start: {either(['full circle', *names.values()])}?"
        text += f" Type SWEEP ANGLE {answers}."
    asked = Finding("CIRCLE_OR_ARC", Severity.ERROR, text, field="sweep", value=gap, lengths=(0.0,))
    return Outcome(missing=() if "sweep" in given.known else ("sweep",), finding=asked)


def _angle_to_type(sweep: float) -> str:
    """Format an angle in degrees with enough decimals to distinguish it from 0 and from 360."""
    angle = degrees(sweep)
    rest = min(angle, 360.0 - angle)
    enough = (count for count in range(3, MAX_ANGLE_DECIMALS) if abs(round(angle, count) - angle) <= rest / 20.0)
    return f"{angle:.{next(enough, MAX_ANGLE_DECIMALS)}f}"


def _center_and_sweep(given: Given) -> Outcome:
    center = _point(given.known, _CENTER_FIELDS)
    if dist(given.start, center) <= JOINED:
        return _no_radius()
    return Outcome((_turned(given.turn, given.start, center, given.known["sweep"]),))


def _turned(turn: Turn, start: Point, center: Point, sweep: float) -> Arc:
    """Return the arc that turns by `sweep` about `center`; a full turn within tolerance ends exactly at the start."""
    if tau - sweep <= AGREES and (tau - sweep) * dist(start, center) <= CLOSED:
        return Arc(start, start, center, turn)
    return Arc(start, construct.rotated(start, center, turn * sweep), center, turn)


def _end_and_radius(given: Given) -> Outcome | None:
    start, end, radius = given.start, _point(given.known, _END_FIELDS), given.known["radius"]
    if _comes_back(start, end):
        return None
    centers = construct.centers(start, end, radius, given.turn)
    if isinstance(centers, OutOfReach):
        return contradiction("RADIUS {0~1} does not reach the end: it takes {1~0}.", "radius", radius, centers.least)
    if isinstance(centers, NotDetermined):
        return None
    return _ordered(*(Arc(start, end, center, given.turn) for center in points_of(centers)))


def _end_and_sweep(given: Given) -> Outcome | None:
    end = _point(given.known, _END_FIELDS)
    return None if _comes_back(given.start, end) else _by_sweep(given, end)


def _by_sweep(given: Given, *ends: Point) -> Outcome | None:
    """Return the arcs that turn by SWEEP ANGLE to each of the ends."""
    centers = [(end, construct.center_by_sweep(given.start, end, given.known["sweep"], given.turn)) for end in ends]
    arcs = tuple(
        Arc(given.start, end, center.point, given.turn) for end, center in centers if isinstance(center, OnePoint)
    )
    return Outcome(arcs) if arcs else None


def _end_and_center_coordinate(axis: int, given: Given) -> Outcome | None:
    start, end = given.start, _point(given.known, _END_FIELDS)
    if _comes_back(start, end):
        return None
    center = construct.center_by_coordinate(start, end, axis, given.known[_CENTER_FIELDS[axis]])
    if not isinstance(center, OnePoint):
        return None
    return (
        _no_radius() if dist(start, center.point) <= JOINED else Outcome((Arc(start, end, center.point, given.turn),))
    )


def _radius_sweep_center(axis: int, given: Given) -> Outcome:
    """Solve RADIUS, SWEEP ANGLE and one center coordinate: the center with the greater other coordinate first."""
    radius, value = given.known["radius"], given.known[_CENTER_FIELDS[axis]]
    centers = construct.on_circle(given.start, radius, axis, value)
    if isinstance(centers, OutOfReach):
        text = f"RADIUS {{0~2}} does not reach {'XY'[axis]} CENTER {{1}}: it takes at least {{2+}}."
        return contradiction(text, "radius", radius, value, centers.least)
    return Outcome(
        tuple(_turned(given.turn, given.start, center, given.known["sweep"]) for center in points_of(centers))
    )


def _radius_sweep_end(axis: int, given: Given) -> Outcome | None:
    """Solve RADIUS, SWEEP ANGLE and one end coordinate: the end with the greater other coordinate first."""
    chord = given.known["radius"] * construct.chord_factor(given.known["sweep"])
    if chord <= CLOSED:
        return None
    ends = construct.on_circle(given.start, chord, axis, given.known[_END_FIELDS[axis]])
    if isinstance(ends, OutOfReach):
        text = f"RADIUS and SWEEP ANGLE make the end {{0}} from the start: that does not reach {'XY'[axis]} END {{1}}."
        return contradiction(text, _END_FIELDS[axis], chord, given.known[_END_FIELDS[axis]])
    return _by_sweep(given, *points_of(ends))


def _turns(arc: Arc, sweep: float) -> bool:
    """True if SWEEP ANGLE agrees with an arc."""
    off = abs(abs(arc.sweep) - sweep)
    return off <= AGREES or off * arc.radius <= ARC_RADII


def _disagreement(piece: Piece, name: str, value: float) -> Finding | None:
    assert isinstance(piece, Arc)
    solved = measured(piece)[name]
    if name == "sweep":
        text = f"SWEEP ANGLE is {angle_text(value)}, but {angle_text(solved)}"
        return None if _turns(piece, value) else fault("CONTRADICTION", text, name)
    if abs(solved - value) <= ARC_RADII:
        return None
    return fault("CONTRADICTION", f"{_labels((name,))} is {{0~1}}, but {{1~0}}", name, value, solved)


def _labels(names: tuple[str, ...]) -> str:
    return " and ".join(field_of(Form.ARC, name).label for name in names)


def _center_needed(given: Given) -> tuple[tuple[str, ...], str] | None:
    """Return the blank center fields of an arc that ends at its start, with advice; None for any other end."""
    known = given.known
    end = known.get("x_end", given.start[0]), known.get("y_end", given.start[1])
    blank = tuple(name for name in _CENTER_FIELDS if name not in known)
    if not blank or not any(name in known for name in _END_FIELDS) or not _comes_back(given.start, end):
        return None
    text = f"the end is at the start. For the full circle type {_labels(blank)}; for a shorter arc the center and "
    return blank, f"{text}SWEEP ANGLE, with X END and Y END blank."


def circle_finding(arc: Arc, given: Given) -> Finding | None:
    """Return a finding on an arc that ends at or near its start, None if there is nothing to report."""
    if arc.start == arc.end:
        return _full_circle_finding(given)
    gap = dist(arc.start, arc.end)
    if gap > (CLOSED if "sweep" in given.known else DOUBTFUL_GAP) or arc.length <= JOINED:
        return None
    text = f"The arc ends only {{value~0}} from its start and turns {angle_text(abs(arc.sweep))} degrees. "
    text += "Enter SWEEP ANGLE 360 if the full circle is meant."
    return Finding("SHORT_ARC", Severity.WARNING, text, field="sweep", value=gap, lengths=(0.0,))


def _full_circle_finding(given: Given) -> Finding | None:
    """Report that the typed numbers make the full circle although they do not match it exactly."""
    known, (x, y) = given.known, given.start
    sweep, gap = known.get("sweep"), dist(given.start, (known.get("x_end", x), known.get("y_end", y)))
    if sweep is not None and sweep != tau:
        text = f"SWEEP ANGLE {angle_text(sweep)} ends at the arc's start: it is the full circle. Enter 360."
        return Finding("FULL_CIRCLE", Severity.WARNING, text, field="sweep")
    if gap <= JOINED or (sweep is not None and given.back):
        return None
    names = tuple(name for name in _END_FIELDS if name in known)
    ends = _labels(names)
    if sweep is not None:
        text = f"SWEEP ANGLE 360 makes the full circle: it ends where it starts, {{value~0}} from {ends}."
        return Finding("FULL_CIRCLE", Severity.INFO, text, field="sweep", value=gap, lengths=(0.0,))
    text = f"{ends} read{'s' if len(names) == 1 else ''} like the arc's start: it is the full circle, and ends where "
    text += f"it starts. For a shorter arc blank {ends} and enter SWEEP ANGLE."
    return Finding("FULL_CIRCLE", Severity.INFO, text, field=names[0])


def adjustment(arc: Arc, given: Given) -> Finding | None:
    """Report that an arc is fitted to typed numbers that do not match exactly; `value` is the difference."""
    known = given.known
    if not given.back and arc.start != arc.end:
        center = known.get("x_center", arc.center[0]), known.get("y_center", arc.center[1])
        end = known.get("x_end", arc.end[0]), known.get("y_end", arc.end[1])
        radius, out = dist(arc.start, center), dist(end, center)
        if abs(out - radius) > MAX_SILENT_ADJUSTMENT:
            text = "Radius {0~1} at start, {1~0} at end: the arc is fitted to both."
            return Finding("ARC_ADJUSTED", Severity.INFO, text, value=abs(out - radius), lengths=(radius, out))
    radius = known.get("radius", arc.radius)
    if abs(arc.radius - radius) <= MAX_SILENT_ADJUSTMENT:
        return None
    text = "RADIUS {0~1} does not fit the other numbers: {1~0} is used."
    return Finding("ARC_ADJUSTED", Severity.INFO, text, value=abs(arc.radius - radius), lengths=(radius, arc.radius))


ARC_TASK: Final = Task(
    Form.ARC,
    ("x_end", "y_end", "x_center", "y_center", "radius", "sweep"),
    (
        Rule(frozenset(("x_end", "y_end", "x_center", "y_center")), _end_and_center),
        Rule(frozenset(("x_center", "y_center", "x_end")), partial(_center_and_coordinate, 0)),
        Rule(frozenset(("x_center", "y_center", "y_end")), partial(_center_and_coordinate, 1)),
        Rule(frozenset(("x_center", "y_center", "sweep")), _center_and_sweep),
        Rule(frozenset(("x_end", "y_end", "radius")), _end_and_radius),
        Rule(frozenset(("x_end", "y_end", "sweep")), _end_and_sweep),
        Rule(frozenset(("x_end", "y_end", "x_center")), partial(_end_and_center_coordinate, 0)),
        Rule(frozenset(("x_end", "y_end", "y_center")), partial(_end_and_center_coordinate, 1)),
        Rule(frozenset(("radius", "sweep", "x_center")), partial(_radius_sweep_center, 0)),
        Rule(frozenset(("radius", "sweep", "y_center")), partial(_radius_sweep_center, 1)),
        Rule(frozenset(("radius", "sweep", "x_end")), partial(_radius_sweep_end, 0)),
        Rule(frozenset(("radius", "sweep", "y_end")), partial(_radius_sweep_end, 1)),
    ),
    _disagreement,
    "type the end and the center, the end and RADIUS, or the center and SWEEP ANGLE.",
    _center_needed,
)
"""The rules for an arc; `Given.turn` is its direction."""
