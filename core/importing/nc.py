"""Reads the contours of an NC program, with the reader and the rules of its control.

A program that the control compensates gives the contour as programmed, without its lead-in and lead-out moves.  A
program of the tool center gives the contour whose offset is its path; compensating it again proves it.  Passes of
one contour at several depths, or with several radii, are one contour.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import dist, pi
from typing import Final

from core.controls.control_names import display_name
from core.controls.control_run import ControlRun, Stretch
from core.controls.control_tools import ToolTable
from core.controls.judging.contours_and_leads import split_where_it_closes
from core.controls.moves import Moves, Plane
from core.controls.registry import UnknownControl, resolve, run
from core.finding import Finding, Severity
from core.geometry.construct import exact_arc
from core.geometry.path import Path, runs_of
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.importing.nc_contour import SAME_HEIGHT, CenterPathTool, Cut, NcContour, NcError, NcProgram
from core.importing.offset_back import offset_back
from core.tolerance import CLOSED
from core.units import Unit, sentence, to_mm

SAME_CONTOUR: Final = 0.001
"""Largest distance in millimeters between passes of one contour."""

LEAD_SLACK: Final = 0.002
"""Largest difference in millimeters of the radii of a lead-in and its lead-out."""

QUARTER_TURN_TOLERANCE: Final = 0.01
"""Largest difference of a lead's arc from a quarter turn, in radians."""

MAX_TANGENT_ANGLE: Final = 0.01
"""Largest angle between a lead and the contour at their joint, in radians."""


def read_nc(
    text: bytes, control: str, tools: ToolTable, *, unit: Unit | None = None, center: CenterPathTool | None = None
) -> NcProgram:
    """Return the contours of a program on a control.  Raises NcError; `center` is needed if nothing is compensated."""
    if isinstance(known := resolve(control), UnknownControl):
        raise NcError(known.text)
    result = run(text, known, tools, unit)
    errors = [finding for finding in result.findings if finding.severity is Severity.ERROR]
    _refuse_alarm(result, errors)
    if result.stretches:
        passes = [contour for stretch in result.stretches for contour in _programmed(result, stretch)]
    elif center is None:
        message = "The program runs the tool's center: its side and the tool's diameter are needed."
        raise NcError(message, needs_center=True)
    else:
        passes = list(_center_passes(result, center))
    if not passes:
        raise NcError("The program has no move in the XY plane at a feed.")
    notes = tuple(f"line {finding.line}: {sentence(finding, result.unit)}" for finding in errors)
    return NcProgram(result.unit, tuple(_grouped(passes)), notes)


def _refuse_alarm(result: ControlRun, errors: Sequence[Finding]) -> None:
    if result.stopped_at is None:
        return
    why = next((finding for finding in errors if finding.line == result.stopped_at), errors[0] if errors else None)
    text = f"{display_name(result.control)} stops at line {result.stopped_at}"
    if why is None:
        raise NcError(text)
    raise NcError(f"{text}: {sentence(why, result.unit)}", tool=why.tool)


def _programmed(result: ControlRun, stretch: Stretch) -> Iterator[NcContour]:
    """Yield the contours of a compensated stretch as programmed."""
    if stretch.plane is not Plane.XY:
        line = int(stretch.programmed.lines[-1])
        raise NcError(f"Line {line}: the contour is in the {stretch.plane.name} plane; only XY can be imported.")
    if stretch.changes:
        row = stretch.changes[0].programmed
        before, after = map(int, stretch.programmed.lines[row - 1 : row + 1])
        raise NcError(f"The side or the radius of the tool changes within the contour, from line {before} to {after}.")
    rows = stretch.programmed.part(stretch.entry, len(stretch.programmed) - stretch.exit)
    for cuts, notes in _contours(list(_cuts(rows)), stretch.side):
        yield replace(_contour(cuts, stretch.side, stretch.radius, result, stretch.first), notes=notes)


def _contour(cuts: list[Cut], side: Side | None, radius: float | None, result: ControlRun, row: int) -> NcContour:
    """Return the contour of these cuts, whose moves start at a row."""
    _, tool, speed = result.spindle_at(row + 1)
    return NcContour(tuple(cuts), side, radius, (cuts[0].z,), tool, speed, _plunge_feed(result.moves, row))


def _plunge_feed(moves: Moves, row: int) -> float | None:
    """Return the feed of the last downward feed move up to the one that starts at a row."""
    for index in range(min(row + 1, len(moves) - 1), 0, -1):
        move, before = moves[index], moves[index - 1]
        if not move.rapid and move.point[2] < before.point[2] - SAME_HEIGHT and move.feed > 0.0:
            return move.feed
    return None


def _cuts(moves: Moves) -> Iterator[Cut]:
    """Yield the moves with motion in XY, with exact arcs; row 0 is their start."""
    at = (float(moves.points[0, 0]), float(moves.points[0, 1])) if len(moves) else (0.0, 0.0)
    for index in range(1, len(moves)):
        move = moves[index]
        end = (move.point[0], move.point[1])
        if move.turn and move.plane is not Plane.XY:
            raise NcError(f"Line {move.line}: an arc outside of the XY plane cannot be imported.")
        if end == at and not move.turn:
            continue
        piece: Piece = Line(at, end)
        if move.turn:
            arc = exact_arc(at, end, (move.center[0], move.center[1]), Turn(move.turn))
            piece = arc if arc.end in (end, at) else replace(arc, end=end)
        yield Cut(piece, move.feed, move.point[2], move.line)
        at = piece.end


def _contours(cuts: list[Cut], side: Side | None) -> Iterator[tuple[list[Cut], tuple[str, ...]]]:
    """Yield the contours among consecutive cuts: closed ones without their approach, or the open one without its leads.

    An open contour has a note if its first and last piece, which might be its own, were left out as leads.
    """
    if not cuts:
        return
    split = split_where_it_closes(Path.from_pieces([cut.piece for cut in cuts], range(len(cuts))))
    whole = [cuts[int(split.path.numbers[row])]._replace(piece=split.path[row]) for row in range(len(split.path))]
    for first, last in split.contours:
        part, notes = whole[first:last], tuple[str, ...]()
        if dist(part[0].piece.start, part[-1].piece.end) > CLOSED and side is not None:
            inner = _without_leads(part, side)
            if inner is not part:
                lines = f"{part[0].line} and {part[-1].line}"
                notes = (
                    f"The quarter circles of lines {lines} are taken for lead-in and lead-out: they are left out.",
                )
            part = inner
        yield part, notes


def _without_leads(cuts: list[Cut], side: Side) -> list[Cut]:
    """Return an open contour without the quarter circles that cutcomp writes before and after it.

    Both must be there, with one radius, tangent to the contour and on the tool's side.
    """
    if len(cuts) < 3:
        return cuts
    first, last = cuts[0].piece, cuts[-1].piece
    if not (isinstance(first, Arc) and isinstance(last, Arc)) or abs(first.radius - last.radius) > LEAD_SLACK:
        return cuts
    quarters = all(
        int(arc.turn) == side.sign and abs(abs(arc.sweep) - pi / 2.0) <= QUARTER_TURN_TOLERANCE for arc in (first, last)
    )  # fmt: skip
    tangent = _tangent(first, cuts[1].piece) and _tangent(cuts[-2].piece, last)
    return cuts[1:-1] if quarters and tangent else cuts


def _tangent(first: Piece, second: Piece) -> bool:
    (ux, uy), (vx, vy) = first.direction_at(first.end), second.direction_at(second.start)
    return abs(ux * vy - uy * vx) <= MAX_TANGENT_ANGLE and ux * vx + uy * vy > 0.0


def _center_passes(result: ControlRun, center: CenterPathTool) -> Iterator[NcContour]:
    """Yield the contours of a program of the tool center: runs of feed moves in XY, with no rapid or plunge between."""
    moves, radius = result.moves, to_mm(center.diameter, result.unit) / 2.0
    for rows in runs_of(moves.moving_in(Plane.XY) & ~moves.rapid):
        first, last = int(rows[0]) - 1, int(rows[-1]) + 1
        cuts = list(_cuts(moves.part(first, last)))
        if center.side is None:
            yield _contour(cuts, None, None, result, first)
            continue
        for part, notes in _contours(cuts, center.side):
            surface, needed = offset_back(part, center.side, radius)
            contour = _contour(surface, center.side, radius, result, first)
            yield replace(contour, lookahead=needed, notes=notes)


def _grouped(passes: Sequence[NcContour]) -> list[NcContour]:
    """Merge the passes of one contour: radius, feed, tool and speed are the last pass's, depths are from all."""
    groups: list[list[NcContour]] = []
    for contour in passes:
        group = next((group for group in groups if _same(group[0], contour)), None)
        if group is None:
            groups.append([contour])
        else:
            group.append(contour)
    return [_passes_as_one(group) for group in groups]


def _same(first: NcContour, second: NcContour) -> bool:
    if first.side is not second.side or len(first.cuts) != len(second.cuts):
        return False
    return all(
        type(piece) is type(other)
        and all(dist(piece.point_at(share), other.point_at(share)) <= SAME_CONTOUR for share in (0.0, 0.5, 1.0))
        for piece, other in zip(first.pieces, second.pieces, strict=True)
    )


def _passes_as_one(group: Sequence[NcContour]) -> NcContour:
    last, notes = group[-1], list[str]()
    radii = list(dict.fromkeys(round(contour.radius, 4) for contour in group if contour.radius is not None))
    if len(radii) > 1:
        notes.append(f"{len(radii)} radii are used on one contour: the last one is the tool's, {radii[-1]:g} mm.")
    tools = list(dict.fromkeys(contour.tool for contour in group))
    if len(tools) > 1:
        notes.append(f"Tools {', '.join(map(str, tools))} cut one contour: the last one is taken.")
    depths = tuple(contour.depths[0] for contour in group)
    return replace(last, depths=depths, notes=(*last.notes, *notes))
