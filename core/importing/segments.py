"""Writes a contour as a MILL CONTOUR block: START, LINE and ARC as a person would have typed them.

Numbers are rounded to the digits of the form if the contour stays in place; the form's own solver decides that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import degrees, dist
from typing import Final

from core.finding import Severity
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.importing.contour import Contour
from core.program.edit import new_block
from core.program.fields import LARGEST_LENGTH
from core.program.model import ArcSegment, Block, CutterComp, Direction, LineSegment, Number, Program, Segment
from core.program.solve.block import solve_block
from core.tolerance import ARC_RADII, CLOSED, GOUGE
from core.units import Kind, Unit, decimals_shown, from_mm

FINER_DECIMALS: Final = 6
"""Decimals for a contour that the form's digits would move too far."""

FINEST_DECIMALS: Final = 10
"""Decimals for a contour that even those would move too far: flat arcs of large radius."""

MAX_SEGMENTS: Final = 500
"""Above this many segments FIT ARCS is advised."""

NEARLY_FULL: Final = 0.01
"""An arc whose end is this close to its start, in millimeters, is given with its SWEEP ANGLE."""


@dataclass(frozen=True, slots=True)
class ImportedBlock:
    """A block made from a contour: the `decimals` of its numbers, and how far they `moved` it at most, in mm."""

    block: Block
    decimals: int
    moved: float
    notes: tuple[str, ...] = ()


class DoesNotFitError(Exception):
    """A contour does not fit into the form; the text says why."""


def block_of(contour: Contour, program: Program, side: CutterComp | None = None) -> ImportedBlock:
    """Return the contour as a block to be put after the program's own.  Raises DoesNotFitError.

    `side` is the operator's answer for an open contour, None if not asked.
    """
    unit = program.unit
    _refuse_far(contour, unit)
    usual = decimals_shown(Kind.LENGTH, unit)
    for decimals in (usual, FINER_DECIMALS, FINEST_DECIMALS):
        block = _block(contour, program, decimals)
        moved = _moved(block, contour, program)
        if moved is not None:
            if side is not None and not contour.closed:
                block = replace(block, cutter_comp=side)
            return ImportedBlock(block, decimals, moved, _notes(contour, decimals, usual, asked=side is not None))
    raise DoesNotFitError(f"Chain {contour.number} cannot be written as segments: its arcs are too flat or too short.")


def with_contours(
    program: Program, contours: Sequence[Contour], side: CutterComp | None = None
) -> tuple[Program, list[ImportedBlock]]:
    """Return the program with a block for each contour, in order, and the blocks; a single empty block is replaced.

    `side` is the operator's answer for open contours.  Raises DoesNotFitError.
    """
    made = [block_of(contour, program, side) for contour in contours]
    kept = program.blocks
    if len(kept) == 1 and not kept[0].segments and kept[0].x_start is None:
        kept = ()
        first = program.blocks[0]
        made = [replace(item, block=replace(item.block, tool=first.tool)) for item in made]
    return replace(program, blocks=(*kept, *(item.block for item in made))), made


def comment(name: str, contours: Sequence[Contour]) -> str:
    """Return the comment for a program's file: `# from plate.dxf, layer IZREZ`."""
    layers = list(dict.fromkeys(layer for contour in contours for layer in contour.layers))
    words = f"layer{'s' if len(layers) > 1 else ''} {', '.join(layers)}" if layers else ""
    text = f"from {name}{', ' if words else ''}{words}"
    return "# " + "".join(sign if sign.isprintable() else "?" for sign in text)


def _refuse_far(contour: Contour, unit: Unit) -> None:
    for piece in contour.pieces:
        points = (piece.start, piece.end, *((piece.center,) if isinstance(piece, Arc) else ()))
        worst = max((value for point in points for value in point), key=abs)
        if abs(worst) > LARGEST_LENGTH:
            most = from_mm(LARGEST_LENGTH, unit)
            if isinstance(piece, Arc) and max(map(abs, (*piece.start, *piece.end))) <= LARGEST_LENGTH:
                raise DoesNotFitError(
                    f"Chain {contour.number} has an arc of radius {from_mm(piece.radius, unit):.3f} {unit}, whose "
                    f"center lies farther away than the form takes, {most:g}. Draw it as lines."
                )
            raise DoesNotFitError(
                f"Chain {contour.number} reaches {from_mm(worst, unit):.3f} {unit}: "
                f"the form takes at most {most:g}. Move the drawing to its origin."
            )


def _notes(contour: Contour, decimals: int, usual: int, *, asked: bool) -> tuple[str, ...]:
    notes = []
    if decimals != usual:
        notes.append(
            f"Chain {contour.number} has {decimals} decimals: with {usual} it would move too far, or not close."
        )
    if len(contour.pieces) > MAX_SEGMENTS:
        notes.append(
            f"{len(contour.pieces):,} segments: the form shows them, the look-ahead of a control may not. FIT ARCS?"
        )
    if not contour.closed and not asked:
        notes.append(f"Chain {contour.number} is open: choose CUTTER COMP. on START.")
    return tuple(notes)


def _block(contour: Contour, program: Program, decimals: int) -> Block:
    unit = program.unit
    start = _start(contour, unit, decimals)
    segments: list[Segment] = []
    for row, piece in enumerate(contour.pieces):
        last = row == len(contour.pieces) - 1
        end = start if last and contour.closed else _typed(piece.end, unit, decimals)
        segments.append(_segment(piece, end, unit, decimals))
    comp = CutterComp.ON if contour.side is None else CutterComp(contour.side.value)
    x, y = map(Number, start)
    return replace(new_block(program), cutter_comp=comp, x_start=x, y_start=y, segments=tuple(segments))


def _start(contour: Contour, unit: Unit, decimals: int) -> Point:
    """Return START in program units, rounded; where it divides a line, to the tool's side of that line.

    Rounded to the other side it would be an inside corner of a few microns, and the path runs on into such a corner at
    START.  It goes around an outside one.
    """
    start, first, last = _typed(contour.start, unit, decimals), contour.pieces[0], contour.pieces[-1]
    if contour.side is None or len(contour.pieces) <= contour.drawn or not isinstance(first, Line):
        return start
    (ax, ay), (bx, by), digit = _typed(last.start, unit, decimals), _typed(first.end, unit, decimals), 10.0**-decimals
    xs, ys = ([round(value + step * digit, decimals) + 0.0 for step in (-1, 0, 1)] for value in start)
    near = [(x, y) for x in xs for y in ys]
    outside = (
        (x, y)
        for x, y in near
        # all factors are whole numbers of digits
        if contour.side.sign * ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) > -0.5 * digit**2
    )
    exact = [from_mm(value, unit) for value in contour.start]
    return min(outside, key=lambda point: dist(point, exact), default=start)


def _typed(point: Point, unit: Unit, decimals: int) -> Point:
    """Return a point in program units, rounded, without a negative zero."""
    x, y = (round(from_mm(value, unit), decimals) + 0.0 for value in point)
    return x, y


def _segment(piece: Piece, end: Point, unit: Unit, decimals: int) -> Segment:
    ends = Number(end[0]), Number(end[1])
    if not isinstance(piece, Arc):
        return LineSegment(*ends)
    center = _typed(piece.center, unit, decimals)
    direction = Direction.CCW if piece.turn is Turn.CCW else Direction.CW
    sweep = None
    if piece.start != piece.end and dist(piece.start, piece.end) <= NEARLY_FULL:
        sweep = Number(round(degrees(abs(piece.sweep)), FINER_DECIMALS))
    return ArcSegment(direction, *ends, x_center=Number(center[0]), y_center=Number(center[1]), sweep=sweep)


def _moved(block: Block, contour: Contour, program: Program) -> float | None:
    """Return how far the block's contour is from the drawing's; None if the form refuses it, or if it is too far.

    An arc ends on its circle, next to the numbers typed.  If a closed contour ends with one, it must still meet START,
    since the cutter gouges as deep as the gap.
    """
    pieces, solved = contour.pieces, solve_block(block, program)
    errors = [
        finding for segment in solved.segments for finding in segment.findings if finding.severity is Severity.ERROR
    ]
    made = [segment.piece for segment in solved.segments]
    if errors or len(made) != len(pieces):
        return None
    first, last = made[0], made[-1]
    if contour.closed and first is not None and last is not None and dist(first.start, last.end) > GOUGE:
        return None
    worst = 0.0
    for piece, original in zip(made, pieces, strict=True):
        if piece is None or isinstance(piece, Arc) is not isinstance(original, Arc):
            return None
        if isinstance(piece, Arc) and isinstance(original, Arc):
            turned = abs(abs(piece.sweep) - abs(original.sweep)) * original.radius
            if piece.turn is not original.turn or turned > 4.0 * ARC_RADII:
                return None
        worst = max(worst, *(dist(piece.point_at(share), original.point_at(share)) for share in (0.0, 0.5, 1.0)))
    return worst if worst <= min(ARC_RADII, CLOSED) else None
