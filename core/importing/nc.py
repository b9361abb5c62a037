"""NC in: the contours of an NC program, by the reader and the rules of its control.

A program that the control compensates gives the contour as programmed, without the moves that lead in and out.  One of
the tool's center gives the contour that this path is the offset of; it is proved by compensating it again.  Passes of
one contour at several depths, or with several radii, are one contour.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import dist, pi
from typing import Final, NamedTuple

from core.comp.compensate import compensate
from core.comp.lookahead import HIGHEST, LOWEST, calculated
from core.controls.compared_contours import Parting, apart
from core.controls.contours_and_leads import contours_of
from core.controls.control_run import ControlRun, Stretch
from core.controls.control_tools import ToolTable
from core.controls.moves import Moves, Plane
from core.controls.program_text import lines_of
from core.controls.registry import UnknownControl, is_klartext, run
from core.finding import Severity
from core.geometry.construct import even_arc
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.importing.contour import Contour, ContourKind
from core.importing.joints import carriers_meet, joined_chain
from core.importing.segments import ImportedBlock, block_of
from core.program.edit import set_tool
from core.program.model import Block, CutterComp, Number, Program, Tool
from core.tolerance import CLOSED, JOINED
from core.units import Unit, from_mm, sentence, to_mm

SAME_CONTOUR: Final = 0.001
"""Millimeters within which passes are of one contour, and a contour's own path is that of the program."""

SAME_HEIGHT: Final = 1e-4
LEAD_SLACK: Final = 0.002
"""Millimeters by which the radii of a lead-in and its lead-out may differ."""

QUARTER: Final = 0.01
"""Radians by which the arc of a lead may differ from a quarter turn."""

TANGENT: Final = 0.01
"""Radians by which a lead may differ from the direction of the contour."""

CORNER_RADIUS: Final = 0.002
"""Millimeters: a contour's arc smaller than that is a corner, about which the tool's center turned."""


class NcError(Exception):
    """An NC program gives no contour; the text says why, with the line.

    `needs_center`: the operator must say side and diameter.
    """

    def __init__(self, text: str, *, needs_center: bool = False) -> None:
        super().__init__(text)
        self.needs_center = needs_center


@dataclass(frozen=True, slots=True)
class CenterPath:
    """What the operator says of a program of the tool's center: the side of the tool, None for ON, and its diameter.

    The diameter is in the program's unit.
    """

    side: Side | None
    diameter: float


class Cut(NamedTuple):
    """A piece with its feed (mm/min), its height at the end, and its line."""

    piece: Piece
    feed: float
    z: float
    line: int


@dataclass(frozen=True, eq=False, slots=True)
class NcContour:
    """A contour of a program.

    `radius` is that of the last pass in millimeters, None where the tool's center runs on the contour; `depths` are
    those of its passes in their order.  `tool` and `speed` are the last ones named before it.
    """

    cuts: tuple[Cut, ...]
    side: Side | None
    radius: float | None
    depths: tuple[float, ...]
    tool: int | None
    speed: float | None
    plunge_feed: float | None = None
    lookahead: int | None = None
    """The look-ahead that makes the program's path of it, None for the calculated one."""
    notes: tuple[str, ...] = ()

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The contour."""
        return tuple(cut.piece for cut in self.cuts)

    @property
    def closed(self) -> bool:
        """Whether it ends where it starts."""
        return dist(self.cuts[0].piece.start, self.cuts[-1].piece.end) <= CLOSED


@dataclass(frozen=True, eq=False, slots=True)
class NcProgram:
    """The contours of a program, in its unit."""

    unit: Unit
    contours: tuple[NcContour, ...]
    notes: tuple[str, ...] = ()


def read_nc(
    text: bytes, control: str, tools: ToolTable, *, unit: Unit | None = None, center: CenterPath | None = None
) -> NcProgram:
    """The contours of a program on a control.  Raises NcError; `center` is needed where nothing is compensated."""
    made = run(text, control, tools, unit)
    if isinstance(made, UnknownControl):
        raise NcError(made.text)
    _refuse_alarm(made)
    words = _Words.of(text, klartext=is_klartext(made.control))
    if made.stretches:
        passes = [contour for stretch in made.stretches for contour in _programmed(made, stretch, words)]
    elif center is None:
        words_needed = "The program runs the tool's center: its side and the tool's diameter are needed."
        raise NcError(words_needed, needs_center=True)
    else:
        passes = list(_center_passes(made, center, words))
    if not passes:
        raise NcError("The program has no move in the XY plane at a feed.")
    return NcProgram(made.unit, tuple(_grouped(passes)), _run_notes(made))


def _refuse_alarm(made: ControlRun) -> None:
    if made.stopped_at is None:
        return
    errors = [finding for finding in made.findings if finding.severity is Severity.ERROR]
    why = next((finding for finding in errors if finding.line == made.stopped_at), errors[0] if errors else None)
    words = "" if why is None else f": {sentence(why, made.unit)}"
    raise NcError(f"{made.control} stops at line {made.stopped_at}{words}")


def _run_notes(made: ControlRun) -> tuple[str, ...]:
    errors = [finding for finding in made.findings if finding.severity is Severity.ERROR]
    return tuple(f"line {finding.line}: {sentence(finding, made.unit)}" for finding in errors)


@dataclass(frozen=True, slots=True)
class _Words:
    """Tool numbers and speeds by the lines in which they stand."""

    tools: tuple[tuple[int, float], ...]
    speeds: tuple[tuple[int, float], ...]

    @staticmethod
    def of(text: bytes, *, klartext: bool) -> _Words:
        lines = [_without_comments(line) for line in lines_of(text)]
        tool = re.compile(r"TOOL\s+CALL\s+(\d+)" if klartext else r"(?<![A-Z])T\s*(\d+)(?!\s*//)", re.IGNORECASE)
        speed = re.compile(r"(?<![A-Z])S\s*(\d+\.?\d*)", re.IGNORECASE)
        return _Words(*(tuple(_named(lines, word)) for word in (tool, speed)))

    def tool(self, line: int) -> int | None:
        """The tool in use at a line."""
        value = _last_before(self.tools, line)
        return None if value is None else int(value)

    def speed(self, line: int) -> float | None:
        """The speed in use at a line."""
        return _last_before(self.speeds, line)


def _without_comments(line: str) -> str:
    return re.sub(r"\([^)]*\)", " ", line).partition(";")[0]


def _named(lines: Sequence[str], word: re.Pattern[str]) -> Iterator[tuple[int, float]]:
    for number, line in enumerate(lines, 1):
        for match in word.finditer(line):
            yield number, float(match[1])


def _last_before(values: Sequence[tuple[int, float]], line: int) -> float | None:
    return next((value for at, value in reversed(values) if at <= line), None)


def _programmed(made: ControlRun, stretch: Stretch, words: _Words) -> Iterator[NcContour]:
    """The contours of a compensated stretch as programmed."""
    if stretch.plane is not Plane.XY:
        line = int(stretch.programmed.lines[-1])
        raise NcError(f"Line {line}: the contour is in the {stretch.plane.name} plane; only XY can be imported.")
    if stretch.changes:
        line = int(stretch.programmed.lines[stretch.changes[0].programmed])
        raise NcError(f"Line {line}: the side or the radius changes within the contour.")
    rows = stretch.programmed.part(stretch.entry, len(stretch.programmed) - stretch.exit)
    plunge = _plunge_feed(made.moves, stretch.first)
    for cuts in _contours(list(_cuts(rows)), stretch.side):
        yield _contour(cuts, stretch.side, stretch.radius, words, plunge)


def _contour(
    cuts: list[Cut], side: Side | None, radius: float | None, words: _Words, plunge: float | None
) -> NcContour:
    first = cuts[0].line
    return NcContour(tuple(cuts), side, radius, (cuts[0].z,), words.tool(first), words.speed(first), plunge)


def _plunge_feed(moves: Moves, row: int) -> float | None:
    """The feed of the last move straight down before a row, or in it."""
    for index in range(min(row + 1, len(moves) - 1), 0, -1):
        move, before = moves[index], moves[index - 1]
        if not move.rapid and move.point[2] < before.point[2] - SAME_HEIGHT and move.feed > 0.0:
            return move.feed
    return None


def _cuts(moves: Moves) -> Iterator[Cut]:
    """The moves that move in XY, with exact arcs; row 0 is where they start."""
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
            arc = even_arc(at, end, (move.center[0], move.center[1]), Turn(move.turn))
            piece = arc if arc.end in (end, at) else replace(arc, end=end)
        yield Cut(piece, move.feed, move.point[2], move.line)
        at = piece.end


def _contours(cuts: list[Cut], side: Side | None) -> Iterator[list[Cut]]:
    """The contours among cuts in a row: closed ones without what leads to them, or the open one without its leads."""
    if not cuts:
        return
    path = Path.from_pieces([cut.piece for cut in cuts])
    for first, last in contours_of(path):
        part = cuts[first:last]
        if dist(part[0].piece.start, part[-1].piece.end) > CLOSED and side is not None:
            part = _without_overlap(_without_leads(part, side))
        yield part


MAX_OVERLAP: Final = 8
"""Pieces at the end of a contour among which the one that runs over its start is sought."""


def _without_overlap(cuts: list[Cut]) -> list[Cut]:
    """A contour that runs over its start and on along its beginning, without what it cuts twice."""
    start = cuts[0].piece.start
    for row in range(len(cuts) - 1, max(len(cuts) - MAX_OVERLAP, 1), -1):
        cut = cuts[row]
        if not _passes(cut.piece, start) or not _tangent(replace(cut.piece, end=start), cuts[0].piece):
            continue
        again = [cut.piece.end, *(later.piece.end for later in cuts[row + 1 :])]
        if all(any(_passes(first.piece, point) for first in cuts[:row]) for point in again):
            return [*cuts[:row], cut._replace(piece=replace(cut.piece, end=start))]
    return cuts


def _passes(piece: Piece, point: Point) -> bool:
    """Whether a piece runs over a point after its start."""
    if dist(piece.start, point) <= SAME_CONTOUR:
        return False
    if isinstance(piece, Arc):
        if abs(dist(piece.center, point) - piece.radius) > SAME_CONTOUR or piece.start == piece.end:
            return False
        return abs(replace(piece, end=point).sweep) <= abs(piece.sweep) + SAME_CONTOUR / piece.radius
    (x, y), (dx, dy) = piece.start, piece.direction_at(piece.start)
    along, off = (point[0] - x) * dx + (point[1] - y) * dy, (point[1] - y) * dx - (point[0] - x) * dy
    return abs(off) <= SAME_CONTOUR and 0.0 < along <= piece.length + SAME_CONTOUR


def _without_leads(cuts: list[Cut], side: Side) -> list[Cut]:
    """An open contour without the quarter circles that this program writes before and after it.

    Both are there, of one radius, tangent to the contour and on the tool's side.
    """
    if len(cuts) < 3:
        return cuts
    first, last = cuts[0].piece, cuts[-1].piece
    if not (isinstance(first, Arc) and isinstance(last, Arc)) or abs(first.radius - last.radius) > LEAD_SLACK:
        return cuts
    quarters = all(
        int(arc.turn) == side.sign and abs(abs(arc.sweep) - pi / 2.0) <= QUARTER for arc in (first, last)
    )  # fmt: skip
    tangent = _tangent(first, cuts[1].piece) and _tangent(cuts[-2].piece, last)
    return cuts[1:-1] if quarters and tangent else cuts


def _tangent(first: Piece, second: Piece) -> bool:
    (ux, uy), (vx, vy) = first.direction_at(first.end), second.direction_at(second.start)
    return abs(ux * vy - uy * vx) <= TANGENT and ux * vx + uy * vy > 0.0


def _center_passes(made: ControlRun, center: CenterPath, words: _Words) -> Iterator[NcContour]:
    """The contours of a program of the tool's center."""
    moves, radius = made.moves, to_mm(center.diameter, made.unit) / 2.0
    for first, last in _feed_runs(moves):
        plunge = _plunge_feed(moves, first)
        cuts = list(_cuts(moves.part(first, last)))
        if center.side is None:
            yield _contour(cuts, None, None, words, plunge)
            continue
        for part in _contours(cuts, center.side):
            surface, needed = offset_back(part, center.side, radius)
            made_contour = _contour(surface, center.side, radius, words, plunge)
            yield replace(made_contour, lookahead=needed)


def _feed_runs(moves: Moves) -> Iterator[tuple[int, int]]:
    """Rows (the start's, one after the last) of feed moves in XY without a rapid or a plunge between them."""
    begin: int | None = None
    for index in range(1, len(moves) + 1):
        inside = False
        if index < len(moves):
            move, before = moves[index], moves[index - 1]
            inside = not move.rapid and (move.point[:2] != before.point[:2] or move.turn != 0)
        if inside and begin is None:
            begin = index - 1
        elif not inside and begin is not None:
            yield begin, index
            begin = None


def offset_back(cuts: Sequence[Cut], side: Side, radius: float) -> tuple[list[Cut], int | None]:
    """The contour whose path at this radius and side the cuts are, and the look-ahead that it needs.

    The look-ahead is None where the calculated one makes the path.  NcError with the line where there is no contour.
    """
    kept = [(cut, piece) for cut in cuts if (piece := _shifted(cut, side, radius)) is not None]
    if not kept:
        raise NcError(f"Line {cuts[0].line}: the path only turns about a point; there is no contour.")
    ring = dist(cuts[0].piece.start, cuts[-1].piece.end) <= CLOSED
    closed = ring or dist(kept[0][1].start, kept[-1][1].end) <= CLOSED
    extended, corner_at_start = _extended(kept, closed=closed)
    pieces = joined_chain([cut.piece for cut in extended], closed=closed, tolerance=SAME_CONTOUR).pieces
    if len(pieces) != len(extended):
        raise NcError(f"Line {cuts[0].line}: no contour has this path.")
    contour = [cut._replace(piece=piece) for cut, piece in zip(extended, pieces, strict=True)]
    if ring and corner_at_start:
        contour = _from_side(contour)
    return contour, _proved(contour, cuts, side, radius, closed=closed)


def _from_side(contour: list[Cut]) -> list[Cut]:
    """A ring from the middle of its longest line on: started in an inside corner it would have another path."""
    lines = [row for row, cut in enumerate(contour) if isinstance(cut.piece, Line)] or list(range(len(contour)))
    row = max(lines, key=lambda row: contour[row].piece.length)
    cut = contour[row]
    middle = cut.piece.point_at(0.5)
    first, second = replace(cut.piece, end=middle), replace(cut.piece, start=middle)
    return [cut._replace(piece=second), *contour[row + 1 :], *contour[:row], cut._replace(piece=first)]


def _shifted(cut: Cut, side: Side, radius: float) -> Piece | None:
    """What the path's piece is the offset of; None where that is a corner."""
    piece = cut.piece
    if isinstance(piece, Line):
        dx, dy = piece.direction_at(piece.start)
        x, y = dy * side.sign * radius, -dx * side.sign * radius
        return Line((piece.start[0] + x, piece.start[1] + y), (piece.end[0] + x, piece.end[1] + y))
    size = piece.radius + radius * int(piece.turn) * side.sign
    if abs(size) <= CORNER_RADIUS:
        return None
    if size < 0.0:
        raise NcError(f"Line {cut.line}: an arc of the path is smaller than the tool and curves around the contour.")
    factor = size / piece.radius
    (cx, cy) = piece.center
    start, end = ((cx + (x - cx) * factor, cy + (y - cy) * factor) for x, y in (piece.start, piece.end))
    return Arc(start, start if piece.start == piece.end else end, piece.center, piece.turn)


def _extended(kept: Sequence[tuple[Cut, Piece]], *, closed: bool) -> tuple[list[Cut], bool]:
    """The pieces made longer up to the inside corners, and whether there is one at the start.

    Where carriers do not meet the tool has left material: there a line goes on from an arc along its tangent.
    """
    made = [cut._replace(piece=piece) for cut, piece in kept]
    result: list[Cut] = []
    corner = False
    for index in range(len(made)):
        following = (index + 1) % len(made)
        first, second = made[index], made[following]
        last = following == 0
        if (last and (not closed or len(made) == 1)) or dist(first.piece.end, second.piece.start) <= SAME_CONTOUR:
            result.append(first)
            continue
        corner = corner or last
        before, between, after = _to_corner(first, second)
        result += [before, *between]
        made[following] = after
        if last:
            result[0] = result[0]._replace(piece=replace(result[0].piece, start=after.piece.start))
    return result, corner


def _to_corner(first: Cut, second: Cut) -> tuple[Cut, list[Cut], Cut]:
    """Two pieces up to the corner between them, and the lines that lead there where they do not reach it."""
    one, other = first.piece, second.piece
    here, there = one.end, other.start
    if min(one.length, other.length) <= JOINED:
        # cut away by the corner before it
        raise NcError(f"Line {second.line}: no contour has this path.")
    meetings = carriers_meet(one, other)
    reach = 4.0 * dist(here, there) + SAME_CONTOUR
    near = [point for point in meetings if max(dist(point, here), dist(point, there)) <= reach]
    if near:
        at = min(near, key=lambda point: dist(point, here) + dist(point, there))
        return first._replace(piece=replace(one, end=at)), [], second._replace(piece=replace(other, start=at))
    tangents = [_tangent_line(one, end=True), _tangent_line(other, end=False)]
    meetings = carriers_meet(*tangents)
    if not meetings or max(dist(meetings[0], here), dist(meetings[0], there)) > reach:
        raise NcError(f"Line {second.line}: two pieces of the contour do not meet; no contour has this path.")
    at = meetings[0]
    if isinstance(one, Line):
        first = first._replace(piece=Line(one.start, at))
        return first, [first._replace(piece=Line(at, there), line=second.line)], second
    if isinstance(other, Line):
        return first, [first._replace(piece=Line(here, at))], second._replace(piece=Line(at, other.end))
    return first, [first._replace(piece=Line(here, at)), second._replace(piece=Line(at, there))], second


def _tangent_line(piece: Piece, *, end: bool) -> Line:
    """A line of length 1 along a piece at its end, or up to its start."""
    if end:
        (x, y), (dx, dy) = piece.end, piece.direction_at(piece.end)
        return Line((x, y), (x + dx, y + dy))
    (x, y), (dx, dy) = piece.start, piece.direction_at(piece.start)
    return Line((x - dx, y - dy), (x, y))


def _proved(contour: Sequence[Cut], cuts: Sequence[Cut], side: Side, radius: float, *, closed: bool) -> int | None:
    """Compensate the contour again and compare with the program's path: the look-ahead that makes it, None for CAL."""
    surface = Path.from_pieces([cut.piece for cut in contour])
    path = Path.from_pieces([cut.piece for cut in cuts], [float(cut.line) for cut in cuts])
    calculated_value = calculated(len(contour), closed=closed)
    best: Parting | None = None
    for value in dict.fromkeys((calculated_value, *range(LOWEST, HIGHEST + 1))):
        again = compensate(surface, side, radius, value, closed=closed).path
        if not len(again):
            continue
        parting = apart(path, again, SAME_CONTOUR) or apart(again, path, SAME_CONTOUR)
        if parting is None:
            return None if value == calculated_value else value
        best = parting if best is None or parting.distance < best.distance else best
    if best is None:
        raise NcError(f"Line {cuts[0].line}: no contour has this path.")
    raise NcError(
        f"Line {best.line or cuts[0].line}: no contour has this path; the nearest one is {best.distance:.3f} mm off. "
        "Is the diameter or the side another one?"
    )


def _grouped(passes: Sequence[NcContour]) -> list[NcContour]:
    """Passes of one contour as one: radius, feed, tool and speed are the last pass's, depths are all of them."""
    groups: list[list[NcContour]] = []
    for contour in passes:
        group = next((group for group in groups if _same(group[0], contour)), None)
        if group is None:
            groups.append([contour])
        else:
            group.append(contour)
    return [_one(group) for group in groups]


def _same(first: NcContour, second: NcContour) -> bool:
    if first.side is not second.side or len(first.cuts) != len(second.cuts):
        return False
    return all(
        type(one.piece) is type(other.piece)
        and dist(one.piece.start, other.piece.start) <= SAME_CONTOUR
        and dist(one.piece.point_at(0.5), other.piece.point_at(0.5)) <= SAME_CONTOUR
        and dist(one.piece.end, other.piece.end) <= SAME_CONTOUR
        for one, other in zip(first.cuts, second.cuts, strict=True)
    )


def _one(group: Sequence[NcContour]) -> NcContour:
    last, notes = group[-1], list[str]()
    radii = list(dict.fromkeys(round(contour.radius, 4) for contour in group if contour.radius is not None))
    if len(radii) > 1:
        notes.append(f"{len(radii)} radii are used on one contour: the last one is the tool's, {radii[-1]:g} mm.")
    tools = list(dict.fromkeys(contour.tool for contour in group))
    if len(tools) > 1:
        notes.append(f"Tools {', '.join(map(str, tools))} cut one contour: the last one is taken.")
    depths = tuple(contour.depths[0] for contour in group)
    return replace(last, depths=depths, notes=(*last.notes, *notes))


def nc_blocks(program: Program, read: NcProgram) -> tuple[Program, list[ImportedBlock]]:
    """The program with a block for each contour of an NC program, and the tools that were not in its table.

    Raises `segments.NotTaken`.
    """
    made: list[ImportedBlock] = []
    for number, contour in enumerate(read.contours, 1):
        program = _with_tool(program, contour)
        made.append(_block(number, contour, program))
    return replace(program, blocks=(*program.blocks, *(item.block for item in made))), made


def _with_tool(program: Program, contour: NcContour) -> Program:
    """The tool table with the contour's tool, unless it has one of that number."""
    if contour.tool is None or contour.radius is None or any(tool.number == contour.tool for tool in program.tools):
        return program
    diameter = Number(round(from_mm(2.0 * contour.radius, program.unit), 6))
    added = set_tool(program, Tool(contour.tool, diameter=diameter))
    return added if isinstance(added, Program) else program


def _block(number: int, contour: NcContour, program: Program) -> ImportedBlock:
    kind = ContourKind.OUTSIDE if contour.closed else ContourKind.OPEN
    pieces = contour.pieces
    plain = Contour(number, pieces, contour.closed, kind, (), len(pieces))
    item = block_of(plain, program)
    notes = [*contour.notes, *(note for note in item.notes if "is open" not in note)]
    block = _with_values(item.block, contour, program.unit, notes)
    return replace(item, block=block, notes=tuple(notes))


def _with_values(block: Block, contour: NcContour, unit: Unit, notes: list[str]) -> Block:
    """The block with side, tool, speed, feeds, heights and depths of the program."""
    side = contour.side
    comp = CutterComp.ON if side is None else CutterComp.LEFT if side is Side.LEFT else CutterComp.RIGHT
    block = replace(block, cutter_comp=comp)
    if contour.tool:
        block = replace(block, tool=Number(float(contour.tool)))
    if contour.lookahead is not None:
        block = replace(block, lookahead=Number(float(contour.lookahead)))
    if contour.speed:
        block = replace(block, speed=Number(contour.speed))
    if contour.plunge_feed:
        block = replace(block, plunge_feed=_typed(contour.plunge_feed, unit, 3))
    return _with_feeds_and_heights(_with_depths(block, contour, unit, notes), contour, unit)


def _typed(value: float, unit: Unit, decimals: int) -> Number:
    return Number(round(from_mm(value, unit), decimals) + 0.0)


def _with_depths(block: Block, contour: NcContour, unit: Unit, notes: list[str]) -> Block:
    """Z BOTTOM is the last depth; PECK DEPTH the step between depths, where it is one."""
    falling = [depth for depth in dict.fromkeys(round(depth, 4) for depth in contour.depths)]
    bottom = min(falling)
    block = replace(block, z_bottom=_typed(bottom, unit, 4))
    steps = [above - below for above, below in pairwise(falling)]
    if not steps:
        return block
    if min(steps) > 0.0 and max(steps) - min(steps) <= 2.0 * SAME_HEIGHT:
        top = falling[0] + steps[0]
        return replace(block, peck_depth=_typed(steps[0], unit, 4), z_start=_typed(top, unit, 4))
    shown = ", ".join(f"{from_mm(depth, unit):.4f}" for depth in falling)
    notes.append(f"The depths {shown} are not even steps: PECK DEPTH is not set.")
    return block


def _with_feeds_and_heights(block: Block, contour: NcContour, unit: Unit) -> Block:
    """Each segment with the feed, and the height at its end, where these are others than those before it."""
    feed, height, segments = None, contour.cuts[0].z, []
    for segment, cut in zip(block.segments, contour.cuts, strict=True):
        changes: dict[str, Number] = {}
        if cut.feed > 0.0 and cut.feed != feed:
            changes["feed"], feed = _typed(cut.feed, unit, 3), cut.feed
        if abs(cut.z - height) > SAME_HEIGHT:
            changes["z_end"], height = _typed(cut.z, unit, 4), cut.z
        segments.append(replace(segment, **changes))  # type: ignore[arg-type]
    return replace(block, segments=tuple(segments))
