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
from core.controls.registry import run
from core.controls.write.contour_pass import PassWithLeads, WrittenLine
from core.controls.write.iso_program import tools_of, write_iso
from core.controls.write.iso_style import FREE_ENTRY, STYLE_OF_CONTROL
from core.controls.write.klartext_program import KLARTEXT_DECIMALS, write_klartext_contours
from core.controls.write.rewritten_stretch import NotTranslated, rewritten_stretch
from core.units import to_mm

MAX_TOOLS: Final = 24
"""Number of tools that every control has."""


@dataclass(frozen=True, eq=False, slots=True)
class TranslatedProgram:
    """The text for the other control, the table of tools that it needs, and its last decimal place in millimeters.

    A line's segment is the number of its element, negative for an arc that only leads to it; `sources` has the
    program's line of each element, and 0 for lines of no element.
    """

    lines: tuple[WrittenLine, ...]
    sources: tuple[int, ...]
    tools: ToolTable
    digit: float


def translate_contours(source: ControlRun, control: str) -> TranslatedProgram | NotTranslated:
    """Return the contours of a run as a program for a control, by full name, in the run's unit."""
    if not source.stretches:
        return NotTranslated("the program has no compensated contour")
    sizes = list(dict.fromkeys(stretch.radius for stretch in source.stretches))
    if len(sizes) > MAX_TOOLS:
        return NotTranslated(f"its contours need more than {MAX_TOOLS} tools")
    style, unit = STYLE_OF_CONTROL.get(control), source.unit
    runs, sources = list[PassWithLeads](), [0]
    for stretch in source.stretches:
        tool = sizes.index(stretch.radius) + 1
        before = len(sources) - 1
        run_led = rewritten_stretch(source, stretch, tool, before, style or FREE_ENTRY, blends=style is not None)
        if isinstance(run_led, NotTranslated):
            return run_led
        sources += stretch.programmed.lines[1:].tolist()
        runs.append(run_led)
    if style is None:
        lines, decimals = write_klartext_contours(runs, unit), KLARTEXT_DECIMALS[unit]
        tools: ToolTable = {}
    else:
        lines, decimals = write_iso(runs, style, unit), style.digits(unit)
        tools = tools_of([run_led.contour_pass for run_led in runs], style)
    return TranslatedProgram(lines, tuple(sources), tools, to_mm(10.0**-decimals, unit))


def run_by_contour(source: ControlRun, control: str) -> tuple[ControlRun, float] | NotTranslated:
    """Run a run's contours on a control of another language; return this run and its last decimal place.

    Lines are those of the first run; moves of leads, and everything that belongs to no contour, have line 0.
    """
    program = translate_contours(source, control)
    if isinstance(program, NotTranslated):
        return program
    text = "".join(f"{line.text}\n" for line in program.lines)
    made = run(text.encode("ascii"), control, program.tools, source.unit)
    return _by_source_lines(made, program), program.digit


def _by_source_lines(made: ControlRun, program: TranslatedProgram) -> ControlRun:
    """Return the run with the lines of the program that the contours come from."""
    segments = [int(line.segment or 0) for line in program.lines]
    sources = np.array([0, *(program.sources[abs(segment)] for segment in segments)], np.int32)
    leads = np.array(
        [True, *(line.lead or segment <= 0 for line, segment in zip(program.lines, segments, strict=True))]
    )

    def source(line: int) -> int:
        """Return the program's line that a line of the text comes from or follows; before any, the first one."""
        rows = np.flatnonzero(sources)
        return int(sources[rows[max(int(np.searchsorted(rows, line, side="right")) - 1, 0)]])

    findings = tuple(
        replace(finding, line=source(finding.line), column=None) if finding.line else finding
        for finding in made.findings
    )
    return replace(
        made,
        moves=replace(made.moves, lines=np.where(leads, 0, sources).astype(np.int32)[made.moves.lines]),
        findings=findings,
        stopped_at=None if made.stopped_at is None else source(made.stopped_at),
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
