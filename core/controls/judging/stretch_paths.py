"""Stretch paths: the surface that a compensated stretch programs, its heights, and the path of the tool's center."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.contours_and_leads import RowRange, closed_passes, is_closed, split_where_it_closes
from core.controls.judging.moves_above import Z_COLUMN
from core.controls.judging.repeated_passes import without_repeats
from core.controls.judging.standing_walls import ClosedPass
from core.controls.moves import Moves, Plane
from core.geometry.path import Floats, Path, joined


def programmed_surface(stretch: Stretch) -> Path:
    """Return what is programmed between the lead-in and lead-out moves."""
    programmed = stretch.programmed
    return programmed.part(stretch.entry, len(programmed) - stretch.exit).path(stretch.plane)


def surface_heights(stretch: Stretch, surface: Path) -> Floats:
    """Return (n, 2) the heights of both ends of each piece of a stretch's surface; 0 in planes other than XY.

    Pieces of the surface may be split, but are otherwise those programmed.
    """
    if stretch.plane is not Plane.XY:
        return np.zeros((len(surface), 2))
    programmed = stretch.programmed.part(stretch.entry, len(stretch.programmed) - stretch.exit)
    rows = np.flatnonzero(programmed.moving_in(stretch.plane))
    if len(rows) < len(surface):
        surface_path = programmed_surface(stretch)
        split = split_where_it_closes(
            replace(surface_path, numbers=np.arange(len(surface_path), dtype=np.float64))
        ).path
        rows = rows[split.numbers.astype(np.intp)]
    heights = programmed.points[:, Z_COLUMN]
    return np.column_stack((heights[rows - 1], heights[rows]))


def closed_passes_of(stretch: Stretch, surface: Path, contours: Iterable[RowRange]) -> list[ClosedPass]:
    """Return the passes of the closed contours on the surface of a stretch of one side and radius."""
    heights = surface_heights(stretch, surface)
    return [
        ClosedPass.of(surface.part(first, last), heights[first:last], stretch.radius)
        for contour in contours
        if is_closed(surface, contour)
        for first, last in closed_passes(surface, contour)
    ]


def center_path(run: ControlRun, stretch: Stretch) -> Path:
    """Return the tool's center path without repeated passes.

    Of a center path with wear it is the programmed path, as with no wear, and the move that leaves it, if one does.
    """
    if stretch.wear:
        programmed = stretch.programmed.path(stretch.plane)
        move_off = run.moves.part(stretch.last - 2, stretch.last)
        leaves = not run.stops_within(stretch) and move_off.lines[-1] != stretch.programmed.lines[-1]
        return without_repeats(joined([programmed, move_off.path(stretch.plane)]) if leaves else programmed)
    return without_repeats(tool_path(run.moves.part(stretch.first, stretch.last), stretch))


def tool_path(moves: Moves, stretch: Stretch) -> Path:
    """Return the path of a tool in the plane of a stretch; if the tool stands still, a line of no length."""
    path = moves.path(stretch.plane)
    if len(path) or not len(moves):
        return path
    point = moves.points[-1:, list(stretch.plane.axes[:2])]
    return Path.of(np.repeat(point, 2, axis=0), point, np.zeros(1, np.int8), np.array([float(moves.lines[-1])]))
