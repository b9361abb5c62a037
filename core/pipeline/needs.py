"""What a contour needs: why the calculated look-ahead is not clean, and what would help where no value is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import ceil
from typing import Final, NamedTuple

from core.comp.result import Deleted
from core.finding import Finding, Severity
from core.pipeline.derived import DerivedBlock
from core.pipeline.remedies import (
    StartMoved,
    ToolFits,
    Unwanted,
    always,
    bare_start,
    larger_bare_tool,
    largest_tool,
    longest,
    start_at_end,
    start_mid_side,
    started,
    without_blends,
)
from core.pipeline.table import Row, Table, Trial, table_of, trial_of
from core.program.model import Program

NAMED_AT_MOST: Final = 4
"""So many places that are too small are named in sentences."""

_BARE: Final = "without blend moves (BLEND OFFSET 0)"


@dataclass(frozen=True, eq=False, slots=True)
class Needs:
    """Sentences for the operator, and what they say.

    `why` tells why CAL's value is not clean, empty when it is.  The rest is there only when no value is clean:
    `small` names inside radii and corners the tool does not enter, `tool`, `start`, `blendless` (a look-ahead that is
    clean without blend moves) and `shut` (START typed anew) are remedies that have been tried and judged clean, None
    where none was found.  Where neither another start nor leaving out the blend moves helps, `bare_start` is both at
    once.  A tool is looked for when no other remedy helps, from the middle of a side where the start is an inside
    corner, with the blend moves and, as `bare_tool`, a larger one without them; another START of an open contour when
    no tool is found either.
    """

    why: tuple[Finding, ...]
    small: tuple[Finding, ...] = ()
    tool: ToolFits | None = None
    start: StartMoved | None = None
    blendless: int | None = None
    shut: StartMoved | None = None
    bare_start: StartMoved | None = None
    bare_tool: ToolFits | None = None
    sentences: tuple[Finding, ...] = ()


def needs(
    found: DerivedBlock, program: Program, table: Table | None = None, *, wanted: Callable[[], bool] = always
) -> Needs | None:
    """What a derived block needs; `table` is its look-ahead table where that is known.  None where there is none.

    `wanted` is asked before each remedy is tried: where it says no, the rest is not tried and the answer is None.
    """
    trial = trial_of(found, program)
    if trial is None:
        return None
    try:
        return needs_of(trial, found.lookahead.calculated, table or table_of(trial), wanted)
    except Unwanted:
        return None


def needs_of(trial: Trial, calculated: int, table: Table, wanted: Callable[[], bool] = always) -> Needs:
    """What a contour needs whose look-ahead table is known; nothing where it could not be offset at all.

    Raises Unwanted where `wanted` says no before a remedy is tried.
    """
    if not len(table.rows[0].compensated.raw):
        return Needs(())
    why = why_not_clean(table, calculated)
    if table.recommended is not None:
        return Needs(why, sentences=why)
    nearest = min(table.rows, key=lambda row: (row.gouge, row.value))
    small = _small(nearest, trial.radius)
    blendless, start = without_blends(trial, wanted), start_mid_side(trial, wanted)
    free = bare_start(trial, wanted) if start is None and blendless is None else None
    alone = start is None and blendless is None and free is None
    tools = _tools(trial, nearest, small, wanted) if alone else _Tools(None, None, "")
    found = (*_blends_said(blendless), *_start_said(start), *_start_said(free, bare=True), *_tools_said(tools))
    shut = None if found else start_at_end(trial, wanted)
    remedies = found or (_shut_said(shut) if shut is not None else _nothing(closed=trial.closed),)
    told = (*why, *_some(small), *remedies)
    return Needs(why, small, tools.tool, start, blendless, shut, free, tools.bare, told)


class _Tools(NamedTuple):
    """The largest tool, a larger one that fits without blend moves, and where the contour is started for them."""

    tool: ToolFits | None
    bare: ToolFits | None
    where: str


def _tools(trial: Trial, nearest: Row, small: tuple[Finding, ...], wanted: Callable[[], bool]) -> _Tools:
    """The largest tools, with another start where the contour's own is an inside corner."""
    hint, where = min((one.value for one in small if one.value is not None), default=None), ""
    if any(one.code == "START_INSIDE_CORNER" for one in nearest.compensated.findings):
        row = longest(trial.surface)[0]
        where = f" when the contour is started in the middle of segment {trial.surface.numbers[row]:g}"
        trial = replace(trial, surface=started(trial.surface, row))
    tool = largest_tool(trial, hint, wanted)
    return _Tools(tool, larger_bare_tool(trial, tool, hint, wanted), where)


def _some(small: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """The first of many places that are too small, and how many there are."""
    if len(small) <= NAMED_AT_MOST:
        return small
    return (*small[:NAMED_AT_MOST], replace(small[0], text=f"There are {len(small)} such places.", segment=None))


def why_not_clean(table: Table, calculated: int) -> tuple[Finding, ...]:
    """Why CAL's value is not clean: where it gouges, and which value would reach what crosses there."""
    row = table.row(calculated)
    if row.clean:
        return ()
    if not row.verdict.gouges:
        return (Finding("CAL_NOT_CLEAN", Severity.WARNING, f"CAL {calculated} makes no path that can be cut."),)
    gouge = row.verdict.gouges[0]
    where = f"CAL {calculated} gouges segment {gouge.surface_number:g} by {{value}} at X {{x}} Y {{y}}: "
    text = where + (_beyond(table, row) or _too_far(table, row) or _seam(row) or "no look-ahead reaches what is wrong.")
    number, at = gouge.surface_number, gouge.surface_at
    return (Finding("CAL_NOT_CLEAN", Severity.WARNING, text, number, at=at, value=gouge.depth),)


def _beyond(table: Table, row: Row) -> str:
    """The crossing a larger value tests about the deepest gouge, if that value is clean."""
    number = row.verdict.gouges[0].path_number
    for later in table.rows:
        if later.value > row.value and later.clean:
            hit = _around(later, number)
            if hit is None:
                return f"look-ahead {later.value} is clean."
            apart = ceil(hit.by[1] - hit.by[0])
            return f"{_crossing(hit)}, {apart} apart, and the look-ahead has to reach {later.value}."
    return ""


def _around(row: Row, number: float) -> Deleted | None:
    return next((one for one in row.compensated.deleted if one.by[0] <= number <= one.by[1]), None)


def _crossing(one: Deleted) -> str:
    return f"the paths of {_piece(one.by[0])} and {_piece(one.by[1])} cross"


def _piece(number: float) -> str:
    return f"segment {number:g}" if number == int(number) else f"the corner after segment {int(number)}"


def _too_far(table: Table, row: Row) -> str:
    """What the calculated value deletes that a smaller, clean one keeps."""
    if table.recommended is None or table.recommended > row.value:
        return ""
    hit = next(iter(row.compensated.deleted), None)
    if hit is None:
        return f"look-ahead {table.recommended} is clean."
    return f"{_crossing(hit)} and erase what is between; look-ahead {table.recommended} keeps it and is clean."


def _seam(row: Row) -> str:
    if not any(one.code == "START_INSIDE_CORNER" for one in row.compensated.findings):
        return ""
    return "the contour starts at an inside corner, and its first and last segments are never tested."


def _small(row: Row, radius: float) -> tuple[Finding, ...]:
    """The inside radii and corners the tool does not enter, where the path gouges least."""
    told = []
    for one in row.compensated.findings:
        if one.code == "VANISHED" and one.segment is not None:
            text = f"The inside radius {{value}} of segment {one.segment:g} is smaller than the tool's {{0}}."
            told.append(replace(one, code="TOO_SMALL", text=text, lengths=(radius,)))
        if one.code == "CORNER_MISSED" and one.segment is not None:
            text = f"The tool does not fit into the inside corner after segment {int(one.segment)}."
            told.append(replace(one, code="TOO_SMALL", text=text))
    return tuple(told)


def _blends_said(value: int | None) -> tuple[Finding, ...]:
    if value is None:
        return ()
    return (_remedy("BLENDLESS", f"W{_BARE[1:]} look-ahead {value} is clean."),)


def _start_said(start: StartMoved | None, *, bare: bool = False) -> tuple[Finding, ...]:
    if start is None:
        return ()
    how = f", {_BARE}" if bare else ""
    text = f"Start in the middle of segment {start.segment:g}, at X {{x}} Y {{y}}{how}: "
    code = "START_BLENDLESS" if bare else "START_MID_SIDE"
    remedy = _remedy(code, f"{text}look-ahead {start.value} is then clean.")
    return (replace(remedy, segment=start.segment, at=start.at),)


def _tools_said(tools: _Tools) -> Iterator[Finding]:
    """The larger one, which needs more to be changed, behind the other."""
    for tool, code, how in ((tools.tool, "TOOL_FITS", ""), (tools.bare, "TOOL_BLENDLESS", f" {_BARE}")):
        if tool is not None:
            text = f"A tool of {{value}} diameter fits{how}{tools.where}: look-ahead {tool.value} is then clean."
            yield replace(_remedy(code, text), field="tool", value=tool.diameter)


def _shut_said(shut: StartMoved) -> Finding:
    text = (
        "START may be mistyped: at X {x} Y {y}, where the contour ends, it would be closed, "
        f"and look-ahead {shut.value} clean."
    )
    return replace(_remedy("START_AT_END", text), segment=0.0, at=shut.at)


def _nothing(*, closed: bool) -> Finding:
    """What has been tried in vain, and no more: the tries are bounded, and a number may be mistyped."""
    tried = "No smaller tool and no start in the middle of a long side was" if closed else "No smaller tool was"
    text = f"{tried} found to help: check the numbers of the contour, those of START too."
    return Finding("NOTHING_HELPS", Severity.WARNING, text)


def _remedy(code: str, text: str) -> Finding:
    return Finding(code, Severity.INFO, text)
