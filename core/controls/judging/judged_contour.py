"""Judged contours: the verdicts on the contours of a compensated stretch, and what else its findings need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.controls.control_run import Stretch
from core.controls.judging.corner_loops import CornerLoop
from core.controls.judging.rapids_at_depth import UncompensatedCut
from core.controls.judging.standing_walls import StandingWall
from core.geometry.path import Path
from core.tolerance import ARC_RADII, ON_PATH
from core.verify.other_contours import ContourCut
from core.verify.verdict import Gouge, Verdict


@dataclass(frozen=True, slots=True)
class ToleratedArc:
    """The arc whose radii at its start and its end differ most, and its line.

    `slack`: how much the uneven arcs of surface and path raise the tolerance.
    """

    first: float
    last: float
    line: int | None
    slack: float


@dataclass(frozen=True, slots=True)
class PassedOver:
    """Moves above the part that pass over it: their lowest height and their lines."""

    height: float
    lines: tuple[int, ...]


@dataclass(frozen=True, eq=False, slots=True)
class JudgedContour:
    """A contour of a compensated stretch, the path of the tool's center with its leads, and the verdict on them."""

    stretch: Stretch
    """The stretch, or the part of it with one side and radius."""
    surface: Path
    """The contour without repeated passes and without loops around corners."""
    center: Path
    """The path of the center without repeated passes; surface and path may keep different ones of two equal passes."""
    verdict: Verdict
    """Its gouges have a digit in the program's unit; `shallow_gouges` counts the others."""
    lines: frozenset[float]
    """The lines of the whole contour, repeated passes included."""
    lead_lines: tuple[int, ...] = ()
    """The lines of programmed moves that are taken for leads, because a contour begins after or ends before them."""
    long_leads: bool = False
    """They are so long that they may be walls."""
    doubtful_leads: bool = False
    """They may be walls: lines out and back at a corner, or arcs of an open contour."""
    lead_gouges: tuple[Gouge, ...] = ()
    """The cuts into them, since they may be walls."""
    lead_slack: float = 0.0
    """Extra tolerance in millimeters of `lead_gouges`."""
    side_changes: bool = False
    """The side changes before this part of a stretch; cuts into contours on the other side are not judged."""
    cut_short: bool = False
    """The control stops within the stretch, so that what stays uncut says nothing."""
    open_lines: frozenset[float] = frozenset()
    """All lines of an open contour among closed ones, if this is its first part."""
    uneven_arc: ToleratedArc | None = None
    shallow_gouges: int = 0
    """How many gouges are too shallow for a digit of the program's unit."""
    passed_over: PassedOver | None = None
    """Moves above the contour, which are not judged."""
    uncompensated_cuts: tuple[UncompensatedCut, ...] = ()
    """On the first contour of a run, the cuts of moves without compensation into all contours."""
    cuts_into_others: tuple[ContourCut, ...] = ()
    """On the first contour of a run, the cuts of all compensated moves into contours of other stretches."""
    corner_loops: tuple[CornerLoop, ...] = ()
    """Loops around outside corners, which are no wall."""
    cut_away: tuple[StandingWall, ...] = ()
    """Walls that other passes of the stretch cut away."""


def with_gouges(
    result: JudgedContour, other_gouges: Sequence[Gouge], slack: float, paths: Sequence[Path]
) -> JudgedContour:
    """Return the result with more gouges, and the most uneven arc of these paths if it raises the tolerance."""
    if not result.verdict.judged:
        return result
    gouges = sorted((*result.verdict.gouges, *other_gouges), key=lambda gouge: -gouge.depth)
    if slack > (result.uneven_arc.slack if result.uneven_arc else 0.0):
        result = replace(result, uneven_arc=most_uneven_arc(slack, *paths))
    return replace(result, verdict=replace(result.verdict, gouges=tuple(gouges)))


def with_unjudged(results: list[JudgedContour], unjudged: Sequence[JudgedContour]) -> list[JudgedContour]:
    """Return the results, and of the unjudged ones one for each reason that no result gives."""
    reasons = {result.verdict.uneven_arc for result in results if not result.verdict.judged}
    by_reason = {result.verdict.uneven_arc: result for result in unjudged if result.verdict.uneven_arc not in reasons}
    return [*results, *by_reason.values()]


def most_uneven_arc(slack: float, *paths: Path) -> ToleratedArc | None:
    """Return the arc of these paths whose radii differ most; None if neither it nor `slack` exceeds ARC_RADII."""
    worst, largest = None, ARC_RADII if slack <= ARC_RADII else ON_PATH
    for path in paths:
        arms = path.ends - path.centers
        first, last = path.radii, np.hypot(arms[:, 0], arms[:, 1])
        differences = np.where(path.turns != 0, np.abs(last - first), 0.0)
        row = int(differences.argmax()) if len(differences) else 0
        if len(differences) and differences[row] > largest:
            line, largest = line_of(path.numbers[row]), differences[row]
            worst = ToleratedArc(float(first[row]), float(last[row]), line, slack)
    return worst


def line_of(number: float) -> int | None:
    """Return the program line in a path piece's number; None for 0, a move that belongs to no line."""
    return int(number) or None


def first_line(path: Path) -> int | None:
    """Return the program line of a path's first piece; None for an empty path or an unknown line."""
    return line_of(path.numbers[0]) if len(path) else None
