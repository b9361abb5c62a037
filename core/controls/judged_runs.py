"""Judged runs: what a control's path does to the contour that the program describes, by the program's lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import compress, pairwise
from typing import Final

import numpy as np

from core.controls.contours_and_leads import (
    MAX_LEAD_MOVES,
    RowRange,
    SplitContours,
    blend_leads,
    has_long_leads,
    leads_at_corner,
    split_where_it_closes,
)
from core.controls.control_run import ControlRun, Stretch
from core.controls.corner_loops import CornerLoop, without_corner_loops
from core.controls.crossing_contours import ContourCut, cuts_of_other_contours
from core.controls.moves import Moves, Plane
from core.controls.moves_above import Divided, divided, heights_above
from core.controls.rapids_at_depth import CutContour, UncompensatedCut, highest_cut, moves_through, rapid_walls
from core.controls.registry import arc_tolerance
from core.controls.repeated_passes import path_key, without_repeats
from core.finding import Finding, Severity
from core.geometry.nearby import BoxTree, near_pairs
from core.geometry.path import Path, Rows, joined
from core.progress import Progress, silent
from core.progress import part as part_of
from core.tolerance import ARC_RADII, GOUGE, ON_PATH, ROUNDING
from core.units import Kind, Unit, decimals_shown, to_mm
from core.verify.air_cuts import AirCut, air_cuts
from core.verify.judge import judge
from core.verify.report import DIGIT, SHOWN, contact_findings, enumerated, or_more
from core.verify.surface import Leads
from core.verify.verdict import Gouge, OverRun, Verdict

MAX_GOUGES: Final = 20
"""Gouges of a stretch that have a finding each, deepest first."""

JUDGED: Final = 0.8
"""Share of the work that is done when each stretch is judged, and its contours are still to be compared."""

MAX_LINES: Final = 6
"""Lines that a finding of several places names."""

LIMIT_RULES: Final = frozenset({"LIMIT", "FN-ENDLESS"})
"""The rules by which a run ends that repeats too much to be followed."""

CAM_ROUNDING: Final = 0.0127 + ROUNDING
"""Millimeters (0.0005 in) of tolerance that a CAM system's rounding explains; more may hide a gouge."""


@dataclass(frozen=True, slots=True)
class ToleratedArc:
    """The arc whose radii at its start and its end differ most, and its line.

    `slack`: by how much the uneven arcs of surface and path raise the tolerance.
    """

    first: float
    last: float
    line: int | None
    slack: float


@dataclass(frozen=True, slots=True)
class PassedOver:
    """Moves above the part that pass over it: their lowest place and their lines."""

    height: float
    lines: tuple[int, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Judged:
    """A compensated stretch, the surface it cuts, the center path with its leads, and the verdict on them.

    Surface and center path are without the passes that they repeat, each by itself; `lines` are those of the whole
    surface, since of two equal passes one may be kept of the surface and the other of the path.
    `leads` are programmed moves taken for leads because a closed contour begins after them or ends before them, which
    is doubtful where they are `long_leads` or, there and back at a corner, `corner_leads`; `lead_gouges` is what is cut
    of them, measured with `lead_slack` of extra tolerance: they may be surface after all.
    `by_itself`: the side changed where it begins, and what is cut on the other side is not judged.  `open_lines`: the
    lines of all of an open contour among closed ones, of which this is the first part.  `unseen_gouges`: how many are
    too shallow for a digit of the program's unit, and are not in the verdict.  `above`: moves above the contour that
    are not judged.  `uncompensated`, of a run's first part: what moves without compensation cut of all contours, and
    `of_others` what compensated moves cut of contours of other stretches.  `loops` are around outside corners and no
    surface.
    """

    stretch: Stretch
    surface: Path
    center: Path
    verdict: Verdict
    lines: frozenset[float]
    leads: tuple[int, ...] = ()
    long_leads: bool = False
    corner_leads: bool = False
    lead_gouges: tuple[Gouge, ...] = ()
    lead_slack: float = 0.0
    by_itself: bool = False
    open_lines: frozenset[float] = frozenset()
    uneven: ToleratedArc | None = None
    unseen_gouges: int = 0
    above: PassedOver | None = None
    uncompensated: tuple[UncompensatedCut, ...] = ()
    of_others: tuple[ContourCut, ...] = ()
    loops: tuple[CornerLoop, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Contours:
    """Contours of which only those near a path are judged; `owners`: which one each box of a piece belongs to."""

    paths: list[Path]
    pieces: BoxTree
    owners: Rows

    @staticmethod
    def of(paths: list[Path]) -> Contours:
        """These contours; at least one."""
        boxes = np.concatenate([path.boxes for path in paths], axis=1)
        return Contours(paths, BoxTree.of(boxes), np.repeat(np.arange(len(paths)), [len(path) for path in paths]))

    def near(self, center: Path, radius: float) -> list[Path]:
        """The contours that the cutter may reach along a path."""
        found = [np.unique(self.owners[pieces]) for _, pieces in near_pairs(center.boxes, self.pieces, radius)]
        return [self.paths[row] for row in np.unique(np.concatenate(found)).tolist()] if found else []


def smallest_gouge(unit: Unit) -> float:
    """Millimeters below which a gouge is none: half of the last digit that a control shows in this unit."""
    return to_mm(0.5 * 10.0 ** -decimals_shown(Kind.LENGTH, unit), unit)


def judge_run(run: ControlRun, progress: Progress = silent) -> tuple[Judged, ...]:
    """The verdict on every compensated stretch of a run, in its own plane; paths are numbered by lines.

    There is none on a run that was given up as endless: it says so itself, and the same moves a thousand times over
    would be judged against one another.
    """
    if any(finding.code in LIMIT_RULES for finding in run.findings):
        return ()
    least, results, heights = smallest_gouge(run.unit), list[Judged](), heights_above(run)
    judging, comparing = part_of(progress, 0.0, JUDGED), part_of(progress, JUDGED, 1.0)
    for done, stretch in enumerate(run.stretches):
        judging(done / len(run.stretches))
        results += [
            _seen(result, least)
            for result in _judge_without_moves_above(run, stretch, float(heights[stretch.last - 1]))
        ]
    if results:
        contours = _cut_contours(run, results)
        cuts = tuple(cut for cut in moves_through(run, contours) if cut.gouge.depth >= least)
        others = tuple(cut for cut in cuts_of_other_contours(run, contours, comparing) if cut.gouge.depth >= least)
        results[0] = replace(results[0], uncompensated=cuts, of_others=others)
    return tuple(results)


def _cut_contours(run: ControlRun, results: Sequence[Judged]) -> list[CutContour]:
    """The contours of these results with how high each is cut."""
    return [
        CutContour(
            result.surface, result.stretch, highest_cut(result.stretch), _accepted_difference(run, result.surface)
        )
        for result in results
    ]


def _seen(result: Judged, least: float) -> Judged:
    """The result with the gouges that are at least so deep."""
    verdict = result.verdict
    gouges = tuple(gouge for gouge in verdict.gouges if gouge.depth >= least)
    lead_gouges = tuple(gouge for gouge in result.lead_gouges if gouge.depth >= least)
    unseen = len(verdict.gouges) - len(gouges)
    if not unseen and len(lead_gouges) == len(result.lead_gouges):
        return result
    return replace(result, verdict=replace(verdict, gouges=gouges), lead_gouges=lead_gouges, unseen_gouges=unseen)


def programmed_surface(stretch: Stretch) -> Path:
    """What is programmed between the moves that lead in and out."""
    programmed = stretch.programmed
    return programmed.part(stretch.entry, len(programmed) - stretch.exit).path(stretch.plane)


def _judge_without_moves_above(run: ControlRun, stretch: Stretch, height: float) -> list[Judged]:
    """The verdicts on a stretch; where it gouges, without its moves at this height or higher if that leaves fewer
    gouges."""
    whole = _judge_stretch(run, stretch)
    if not any(result.verdict.gouges or result.verdict.wrong_side for result in whole):
        return whole
    parted = divided(run.moves, stretch, height)
    pieces = None if parted is None else _judge_pieces(run, stretch, parted)
    return whole if pieces is None or _count_gouges(pieces) >= _count_gouges(whole) else pieces


def _count_gouges(results: Sequence[Judged]) -> int:
    return sum(len(result.verdict.gouges) + len(result.verdict.wrong_side) for result in results)


def _judge_pieces(run: ControlRun, stretch: Stretch, parted: Divided) -> list[Judged]:
    """The verdicts on the pieces of a stretch, each with what it cuts of the others."""
    judged = [_judge_stretch(run, piece) for piece in parted.pieces]
    surfaces = {path_key(result.surface): result.surface for results in judged for result in results}
    contours = Contours.of(list(surfaces.values()))
    unjudged: list[Judged] = []
    for results in judged:
        own, center = {path_key(result.surface) for result in results}, results[0].center
        others = [contour for contour in contours.near(center, stretch.radius) if path_key(contour) not in own]
        more, unknown, slack = _cuts_of(run, stretch, center, others)
        results[0] = _with_gouges(results[0], more, slack, (*others, center))
        unjudged += unknown
    results = _with_unjudged([result for results in judged for result in results], unjudged)
    over = (*parted.links, *(lead for lead in parted.leads if _passes_over(run, stretch, lead, contours)))
    if over:
        lines = sorted({line for moves in over for line in moves.lines[1:].tolist()})
        lowest = min(float(moves.points[:, 2].min()) for moves in over)
        results[0] = replace(results[0], above=PassedOver(lowest, tuple(lines)))
    return results


def _passes_over(run: ControlRun, part: Stretch, lead: Moves, contours: Contours) -> bool:
    """Whether a lead would cut contours, were it as low as they are."""
    path = lead.path()
    return bool(_cuts_of(run, part, path, contours.near(path, part.radius))[0])


def _cuts_of(
    run: ControlRun, part: Stretch, center: Path, contours: Sequence[Path]
) -> tuple[list[Gouge], list[Judged], float]:
    """What a path cuts of contours, those of them that cannot be judged, and the tolerance that uneven arcs add."""
    gouges, unjudged, slack = list[Gouge](), list[Judged](), 0.0
    for contour in contours:
        accepted = _accepted_difference(run, contour, center)
        verdict = judge(contour, part.side, part.radius, center, accepted, leads=Leads.MOVES)
        if verdict.judged:
            gouges += verdict.gouges
            slack = max(slack, verdict.radius_slack)
        else:
            unjudged.append(Judged(part, contour, center, verdict, frozenset()))
    return gouges, unjudged, slack


def _with_gouges(result: Judged, more: Sequence[Gouge], slack: float, paths: Sequence[Path]) -> Judged:
    """The result with more gouges, and with the most uneven arc of these paths where that raises the tolerance."""
    if not result.verdict.judged:
        return result
    gouges = sorted((*result.verdict.gouges, *more), key=lambda gouge: -gouge.depth)
    if slack > (result.uneven.slack if result.uneven else 0.0):
        result = replace(result, uneven=_most_uneven(slack, *paths))
    return replace(result, verdict=replace(result.verdict, gouges=tuple(gouges)))


def _judge_stretch(run: ControlRun, stretch: Stretch) -> list[Judged]:
    """The verdicts on a stretch; where its side or radius changes, on each part with those that are in force there.

    A part may also cut the surface of another one: that counts where the tool runs on one side of all of them; where
    the side changes it is not judged, and a finding says so.
    """
    surface, parts = programmed_surface(stretch), stretch.parts()
    split = split_where_it_closes(surface) if len(parts) == 1 else SplitContours.of(surface)
    whole, contours, open_lines = split.path, split.contours, split.open_lines
    results, row = list[Judged](), 0
    unjudged: list[Judged] = []
    sides_change = any(part.side is not parts[0].side for part in parts)
    for part in parts:
        surface = programmed_surface(part) if len(parts) > 1 else whole
        begin, row = row, row + len(surface)
        inner = [(max(first, begin) - begin, min(last, row) - begin) for first, last in contours]
        inside = [first < last for first, last in inner]
        judgments = _judge_part(run, part, surface, list(compress(inner, inside)) or [(0, len(surface))])
        for index, rows in enumerate(compress(contours, inside)):
            judgments[index] = replace(judgments[index], open_lines=open_lines.pop(rows, frozenset()))
        if sides_change:
            judgments[0] = replace(judgments[0], by_itself=bool(results))
        elif len(parts) > 1:
            judgments[0], unknown = _with_other_parts(run, judgments[0], whole, contours, (begin, row))
            unjudged += unknown
        results += judgments
    return _with_unjudged(results, unjudged)


def _with_unjudged(results: list[Judged], unjudged: Sequence[Judged]) -> list[Judged]:
    """The results and those that are not judged for another reason than one of them."""
    reasons = {result.verdict.uneven_arc for result in results if not result.verdict.judged}
    more = {result.verdict.uneven_arc: result for result in unjudged if result.verdict.uneven_arc not in reasons}
    return [*results, *more.values()]


def _with_other_parts(
    run: ControlRun, result: Judged, whole: Path, contours: tuple[RowRange, ...], rows: RowRange
) -> tuple[Judged, list[Judged]]:
    """With what is cut of all contours outside the part's rows, and those of them that cannot be judged.

    A subprogram's lines may be in several parts.
    """
    part, numbered = result.stretch, replace(whole, numbers=np.arange(len(whole), dtype=np.float64))
    accepted = _accepted_difference(run, whole, result.center)
    more, unjudged, slack = list[Gouge](), list[Judged](), 0.0
    for first, last in contours:
        edges = np.clip((first, *rows, last), first, last).tolist()
        # each by itself, for a pass of another part is no repetition of one of this part
        surface = joined([without_repeats(numbered.part(*both)) for both in pairwise(edges)])
        verdict = judge(surface, part.side, part.radius, result.center, accepted)
        if not verdict.judged:
            unjudged.append(Judged(part, surface, result.center, _numbered(verdict, whole), frozenset()))
            continue
        slack = max(slack, verdict.radius_slack)
        others = [gouge for gouge in verdict.gouges if not rows[0] <= gouge.surface_number < rows[1]]
        more += (replace(gouge, surface_number=float(whole.numbers[int(gouge.surface_number)])) for gouge in others)
    return _with_gouges(result, more, slack, (whole, result.center)), unjudged


def _numbered(verdict: Verdict, surface: Path) -> Verdict:
    """The verdict with the number of an uneven arc of the surface instead of its row."""
    arc = verdict.uneven_arc
    if arc is None or not arc.on_surface:
        return verdict
    return replace(verdict, uneven_arc=replace(arc, number=float(surface.numbers[int(arc.number)])))


def _judge_part(run: ControlRun, stretch: Stretch, whole: Path, contours: Sequence[RowRange]) -> list[Judged]:
    """The verdict on each contour among moves of one side and radius; the first of them has the leads."""
    center = _center_path(run, stretch)
    accepted = _accepted_difference(run, whole, center)
    results = [_judge_contour(stretch, whole.part(*rows), center, accepted, len(contours)) for rows in contours]
    slack = max(result.verdict.radius_slack for result in results)
    results[0] = replace(results[0], uneven=_most_uneven(slack, whole, center))
    inside = np.zeros(len(whole), np.bool_)
    for first, last in contours:
        inside[first:last] = True
    leads = whole.numbers[~inside].tolist()
    if leads:
        surface = without_repeats(whole)
        long = has_long_leads(whole, tuple(contours))
        ends = Leads.NONE if long else Leads.SEGMENTS
        verdict = judge(surface, stretch.side, stretch.radius, center, accepted, leads=ends)
        gouges = verdict.gouges if verdict.judged else ()
        doubtful = set(leads) - {float(whole.numbers[row]) for row in blend_leads(whole, tuple(contours))}
        lead_gouges = tuple(gouge for gouge in gouges if gouge.surface_number in doubtful)
        results[0] = replace(
            results[0],
            leads=tuple(dict.fromkeys(map(int, leads))),
            long_leads=long,
            corner_leads=leads_at_corner(whole, tuple(contours)),
            lead_gouges=lead_gouges,
            lead_slack=verdict.radius_slack,
        )
        if not verdict.judged:
            results = _with_unjudged(results, [Judged(stretch, surface, center, verdict, frozenset())])
    return results


def _center_path(run: ControlRun, stretch: Stretch) -> Path:
    """The tool's center, each pass once; where it only stands, a line of no length."""
    moves = run.moves.part(stretch.first, stretch.last)
    center = without_repeats(moves.path(stretch.plane))
    if len(center) or not len(moves):
        return center
    point = moves.points[-1:, list(stretch.plane.axes[:2])]
    return Path.of(np.repeat(point, 2, axis=0), point, np.zeros(1, np.int8), np.array([float(moves.lines[-1])]))


def _judge_contour(stretch: Stretch, contour: Path, center: Path, accepted: float, contours: int) -> Judged:
    """The verdict on one contour with the whole center path: what runs along another one is on neither side of this."""
    lines = frozenset(contour.numbers.tolist())
    surface, loops = without_corner_loops(without_repeats(contour), stretch.side)
    leads = Leads.MOVES if contours == 1 else Leads.SEGMENTS
    verdict = judge(surface, stretch.side, stretch.radius, center, accepted, leads=leads)
    if stretch.radius <= GOUGE or contours > 1:
        # a center on the contour itself is on neither side of it, whatever its leads cross; a later offset may not be 0
        verdict = replace(verdict, wrong_side=tuple(row for row in verdict.wrong_side if center.numbers[row] in lines))
    return Judged(stretch, surface, center, verdict, lines, loops=loops)


def _accepted_difference(run: ControlRun, *paths: Path) -> float:
    """Millimeters by which the control that made this run lets the radii of an arc of this size differ."""
    radii = [float(path.radii[path.turns != 0].max(initial=0.0)) for path in paths]
    return max(ARC_RADII, arc_tolerance(run.control).largest_difference(max(radii), run.unit) + GOUGE)


def _most_uneven(slack: float, *paths: Path) -> ToleratedArc | None:
    """The arc of these paths whose radii differ most, None where they add no more tolerance than ARC_RADII."""
    worst, difference = None, ARC_RADII if slack <= ARC_RADII else ON_PATH
    for path in paths:
        arms = path.ends - path.centers
        first, last = path.radii, np.hypot(arms[:, 0], arms[:, 1])
        apart = np.where(path.turns != 0, np.abs(last - first), 0.0)
        row = int(apart.argmax()) if len(apart) else 0
        if len(apart) and apart[row] > difference:
            line, difference = _line(path.numbers[row]), apart[row]
            worst = ToleratedArc(float(first[row]), float(last[row]), line, slack)
    return worst


def judged_findings(results: tuple[Judged, ...]) -> tuple[Finding, ...]:
    """The verdicts as findings with lines: gouges and the wrong side are errors, the rest is a warning."""
    gouged = {gouge.surface_number for result in results for gouge in result.verdict.gouges}
    uneven = _uneven_arcs(results)
    return (
        _unseen(results)
        + _rapid_walls(results)
        + tuple(
            _with_axes(finding, result.stretch.plane)
            for result in results
            for finding in (
                *_by_itself(result),
                *_above(result),
                *_uneven_arc(uneven.get(result)),
                *_cuts(result),
                *_open_contour(result, gouged),
                *_leads(result),
                *_corner_loops(result),
                *_contact(result),
                *_uncut(result),
                *_crossing(result),
                *_uncompensated(result),
                *_cuts_of_others(result),
            )
        )
    )


def _with_axes(finding: Finding, plane: Plane) -> Finding:
    """The finding with the names of a plane's axes."""
    first, second, _ = ("XYZ"[axis] for axis in plane.axes)
    return replace(finding, text=finding.text.replace("X {x} Y {y}", f"{first} {{x}} {second} {{y}}"))


def _unseen(results: tuple[Judged, ...]) -> tuple[Finding, ...]:
    """Once, that some gouges are too shallow for a digit."""
    count = sum(result.unseen_gouges for result in results)
    if not count:
        return ()
    gouges = "1 gouge is" if count == 1 else f"{count} gouges are"
    text = f"{gouges} less than half the last digit that a control shows (0.00005 in, 0.0005 mm) and not counted."
    return (Finding("DIGIT", Severity.INFO, text),)


def deepest_gouge(results: tuple[Judged, ...]) -> tuple[float, int | None]:
    """The deepest gouge of a run in millimeters with its line; 0 and None if there is none, None for a line unknown."""
    gouges = [gouge for result in results for gouge in result.verdict.gouges]
    deepest = max(gouges, key=lambda gouge: gouge.depth, default=None)
    return (deepest.depth, _line(deepest.path_number)) if deepest else (0.0, None)


def first_unjudged(results: tuple[Judged, ...]) -> tuple[bool, int | None]:
    """Whether a contour of a run cannot be judged, and the line of the first one."""
    result = next((result for result in results if not result.verdict.judged), None)
    return result is not None, None if result is None else _first_line(result.center)


def _line(number: float) -> int | None:
    """The program's line that a piece of a path has as its number; 0 is a move that belongs to no line."""
    return int(number) or None


def _first_line(path: Path) -> int | None:
    return _line(path.numbers[0]) if len(path) else None


def _by_itself(result: Judged) -> Iterator[Finding]:
    """Says that a part is judged by itself."""
    text = "The side changes here. Cuts into the contour on the other side are not judged. Program G40 between them."
    if result.by_itself:
        yield Finding("SIDES", Severity.WARNING, text, line=_first_line(result.surface))


def _uncompensated(result: Judged) -> Iterator[Finding]:
    """Moves without compensation through a contour: a warning, for what stood there may be cut away by then."""
    for cut in result.uncompensated:
        code, move = ("RAPID", "rapid") if cut.rapid else ("FEED", "move without compensation")
        at, line = cut.gouge.surface_at, _line(cut.gouge.path_number)
        text = (
            f"This {move} at Z {{0}} cuts the contour of line {int(cut.gouge.surface_number)} at X {{x}} Y {{y}}. "
            "Raise the tool before it."
        )
        yield Finding(code, Severity.WARNING, text, at=at, value=cut.gouge.depth, lengths=(cut.height,), line=line)


def _cuts_of_others(result: Judged) -> Iterator[Finding]:
    """Cuts into the contours of other stretches: warnings, for a wall may be meant to be cut, as by a slot."""
    deepest = sorted(result.of_others, key=lambda cut: -cut.gouge.depth)
    for cut in deepest[:MAX_GOUGES]:
        into = (
            f"the contour of line {int(cut.gouge.surface_number)} at X {{x}} Y {{y}}. Check that this wall may be cut."
        )
        text = f"The cutter runs through {into}" if cut.through else f"The cutter cuts {{value}} into {into}"
        at, line = cut.gouge.surface_at, _line(cut.gouge.path_number)
        yield Finding("OTHER-CONTOUR", Severity.WARNING, text, at=at, value=cut.gouge.depth, line=line)
    if len(deepest) > MAX_GOUGES:
        text = f"Other paths cut {len(deepest) - MAX_GOUGES} more contours, none deeper."
        yield Finding("OTHER-CONTOUR", Severity.WARNING, text)


def _rapid_walls(results: Sequence[Judged]) -> tuple[Finding, ...]:
    """Rapids under compensation at the depth of the cut, once a line."""
    moves = {move.line: move for result in results for move in rapid_walls(result.stretch)}
    text = "This rapid under compensation runs at the depth of the cut, Z {0}. Write G1, or raise the tool before it."
    return tuple(
        Finding("RAPID", Severity.WARNING, text, lengths=(move.point[2],), line=_line(line))
        for line, move in sorted(moves.items())
    )


def _above(result: Judged) -> Iterator[Finding]:
    """Says that moves above the part pass over it and are not judged: no program says how high it is."""
    above = result.above
    if above is None:
        return
    listed = ", ".join(map(str, above.lines[:MAX_LINES])) + (" ..." if len(above.lines) > MAX_LINES else "")
    which = f"line {listed}" if len(above.lines) == 1 else f"lines {listed}"
    text = f"The tool passes over the part at Z {{0}} or higher ({which}). Check that it clears part and clamps."
    yield Finding("ABOVE", Severity.WARNING, text, lengths=(above.height,), line=above.lines[0])


def _uneven_arcs(results: Sequence[Judged]) -> dict[Judged, ToleratedArc]:
    """The uneven arcs of judged parts that raise the tolerance, each line once, where it does so most."""
    uneven = [(result, result.uneven) for result in results if result.uneven and result.verdict.judged]
    uneven.sort(key=lambda pair: pair[1].slack)
    return dict({arc.line: (result, arc) for result, arc in uneven if arc.slack > 0.0}.values())


def _uneven_arc(arc: ToleratedArc | None) -> list[Finding]:
    """Says that an arc has two radii, which the control accepts, and how it is judged; warns beyond CAM_ROUNDING."""
    if arc is None:
        return []
    text = "Arc radius {0} at its start, {1} at its end: judged at a radius between them, with {value} extra tolerance."
    severity = Severity.WARNING if arc.slack > CAM_ROUNDING else Severity.INFO
    return [Finding("ARC_RADII", severity, text, value=arc.slack, lengths=(arc.first, arc.last), line=arc.line)]


def _cuts(result: Judged) -> list[Finding]:
    verdict = result.verdict
    if not verdict.judged:
        return [_unjudged(result)]
    listed = [_gouge(gouge, verdict.radius) for gouge in verdict.gouges[:MAX_GOUGES]]
    left = len(verdict.gouges) - len(listed)
    if left:
        listed.append(Finding("GOUGE", Severity.ERROR, f"{left} more gouges, none deeper."))
    if verdict.wrong_side:
        line = _line(result.center.numbers[verdict.wrong_side[0]])
        text = "The cutter is on the wrong side of the contour at this line."
        if 2 * len(verdict.wrong_side) > len(result.center):
            text = "The cutter is on the wrong side. Swap G41 and G42 (RL and RR)."
        listed.append(Finding("WRONG-SIDE", Severity.ERROR, text, line=line))
    return listed


def _unjudged(result: Judged) -> Finding:
    """Why nothing is known of a path."""
    arc, line = result.verdict.uneven_arc, _first_line(result.center)
    if arc is None:
        text = "Not judged: a coordinate or the tool radius is too large for any machine."
        return Finding("UNJUDGED", Severity.ERROR, text, line=line)
    text = "Not judged: the radii of this arc differ by {value}. Correct its center or end point."
    if np.isinf(arc.difference):
        text = "Not judged: this arc may be empty or a full circle. Correct its center or end point."
    return Finding("UNJUDGED", Severity.ERROR, text, value=arc.difference, line=_line(arc.number) or line)


def _gouge(gouge: Gouge, radius: float) -> Finding:
    fine = gouge.depth < SHOWN
    depth = "less than {0}" if fine else "{value}" + or_more(gouge, radius)
    text = f"The cutter gouges the surface of line {int(gouge.surface_number)} by {depth} at X {{x}} Y {{y}}."
    line = _line(gouge.path_number)
    return Finding(
        "GOUGE",
        Severity.ERROR,
        text,
        at=gouge.surface_at,
        value=gouge.depth,
        lengths=(DIGIT,) if fine else (),
        line=line,
    )


def _open_contour(result: Judged, gouged: set[float]) -> list[Finding]:
    """That gouged lines may be no surface at all: nothing in a program says where a contour begins."""
    if not gouged & result.open_lines:
        return []
    first, last = int(min(result.open_lines)), int(max(result.open_lines))
    text = (
        f"Lines {first}-{last} are treated as a contour because they are more than {MAX_LEAD_MOVES} moves. If they "
        f"only connect contours, cancel compensation before them or use at most {MAX_LEAD_MOVES} moves."
    )
    return [Finding("WAY", Severity.WARNING, text, line=first)]


def _leads(result: Judged) -> Iterator[Finding]:
    """Says that moves are treated as leads, and what is cut of them."""
    if not result.leads:
        return
    text = f"{len(result.leads)} moves before or after a closed contour are treated as lead moves, not part."
    check = "They are long. Check that none of them is a wall."
    if len(result.leads) == 1:
        text = "A move before or after a closed contour is treated as a lead move, not part."
        check = "It is long. Check that it is no wall."
    severity = Severity.INFO
    if result.long_leads:
        severity, text = Severity.WARNING, f"{text} {check}"
    yield Finding("LEADS", severity, text, line=result.leads[0])
    deepest = {gouge.surface_number: gouge for gouge in reversed(result.lead_gouges)}
    for gouge in sorted(deepest.values(), key=lambda gouge: -gouge.depth):
        text = f"The cutter cuts {{value}} into line {int(gouge.surface_number)}. If this is not a lead, it is a gouge."
        slack = (result.lead_slack,) if result.lead_slack > 0.0 else ()
        text += " It is judged with {0} extra tolerance." if slack else ""
        line, at = _line(gouge.path_number), gouge.surface_at
        severity = Severity.WARNING if result.corner_leads else severity
        yield Finding("LEAD-GOUGE", severity, text, at=at, value=gouge.depth, lengths=slack, line=line)


def _corner_loops(result: Judged) -> Iterator[Finding]:
    """Says that a contour crosses itself to go around an outside corner."""
    for loop in result.loops:
        lines = enumerated("line", loop.numbers)
        text = f"Loop around the corner X {{x}} Y {{y}}: what lies beyond it on {lines} is no wall."
        severity = Severity.INFO
        if loop.long:
            severity, text = Severity.WARNING, f"{text} It is long. Check that none of it is a wall."
        yield Finding("CORNER-LOOP", severity, text, at=loop.at, line=_line(loop.numbers[0]))


def _contact(result: Judged) -> list[Finding]:
    """Moves between the leads that leave the surface by more than the radius, or run against it.

    Some controls leave it at every corner: several such places are one finding.
    """
    numbers, lines = result.center.numbers, result.lines
    against = tuple(row for row in result.verdict.backwards if numbers[row] in lines)
    away: tuple[AirCut, ...] = ()
    if any(numbers[row] in lines for row in result.verdict.loose):
        cuts = air_cuts(result.surface, result.stretch.radius, result.center)
        away = tuple(cut for cut in cuts if _between_leads(cut, result.center, lines))
    begun = [*(int(numbers[row]) for row in against[:1]), *(int(cut.first_number) for cut in away)]
    listed = contact_findings(away, against)
    told = [replace(finding, segment=None, line=line) for finding, line in zip(listed, begun, strict=True)]
    return told if len(away) < 2 else [*told[: -len(away)], _several(told[-len(away) :])]


def _several(away: Sequence[Finding]) -> Finding:
    """Several places where a path cuts air, at the one that is farthest off the part."""
    lines = list(dict.fromkeys(str(finding.line) for finding in away))
    more = " ..." if len(lines) > MAX_LINES else ""
    text = f"The path cuts air at {len(away)} places (lines {', '.join(lines[:MAX_LINES])}{more}), "
    text += "at most {0} off the part, at X {x} Y {y}."
    return replace(max(away, key=lambda finding: finding.lengths), text=text)


def _between_leads(away: AirCut, center: Path, lines: frozenset[float]) -> bool:
    """Leads are at a path's two ends, or have lines of their own."""
    ends = {tuple(center.points[0].tolist()), tuple(center.points[-1].tolist())}
    return {away.first_number, away.last_number} <= lines and not ends & {away.start, away.end}


def _uncut(result: Judged) -> list[Finding]:
    verdict = result.verdict
    if not verdict.judged or not verdict.uncut:
        return []
    worst = max(verdict.uncut, key=lambda stretch: stretch.thickness)
    fine = worst.thickness < SHOWN
    thick = "less than {2}" if fine else "at most {value}"
    text = f"{{0}} of {{1}} of the surface stays uncut, {thick} thick at X {{x}} Y {{y}}."
    lengths = (verdict.uncut_length, verdict.surface_length, *((DIGIT,) if fine else ()))
    line, at = int(worst.first_number), worst.thickest
    return [Finding("UNCUT", Severity.WARNING, text, at=at, value=worst.thickness, lengths=lengths, line=line)]


def _crossing(result: Judged) -> list[Finding]:
    """Says that the contour's ends run past its corner, or that it crosses itself."""
    verdict, line = result.verdict, _first_line(result.surface)
    if verdict.over_run is not None:
        return [_over_run(verdict.over_run, result.surface)]
    if not verdict.crosses_itself:
        return []
    place = " at X {x} Y {y}" if verdict.crossing_at else ""
    text = f"The programmed contour crosses or touches itself{place}. All of it counts as surface."
    return [Finding("CROSSES", Severity.WARNING, text, at=verdict.crossing_at, line=line)]


def _over_run(over_run: OverRun, surface: Path) -> Finding:
    """Says that the contour's ends are leads; a warning where the first or the last point may be wrong."""
    if not over_run.doubtful and over_run.lead_numbers:
        which = enumerated("line", over_run.lead_numbers)
        text = f"Over-run at X {{x}} Y {{y}}. Taken for lead beyond it: {which}. Check that no wall is cut there."
        return Finding("OVER_RUN", Severity.WARNING, text, at=over_run.at, line=_line(over_run.lead_numbers[0]))
    if not over_run.doubtful:
        text = "Over-run at X {x} Y {y}: the ends are lead-in and lead-out."
        return Finding("OVER_RUN", Severity.INFO, text, at=over_run.at, line=_first_line(surface))
    length, line = max(over_run.lead_in, over_run.lead_out), _line(over_run.last_number)
    text = "The contour begins on this line; {value} behind that is taken for lead-out. Check where it begins."
    if over_run.lead_in > over_run.lead_out:
        line = _line(over_run.first_number)
        text = "The contour ends on this line; {value} before that is taken for lead-in. Check where it ends."
    return Finding("OVER_RUN", Severity.WARNING, text, at=over_run.at, value=length, line=line)
