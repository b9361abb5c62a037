"""Remedies for a contour that no look-ahead value cuts clean: each is cut and judged before it is offered.

The number of trials is bounded, so a remedy that exists may not be found; but every remedy offered does work.
Before each trial `progress` is called, which may raise Stopped; how far the search is, is not known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.advice.lookahead_table import CuttingSetup, Row, judge_lookaheads
from core.geometry.path import Path
from core.geometry.piece import Point
from core.progress import Progress, silent
from core.tolerance import CLOSED
from core.verify.judge import judge

MAX_STARTS: Final = 6
"""How many of the longest sides are tried as the start."""

MAX_STARTS_WITHOUT_BLENDS: Final = 2
"""The same without blend moves, when the start point matters little."""

LARGER_BY: Final = 1.02
"""A tool that fits only without blend moves must be this much larger to be offered beside one that fits with them."""

FEWEST_CLOSED: Final = 3
"""Segments with which a contour can come back to its start, except two arcs."""

USUAL_LOOKAHEADS: Final = (8, 3, 1, 20)
"""Look-aheads tried in the search for a tool; the one offered with the tool is then chosen from all."""


@dataclass(frozen=True, slots=True)
class ToolFits:
    """A cutter of `diameter` millimeters that is clean at look-ahead `value`; one that is a step larger is not clean.

    `lengths` (mm) are the contour's smallest inside radius, if the cutter leaves it uncut, and the largest
    diameter that cuts it.
    """

    diameter: float
    value: int
    lengths: tuple[float, ...] = ()

    @property
    def left_uncut(self) -> str:
        """The sentence on the radius that the cutter leaves uncut, with a leading blank; empty if there is none."""
        return " It leaves the inside radius {0} uncut; {1} or smaller cuts it." if self.lengths else ""


@dataclass(frozen=True, slots=True)
class StartMoved:
    """A new START: from `at`, the middle of `segment` or its new start, the contour is clean at look-ahead `value`.

    `effect`: what this look-ahead does, as in `Row.effect`.
    """

    segment: float
    at: Point
    value: int
    effect: tuple[str, tuple[float, ...]]


def _recommended(setup: CuttingSetup, progress: Progress) -> Row | None:
    """Return the row of the look-ahead that the table recommends."""
    progress(0.0)
    table = judge_lookaheads(setup)
    return None if table.recommended is None else table.row(table.recommended)


def without_blends(setup: CuttingSetup) -> CuttingSetup | None:
    """Return the setup with BLEND OFFSET 0; the overlap past the start stays.  None if there is no blend anyway."""
    return replace(setup, blend=0.0) if setup.blend > 0.0 else None


def lookahead_without_blends(setup: CuttingSetup, progress: Progress = silent) -> int | None:
    """Return the recommended look-ahead without blend moves; None if none is clean or there is no blend."""
    bare = without_blends(setup)
    row = None if bare is None else _recommended(bare, progress)
    return None if row is None else row.value


def larger_tool_without_blends(setup: CuttingSetup, than: ToolFits | None, progress: Progress) -> ToolFits | None:
    """Return the largest clean tool with BLEND OFFSET 0, or None.

    `than` is the tool that fits with blends: a tool less than `LARGER_BY` times as large is not offered.
    """
    bare = without_blends(setup)
    if bare is None:
        return None
    given = 0 if than is None else _steps(setup, than.diameter)
    least = 0 if than is None else max(int(given * LARGER_BY), given + 1)
    return largest_tool(bare, progress, least=least)


def largest_tool(setup: CuttingSetup, progress: Progress = silent, *, least: int = 0) -> ToolFits | None:
    """Find the largest clean diameter below the cutter's, in whole steps, by bisection.

    The smallest inside radius, often the limit, is tried first: if it is the limit, a larger tool that is clean only
    because it deletes such arcs is not searched for.  If a tool of `least` steps is not clean, the result is None.
    """
    clean, fails = least, _steps(setup, 2.0 * setup.radius)
    if clean >= fails or (clean and not _clean(setup, clean, progress)):
        return None
    limit = _smallest_inside_radius(setup)
    tries = [] if limit is None else [_steps(setup, 2.0 * limit), _steps(setup, 2.0 * limit) + 1]
    while fails - clean > 1:
        size = tries.pop(0) if tries else (clean + fails) // 2
        if not clean < size < fails:
            continue
        if _clean(setup, size, progress):
            clean = size
        else:
            fails = size
    row = _recommended(_with_tool(setup, clean), progress) if clean else None
    if row is None:
        return None
    fits = 0 if limit is None else _steps(setup, 2.0 * limit)
    left = (limit, fits * setup.diameter_step) if limit is not None and 0 < fits < clean else ()
    return ToolFits(clean * setup.diameter_step, row.value, left)


def _smallest_inside_radius(setup: CuttingSetup) -> float | None:
    surface = setup.surface
    radii: list[float] = surface.radii[surface.turns * setup.side.sign > 0].tolist()
    return min(radii, default=None)


def _clean(setup: CuttingSetup, size: int, progress: Progress) -> bool:
    """True if one of the usual look-aheads gives a clean finish path with a diameter of `size` steps."""
    progress(0.0)
    setup = _with_tool(setup, size)
    distinct = {
        id(control.path): control.whole for control in setup.paths(setup.radius, USUAL_LOOKAHEADS) if len(control.path)
    }
    return any(judge(setup.surface, setup.side, setup.radius, path).clean for path in distinct.values())


def _with_tool(setup: CuttingSetup, size: int) -> CuttingSetup:
    return replace(setup, radius=size * setup.diameter_step / 2.0)


def _steps(setup: CuttingSetup, diameter: float) -> int:
    """Return the whole steps in a diameter, tolerant of rounding."""
    return int(diameter / setup.diameter_step + 1e-6)


def start_mid_side(setup: CuttingSetup, progress: Progress = silent, max_starts: int = MAX_STARTS) -> StartMoved | None:
    """Find the longest side of a closed contour whose middle is a clean start, among the `max_starts` longest."""
    if not setup.closed:
        return None
    for side in longest_segments(setup.surface)[:max_starts]:
        row = _recommended(replace(setup, surface=restarted(setup.surface, side)), progress)
        if row is not None:
            middle = setup.surface[side].point_at(0.5)
            return StartMoved(float(setup.surface.numbers[side]), middle, row.value, row.effect)
    return None


def start_at_end(setup: CuttingSetup, progress: Progress) -> StartMoved | None:
    """Return the end of an open contour, if the contour is clean and closed when START is moved there.

    Only if START and the end share one coordinate, so that a single mistyped number explains the gap, and the first
    segment is a line, which the move may change."""
    surface = setup.surface
    gap = np.abs(surface.points[0] - surface.points[-1])
    if setup.closed or len(surface) < FEWEST_CLOSED or surface.turns[0] or float(gap.min()) > CLOSED:
        return None
    points = np.concatenate((surface.points[-1:], surface.points[1:]))
    closed = replace(setup, surface=Path.of(points, surface.centers, surface.turns, surface.numbers), closed=True)
    row = _recommended(closed, progress)
    x, y = points[0].tolist()
    return None if row is None else StartMoved(float(surface.numbers[0]), (x, y), row.value, row.effect)


def longest_segments(contour: Path) -> list[int]:
    """Return the rows of a contour's segments, the longest first."""
    rows: list[int] = np.argsort(-contour.lengths, kind="stable").tolist()
    return rows


def restarted(contour: Path, row: int) -> Path:
    """Return a closed contour of n segments, started in the middle of segment `row` (from 0): n + 1 new segments."""
    at = np.array([contour[row].point_at(0.5)])
    points = np.concatenate((at, contour.points[row + 1 :], contour.points[1 : row + 1], at))
    turns = np.concatenate((contour.turns[row:], contour.turns[: row + 1]))
    centers = np.concatenate((contour.centers[row:], contour.centers[: row + 1]))
    return Path.of(points, centers, turns)
