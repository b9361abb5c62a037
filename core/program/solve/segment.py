"""This module solves one segment by itself, before blending: its piece of the surface, and what it passes on."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Final, assert_never

from core.finding import Finding, Severity
from core.geometry.construct import polar
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.program.fields import FIELDS_OF_FORM, LARGEST_LENGTH, LINE, form_of
from core.program.model import (
    ArcSegment,
    BlendSegment,
    ChamferSegment,
    CornerSegment,
    Direction,
    LineSegment,
    Number,
    Segment,
    Unread,
)
from core.program.solve.reading import Reading, heading_at, measured_fields
from core.program.solve.rules import (
    ARC_KIND,
    LINE_KIND,
    Known,
    Outcome,
    SegmentData,
    SegmentKind,
    adjustment,
    circle_finding,
    is_start,
    solve,
)
from core.program.solve.solved import Origin, Value
from core.tolerance import JOINED, LARGEST_COORDINATE
from core.units import Unit, from_mm

_END_FIELDS: Final = ("x_end", "y_end")

TURNS: Final = {Direction.CW: Turn.CW, Direction.CCW: Turn.CCW}


@dataclass(frozen=True, slots=True)
class SegmentResult:
    """The result for one segment: its piece, the missing fields, or the solutions to choose from."""

    piece: Piece | None = None
    end: Point | None = None
    missing: tuple[str, ...] = ()
    choices: tuple[Piece, ...] = ()
    sketch: Piece | None = None
    findings: tuple[Finding, ...] = ()
    adjustment: Finding | None = None
    """Reports that an arc was fitted to its numbers; a contour reports this once."""


@dataclass(frozen=True, slots=True)
class Carried:
    """What a segment takes over from the one before it: its end, Z and feed; None if not known."""

    point: Point | None
    typed: tuple[float | None, float | None]
    """X and Y of the end as typed, in program units; None for a calculated one."""
    z: float | None
    feed: float | None
    heading: float | None = None
    """The direction in which the segment before ends, before any blending."""
    feed_origin: Origin = Origin.CALCULATED


@dataclass(frozen=True, slots=True)
class Draft:
    """A solved segment before blending, with what it takes over and what it passes on."""

    reading: Reading
    result: SegmentResult
    before: Carried
    after: Carried


def typed_point(values: dict[str, Value], names: tuple[str, str]) -> tuple[float | None, float | None]:
    """Return X and Y of a point as typed, in program units; None for one that is not typed as a plain number."""
    x, y = values.get(names[0]), values.get(names[1])
    return x.value if isinstance(x, Number) else None, y.value if isinstance(y, Number) else None


def solve_segment(segment: Segment, reading: Reading, before: Carried, unit: Unit) -> Draft:
    """Solve a segment, which starts at the end of the one before it, from its own fields."""
    _keep_coordinate(segment, reading, before, unit)
    return draft_of_result(segment, reading, before, _result(segment, reading, before, unit), unit)


def draft_of_result(segment: Segment, reading: Reading, before: Carried, result: SegmentResult, unit: Unit) -> Draft:
    """Return the draft of a segment with this result; blank Z and feed are taken over from the segment before."""
    known = reading.known
    origin = Origin.CALCULATED if "feed" in known else before.feed_origin
    z, feed = known.get("z_end", before.z), known.get("feed", before.feed)
    reading.fill("feed", None if feed is None else from_mm(feed, unit), origin)
    if isinstance(segment, CornerSegment):
        return Draft(reading, result, before, Carried(result.end, before.typed, z, feed, before.heading, origin))
    reading.fill("z_end", None if z is None else from_mm(z, unit))
    # later segments start at a typed end even if this segment is not determined
    typed_end = (known["x_end"], known["y_end"]) if "x_end" in known and "y_end" in known else None
    typed = typed_point(reading.values, _END_FIELDS)
    kept = axis_kept_from(before.point, segment, reading)
    if kept is not None:
        # the kept coordinate is the number typed for the segment before
        typed = (before.typed[0], typed[1]) if kept == 0 else (typed[0], before.typed[1])
    heading = None if result.piece is None else heading_at(result.piece, result.piece.end)
    return Draft(reading, result, before, Carried(result.end or typed_end, typed, z, feed, heading, origin))


def shape_data(kind: SegmentKind, reading: Reading, start: Point) -> dict[str, float]:
    """Return a segment's typed shape data, with coordinates relative to its known start made absolute."""
    known = {name: value for name, value in reading.known.items() if name in kind.shape}
    for name, axis in (("x_end", 0), ("y_end", 1), ("x_center", 0), ("y_center", 1)):
        if name + "_inc" in reading.known:
            known[name] = start[axis] + reading.known[name + "_inc"]
    return known


def axis_kept_from(start: Point | None, segment: Segment, reading: Reading) -> int | None:
    """Return the axis (0 is X) whose coordinate a LINE keeps: its only typed shape field is the other end coordinate.

    Return None if it keeps none or would have no length.
    """
    if not isinstance(segment, LineSegment):
        return None
    shape = (field.name for field in LINE if field.name not in ("z_end", "feed"))
    typed = [name for name in shape if getattr(segment, name) not in (None, False)]
    if len(typed) != 1 or typed[0] not in _END_FIELDS or isinstance(getattr(segment, typed[0]), Unread):
        return None
    name, known = typed[0], reading.known
    axis = 1 - _END_FIELDS.index(name)
    if start is None:
        return axis
    step = known.get(name + "_inc", known[name] - start[1 - axis] if name in known else inf)
    return axis if abs(step) > JOINED else None


def _keep_coordinate(segment: Segment, reading: Reading, before: Carried, unit: Unit) -> None:
    """Fill the other end coordinate of a LINE with only one typed, from the segment before."""
    axis = axis_kept_from(before.point, segment, reading)
    names = (_END_FIELDS[1 - axis], _END_FIELDS[1 - axis] + "_inc") if axis is not None else ()
    if axis is not None and before.point is not None and any(name in reading.known for name in names):
        reading.known[_END_FIELDS[axis]] = before.point[axis]
        reading.fill(_END_FIELDS[axis], from_mm(before.point[axis], unit), Origin.SAME)


def _result(segment: Segment, reading: Reading, before: Carried, unit: Unit) -> SegmentResult:
    match segment:
        case BlendSegment() | ChamferSegment():
            return _corner(segment, reading, before.point)
        case _ if before.point is None:
            return SegmentResult()
        case LineSegment():
            data = SegmentData(before.point, shape_data(LINE_KIND, reading, before.point))
            return _solved(LINE_KIND, reading, data, segment.choice, unit)
        case ArcSegment():
            back = _ends_at_start(reading, before.point, before.typed, unit)
            data = SegmentData(
                before.point, shape_data(ARC_KIND, reading, before.point), back, TURNS[segment.direction]
            )
            return _solved(ARC_KIND, reading, data, segment.choice, unit)
        case _:
            assert_never(segment)


def _ends_at_start(reading: Reading, start: Point, typed: tuple[float | None, float | None], unit: Unit) -> bool:
    """True if each typed end coordinate of an arc is typed as that of its start."""
    end = typed_point(reading.values, _END_FIELDS)
    return all(
        value is None or is_start(value, here, here_typed, unit)
        for value, here, here_typed in zip(end, start, typed, strict=True)
    )


def _corner(segment: CornerSegment, reading: Reading, corner: Point | None) -> SegmentResult:
    size = FIELDS_OF_FORM[form_of(segment)][0]
    if reading.values[size.name] is not None:
        return SegmentResult(end=corner)
    missing = Finding("MISSING", Severity.ERROR, f"More data needed: type {size.label}.", field=size.name)
    return SegmentResult(end=corner, missing=(size.name,), findings=(missing,))


def _solved(kind: SegmentKind, reading: Reading, data: SegmentData, choice: int | None, unit: Unit) -> SegmentResult:
    """Solve a line or an arc: return its only solution, the picked one, or none with the reason."""
    outcome = solve(kind, data)
    pieces = outcome.pieces
    if len(pieces) > 1 and (choice is None or choice >= len(pieces)):
        pick = Finding("PICK_SOLUTION", Severity.ERROR, "Two solutions fit: pick one on SOLUTION.", field="choice")
        return SegmentResult(choices=pieces, sketch=pieces[0], findings=(pick,))
    if not pieces:
        return _unsolved(kind, outcome, reading, data.start)
    piece = pieces[choice or 0] if len(pieces) > 1 else pieces[0]
    if _too_far(piece):
        text = "This segment's end or center is beyond any machine's travel. Check its numbers."
        return SegmentResult(findings=(Finding("OUT_OF_RANGE", Severity.ERROR, text, field=kind.shape[0]),))
    calculate(reading, piece, unit)
    if piece.length <= JOINED:
        text = "No length: skipped. Type its end, or F1 deletes it."
        return SegmentResult(end=data.start, findings=(Finding("ZERO_LENGTH", Severity.WARNING, text),))
    choices = pieces if len(pieces) > 1 else ()
    if isinstance(piece, Line):
        return SegmentResult(piece, piece.end, choices=choices)
    finding = circle_finding(piece, data)
    findings = () if finding is None else (finding,)
    return SegmentResult(piece, piece.end, choices=choices, findings=findings, adjustment=adjustment(piece, data))


def _too_far(piece: Piece) -> bool:
    """True if a piece ends beyond any machine's travel, or its center is too far away for exact numbers."""
    x, y = piece.end
    if abs(x) > LARGEST_LENGTH or abs(y) > LARGEST_LENGTH:
        return True
    return isinstance(piece, Arc) and max(map(abs, piece.center)) > LARGEST_COORDINATE


def _unsolved(kind: SegmentKind, outcome: Outcome, reading: Reading, start: Point) -> SegmentResult:
    """Return the result if nothing fits; missing data are not reported while a typed shape field has a fault."""
    faulty = any(finding.field in kind.shape for finding in reading.findings)
    findings = () if outcome.finding is None or (faulty and outcome.missing) else (outcome.finding,)
    sketch = _sketch(start, shape_data(kind, reading, start))
    return SegmentResult(missing=outcome.missing, sketch=sketch, findings=findings)


def _sketch(start: Point, known: Known) -> Line | None:
    """Return the line or chord to draw dashed for an undetermined segment, toward as much of its end as is typed."""
    end = (known.get("x_end", start[0]), known.get("y_end", start[1]))
    if end == start and "length" in known and "angle" in known:
        end = polar(start, known["angle"], known["length"])
    return None if end == start else Line(start, end)


def calculate(reading: Reading, piece: Piece, unit: Unit) -> None:
    """Fill the blank fields of a determined line or arc."""
    for name, value in measured_fields(piece, unit).items():
        reading.fill(name, value)
