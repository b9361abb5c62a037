"""This module decides which segments are solved together as a run, solves the run and fills in its segments.

CALCULATED_RUNS.md, section 5, says which they are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import repeat
from math import cos, dist, sin

from core.finding import Finding, Severity
from core.geometry.oriented import line_through
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.program.fields import form_of
from core.program.model import ArcSegment, CornerSegment, LineSegment, Segment
from core.program.solve.reading import Reading, heading_at
from core.program.solve.run import reasons
from core.program.solve.run.branch import MAX_RUN_LENGTH, Branch, Element, Parallel, Run
from core.program.solve.run.fitting_number import with_fitting_number
from core.program.solve.run.from_pick import Picked, picked_answers
from core.program.solve.run.search import search
from core.program.solve.segment import (
    TURNS,
    Carried,
    Draft,
    SegmentResult,
    axis_kept_from,
    calculate,
    draft_of_result,
    solve_segment,
)
from core.program.solve.solved import Origin, RunAnswer, SolvedRun
from core.tolerance import JOINED
from core.units import Unit, from_mm

RELATIONS = ("point_x", "point_y", "point_dist", "parallel", "offset", "start_angle", "start_angle_inc", "angle_inc")
"""Data that relate a segment to a point or another segment; the rules for a segment by itself do not use them."""

SKETCH_SHARE = 0.2
"""Length drawn for an element of which only the heading is known, as a fraction of the run's size."""

END_DATA = {"x_end", "y_end", "x_end_inc", "y_end_inc", "length", "sweep"}
"""Data that fix where an element ends along its line or circle; the last element of a run needs one of them."""

KEPT_COORDINATE = ("x_end_inc", "y_end_inc")
"""By axis, the relative end coordinate that is 0 for a LINE that keeps the coordinate of its start."""

MAX_SQUARE_COSINE = 1e-9
"""Largest cosine of the angle between a line and an axis at which they count as square."""


DraftedRun = tuple[tuple[Draft, ...], SolvedRun | None]
"""The drafts of a run's segments, including corners, and the run as the screens use it; None if it was not tried."""


@dataclass(frozen=True, slots=True)
class TypedContour:
    """The segments of a block, their typed fields, and the drafts of the segments before the run."""

    segments: Sequence[Segment]
    readings: Sequence[Reading]
    drafts: Sequence[Draft]
    unit: Unit


def run_at(contour: TypedContour, index: int, own_draft: Draft) -> DraftedRun | None:
    """Return the run that begins at a segment; None if `own_draft`, from the segment's own fields, is enough."""
    segment = contour.segments[index]
    if own_draft.before.point is None or isinstance(segment, CornerSegment):
        return None
    chosen_by_next = len(own_draft.result.choices) > 1 and _tied(contour, _next(contour, index))
    tied = _relational(contour, index)
    undetermined = own_draft.result.end is None and not own_draft.result.choices
    contradicted = undetermined and any(finding.code != "MISSING" for finding in own_draft.result.findings)
    if not (tied or chosen_by_next or undetermined) or (contradicted and not tied):
        return None
    if _tied(contour, index) and own_draft.before.heading is None:
        # the segment to which it is tied must be determined first
        return (
            draft_of_result(segment, contour.readings[index], own_draft.before, SegmentResult(), contour.unit),
        ), None
    run = _solved(contour, index, own_draft.before, 1 if tied else 2)
    if chosen_by_next and not tied and (run is None or not _decides(run, own_draft)):
        return None
    alone = None if tied or chosen_by_next else _run_to(contour, [index], own_draft.before)
    if alone is not None and search(alone).stuck is None and search(alone).answers:
        # its own data determine it, although the rules for a segment by itself do not
        run = _narrowed(contour, alone, own_draft.before)
    if run is None:
        run = _unsolved(contour, index, own_draft.before)
        if len(run.elements) == 1 and not tied:
            return None
    return _result(contour, run, own_draft)


def _decides(run: Run, own_draft: Draft) -> bool:
    """True if the run leaves fewer solutions for its first segment than the segment has by itself."""
    left = {_rounded(answer.pieces[:1]) for answer in search(run).answers}
    return 0 < len(left) < len(own_draft.result.choices)


# which segments make a run


def _next(contour: TypedContour, index: int) -> int | None:
    """Return the index of the next LINE or ARC, None if there is none."""
    after = range(index + 1, len(contour.segments))
    return next((at for at in after if not isinstance(contour.segments[at], CornerSegment)), None)


def _relational(contour: TypedContour, index: int) -> bool:
    """True if a typed field relates the segment to a point or to another segment."""
    segment = contour.segments[index]
    known = contour.readings[index].known
    return getattr(segment, "tangent", False) or any(name in known for name in RELATIONS)


def _tied(contour: TypedContour, index: int | None) -> bool:
    """True if a segment's heading is tied to the segment before it."""
    if index is None:
        return False
    known = contour.readings[index].known
    relative = "angle_inc" in known or "start_angle_inc" in known
    return relative or (getattr(contour.segments[index], "tangent", False) and tangent_fault(contour, index) is None)


def tangent_fault(contour: TypedContour, index: int) -> Finding | None:
    """Return why TANGENT is not allowed at a segment, None if it is allowed or not set."""
    if not getattr(contour.segments[index], "tangent", False):
        return None
    if index == 0:
        text = "Segment 1 has no segment before it to which it could be tangent: blank TANGENT."
    elif isinstance(contour.segments[index - 1], CornerSegment):
        corner = form_of(contour.segments[index - 1])
        text = f"TANGENT cannot follow a {corner}, which stands at a corner: blank TANGENT or delete the {corner}."
    else:
        return None
    return Finding("TANGENT_PLACE", Severity.ERROR, text, field="tangent")


def _candidate_runs(contour: TypedContour, first: int) -> Iterator[tuple[int, ...]]:
    """Yield the indices of runs of one, two ... LINEs and ARCs from `first` on, up to the first that ends.

    The longest has as many elements as are solved together.
    """
    indices: tuple[int, ...] = ()
    at: int | None = first
    while at is not None and len(indices) < MAX_RUN_LENGTH:
        indices = (*indices, at)
        yield indices
        at = None if _ends_run(contour, indices) else _next(contour, at)


def _ends_run(contour: TypedContour, indices: Sequence[int]) -> bool:
    """True if a run ends at a typed point and no later segment refers to it."""
    known, after = contour.readings[indices[-1]].known, _next(contour, indices[-1])
    if not ("x_end" in known and "y_end" in known):
        return False
    if after is None:
        return True
    numbers = {index + 1 for index in indices}
    later = contour.readings[after : after + MAX_RUN_LENGTH]
    return not _tied(contour, after) and not any(reading.known.get("parallel") in numbers for reading in later)


def _solved(contour: TypedContour, first: int, before: Carried, least: int) -> Run | None:
    """Return the shortest run from a segment on that the solver settles, with or without answers; None if none.

    It has at least `least` elements: a segment that is tied to no other has its own rules.
    """
    for indices in _candidate_runs(contour, first):
        run = _run_to(contour, indices, before) if len(indices) >= least else None
        if run is not None and search(run).stuck is None:
            return _narrowed(contour, run, before)
    return None


def _run_to(contour: TypedContour, indices: Sequence[int], before: Carried) -> Run | None:
    """Return a run; None if too few data are typed."""
    if not contour.readings[indices[-1]].known.keys() & END_DATA:
        return None
    run = _run(contour, indices, before)
    return run if run.enough else None


def _narrowed(contour: TypedContour, run: Run, before: Carried) -> Run:
    """Extend the run by the segments tied to its end while they leave fewer answers."""
    indices, count = list(run.indices), len(run.elements)
    while len(search(run).answers) > 1 and len(indices) < MAX_RUN_LENGTH:
        after = _next(contour, indices[-1])
        if after is None or not _tied(contour, after):
            break
        indices.append(after)
        longer = _run_to(contour, indices, before)
        if longer is None or search(longer).stuck is not None:
            continue
        left, left_by_longer = (
            len({_rounded(answer.pieces[:count]) for answer in search(each).answers}) for each in (run, longer)
        )
        if left_by_longer < left:
            run, count = longer, len(indices)
    return run


def _rounded(pieces: Sequence[Piece]) -> tuple[float, ...]:
    """Return the rounded ends and centers of an answer's pieces, by which answers are compared."""
    return tuple(round(value, 4) for piece in pieces for value in (*piece.end, *getattr(piece, "center", ())))


def _unsolved(contour: TypedContour, first: int, before: Carried) -> Run:
    """Return the run whose missing data are reported: up to the first typed end, else up to the longest."""
    *_, indices = _candidate_runs(contour, first)
    return _run(contour, indices, before)


# the data of a run


def _run(contour: TypedContour, indices: Sequence[int], before: Carried) -> Run:
    assert before.point is not None
    starts = (before.point, *repeat(None, len(indices) - 1))
    elements = tuple(_element(contour, *each, indices) for each in zip(indices, starts, strict=True))
    return Run(before.point, before.heading, elements)


def _element(contour: TypedContour, index: int, start: Point | None, indices: Sequence[int]) -> Element:
    segment, known = contour.segments[index], contour.readings[index].known
    data = {name: value for name, value in known.items() if name not in _NO_SHAPE}
    if known.get("parallel") is None:
        data.pop("offset", None)
    for name in () if start is None else _implied_by_angle(data, start):
        # the heading implies it already: do not count it twice
        del data[name]
    kept = axis_kept_from(start, segment, contour.readings[index])
    if kept is not None:
        data.setdefault(KEPT_COORDINATE[kept], 0.0)
    link = 0.0 if _tied(contour, index) else None
    link = known.get("angle_inc", known.get("start_angle_inc", link))
    turn = TURNS[segment.direction] if isinstance(segment, ArcSegment) else Turn.NONE
    return Element(index + 1, turn, tuple(data.items()), link, _parallel(contour, index, indices))


def _implied_by_angle(data: dict[str, float], start: Point) -> list[str]:
    """Name the typed end coordinates of a line from a known start that its typed XY ANGLE already implies."""
    if "angle" not in data:
        return []
    implied: dict[str, float] = {}
    if abs(cos(data["angle"])) <= MAX_SQUARE_COSINE:
        implied |= {"x_end": start[0], "x_end_inc": 0.0}
    if abs(sin(data["angle"])) <= MAX_SQUARE_COSINE:
        implied |= {"y_end": start[1], "y_end_inc": 0.0}
    return [name for name, value in implied.items() if name in data and abs(data[name] - value) <= JOINED]


_NO_SHAPE = ("z_end", "feed", "pick_x", "pick_y", "parallel", "angle_inc", "start_angle_inc")


def _parallel(contour: TypedContour, index: int, indices: Sequence[int]) -> Parallel | None:
    """Return the target of PARALLEL TO: the index of a line in the run, or a solved line before it."""
    target = contour.readings[index].known.get("parallel")
    if target is None or parallel_fault(contour, index) is not None:
        return None
    at = int(target) - 1
    if at in indices:
        return indices.index(at)
    piece = contour.drafts[at].result.piece if at < len(contour.drafts) else None
    return line_through(piece.start, heading_at(piece, piece.start)) if isinstance(piece, Line) else None


def parallel_fault(contour: TypedContour, index: int) -> Finding | None:
    """Return why the number in PARALLEL TO is not allowed, None if it is."""
    target = contour.readings[index].known.get("parallel")
    if target is None:
        return None
    number, at = index + 1, int(target) - 1
    if at >= index:
        text = f"PARALLEL TO {target:.0f} is not before segment {number}: enter the number of an earlier LINE."
    elif not isinstance(contour.segments[at], LineSegment):
        text = f"PARALLEL TO {target:.0f}: segment {target:.0f} is not a LINE. Enter the number of an earlier LINE."
    else:
        return None
    return Finding("PARALLEL_TO", Severity.ERROR, text, field="parallel")


def reference_faults(contour: TypedContour, index: int) -> tuple[Finding, ...]:
    """Return the faults in a segment's references to other segments."""
    faults = (tangent_fault(contour, index), parallel_fault(contour, index), _relative_fault(contour, index))
    return tuple(fault for fault in faults if fault is not None)


def _relative_fault(contour: TypedContour, index: int) -> Finding | None:
    known = contour.readings[index].known
    for name, label in (("angle_inc", "XY ANGLE"), ("start_angle_inc", "START ANGLE")):
        if name in known and index == 0:
            text = f"Segment 1 has no segment before it: enter {label} without I."
            return Finding("TANGENT_PLACE", Severity.ERROR, text, field=name.removesuffix("_inc"))
    return None


# the drafts of a run


def _result(contour: TypedContour, run: Run, own_draft: Draft) -> DraftedRun:
    """Return the drafts of a run and the run itself: solved, or waiting for a pick or for data, with the reason."""
    picked = _picked(contour, run)
    answers = _answers(run, picked)
    taken, finding = _taken(contour, run, answers, picked)
    first, last = run.elements[0].number, run.elements[-1].number
    code = None if finding is None else finding.code
    sketch = tuple(piece for piece in (*_sketches(run), _chord_to_end(run)) if piece is not None)
    solved = SolvedRun(first, last, answers, taken, code, max(0, run.missing), () if taken is not None else sketch)
    if taken is not None:
        results = _determined(contour, dict(answers[taken].pieces), own_draft.before)
    else:
        assert finding is not None
        results = _waiting(contour, run, own_draft, finding)
    return _drafts(contour, run, own_draft.before, results), solved


def _picked(contour: TypedContour, run: Run) -> Picked | None:
    """Return the answers near the operator's pick if the steps do not solve the run; None without a usable pick."""
    known = contour.readings[run.indices[0]].known
    if search(run).stuck is None or run.missing > 0 or not ("pick_x" in known and "pick_y" in known):
        return None
    return picked_answers(run, (known["pick_x"], known["pick_y"]))


def _answers(run: Run, picked: Picked | None) -> tuple[RunAnswer, ...]:
    if picked is None and search(run).stuck is not None:
        return ()
    numbers = [element.number for element in run.elements]
    answers = search(run).answers if picked is None else picked.answers
    numbered = [(tuple(zip(numbers, answer.pieces, strict=True)), answer) for answer in answers]
    if picked is None:
        return tuple(RunAnswer(pieces, answer.choice) for pieces, answer in numbered)
    return tuple(RunAnswer(pieces, pick=answer.pieces[picked.joint - 1].end) for pieces, answer in numbered)


def _taken(
    contour: TypedContour, run: Run, answers: tuple[RunAnswer, ...], picked: Picked | None
) -> tuple[int | None, Finding | None]:
    """Return the index of the answer in force, or the finding that explains why there is none."""
    result = search(run)
    if picked is not None and answers:
        return picked.taken, None if picked.taken is not None else reasons.pick_nearer(run, len(answers))
    if result.stuck is not None:
        return None, _why_stuck(contour, run, result.stuck, pick_tried=picked is not None)
    if not answers:
        return None, with_fitting_number(run, result.findings[0])
    choice = getattr(contour.segments[run.indices[0]], "choice", None)
    if choice is None and len(answers) == 1:
        return 0, None
    taken = next((at for at, answer in enumerate(answers) if answer.choice == choice), None)
    if taken is not None:
        return taken, None
    return None, reasons.pick_solution(run, len(answers), picked=choice is not None)


def _why_stuck(contour: TypedContour, run: Run, stuck: Branch, *, pick_tried: bool) -> Finding:
    if run.missing > 0:
        return reasons.missing(stuck, run.missing, _may_be_tangent(contour, stuck))
    for index in range(1, len(run.elements)):
        if stuck.joint(index) is None and _on_same_curve(stuck, index):
            return reasons.coincident(run, index)
    return reasons.unsolvable(run, _may_be_tangent(contour, stuck), tried=pick_tried)


def _may_be_tangent(contour: TypedContour, stuck: Branch) -> int | None:
    """Return the number of the first segment of a run where TANGENT YES would add a value.

    It adds none on segment 1, after a BLEND ARC or CHAMFER, or if both headings at the joint are already known.
    """
    heading = stuck.run.heading
    for index, element in enumerate(stuck.run.elements):
        both_known = heading is not None and stuck.heading_in[index] is not None
        behind_corner = element.number > 1 and isinstance(contour.segments[element.number - 2], CornerSegment)
        if element.number > 1 and element.link is None and not both_known and not behind_corner:
            return element.number
        heading = stuck.heading_out[index]
    return None


def _on_same_curve(branch: Branch, joint: int) -> bool:
    """True if both elements at an unknown joint have known lines or known circles, which must then coincide."""
    first, second = branch.line(joint - 1), branch.line(joint)
    if first is not None and second is not None:
        return True
    centers = branch.center(joint - 1), branch.center(joint)
    circles = branch.rho[joint - 1] is not None and branch.rho[joint] is not None
    return circles and centers[0] is not None and centers[1] is not None


def _determined(contour: TypedContour, pieces: dict[int, Piece], before: Carried) -> dict[int, SegmentResult]:
    """Fill the blanks of a solved run's segments; return their results by index."""
    start = before.point
    for number, piece in pieces.items():
        segment, reading = contour.segments[number - 1], contour.readings[number - 1]
        kept = axis_kept_from(start, segment, reading)
        if kept is not None:
            reading.fill(
                KEPT_COORDINATE[kept].removesuffix("_inc"), from_mm(piece.end[kept], contour.unit), Origin.SAME
            )
        calculate(reading, piece, contour.unit)
        start = None
    return {number - 1: SegmentResult(piece, piece.end) for number, piece in pieces.items()}


def _waiting(contour: TypedContour, run: Run, own_draft: Draft, finding: Finding) -> dict[int, SegmentResult]:
    """Return the results of an undetermined run by index; the finding goes to the segment it names."""
    sketches = zip(run.indices, _sketches(run), strict=True)
    results = {index: SegmentResult(sketch=sketch) for index, sketch in sketches}
    first, lacking = run.indices[0], finding.code == "MISSING"
    assert finding.segment is not None
    at = int(finding.segment) - 1
    faulty = finding.code in ("MISSING", "NOT_YET") and bool(contour.readings[at].findings)
    missing = (finding.field,) if lacking and finding.field else ()
    results[at] = replace(results[at], missing=missing, findings=() if faulty else (finding,))
    if lacking:
        results[first] = replace(results[first], missing=own_draft.result.missing or results[first].missing)
    return results


def _drafts(contour: TypedContour, run: Run, before: Carried, results: dict[int, SegmentResult]) -> tuple[Draft, ...]:
    """Return the drafts of a run's segments, including corners, each from what the one before passes on."""
    drafts: list[Draft] = []
    for index in range(run.indices[0], run.indices[-1] + 1):
        segment, reading = contour.segments[index], contour.readings[index]
        result = results.get(index)
        if result is None:
            drafts.append(solve_segment(segment, reading, before, contour.unit))
        else:
            drafts.append(draft_of_result(segment, reading, before, result, contour.unit))
        before = drafts[-1].after
        if result is not None and result.piece is None and index != run.indices[-1]:
            joint = search(run).known.joint(run.indices.index(index) + 1)
            before = replace(before, point=joint or before.point)
    return tuple(drafts)


def _chord_to_end(run: Run) -> Line | None:
    """Return the chord from the run's start to its typed end, None if that end is not typed or too near."""
    known = run.elements[-1].known
    if "x_end" not in known or "y_end" not in known:
        return None
    end = (known["x_end"], known["y_end"])
    return Line(run.start, end) if dist(run.start, end) > JOINED else None


def _sketches(run: Run) -> list[Piece | None]:
    """Return what can be drawn of each element of an undetermined run."""
    return [_sketch(run, search(run).known, index) for index in range(len(run.elements))]


def _sketch(run: Run, known: Branch, index: int) -> Piece | None:
    """Return a chord between known ends, a full circle, or a line in a known heading; None if too little is known."""
    start, end, center, rho = known.joint(index), known.joint(index + 1), known.center(index), known.rho[index]
    if start is not None and end is not None:
        return Line(start, end) if dist(start, end) > JOINED else None
    if center is not None and rho is not None:
        at = (center[0] + abs(rho), center[1])
        return Arc(at, at, center, run.elements[index].turn)
    size = known.length[index] or SKETCH_SHARE * run.size
    leaving, arriving = known.heading_in[index], known.heading_out[index]
    if size <= JOINED:
        return None
    if start is not None and leaving is not None:
        return Line(start, (start[0] + size * cos(leaving), start[1] + size * sin(leaving)))
    if end is not None and arriving is not None:
        return Line((end[0] - size * cos(arriving), end[1] - size * sin(arriving)), end)
    return None
