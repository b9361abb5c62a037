"""Judged walls: the cuts of a stretch's moves into one contour, measured exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.corner_loops import without_corner_loops
from core.controls.judging.judged_contour import JudgedContour
from core.controls.judging.moves_above import Z_COLUMN
from core.controls.judging.repeated_passes import without_repeats
from core.controls.judging.standing_walls import StandingWall
from core.controls.judging.stretch_paths import tool_path
from core.controls.registry import arc_tolerance
from core.geometry.path import Path
from core.tolerance import ARC_RADII, GOUGE, ON_PATH
from core.verify.judge import judge
from core.verify.surface import Leads
from core.verify.verdict import Gouge


def judge_wall(
    run: ControlRun,
    stretch: Stretch,
    wall: StandingWall,
    center: Path,
    accepted: float,
    closed: frozenset[float],
    *,
    alone: bool,
) -> JudgedContour:
    """Judge one contour with the whole center path; moves along other contours are never on its wrong side.

    Moves above the wall cannot gouge it.  A center path without its wear cannot gouge: there, moves between the
    `closed` contours may be on the wrong side.
    """
    contour = wall.path
    lines = frozenset(contour.numbers.tolist())
    surface, loops = without_corner_loops(without_repeats(contour), stretch.side)
    leads = Leads.MOVES if alone else Leads.SEGMENTS
    verdict = judge(surface, stretch.side, stretch.radius, center, accepted, leads=leads)
    wrong_side = verdict.wrong_side
    if stretch.wear and lines <= closed:
        wrong_side = tuple(row for row in wrong_side if center.numbers[row] not in closed - lines)
    elif (stretch.radius <= GOUGE and not stretch.wear) or not alone:
        # a center on the contour itself has no side, whatever its leads cross; a later offset may not be 0
        wrong_side = tuple(row for row in wrong_side if center.numbers[row] in lines)
    verdict = replace(verdict, wrong_side=wrong_side)
    if verdict.judged and wall.top < np.inf:
        verdict = replace(verdict, gouges=tuple(cuts_below(run, stretch, wall.top, surface, leads)))
    return JudgedContour(stretch, surface, center, verdict, lines, corner_loops=loops)


def cuts_below(run: ControlRun, stretch: Stretch, top: float, contour: Path, leads: Leads) -> list[Gouge]:
    """Return the cuts into a contour of a stretch's moves that begin or end below a height, the deepest first."""
    moves = run.moves.part(stretch.first, stretch.last)
    heights = moves.points[:, Z_COLUMN]
    low = np.minimum(heights, np.concatenate((heights[:1], heights[:-1]))) < top - ON_PATH
    paths = [tool_path(part, stretch) for part in moves.runs(low)]
    gouges = [gouge for path in paths for gouge in cuts_into(run, stretch, path, [contour], leads).gouges]
    return sorted(gouges, key=lambda gouge: -gouge.depth)


@dataclass(frozen=True, slots=True)
class CutsInto:
    """A path's cuts into contours, the contours that cannot be judged, and the tolerance that uneven arcs add (mm)."""

    gouges: list[Gouge]
    unjudged: list[JudgedContour]
    slack: float


def cuts_into(
    run: ControlRun, stretch: Stretch, center: Path, contours: Sequence[Path], leads: Leads = Leads.MOVES
) -> CutsInto:
    """Return what a path does to contours with the side and radius of a stretch."""
    gouges, unjudged, slack = list[Gouge](), list[JudgedContour](), 0.0
    for contour in contours:
        accepted = accepted_difference(run, contour, center)
        verdict = judge(contour, stretch.side, stretch.radius, center, accepted, leads=leads, measures_uncut=False)
        if verdict.judged:
            gouges += verdict.gouges
            slack = max(slack, verdict.radius_slack)
        else:
            unjudged.append(JudgedContour(stretch, contour, center, verdict, frozenset()))
    return CutsInto(gouges, unjudged, slack)


def accepted_difference(run: ControlRun, *paths: Path) -> float:
    """Return how far in millimeters the run's control lets the radii of the largest of these arcs differ."""
    radii = [float(path.radii[path.turns != 0].max(initial=0.0)) for path in paths]
    return max(ARC_RADII, arc_tolerance(run.control).largest_difference(max(radii), run.unit) + GOUGE)
