"""What a control's path does to the contour that the program describes, by the program's lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import compress, pairwise
from typing import Final

import numpy as np

from core.controls.contours_and_leads import MAX_LEAD_MOVES, Rows, contours_of, open_contours
from core.controls.control_run import Run, Stretch
from core.controls.repeated_passes import without_repeats
from core.finding import Finding, Severity
from core.geometry.path import Path, joined
from core.tolerance import GOUGE
from core.verify.contact import AirCut, air_cuts
from core.verify.judge import judge
from core.verify.report import contact_findings, or_more
from core.verify.verdict import Gouge, Verdict

MAX_GOUGES: Final = 20
"""Gouges of a stretch that are told one by one, deepest first."""

GIVEN_UP: Final = "LIMIT"
"""The rule by which a run ends that repeats too much to be followed."""

FINE: Final = 0.001
"""Millimeters under which a gouge's depth cannot be shown in digits."""


@dataclass(frozen=True, eq=False, slots=True)
class Judged:
    """A compensated stretch, the surface it cuts, the center path with its leads, and the verdict on them.

    Surface and center path are without the laps that they repeat, each by itself; `lines` are those of the whole
    surface, since of two laps written out the one may be kept of the surface and the other of the path.
    `leads` are programmed moves taken for leads because a closed contour begins behind them or ends before them, and
    `lead_gouges` what is cut of them: they may be surface after all.  `alone`: the side changed where it begins, and
    what is cut on the other side is not asked about.  `way`: the lines of all of an open contour beside closed ones, of
    which this is the first part.
    """

    stretch: Stretch
    surface: Path
    center: Path
    verdict: Verdict
    lines: frozenset[float]
    leads: tuple[int, ...] = ()
    lead_gouges: tuple[Gouge, ...] = ()
    alone: bool = False
    way: frozenset[float] = frozenset()


def judged(run: Run) -> tuple[Judged, ...]:
    """The verdict on every compensated stretch of a run, in its own plane; paths are numbered by lines.

    There is none on a run that was given up as endless: it says so itself, and the same moves a thousand times over
    would be judged against one another.
    """
    if any(finding.code == GIVEN_UP for finding in run.findings):
        return ()
    return tuple(result for stretch in run.stretches for result in _each(run, stretch))


def surface_of(stretch: Stretch) -> Path:
    """What is programmed between the moves that lead in and out."""
    programmed = stretch.programmed
    return programmed.part(stretch.entry, len(programmed) - stretch.exit).path(stretch.plane)


def _each(run: Run, stretch: Stretch) -> list[Judged]:
    """The verdicts on a stretch; where its side or radius changes, on each part with those that are in force there.

    A part may also cut the surface of another one: that counts where the tool runs on one side of all of them; where
    the side changes it is not asked for, which is told.
    """
    whole = surface_of(stretch)
    contours = contours_of(whole)
    untold = open_contours(whole, contours)
    parts, results, row = stretch.parts(), list[Judged](), 0
    sides = any(part.side is not parts[0].side for part in parts)
    for part in parts:
        own = surface_of(part)
        begin, row = row, row + len(own)
        inner = [(max(first, begin) - begin, min(last, row) - begin) for first, last in contours]
        held = [both[0] < both[1] for both in inner]
        told = _judged(run, part, own, list(compress(inner, held)) or [(0, len(own))])
        for place, rows in enumerate(compress(contours, held)):
            told[place] = replace(told[place], way=untold.pop(rows, frozenset()))
        if sides:
            told[0] = replace(told[0], alone=bool(results))
        elif len(parts) > 1:
            told[0] = _beyond(told[0], whole, contours, (begin, row))
        results += told
    return results


def _beyond(result: Judged, whole: Path, contours: tuple[Rows, ...], own: Rows) -> Judged:
    """With what is cut of all contours besides the part's own rows; a subprogram's lines may be in several."""
    part, numbered = result.stretch, replace(whole, numbers=np.arange(len(whole), dtype=np.float64))
    more: list[Gouge] = []
    for first, last in contours:
        edges = np.clip((first, *own, last), first, last).tolist()
        # each by itself, for a lap of another part is no repetition of the part's own one
        surface = joined([without_repeats(numbered.part(*both)) for both in pairwise(edges)])
        cut = judge(surface, part.side, part.radius, result.center).gouges
        others = [(gouge, int(gouge.surface_number)) for gouge in cut if not own[0] <= gouge.surface_number < own[1]]
        more += (replace(gouge, surface_number=float(whole.numbers[at])) for gouge, at in others)
    gouges = sorted((*result.verdict.gouges, *more), key=lambda gouge: -gouge.depth)
    return replace(result, verdict=replace(result.verdict, gouges=tuple(gouges)))


def _judged(run: Run, stretch: Stretch, whole: Path, contours: Sequence[Rows]) -> list[Judged]:
    """The verdict on each contour among moves of one side and radius; the first of them has what is said of leads."""
    center = without_repeats(run.moves.part(stretch.first, stretch.last).path(stretch.plane))
    results = [_contour(stretch, whole.part(*rows), center, alone=len(contours) == 1) for rows in contours]
    inside = np.zeros(len(whole), np.bool_)
    for first, last in contours:
        inside[first:last] = True
    leads = whole.numbers[~inside].tolist()
    if leads:
        cut = judge(without_repeats(whole), stretch.side, stretch.radius, center).gouges
        cut_leads = tuple(gouge for gouge in cut if gouge.surface_number in leads)
        results[0] = replace(results[0], leads=tuple(map(int, leads)), lead_gouges=cut_leads)
    return results


def _contour(stretch: Stretch, contour: Path, center: Path, *, alone: bool) -> Judged:
    """The verdict on one contour with the whole center path: what runs along another one is on neither side of this."""
    surface, lines = without_repeats(contour), frozenset(contour.numbers.tolist())
    verdict = judge(surface, stretch.side, stretch.radius, center)
    if stretch.radius <= GOUGE or not alone:
        # a center on the contour itself is on neither side of it, whatever its leads cross; a later offset may not be 0
        verdict = replace(verdict, wrong_side=tuple(row for row in verdict.wrong_side if center.numbers[row] in lines))
    return Judged(stretch, surface, center, verdict, lines)


def findings(results: tuple[Judged, ...]) -> tuple[Finding, ...]:
    """The verdicts as findings with lines: gouges and the wrong side are errors, the rest is a warning."""
    gouged = {gouge.surface_number for result in results for gouge in result.verdict.gouges}
    return tuple(
        finding
        for result in results
        for finding in (
            *_alone(result),
            *_cuts(result),
            *_way(result, gouged),
            *_leads(result),
            *_strays(result),
            *_rest(result),
        )
    )


def deepest_gouge(results: tuple[Judged, ...]) -> tuple[float, int | None]:
    """The deepest gouge of a run in millimeters with its line; 0 and None if there is none, None for a line unknown."""
    gouges = [gouge for result in results for gouge in result.verdict.gouges]
    deepest = max(gouges, key=lambda gouge: gouge.depth, default=None)
    return (deepest.depth, _line(deepest.path_number)) if deepest else (0.0, None)


def first_unjudged(results: tuple[Judged, ...]) -> tuple[bool, int | None]:
    """Whether a contour of a run cannot be judged, and the line of the first one."""
    result = next((result for result in results if not result.verdict.judged), None)
    line = _line(result.center.numbers[0]) if result is not None and len(result.center) else None
    return result is not None, line


def _line(number: float) -> int | None:
    """The program's line that a piece of a path has as its number; 0 is a move that stands in no line."""
    return int(number) or None


def _cuts(result: Judged) -> list[Finding]:
    verdict = result.verdict
    if not verdict.judged:
        line = _line(result.center.numbers[0]) if len(result.center) else None
        text = "Not judged: a coordinate or the tool radius is too large, or the radii of an arc differ."
        return [Finding("UNJUDGED", Severity.ERROR, text, line=line)]
    found = [_gouge(gouge, verdict.radius) for gouge in verdict.gouges[:MAX_GOUGES]]
    left = len(verdict.gouges) - len(found)
    if left:
        found.append(Finding("GOUGE", Severity.ERROR, f"There are {left} more gouges, none of them deeper."))
    if verdict.wrong_side:
        line = _line(result.center.numbers[verdict.wrong_side[0]])
        text = "The cutter runs on the wrong side of the contour here."
        if 2 * len(verdict.wrong_side) > len(result.center):
            text = "The cutter runs on the wrong side of the contour; exchange G41 and G42, or RL and RR."
        found.append(Finding("WRONG-SIDE", Severity.ERROR, text, line=line))
    return found


def _alone(result: Judged) -> list[Finding]:
    """That a part is judged by itself."""
    if not result.alone:
        return []
    text = (
        "The side changes here, and each part is judged by its own side alone: whether the cutter gouges here what it "
        "cuts on the other side, or there what it cuts here, is not judged; write G40 between them to be sure."
    )
    line = int(result.surface.numbers[0]) if len(result.surface) else None
    return [Finding("SIDES", Severity.WARNING, text, line=line)]


def _way(result: Judged, gouged: set[float]) -> list[Finding]:
    """That gouged lines may be no surface at all: nothing in a program says where a contour begins."""
    if not gouged & result.way:
        return []
    first, last = int(min(result.way)), int(max(result.way))
    text = (
        f"Lines {first} to {last}, more than {MAX_LEAD_MOVES} moves beside a closed contour, are taken for a contour "
        "of their own, and what the cutter cuts into them for a gouge; if they only lead from one contour to another, "
        f"cancel the compensation before them, or lead there in {MAX_LEAD_MOVES} moves."
    )
    return [Finding("WAY", Severity.WARNING, text, line=first)]


def _leads(result: Judged) -> list[Finding]:
    """That moves are taken for leads, and what is cut of them."""
    if not result.leads:
        return []
    text = f"{len(result.leads)} moves before or behind a closed contour are taken for leads, not for surface."
    if len(result.leads) == 1:
        text = "A move before or behind a closed contour is taken for a lead, not for surface."
    found = [Finding("LEADS", Severity.INFO, text, line=result.leads[0])]
    deepest = {gouge.surface_number: gouge for gouge in reversed(result.lead_gouges)}
    for gouge in sorted(deepest.values(), key=lambda one: -one.depth):
        text = f"The cutter cuts {{value}} into line {int(gouge.surface_number)}; if that is no lead, it is a gouge."
        line = _line(gouge.path_number)
        found.append(Finding("LEAD-GOUGE", Severity.INFO, text, at=gouge.surface_at, value=gouge.depth, line=line))
    return found


def _strays(result: Judged) -> list[Finding]:
    """Moves between the leads that leave the surface by more than the radius, or run against it."""
    numbers, lines = result.center.numbers, result.lines
    against = tuple(row for row in result.verdict.backwards if numbers[row] in lines)
    away: tuple[AirCut, ...] = ()
    if any(numbers[row] in lines for row in result.verdict.loose):
        found = air_cuts(result.surface, result.stretch.radius, result.center)
        away = tuple(one for one in found if _between_leads(one, result.center, lines))
    told = contact_findings(away, against)
    begun = [*(int(numbers[row]) for row in against[:1]), *(int(one.first_number) for one in away)]
    return [replace(finding, segment=None, line=line) for finding, line in zip(told, begun, strict=True)]


def _between_leads(away: AirCut, center: Path, lines: frozenset[float]) -> bool:
    """Leads are at a path's two ends, or have lines of their own."""
    ends = {tuple(center.points[0].tolist()), tuple(center.points[-1].tolist())}
    return {away.first_number, away.last_number} <= lines and not ends & {away.start, away.end}


def _gouge(gouge: Gouge, radius: float) -> Finding:
    much = "{value}" + or_more(gouge, radius) if gouge.depth > FINE else "less than a thousandth of a millimeter"
    text = f"The cutter gouges the surface of line {int(gouge.surface_number)} by {much} at X {{x}} Y {{y}}."
    line = _line(gouge.path_number)
    return Finding("GOUGE", Severity.ERROR, text, at=gouge.surface_at, value=gouge.depth, line=line)


def _rest(result: Judged) -> list[Finding]:
    verdict, found = result.verdict, []
    if verdict.judged and verdict.uncut:
        worst = max(verdict.uncut, key=lambda stretch: stretch.thickness)
        text = "{0} of {1} of the surface stays uncut, at most {value} thick at X {x} Y {y}."
        lengths = (verdict.uncut_length, verdict.surface_length)
        line = int(worst.first_number)
        place, thick = worst.thickest, worst.thickness
        found.append(
            Finding("UNCUT", Severity.WARNING, text, at=place, value=thick, lengths=lengths, line=line),
        )
    if verdict.crosses_itself:
        at = verdict.crossing_at
        where = " at X {x} Y {y}" if at else ""
        text = f"The programmed contour crosses or touches itself{where}; the verdict counts all of it as surface."
        began = int(result.surface.numbers[0]) if len(result.surface) else None
        found.append(Finding("CROSSES", Severity.WARNING, text, at=at, line=began))
    return found
