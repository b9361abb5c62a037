"""Advice: why the calculated look-ahead is not clean, and what would help if no value is clean."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from core.advice.lookahead_table import CuttingSetup, Row, Table
from core.advice.remedies import (
    MAX_STARTS_WITHOUT_BLENDS,
    StartMoved,
    larger_tool_without_blends,
    largest_tool,
    longest_segments,
    lookahead_without_blends,
    restarted,
    start_at_end,
    start_mid_side,
    without_blends,
)
from core.finding import Finding, Severity
from core.geometry.piece import Point
from core.progress import Progress, silent

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
    remedies = (*_blends_sentence(value), *_start_sentence(start))
    bare = None if remedies else without_blends(setup)
    if bare is not None:
        remedies = _start_sentence(start_mid_side(bare, progress, MAX_STARTS_WITHOUT_BLENDS), blends=False)
    remedies = (
        remedies
        or tuple(_tool_sentences(setup, nearest, progress))
        or _start_at_end_sentence(setup, progress)
        or (_nothing_helps(closed=setup.closed),)
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
        help_ = f"Enter look-ahead {table.recommended}, which {effect}."
    elif _starts_at_inside_corner(row):
        help_ = "START is in an inside corner, where no look-ahead helps."
    else:
        help_ = "No look-ahead is clean."
    text, number = f"CAL {calculated} gouges. {help_}", gouge.surface_number
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


def _blends_sentence(value: int | None) -> tuple[Finding, ...]:
    if value is None:
        return ()
    return (_remedy("BLENDLESS", f"W{_NO_BLENDS[1:]} look-ahead {value} is clean."),)


def _start_sentence(start: StartMoved | None, *, blends: bool = True) -> tuple[Finding, ...]:
    if start is None:
        return ()
    code, how = ("START_MID_SIDE", "") if blends else ("START_BLENDLESS", f", {_NO_BLENDS}")
    text = f"Start in the middle of segment {start.segment:g}, at X {{x}} Y {{y}}{how}: "
    effect, lengths = start.effect
    remedy = _remedy(code, f"{text}look-ahead {start.value} then {effect}.")
    return (replace(remedy, segment=start.segment, at=start.at, lengths=lengths),)


def _tool_sentences(setup: CuttingSetup, nearest: Row, progress: Progress) -> Iterator[Finding]:
    """Yield the largest tool that fits, then a larger one that fits without blend moves, which needs more changes.

    Both are searched for with another start if the contour's own is an inside corner.
    """
    where = ""
    if _starts_at_inside_corner(nearest):
        row = longest_segments(setup.surface)[0]
        where = f" when the contour is started in the middle of segment {setup.surface.numbers[row]:g}"
        setup = replace(setup, surface=restarted(setup.surface, row))
    tool = largest_tool(setup, progress)
    larger = larger_tool_without_blends(setup, tool, progress)
    for fits, code, blends in ((tool, "TOOL_FITS", ""), (larger, "TOOL_BLENDLESS", f" {_NO_BLENDS}")):
        if fits is not None:
            largest = f"the largest that does not gouge{blends}{where}: {{value}}, with look-ahead {fits.value}."
            text = f"Tool too big; {largest}{fits.left_uncut}"
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


def _nothing_helps(*, closed: bool) -> Finding:
    """Return only what has been tried without success: the trials are bounded, and a number may be mistyped."""
    tried = "No look-ahead, start or tool" if closed else "No look-ahead or tool"
    text = f"{tried} was found that works. Check the contour's numbers."
    return Finding("NOTHING_HELPS", Severity.WARNING, text)


def _remedy(code: str, text: str) -> Finding:
    return Finding(code, Severity.INFO, text)
