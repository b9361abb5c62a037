"""Finds the largest tool that fits: runs an NC program with smaller and smaller sizes of a tool that is too big."""

from __future__ import annotations

import re
from dataclasses import replace
from math import ceil
from typing import Final

from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, ToolTable, tool_id
from core.controls.iso.flow import ProgramLibrary
from core.controls.judging.judged_runs import deepest_gouge, judge_run
from core.controls.registry import UnknownControl, run
from core.finding import Finding, Severity
from core.progress import Progress, silent
from core.units import Kind, Unit, decimals_shown, from_mm, to_mm

MAX_MOVES: Final = 2_000
"""Most moves, and most lines, of a program that is run again and again."""

MAX_TOOLS: Final = 8
"""Most tools of a program that are tried."""

MAX_REDUCTION: Final = 20
"""The smallest size tried is the diameter divided by this: with a tiny tool every fault looks small."""

_NAMED: Final = re.compile(rb'(?:[TD]|CALL|DEF)\s*(?:(\d+)|"([^"]+)")', re.IGNORECASE)
"""How a program names a tool or an offset."""


def largest_tool(
    text: bytes,
    done: ControlRun,
    tools: ToolTable,
    library: ProgramLibrary,
    unit: Unit | None,
    progress: Progress = silent,
) -> Finding | None:
    """Return the tool that is too big for a program that alarms or gouges, and the largest diameter that is clean.

    `done` is the run with the tools as they are.  None if no smaller tool helps: the fault is a different one.
    Each trial reports its own `progress`: the number of trials is not known beforehand.
    """
    if len(done.moves) > MAX_MOVES or text.count(b"\n") > MAX_MOVES:
        return None

    step = 10.0 ** -decimals_shown(Kind.LENGTH, done.unit)

    def fits(tool: CutterTool, size: int) -> bool:
        diameter = step * size if tool.diameter > 0.0 else -step * size
        trial = tools.with_tools(ToolTable.of(replace(tool, diameter=diameter, unit=done.unit)))
        ran = run(text, done.control, trial, unit, library, progress=progress)
        if isinstance(ran, UnknownControl) or len(ran.moves) > MAX_MOVES or ran.stopped_at is not None:
            return False
        return deepest_gouge(judge_run(ran, progress))[0] == 0.0

    for tool in _named(text, tools):
        fails = ceil(from_mm(abs(tool.diameter_mm(done.unit)), done.unit) / step - 1e-6)
        clean = fails // MAX_REDUCTION
        if not clean or not fits(tool, clean):
            continue
        while fails - clean > 1:
            size = (clean + fails) // 2
            clean, fails = (size, fails) if fits(tool, size) else (clean, size)
        message = f"Tool {tool.number} is too big; the largest that does not gouge: {{0}}."
        return Finding("TOOL_FITS", Severity.INFO, message, lengths=(to_mm(step * clean, done.unit),))
    return None


def _named(text: bytes, tools: ToolTable) -> tuple[CutterTool, ...]:
    """Return the tools of the table that the text names."""
    names = dict.fromkeys(tool_id((number or name).decode(errors="replace")) for number, name in _NAMED.findall(text))
    named = map(tools.get, names)
    return tuple(tool for tool in named if tool is not None)[:MAX_TOOLS]
