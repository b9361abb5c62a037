"""Contour translation writes a run's contours for a control of another language, so that both can be compared.

The contour keeps the side and the radius of the run, and each stretch gets a move into it and out of it that the other
control allows; everything else in the program is left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.control_run import ControlRun, Stretch
from core.controls.control_tools import ToolTable
from core.controls.registry import UnknownControl, run
from core.controls.write.contour_pass import PassWithLeads, WrittenLine
from core.controls.write.iso_program import Frame, tools_of, write_iso
from core.controls.write.iso_style import FREE_ENTRY, STYLES
from core.controls.write.klartext_program import KLARTEXT_DECIMALS, write_klartext_contours
from core.controls.write.rewritten_stretch import NotTranslated, RewrittenStretch, stretch_to_rewrite, with_leads
from core.units import to_mm

MAX_TOOLS: Final = 24
"""Number of tools that every control has."""


@dataclass(frozen=True, eq=False, slots=True)
class TranslatedProgram:
    """The text for the other control; for each line the program's line (0 for none), and whether it only leads.

    `tools` is the table that the text needs, `digit` its last decimal place in millimeters.
    """

    lines: tuple[WrittenLine, ...]
    sources: tuple[int, ...]
    leads: tuple[bool, ...]
    tools: ToolTable
    digit: float


def translate_contours(source: ControlRun, control: str) -> TranslatedProgram | NotTranslated:
    """Return the contours of a run as a program for a control, by full name, in the run's unit."""
    if not source.stretches:
        return NotTranslated("the program has no compensated contour")
    sizes = list(dict.fromkeys(stretch.radius for stretch in source.stretches))
    if len(sizes) > MAX_TOOLS:
        return NotTranslated(f"its contours need more than {MAX_TOOLS} tools")
    style = STYLES.get(control)
    programmed: list[RewrittenStretch] = []
    runs: list[PassWithLeads] = []
    for stretch in source.stretches:
        elements = stretch_to_rewrite(source, stretch, sizes.index(stretch.radius) + 1)
        if isinstance(elements, NotTranslated):
            return elements
        run_led = with_leads(elements, style or FREE_ENTRY, blends=style is not None)
        if isinstance(run_led, NotTranslated):
            return run_led
        programmed.append(elements)
        runs.append(run_led)
    return _written(source, control, programmed, runs)


def _written(
    source: ControlRun, control: str, programmed: list[RewrittenStretch], runs: list[PassWithLeads]
) -> TranslatedProgram:
    style, unit = STYLES.get(control), source.unit
    if style is None:
        lines, tools, decimals = write_klartext_contours(runs, unit), ToolTable(), KLARTEXT_DECIMALS[unit]
    else:
        lines, decimals = write_iso(runs, style, Frame(unit)), style.digits(unit)
        tools = tools_of([run_led.contour_pass for run_led in runs], style)
    sources, leads = _sources(lines, programmed)
    return TranslatedProgram(lines, sources, leads, tools, to_mm(10.0**-decimals, unit))


def _sources(
    lines: tuple[WrittenLine, ...], programmed: list[RewrittenStretch]
) -> tuple[tuple[int, ...], tuple[bool, ...]]:
    """Return for each line the program's line, and whether it is a lead; a run ends with its lead-out line."""
    sources, leads = [], []
    run_index, inside = 0, False
    for line in lines:
        if line.segment is None:
            sources.append(0)
            leads.append(True)
            continue
        numbers = programmed[run_index].lines
        sources.append(numbers[min(max(int(line.segment), 1), len(numbers)) - 1])
        leads.append(line.lead or not 1 <= line.segment <= len(numbers))
        if line.lead and inside:
            run_index += 1
        inside = inside != line.lead
    return tuple(sources), tuple(leads)


def run_by_contour(source: ControlRun, control: str) -> tuple[ControlRun, float] | NotTranslated:
    """Run a run's contours on a control of another language; return this run and its last decimal place.

    Lines are those of the first run; moves of leads, and everything that belongs to no contour, have line 0.
    """
    program = translate_contours(source, control)
    if isinstance(program, NotTranslated):
        return program
    text = "".join(f"{line.text}\n" for line in program.lines)
    made = run(text.encode("ascii"), control, program.tools, source.unit)
    assert not isinstance(made, UnknownControl), made.text
    return _by_source_lines(made, program), program.digit


def _by_source_lines(made: ControlRun, program: TranslatedProgram) -> ControlRun:
    """Return the run with the lines of the program that the contours come from."""
    sources, leads = np.array([0, *program.sources], np.int32), np.array([True, *program.leads])
    findings = tuple(
        replace(finding, line=_source(program, finding.line), column=None) if finding.line else finding
        for finding in made.findings
    )
    return replace(
        made,
        moves=replace(made.moves, lines=np.where(leads, 0, sources).astype(np.int32)[made.moves.lines]),
        findings=findings,
        stopped_at=None if made.stopped_at is None else _source(program, made.stopped_at),
        stretches=tuple(_stretch(stretch, sources, leads) for stretch in made.stretches),
    )


def _stretch(stretch: Stretch, sources: NDArray[np.int32], leads: NDArray[np.bool_]) -> Stretch:
    """Return a stretch with the program's lines; arcs that lead in and out count as leads, not as surface."""
    lines = stretch.programmed.lines
    last = len(lines) - 1
    inner = np.flatnonzero(~leads[lines[1:]]) + 1
    entry, end = (int(inner[0]) - 1, int(inner[-1])) if len(inner) else (last, last)
    programmed = replace(stretch.programmed, lines=sources[lines])
    return replace(stretch, programmed=programmed, entry=entry, exit=last - end, led_in=True, led_out=True)


def _source(program: TranslatedProgram, line: int) -> int:
    """Return the program's line that a line of the text comes from or follows; before any, the first one."""
    before = [source for source in program.sources[:line] if source]
    return before[-1] if before else next(source for source in program.sources if source)
