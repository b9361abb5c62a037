"""What a control's path does to the contour that the program describes, by the program's lines."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final

import numpy as np

from core.controls.laps import unlapped
from core.controls.report import Run, Stretch
from core.finding import Finding, Severity
from core.geometry.path import Path, joined
from core.tolerance import CLOSED, GOUGE
from core.verify.judge import judge
from core.verify.report import stray_findings
from core.verify.stray import Away, Stray, stray
from core.verify.verdict import Gouge, Verdict

MOST_GOUGES: Final = 20
"""Gouges of a stretch that are told one by one, deepest first."""

GIVEN_UP: Final = "LIMIT"
"""The rule by which a run ends that repeats too much to be followed."""

FINE: Final = 0.001
"""Millimetres under which a gouge's depth cannot be shown in digits."""


@dataclass(frozen=True, eq=False, slots=True)
class Judged:
    """A compensated stretch, the surface it cuts, the centre path with its leads, and the verdict on them.

    Surface and centre path are without the laps that they repeat, each by itself; `lines` are those of the whole
    surface, since of two laps written out the one may be kept of the surface and the other of the path.
    `leads` are programmed moves taken for leads because a closed contour begins behind them or ends before them, and
    `lead_gouges` what is cut of them: they may be surface after all.  `alone`: the side changed where it begins, and
    what is cut on the other side is not asked about.
    """

    stretch: Stretch
    surface: Path
    centre: Path
    verdict: Verdict
    lines: frozenset[float]
    leads: tuple[int, ...] = ()
    lead_gouges: tuple[Gouge, ...] = ()
    alone: bool = False


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
    """The verdict on a stretch; where its side or radius changes, on each part with those that are in force there.

    A part may also cut the surface of another one: that counts where the tool runs on one side of all of them; where
    the side changes it is not asked for, which is told.
    """
    whole = surface_of(stretch)
    first, last = closed_part(whole)
    parts, results, row = stretch.parts(), list[Judged](), 0
    for part in parts:
        own = surface_of(part)
        begin, end = max(first - row, 0), min(last - row, len(own))
        row += len(own)
        result = _judged(run, part, own, (begin, end) if begin < end else (0, len(own)))
        if any(one.side is not part.side for one in parts):
            result = replace(result, alone=bool(results))
        elif len(parts) > 1:
            result = _beyond(result, whole.part(first, last), row - len(own) - first, row - first)
        results.append(result)
    return results


def _beyond(result: Judged, whole: Path, begin: int, end: int) -> Judged:
    """With what is cut of the whole surface besides the part's own rows; a subprogram's lines may be in several."""
    part, rows = result.stretch, np.arange(len(whole), dtype=np.float64)
    surface = replace(whole, numbers=rows)
    edges = np.clip((0, begin, end, len(whole)), 0, len(whole)).tolist()
    # each by itself, for a lap of another part is no repetition of the part's own one
    surface = joined([unlapped(surface.part(*both)) for both in pairwise(edges)])
    cut = judge(surface, part.side, part.radius, result.centre).gouges
    others = [(gouge, int(gouge.surface_number)) for gouge in cut if not begin <= gouge.surface_number < end]
    more = (replace(gouge, surface_number=float(whole.numbers[at])) for gouge, at in others)
    gouges = sorted((*result.verdict.gouges, *more), key=lambda gouge: -gouge.depth)
    return replace(result, verdict=replace(result.verdict, gouges=tuple(gouges)))


def _judged(run: Run, stretch: Stretch, whole: Path, contour: tuple[int, int]) -> Judged:
    """The verdict on moves of one side and radius, of which a part of the surface is contour and the rest leads."""
    first, last = contour
    surface, lines = unlapped(whole.part(first, last)), frozenset(whole.numbers[first:last].tolist())
    centre = unlapped(run.moves.part(stretch.first, stretch.last).path(stretch.plane))
    verdict = judge(surface, stretch.side, stretch.radius, centre)
    if stretch.radius <= GOUGE:
        # a centre on the contour itself is on neither side of it, whatever its leads cross; a later offset may not be 0
        verdict = replace(verdict, wrong_side=tuple(row for row in verdict.wrong_side if centre.numbers[row] in lines))
    leads = (*whole.numbers[:first].tolist(), *whole.numbers[last:].tolist())
    if not leads:
        return Judged(stretch, surface, centre, verdict, lines)
    cut = judge(unlapped(whole), stretch.side, stretch.radius, centre).gouges
    cut_leads = tuple(gouge for gouge in cut if gouge.surface_number in leads)
    return Judged(stretch, surface, centre, verdict, lines, tuple(int(line) for line in leads), cut_leads)


def closed_part(path: Path) -> tuple[int, int]:
    """The longest run of pieces that ends where it begins, as first and one behind the last; all if there is none."""
    first_seen: dict[tuple[float, float], int] = {}
    best = (0, 0)
    for index, (x, y) in enumerate(np.round(path.points / CLOSED).tolist()):
        begin = first_seen.setdefault((x, y), index)
        if index - begin > best[1] - best[0]:
            best = (begin, index)
    return best if best[1] else (0, len(path))


def findings(results: tuple[Judged, ...]) -> tuple[Finding, ...]:
    """The verdicts as findings with lines: gouges and the wrong side are errors, the rest is a warning."""
    return tuple(
        finding
        for result in results
        for finding in (*_alone(result), *_cuts(result), *_leads(result), *_strays(result), *_rest(result))
    )


def depth(results: tuple[Judged, ...]) -> tuple[float, int | None]:
    """The deepest gouge of a run in millimetres with its line; 0 and None if there is none, None for a line unknown."""
    gouges = [gouge for result in results for gouge in result.verdict.gouges]
    deepest = max(gouges, key=lambda gouge: gouge.depth, default=None)
    return (deepest.depth, _line(deepest.path_number)) if deepest else (0.0, None)


def _line(number: float) -> int | None:
    """The program's line that a piece of a path has as its number; 0 is a move that stands in no line."""
    return int(number) or None


def _cuts(result: Judged) -> list[Finding]:
    verdict = result.verdict
    if not verdict.judged:
        line = _line(result.centre.numbers[0]) if len(result.centre) else None
        return [Finding("UNJUDGED", Severity.ERROR, "This path cannot be judged: its numbers are none.", line=line)]
    found = [_gouge(gouge) for gouge in verdict.gouges[:MOST_GOUGES]]
    left = len(verdict.gouges) - len(found)
    if left:
        found.append(Finding("GOUGE", Severity.ERROR, f"There are {left} more gouges, none of them deeper."))
    if verdict.wrong_side:
        line = _line(result.centre.numbers[verdict.wrong_side[0]])
        text = "The cutter runs on the wrong side of the contour here."
        if 2 * len(verdict.wrong_side) > len(result.centre):
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


def _leads(result: Judged) -> list[Finding]:
    """That moves are taken for leads, and what is cut of them."""
    if not result.leads:
        return []
    text = f"{len(result.leads)} moves before or behind the closed contour are taken for leads, not for surface."
    found = [Finding("LEADS", Severity.INFO, text, line=result.leads[0])]
    for gouge in result.lead_gouges[:1]:
        text = f"The cutter cuts {{value}} into line {int(gouge.surface_number)}; if that is no lead, it is a gouge."
        line = _line(gouge.path_number)
        found.append(Finding("LEAD-GOUGE", Severity.INFO, text, at=gouge.surface_at, value=gouge.depth, line=line))
    return found


def _strays(result: Judged) -> list[Finding]:
    """Moves between the leads that leave the surface by more than the radius, or run against it."""
    numbers, lines = result.centre.numbers, result.lines
    against = tuple(row for row in result.verdict.backwards if numbers[row] in lines)
    away: tuple[Away, ...] = ()
    if any(numbers[row] in lines for row in result.verdict.loose):
        found = stray(result.surface, result.stretch.radius, result.centre).away
        away = tuple(one for one in found if _between_leads(one, result.centre, lines))
    told = stray_findings(Stray(away, against))
    begun = [*(int(numbers[row]) for row in against[:1]), *(int(one.first_number) for one in away)]
    return [replace(finding, segment=None, line=line) for finding, line in zip(told, begun, strict=True)]


def _between_leads(away: Away, centre: Path, lines: frozenset[float]) -> bool:
    """Leads are at a path's two ends, or have lines of their own."""
    ends = {tuple(centre.points[0].tolist()), tuple(centre.points[-1].tolist())}
    return {away.first_number, away.last_number} <= lines and not ends & {away.start, away.end}


def _gouge(gouge: Gouge) -> Finding:
    much = "{value}" if gouge.depth > FINE else "less than a thousandth of a millimetre"
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
