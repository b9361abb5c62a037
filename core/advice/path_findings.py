"""Path findings: what is wrong with a block's surface and paths, and what a better path would cut."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, dist, inf, radians
from typing import Final, NamedTuple

import numpy as np

from core.advice.block_paths import BlockPaths, Loop, RoughPass
from core.advice.remedies import FEWEST_CLOSED
from core.comp.best_path.best_path import BestPath
from core.comp.best_path.separation import Separation
from core.comp.compensated import Compensated
from core.finding import Finding, Severity
from core.geometry.path import Path, as_complex, next_in_ring
from core.geometry.piece import Point, Side
from core.tolerance import GOUGE, JOINED, SHOWN
from core.verify.air_cuts import AirCut, air_cuts
from core.verify.report import Names, contact_findings, move_name
from core.verify.report import verdict_findings as verdict_findings
from core.verify.verdict import Approach, Gouge, Verdict

_ORDER: Final = {severity: place for place, severity in enumerate(Severity)}

STRAIGHT_BACK: Final = cos(radians(1.0))
"""Cosine of the angle between two segments below which they lie on each other: an end typed to the last digit of a
drawing misses the tangent of a small arc by less."""

MAX_TIGHT_ARCS: Final = 100
"""Arcs, the smallest first, that are looked at for one that stays uncut."""


def by_severity(findings: Sequence[Finding]) -> tuple[Finding, ...]:
    """Errors, then warnings, then the rest."""
    return tuple(sorted(findings, key=lambda finding: _ORDER[finding.severity]))


def path_findings(work: BlockPaths) -> tuple[Finding, ...]:
    """Everything found about the posted path, its blends and the roughing passes."""
    assert work.verdict is not None
    assert work.compensated is not None
    return (
        *(work.compensated if work.best is None else work.best).findings,
        *verdict_findings(work.verdict, work.surface, move_names(work)),
        *contact_findings(tuple(_air_cuts(work, work.verdict)), work.verdict.backwards),
        *blend_findings(work.loops, work.verdict.gouges, work.verdict.wrong_side),
        *rough_findings(work.rough, work.compensated if work.best is None else None),
    )


class _Rows(NamedTuple):
    """Where the parts of one loop begin and end among the rows of the verdict, which counts all loops in order."""

    lead_in: int
    path: int
    lead_out: int
    end: int


def _rows(loops: Sequence[Loop]) -> Iterator[tuple[Loop, _Rows]]:
    first = 0
    for loop in loops:
        path = first + len(loop.lead_in)
        rows = _Rows(first, path, path + len(loop.path), path + len(loop.path) + len(loop.lead_out))
        yield loop, rows
        first = rows.end


def _air_cuts(work: BlockPaths, verdict: Verdict) -> Iterator[AirCut]:
    """Where the paths without their blends leave the surface by more than the radius."""
    for loop, rows in _rows(work.loops):
        if any(rows.path <= row < rows.lead_out for row in verdict.loose):
            yield from air_cuts(work.surface, verdict.radius, loop.path)


def move_names(work: BlockPaths) -> Names:
    """What the moves of all loops are, counted as the verdict counts them."""

    def name(row: int, _number: float) -> str:
        for loop, rows in _rows(work.loops):
            if row < rows.path:
                return "the blend-in arc"
            if row < rows.lead_out:
                return move_name(loop.path, row - rows.path, work.surface)
            if row < rows.end:
                return _lead_out_name(loop, row - rows.lead_out, work.surface)
        raise IndexError(row)

    return name


def _lead_out_name(loop: Loop, row: int, surface: Path) -> str:
    lead = loop.lead_out
    # the overlap's arcs are the path's own, the blend's is not
    again = bool((as_complex(loop.path.centers) == as_complex(lead.centers)[row]).any())
    if row == len(lead) - 1 and lead.turns[row] and not again:
        return "the blend-out arc"
    return f"{move_name(lead, row, surface)} past START"


def blend_findings(loops: Sequence[Loop], gouges: Sequence[Gouge], wrong_side: Sequence[int]) -> Iterator[Finding]:
    """A blend arc that gouges or crosses a wall: the remedy is another start or a smaller BLEND OFFSET.

    `wrong_side` are moves that run on the part's side, counted as the verdict counts them.
    """
    for loop, rows in _rows(loops):
        blends = (("in", rows.lead_in, rows.path), ("out", rows.lead_out, rows.end))
        for name, first, last in blends:
            hit = next((gouge for gouge in gouges if first <= gouge.path_piece < last), None)
            if hit is not None:
                text = f"The blend-{name} arc gouges {{value}} deep. Start elsewhere or reduce BLEND OFFSET."
                yield Finding("BLEND_GOUGES", Severity.ERROR, text, hit.surface_number, None, hit.at, hit.depth)
            if any(first <= row < last for row in wrong_side):
                yield _blend_crosses_wall(loop, name)


def _blend_crosses_wall(loop: Loop, name: str) -> Finding:
    """The blend arc that runs beyond a wall somewhere, with its free end."""
    lead, row, way = (loop.lead_in, 0, "from") if name == "in" else (loop.lead_out, -1, "to")
    x, y = lead.points[row].tolist()
    text = f"The blend-{name} arc {way} X {{x}} Y {{y}} crosses a wall. Reduce BLEND OFFSET."
    return Finding("BLEND_LEAVES", Severity.WARNING, text, float(lead.numbers[row]), None, (x, y))


def rough_findings(rough: Sequence[RoughPass], finish: Compensated | None) -> Iterator[Finding]:
    """What is wrong with each roughing pass: gouges, stock that is not left, no room, segments it skips."""
    for rough_pass in rough:
        yield from _rough_errors(rough_pass)
        skipped = _deleted(rough_pass.compensated) - (set() if finish is None else _deleted(finish))
        if skipped and finish is not None:
            numbers = ", ".join(f"{number:g}" for number in sorted(skipped))
            which = f"segment{'s' if len(skipped) > 1 else ''} {numbers}"
            text = f"Roughing that leaves {{0}} skips {which}: the next pass cuts solid stock there."
            yield Finding("ROUGH_DELETES", Severity.WARNING, text, min(skipped), lengths=(rough_pass.stock,))


def _rough_errors(rough_pass: RoughPass) -> Iterator[Finding]:
    for gouge in rough_pass.verdict.gouges[:1]:
        left = rough_pass.stock - gouge.depth
        where = gouge.surface_number, None, gouge.surface_at, abs(left), (rough_pass.stock,)
        if left < -GOUGE:
            text = "Roughing that leaves {0} gouges {value} deep at X {x} Y {y}."
            yield Finding("ROUGH_GOUGES", Severity.ERROR, text, *where)
        else:
            text = "Roughing that should leave {0~value} leaves only {value~0} at X {x} Y {y}."
            yield Finding("ROUGH_STOCK", Severity.WARNING, text, *where)
    if rough_pass.verdict.wrong_side or not rough_pass.verdict.judged:
        what = "runs on the wrong side of the contour" if rough_pass.verdict.judged else "cannot be judged"
        text = f"Roughing that leaves {{0}} {what}."
        yield Finding("ROUGH_GOUGES", Severity.ERROR, text, lengths=(rough_pass.stock,))
    if not rough_pass.loops:
        text = "No room for the {0} roughing pass: skipped."
        yield Finding("ROUGH_EMPTY", Severity.WARNING, text, lengths=(rough_pass.stock,))


def _deleted(compensated: Compensated) -> set[float]:
    return set(compensated.deleted.segments.tolist())


class ZStep(NamedTuple):
    """Where the path goes straight up or down: how far, up if positive, the segment after it, and the place."""

    rise: float
    number: float
    at: Point


def z_step_findings(steps: Sequence[ZStep]) -> tuple[Finding, ...]:
    """The deepest and the highest step, each a warning that says how many there are.

    The tool plunges there with its whole width, which an end mill that does not cut at its center cannot.
    """
    falls = sorted(step for step in steps if step.rise < 0.0)
    rises = sorted((step for step in steps if step.rise > 0.0), reverse=True)
    return (*_largest_step(falls, "down"), *_largest_step(rises, "up"))


def _largest_step(steps: Sequence[ZStep], way: str) -> tuple[Finding, ...]:
    if not steps:
        return ()
    rise, number, at = steps[0]
    more = f" There are {len(steps)} such places." if len(steps) > 1 else ""
    text = f"The tool goes straight {way} {{value}} at X {{x}} Y {{y}}: the ramp to Z END is shortened there.{more}"
    return (Finding("Z_STEP", Severity.WARNING, text, number, "z_end", at, abs(rise)),)


def nearest_place(work: BlockPaths | None) -> Approach | None:
    """Where the posted path comes nearest to the surface."""
    return None if work is None or work.verdict is None else work.verdict.closest


def better_path_findings(best: BestPath, apart: Separation) -> tuple[Finding, ...]:
    """What the best path would cut that the control's does not, or that there is none."""
    if not best.loops:
        return (Finding("NO_BEST", Severity.INFO, "The tool does not fit. Use a smaller one."),)
    if apart.length <= SHOWN or not apart.stretches:
        return ()
    first = apart.stretches[0]
    x, y = first.points[0].tolist()
    text = "BEST runs {value} more, from X {x} Y {y} on. Set PATH with F4."
    return (Finding("BEST_DIFFERS", Severity.INFO, text, float(first.numbers[0]), None, (x, y), apart.length),)


def size_warning(radius: float, surface: Path) -> tuple[Finding, ...]:
    """A tool that is larger than the whole contour is usually the wrong tool."""
    boxes = surface.boxes
    extent = max((boxes[2:].max(axis=1) - boxes[:2].min(axis=1)).tolist(), default=inf)
    if 2 * radius <= extent:
        return ()
    text = "The tool is {value} across, larger than the whole contour ({0}). Check TOOL and TOOL SETUP."
    return (Finding("TOOL_LARGE", Severity.WARNING, text, field="tool", value=2 * radius, lengths=(extent,)),)


def tight_arcs(verdict: Verdict, surface: Path, side: Side, radius: float) -> tuple[Finding, ...]:
    """Says that a tool stays out of inside arcs smaller than it is; names the smallest that it leaves uncut."""
    first, last = verdict.uncut.columns[:2]
    inside = np.flatnonzero((surface.turns * side.sign > 0) & (surface.radii < radius - JOINED))
    for row in inside[surface.radii[inside].argsort()][:MAX_TIGHT_ARCS].tolist():
        number, small = float(surface.numbers[row]), float(surface.radii[row])
        after_first, before_last = first <= number, number <= last
        # a stretch may run over START
        if np.where(first <= last, after_first & before_last, after_first | before_last).any():
            text = "The radius {0} is smaller than the tool's {1}. To cut it use a tool of {value} or smaller."
            return (Finding("ARC_TIGHT", Severity.INFO, text, number, value=2.0 * small, lengths=(small, radius)),)
    return ()


def open_finding(surface: Path, diameter: float, *, closed: bool) -> tuple[Finding, ...]:
    """Says that a contour is open: a warning where START and the end are no farther apart than the tool is wide.

    Such a gap is seldom meant, and no look at the path shows it; nor one so small that the contour counts as closed,
    where the path gouges as deep.  Fewer than three segments enclose nothing.
    """
    apart = dist(surface.points[0].tolist(), surface.points[-1].tolist()) if len(surface) else 0.0
    if apart <= GOUGE or (not closed and len(surface) < FEWEST_CLOSED):
        return ()
    number, place = float(surface.numbers[-1]), tuple(surface.points[-1].tolist())
    # with the digits that tell the end from START, however small the gap
    lengths = (0.0, *surface.points[0].tolist())
    if not closed and apart > diameter:
        text = "The contour is open: it ends {value~0} from START."
        return (Finding("OPEN", Severity.INFO, text, number, None, place, apart, lengths),)
    what = "is treated as closed but" if closed else "is not closed: it"
    text = f"The contour {what} ends {{value~0}} from START, at X {{x~1}} Y {{y~2}}. "
    text += "Check START and the last segment."
    return (Finding("NEARLY_CLOSED", Severity.WARNING, text, number, None, place, apart, lengths),)


def turning_back(surface: Path, *, closed: bool) -> tuple[Finding, ...]:
    """A segment that leaves the end of the one before in the direction it came from, one of the two a line: mostly an
    arc of the wrong DIRECTION between two lines that it should be tangent to.

    Two arcs do so where scallops meet, and are left alone.
    """
    points, centers, turns = as_complex(surface.points), as_complex(surface.centers), surface.turns
    # a line has its own start for a center: from there to its end it runs as it is
    leave, arcs = points[1:] - centers, turns.nonzero()[0]
    into, quarter = leave.copy(), 1j * turns[arcs]
    leave[arcs] *= quarter
    into[arcs] = quarter * (points[arcs] - centers[arcs])
    turned = leave.conj() * next_in_ring(into)
    back = (turned.real < -STRAIGHT_BACK * np.abs(turned)).nonzero()[0].tolist()
    joints = [(row, (row + 1) % len(turns)) for row in back if closed or row + 1 < len(turns)]
    return tuple(_turned(surface, row, following) for row, following in joints if not (turns[row] and turns[following]))


def _turned(surface: Path, row: int, following: int) -> Finding:
    before, number = f"{surface.numbers[row]:g}", float(surface.numbers[following])
    check = f"DIRECTION of segment {before}" if surface.turns[row] else "its end"
    if surface.turns[following]:
        check = "its DIRECTION and its end"
    text = f"This segment goes straight back over segment {before} at X {{x}} Y {{y}}. Check {check}."
    return Finding("TURNS_BACK", Severity.WARNING, text, number, at=tuple(surface.points[row + 1].tolist()))
