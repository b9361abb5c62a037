"""Written programs are contours for a control that compensates by itself, confirmed by reading them back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

from core.comp.compensated import Compensated
from core.controls.registry import is_klartext
from core.controls.write import iso_program, klartext_program
from core.controls.write.contour_pass import (
    CompensatedPass,
    PassToWrite,
    PassWithLeads,
    UncompensatedPass,
    not_written,
    path_begin,
    path_finish,
    programmed_elements,
)
from core.controls.write.iso_program import tools_of
from core.controls.write.iso_style import STYLE_OF_CONTROL, IsoStyle
from core.controls.write.lead_moves import ProtectedContour, clear_leads, merged, with_blends
from core.controls.write.read_back import ComparedPaths, Intended, read_back
from core.finding import Finding, Severity
from core.units import Unit, located_sentence, to_mm

Remarks = Callable[[Sequence[Finding]], Sequence[str]]
"""A function that makes a program's first lines from the notes on it."""

WRITTEN_AGAIN: Final = 2
"""Most times that a program is written, because its own first lines contain the notes on it."""


@dataclass(frozen=True, slots=True)
class Posted:
    """NC text, the errors that were overridden to get it, and notes for the operator."""

    text: str
    overridden: tuple[Finding, ...] = ()
    notes: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why nothing was posted; lengths in `text` are in `unit`."""

    findings: tuple[Finding, ...]
    unit: Unit

    @property
    def text(self) -> str:
        """Every reason as a sentence, with its block and its segment."""
        return " ".join(located_sentence(finding, self.unit) for finding in self.findings)


def write_program(
    cuts: Sequence[PassToWrite], control: str, unit: Unit, name: str, remarks: Remarks, work_offset: int = 54
) -> Posted | Refusal:
    """Return the program for a control, by full name; `remarks` makes its first lines from the notes on it.

    The work offset is 54 to 59; Klartext has none.
    """
    if is_klartext(control):
        return _klartext(cuts, control, unit, name, remarks)
    return _iso(cuts, control, unit, work_offset, remarks)


def _klartext(cuts: Sequence[PassToWrite], control: str, unit: Unit, name: str, remarks: Remarks) -> Posted | Refusal:
    digit = to_mm(10.0 ** -klartext_program.KLARTEXT_DECIMALS[unit], unit)

    def write(notes: Sequence[Finding]) -> Intended | Finding:
        lines = klartext_program.write_klartext(cuts, name, unit, remarks(notes))
        if isinstance(lines, Finding):
            return lines
        return Intended(control, lines, tuple(cuts), {}, unit, digit, leads=False)

    return _confirmed(write, unit)


def _iso(cuts: Sequence[PassToWrite], control: str, unit: Unit, work_offset: int, remarks: Remarks) -> Posted | Refusal:
    style = STYLE_OF_CONTROL[control]
    led: dict[Compensated, PassWithLeads | Finding] = {}
    runs, refusals = list[PassWithLeads | UncompensatedPass](), dict[Finding, None]()
    for cut in cuts:
        if isinstance(cut, UncompensatedPass):
            runs.append(cut)
            continue
        # all cuts of a contour share its leads
        if cut.compensated not in led:
            led[cut.compensated] = _with_clear_leads(cut, style)
        run = led[cut.compensated]
        if isinstance(run, Finding):
            refusals[replace(run, block=cut.block)] = None
        else:
            runs.append(replace(run, contour_pass=cut))
    if refusals:
        return Refusal(tuple(refusals), unit)
    digit = to_mm(10.0 ** -style.digits(unit), unit)

    def write(notes: Sequence[Finding]) -> Intended:
        lines = iso_program.write_iso(runs, style, unit, remarks(notes), work_offset)
        return Intended(control, lines, tuple(cuts), tools_of(cuts, style), unit, digit, leads=True)

    return _confirmed(write, unit)


def _with_clear_leads(cut: CompensatedPass, style: IsoStyle) -> PassWithLeads | Finding:
    """Return the cut with the longest leads that cut nothing, or why there is none."""
    compensated, radius = cut.compensated, cut.compensated.radius
    first, last = path_begin(compensated), path_finish(compensated)
    surface = ProtectedContour(compensated.contour, compensated.side, cut.diameter / 2)
    leads = clear_leads(first, last, style, radius, surface, longest=cut.longest_lead)
    if isinstance(leads, float):
        text = "There is no room for the straight move into the cut and out of it: it gouges by {0}."
        start = "Start" if first.blend else "Enter BLEND OFFSET, start"
        text += f" {start} elsewhere, take a smaller tool, or post the center path."
        return not_written(text, lengths=(leads,))
    shape = programmed_elements(compensated)
    if isinstance(shape, Finding):
        return shape
    ends = shape.segments[0], shape.segments[-1]
    shape = with_blends(merged(shape) if style.merged else shape, first, last, radius, ends)
    return PassWithLeads(cut, compensated.side, shape, leads[0], first.corner, leads[1])


def _confirmed(write: Callable[[Sequence[Finding]], Intended | Finding], unit: Unit) -> Posted | Refusal:
    """Return the program, with the notes in it, once its control confirms it."""
    notes: tuple[Finding, ...] = ()
    compared: ComparedPaths = {}
    for _ in range(WRITTEN_AGAIN):
        intended = write(notes)
        if isinstance(intended, Finding):
            return Refusal((intended,), unit)
        answer = read_back(intended, compared)
        if errors := tuple(finding for finding in answer if finding.severity is Severity.ERROR):
            return Refusal(errors, unit)
        if answer == notes:
            break
        notes = answer
    return Posted(intended.text, notes=notes)
