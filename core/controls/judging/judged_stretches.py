"""Judged stretches: the verdicts on the contours of a compensated stretch, part by part if side or radius change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, groupby, pairwise

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.contours_and_leads import (
    MAX_LEAD_MOVES,
    RowRange,
    between_lead_arcs,
    blend_leads,
    closed_passes,
    contours_of,
    end_of_overlap,
    has_long_leads,
    is_closed,
    leads_at_corner,
    split_where_it_closes,
)
from core.controls.judging.corner_loops import without_corner_loops
from core.controls.judging.judged_contour import JudgedContour, most_uneven_arc, with_gouges, with_unjudged
from core.controls.judging.judged_walls import accepted_difference, cuts_below, cuts_into, judge_wall
from core.controls.judging.repeated_passes import path_key, without_repeats
from core.controls.judging.standing_walls import ClosedPass, StandingWall, standing_walls, walls_of
from core.controls.judging.stretch_paths import center_path, closed_passes_of, programmed_surface
from core.geometry.path import Path, joined
from core.verify.judge import judge
from core.verify.surface import Leads
from core.verify.verdict import Verdict


@dataclass(frozen=True, eq=False, slots=True)
class _Part:
    """A part of a stretch with one side and radius, and its surface.

    `rows` are those of its surface in the surface of the whole stretch.  `contours` are rows of its own surface, with
    all lines of an open contour among closed ones.
    """

    stretch: Stretch
    surface: Path
    rows: RowRange
    contours: Mapping[RowRange, frozenset[float]]


def judge_stretch(run: ControlRun, stretch: Stretch) -> list[JudgedContour]:
    """Return the verdicts on a stretch, for each part with the side and radius in force there.

    A part may also cut the surface of another part.  Such cuts count up to where the side changes; beyond it they are
    not judged, and a finding says so.
    """
    surface = programmed_surface(stretch)
    if len(stretch.parts()) == 1:
        surface, contours = split_where_it_closes(surface)
        rows = (0, len(surface))
        return _judge_part(
            run, _Part(stretch, surface, rows, _contours_within(contours, rows, _open_lines(surface, contours)))
        )
    contours = contours_of(surface)
    parts = _parts(stretch, surface, contours)
    results, unjudged = list[JudgedContour](), list[JudgedContour]()
    for _, group in groupby(parts, key=lambda part: part.stretch.side):
        same_side = list(group)
        others = _clipped(contours, (same_side[0].rows[0], same_side[-1].rows[1]))
        several = same_side if len(same_side) > 1 else []
        passes = [each for part in several for each in closed_passes_of(part.stretch, part.surface, part.contours)]
        for part in same_side:
            judged = _judge_part(run, part, passes)
            if several:
                judged[0], not_judged = _with_other_parts(run, judged[0], surface, others, part.rows, passes)
                unjudged += not_judged
            side_changes = bool(results) and part is same_side[0]
            results += [replace(judged[0], side_changes=side_changes), *judged[1:]]
    return with_unjudged(results, unjudged)


def _open_lines(surface: Path, contours: Sequence[RowRange]) -> dict[RowRange, frozenset[float]]:
    """Return the lines of the open contours among several."""
    open_contours = [rows for rows in contours if len(contours) > 1 and not is_closed(surface, rows)]
    return {rows: frozenset(surface.numbers[slice(*rows)].tolist()) for rows in open_contours}


def _parts(stretch: Stretch, surface: Path, contours: Sequence[RowRange]) -> list[_Part]:
    """Return the parts of a stretch; one that repeats walls of the part before it has contours of its own."""
    surfaces = [programmed_surface(part) for part in stretch.parts()]
    overlaps = [(last, end_of_overlap(surface, (first, last))) for first, last in contours]
    parts, open_lines = list[_Part](), _open_lines(surface, contours)
    ends = accumulate(map(len, surfaces), initial=0)
    for part, part_surface, rows in zip(stretch.parts(), surfaces, pairwise(ends), strict=True):
        repeated = max((last - first for first, last in _clipped(overlaps, rows)), default=0)
        if repeated > MAX_LEAD_MOVES:
            inner = {each: frozenset[float]() for each in contours_of(part_surface)}
        else:
            inner = _contours_within(contours, rows, open_lines)
        parts.append(_Part(part, part_surface, rows, inner))
    return parts


def _clipped(contours: Sequence[RowRange], rows: RowRange) -> list[RowRange]:
    """Return what of the contours lies in these rows."""
    clipped = ((max(first, rows[0]), min(last, rows[1])) for first, last in contours)
    return [(first, last) for first, last in clipped if first < last]


def _contours_within(
    contours: Sequence[RowRange], rows: RowRange, open_lines: dict[RowRange, frozenset[float]]
) -> dict[RowRange, frozenset[float]]:
    """Return what of the contours lies in a part's rows; take the lines of an open one for the first part it is in."""
    inner = {
        (first - rows[0], last - rows[0]): open_lines.pop(contour, frozenset())
        for contour in contours
        for first, last in _clipped([contour], rows)
    }
    return inner or {(0, rows[1] - rows[0]): frozenset()}


def _with_other_parts(
    run: ControlRun,
    result: JudgedContour,
    surface: Path,
    contours: Sequence[RowRange],
    rows: RowRange,
    passes: Sequence[ClosedPass],
) -> tuple[JudgedContour, list[JudgedContour]]:
    """Add the cuts into contours outside the part's rows; also return the contours that cannot be judged.

    If there are any, walls that other `passes` cut away are left out.  Gouges are assigned by row of the whole surface,
    because a subprogram's lines may be in several parts.
    """
    by_row, walls = replace(surface, numbers=np.arange(len(surface), dtype=np.float64)), dict[RowRange, Path]()
    for first, last in contours:
        edges = np.clip((first, *rows, last), first, last).tolist()
        # each separately, because a pass of another part does not repeat one of this part
        wall = joined([without_repeats(by_row.part(*both)) for both in pairwise(edges)])
        walls[first, last] = without_corner_loops(wall, result.stretch.side)[0]
    stretch, center = result.stretch, result.center
    cuts = cuts_into(run, stretch, center, list(walls.values()), Leads.SEGMENTS)
    gouges = cuts.gouges
    standing = standing_walls(passes, stretch.side) if gouges else ()
    if cut_away := {wall.shape: wall for wall in standing if wall.cut_away_by}:
        gouges = []
        for contour, wall in walls.items():
            runs = closed_passes(surface, contour) if is_closed(surface, contour) else ()
            shapes = {each: path_key(surface.part(*each)) for each in runs}
            if cut_away.keys().isdisjoint(shapes.values()):
                gouges += cuts_into(run, stretch, center, [wall], Leads.SEGMENTS).gouges
                continue
            for each, shape in shapes.items():
                if shape not in cut_away:
                    gouges += cuts_into(run, stretch, center, [by_row.part(*each)], Leads.SEGMENTS).gouges
                elif cut_away[shape].stands:
                    gouges += cuts_below(run, stretch, cut_away[shape].top, by_row.part(*each), Leads.SEGMENTS)
    others = [
        replace(gouge, surface_number=float(surface.numbers[int(gouge.surface_number)]))
        for gouge in gouges
        if not rows[0] <= gouge.surface_number < rows[1]
    ]
    unjudged = [replace(each, verdict=_with_number(each.verdict, surface)) for each in cuts.unjudged]
    return with_gouges(result, others, cuts.slack, (surface, center)), unjudged


def _with_number(verdict: Verdict, surface: Path) -> Verdict:
    """Return the verdict with an uneven arc of the surface given by its number instead of its row."""
    arc = verdict.uneven_arc
    if arc is None or not arc.on_surface:
        return verdict
    return replace(verdict, uneven_arc=replace(arc, number=float(surface.numbers[int(arc.number)])))


def _judge_part(run: ControlRun, part: _Part, passes: Sequence[ClosedPass] = ()) -> list[JudgedContour]:
    """Return the verdict on each contour of a part; the first one has the leads.

    If a contour is gouged, walls that other passes cut away are left out, and of an open contour the arcs that lead in
    and out.  `passes` are those of all parts of its side, this one too, if there are several.
    """
    stretch, surface, rows = part.stretch, part.surface, list(part.contours)
    center = center_path(run, stretch)
    accepted = accepted_difference(run, surface, center)
    closed = frozenset(
        line for each, lines in part.contours.items() if not lines for line in surface.numbers[slice(*each)].tolist()
    )

    def judged(walls: Sequence[StandingWall], *, alone: bool) -> list[JudgedContour]:
        return [judge_wall(run, stretch, wall, center, accepted, closed, alone=alone) for wall in walls]

    cut_away, contours = tuple[StandingWall, ...](), rows
    walls, results = _walls(surface, rows), list[JudgedContour]()
    while len(results) < len(walls) and not (results and results[-1].verdict.gouges):
        results += judged([walls[len(results)]], alone=len(walls) == 1)
    if results[-1].verdict.gouges:
        contours = [between_lead_arcs(surface, each, stretch, cut_short=run.stops_within(stretch)) for each in rows]
        own_passes = closed_passes_of(stretch, surface, contours)
        standing = walls_of(standing_walls(passes or own_passes, stretch.side), own_passes)
        cut_away = tuple(wall for wall in standing if wall.cut_away_by)
        if cut_away:
            open_walls = _walls(surface, [each for each in contours if not is_closed(surface, each)])
            walls = [*(wall for wall in standing if wall.stands), *open_walls]
            # two passes or more: one cuts another one away
            results = judged(walls or [replace(standing[0], top=-np.inf)], alone=False)
        elif contours != rows:
            walls = _walls(surface, contours)
            results = judged(walls, alone=len(walls) == 1)
        else:
            results += judged(walls[len(results) :], alone=len(walls) == 1)
    opened = [lines for lines in part.contours.values() if lines]
    results = [
        replace(result, open_lines=next((lines for lines in opened if result.lines <= lines), frozenset()))
        for result in results
    ]
    slack = max(result.verdict.radius_slack for result in results)
    results[0] = replace(results[0], cut_away=cut_away, uneven_arc=most_uneven_arc(slack, surface, center))
    return _with_leads(results, surface, tuple(contours), accepted, arcs=contours != rows)


def _walls(surface: Path, contours: Sequence[RowRange]) -> list[StandingWall]:
    """Return the walls of contours; closed ones of one shape make one wall."""
    shapes = dict[object, list[Path]]()
    for rows in contours:
        path = surface.part(*rows)
        shapes.setdefault(path_key(path) if is_closed(surface, rows) else rows, []).append(path)
    return [StandingWall(joined(paths)) for paths in shapes.values()]


def _with_leads(
    results: list[JudgedContour], surface: Path, contours: tuple[RowRange, ...], accepted: float, *, arcs: bool
) -> list[JudgedContour]:
    """Return the results with the leads outside the contours in the first one; with `arcs` all of them are doubtful."""
    in_contour = np.zeros(len(surface), np.bool_)
    for first, last in contours:
        in_contour[first:last] = True
    leads = surface.numbers[~in_contour].tolist()
    if not leads:
        return results
    stretch, center, wall = results[0].stretch, results[0].center, without_repeats(surface)
    long = has_long_leads(surface, contours)
    ends = Leads.NONE if long else Leads.SEGMENTS
    verdict = judge(wall, stretch.side, stretch.radius, center, accepted, leads=ends, measures_uncut=False)
    gouges = verdict.gouges if verdict.judged else ()
    certain = set[float]() if arcs else {float(surface.numbers[row]) for row in blend_leads(surface, contours)}
    doubtful = set(leads) - certain
    results[0] = replace(
        results[0],
        lead_lines=tuple(dict.fromkeys(map(int, leads))),
        long_leads=long,
        doubtful_leads=arcs or leads_at_corner(surface, contours),
        lead_gouges=tuple(gouge for gouge in gouges if gouge.surface_number in doubtful),
        lead_slack=verdict.radius_slack,
    )
    if verdict.judged:
        return results
    return with_unjudged(results, [JudgedContour(stretch, wall, center, verdict, frozenset())])
