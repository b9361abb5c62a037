"""Remedies: why the calculated look-ahead is not clean, and what would help if no value is.

Each remedy is cut and judged before it is offered.  The number of trials is bounded, so a remedy that exists may not be
found; but every remedy offered does work.  Before each trial `progress` is called, which may raise Stopped; how far the
search is, is not known.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.advice.lookahead_table import CuttingSetup, Effect, Row, Table, judge_lookaheads
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Point
from core.progress import Progress, silent
from core.tolerance import CLOSED
from core.verify.judge import judge

MAX_STARTS: Final = 6
"""How many of the longest sides are tried as the start."""

MAX_STARTS_WITHOUT_BLENDS: Final = 2
"""The same without blend moves, when the start point matters little."""

LARGER_BY: Final = 1.02
"""A tool that fits only without blend moves must be this much larger to be offered beside one that fits with them."""

FEWEST_CLOSED: Final = 3
"""Segments with which a contour can come back to its start, except two arcs."""

USUAL_LOOKAHEADS: Final = (8, 3, 1, 20)
"""Look-aheads tried in the search for a tool; the one offered with the tool is then chosen from all."""


@dataclass(frozen=True, slots=True)
class ToolFits:
    """A cutter of `diameter` millimeters that is clean at look-ahead `value`; one that is a step larger is not clean.

    `lengths` (mm) are the contour's smallest inside radius, if the cutter leaves it uncut, and the largest
    diameter that cuts it.
    """

    diameter: float
    value: int
    lengths: tuple[float, ...] = ()

    def sentence(self, condition: str = "") -> str:
        """Return the end of a sentence: the diameter, its look-ahead, and the radius that the cutter leaves uncut."""
        uncut_text = " It leaves the inside radius {0} uncut; {1} or smaller cuts it." if self.lengths else ""
        return f"the largest that does not gouge{condition}: {{value}}, with look-ahead {self.value}.{uncut_text}"


@dataclass(frozen=True, slots=True)
class StartMoved:
    """A new START: from `at`, the middle of `segment` or its new start, the contour is clean at look-ahead `value`.

    `effect`: what this look-ahead does, as in `Row.effect`.
    """

    segment: float
    at: Point
    value: int
    effect: Effect


def _recommended(setup: CuttingSetup, progress: Progress) -> Row | None:
    """Return the row of the look-ahead that the table recommends."""
    progress(0.0)
    table = judge_lookaheads(setup)
    return None if table.recommended is None else table.row(table.recommended)


def without_blends(setup: CuttingSetup) -> CuttingSetup | None:
    """Return the setup with BLEND OFFSET 0; the overlap past the start stays.  None if there is no blend anyway."""
    return replace(setup, blend=0.0) if setup.blend > 0.0 else None


def lookahead_without_blends(setup: CuttingSetup, progress: Progress = silent) -> int | None:
    """Return the recommended look-ahead without blend moves; None if none is clean or there is no blend."""
    blendless = without_blends(setup)
    row = None if blendless is None else _recommended(blendless, progress)
    return None if row is None else row.value


def larger_tool_without_blends(
    setup: CuttingSetup, with_blends: ToolFits | None, progress: Progress
) -> ToolFits | None:
    """Return the largest clean tool with BLEND OFFSET 0, or None.

    `with_blends` is the tool that fits with blends: a tool less than `LARGER_BY` times as large is not offered.
    """
    blendless = without_blends(setup)
    if blendless is None:
        return None
    steps_with_blends = 0 if with_blends is None else _steps(setup, with_blends.diameter)
    least = 0 if with_blends is None else max(int(steps_with_blends * LARGER_BY), steps_with_blends + 1)
    return largest_tool(blendless, progress, least=least)


def largest_tool(setup: CuttingSetup, progress: Progress = silent, *, least: int = 0) -> ToolFits | None:
    """Find the largest clean diameter below the cutter's, in whole steps, by bisection.

    The smallest inside radius, often the limit, is tried first: if it is the limit, a larger tool that is clean only
    because it deletes such arcs is not searched for.  If a tool of `least` steps is not clean, the result is None.
    """
    fitting, too_large = least, _steps(setup, 2.0 * setup.radius)
    if fitting >= too_large or (fitting and not _clean(setup, fitting, progress)):
        return None
    surface = setup.surface
    limit = min(surface.radii[surface.turns * setup.side.sign > 0].tolist(), default=None)
    first_sizes = [] if limit is None else [_steps(setup, 2.0 * limit), _steps(setup, 2.0 * limit) + 1]
    while too_large - fitting > 1:
        size = first_sizes.pop(0) if first_sizes else (fitting + too_large) // 2
        if not fitting < size < too_large:
            continue
        if _clean(setup, size, progress):
            fitting = size
        else:
            too_large = size
    row = _recommended(_with_tool(setup, fitting), progress) if fitting else None
    if row is None:
        return None
    fits = 0 if limit is None else _steps(setup, 2.0 * limit)
    uncut_radius = (limit, fits * setup.diameter_step) if limit is not None and 0 < fits < fitting else ()
    return ToolFits(fitting * setup.diameter_step, row.value, uncut_radius)


def _clean(setup: CuttingSetup, size: int, progress: Progress) -> bool:
    """True if one of the usual look-aheads gives a clean finish path with a diameter of `size` steps."""
    progress(0.0)
    setup = _with_tool(setup, size)
    distinct = {
        id(control.path): control.with_leads
        for control in setup.paths(setup.radius, USUAL_LOOKAHEADS)
        if len(control.path)
    }
    return any(judge(setup.surface, setup.side, setup.radius, path).clean for path in distinct.values())


def _with_tool(setup: CuttingSetup, size: int) -> CuttingSetup:
    return replace(setup, radius=size * setup.diameter_step / 2.0)


def _steps(setup: CuttingSetup, diameter: float) -> int:
    """Return the whole steps in a diameter, tolerant of rounding."""
    return int(diameter / setup.diameter_step + 1e-6)


def start_mid_side(setup: CuttingSetup, progress: Progress = silent, max_starts: int = MAX_STARTS) -> StartMoved | None:
    """Find the longest side of a closed contour whose middle is a clean start, among the `max_starts` longest."""
    if not setup.closed:
        return None
    for side in longest_segments(setup.surface)[:max_starts]:
        row = _recommended(replace(setup, surface=restarted(setup.surface, side)), progress)
        if row is not None:
            middle = setup.surface[side].point_at(0.5)
            return StartMoved(float(setup.surface.numbers[side]), middle, row.value, row.effect)
    return None


def start_at_end(setup: CuttingSetup, progress: Progress) -> StartMoved | None:
    """Return the end of an open contour, if the contour is clean and closed when START is moved there.

    Only if START and the end share one coordinate, so that a single mistyped number explains the gap, and the first
    segment is a line, which the move may change."""
    surface = setup.surface
    gap = np.abs(surface.points[0] - surface.points[-1])
    if setup.closed or len(surface) < FEWEST_CLOSED or surface.turns[0] or float(gap.min()) > CLOSED:
        return None
    points = np.concatenate((surface.points[-1:], surface.points[1:]))
    closed = replace(setup, surface=Path.of(points, surface.centers, surface.turns, surface.numbers), closed=True)
    row = _recommended(closed, progress)
    x, y = points[0].tolist()
    return None if row is None else StartMoved(float(surface.numbers[0]), (x, y), row.value, row.effect)


def longest_segments(contour: Path) -> list[int]:
    """Return the rows of a contour's segments, the longest first."""
    rows: list[int] = np.argsort(-contour.lengths, kind="stable").tolist()
    return rows


def restarted(contour: Path, row: int) -> Path:
    """Return a closed contour of n segments, started in the middle of segment `row` (from 0): n + 1 new segments."""
    pieces, middle = list(contour), contour[row].point_at(0.5)
    first, last = replace(pieces[row], start=middle), replace(pieces[row], end=middle)
    return Path.from_pieces([first, *pieces[row + 1 :], *pieces[:row], last])


MAX_NAMED_PLACES: Final = 4
"""How many of the places that are too small are named in sentences."""

_NO_BLENDS: Final = "without blend moves (BLEND OFFSET 0)"


def advice_for(setup: CuttingSetup, calculated: int, table: Table, progress: Progress = silent) -> tuple[Finding, ...]:
    """Return the advice for a contour from its look-ahead table: why CAL is not clean, and what would help.

    It is empty if CAL is clean or if the contour cannot be offset at all.  Remedies are searched for only if no value
    is clean.  `progress` may raise Stopped before each trial.
    """
    if not len(table.rows[0].compensated.raw):
        return ()
    why = why_not_clean(table, calculated)
    if table.recommended is not None:
        return why
    return (*why, *_remedies(setup, table, progress))


def _remedies(setup: CuttingSetup, table: Table, progress: Progress) -> tuple[Finding, ...]:
    """Return what would help, each remedy cut and judged clean, after the places that the tool does not enter.

    If neither another start nor leaving out the blend moves helps alone, both are tried at once.  If that does not
    help, a tool is searched for, from the middle of a side if the start is an inside corner; if no tool is found
    either, the end is tried as the start.  Of a contour that crosses itself nothing but the end is tried.
    """
    nearest = min(table.rows, key=lambda row: (row.gouge, row.value))
    if nearest.verdict.crosses_itself:
        return _start_at_end_sentence(setup, progress) or (_crossing_first(nearest.verdict.crossing_at),)
    value, start = lookahead_without_blends(setup, progress), start_mid_side(setup, progress)
    remedies = _start_sentence(start)
    if value is not None:
        remedies = (
            _remedy("BLENDLESS", f"Without blend moves (BLEND OFFSET 0) look-ahead {value} is clean."),
            *remedies,
        )
    blendless = None if remedies else without_blends(setup)
    if blendless is not None:
        remedies = _start_sentence(start_mid_side(blendless, progress, MAX_STARTS_WITHOUT_BLENDS), blends=False)
    tried = "No look-ahead, start or tool" if setup.closed else "No look-ahead or tool"
    remedies = (
        remedies
        or tuple(_tool_sentences(setup, nearest, progress))
        or _start_at_end_sentence(setup, progress)
        # only what has been tried without success: the trials are bounded, and a number may be mistyped
        or (Finding("NOTHING_HELPS", Severity.WARNING, f"{tried} was found that works. Check the contour's numbers."),)
    )
    return (*_too_small(nearest, setup.radius), *remedies)


def _starts_at_inside_corner(row: Row) -> bool:
    return any(finding.code == "START_INSIDE_CORNER" for finding in row.compensated.findings)


def why_not_clean(table: Table, calculated: int) -> tuple[Finding, ...]:
    """Say that CAL's value is not clean, with its deepest gouge, and name the value that is."""
    row = table.row(calculated)
    if row.clean:
        return ()
    if not row.verdict.gouges:
        return (Finding("CAL_NOT_CLEAN", Severity.WARNING, f"CAL {calculated} makes no path that can be cut."),)
    gouge = row.verdict.gouges[0]
    lengths: tuple[float, ...] = ()
    if table.recommended is not None:
        effect, lengths = table.row(table.recommended).effect
        remedy = f"Enter look-ahead {table.recommended}, which {effect}."
    elif _starts_at_inside_corner(row):
        remedy = "START is in an inside corner, where no look-ahead helps."
    else:
        remedy = "No look-ahead is clean."
    text, number = f"CAL {calculated} gouges. {remedy}", gouge.surface_number
    at, depth = gouge.surface_at, gouge.depth
    return (Finding("CAL_NOT_CLEAN", Severity.WARNING, text, number, at=at, value=depth, lengths=lengths),)


def _too_small(row: Row, radius: float) -> tuple[Finding, ...]:
    """Return the inside radii and corners that the tool does not enter in the path that gouges least.

    If there are many, the first ones are named and all are counted.
    """
    small = []
    for finding in row.compensated.findings:
        if finding.code == "VANISHED" and finding.segment is not None:
            text = f"Inside radius {{value}} of segment {finding.segment:g} is too small for tool radius {{0}}."
            small.append(replace(finding, code="TOO_SMALL", text=text, lengths=(radius,)))
        if finding.code == "CORNER_MISSED" and finding.segment is not None:
            text = f"The tool does not fit into the inside corner after segment {int(finding.segment)}."
            small.append(replace(finding, code="TOO_SMALL", text=text))
    if len(small) > MAX_NAMED_PLACES:
        count = replace(small[0], text=f"There are {len(small)} such places.", segment=None)
        small = [*small[:MAX_NAMED_PLACES], count]
    return tuple(small)


def _start_sentence(start: StartMoved | None, *, blends: bool = True) -> tuple[Finding, ...]:
    if start is None:
        return ()
    code, condition = ("START_MID_SIDE", "") if blends else ("START_BLENDLESS", f", {_NO_BLENDS}")
    text = f"Start in the middle of segment {start.segment:g}, at X {{x}} Y {{y}}{condition}: "
    effect, lengths = start.effect
    remedy = _remedy(code, f"{text}look-ahead {start.value} then {effect}.")
    return (replace(remedy, segment=start.segment, at=start.at, lengths=lengths),)


def _tool_sentences(setup: CuttingSetup, nearest: Row, progress: Progress) -> Iterator[Finding]:
    """Yield the largest tool that fits, then a larger one that fits without blend moves, which needs more changes.

    Both are searched for with another start if the contour's own is an inside corner.
    """
    start_condition = ""
    if _starts_at_inside_corner(nearest):
        row = longest_segments(setup.surface)[0]
        start_condition = f" when the contour is started in the middle of segment {setup.surface.numbers[row]:g}"
        setup = replace(setup, surface=restarted(setup.surface, row))
    tool = largest_tool(setup, progress)
    larger = larger_tool_without_blends(setup, tool, progress)
    for fits, code, blends in ((tool, "TOOL_FITS", ""), (larger, "TOOL_BLENDLESS", f" {_NO_BLENDS}")):
        if fits is not None:
            text = f"Tool too big; {fits.sentence(blends + start_condition)}"
            yield replace(_remedy(code, text), field="tool", value=fits.diameter, lengths=fits.lengths)


def _start_at_end_sentence(setup: CuttingSetup, progress: Progress) -> tuple[Finding, ...]:
    start = start_at_end(setup, progress)
    if start is None:
        return ()
    text = (
        "START may be mistyped: at X {x} Y {y}, where the contour ends, it would close "
        f"and look-ahead {start.value} would be clean."
    )
    return (replace(_remedy("START_AT_END", text), segment=0.0, at=start.at),)


def _crossing_first(at: Point | None) -> Finding:
    """Return the advice on a contour that crosses itself: another start or tool would only delete what is wrong."""
    place = " at X {x} Y {y}" if at is not None else ""
    text = f"The contour crosses itself{place}. First look there for a wrong DIRECTION, sign or number."
    return Finding("CROSSING_FIRST", Severity.WARNING, text, at=at)


def _remedy(code: str, text: str) -> Finding:
    return Finding(code, Severity.INFO, text)
