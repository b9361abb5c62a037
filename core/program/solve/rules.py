"""This module solves a LINE or an ARC from its own fields and its start, by rules.

A rule names the fields it needs.  The first rule in the table whose fields are typed and which gives a result is used.
Other typed fields must agree with it, and choose if the rule leaves two solutions.

LINE: if two solutions fit (one end coordinate and XY LENGTH), the one with the greater other coordinate comes first.

ARC: SWEEP ANGLE is the angle the arc turns through in its DIRECTION, always positive.  If two solutions fit, the arc
with the smaller SWEEP ANGLE comes first; if both have the typed one, the greater coordinate that was not typed.

A full circle is an arc about a typed center whose end is typed as its start (`is_start`).  An end that only comes
within 0.0001 in (0.00254 mm) of the start may belong to a full circle or to an arc a few micrometers long: SWEEP ANGLE
decides, and without it the arc is not determined.  A center calculated from such an end would depend on how the end
is rounded, so the center must be typed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import partial
from math import degrees, dist, pi, tau
from typing import Final

from core.finding import Finding, Severity
from core.geometry import construct
from core.geometry.construct import OutOfReach
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.program.fields import Form, field_of
from core.program.solve.reading import ANGLE_FIELDS, measured
from core.tolerance import AGREES, ARC_RADII, CLOSED, JOINED
from core.units import Kind, Unit, convert, decimals_shown, from_mm, show, to_mm

_END: Final = ("x_end", "y_end")
_CENTER: Final = ("x_center", "y_center")

DOUBTFUL_GAP: Final = 10.0 * CLOSED
"""An arc whose end is within this distance of its start may be a full circle typed with too few digits."""

MAX_SILENT_ADJUSTMENT: Final = 5e-6
"""Millimeters by which an arc's numbers may disagree without a message: half of the last posted digit."""

MAX_ANGLE_DECIMALS: Final = 12
"""Decimals that an angle field accepts."""

Known = Mapping[str, float]
"""The typed values by field name, in millimeters and radians."""


@dataclass(frozen=True, slots=True)
class SegmentData:
    """The data from which a segment is solved: its start, its typed values, and the direction of an arc."""

    start: Point
    known: Known
    ends_at_start: bool = False
    """True if every end coordinate that is typed is typed as the same number as at the start."""
    turn: Turn = Turn.NONE


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a segment's fields: one piece, several to pick from, or what is missing or wrong."""

    pieces: tuple[Piece, ...] = ()
    missing: tuple[str, ...] = ()
    finding: Finding | None = None


Solver = Callable[[SegmentData], Outcome | None]
"""Returns None if its fields do not determine this segment; another rule may."""


@dataclass(frozen=True, slots=True)
class Rule:
    """The fields that determine a segment, and how."""

    needs: frozenset[str]
    solve: Solver


@dataclass(frozen=True, slots=True)
class SegmentKind:
    """A kind of segment, LINE or ARC: its form, the fields of its shape, and the rules that solve it."""

    form: Form
    shape: tuple[str, ...]
    rules: tuple[Rule, ...]
    advice: str
    """The advice if nothing more specific is known."""
    special_case: Callable[[SegmentData], tuple[tuple[str, ...], str] | None] = lambda _data: None
    """Returns missing fields and advice if no rule gives a result and this case explains why, else None."""

    def label(self, name: str) -> str:
        """Return a field's label on this form."""
        return field_of(self.form, name).label


def solve(kind: SegmentKind, data: SegmentData) -> Outcome:
    """Return the pieces that fit all typed values, or what is missing or wrong."""
    known, rule_tried = data.known, False
    for rule in kind.rules:
        if not rule.needs <= known.keys():
            continue
        outcome = rule.solve(data)
        if outcome is not None:
            others = [name for name in known if name not in rule.needs]
            return _agreeing_pieces(kind, outcome, others, known) if outcome.pieces and others else outcome
        rule_tried = True
    special_case = kind.special_case(data) if rule_tried else None
    return _undetermined(kind, known, tried=rule_tried) if special_case is None else more_needed(*special_case)


def _agreeing_pieces(kind: SegmentKind, outcome: Outcome, others: list[str], known: Known) -> Outcome:
    """Keep the pieces that agree with every other typed field; if none does, return the first disagreement."""
    disagreements = [_first_disagreement(kind, piece, others, known) for piece in outcome.pieces]
    pairs = zip(outcome.pieces, disagreements, strict=True)
    fitting = tuple(piece for piece, disagreement in pairs if disagreement is None)
    return Outcome(fitting) if fitting else Outcome(finding=disagreements[0])


def _first_disagreement(kind: SegmentKind, piece: Piece, others: list[str], known: Known) -> Finding | None:
    for name in others:
        finding = _disagreement(kind, piece, name, known[name])
        if finding is not None:
            others_text = " and ".join(kind.label(other) for other in kind.shape if other in known and other != name)
            return replace(finding, field=name, text=f"{finding.text} by {others_text}: correct or blank one of them.")
    return None


def _disagreement(kind: SegmentKind, piece: Piece, name: str, value: float) -> Finding | None:
    """Return what a piece has instead of a typed value, as the beginning of a sentence; None if they agree."""
    solved, label = measured(piece)[name], kind.label(name)
    if name not in ANGLE_FIELDS:
        if abs(solved - value) <= ARC_RADII:
            return None
        return fault("CONTRADICTION", f"{label} is {{0~1}}, but {{1~0}}", name, value, solved)
    if name == "angle":
        solved = nearest_equivalent(solved, value)
    if angles_agree(solved - value, piece):
        return None
    return fault("CONTRADICTION", f"{label} is {angle_text(value)}, but {angle_text(solved)}", name)


def angles_agree(difference: float, piece: Piece) -> bool:
    """True if an angle is off by no more than rounding, or if that displaces the piece by no more than ARC_RADII."""
    reach = piece.length if isinstance(piece, Line) else piece.radius
    return abs(difference) <= AGREES or abs(difference) * reach <= ARC_RADII


def angle_text(angle: float) -> str:
    """Format an angle as the form shows it."""
    return show(degrees(angle), Kind.ANGLE, Unit.IN)


def nearest_equivalent(angle: float, typed: float) -> float:
    """Return a direction as the angle within half a turn of a typed one: 295 is -65 beside a typed -30."""
    return typed + (angle - typed + pi) % tau - pi


def more_needed(missing: tuple[str, ...], advice: str) -> Outcome:
    """Return an outcome that the fields `missing` are needed, with advice on what to type."""
    field = missing[0] if missing else None
    return Outcome(missing=missing, finding=fault("MISSING", f"More data needed: {advice}", field))


def _undetermined(kind: SegmentKind, known: Known, *, tried: bool) -> Outcome:
    """Advise which blank fields to type; `tried` if a rule had its fields but they did not determine the segment."""
    blank = tuple(name for name in kind.shape if name not in known)
    completing = tuple(name for name in blank if any(rule.needs <= {*known, name} for rule in kind.rules))
    missing = blank if tried or not completing else completing
    if not completing or (tried and len(blank) > 2):
        return more_needed(missing, kind.advice)
    return more_needed(missing, f"type {joined_with_or([kind.label(name) for name in missing])}.")


def joined_with_or(labels: list[str]) -> str:
    """Join labels with commas and `or`."""
    return labels[0] if len(labels) == 1 else f"{', '.join(labels[:-1])} or {labels[-1]}"


def fault(code: str, text: str, field: str | None, *lengths: float) -> Finding:
    """Return an error at one field."""
    return Finding(code, Severity.ERROR, text, field=field, lengths=lengths)


def contradiction(text: str, field: str, *lengths: float) -> Outcome:
    """Return the error at `field` that typed values contradict; `{0}` ... in the text are `lengths` (mm)."""
    return Outcome(finding=fault("CONTRADICTION", text, field, *lengths))


# the rules of a LINE


def _line_by_angle_and_coordinate(axis: int, data: SegmentData) -> Outcome | None:
    """Solve a line along XY ANGLE to one end coordinate; None if the angle leaves the end open."""
    start, known = data.start, data.known
    value, angle = known[_END[axis]], known["angle"]
    reached = construct.ray_to_coordinate(start, angle, axis, value)
    letter = "XY"[axis]
    if reached is None:
        if "length" in known or abs(value - start[axis]) <= ARC_RADII:
            return None
        text = f"XY ANGLE {angle_text(angle)} holds {letter} at {{0~1}}: it never reaches {letter} END {{1~0}}"
        return contradiction(f"{text}. Correct one of them.", "angle", start[axis], value)
    end, ahead = reached
    if not ahead:
        text = f"XY ANGLE {angle_text(angle)} leads away from {letter} END {{0}}. Correct one of them."
        return contradiction(text, "angle", value)
    return _lines(start, end)


def _line_by_angle_and_length(data: SegmentData) -> Outcome:
    return _lines(data.start, construct.polar(data.start, data.known["angle"], data.known["length"]))


def _line_by_length_and_coordinate(axis: int, data: SegmentData) -> Outcome:
    """Solve a line of the typed XY LENGTH to one end coordinate."""
    value, length = data.known[_END[axis]], data.known["length"]
    ends = construct.points_on_circle(data.start, length, axis, value)
    if isinstance(ends, OutOfReach):
        text = f"XY LENGTH {{0~2}} does not reach {'XY'[axis]} END {{1}}: it takes at least {{2+}}."
        return contradiction(text, "length", length, value, ends.least)
    return _lines(data.start, *ends)


def _lines(start: Point, *ends: Point) -> Outcome:
    return Outcome(tuple(Line(start, end) for end in ends))


LINE_KIND: Final = SegmentKind(
    Form.LINE,
    ("x_end", "y_end", "length", "angle"),
    (
        Rule(frozenset(("x_end", "y_end")), lambda data: _lines(data.start, _point(data.known, _END))),
        Rule(frozenset(("x_end", "angle")), partial(_line_by_angle_and_coordinate, 0)),
        Rule(frozenset(("y_end", "angle")), partial(_line_by_angle_and_coordinate, 1)),
        Rule(frozenset(("length", "angle")), _line_by_angle_and_length),
        Rule(frozenset(("x_end", "length")), partial(_line_by_length_and_coordinate, 0)),
        Rule(frozenset(("y_end", "length")), partial(_line_by_length_and_coordinate, 1)),
    ),
    "type X END and Y END, or XY LENGTH and XY ANGLE, or one end and one of these.",
)


# the rules of an ARC


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
    return any(_shown_alike(convert(value, unit, other), from_mm(start, other), other) for other in Unit)


def _shown_alike(value: float, start: float, unit: Unit) -> bool:
    typed = -int(Decimal(repr(value)).normalize().as_tuple().exponent)
    return round(start, max(typed, decimals_shown(Kind.LENGTH, unit))) == value


def _near_start(start: Point, end: Point) -> bool:
    """True if an end is close enough to the start, in X and in Y, that it may be the start."""
    return max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= CLOSED


def _point(known: Known, names: tuple[str, str]) -> Point:
    return known[names[0]], known[names[1]]


def _ordered(*arcs: Arc) -> Outcome:
    shortest_first: list[Arc] = sorted(dict.fromkeys(arcs), key=lambda arc: abs(arc.sweep))
    return Outcome(tuple(shortest_first))


def _no_radius() -> Outcome:
    return contradiction("X CENTER and Y CENTER are the same as the start: an arc needs a radius.", "x_center")


def _end_and_center(data: SegmentData) -> Outcome:
    end, center = _point(data.known, _END), _point(data.known, _CENTER)
    radius, end_radius = dist(data.start, center), dist(end, center)
    if radius <= JOINED:
        return _no_radius()
    if abs(end_radius - radius) > ARC_RADII:
        text = "The arc's radius is {0~1} at its start and {1~0} at its end: correct the end or the center."
        return Outcome(finding=fault("RADII_DIFFER", text, "x_center", radius, end_radius))
    return _about_center(data, end)


def _center_and_coordinate(axis: int, data: SegmentData) -> Outcome:
    center, value = _point(data.known, _CENTER), data.known[_END[axis]]
    radius = dist(data.start, center)
    if radius <= JOINED:
        return _no_radius()
    ends = construct.points_on_circle(center, radius, axis, value)
    if isinstance(ends, OutOfReach):
        text = f"The arc's radius is {{0}}: it does not reach {'XY'[axis]} END {{1}}."
        return contradiction(text, _END[axis], radius, value)
    if len(ends) == 1 and "sweep" in data.known:
        # where the circle only touches this coordinate, SWEEP ANGLE says more about the other one
        turned = construct.rotated(data.start, center, data.turn * data.known["sweep"])
        ends = (turned,) if abs(turned[axis] - value) <= JOINED else ends
    return _about_center(data, *ends)


def _about_center(data: SegmentData, *ends: Point) -> Outcome:
    """Return the arcs about a typed center to each end; SWEEP ANGLE decides what an end close to the start means."""
    start, center, sweep = data.start, _point(data.known, _CENTER), data.known.get("sweep")
    close = [end for end in ends if _near_start(start, end)]
    arcs = [construct.exact_arc(start, end, center, data.turn) for end in close]
    others = [construct.exact_arc(start, end, center, data.turn) for end in ends if end not in close]
    full = Arc(start, start, center, data.turn)
    if not close:
        return _ordered(*others)
    if data.ends_at_start:
        return _ordered(_closed_by_sweep(full, data), *others)
    if sweep is None or not any(angles_agree(abs(arc.sweep) - sweep, arc) for arc in (full, *arcs, *others)):
        return _ask_circle_or_arc(min(dist(start, end) for end in close), arcs, others, data)
    return _ordered(min(full, *arcs, key=lambda arc: abs(abs(arc.sweep) - sweep)), *others)


def _closed_by_sweep(full: Arc, data: SegmentData) -> Arc:
    """Return the arc whose end is typed as its start: turned by SWEEP ANGLE if that also ends there, else `full`."""
    if "sweep" in data.known:
        turned = _turned(full.turn, full.start, full.center, data.known["sweep"])
        if _near_start(full.start, turned.end):
            return turned
    return full


def _ask_circle_or_arc(gap: float, arcs: list[Arc], others: list[Arc], data: SegmentData) -> Outcome:
    """Ask what an end means that is only `gap` from the start; the operator answers with SWEEP ANGLE."""
    names = {arc: "short arc" if abs(arc.sweep) < tau / 2.0 else "arc to that end" for arc in arcs}
    names = {arc: name for arc, name in names.items() if arc.end != arc.start}
    names |= dict.fromkeys(others, "arc to the other end")
    text = "The end is {value~0} from the start. Type SWEEP ANGLE 360 for the full circle."
    if names:
        answers = joined_with_or(["360", *(_angle_to_type(abs(arc.sweep)) for arc in names)])
        text = f"The end is {{value~0}} from the start: {joined_with_or(['full circle', *names.values()])}?"
        text += f" Type SWEEP ANGLE {answers}."
    question = Finding("CIRCLE_OR_ARC", Severity.ERROR, text, field="sweep", value=gap, lengths=(0.0,))
    return Outcome(missing=() if "sweep" in data.known else ("sweep",), finding=question)


def _angle_to_type(sweep: float) -> str:
    """Format an angle in degrees with enough decimals to distinguish it from 0 and from 360."""
    angle = degrees(sweep)
    margin = min(angle, 360.0 - angle)
    enough = (count for count in range(3, MAX_ANGLE_DECIMALS) if abs(round(angle, count) - angle) <= margin / 20.0)
    return f"{angle:.{next(enough, MAX_ANGLE_DECIMALS)}f}"


def _center_and_sweep(data: SegmentData) -> Outcome:
    center = _point(data.known, _CENTER)
    if dist(data.start, center) <= JOINED:
        return _no_radius()
    return Outcome((_turned(data.turn, data.start, center, data.known["sweep"]),))


def _turned(turn: Turn, start: Point, center: Point, sweep: float) -> Arc:
    """Return the arc that turns by `sweep` about `center`; a full turn within tolerance ends exactly at the start."""
    if tau - sweep <= AGREES and (tau - sweep) * dist(start, center) <= CLOSED:
        return Arc(start, start, center, turn)
    return Arc(start, construct.rotated(start, center, turn * sweep), center, turn)


def _end_and_radius(data: SegmentData) -> Outcome | None:
    start, end, radius = data.start, _point(data.known, _END), data.known["radius"]
    if _near_start(start, end):
        return None
    centers = construct.centers(start, end, radius, data.turn)
    if isinstance(centers, OutOfReach):
        return contradiction("RADIUS {0~1} does not reach the end: it takes {1~0}.", "radius", radius, centers.least)
    return _ordered(*(Arc(start, end, center, data.turn) for center in centers)) if centers else None


def _end_and_sweep(data: SegmentData) -> Outcome | None:
    end = _point(data.known, _END)
    return None if _near_start(data.start, end) else _by_sweep(data, end)


def _by_sweep(data: SegmentData, *ends: Point) -> Outcome | None:
    """Return the arcs that turn by SWEEP ANGLE to each of the ends."""
    centers = [(end, construct.center_by_sweep(data.start, end, data.known["sweep"], data.turn)) for end in ends]
    arcs = tuple(Arc(data.start, end, center, data.turn) for end, center in centers if center is not None)
    return Outcome(arcs) if arcs else None


def _end_and_center_coordinate(axis: int, data: SegmentData) -> Outcome | None:
    start, end = data.start, _point(data.known, _END)
    if _near_start(start, end):
        return None
    center = construct.center_by_coordinate(start, end, axis, data.known[_CENTER[axis]])
    if center is None:
        return None
    return _no_radius() if dist(start, center) <= JOINED else Outcome((Arc(start, end, center, data.turn),))


def _radius_sweep_center(axis: int, data: SegmentData) -> Outcome:
    """Solve RADIUS, SWEEP ANGLE and one center coordinate: the center with the greater other coordinate first."""
    radius, value = data.known["radius"], data.known[_CENTER[axis]]
    centers = construct.points_on_circle(data.start, radius, axis, value)
    if isinstance(centers, OutOfReach):
        text = f"RADIUS {{0~2}} does not reach {'XY'[axis]} CENTER {{1}}: it takes at least {{2+}}."
        return contradiction(text, "radius", radius, value, centers.least)
    return Outcome(tuple(_turned(data.turn, data.start, center, data.known["sweep"]) for center in centers))


def _radius_sweep_end(axis: int, data: SegmentData) -> Outcome | None:
    """Solve RADIUS, SWEEP ANGLE and one end coordinate: the end with the greater other coordinate first."""
    chord = data.known["radius"] * construct.chord_factor(data.known["sweep"])
    if chord <= CLOSED:
        return None
    ends = construct.points_on_circle(data.start, chord, axis, data.known[_END[axis]])
    if isinstance(ends, OutOfReach):
        text = f"RADIUS and SWEEP ANGLE make the end {{0}} from the start: that does not reach {'XY'[axis]} END {{1}}."
        return contradiction(text, _END[axis], chord, data.known[_END[axis]])
    return _by_sweep(data, *ends)


def _labels(names: tuple[str, ...]) -> str:
    return " and ".join(field_of(Form.ARC, name).label for name in names)


def _center_needed(data: SegmentData) -> tuple[tuple[str, ...], str] | None:
    """Return the blank center fields of an arc that ends at its start, with advice; None for any other end."""
    known = data.known
    end = known.get("x_end", data.start[0]), known.get("y_end", data.start[1])
    blank = tuple(name for name in _CENTER if name not in known)
    if not blank or not any(name in known for name in _END) or not _near_start(data.start, end):
        return None
    text = f"the end is at the start. For the full circle type {_labels(blank)}; for a shorter arc the center and "
    return blank, f"{text}SWEEP ANGLE, with X END and Y END blank."


def circle_finding(arc: Arc, data: SegmentData) -> Finding | None:
    """Return a finding on an arc that ends at or near its start, None if there is nothing to report."""
    if arc.start == arc.end:
        return _full_circle_finding(data)
    gap = dist(arc.start, arc.end)
    if gap > (CLOSED if "sweep" in data.known else DOUBTFUL_GAP) or arc.length <= JOINED:
        return None
    text = f"The arc ends only {{value~0}} from its start and turns {angle_text(abs(arc.sweep))} degrees. "
    text += "Enter SWEEP ANGLE 360 if the full circle is meant."
    return Finding("SHORT_ARC", Severity.WARNING, text, field="sweep", value=gap, lengths=(0.0,))


def _full_circle_finding(data: SegmentData) -> Finding | None:
    """Report that the typed numbers make the full circle although they do not match it exactly."""
    known, (x, y) = data.known, data.start
    sweep, gap = known.get("sweep"), dist(data.start, (known.get("x_end", x), known.get("y_end", y)))
    if sweep is not None and sweep != tau:
        text = f"SWEEP ANGLE {angle_text(sweep)} ends at the arc's start: it is the full circle. Enter 360."
        return Finding("FULL_CIRCLE", Severity.WARNING, text, field="sweep")
    if gap <= JOINED or (sweep is not None and data.ends_at_start):
        return None
    names = tuple(name for name in _END if name in known)
    ends = _labels(names)
    if sweep is not None:
        text = f"SWEEP ANGLE 360 makes the full circle: it ends where it starts, {{value~0}} from {ends}."
        return Finding("FULL_CIRCLE", Severity.INFO, text, field="sweep", value=gap, lengths=(0.0,))
    text = f"{ends} read{'s' if len(names) == 1 else ''} like the arc's start: it is the full circle, and ends where "
    text += f"it starts. For a shorter arc blank {ends} and enter SWEEP ANGLE."
    return Finding("FULL_CIRCLE", Severity.INFO, text, field=names[0])


def adjustment(arc: Arc, data: SegmentData) -> Finding | None:
    """Report that an arc is fitted to typed numbers that do not match exactly; `value` is the difference."""
    known = data.known
    if not data.ends_at_start and arc.start != arc.end:
        center = known.get("x_center", arc.center[0]), known.get("y_center", arc.center[1])
        end = known.get("x_end", arc.end[0]), known.get("y_end", arc.end[1])
        radius, end_radius = dist(arc.start, center), dist(end, center)
        if abs(end_radius - radius) > MAX_SILENT_ADJUSTMENT:
            text = "Radius {0~1} at start, {1~0} at end: the arc is fitted to both."
            return Finding(
                "ARC_ADJUSTED", Severity.INFO, text, value=abs(end_radius - radius), lengths=(radius, end_radius)
            )
    radius = known.get("radius", arc.radius)
    if abs(arc.radius - radius) <= MAX_SILENT_ADJUSTMENT:
        return None
    text = "RADIUS {0~1} does not fit the other numbers: {1~0} is used."
    return Finding("ARC_ADJUSTED", Severity.INFO, text, value=abs(arc.radius - radius), lengths=(radius, arc.radius))


ARC_KIND: Final = SegmentKind(
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
    "type the end and the center, the end and RADIUS, or the center and SWEEP ANGLE.",
    _center_needed,
)
"""The rules for an arc; `SegmentData.turn` is its direction."""
