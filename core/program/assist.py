"""The calculated fields: a block with every blank that the typed fields determine.

A segment starts where the one before it ends.  Of its own fields those that are blank are calculated as
`Solved`; Z END and FEED carry over from the segment before, on the first from Z BOTTOM and PLUNGE FEED.  A blank
X END or Y END does not carry over: the line or arc then is not determined, and says what is missing.  Where two
solutions fit, the order is documented in `solve_line` and `solve_arc`, and the segment's `choice` picks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain, compress, count, repeat
from math import hypot
from operator import is_not
from typing import assert_never

from core.finding import Finding, Severity
from core.geometry.piece import Arc, Line, Piece, Point
from core.program import solve_arc, solve_line
from core.program.fields import FARTHEST, Form
from core.program.full_circle import circle_finding
from core.program.model import ArcSegment, BlendSegment, Block, Entry, LineSegment, Program, Segment, Unread
from core.program.reading import Reading, carry, fill, fill_angle, read
from core.program.solution import Known, Outcome, Task, solve
from core.program.solve_blend import Blends, blended
from core.program.solve_start import Start, solve_start
from core.program.solved import SolvedBlock, SolvedSegment
from core.records import dataclass
from core.tolerance import CLOSED, JOINED, LARGEST
from core.units import Unit


def solve_block(block: Block, program: Program, before: SolvedBlock | None = None) -> SolvedBlock:
    """The block with its blanks calculated; trouble is in its findings, never raised.

    Segments that are the same objects as in `before`, and begin with the same, are taken from there.
    """
    start = solve_start(block, program)
    drafts = _drafts(block, start, program.unit, () if before is None else before.drafts)
    segments = _segments(block, drafts, before)
    determined = next(
        (index for index, one in enumerate(segments) if one.start is None or one.end is None), len(segments)
    )
    known = start.known
    return SolvedBlock(
        values=start.values,
        segments=tuple(segments),
        closed=determined == len(segments) and _closed(segments),
        determined=determined,
        tool_diameter=start.tool.diameter,
        tool_type=start.tool.type,
        finish_diameter=start.finish.diameter,
        z_start=known.get("z_start"),
        z_bottom=known.get("z_bottom"),
        plunge_feed=known.get("plunge_feed"),
        speed=known.get("speed"),
        peck_depth=known.get("peck_depth", 0.0),
        findings=start.findings,
        pieces=tuple((one.number, one.piece) for one in segments[:determined] if one.piece is not None),
        drafts=tuple(drafts),
    )


def _closed(segments: list[SolvedSegment]) -> bool:
    """Whether the last programmed end is START again; a contour without any length is not closed."""
    if not any(segment.piece for segment in segments):
        return False
    first, last = segments[0].start, segments[-1].end
    if first is None or last is None:
        return False
    return hypot(last[0] - first[0], last[1] - first[1]) <= CLOSED


@dataclass(frozen=True, slots=True)
class _Here:
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
    shape: _Shape
    here: _Here
    ahead: _Here


def _segments(block: Block, drafts: list[Draft], before: SolvedBlock | None) -> list[SolvedSegment]:
    blends = _blends(block, drafts)
    off = blends.faults.keys() | blends.waiting
    # a draft that is kept has the place it had
    olds = () if before is None else zip(before.drafts, before.segments, strict=False)
    each = zip(drafts, blends.pieces, chain(olds, repeat((None, None))), strict=False)
    # a segment stands as it was where it is the same draft and no blend made anything else of it than before
    return [
        old
        if was is draft and old is not None and old.piece is piece and old.end is draft.shape.end and index not in off
        else _finished(draft, index, blends)
        for index, (draft, piece, (was, old)) in enumerate(each)
    ]


def _blends(block: Block, drafts: list[Draft]) -> Blends:
    """The surface with its blends, mostly none."""
    pieces = [draft.shape.piece for draft in drafts]
    blend = [index for index, segment in enumerate(block.segments) if isinstance(segment, BlendSegment)]
    if not blend:
        return Blends(pieces)
    radii = {index: drafts[index].reading.known["radius"] for index in blend if "radius" in drafts[index].reading.known}
    shapes = (draft.shape for draft in drafts)
    lengthless = (index for index, shape in enumerate(shapes) if shape.piece is None and shape.end is not None)
    return blended(block.segments, blend, pieces, radii, frozenset(lengthless).difference(blend))


def _drafts(block: Block, start: Start, unit: Unit, before: Sequence[Draft]) -> list[Draft]:
    """Every segment solved by itself; those that are kept, and take over what they took, are taken run by run."""
    here = _Here(start.point, start.known.get("z_bottom"), start.known.get("plunge_feed"))
    segments = block.segments
    # all drafts of a block are of one unit
    kept = before if before and before[0].unit is unit else ()
    others = map(is_not, segments, [old.segment for old in kept])
    anew = [*compress(count(), others), *range(len(kept), len(segments))]
    drafts: list[Draft] = []
    for index in (*anew, len(segments)):
        while len(drafts) < index:
            old = before[len(drafts)]
            # behind a segment that is kept it is the same object
            if old.here is here or old.here == here:
                drafts += before[len(drafts) : index]
            elif old.here.point == here.point:
                drafts.append(_carried(old, here))
            else:
                drafts.append(_draft(segments[len(drafts)], len(drafts) + 1, here, unit))
            here = drafts[-1].ahead
        if index < len(segments):
            drafts.append(_draft(segments[index], index + 1, here, unit))
            here = drafts[-1].ahead
    return drafts


def _draft(segment: Segment, number: int, here: _Here, unit: Unit) -> Draft:
    """A segment that takes over a point, and Z and feed where its own are blank."""
    reading = read(_FORMS[type(segment)], segment, unit, number)
    values, known = reading.values, reading.known
    own_feed, own_z = known.pop("feed", None), known.pop("z_end", None)
    shape = _shape(segment, reading, here.point, unit)
    z, feed = here.z if own_z is None else own_z, here.feed if own_feed is None else own_feed
    for name, value in (("z_end", z), ("feed", feed)):
        if name in values:
            carry(values, name, value, unit)
    ahead = _Here(shape.end or _typed_end(known), z, feed)
    return Draft(segment, unit, own_z, own_feed, reading, shape, here, ahead)


def _carried(draft: Draft, here: _Here) -> Draft:
    """The same segment with Z END and FEED carried over from another one before it."""
    values = dict(draft.reading.values)
    z = here.z if draft.z is None else draft.z
    feed = here.feed if draft.feed is None else draft.feed
    for name, value in (("z_end", z), ("feed", feed)):
        if name in values and not isinstance(values[name], Entry | Unread):
            values[name] = None
            carry(values, name, value, draft.unit)
    ahead = _Here(draft.ahead.point, z, feed)
    reading = Reading(values, draft.reading.known, draft.reading.findings)
    return Draft(draft.segment, draft.unit, draft.z, draft.feed, reading, draft.shape, here, ahead)


def _finished(draft: Draft, index: int, blends: Blends) -> SolvedSegment:
    shape, here, ahead = draft.shape, draft.here, draft.ahead
    fault = blends.faults.get(index)
    told = shape.findings if fault is None else (*shape.findings, fault)
    own = tuple(replace(finding, segment=index + 1) for finding in told) if told else ()
    return SolvedSegment(
        index + 1,
        draft.reading.values,
        blends.pieces[index],
        shape.missing,
        shape.choices,
        here.point,
        None if index in blends.waiting else shape.end,
        shape.sketch,
        here.z or 0.0,
        ahead.z or 0.0,
        ahead.feed,
        draft.reading.findings + own,
    )


_FORMS = {LineSegment: Form.LINE, ArcSegment: Form.ARC, BlendSegment: Form.BLEND}


@dataclass(frozen=True, slots=True)
class _Shape:
    """A segment's part of the surface, or what is to be told of it instead."""

    piece: Piece | None = None
    end: Point | None = None
    missing: tuple[str, ...] = ()
    choices: tuple[Piece, ...] = ()
    sketch: Piece | None = None
    findings: tuple[Finding, ...] = ()


def _shape(segment: Segment, reading: Reading, start: Point | None, unit: Unit) -> _Shape:
    match segment:
        case LineSegment():
            return _solved(solve_line.TASK, reading, start, segment.choice, unit)
        case ArcSegment():
            task = solve_arc.task(solve_arc.turn_of(segment.direction))
            return _solved(task, reading, start, segment.choice, unit)
        case BlendSegment():
            return _blend(reading, start)
        case _:
            assert_never(segment)


def _blend(reading: Reading, corner: Point | None) -> _Shape:
    if reading.values["radius"] is not None:
        return _Shape(end=corner)
    text = "Not determined yet: enter RADIUS."
    return _Shape(end=corner, missing=("radius",), findings=(Finding("MISSING", Severity.ERROR, text, field="radius"),))


def _solved(task: Task, reading: Reading, start: Point | None, choice: int | None, unit: Unit) -> _Shape:
    """A line or an arc: one solution, the picked one, or none with the reason."""
    if start is None:
        return _Shape()
    outcome = solve(task, start, reading.known)
    pieces = outcome.pieces
    if len(pieces) > 1 and (choice is None or choice >= len(pieces)):
        pick = Finding("PICK_SOLUTION", Severity.ERROR, "Two solutions fit: pick one on SOLUTION.", field="choice")
        return _Shape(choices=pieces, sketch=pieces[0], findings=(pick,))
    if not pieces:
        return _unsolved(task, outcome, reading, start)
    piece = pieces[choice or 0] if len(pieces) > 1 else pieces[0]
    if _too_far(piece):
        text = "This segment leads farther than any machine goes: check its numbers."
        return _Shape(findings=(Finding("OUT_OF_RANGE", Severity.ERROR, text, field=task.shape[0]),))
    _calculate(reading, piece, unit)
    if piece.length > JOINED:
        said = circle_finding(piece, reading.known, unit) if isinstance(piece, Arc) else None
        told = () if said is None else (said,)
        return _Shape(piece, piece.end, choices=pieces if len(pieces) > 1 else (), findings=told)
    text = "This segment has no length: it is passed over."
    return _Shape(end=start, findings=(Finding("ZERO_LENGTH", Severity.WARNING, text),))


def _too_far(piece: Piece) -> bool:
    """Whether a piece ends beyond any machine, or its centre leaves the numbers that are still exact."""
    x, y = piece.end
    if abs(x) > FARTHEST or abs(y) > FARTHEST:
        return True
    return isinstance(piece, Arc) and max(map(abs, piece.centre)) > LARGEST


def _unsolved(task: Task, outcome: Outcome, reading: Reading, start: Point) -> _Shape:
    """Nothing fits yet; what is missing is not told while a typed field of the shape is itself at fault."""
    faulty = any(finding.field in task.shape for finding in reading.findings)
    told = () if outcome.finding is None or (faulty and outcome.missing) else (outcome.finding,)
    sketch = solve_line.sketch if task is solve_line.TASK else solve_arc.sketch
    drawn = sketch(start, reading.known)
    return _Shape(missing=outcome.missing, sketch=drawn, findings=told)


def _typed_end(known: Known) -> Point | None:
    """The end where both its coordinates are typed, so that later segments start there all the same."""
    return (known["x_end"], known["y_end"]) if "x_end" in known and "y_end" in known else None


def _calculate(reading: Reading, piece: Piece, unit: Unit) -> None:
    """Fill the blanks of a determined line or arc."""
    values = reading.values
    if isinstance(piece, Line):
        fill(values, {"x_end": piece.end[0], "y_end": piece.end[1], "length": piece.length}, unit)
        fill_angle(values, "angle", solve_line.heading(piece))
        return
    assert isinstance(piece, Arc)
    (x_end, y_end), (x_center, y_center) = piece.end, piece.centre
    places = {"x_end": x_end, "y_end": y_end, "x_center": x_center, "y_center": y_center, "radius": piece.radius}
    fill(values, places, unit)
    fill_angle(values, "sweep", abs(piece.sweep))
