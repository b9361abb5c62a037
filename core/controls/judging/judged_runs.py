"""Judged runs show what a control's path does to the contours that the program describes, by program line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.contours_and_leads import split_where_it_closes
from core.controls.judging.crossing_contours import cuts_of_other_contours
from core.controls.judging.judged_contour import (
    JudgedContour,
    PassedOver,
    first_line,
    line_of,
    with_gouges,
    with_unjudged,
)
from core.controls.judging.judged_stretches import judge_stretch
from core.controls.judging.judged_walls import accepted_difference, cuts_below, cuts_into
from core.controls.judging.moves_above import Divided, divided, heights_above
from core.controls.judging.rapids_at_depth import CutContour, PathTree, highest_cut, moves_through
from core.controls.judging.repeated_passes import path_key, without_repeats
from core.controls.judging.standing_walls import standing_walls
from core.controls.judging.stretch_paths import closed_passes_of, programmed_surface
from core.geometry.path import Path
from core.progress import Progress, silent
from core.progress import part as part_of
from core.units import Kind, decimals_shown, to_mm
from core.verify.surface import Leads

JUDGING_SHARE: Final = 0.8
"""Progress when every stretch is judged; the moves between them and their contours with one another take the rest."""

MOVES_SHARE: Final = 0.9
"""Progress when the moves between the stretches are judged too."""


def judge_run(run: ControlRun, progress: Progress = silent) -> tuple[JudgedContour, ...]:
    """Return the verdict on every compensated stretch of a run, in its own plane; paths are numbered by lines.

    A run given up as endless has no verdicts: its own finding says so, and the same moves a thousand times over would
    be judged against one another.
    """
    if run.endless:
        return ()
    # a shallower gouge than half the last digit that a control shows is none
    least = to_mm(0.5 * 10.0 ** -decimals_shown(Kind.LENGTH, run.unit), run.unit)
    results, heights = list[JudgedContour](), heights_above(run)
    judging, comparing = part_of(progress, 0.0, JUDGING_SHARE), part_of(progress, MOVES_SHARE, 1.0)
    between = part_of(progress, JUDGING_SHARE, MOVES_SHARE)
    for index, stretch in enumerate(run.stretches):
        judging(index / len(run.stretches))
        cut_short = run.stops_within(stretch)
        results += [
            replace(_without_shallow(result, least), cut_short=cut_short)
            for result in _judge_without_moves_above(run, stretch.without_wear(), float(heights[stretch.last - 1]))
        ]
    if results:
        contours = [
            CutContour(
                result.surface,
                result.stretch,
                highest_cut(result.stretch),
                accepted_difference(run, result.surface),
                run.setup_at(result.stretch.first + 1),
            )
            for result in results
        ]
        cuts = tuple(cut for cut in moves_through(run, contours, between) if cut.gouge.depth >= least)
        others = tuple(cut for cut in cuts_of_other_contours(run, contours, comparing) if cut.gouge.depth >= least)
        results[0] = replace(results[0], uncompensated_cuts=cuts, cuts_into_others=others)
    return tuple(results)


def _without_shallow(result: JudgedContour, least: float) -> JudgedContour:
    """Return the result without its gouges shallower than `least`; `shallow_gouges` counts those of the verdict."""
    verdict = result.verdict
    gouges = tuple(gouge for gouge in verdict.gouges if gouge.depth >= least)
    lead_gouges = tuple(gouge for gouge in result.lead_gouges if gouge.depth >= least)
    unseen = len(verdict.gouges) - len(gouges)
    if not unseen and len(lead_gouges) == len(result.lead_gouges):
        return result
    return replace(result, verdict=replace(verdict, gouges=gouges), lead_gouges=lead_gouges, shallow_gouges=unseen)


def _judge_without_moves_above(run: ControlRun, stretch: Stretch, height: float) -> list[JudgedContour]:
    """Judge a stretch; if it gouges or loops, omit its moves at `height` or higher unless that leaves more gouges."""
    results = judge_stretch(run, stretch)
    if not any(result.verdict.gouges or result.verdict.wrong_side or result.corner_loops for result in results):
        return results
    parted = divided(run.moves, stretch, height)
    pieces = None if parted is None else _judge_pieces(run, stretch, parted)
    return results if pieces is None or _count_gouges(pieces) > _count_gouges(results) else pieces


def _count_gouges(results: Sequence[JudgedContour]) -> int:
    return sum(len(result.verdict.gouges) + len(result.verdict.wrong_side) for result in results)


def _judge_pieces(run: ControlRun, stretch: Stretch, parted: Divided) -> list[JudgedContour]:
    """Return the verdicts on the pieces of a stretch, each with its cuts into the surfaces of the others."""
    judged = [judge_stretch(run, piece) for piece in parted.pieces]
    surfaces = {path_key(result.surface): result.surface for results in judged for result in results}
    contours = list(surfaces.values())
    tree = PathTree(contours)

    def near_contours(path: Path) -> list[Path]:
        """Return the contours that the cutter may reach along a path."""
        return [contours[row] for row in tree.near(path, stretch.radius)]

    split = [(piece, *split_where_it_closes(programmed_surface(piece))) for piece in parted.pieces]
    passes = [each for piece, surface, rows in split for each in closed_passes_of(piece, surface, rows)]
    cut_away = {
        path_key(without_repeats(wall.path)): wall for wall in standing_walls(passes, stretch.side) if wall.cut_away_by
    }
    unjudged: list[JudgedContour] = []
    for piece, results in zip(parted.pieces, judged, strict=True):
        center, own_keys = results[0].center, {path_key(result.surface) for result in results}
        near = {path_key(contour): contour for contour in near_contours(center)}
        other_walls = {key: contour for key, contour in near.items() if key not in own_keys}
        whole_walls = [contour for key, contour in other_walls.items() if key not in cut_away]
        cuts = cuts_into(run, stretch, center, whole_walls)
        gouges = [
            *cuts.gouges,
            *(
                gouge
                for key, wall in cut_away.items()
                if key in other_walls and wall.stands
                for gouge in cuts_below(run, piece, wall.top, other_walls[key], Leads.MOVES)
            ),
        ]
        results[0] = with_gouges(results[0], gouges, cuts.slack, (*whole_walls, center))
        unjudged += cuts.unjudged
    results = with_unjudged([replace(result, cut_away=()) for results in judged for result in results], unjudged)
    results[0] = replace(results[0], cut_away=tuple(cut_away.values()))
    # a lead passes over contours that it would cut if it were as low as they are
    leads = ((lead, lead.path()) for lead in parted.leads)
    over = (lead for lead, path in leads if cuts_into(run, stretch, path, near_contours(path)).gouges)
    if passing := (*parted.links, *over):
        lines = sorted({line for moves in passing for line in moves.lines[1:].tolist()})
        lowest = min(float(moves.points[:, 2].min()) for moves in passing)
        results[0] = replace(results[0], passed_over=PassedOver(lowest, tuple(lines)))
    return results


def deepest_gouge(results: tuple[JudgedContour, ...]) -> tuple[float, int | None]:
    """Return a run's deepest gouge in millimeters and its line: 0 and None without one, None for an unknown line."""
    gouges = [gouge for result in results for gouge in result.verdict.gouges]
    deepest = max(gouges, key=lambda gouge: gouge.depth, default=None)
    return (deepest.depth, line_of(deepest.path_number)) if deepest else (0.0, None)


def first_unjudged(results: tuple[JudgedContour, ...]) -> tuple[bool, int | None]:
    """Return whether a contour of a run cannot be judged, and the line of the first such contour."""
    result = next((result for result in results if not result.verdict.judged), None)
    return result is not None, None if result is None else first_line(result.center)
