"""What is said of a block's paths: errors that forbid posting, warnings, and what a better path would cut."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist, inf
from typing import Final

from core.comp.best_path.best_path import BestPath, Separation
from core.comp.result import Compensated
from core.finding import Finding, Severity
from core.geometry.path import Path, planes
from core.pipeline.derived import DerivedBlock, Loop, RoughPass, Work
from core.tolerance import GOUGE
from core.verify.names import Names, move_name
from core.verify.nearest import Nearest, nearest
from core.verify.report import findings as verdict_findings
from core.verify.report import stray_findings
from core.verify.stray import Away, Stray, stray
from core.verify.verdict import Gouge, Verdict

_ORDER: Final = {severity: place for place, severity in enumerate(Severity)}

FEWEST: Final = 3
"""Segments with which a contour can come back to where it began, but for two arcs."""


def path_findings(work: Work) -> tuple[Finding, ...]:
    """Everything found about the posted path, its blends and the roughing passes."""
    assert work.verdict is not None
    assert work.compensated is not None
    return (
        *(work.compensated if work.best is None else work.best).findings,
        *verdict_findings(work.verdict, work.surface, move_names(work)),
        *stray_findings(strayed(work, work.verdict)),
        *blend_findings(work.loops, work.verdict.gouges, work.verdict.wrong_side),
        *rough_findings(work.rough, work.compensated if work.best is None else None),
    )


def strayed(work: Work, verdict: Verdict) -> Stray:
    """Where the paths without their blends leave the surface by more than the radius, and what runs backwards."""
    away: list[Away] = []
    against: list[int] = []
    first = 0
    for loop in work.loops:
        begin = first + len(loop.lead_in)
        last = begin + len(loop.path) + len(loop.lead_out)
        rows = range(begin, begin + len(loop.path))
        if any(row in rows for row in verdict.loose):
            away += stray(work.surface, verdict.radius, loop.path).away
        against += [row for row in verdict.backwards if first <= row < last]
        first = last
    return Stray(tuple(away), tuple(against))


def move_names(work: Work) -> Names:
    """What the moves of all loops are, counted as the verdict counts them."""

    def name(row: int, _number: float) -> str:
        for loop in work.loops:
            for path in (loop.lead_in, loop.path, loop.lead_out):
                if row < len(path):
                    return _move_name(loop, path, row, work.surface)
                row -= len(path)
        raise IndexError(row)

    return name


def _move_name(loop: Loop, path: Path, row: int, surface: Path) -> str:
    if path is loop.path:
        return move_name(path, row, surface)
    if path is loop.lead_in:
        return "The blend-in arc"
    # the overlap's arcs are the path's own, the blend's is not
    again = bool((planes(loop.path.centers) == planes(path.centers)[row]).any())
    if row == len(path) - 1 and path.turns[row] and not again:
        return "The blend-out arc"
    return f"{move_name(path, row, surface)} past START"


def blend_findings(loops: Sequence[Loop], gouges: Sequence[Gouge], wrong_side: Sequence[int]) -> Iterator[Finding]:
    """A blend arc that gouges or leads through a wall is named: the remedy is another start or a smaller BLEND OFFSET.

    `wrong_side` are moves that run on the part's side, counted as the verdict counts them.
    """
    first = 0
    for loop in loops:
        begin, end = first + len(loop.lead_in), first + len(loop.lead_in) + len(loop.path)
        last = end + len(loop.lead_out)
        for name, low, high in (("in", first, begin), ("out", end, last)):
            hit = next((gouge for gouge in gouges if low <= gouge.path_piece < high), None)
            if hit is not None:
                text = f"The blend-{name} arc gouges {{value}} deep. Start elsewhere or make BLEND OFFSET smaller."
                yield Finding("BLEND_GOUGES", Severity.ERROR, text, hit.surface_number, None, hit.at, hit.depth)
            if any(low <= piece < high for piece in wrong_side):
                yield _leaves(loop, name)
        first = last


def _leaves(loop: Loop, name: str) -> Finding:
    """The blend arc that is beyond a wall somewhere, with its free end."""
    lead, row, verb = (loop.lead_in, 0, "begins") if name == "in" else (loop.lead_out, -1, "ends")
    x, y = lead.points[row].tolist()
    text = f"The blend-{name} arc, which {verb} at X {{x}} Y {{y}}, runs beyond a wall: make BLEND OFFSET smaller."
    return Finding("BLEND_LEAVES", Severity.WARNING, text, float(lead.numbers[row]), None, (x, y))


def rough_findings(rough: Sequence[RoughPass], finish: Compensated | None) -> Iterator[Finding]:
    """What is wrong with each roughing pass: gouges, stock that is not left, no room, what it deletes of the finish."""
    for one in rough:
        yield from _rough_errors(one)
        gone = _deleted(one.compensated) - (set() if finish is None else _deleted(finish))
        if gone and finish is not None:
            which = f"segment{'s' if len(gone) > 1 else ''} {', '.join(f'{number:g}' for number in sorted(gone))}"
            text = f"The roughing pass that leaves {{0}} deletes {which}: the next one meets solid there."
            yield Finding("ROUGH_DELETES", Severity.WARNING, text, min(gone), lengths=(one.stock,))


def _rough_errors(one: RoughPass) -> Iterator[Finding]:
    for hit in one.verdict.gouges[:1]:
        left = one.stock - hit.depth
        where = hit.surface_number, None, hit.surface_at, abs(left), (one.stock,)
        if left < -GOUGE:
            text = "The roughing pass that leaves {0} gouges {value} deep at X {x} Y {y}."
            yield Finding("ROUGH_GOUGES", Severity.ERROR, text, *where)
        else:
            text = "The roughing pass that leaves {0~value} leaves only {value~0} at X {x} Y {y}."
            yield Finding("ROUGH_STOCK", Severity.WARNING, text, *where)
    if one.verdict.wrong_side or not one.verdict.judged:
        text = "The roughing pass that leaves {0} runs on the part's side of the contour, or cannot be judged."
        yield Finding("ROUGH_GOUGES", Severity.ERROR, text, lengths=(one.stock,))
    if not one.loops:
        text = "The roughing pass that leaves {0} has no room: it is left out."
        yield Finding("ROUGH_EMPTY", Severity.WARNING, text, lengths=(one.stock,))


def _deleted(one: Compensated) -> set[float]:
    return set(one.deleted.segments.tolist())


def nearest_of(found: DerivedBlock) -> Nearest | None:
    """Where the posted path comes nearest to the surface."""
    work = found.work
    if work is None or work.verdict is None:
        return None
    return nearest(work.surface, [loop.whole for loop in work.loops], work.verdict.clearance)


def nearest_finding(found: DerivedBlock) -> Finding | None:
    """The least distance from the center path to the surface against the tool's radius, and where; None for none."""
    place = nearest_of(found)
    if place is None or found.radius is None:
        return None
    text = f"{{value~0}} at X {{x}} Y {{y}} on segment {place.surface_number:g}; the tool's radius is {{0~value}}."
    where = place.surface_number, None, place.surface_at, place.distance, (found.radius,)
    return Finding("NEAREST", Severity.INFO, text, *where)


def better_findings(best: BestPath, apart: Separation) -> tuple[Finding, ...]:
    """What the best path would cut that the control's does not, or that there is none."""
    if not best.loops:
        text = "The tool fits nowhere beside this contour: there is no best path either."
        return (Finding("NO_BEST", Severity.INFO, text),)
    if apart.length <= GOUGE or not apart.stretches:
        return ()
    first = apart.stretches[0]
    x, y = first.points[0].tolist()
    text = "The best path runs {value} that this path does not, from X {x} Y {y} on: PATH on PROGRAM PARAMETERS."
    return (Finding("BEST_DIFFERS", Severity.INFO, text, float(first.numbers[0]), None, (x, y), apart.length),)


def size_warning(radius: float, surface: Path) -> tuple[Finding, ...]:
    """A tool that is larger than the whole contour is mostly a wrong one."""
    if len(surface):
        # the contour is no smaller than what two of its points span: seldom is more to be asked
        (x, y), (x_far, y_far) = surface.points[0].tolist(), surface.points[len(surface) // 2].tolist()
        if 2 * radius <= max(abs(x_far - x), abs(y_far - y)):
            return ()
    boxes = surface.boxes
    extent = max((boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0)).tolist(), default=inf)
    if 2 * radius <= extent:
        return ()
    text = "The tool is {value} across, larger than the whole contour ({0}). Check TOOL and TOOL SETUP."
    return (Finding("TOOL_LARGE", Severity.WARNING, text, field="tool", value=2 * radius, lengths=(extent,)),)


def open_finding(surface: Path, diameter: float, *, closed: bool) -> tuple[Finding, ...]:
    """That a contour is open: a warning where START and the end are no farther apart than the tool is wide.

    Such a gap is seldom meant, and no look at the path shows it; nor one so small that the contour counts as closed,
    beside which the path gouges as deep.  Fewer than three segments enclose nothing.
    """
    apart = dist(surface.points[0].tolist(), surface.points[-1].tolist()) if len(surface) else 0.0
    if apart <= GOUGE or (not closed and len(surface) < FEWEST):
        return ()
    number, place = float(surface.numbers[-1]), tuple(surface.points[-1].tolist())
    if not closed and apart > diameter:
        text = "The contour is open: it ends {value} from START."
        return (Finding("OPEN", Severity.INFO, text, number, None, place, apart),)
    what = "counts as closed, but" if closed else "is not closed:"
    text = f"The contour {what} it ends at X {{x}} Y {{y}}, {{value}} from START. Check START and the last segment."
    return (Finding("NEARLY_CLOSED", Severity.WARNING, text, number, None, place, apart),)


def by_weight(found: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """Errors, then warnings, then the rest."""
    return tuple(sorted(found, key=lambda finding: _ORDER[finding.severity]))
