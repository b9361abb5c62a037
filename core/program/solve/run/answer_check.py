"""This module checks an answer: it walks the chain from its start and compares every typed number with the actual one.

A branch that disagrees is dropped, so that surplus data choose among branches (CALCULATED_RUNS.md, section 4).
"""

from __future__ import annotations

from math import dist, hypot, remainder, sin, tau

from core.finding import Finding
from core.geometry import construct
from core.geometry.oriented import OrientedLine, direction
from core.geometry.piece import ANGLE_ROUNDING, Arc, Line, Piece, Point
from core.program.fields import LARGEST_LENGTH
from core.program.solve.reading import ANGLE_FIELDS, heading_at, measured
from core.program.solve.rules import angles_agree
from core.program.solve.run import reasons
from core.program.solve.run.branch import Branch, Element, Run
from core.tolerance import AGREES, ARC_RADII, CLOSED, JOINED, LARGEST_COORDINATE

Pieces = tuple[Piece, ...]
"""A run's pieces, joined end to start; `objections` finds what disagrees with them."""


def chain_of(branch: Branch) -> tuple[Pieces | None, tuple[Finding, ...]]:
    """Return the pieces of a complete branch and the objections to them; none if a piece cannot be made."""
    run = branch.run
    pieces: list[Piece] = []
    findings: list[Finding] = []
    for index, element in enumerate(run.elements):
        # the end of an arc may have moved onto its circle
        start, end = pieces[-1].end if pieces else run.start, branch.joint(index + 1)
        assert end is not None
        out_of_range = max(map(abs, end)) > LARGEST_LENGTH
        piece: Piece | None
        if element.turn:
            center = branch.center(index)
            assert center is not None
            piece, piece_objections = _arc(element, start, end, center)
            out_of_range = out_of_range or max(map(abs, center)) > LARGEST_COORDINATE
        else:
            piece, piece_objections = _line(run, index, start, end, branch)
        if out_of_range:
            findings.append(reasons.out_of_range(branch, index))
        findings += piece_objections
        if piece is None:
            return None, tuple(findings)
        pieces.append(piece)
    return tuple(pieces), (*findings, *objections(run, tuple(pieces)))


def _line(run: Run, index: int, start: Point, end: Point, branch: Branch) -> tuple[Line | None, list[Finding]]:
    """Return a line, with an objection if it runs against its heading; None if it has no length."""
    heading = branch.heading_in[index]
    vector = (end[0] - start[0], end[1] - start[1])
    if hypot(*vector) <= JOINED:
        return None, [reasons.no_length(run.elements[index])]
    if heading is not None:
        tx, ty = direction(heading)
        travel = vector[0] * tx + vector[1] * ty
        if travel < 0.0:
            return Line(start, end), [reasons.line_runs_backward(run, index, -travel, heading)]
    return Line(start, end), []


def _arc(element: Element, start: Point, end: Point, center: Point) -> tuple[Arc | None, list[Finding]]:
    """Return an arc; None with an objection if its radii at both ends differ or it has no length."""
    radius, end_radius = dist(start, center), dist(end, center)
    if dist(start, end) <= CLOSED:
        if not _full(element, start):
            return None, [reasons.no_length(element)]
        return Arc(start, start, center, element.turn), []
    if abs(radius - end_radius) > ARC_RADII:
        return None, [reasons.radii_differ(element, radius, end_radius)]
    arc = construct.exact_arc(start, end, center, element.turn)
    if arc.length <= JOINED:
        return None, [reasons.no_length(element)]
    return arc, []


def _full(element: Element, start: Point) -> bool:
    """True if an arc that ends at its start is typed as a full circle: by SWEEP ANGLE, or with center and end."""
    known = element.known
    if "sweep" in known:
        return known["sweep"] >= tau - ANGLE_ROUNDING
    typed = all(name in known for name in ("x_end", "y_end", "x_center", "y_center"))
    return typed and dist(start, (known["x_end"], known["y_end"])) <= JOINED


def objections(run: Run, pieces: Pieces) -> tuple[Finding, ...]:
    """Return a finding for every typed number that the pieces do not match."""
    findings: list[Finding] = []
    before = run.heading
    for index, (element, piece) in enumerate(zip(run.elements, pieces, strict=True)):
        findings += _field_objections(run, index, element, piece)
        leaving = heading_at(piece, piece.start)
        if element.link is not None and before is not None:
            turned = leaving - before - element.link
            if not angles_agree(remainder(turned, tau), piece):
                findings.append(reasons.not_linked(run, index, element.link, leaving - before))
        findings += _parallel(run, pieces, index)
        before = heading_at(piece, piece.end)
    return tuple(findings)


def _field_objections(run: Run, index: int, element: Element, piece: Piece) -> list[Finding]:
    """Return the disagreements with an element's own fields."""
    findings = []
    for name, actual in measured(piece).items():
        typed = element.known.get(name)
        if typed is None:
            continue
        if name in ANGLE_FIELDS:
            if not angles_agree(remainder(typed - actual, tau), piece):
                findings.append(reasons.angle_differs(run, index, name, typed, actual))
        elif abs(typed - actual) > ARC_RADII:
            findings.append(reasons.length_differs(run, index, name, typed, actual))
    point = element.point
    if point is not None:
        distance, typed = _distance(piece, point), element.known.get("point_dist", 0.0)
        if abs(distance - typed) > ARC_RADII:
            findings.append(reasons.point_missed(element, point, typed, distance))
    return findings


def _distance(piece: Piece, point: Point) -> float:
    """Return the distance of a point from the infinite line or full circle of a piece."""
    if isinstance(piece, Arc):
        return abs(dist(point, piece.center) - piece.radius)
    tx, ty = piece.direction_at(piece.start)
    return abs(tx * (point[1] - piece.start[1]) - ty * (point[0] - piece.start[0]))


def _parallel(run: Run, pieces: Pieces, index: int) -> list[Finding]:
    """Return the disagreement with PARALLEL TO or OFFSET, if any."""
    element, piece = run.elements[index], pieces[index]
    parallel = element.parallel
    if parallel is None or not isinstance(piece, Line):
        return []
    if isinstance(parallel, OrientedLine):
        heading, (nx, ny) = parallel.heading, parallel.normal
        distance = abs(nx * piece.start[0] + ny * piece.start[1] - parallel.offset)
    else:
        target = pieces[parallel]
        heading, distance = heading_at(target, target.start), _distance(target, piece.start)
    actual = heading_at(piece, piece.start)
    difference = actual - heading
    if abs(sin(difference)) > AGREES and abs(sin(difference)) * piece.length > ARC_RADII:
        return [reasons.not_parallel(element, heading, actual)]
    typed = element.known.get("offset")
    if typed is not None and abs(distance - typed) > ARC_RADII:
        return [reasons.length_differs(run, index, "offset", typed, distance)]
    return []
