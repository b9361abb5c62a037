"""A run's contours told to a control of another language, so that programs of both can be compared.

What is told is the contour with the side and the radius of the run, each stretch with a move into it and out of it
that the other control allows; everything else of the program is left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.control_run import Run, Stretch
from core.controls.control_tools import ToolTable
from core.controls.registry import UnknownControl, run
from core.controls.write.iso_leads import Ready
from core.controls.write.iso_program import Frame, tools_of, write
from core.controls.write.iso_style import STYLES
from core.controls.write.klartext_program import DECIMALS, write_led
from core.controls.write.programmed_contour import Line
from core.controls.write.traced import Traced, Untold, led, traced
from core.units import to_mm

MOST_TOOLS: Final = 24
"""Tools that every control has."""


@dataclass(frozen=True, eq=False, slots=True)
class Translated:
    """The text for the other control; of each of its lines the program's line, 0 for none, and whether it only leads.

    `tools` is what the text counts on, `digit` how fine its numbers are, in millimeters.
    """

    lines: tuple[Line, ...]
    places: tuple[int, ...]
    leads: tuple[bool, ...]
    tools: ToolTable
    digit: float


def translated(source: Run, control: str) -> Translated | Untold:
    """The contours of a run as a program of a control by its full name, in the run's unit."""
    if not source.stretches:
        return Untold("the program has no compensated contour")
    sizes = list(dict.fromkeys(stretch.radius for stretch in source.stretches))
    if len(sizes) > MOST_TOOLS:
        return Untold(f"its contours need more than {MOST_TOOLS} tools")
    style = STYLES.get(control)
    every: list[Traced] = []
    runs: list[Ready] = []
    for stretch in source.stretches:
        one = traced(source, stretch, sizes.index(stretch.radius) + 1)
        if isinstance(one, Untold):
            return one
        ready = led(one, style or STYLES["rosettacnc:easy"], blends=style is not None)
        if isinstance(ready, Untold):
            return ready
        every.append(one)
        runs.append(ready)
    return _written(source, control, every, runs)


def _written(source: Run, control: str, every: list[Traced], runs: list[Ready]) -> Translated:
    style, unit = STYLES.get(control), source.unit
    if style is None:
        lines, tools, decimals = write_led(runs, unit), ToolTable(), DECIMALS[unit]
    else:
        lines, decimals = write(runs, style, Frame(unit)), style.digits(unit)
        tools = tools_of([one.cut for one in runs], style)
    places, leads = _places(lines, every)
    return Translated(lines, places, leads, tools, to_mm(10.0**-decimals, unit))


def _places(lines: tuple[Line, ...], every: list[Traced]) -> tuple[tuple[int, ...], tuple[bool, ...]]:
    """Of each line the program's line, and whether it is a lead; a run ends with the line that leads out of it."""
    places, leads = [], []
    at, inside = 0, False
    for line in lines:
        if line.segment is None:
            places.append(0)
            leads.append(True)
            continue
        of = every[at].lines
        places.append(of[min(max(int(line.segment), 1), len(of)) - 1])
        leads.append(line.lead or not 1 <= line.segment <= len(of))
        if line.lead and inside:
            at += 1
        inside = inside != line.lead
    return tuple(places), tuple(leads)


def run_by_contour(source: Run, control: str) -> tuple[Run, float] | Untold:
    """A run's contours on a control of another language, told by the lines of the run; and how fine they are written.

    Moves of the leads, and everything that is not of a contour, have line 0.
    """
    found = translated(source, control)
    if isinstance(found, Untold):
        return found
    text = "".join(f"{line.text}\n" for line in found.lines)
    made = run(text.encode("ascii"), control, found.tools, source.unit)
    assert not isinstance(made, UnknownControl), made.text
    return _told(made, found), found.digit


def _told(made: Run, found: Translated) -> Run:
    """The run with the lines of the program that the contours are from."""
    where = np.array([0, *found.places], np.int32)
    led_to = np.where(np.array([True, *found.leads]), 0, where).astype(np.int32)
    findings = tuple(
        one if one.line is None else replace(one, line=_nearest(found, one.line), column=None) for one in made.findings
    )
    stretches = tuple(_stretch(one, where, np.array([True, *found.leads])) for one in made.stretches)
    return replace(
        made,
        moves=replace(made.moves, lines=led_to[made.moves.lines]),
        findings=findings,
        stopped_at=None if made.stopped_at is None else _nearest(found, made.stopped_at),
        stretches=stretches,
    )


def _stretch(one: Stretch, where: NDArray[np.int32], leads: NDArray[np.bool_]) -> Stretch:
    """A stretch with the program's lines, the arcs that lead in and out counted as leads: they are no surface."""
    lines = one.programmed.lines
    inner = np.flatnonzero(~leads[lines[1:]]) + 1
    entry, behind = (int(inner[0]) - 1, int(inner[-1])) if len(inner) else (len(lines) - 1, len(lines) - 1)
    programmed = replace(one.programmed, lines=where[lines])
    return replace(
        one, programmed=programmed, entry=entry, exit=len(lines) - 1 - behind, led_in=True, led_out=True
    )  # fmt: skip


def _nearest(found: Translated, line: int) -> int:
    """The program's line that a line of the text is from or stands behind, the first one for what stands before all."""
    before = [place for place in found.places[:line] if place]
    return before[-1] if before else next(place for place in found.places if place)
