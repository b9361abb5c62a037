"""A compensated stretch of a run as elements to be written anew, with moves into it and out of it that cut nothing.

Elements are numbered from 1 in their order; what leads in has the number 0, what leads out one more than the last.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.compensation.corners import Element, arc_element, beyond, line_element, square
from core.controls.contours_and_leads import contour_of
from core.controls.control_run import Run, Stretch
from core.controls.moves import Moves, Plane
from core.controls.write.iso_leads import Ready, merged, out_of, start_of
from core.controls.write.iso_style import Entry, IsoStyle
from core.controls.write.programmed_contour import End, Programmed, Terms
from core.geometry.path import Path
from core.geometry.piece import Arc, Piece, Point, Turn
from core.geometry.piece import Line as Straight
from core.tolerance import GOUGE, JOINED
from core.verify.judge import judge

REACHES: Final = (2.0, 1.25, 1.05, 0.5, 0.25, 0.1)
"""Lengths of the straight leads in radii, longest first."""

BLENDS: Final = (0.0, 1.0, 0.5, 0.25, 0.1)
"""Radii, in radii of the tool, of the quarter arcs between a straight lead and the contour; none is tried first."""

ABOVE: Final = 10.0
"""Millimeters from a contour's depth up to where the tool travels, at least."""

FEED: Final = 100.0
"""Millimeters a minute where the program gives no feed."""


@dataclass(frozen=True, slots=True)
class Untold:
    """Why a run's contours cannot be told to another control; the end of a sentence."""

    text: str


@dataclass(frozen=True, eq=False, slots=True)
class Traced:
    """A stretch's programmed elements, their lines in the program, its surface, and how it is run."""

    shape: Programmed
    lines: tuple[int, ...]
    stretch: Stretch
    terms: Terms
    surface: Path

    def end(self, corner: Point, way: Point, blend: float, sense: int) -> End:
        """The path's begin (`sense` 1) or its end (-1), with a quarter arc of radius `blend` or 0."""
        aside, radius = self.stretch.side.sign, self.stretch.radius
        off = square((0.0, 0.0), way, aside)
        at = beyond(beyond(corner, off, radius + blend), way, -sense * blend)
        if not blend:
            return End(at, corner, way, off, 0.0)
        return End(at, beyond(at, way, -sense * radius), way, off, blend)


def traced(source: Run, stretch: Stretch, tool: int) -> Traced | Untold:
    """A stretch of a run, with a tool's number; or why it cannot be told to another control."""
    moves = stretch.programmed
    line = int(moves.lines[min(1, len(moves) - 1)])
    if stretch.plane is not Plane.XY:
        return Untold(f"line {line} is compensated in another plane than XY")
    if stretch.radius <= JOINED:
        return Untold(f"the tool at line {line} has no radius")
    rows = _surface_rows(stretch)
    if not len(rows):
        return Untold(f"behind line {line} there is no contour")
    heights = np.stack((moves.points[rows, 2], moves.points[rows - 1, 2]), axis=1)
    uneven = np.flatnonzero((np.abs(heights - heights[0, 0]) > JOINED).any(axis=1))
    if len(uneven):
        return Untold(f"the tool axis moves under compensation at line {int(moves.lines[rows[uneven[0]]])}")
    shape = Programmed(
        tuple(_element(moves, row) for row in rows.tolist()), tuple(float(one) for one in range(1, len(rows) + 1))
    )
    whole = moves.part(int(rows[0]) - 1, int(rows[-1]) + 1).path()
    surface = whole.part(*contour_of(whole))
    lines = tuple(moves.lines[rows].tolist())
    return Traced(shape, lines, stretch, _terms(source, stretch, rows, tool), surface)


def _surface_rows(stretch: Stretch) -> NDArray[np.intp]:
    """Rows of the programmed moves that are the contour; an entry or exit along an arc counts, as not all have that."""
    moves, entry, behind = stretch.programmed, stretch.entry, len(stretch.programmed) - stretch.exit
    if entry == 1 and moves.turns[1]:
        entry = 0
    if stretch.exit == 1 and moves.turns[-1]:
        behind += 1
    rows: NDArray[np.intp] = np.arange(entry + 1, behind, dtype=np.intp)
    moving = (moves.turns[rows] != 0) | np.any(moves.points[rows, :2] != moves.points[rows - 1, :2], axis=1)
    found: NDArray[np.intp] = rows[moving]
    return found


def _element(moves: Moves, row: int) -> Element:
    (ax, ay), (bx, by) = moves.points[row - 1, :2].tolist(), moves.points[row, :2].tolist()
    turn, line = int(moves.turns[row]), int(moves.lines[row])
    if not turn:
        return line_element((ax, ay), (bx, by), 0.0, 0.0, rapid=False, feed=0.0, line=line)
    cx, cy = moves.centers[row, :2].tolist()
    return arc_element((ax, ay), (bx, by), (cx, cy), turn, 0.0, 0.0, 0.0, line)


def _terms(source: Run, stretch: Stretch, rows: NDArray[np.intp], tool: int) -> Terms:
    moves = stretch.programmed
    depth = float(moves.points[rows[0], 2])
    up = max(float(source.moves.points[:, 2].max()), depth + ABOVE)
    given = [float(feed) or FEED for feed in moves.feeds[rows].tolist()]
    feeds = dict(enumerate((given[0], *given, given[-1])))
    return Terms(
        tool=tool, diameter=2 * stretch.radius, stock=0.0, speed=1000.0, feeds=feeds, plunge_feed=FEED,
        travel=up, near=up, depth=depth, leave=up,
    )  # fmt: skip


def led(one: Traced, style: IsoStyle, *, blends: bool) -> Ready | Untold:
    """The stretch with the first leads that cut nothing, in a control's style; `blends`: with quarter arcs too."""
    for blend in BLENDS if blends else BLENDS[:1]:
        for reach in REACHES:
            if style.entry is Entry.OWN and reach <= 1.0:
                continue
            found = _ready(one, style, blend * one.stretch.radius, reach * one.stretch.radius)
            if found is not None:
                return found
    return Untold(f"beside line {one.lines[0]} there is no room for a straight move into the cut and out of it")


def _ready(one: Traced, style: IsoStyle, blend: float, reach: float) -> Ready | None:
    """With leads of these sizes, None where they cut the contour."""
    shape = merged(one.shape) if style.merged else one.shape
    first, last = shape.elements[0], shape.elements[-1]
    begin, finish = one.end(first.start, first.leaving, blend, 1), one.end(last.end, last.arriving, blend, -1)
    start, out = start_of(begin, style, reach), out_of(finish, reach)
    side, radius = one.stretch.side, one.stretch.radius
    for lead in (_way_in(one, begin, start), _way_out(one, finish, out)):
        verdict = judge(one.surface, side, radius, Path.from_pieces(list(lead)))
        if not verdict.judged or verdict.depth > GOUGE:
            return None
    if blend:
        shape = _blended(shape, begin, finish, radius)
    return Ready(one.terms, side, shape, start, begin.corner, out, one.terms.tool)


def _way_in(one: Traced, begin: End, start: Point) -> Iterator[Piece]:
    """The tool's way from where it starts onto its path."""
    yield Straight(start, begin.at)
    if begin.blend:
        center = beyond(begin.at, begin.way, begin.blend)
        yield Arc(begin.at, beyond(center, begin.off, -begin.blend), center, Turn(one.stretch.side.sign))


def _way_out(one: Traced, finish: End, out: Point) -> Iterator[Piece]:
    if finish.blend:
        center = beyond(finish.at, finish.way, -finish.blend)
        yield Arc(beyond(center, finish.off, -finish.blend), finish.at, center, Turn(one.stretch.side.sign))
    yield Straight(finish.at, out)


def _blended(shape: Programmed, begin: End, finish: End, radius: float) -> Programmed:
    """With quarter arcs about the blends' centers, a tool's radius larger: the control runs inside of them."""
    first, last = shape.elements[0], shape.elements[-1]
    size = begin.blend + radius
    turn = 1 if (begin.off[1] * begin.way[0] - begin.off[0] * begin.way[1]) > 0.0 else -1
    into = arc_element(begin.corner, first.start, beyond(begin.corner, begin.way, size), turn, 0.0, 0.0, 0.0, 0)
    off = arc_element(last.end, finish.corner, beyond(finish.corner, finish.way, -size), turn, 0.0, 0.0, 0.0, 0)
    return replace(
        shape,
        elements=(into, *shape.elements, off),
        segments=(0.0, *shape.segments, max(shape.segments) + 1.0),
    )
