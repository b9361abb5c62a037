"""Rapids at depth: uncompensated rapids that run through a contour no higher than it is cut.

A program that forgets to raise the tool after G40 drives it through the wall it has just cut.  Of feed moves only those
are looked at that follow a contour at the same height: without compensation others may cut anything.  Rapids of a
compensated stretch at its depth are told too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.moves import Move, Moves, Plane
from core.controls.moves_above import surface_rows
from core.geometry.nearby import near_pairs
from core.geometry.path import Path, Rows
from core.tolerance import ON_PATH
from core.verify.judge import judge
from core.verify.verdict import Gouge


@dataclass(frozen=True, eq=False, slots=True)
class CutContour:
    """A contour of a stretch, the highest place where it is cut, and by how much radii of its arcs may differ."""

    path: Path
    stretch: Stretch
    top: float
    accepted: float


def highest_cut(stretch: Stretch) -> float:
    """The highest place at which a stretch in XY cuts its contour; -inf where nothing cuts.

    A helix or a ramp may begin in the air: it counts from zero, where the top of a part usually is, or its low end.
    Where all of it is rapid, what runs below zero cuts: a G1 was forgotten.
    """
    programmed, surface = stretch.programmed, surface_rows(stretch)
    below = np.maximum(programmed.points[:, 2], np.roll(programmed.points[:, 2], 1)) < -ON_PATH
    feeds = surface & ~programmed.rapid
    rows = np.flatnonzero(feeds if feeds.any() else surface & below)
    ends = programmed.points[[rows, rows - 1], 2]
    high, low = ends.max(axis=0), ends.min(axis=0)
    return float(np.where(high == low, high, np.minimum(high, np.maximum(low, 0.0))).max(initial=-np.inf))


def rapid_walls(stretch: Stretch) -> tuple[Move, ...]:
    """The rapids of a stretch in XY that count as its contour and are no higher than that is cut."""
    if stretch.plane is not Plane.XY:
        return ()
    programmed, top = stretch.programmed, highest_cut(stretch)
    low = programmed.points[:, 2] <= top + ON_PATH
    low[1:] &= low[:-1]
    rows = np.flatnonzero(surface_rows(stretch) & programmed.rapid & low)
    return tuple(programmed[row] for row in rows.tolist())


@dataclass(frozen=True, slots=True)
class UncompensatedCut:
    """What a move without compensation cuts of a contour, its height in millimeters, and whether it is a rapid."""

    gouge: Gouge
    height: float
    rapid: bool


def moves_through(run: ControlRun, contours: Sequence[CutContour]) -> tuple[UncompensatedCut, ...]:
    """The moves outside the compensated stretches that cut contours in XY, each line with its deepest cut.

    They are rapids, and feed moves that go on behind a stretch at its height and cut its own contours.  The tool is the
    one of the stretch before, at the beginning that of the first stretch.
    """
    contours = [contour for contour in contours if contour.stretch.plane is Plane.XY and len(contour.path)]
    if not contours:
        return ()
    low = _low_rapids(run, max(contour.top for contour in contours))
    ends = np.array([stretch.last for stretch in run.stretches])
    found = list[UncompensatedCut]()
    for rows in np.split(low, np.flatnonzero(np.diff(low) > 1) + 1) if len(low) else ():
        moves = run.moves.part(int(rows[0]) - 1, int(rows[-1]) + 1)
        before = max(int(np.searchsorted(ends, rows[0], side="right")) - 1, 0)
        found += _cuts(moves, run.stretches[before].radius, contours, rapid=True)
    for stretch, last in _feeds_behind(run):
        own = [contour for contour in contours if stretch.first <= contour.stretch.first < stretch.last]
        found += _cuts(run.moves.part(stretch.last - 1, last), stretch.radius, own, rapid=False)
    # a wall that is cut already is named before one that is still to be cut
    ranked = sorted(found, key=lambda cut: (cut.gouge.surface_number < cut.gouge.path_number, cut.gouge.depth))
    deepest = {int(cut.gouge.path_number): cut for cut in ranked}
    return tuple(deepest[line] for line in sorted(deepest))


def _feeds_behind(run: ControlRun) -> Iterator[tuple[Stretch, int]]:
    """Stretches behind which feed moves go on at the height at which they end, and one after the last of these rows."""
    moves = run.moves
    heights = moves.points[:, 2]
    begins = [stretch.first + 1 for stretch in run.stretches[1:]]
    for stretch, begin in zip(run.stretches, [*begins, len(moves)], strict=True):
        last = stretch.last
        while (
            last < begin
            and last not in run.unplaced
            and not moves.rapid[last]
            and abs(heights[last] - heights[stretch.last - 1]) <= ON_PATH
        ):
            last += 1
        if last > stretch.last:
            yield stretch, last


def _low_rapids(run: ControlRun, top: float) -> Rows:
    """The rows of rapids in the plane outside the stretches that are no higher than this.

    How high the tool is before the program moves it up or down is not known, nor at a point of the machine.
    """
    moves, heights = run.moves, run.moves.points[:, 2]
    low = (heights <= top + ON_PATH) & np.logical_or.accumulate(heights != heights[0])
    low[1:] &= low[:-1]
    low &= moves.rapid & moves.moving_in(Plane.XY)
    low[list(run.unplaced)] = False
    for stretch in run.stretches:
        low[stretch.first + 1 : stretch.last] = False
    rows: Rows = np.flatnonzero(low)
    return rows


def _cuts(moves: Moves, radius: float, contours: Sequence[CutContour], *, rapid: bool) -> list[UncompensatedCut]:
    path, height = moves.path(), float(moves.points[:, 2].max())
    cuts = list[UncompensatedCut]()
    for contour in contours:
        if height > contour.top + ON_PATH or not any(True for _ in near_pairs(path.boxes, contour.path.boxes, radius)):
            continue
        verdict = judge(contour.path, contour.stretch.side, radius, path, contour.accepted)
        cuts += [UncompensatedCut(gouge, height, rapid) for gouge in verdict.gouges]
    return cuts
