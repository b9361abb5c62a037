"""Path findings: problems of a block's surface and paths, and what a better path would cut."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, dist, inf, radians
from typing import Final, NamedTuple

import numpy as np

from core.advice.block_paths import BlockPaths, RoughPass
from core.advice.remedies import FEWEST_CLOSED
from core.comp.best_path.best_path import BestPath
from core.comp.best_path.separation import Separation
from core.comp.compensated import CenterPath, Compensated
from core.comp.findings import NO_PATH
from core.finding import Finding, Severity
from core.geometry.path import Path, as_complex, next_in_ring, tangents
from core.geometry.piece import Point, Side, signed_area
from core.tolerance import GOUGE, JOINED, SMALLEST_SHOWN_LENGTH
from core.verify.air_cuts import AirCut, air_cuts
from core.verify.report import Names, contact_findings, move_name
from core.verify.report import verdict_findings as verdict_findings
from core.verify.verdict import Approach, Gouge, Verdict

_ORDER: Final = {severity: place for place, severity in enumerate(Severity)}

STRAIGHT_BACK: Final = cos(radians(1.0))
"""Cosine of the angle up to which a segment counts as going straight back over the one before it: an end typed with
all digits of a drawing misses the tangent of a small arc by less."""

MAX_TIGHT_ARCS: Final = 100
"""Arcs, the smallest first, that are searched for one that stays uncut."""


def by_severity(findings: Sequence[Finding]) -> tuple[Finding, ...]:
    """Sort findings: errors, then warnings, then the rest."""
    return tuple(sorted(findings, key=lambda finding: _ORDER[finding.severity]))


def path_findings(paths: BlockPaths) -> tuple[Finding, ...]:
    """Return all findings on the posted path, its blends and the roughing passes."""
    assert paths.verdict is not None
    assert paths.compensated is not None
    return (
        *(paths.compensated if paths.best is None else paths.best).findings,
        *verdict_findings(paths.verdict, paths.surface, move_names(paths)),
        *contact_findings(tuple(_air_cuts(paths, paths.verdict)), paths.verdict.backwards),
        *blend_findings(paths.loops, paths.verdict.gouges, paths.verdict.wrong_side),
        *rough_findings(paths.rough, paths.compensated if paths.best is None else None),
    )


class _Rows(NamedTuple):
    """The rows where one loop's parts begin and end in the verdict, which counts the pieces of all loops in order."""

    lead_in: int
    path: int
    lead_out: int
    end: int


def _rows(loops: Sequence[CenterPath]) -> Iterator[tuple[CenterPath, _Rows]]:
    first = 0
    for loop in loops:
        path = first + len(loop.lead_in)
        rows = _Rows(first, path, path + len(loop.path), path + len(loop.path) + len(loop.lead_out))
        yield loop, rows
        first = rows.end


def _air_cuts(paths: BlockPaths, verdict: Verdict) -> Iterator[AirCut]:
    """Yield the air cuts of the paths without their blends."""
    for loop, rows in _rows(paths.loops):
        if any(rows.path <= row < rows.lead_out for row in verdict.may_cut_air):
            yield from air_cuts(paths.surface, verdict.radius, loop.path)


def move_names(paths: BlockPaths) -> Names:
    """Return a function that names the moves of all loops, by their rows in the verdict."""

    def name(row: int, _number: float) -> str:
        for loop, rows in _rows(paths.loops):
            if row < rows.path:
                return "the blend-in arc"
            if row < rows.lead_out:
                return move_name(loop.path, row - rows.path, paths.surface)
            if row < rows.end:
                return _lead_out_name(loop, row - rows.lead_out, paths.surface)
        raise IndexError(row)

    return name


def _lead_out_name(loop: CenterPath, row: int, surface: Path) -> str:
    lead = loop.lead_out
    # the overlap's arcs share centers with the path's own, the blend arc does not
    repeats_path = bool((as_complex(loop.path.centers) == as_complex(lead.centers)[row]).any())
    if row == len(lead) - 1 and lead.turns[row] and not repeats_path:
        return "the blend-out arc"
    return f"{move_name(lead, row, surface)} past START"


def blend_findings(
    loops: Sequence[CenterPath], gouges: Sequence[Gouge], wrong_side: Sequence[int]
) -> Iterator[Finding]:
    """Report blend arcs that gouge or cross a wall; another start or a smaller BLEND OFFSET is the remedy.

    The gouge that is named is also a GOUGE, with the same segment, place and depth.  `wrong_side` are the moves that
    run on the part's side, by their rows in the verdict.
    """
    for loop, rows in _rows(loops):
        into, out = ("in", loop.lead_in, rows.lead_in, rows.path), ("out", loop.lead_out, rows.lead_out, rows.end)
        for name, lead, first, last in (into, out):
            gouging = next((gouge for gouge in gouges if first <= gouge.path_piece < last), None)
            if gouging is not None:
                text = f"The blend-{name} arc gouges {{value}} deep. Start elsewhere or reduce BLEND OFFSET with F4."
                where = gouging.surface_number, "blend_offset", gouging.surface_at, gouging.depth
                yield Finding("BLEND_GOUGES", Severity.ERROR, text, *where)
            if any(first <= row < last for row in wrong_side):
                # its free end
                end, preposition = (0, "from") if name == "in" else (-1, "to")
                x, y = lead.points[end].tolist()
                text = (
                    f"The blend-{name} arc {preposition} X {{x}} Y {{y}} crosses a wall. Reduce BLEND OFFSET with F4."
                )
                yield Finding("BLEND_LEAVES", Severity.WARNING, text, float(lead.numbers[end]), "blend_offset", (x, y))


def rough_findings(rough: Sequence[RoughPass], finish: Compensated | None) -> Iterator[Finding]:
    """Report the problems of each roughing pass: gouges, stock that is not left, no room, segments that it skips."""
    for rough_pass in rough:
        yield from _rough_errors(rough_pass, posts_control=finish is not None)
        skipped = _deleted(rough_pass.compensated) - (set() if finish is None else _deleted(finish))
        if skipped and finish is not None:
            numbers = ", ".join(f"{number:g}" for number in sorted(skipped))
            which = f"segment{'s' if len(skipped) > 1 else ''} {numbers}"
            text = f"Roughing that leaves {{0}} skips {which}: the next pass cuts solid stock there."
            yield Finding("ROUGH_DELETES", Severity.WARNING, text, min(skipped), lengths=(rough_pass.stock,))


def _rough_errors(rough_pass: RoughPass, *, posts_control: bool) -> Iterator[Finding]:
    for gouge in rough_pass.verdict.gouges[:1]:
        stock_left = rough_pass.stock - gouge.depth
        where = gouge.surface_number, None, gouge.surface_at, abs(stock_left), (rough_pass.stock,)
        if stock_left < -GOUGE:
            text = "Roughing that leaves {0} gouges {value} deep at X {x} Y {y}."
            yield Finding("ROUGH_GOUGES", Severity.ERROR, text, *where)
        else:
            text = "Roughing that should leave {0~value} leaves only {value~0} at X {x} Y {y}."
            yield Finding("ROUGH_STOCK", Severity.WARNING, text, *where)
    if rough_pass.verdict.wrong_side or not rough_pass.verdict.judged:
        fault = "runs on the wrong side of the contour" if rough_pass.verdict.judged else "cannot be judged"
        text = f"Roughing that leaves {{0}} {fault}."
        yield Finding("ROUGH_GOUGES", Severity.ERROR, text, lengths=(rough_pass.stock,))
    if not rough_pass.loops:
        text = "No room for the {0} roughing pass: skipped."
        back = any(finding.code == NO_PATH and finding.field for finding in rough_pass.compensated.findings)
        if posts_control and back:
            text = "The {0} roughing pass comes back to its start next to a corner and is skipped. "
            text += "Start in the middle of a side."
        yield Finding("ROUGH_EMPTY", Severity.WARNING, text, lengths=(rough_pass.stock,))


def _deleted(compensated: Compensated) -> set[float]:
    return set(compensated.deleted.segments.tolist())


class ZStep(NamedTuple):
    """A place where the path goes straight up or down: the `rise` (negative if down), the next segment, the point."""

    rise: float
    number: float
    at: Point


def z_step_findings(steps: Sequence[ZStep]) -> tuple[Finding, ...]:
    """Warn about the deepest and the highest step, and say how many there are of each.

    The tool plunges there with its whole width, which a non-center-cutting end mill cannot do.
    """
    falls = sorted(step for step in steps if step.rise < 0.0)
    rises = sorted((step for step in steps if step.rise > 0.0), reverse=True)
    return (*_largest_step(falls, "down"), *_largest_step(rises, "up"))


def _largest_step(steps: Sequence[ZStep], direction: str) -> tuple[Finding, ...]:
    if not steps:
        return ()
    rise, number, at = steps[0]
    more = f" There are {len(steps)} such places." if len(steps) > 1 else ""
    text = (
        f"The tool goes straight {direction} {{value}} at X {{x}} Y {{y}}: the ramp to Z END is shortened there.{more}"
    )
    return (Finding("Z_STEP", Severity.WARNING, text, number, "z_end", at, abs(rise)),)


def nearest_place(paths: BlockPaths | None) -> Approach | None:
    """Return where the posted path comes nearest to the surface."""
    return None if paths is None or paths.verdict is None else paths.verdict.closest


def better_path_findings(best: BestPath, separation: Separation) -> tuple[Finding, ...]:
    """Report what the best path would cut that the control's does not, or that there is no best path."""
    if not best.loops:
        return (Finding("NO_BEST", Severity.INFO, "The tool does not fit. Use a smaller one."),)
    if separation.length <= SMALLEST_SHOWN_LENGTH or not separation.stretches:
        return ()
    first = separation.stretches[0]
    x, y = first.points[0].tolist()
    text = "BEST runs {value} more, from X {x} Y {y} on. Set PATH with F4."
    return (Finding("BEST_DIFFERS", Severity.INFO, text, float(first.numbers[0]), None, (x, y), separation.length),)


def size_warning(radius: float, surface: Path, side: Side, *, closed: bool) -> tuple[Finding, ...]:
    """Warn about a tool larger than the whole contour, which is usually the wrong one.

    Around the outside of a closed contour, such as a small island, a larger tool is nothing unusual.
    """
    boxes = surface.boxes
    extent = max((boxes[2:].max(axis=1) - boxes[:2].min(axis=1)).tolist(), default=inf)
    if 2 * radius <= extent or (closed and signed_area(surface) * side.sign < 0.0):
        return ()
    text = "The tool is {value} across, larger than the whole contour ({0}). Check TOOL and TOOL SETUP."
    return (Finding("TOOL_LARGE", Severity.WARNING, text, field="tool", value=2 * radius, lengths=(extent,)),)


def tight_arcs(verdict: Verdict, surface: Path, side: Side, radius: float) -> tuple[Finding, ...]:
    """Say that the tool does not fit into inside arcs smaller than it is; name the smallest that it leaves uncut."""
    ends = verdict.uncut_ends
    first, last = ends.first, ends.last
    inside = np.flatnonzero((surface.turns * side.sign > 0) & (surface.radii < radius - JOINED))
    for row in inside[surface.radii[inside].argsort()][:MAX_TIGHT_ARCS].tolist():
        number, small = float(surface.numbers[row]), float(surface.radii[row])
        after_first, before_last = first <= number, number <= last
        # a stretch may run over START
        if np.where(first <= last, after_first & before_last, after_first | before_last).any():
            text = "The radius {0~1} is smaller than the tool's {1~0}. To cut it use a tool of {value-} or smaller."
            return (Finding("ARC_TIGHT", Severity.INFO, text, number, value=2.0 * small, lengths=(small, radius)),)
    return ()


def open_finding(surface: Path, diameter: float, *, closed: bool) -> tuple[Finding, ...]:
    """Say that a contour is open; warn if START and the end are no farther apart than the tool is wide.

    Such a gap is seldom intended and invisible in the path.  So is one so small that the contour counts as closed,
    in which the path gouges as deep as the gap.  Fewer than three segments enclose nothing.
    """
    gap = dist(surface.points[0].tolist(), surface.points[-1].tolist()) if len(surface) else 0.0
    if gap <= GOUGE or (not closed and len(surface) < FEWEST_CLOSED):
        return ()
    number, place = float(surface.numbers[-1]), tuple(surface.points[-1].tolist())
    # show enough digits to tell the end from START, however small the gap
    lengths = (0.0, *surface.points[0].tolist())
    if not closed and gap > diameter:
        text = "The contour is open: it ends {value~0} from START."
        return (Finding("OPEN", Severity.INFO, text, number, None, place, gap, lengths),)
    claim = "is treated as closed but" if closed else "is not closed: it"
    text = f"The contour {claim} ends {{value~0}} from START, at X {{x~1}} Y {{y~2}}. "
    text += "Check START and the last segment."
    return (Finding("NEARLY_CLOSED", Severity.WARNING, text, number, None, place, gap, lengths),)


def turning_back(surface: Path, *, closed: bool) -> tuple[Finding, ...]:
    """Warn about segments that go straight back over the one before them, if one of the two is a line: mostly arcs with
    the wrong DIRECTION between two lines to which they should be tangent.

    Two arcs do this where scallops meet, which is fine.
    """
    (into, leave), turns = tangents(surface), surface.turns
    turned = leave.conj() * next_in_ring(into)
    reversals = (turned.real < -STRAIGHT_BACK * np.abs(turned)).nonzero()[0].tolist()
    joints = [(row, (row + 1) % len(turns)) for row in reversals if closed or row + 1 < len(turns)]
    return tuple(_turned(surface, row, following) for row, following in joints if not (turns[row] and turns[following]))


def _turned(surface: Path, row: int, following: int) -> Finding:
    before, number = f"{surface.numbers[row]:g}", float(surface.numbers[following])
    check = f"DIRECTION of segment {before}" if surface.turns[row] else "its end"
    if surface.turns[following]:
        check = "its DIRECTION and its end"
    text = f"This segment goes straight back over segment {before} at X {{x}} Y {{y}}. Check {check}."
    return Finding("TURNS_BACK", Severity.WARNING, text, number, at=tuple(surface.points[row + 1].tolist()))
