"""One segment solved by itself, before blending: its fields read, its piece of the surface, and what it hands on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import assert_never

from core.finding import Finding, Severity
from core.geometry.piece import Arc, Line, Piece, Point
from core.program.fields import FARTHEST, Form
from core.program.model import ArcSegment, BlendSegment, Entry, LineSegment, Segment, Unread
from core.program.solve import arc, line
from core.program.solve.full_circle import circle_finding
from core.program.solve.reading import Reading, carry, fill, fill_angle, read
from core.program.solve.rules import Known, Outcome, Task, solve
from core.tolerance import JOINED, LARGEST
from core.units import Unit

_FORMS = {LineSegment: Form.LINE, ArcSegment: Form.ARC, BlendSegment: Form.BLEND}


@dataclass(frozen=True, slots=True)
class Shape:
    """A segment's part of the surface, or what is to be told of it instead."""

    piece: Piece | None = None
    end: Point | None = None
    missing: tuple[str, ...] = ()
    choices: tuple[Piece, ...] = ()
    sketch: Piece | None = None
    findings: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True)
class Here:
    """What a segment takes over from the one before it: its end, Z and feed, None while not known."""

    point: Point | None
    z: float | None
    feed: float | None


@dataclass(frozen=True, eq=False, slots=True)
class Draft:
    """A segment solved by itself, before blending: `here` is what it takes over, `ahead` what it hands on.

    `z` and `feed` are its own, None where it takes over those of the segment before.
    """

    segment: Segment
    unit: Unit
    z: float | None
    feed: float | None
    reading: Reading
    shape: Shape
    here: Here
    ahead: Here


def drafted(segment: Segment, number: int, here: Here, unit: Unit) -> Draft:
    """A segment that takes over a point, and Z and feed where its own are blank."""
    reading = read(_FORMS[type(segment)], segment, unit, number)
    values, known = reading.values, reading.known
    own_feed, own_z = known.pop("feed", None), known.pop("z_end", None)
    shape = _shape(segment, reading, here.point, unit)
    z, feed = here.z if own_z is None else own_z, here.feed if own_feed is None else own_feed
    for name, value in (("z_end", z), ("feed", feed)):
        if name in values:
            carry(values, name, value, unit)
    ahead = Here(shape.end or _typed_end(known), z, feed)
    return Draft(segment, unit, own_z, own_feed, reading, shape, here, ahead)


def carried(draft: Draft, here: Here) -> Draft:
    """The same segment with Z END and FEED carried over from another one before it."""
    values = dict(draft.reading.values)
    z = here.z if draft.z is None else draft.z
    feed = here.feed if draft.feed is None else draft.feed
    for name, value in (("z_end", z), ("feed", feed)):
        if name in values and not isinstance(values[name], Entry | Unread):
            values[name] = None
            carry(values, name, value, draft.unit)
    ahead = Here(draft.ahead.point, z, feed)
    reading = Reading(values, draft.reading.known, draft.reading.findings)
    return Draft(draft.segment, draft.unit, draft.z, draft.feed, reading, draft.shape, here, ahead)


def _shape(segment: Segment, reading: Reading, start: Point | None, unit: Unit) -> Shape:
    match segment:
        case LineSegment():
            return _solved(line.TASK, reading, start, segment.choice, unit)
        case ArcSegment():
            task = arc.task(arc.turn_of(segment.direction))
            return _solved(task, reading, start, segment.choice, unit)
        case BlendSegment():
            return _blend(reading, start)
        case _:
            assert_never(segment)


def _blend(reading: Reading, corner: Point | None) -> Shape:
    if reading.values["radius"] is not None:
        return Shape(end=corner)
    text = "Not determined yet: enter RADIUS."
    return Shape(end=corner, missing=("radius",), findings=(Finding("MISSING", Severity.ERROR, text, field="radius"),))


def _solved(task: Task, reading: Reading, start: Point | None, choice: int | None, unit: Unit) -> Shape:
    """A line or an arc: one solution, the picked one, or none with the reason."""
    if start is None:
        return Shape()
    outcome = solve(task, start, reading.known)
    pieces = outcome.pieces
    if len(pieces) > 1 and (choice is None or choice >= len(pieces)):
        pick = Finding("PICK_SOLUTION", Severity.ERROR, "Two solutions fit: pick one on SOLUTION.", field="choice")
        return Shape(choices=pieces, sketch=pieces[0], findings=(pick,))
    if not pieces:
        return _unsolved(task, outcome, reading, start)
    piece = pieces[choice or 0] if len(pieces) > 1 else pieces[0]
    if _too_far(piece):
        text = "This segment leads farther than any machine goes: check its numbers."
        return Shape(findings=(Finding("OUT_OF_RANGE", Severity.ERROR, text, field=task.shape[0]),))
    _calculate(reading, piece, unit)
    if piece.length > JOINED:
        said = circle_finding(piece, reading.known, unit) if isinstance(piece, Arc) else None
        told = () if said is None else (said,)
        return Shape(piece, piece.end, choices=pieces if len(pieces) > 1 else (), findings=told)
    text = "This segment has no length: it is passed over."
    return Shape(end=start, findings=(Finding("ZERO_LENGTH", Severity.WARNING, text),))


def _too_far(piece: Piece) -> bool:
    """Whether a piece ends beyond any machine, or its center leaves the numbers that are still exact."""
    x, y = piece.end
    if abs(x) > FARTHEST or abs(y) > FARTHEST:
        return True
    return isinstance(piece, Arc) and max(map(abs, piece.center)) > LARGEST


def _unsolved(task: Task, outcome: Outcome, reading: Reading, start: Point) -> Shape:
    """Nothing fits yet; what is missing is not told while a typed field of the shape is itself at fault."""
    faulty = any(finding.field in task.shape for finding in reading.findings)
    told = () if outcome.finding is None or (faulty and outcome.missing) else (outcome.finding,)
    sketch = line.sketch if task is line.TASK else arc.sketch
    drawn = sketch(start, reading.known)
    return Shape(missing=outcome.missing, sketch=drawn, findings=told)


def _typed_end(known: Known) -> Point | None:
    """The end where both its coordinates are typed, so that later segments start there all the same."""
    return (known["x_end"], known["y_end"]) if "x_end" in known and "y_end" in known else None


def _calculate(reading: Reading, piece: Piece, unit: Unit) -> None:
    """Fill the blanks of a determined line or arc."""
    values = reading.values
    if isinstance(piece, Line):
        fill(values, {"x_end": piece.end[0], "y_end": piece.end[1], "length": piece.length}, unit)
        fill_angle(values, "angle", line.heading(piece))
        return
    assert isinstance(piece, Arc)
    (x_end, y_end), (x_center, y_center) = piece.end, piece.center
    places = {"x_end": x_end, "y_end": y_end, "x_center": x_center, "y_center": y_center, "radius": piece.radius}
    fill(values, places, unit)
    fill_angle(values, "sweep", abs(piece.sweep))
