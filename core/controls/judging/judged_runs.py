"""Judged runs show what a control's path does to the contour that the program describes, by program line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from typing import Final

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
from core.controls.judging.corner_loops import CornerLoop, without_corner_loops
from core.controls.judging.crossing_contours import cuts_of_other_contours
from core.controls.judging.moves_above import Z_COLUMN, Divided, divided, heights_above
from core.controls.judging.rapids_at_depth import CutContour, UncompensatedCut, highest_cut, moves_through
from core.controls.judging.repeated_passes import path_key, without_repeats
from core.controls.judging.standing_walls import (
    ClosedPass,
    StandingWall,
    closed_passes_of,
    standing_walls,
    walls_of,
)
from core.controls.moves import Moves, Plane
from core.controls.registry import arc_tolerance
from core.geometry.nearby import BoxTree, near_pairs
from core.geometry.path import Floats, Path, Rows, joined
from core.progress import Progress, silent
from core.progress import part as part_of
from core.tolerance import ARC_RADII, GOUGE, ON_PATH
from core.units import Kind, Unit, decimals_shown, to_mm
from core.verify.judge import judge
from core.verify.other_contours import ContourCut
from core.verify.surface import Leads
from core.verify.verdict import Gouge, Verdict

JUDGING_SHARE: Final = 0.8
"""Progress when every stretch is judged; comparing their contours with one another takes the rest."""


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
class Judged:
    """A compensated stretch, the surface it cuts, the center path with its leads, and the verdict on them.

    Repeated passes are removed from surface and center path separately; `lines` covers the whole surface, because of
    two equal passes the surface may keep one and the path the other.  `leads` are programmed moves treated as leads
    because a contour begins after or ends before them, which is doubtful if they are `long_leads` or `doubtful_leads`
    (out and back at a corner, or arcs of an open contour); `lead_gouges` are the cuts into them, measured with
    `lead_slack` of extra tolerance, because they may be surface after all.  `by_itself`: the side changes within the
    stretch, and cuts into its other parts are not judged.  `cut_short`: the control stops within the stretch, so that
    what stays uncut says nothing.  `open_lines`: all lines of an open contour among closed ones, if this result is its
    first part.  `unseen_gouges` counts gouges too shallow for a digit of the program's unit; the verdict leaves them
    out.  `above`: moves above the contour, which are not judged.  On a run's first result, `uncompensated` has the cuts
    of moves without compensation into all contours, and `of_others` the cuts of compensated moves into contours of
    other stretches.  `loops` go around outside corners and are not surface; other passes cut away
    the walls of `cut_away`.
    """

    stretch: Stretch
    surface: Path
    center: Path
    verdict: Verdict
    lines: frozenset[float]
    leads: tuple[int, ...] = ()
    long_leads: bool = False
    doubtful_leads: bool = False
    lead_gouges: tuple[Gouge, ...] = ()
    lead_slack: float = 0.0
    by_itself: bool = False
    cut_short: bool = False
    open_lines: frozenset[float] = frozenset()
    uneven: ToleratedArc | None = None
    unseen_gouges: int = 0
    above: PassedOver | None = None
    uncompensated: tuple[UncompensatedCut, ...] = ()
    of_others: tuple[ContourCut, ...] = ()
    loops: tuple[CornerLoop, ...] = ()
    cut_away: tuple[StandingWall, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Contours:
    """Contours that can be searched for those near a path; `owners`: the index of each piece box's contour."""

    paths: list[Path]
    pieces: BoxTree
    owners: Rows

    @staticmethod
    def of(paths: list[Path]) -> Contours:
        """Index these contours, of which there must be at least one."""
        boxes = np.concatenate([path.boxes for path in paths], axis=1)
        return Contours(paths, BoxTree.of(boxes), np.repeat(np.arange(len(paths)), [len(path) for path in paths]))

    def near(self, center: Path, radius: float) -> list[Path]:
        """Return the contours that the cutter may reach along a path."""
        rows = [np.unique(self.owners[pieces]) for _, pieces in near_pairs(center.boxes, self.pieces, radius)]
        return [self.paths[row] for row in np.unique(np.concatenate(rows)).tolist()] if rows else []


def smallest_gouge(unit: Unit) -> float:
    """Return the millimeters below which a gouge is ignored: half the last digit a control shows in this unit."""
    return to_mm(0.5 * 10.0 ** -decimals_shown(Kind.LENGTH, unit), unit)


def judge_run(run: ControlRun, progress: Progress = silent) -> tuple[Judged, ...]:
    """Return the verdict on every compensated stretch of a run, in its own plane; paths are numbered by lines.

    A run given up as endless has no verdicts: its own finding says so, and the same moves a thousand times over would
    be judged against one another.
    """
    if run.endless:
        return ()
    least, results, heights = smallest_gouge(run.unit), list[Judged](), heights_above(run)
    judging, comparing = part_of(progress, 0.0, JUDGING_SHARE), part_of(progress, JUDGING_SHARE, 1.0)
    for done, stretch in enumerate(run.stretches):
        judging(done / len(run.stretches))
        cut_short = run.stops_within(stretch)
        results += [
            replace(_without_shallow(result, least), cut_short=cut_short)
            for result in _judge_without_moves_above(run, stretch.without_wear(), float(heights[stretch.last - 1]))
        ]
    if results:
        contours = [
            CutContour(
                result.surface, result.stretch, highest_cut(result.stretch), _accepted_difference(run, result.surface)
            )
            for result in results
        ]
        cuts = tuple(cut for cut in moves_through(run, contours) if cut.gouge.depth >= least)
        others = tuple(cut for cut in cuts_of_other_contours(run, contours, comparing) if cut.gouge.depth >= least)
        results[0] = replace(results[0], uncompensated=cuts, of_others=others)
    return tuple(results)


def _without_shallow(result: Judged, least: float) -> Judged:
    """Return the result without its gouges shallower than `least`; `unseen_gouges` counts those of the verdict."""
    verdict = result.verdict
    gouges = tuple(gouge for gouge in verdict.gouges if gouge.depth >= least)
    lead_gouges = tuple(gouge for gouge in result.lead_gouges if gouge.depth >= least)
    unseen = len(verdict.gouges) - len(gouges)
    if not unseen and len(lead_gouges) == len(result.lead_gouges):
        return result
    return replace(result, verdict=replace(verdict, gouges=gouges), lead_gouges=lead_gouges, unseen_gouges=unseen)


def programmed_surface(stretch: Stretch) -> Path:
    """Return what is programmed between the lead-in and lead-out moves."""
    programmed = stretch.programmed
    return programmed.part(stretch.entry, len(programmed) - stretch.exit).path(stretch.plane)


def _judge_without_moves_above(run: ControlRun, stretch: Stretch, height: float) -> list[Judged]:
    """Judge a stretch; if it gouges or loops, omit its moves at `height` or higher unless that leaves more gouges."""
    whole = _judge_stretch(run, stretch)
    if not any(result.verdict.gouges or result.verdict.wrong_side or result.loops for result in whole):
        return whole
    parted = divided(run.moves, stretch, height)
    pieces = None if parted is None else _judge_pieces(run, stretch, parted)
    return whole if pieces is None or _count_gouges(pieces) > _count_gouges(whole) else pieces


def _count_gouges(results: Sequence[Judged]) -> int:
    return sum(len(result.verdict.gouges) + len(result.verdict.wrong_side) for result in results)


def _judge_pieces(run: ControlRun, stretch: Stretch, parted: Divided) -> list[Judged]:
    """Return the verdicts on the pieces of a stretch, each with its cuts into the surfaces of the others."""
    judged = [_judge_stretch(run, piece) for piece in parted.pieces]
    surfaces = {path_key(result.surface): result.surface for results in judged for result in results}
    contours = Contours.of(list(surfaces.values()))
    passes = [each for piece in parted.pieces for each in _closed_passes(piece)]
    cut_away = {
        path_key(without_repeats(wall.path)): wall for wall in standing_walls(passes, stretch.side) if wall.cut_away_by
    }
    unjudged: list[Judged] = []
    for piece, results in zip(parted.pieces, judged, strict=True):
        surface_keys, center = {path_key(result.surface) for result in results}, results[0].center
        near = {path_key(contour): contour for contour in contours.near(center, stretch.radius)}
        others = [contour for key, contour in near.items() if key not in surface_keys and key not in cut_away]
        more, unknown, slack = _cuts_of(run, stretch, center, others)
        for key, wall in cut_away.items():
            if key in near and key not in surface_keys and wall.stands:
                more += _cuts_below(run, piece, wall.top, near[key], Leads.MOVES)
        results[0] = _with_gouges(results[0], more, slack, (*others, center))
        unjudged += unknown
    results = _with_unjudged([replace(result, cut_away=()) for results in judged for result in results], unjudged)
    results[0] = replace(results[0], cut_away=tuple(cut_away.values()))
    passing = (*parted.links, *(lead for lead in parted.leads if _passes_over(run, stretch, lead, contours)))
    if passing:
        lines = sorted({line for moves in passing for line in moves.lines[1:].tolist()})
        lowest = min(float(moves.points[:, 2].min()) for moves in passing)
        results[0] = replace(results[0], above=PassedOver(lowest, tuple(lines)))
    return results


def _passes_over(run: ControlRun, part: Stretch, lead: Moves, contours: Contours) -> bool:
    """True if a lead would cut contours if it were as low as they are."""
    path = lead.path()
    return bool(_cuts_of(run, part, path, contours.near(path, part.radius))[0])


def _cuts_of(
    run: ControlRun, part: Stretch, center: Path, contours: Sequence[Path], leads: Leads = Leads.MOVES
) -> tuple[list[Gouge], list[Judged], float]:
    """Return a path's cuts into contours, the contours that cannot be judged, and the tolerance uneven arcs add."""
    gouges, unjudged, slack = list[Gouge](), list[Judged](), 0.0
    for contour in contours:
        accepted = _accepted_difference(run, contour, center)
        verdict = judge(contour, part.side, part.radius, center, accepted, leads=leads, measures_uncut=False)
        if verdict.judged:
            gouges += verdict.gouges
            slack = max(slack, verdict.radius_slack)
        else:
            unjudged.append(Judged(part, contour, center, verdict, frozenset()))
    return gouges, unjudged, slack


def _with_gouges(result: Judged, more: Sequence[Gouge], slack: float, paths: Sequence[Path]) -> Judged:
    """Return the result with more gouges, and the most uneven arc of these paths if it raises the tolerance."""
    if not result.verdict.judged:
        return result
    gouges = sorted((*result.verdict.gouges, *more), key=lambda gouge: -gouge.depth)
    if slack > (result.uneven.slack if result.uneven else 0.0):
        result = replace(result, uneven=_most_uneven(slack, *paths))
    return replace(result, verdict=replace(result.verdict, gouges=tuple(gouges)))


def _judge_stretch(run: ControlRun, stretch: Stretch) -> list[Judged]:
    """Return the verdicts on a stretch, for each part with the side and radius in force there.

    A part may also cut the surface of another part.  Such cuts count up to where the side changes; beyond it they are
    not judged, and a finding says so.
    """
    surface, parts = programmed_surface(stretch), stretch.parts()
    whole, contours = split_where_it_closes(surface) if len(parts) == 1 else (surface, contours_of(surface))
    open_contours = [rows for rows in contours if len(contours) > 1 and not is_closed(whole, rows)]
    open_lines = {rows: frozenset(whole.numbers[slice(*rows)].tolist()) for rows in open_contours}
    surfaces = [programmed_surface(part) for part in parts] if len(parts) > 1 else [whole]
    ends = list(accumulate(map(len, surfaces), initial=0))
    repeated = [(rows[1], end_of_overlap(whole, rows)) for rows in contours] if len(parts) > 1 else []
    inner = [
        _within_part(contours, rows, open_lines) if _longest(_clipped(repeated, rows)) <= MAX_LEAD_MOVES else _own(cut)
        for rows, cut in zip(pairwise(ends), surfaces, strict=True)
    ]
    passes = [
        closed_passes_of(cut, list(rows), _heights(part, cut), part.radius)
        for part, cut, rows in zip(parts, surfaces, inner, strict=True)
        if len(parts) > 1
    ]
    results, unjudged = list[Judged](), list[Judged]()
    for index, (part, rows) in enumerate(zip(parts, pairwise(ends), strict=True)):
        same_side = _same_side(parts, index)
        alike = [each for other in same_side for each in passes[other]] if len(same_side) > 1 else []
        judgments = _judge_part(run, part, surfaces[index], inner[index], alike)
        if len(same_side) > 1:
            reach = (ends[same_side[0]], ends[same_side[-1] + 1])
            others = _clipped(contours, reach)
            judgments[0], unknown = _with_other_parts(run, judgments[0], whole, others, rows, alike)
            unjudged += unknown
        judgments[0] = replace(judgments[0], by_itself=0 < index == same_side[0])
        results += judgments
    return _with_unjudged(results, unjudged)


def _same_side(parts: Sequence[Stretch], index: int) -> range:
    """Return the indices of the parts around a part up to where the side changes."""
    begin = end = index
    while begin and parts[begin - 1].side is parts[index].side:
        begin -= 1
    while end < len(parts) and parts[end].side is parts[index].side:
        end += 1
    return range(begin, end)


def _clipped(contours: Sequence[RowRange], rows: RowRange) -> list[RowRange]:
    """Return what of the contours lies in these rows."""
    clipped = ((max(first, rows[0]), min(last, rows[1])) for first, last in contours)
    return [(first, last) for first, last in clipped if first < last]


def _longest(runs: Sequence[RowRange]) -> int:
    return max((last - first for first, last in runs), default=0)


def _own(cut: Path) -> dict[RowRange, frozenset[float]]:
    """Return the contours of a part that repeats walls of the part before it, and so has them as its own."""
    return {rows: frozenset() for rows in contours_of(cut)}


def _within_part(
    contours: Sequence[RowRange], rows: RowRange, open_lines: dict[RowRange, frozenset[float]]
) -> dict[RowRange, frozenset[float]]:
    """Return what of the contours lies in a part's rows, with the lines of an open one in the first part it is in."""
    inner = {
        (first - rows[0], last - rows[0]): open_lines.pop(contour, frozenset())
        for contour in contours
        for first, last in _clipped([contour], rows)
    }
    return inner or {(0, rows[1] - rows[0]): frozenset()}


def _with_unjudged(results: list[Judged], unjudged: Sequence[Judged]) -> list[Judged]:
    """Return the results, and of the unjudged ones one for each reason that no result gives."""
    reasons = {result.verdict.uneven_arc for result in results if not result.verdict.judged}
    more = {result.verdict.uneven_arc: result for result in unjudged if result.verdict.uneven_arc not in reasons}
    return [*results, *more.values()]


def _with_other_parts(
    run: ControlRun,
    result: Judged,
    whole: Path,
    contours: Sequence[RowRange],
    rows: RowRange,
    passes: Sequence[ClosedPass],
) -> tuple[Judged, list[Judged]]:
    """Add the cuts into contours outside the part's rows; also return the contours that cannot be judged.

    If there are any, walls that other `passes` cut away are left out.  Gouges are assigned by row, because a
    subprogram's lines may be in several parts.
    """
    numbered, surfaces = replace(whole, numbers=np.arange(len(whole), dtype=np.float64)), dict[RowRange, Path]()
    for first, last in contours:
        edges = np.clip((first, *rows, last), first, last).tolist()
        # each separately, because a pass of another part does not repeat one of this part
        surface = joined([without_repeats(numbered.part(*both)) for both in pairwise(edges)])
        surfaces[first, last] = without_corner_loops(surface, result.stretch.side)[0]
    stretch, center = result.stretch, result.center
    gouges, unjudged, slack = _cuts_of(run, stretch, center, list(surfaces.values()), Leads.SEGMENTS)
    cut_away = {wall.shape: wall for wall in standing_walls(passes, stretch.side) if wall.cut_away_by} if gouges else {}
    if cut_away:
        gouges = []
        for contour, surface in surfaces.items():
            runs = closed_passes(whole, contour) if is_closed(whole, contour) else ()
            walls = {each: cut_away.get(path_key(whole.part(*each))) for each in runs}
            if not any(walls.values()):
                gouges += _cuts_of(run, stretch, center, [surface], Leads.SEGMENTS)[0]
                continue
            for each, wall in walls.items():
                if wall is None:
                    gouges += _cuts_of(run, stretch, center, [numbered.part(*each)], Leads.SEGMENTS)[0]
                elif wall.stands:
                    gouges += _cuts_below(run, stretch, wall.top, numbered.part(*each), Leads.SEGMENTS)
    others = [
        replace(gouge, surface_number=float(whole.numbers[int(gouge.surface_number)]))
        for gouge in gouges
        if not rows[0] <= gouge.surface_number < rows[1]
    ]
    unknown = [replace(each, verdict=_numbered(each.verdict, whole)) for each in unjudged]
    return _with_gouges(result, others, slack, (whole, center)), unknown


def _numbered(verdict: Verdict, surface: Path) -> Verdict:
    """Return the verdict with an uneven arc of the surface given by its number instead of its row."""
    arc = verdict.uneven_arc
    if arc is None or not arc.on_surface:
        return verdict
    return replace(verdict, uneven_arc=replace(arc, number=float(surface.numbers[int(arc.number)])))


def _judge_part(
    run: ControlRun,
    stretch: Stretch,
    whole: Path,
    contours: Mapping[RowRange, frozenset[float]],
    alike: Sequence[ClosedPass],
) -> list[Judged]:
    """Return the verdict on each contour of a part with one side and radius; the first one has the leads.

    `contours` have all lines of an open one among closed ones.  If a contour is gouged, walls that other passes cut
    away are left out, and of an open contour the arcs that lead in and out.  `alike`: the passes of all parts of its
    side, this one too, if there are several.
    """
    center = _center_path(run, stretch)
    accepted = _accepted_difference(run, whole, center)
    closed = frozenset(line for rows in contours if not contours[rows] for line in whole.numbers[slice(*rows)].tolist())

    def judged(walls: Sequence[StandingWall], *, alone: bool) -> list[Judged]:
        return [_judge_wall(run, stretch, wall, center, accepted, closed, alone=alone) for wall in walls]

    rows, cut_away = list(contours), tuple[StandingWall, ...]()
    spans, walls = rows, _walls(whole, rows)
    results = list[Judged]()
    while len(results) < len(walls) and not (results and results[-1].verdict.gouges):
        results += judged([walls[len(results)]], alone=len(walls) == 1)
    if results[-1].verdict.gouges:
        spans = [between_lead_arcs(whole, each, stretch, cut_short=run.stops_within(stretch)) for each in rows]
        passes = closed_passes_of(whole, spans, _heights(stretch, whole), stretch.radius)
        standing = walls_of(standing_walls(alike or passes, stretch.side), passes)
        cut_away = tuple(wall for wall in standing if wall.cut_away_by)
        if cut_away:
            open_walls = _walls(whole, [span for span in spans if not is_closed(whole, span)])
            walls = [*(wall for wall in standing if wall.stands), *open_walls]
            # two passes or more: one cuts another one away
            results = judged(walls or [replace(standing[0], top=-np.inf)], alone=False)
        elif spans != rows:
            walls = _walls(whole, spans)
            results = judged(walls, alone=len(walls) == 1)
        else:
            results += judged(walls[len(results) :], alone=len(walls) == 1)
    opened = [lines for lines in contours.values() if lines]
    results = [
        replace(result, open_lines=next((lines for lines in opened if result.lines <= lines), frozenset()))
        for result in results
    ]
    slack = max(result.verdict.radius_slack for result in results)
    results[0] = replace(results[0], cut_away=cut_away, uneven=_most_uneven(slack, whole, center))
    return _with_leads(results, whole, tuple(spans), accepted, arcs=spans != rows)


def _walls(whole: Path, contours: Sequence[RowRange]) -> list[StandingWall]:
    """Return the walls of contours; closed ones of one shape make one wall."""
    shapes = dict[object, list[Path]]()
    for rows in contours:
        path = whole.part(*rows)
        shapes.setdefault(path_key(path) if is_closed(whole, rows) else rows, []).append(path)
    return [StandingWall(joined(paths)) for paths in shapes.values()]


def _closed_passes(stretch: Stretch) -> list[ClosedPass]:
    """Return the closed passes of a stretch of one side and radius."""
    whole, contours = split_where_it_closes(programmed_surface(stretch))
    return closed_passes_of(whole, contours, _heights(stretch, whole), stretch.radius)


def _heights(stretch: Stretch, surface: Path) -> Floats:
    """Return (n, 2) the heights of both ends of each piece of a stretch's surface; 0 in planes other than XY.

    Pieces of the surface may be split, but are otherwise those programmed.
    """
    if stretch.plane is not Plane.XY:
        return np.zeros((len(surface), 2))
    programmed = stretch.programmed.part(stretch.entry, len(stretch.programmed) - stretch.exit)
    rows = np.flatnonzero(programmed.moving_in(stretch.plane))
    if len(rows) < len(surface):
        whole = programmed_surface(stretch)
        split = split_where_it_closes(replace(whole, numbers=np.arange(len(whole), dtype=np.float64))).path
        rows = rows[split.numbers.astype(np.intp)]
    heights = programmed.points[:, Z_COLUMN]
    return np.column_stack((heights[rows - 1], heights[rows]))


def _with_leads(
    results: list[Judged], whole: Path, contours: tuple[RowRange, ...], accepted: float, *, arcs: bool
) -> list[Judged]:
    """Return the results with the leads outside the contours in the first one; with `arcs` all of them are doubtful."""
    in_contour = np.zeros(len(whole), np.bool_)
    for first, last in contours:
        in_contour[first:last] = True
    leads = whole.numbers[~in_contour].tolist()
    if not leads:
        return results
    stretch, center, surface = results[0].stretch, results[0].center, without_repeats(whole)
    long = has_long_leads(whole, contours)
    ends = Leads.NONE if long else Leads.SEGMENTS
    verdict = judge(surface, stretch.side, stretch.radius, center, accepted, leads=ends, measures_uncut=False)
    gouges = verdict.gouges if verdict.judged else ()
    certain = set[float]() if arcs else {float(whole.numbers[row]) for row in blend_leads(whole, contours)}
    doubtful = set(leads) - certain
    results[0] = replace(
        results[0],
        leads=tuple(dict.fromkeys(map(int, leads))),
        long_leads=long,
        doubtful_leads=arcs or leads_at_corner(whole, contours),
        lead_gouges=tuple(gouge for gouge in gouges if gouge.surface_number in doubtful),
        lead_slack=verdict.radius_slack,
    )
    if verdict.judged:
        return results
    return _with_unjudged(results, [Judged(stretch, surface, center, verdict, frozenset())])


def _center_path(run: ControlRun, stretch: Stretch) -> Path:
    """Return the tool's center path without repeated passes.

    Of a center path with wear it is the programmed path, as with no wear, and the move that leaves it, if one does.
    """
    if stretch.wear:
        programmed = stretch.programmed.path(stretch.plane)
        way_out = run.moves.part(stretch.last - 2, stretch.last)
        leaves = not run.stops_within(stretch) and way_out.lines[-1] != stretch.programmed.lines[-1]
        return without_repeats(joined([programmed, way_out.path(stretch.plane)]) if leaves else programmed)
    return without_repeats(_path_of(run.moves.part(stretch.first, stretch.last), stretch))


def _path_of(moves: Moves, stretch: Stretch) -> Path:
    """Return the path of a tool in the plane of a stretch; if the tool stands still, a line of no length."""
    path = moves.path(stretch.plane)
    if len(path) or not len(moves):
        return path
    point = moves.points[-1:, list(stretch.plane.axes[:2])]
    return Path.of(np.repeat(point, 2, axis=0), point, np.zeros(1, np.int8), np.array([float(moves.lines[-1])]))


def _judge_wall(
    run: ControlRun,
    stretch: Stretch,
    wall: StandingWall,
    center: Path,
    accepted: float,
    closed: frozenset[float],
    *,
    alone: bool,
) -> Judged:
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
        verdict = replace(verdict, gouges=tuple(_cuts_below(run, stretch, wall.top, surface, leads)))
    return Judged(stretch, surface, center, verdict, lines, loops=loops)


def _cuts_below(run: ControlRun, stretch: Stretch, top: float, contour: Path, leads: Leads) -> list[Gouge]:
    """Return the cuts into a contour of a stretch's moves that begin or end below a height, the deepest first."""
    moves = run.moves.part(stretch.first, stretch.last)
    heights = moves.points[:, Z_COLUMN]
    low = np.minimum(heights, np.concatenate((heights[:1], heights[:-1]))) < top - ON_PATH
    paths = [_path_of(part, stretch) for part in moves.runs(low)]
    gouges = [gouge for path in paths for gouge in _cuts_of(run, stretch, path, [contour], leads)[0]]
    return sorted(gouges, key=lambda gouge: -gouge.depth)


def _accepted_difference(run: ControlRun, *paths: Path) -> float:
    """Return how far in millimeters the run's control lets the radii of the largest of these arcs differ."""
    radii = [float(path.radii[path.turns != 0].max(initial=0.0)) for path in paths]
    return max(ARC_RADII, arc_tolerance(run.control).largest_difference(max(radii), run.unit) + GOUGE)


def _most_uneven(slack: float, *paths: Path) -> ToleratedArc | None:
    """Return the arc of these paths whose radii differ most; None if neither it nor `slack` exceeds ARC_RADII."""
    worst, difference = None, ARC_RADII if slack <= ARC_RADII else ON_PATH
    for path in paths:
        arms = path.ends - path.centers
        first, last = path.radii, np.hypot(arms[:, 0], arms[:, 1])
        apart = np.where(path.turns != 0, np.abs(last - first), 0.0)
        row = int(apart.argmax()) if len(apart) else 0
        if len(apart) and apart[row] > difference:
            line, difference = line_of(path.numbers[row]), apart[row]
            worst = ToleratedArc(float(first[row]), float(last[row]), line, slack)
    return worst


def deepest_gouge(results: tuple[Judged, ...]) -> tuple[float, int | None]:
    """Return a run's deepest gouge in millimeters and its line: 0 and None without one, None for an unknown line."""
    gouges = [gouge for result in results for gouge in result.verdict.gouges]
    deepest = max(gouges, key=lambda gouge: gouge.depth, default=None)
    return (deepest.depth, line_of(deepest.path_number)) if deepest else (0.0, None)


def first_unjudged(results: tuple[Judged, ...]) -> tuple[bool, int | None]:
    """Return whether a contour of a run cannot be judged, and the line of the first such contour."""
    result = next((result for result in results if not result.verdict.judged), None)
    return result is not None, None if result is None else first_line(result.center)


def line_of(number: float) -> int | None:
    """Return the program line in a path piece's number; None for 0, a move that belongs to no line."""
    return int(number) or None


def first_line(path: Path) -> int | None:
    """Return the program line of a path's first piece; None for an empty path or an unknown line."""
    return line_of(path.numbers[0]) if len(path) else None
