"""Rapids at depth are uncompensated rapids that run through a contour no higher than it is cut.

A program that forgets to raise the tool after G40 drives it through the wall it has just cut.  Feed moves are checked
only if they follow a contour at the same height: without compensation others may cut anything.  Rapids within a
compensated stretch at its depth are reported too.

A rapid below zero, where the top of a part usually is, may also cut the upper part of a wall, unless feed moves before
it have cut all that away.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from typing import Final

import numpy as np
from shapely import LineString, Point, unary_union
from shapely.geometry.base import BaseGeometry

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.moves_above import surface_rows
from core.controls.moves import Move, Moves, Plane
from core.geometry.nearby import BoxTree, near_pairs
from core.geometry.path import Flags, Path, chords_of, runs_of
from core.progress import Progress, part, silent
from core.tolerance import ON_PATH
from core.verify.judge import judge
from core.verify.verdict import Gouge

CLEARED: Final = 0.05
"""Millimeters that the areas of cuts may be off, since shapely's circles are polygons."""

LEAST_RADIUS: Final = 0.2
"""Millimeters; hardly a tool has a smaller radius."""


@dataclass(frozen=True, eq=False, slots=True)
class CutContour:
    """A contour of a stretch, the height of its highest cut, how far its arcs' radii may differ, and its setup."""

    path: Path
    stretch: Stretch
    top: float
    accepted: float
    setup: int = 0


class PathTree:
    """A search tree of the boxes of paths, of which there is at least one; `owners`: the index of each box's path."""

    def __init__(self, paths: Sequence[Path]) -> None:
        self.boxes = BoxTree.of(np.concatenate([path.boxes for path in paths], axis=1))
        self.owners = np.repeat(np.arange(len(paths)), [len(path) for path in paths])

    def near(self, path: Path, reach: float) -> list[int]:
        """Return the indices of the paths of which a box is no farther from a box of `path` than `reach`."""
        rows = [np.unique(self.owners[boxes]) for _, boxes in near_pairs(path.boxes, self.boxes, reach)]
        indices: list[int] = np.unique(np.concatenate(rows)).tolist() if rows else []
        return indices


class _CutContours:
    """Contours that can be searched for those near a path."""

    def __init__(self, contours: Sequence[CutContour]) -> None:
        self.contours, self.tree = contours, PathTree([contour.path for contour in contours])

    def near(self, path: Path, reach: float, setups: Set[int]) -> list[CutContour]:
        """Return the contours of these setups that the tool may reach along a path."""
        near = (self.contours[row] for row in self.tree.near(path, reach))
        return [contour for contour in near if contour.setup in setups]


def highest_cut(stretch: Stretch) -> float:
    """Return the highest place at which a stretch in XY cuts its contour; -inf if nothing cuts.

    A helix or a ramp may begin in the air: it counts from zero, where the top of a part usually is, or from its low end
    if that is higher.  If all moves are rapid, those below zero cut: a G1 was forgotten.
    """
    programmed, surface = stretch.programmed, surface_rows(stretch)
    below = np.maximum(programmed.points[:, 2], np.roll(programmed.points[:, 2], 1)) < -ON_PATH
    feeds = surface & ~programmed.rapid
    rows = np.flatnonzero(feeds if feeds.any() else surface & below)
    ends = programmed.points[[rows, rows - 1], 2]
    high, low = ends.max(axis=0), ends.min(axis=0)
    return float(np.where(high == low, high, np.minimum(high, np.maximum(low, 0.0))).max(initial=-np.inf))


def cuts_nothing(stretch: Stretch) -> bool:
    """True if a stretch in XY has a contour, and all of it is rapids that are not below zero."""
    surface = surface_rows(stretch)
    return stretch.plane is Plane.XY and bool(surface.any()) and highest_cut(stretch) == -inf


def rapid_walls(stretch: Stretch) -> tuple[Move, ...]:
    """Return a stretch's rapids in XY that count as its contour and are no higher than its highest cut."""
    if stretch.plane is not Plane.XY:
        return ()
    programmed = stretch.programmed
    low = programmed.low(highest_cut(stretch))
    return tuple(programmed[row] for row in np.flatnonzero(surface_rows(stretch) & programmed.rapid & low).tolist())


@dataclass(frozen=True, slots=True)
class UncompensatedCut:
    """The cut of a move without compensation into a contour, its height in millimeters, and if it is a rapid.

    `above`: the rapid is below zero and above the cut of the contour, so that the wall may end below it.
    """

    gouge: Gouge
    height: float
    rapid: bool
    above: bool = False


def moves_through(
    run: ControlRun, contours: Sequence[CutContour], progress: Progress = silent
) -> tuple[UncompensatedCut, ...]:
    """Return the cuts of moves outside the compensated stretches into contours in XY, the deepest of each line.

    The moves are rapids, and feed moves at the height of a stretch that lead to it or follow it and cut its own
    contours.
    """
    contours = [contour for contour in contours if contour.stretch.plane is Plane.XY and len(contour.path)]
    if not contours:
        return ()
    cuts, tools, all_contours = list[UncompensatedCut](), _Tools(run), _CutContours(contours)
    at_depth, over_walls, beside = (part(progress, third / 3.0, (third + 1) / 3.0) for third in range(3))
    changes = {change.row for change in run.setups} | {change.row for change in run.spindle}
    for rows in runs_of(_low_rapids(run, max(contour.top for contour in contours))):
        at_depth(int(rows[0]) / len(run.moves))
        starts = [int(rows[0]), *(row for row in rows[1:].tolist() if not changes.isdisjoint((row, row - 1)))]
        for first, end in pairwise((*starts, int(rows[-1]) + 1)):
            moves = run.moves.part(first - 1, end)
            cuts += _cuts(moves, tools.cutting_radius(first), all_contours, _setups(run, first), rapid=True)
    for row in np.flatnonzero(_low_rapids(run, inf)).tolist():
        over_walls(row / len(run.moves))
        below_zero = _below_zero(run.moves.part(row - 1, row + 1))
        if below_zero is not None:
            cuts += _cuts_above(tools, row, below_zero, tools.cutting_radius(row), all_contours)
    for stretch, first, last in _adjoining_feeds(run):
        beside(first / len(run.moves))
        own_contours = [contour for contour in contours if stretch.has_part(contour.stretch)]
        if own_contours:
            moves, setups = run.moves.part(first, last), {own_contours[0].setup}
            cuts += _cuts(moves, stretch.radius, _CutContours(own_contours), setups, rapid=False)
    # a cut at depth takes precedence, and a wall that is already cut over one that is yet to be cut
    ranked = sorted(
        cuts, key=lambda cut: (not cut.above, cut.gouge.surface_number < cut.gouge.path_number, cut.gouge.depth)
    )
    deepest = {int(cut.gouge.path_number): cut for cut in ranked}
    return tuple(deepest[line] for line in sorted(deepest))


class _Tools:
    """The tools that make the moves outside the compensated stretches of a run."""

    def __init__(self, run: ControlRun) -> None:
        self.run = run
        self.ends = [stretch.last for stretch in run.stretches]
        self.numbers = [run.spindle_at(stretch.first + 1).tool for stretch in run.stretches]
        self.largest = max(stretch.radius for stretch in run.stretches)

    def radius(self, row: int) -> tuple[float, bool]:
        """Return the radius of a row's tool, and if it is known.

        It is that of the stretch before with this tool, or else of one after; if no stretch has the tool, that of the
        stretch before.
        """
        tool, index = self.run.spindle_at(row).tool, bisect_right(self.ends, row)
        nearest_first = (*range(index - 1, -1, -1), *range(index, len(self.ends)))
        found = next((each for each in nearest_first if tool in (None, self.numbers[each])), None)
        return self.run.stretches[nearest_first[0] if found is None else found].radius, found is not None

    def cutting_radius(self, row: int) -> float:
        """Return the radius within which a row's tool is known to cut: of a drill, no size is known."""
        radius, known = self.radius(row)
        return radius if known else min(radius, LEAST_RADIUS)


def _adjoining_feeds(run: ControlRun) -> Iterator[tuple[Stretch, int, int]]:
    """Yield stretches with the rows of feed moves that lead to them or follow them, at the height of the stretch's end.

    The first row is where the moves start; the second is one past the last.
    """
    heights, rapid = run.moves.points[:, 2], run.moves.rapid
    ends = [1, *(stretch.last for stretch in run.stretches), len(run.moves)]
    for index, stretch in enumerate(run.stretches):
        first, last = stretch.first, stretch.last - 1

        def cuts(row: int, stretch_row: int) -> bool:
            """True if the move to a row is a feed move at the height of `stretch_row`."""
            level = max(abs(heights[end] - heights[stretch_row]) for end in (row - 1, row)) <= ON_PATH
            return bool(row not in run.unplaced and not rapid[row] and level)

        while first >= ends[index] and cuts(first, stretch.first):
            first -= 1
        begin = run.stretches[index + 1].first if index + 1 < len(run.stretches) else len(run.moves) - 1
        while last < begin and cuts(last + 1, stretch.last - 1):
            last += 1
        if first < stretch.first:
            yield stretch, first, stretch.first + 1
        if last >= stretch.last:
            yield stretch, stretch.last - 1, last + 1


def _low_rapids(run: ControlRun, top: float) -> Flags:
    """Return (n,) flags of the rapids in the plane outside the stretches that are no higher than `top`.

    The tool's height is not known before the program moves it up or down, nor at a machine position.
    """
    moves, heights = run.moves, run.moves.points[:, 2]
    placed = np.logical_or.accumulate(heights != heights[0])
    low = moves.low(top) & moves.rapid & moves.moving_in(Plane.XY)
    low[1:] &= placed[:-1]
    low[list(run.unplaced)] = False
    for stretch in run.stretches:
        low[stretch.first + 1 : stretch.last] = False
    return low


def _setups(run: ControlRun, row: int) -> set[int]:
    """Return the setups of a row: the first move of one starts among the contours of the setup before."""
    return {run.setup_at(row - 1), run.setup_at(row)}


def _cuts(
    moves: Moves, radius: float, contours: _CutContours, setups: Set[int], *, rapid: bool
) -> list[UncompensatedCut]:
    path, height = moves.path(), float(moves.points[:, 2].max())
    cuts = list[UncompensatedCut]()
    for contour in contours.near(path, radius, setups):
        if height > contour.top + ON_PATH:
            continue
        verdict = judge(contour.path, contour.stretch.side, radius, path, contour.accepted, measures_uncut=False)
        cuts += [UncompensatedCut(gouge, height, rapid) for gouge in verdict.gouges]
    return cuts


def _below_zero(move: Moves) -> Moves | None:
    """Return the part below zero of a straight move, given with its start point; None if it has none."""
    first, last = move.points
    low, high = sorted((float(first[2]), float(last[2])))
    if low >= -ON_PATH:
        return None
    if high <= 0.0:
        return move
    crossing = first + (last - first) * (first[2] / (first[2] - last[2]))
    points = np.array([crossing, last] if last[2] < 0.0 else [first, crossing])
    return replace(move, points=points, centers=points)


def _cuts_above(tools: _Tools, row: int, move: Moves, radius: float, contours: _CutContours) -> list[UncompensatedCut]:
    """Return the cuts of a rapid into contours that are cut lower, unless feed moves before have cut all that away."""
    path, low, high = move.path(), float(move.points[:, 2].min()), float(move.points[:, 2].max())
    cuts = list[UncompensatedCut]()
    for contour in contours.near(path, radius, _setups(tools.run, row)):
        if high <= contour.top + ON_PATH:
            continue
        verdict = judge(contour.path, contour.stretch.side, radius, path, contour.accepted, measures_uncut=False)
        cuts += [
            UncompensatedCut(gouge, low, rapid=True, above=True)
            for gouge in verdict.gouges
            if not _is_cut_away(tools, row, low, gouge.at, radius, contour.setup)
        ]
    return cuts


def _is_cut_away(
    tools: _Tools, row: int, height: float, center: tuple[float, float], radius: float, setup: int
) -> bool:
    """True if feed moves of a setup before a row have cut the tool's circle about a center free, at a height or below.

    A tool of unknown size has cut no more than the tool of the row would.
    """
    run, moves = tools.run, tools.run.moves.part(0, row)
    feeds = moves.low(height) & ~moves.rapid & moves.moving_in(Plane.XY)
    ends, arms = moves.points[:, :2], (moves.points - moves.centers)[:, :2]
    starts = np.vstack((ends[:1], ends[:-1]))
    # a line has its end as center: its arm has no length
    reach = radius + tools.largest + np.hypot(arms[:, :1], arms[:, 1:])
    far = (np.maximum(starts, ends) + reach < center) | (np.minimum(starts, ends) - reach > center)
    cleared = list[BaseGeometry]()
    for each in np.flatnonzero(feeds & ~far.any(axis=1)).tolist():
        if run.setup_at(each) == setup:
            points = chords_of(moves.part(each - 1, each + 1).path(), CLEARED / 2.0)
            size, known = tools.radius(each)
            cleared.append(LineString(points).buffer(size if known else radius))
    return bool(unary_union(cleared).covers(Point(center).buffer(radius - CLEARED)))
