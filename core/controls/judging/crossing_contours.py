"""Crossing contours are compensated contours of a program that cut into one another."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.controls.control_run import ControlRun
from core.controls.judging.rapids_at_depth import CutContour
from core.controls.judging.repeated_passes import PathKey, path_key
from core.controls.moves import Plane
from core.progress import Progress, silent
from core.verify.other_contours import MIN_CUT_DEPTH, ContourCut, Sweep, Wall, cuts_into_other_contours


def cuts_of_other_contours(
    run: ControlRun, contours: Sequence[CutContour], progress: Progress = silent
) -> tuple[ContourCut, ...]:
    """Return the cuts of compensated XY moves into other stretches' contours that are cut no deeper than they run.

    Only the deepest cut of each contour is listed, in the order of the moves' lines.  A gouge's `path_number` is that
    line, `surface_number` the contour's.
    """
    if len(run.stretches) < 2:
        return ()
    cuts = cuts_into_other_contours(_walls(contours), _sweeps(run, contours), progress)
    return tuple(sorted(cuts, key=lambda cut: cut.gouge.path_number))


def _walls(contours: Sequence[CutContour]) -> list[Wall]:
    """Return the contours in XY; of those with the same shape, the one that is cut highest."""
    walls = dict[tuple[PathKey, int], Wall]()
    for contour in contours:
        if contour.stretch.plane is Plane.XY:
            shape, setup = path_key(contour.path), contour.setup
            if (shape, setup) not in walls or contour.top > walls[shape, setup].top:
                walls[shape, setup] = Wall(
                    contour.path, contour.stretch.side, contour.top, shape, contour.accepted, setup
                )
    return list(walls.values())


def _sweeps(run: ControlRun, contours: Sequence[CutContour]) -> list[Sweep]:
    """Return the compensated moves of a run in XY, by stretch and radius; of equal ones the lowest."""
    sweeps = dict[tuple[PathKey, float, int], Sweep]()
    for stretch in run.stretches:
        shapes = frozenset(path_key(cut.path) for cut in contours if stretch.has_part(cut.stretch))
        setup = run.setup_at(stretch.first + 1)
        for part in stretch.parts() if stretch.plane is Plane.XY else ():
            moves = run.moves.part(part.first, part.last)
            path, heights = moves.path(), moves.heights()
            key = (path_key(path), part.radius, setup)
            lowest = sweeps[key].heights.min() if key in sweeps else np.inf
            if part.radius > MIN_CUT_DEPTH and len(path) and heights.min() < lowest:
                sweeps[key] = Sweep(path, heights, part.radius, shapes, setup)
    return list(sweeps.values())
