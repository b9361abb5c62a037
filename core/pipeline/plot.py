"""What is drawn of a block: surface, center path, blends, what was deleted, gouged and left, and the cutter."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from core.advice.trials import Row
from core.advice.work import Loop, Work
from core.comp.result import Compensated
from core.draw.scene import Scene, contour_scene, joined_scenes
from core.geometry.path import EMPTY, Floats, Path
from core.geometry.piece import Line, Piece, Point
from core.geometry.stretch import NO_PARTS, Parts, pieces_joined, stretches
from core.output.svg import svg
from core.pipeline.derived import Derived, DerivedBlock
from core.units import Unit


def svg_of(derived: Derived, *, title: str) -> str:
    """The whole program as one SVG drawing."""
    scenes = [block_scene(found, None, derived.program.unit) for found in derived.blocks]
    return svg(joined_scenes(scenes), title=title)


def block_scene(found: DerivedBlock, segment: int | None, unit: Unit, row: Row | None = None) -> Scene:
    """The block with the cursor on `segment` (0 is START, None nowhere), or with the path of a row of the table."""
    work, solved = found.work, found.solved
    loops, one, verdict = ((), None, None) if work is None else (work.loops, _shown(work), work.verdict)
    if row is not None:
        one, verdict = row.compensated, row.verdict
        loops = (Loop(one.path, one.lead_in, one.lead_out),)
    surface, first = _surface(found), loops[0] if loops else Loop(EMPTY, EMPTY, EMPTY)
    return contour_scene(
        surface,
        unit=unit,
        sketches=_sketches(found),
        path=first.path,
        further=[loop.path for loop in loops[1:]],
        leads=[lead for loop in loops for lead in (loop.lead_in, loop.lead_out)],
        rough=() if row is not None else _behind(work),
        deleted=NO_PARTS if one is None else _deleted(one),
        meetings=() if one is None else list(dict.fromkeys(zip(*one.deleted.at.T.tolist(), strict=True))),
        gouges=() if verdict is None else [gouge.surface_at for gouge in verdict.gouges],
        uncut=NO_PARTS if verdict is None or not verdict.uncut else stretches(surface, verdict.uncut.ends),
        cutter=_cutter(found, loops, one, segment),
        current=_current(found, segment),
        start=solved.segments[0].start if solved.segments else None,
    )


def _shown(work: Work) -> Compensated | None:
    """The control's path where it is the one that is posted: only then have its deletions a meaning."""
    return work.compensated if work.best is None else None


def _behind(work: Work | None) -> list[Path]:
    """The roughing passes, and the control's path where another one is posted."""
    if work is None:
        return []
    rough = [loop.whole for one in work.rough for loop in one.loops]
    return rough if work.compensated is None or _shown(work) is not None else [*rough, work.compensated.path]


def _surface(found: DerivedBlock) -> Path:
    if found.work is not None:
        return found.work.surface
    pieces = found.solved.pieces
    return Path.from_pieces([piece for _, piece in pieces], [float(number) for number, _ in pieces])


def _sketches(found: DerivedBlock) -> Parts:
    """Segments not determined yet: what is known of them, or the solutions the operator picks from."""
    pieces: list[Piece] = []
    for one in found.solved.segments[found.solved.determined :]:
        if one.piece is not None:
            pieces.append(one.piece)
        else:
            pieces += one.choices or ((one.sketch,) if one.sketch is not None else ())
    if not pieces:
        return NO_PARTS
    # a line between each and the next, which is not drawn: behind a number of one digit there may be a hundred
    parts = [part for one, behind in pairwise(pieces) for part in (one, Line(one.end, behind.start))] + pieces[-1:]
    return Parts(Path.from_pieces(parts), np.arange(len(parts)) % 2 == 0)


def _deleted(one: Compensated) -> Parts:
    if not len(one.deleted):
        return NO_PARTS
    sought, numbers = one.deleted.segments.copy(), one.contour.numbers
    sought.sort()
    nearest = sought.take(sought.searchsorted(numbers), mode="clip")
    return pieces_joined(one.contour, (nearest == numbers).nonzero()[0])


def _current(found: DerivedBlock, segment: int | None) -> Path | None:
    if not segment or segment > len(found.solved.segments):
        return None
    piece = found.solved.segments[segment - 1].piece
    return None if piece is None else Path.from_pieces([piece])


class Place(NamedTuple):
    """Where the cutter is drawn; `by` are the two pieces that meet there where they have deleted the segment."""

    at: Point
    by: tuple[float, float] | None = None


def cutter_at(found: DerivedBlock, segment: int) -> Place | None:
    """Where the cutter is drawn for a segment of the block's own path; None where no path belongs to the segment."""
    work = found.work
    return None if work is None else _place(work.loops, _shown(work), segment)


def _cutter(
    found: DerivedBlock, loops: Sequence[Loop], one: Compensated | None, segment: int | None
) -> tuple[Point, float] | None:
    place = None if segment is None else _place(loops, one, segment)
    return None if place is None or found.radius is None else (place.at, found.radius)


def _place(loops: Sequence[Loop], one: Compensated | None, segment: int) -> Place | None:
    """The end of a segment's path, the path's start for START, or where the path passes what was deleted."""
    for loop in loops:
        parts = [part for part in (loop.lead_in, loop.path, loop.lead_out) if len(part)]
        if not segment and parts:
            return Place(_point(parts[0].points[0]))
        for part in reversed(parts):
            if len(rows := (part.numbers == segment).nonzero()[0]):
                return Place(_point(part.ends[rows[-1]]))
    return None if one is None else _passed(one, segment)


def _point(row: Floats) -> Point:
    x, y = row.tolist()
    return x, y


def _passed(one: Compensated, segment: float) -> Place | None:
    """The meeting that deleted a segment; where a later one has deleted a piece of that pair too, the later one."""
    deleted = {each.segment: each for each in one.deleted}
    found = last = deleted.get(segment)
    while found is not None:
        last = found
        found = next((deleted[number] for number in found.by if number in deleted), None)
    return None if last is None else Place(last.at, last.by)
