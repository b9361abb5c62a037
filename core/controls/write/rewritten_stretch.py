"""A rewritten stretch is a compensated stretch of a run as a pass for another control, with leads that cut nothing.

Elements have numbers of their own, because a line that runs again may have another feed; arcs that lead in and out
have the negative numbers of the elements next to them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.compensation.elements import offset_point, point_along
from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.contours_and_leads import contour_of
from core.controls.moves import Plane
from core.controls.write.contour_pass import ContourPass, PassWithLeads, PathEnd, ProgrammedElements, element_of
from core.controls.write.iso_style import IsoStyle
from core.controls.write.lead_moves import ProtectedContour, clear_leads, merged, with_blends
from core.geometry.piece import Arc, Piece, Point, Side, Turn
from core.tolerance import JOINED

BLEND_RADII: Final = (0.0, 1.0, 0.5, 0.25, 0.1)
"""Radii, in tool radii, of the quarter arcs between a straight lead and the contour; no arc is tried first."""

MIN_LIFT: Final = 10.0
"""Least height in millimeters from a contour's depth up to where the tool travels."""

DEFAULT_FEED: Final = 100.0
"""Millimeters per minute where the program gives no feed."""


@dataclass(frozen=True, slots=True)
class NotTranslated:
    """Why a run's contours cannot be written for another control, as the end of a sentence."""

    text: str


def rewritten_stretch(
    source: ControlRun, stretch: Stretch, tool: int, before: int, style: IsoStyle, *, blends: bool
) -> PassWithLeads | NotTranslated:
    """Return a stretch of a run with a tool's number in a control's style, or why it cannot be written for it.

    The number of an element is the row of its move, plus `before`.  The stretch has the first leads that cut nothing;
    `blends` allows quarter arcs.
    """
    moves = stretch.programmed
    line = int(moves.lines[min(1, len(moves) - 1)])
    if stretch.plane is not Plane.XY:
        return NotTranslated(f"line {line} is compensated in another plane than XY")
    if stretch.radius <= JOINED:
        return NotTranslated(f"the tool at line {line} has no radius")
    rows = _surface_rows(stretch)
    if not len(rows):
        return NotTranslated(f"there is no contour after line {line}")
    heights = np.stack((moves.points[rows, 2], moves.points[rows - 1, 2]), axis=1)
    uneven = np.flatnonzero((np.abs(heights - heights[0, 0]) > JOINED).any(axis=1))
    if len(uneven):
        return NotTranslated(f"the tool axis moves under compensation at line {int(moves.lines[rows[uneven[0]]])}")
    whole = moves.part(int(rows[0]) - 1, int(rows[-1]) + 1).path()
    numbers = (before + rows).tolist()
    shape = ProgrammedElements(tuple(map(element_of, whole)), tuple(map(float, numbers)))
    surface = ProtectedContour(whole.part(*contour_of(whole)), stretch.side, stretch.radius)
    shape = merged(shape) if style.merged else shape
    feeds = dict(zip(numbers, (feed or DEFAULT_FEED for feed in moves.feeds[rows].tolist()), strict=True))
    feeds |= {-number: feed for number, feed in feeds.items()}
    contour_pass = _contour_pass(source, stretch, float(moves.points[rows[0], 2]), feeds, tool)
    led = _with_leads(shape, contour_pass, surface, style, blends=blends)
    if led is None:
        line = int(moves.lines[rows[0]])
        return NotTranslated(f"at line {line} there is no room for a straight move into the cut and out of it")
    return led


def _surface_rows(stretch: Stretch) -> NDArray[np.intp]:
    """Return the contour's rows in the programmed moves; an entry or exit arc counts, as not all controls allow it."""
    moves, entry, end = stretch.programmed, stretch.entry, len(stretch.programmed) - stretch.exit
    if entry == 1 and moves.turns[1]:
        entry = 0
    if stretch.exit == 1 and moves.turns[-1]:
        end += 1
    rows: NDArray[np.intp] = np.arange(entry + 1, end)
    return rows.compress(moves.moving_in(Plane.XY)[rows])


def _contour_pass(
    source: ControlRun, stretch: Stretch, depth: float, feeds: dict[int, float], tool: int
) -> ContourPass:  # fmt: skip
    up = max(float(source.moves.points[:, 2].max()), depth + MIN_LIFT)
    return ContourPass(
        tool=tool, diameter=2 * stretch.radius, stock=0.0, speed=1000.0, feeds=feeds, plunge_feed=DEFAULT_FEED,
        travel=up, near=up, depth=depth, leave=up,
    )  # fmt: skip


def _with_leads(
    shape: ProgrammedElements, contour_pass: ContourPass, surface: ProtectedContour, style: IsoStyle, *, blends: bool
) -> PassWithLeads | None:
    """Return the elements with the first leads that cut nothing, None if there are none."""
    side, radius, first, last = surface.side, surface.radius, shape.elements[0], shape.elements[-1]
    for blend in BLEND_RADII if blends else BLEND_RADII[:1]:
        begin = _path_end(surface, first.start, first.start_direction, blend * radius, 1)
        finish = _path_end(surface, last.end, last.end_direction, blend * radius, -1)
        into, off = _blend(begin, side, 1), _blend(finish, side, -1)
        leads = clear_leads(begin, finish, style, radius, surface, into, off)
        if not isinstance(leads, float):
            shape = with_blends(shape, begin, finish, radius, (-shape.segments[0], -shape.segments[-1]))
            return PassWithLeads(contour_pass, side, shape, leads[0], begin.corner, leads[1])
    return None


def _path_end(surface: ProtectedContour, corner: Point, direction: Point, blend: float, sense: int) -> PathEnd:
    """Return the path's start (`sense` 1) or end (-1), with a quarter arc of radius `blend`, or none for 0."""
    outward = offset_point((0.0, 0.0), direction, surface.side.sign)
    at = point_along(point_along(corner, outward, surface.radius + blend), direction, -sense * blend)
    corner = point_along(at, direction, -sense * surface.radius) if blend else corner
    return PathEnd(at, corner, direction, outward, blend)


def _blend(end: PathEnd, side: Side, sense: int) -> tuple[Piece, ...]:
    """Return the quarter arc between a straight lead and the tool's path, at its start (`sense` 1) or end (-1)."""
    if not end.blend:
        return ()
    center = point_along(end.at, end.direction, sense * end.blend)
    first, last = (end.at, point_along(center, end.outward, -end.blend))[::sense]
    return (Arc(first, last, center, Turn(side.sign)),)
