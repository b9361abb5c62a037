"""Contours as the program of a control that compensates by itself: leads chosen, text written, text read back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

from core.controls.control_tools import ToolTable
from core.controls.write import iso_program, klartext_program
from core.controls.write.iso_leads import Ready, out_of, ready, start_of
from core.controls.write.iso_program import Frame, offsets, tools_of
from core.controls.write.iso_style import STYLES, Entry, IsoStyle
from core.controls.write.programmed_contour import Cut, Line, Plain, begin, finish, refusal
from core.controls.write.read_back import Meant, read_back
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Line as Straight
from core.tolerance import GOUGE
from core.units import to_mm
from core.verify.judge import judge

REACHES: Final = (2.0, 1.25, 1.05, 0.5, 0.25, 0.1)
"""Lengths of the move into the cut, in radii, longest first; the first that cuts nothing is taken."""

LONGER: Final = 1.0
"""Radii that the entry has to be longer than where it ends square to itself."""

Remarks = Callable[[Sequence[Finding]], Sequence[str]]
"""From the notes on a program to its first lines."""


@dataclass(frozen=True, slots=True)
class Own:
    """A program that was read back, and what is to be said with it."""

    text: str
    notes: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True)
class NotWritten:
    """Why there is no program."""

    findings: tuple[Finding, ...]


def write_own(cuts: Sequence[Cut | Plain], control: str, frame: Frame, name: str, remarks: Remarks) -> Own | NotWritten:
    """The program of a control by its full name; `remarks` makes its first lines of the notes on it."""
    if control == "klartext":
        return _klartext(cuts, frame, name, remarks)
    return _iso(cuts, control, frame, remarks)


def _klartext(cuts: Sequence[Cut | Plain], frame: Frame, name: str, remarks: Remarks) -> Own | NotWritten:
    decimals = klartext_program.DECIMALS[frame.unit]

    def meant(notes: Sequence[Finding]) -> Meant | Finding:
        lines = klartext_program.write(cuts, name, frame.unit, remarks(notes))
        return lines if isinstance(lines, Finding) else _meant(lines, "klartext", cuts, ToolTable(), frame, decimals)

    return _confirmed(meant)


def _iso(cuts: Sequence[Cut | Plain], control: str, frame: Frame, remarks: Remarks) -> Own | NotWritten:
    style = STYLES[control]
    shared = _shared(cuts)
    found = [_led(cut, style, offsets(cuts, style)[cut.tool, cut.stock]) for cut in shared]
    against = tuple(dict.fromkeys(one for one in found if isinstance(one, Finding)))
    if against:
        return NotWritten(against)
    by_run = {id(cut.compensated): one for cut, one in zip(shared, found, strict=True) if isinstance(one, Ready)}
    every = [cut if isinstance(cut, Plain) else replace(by_run[id(cut.compensated)], cut=cut) for cut in cuts]
    frame = replace(frame, corners=_corners(control))

    def meant(notes: Sequence[Finding]) -> Meant:
        lines = iso_program.write(every, style, frame, remarks(notes))
        return _meant(lines, control, cuts, tools_of(cuts, style), frame, style.digits(frame.unit))

    return _confirmed(meant)


def _shared(cuts: Sequence[Cut | Plain]) -> Sequence[Cut]:
    """One cut of each compensated run."""
    return list({id(cut.compensated): cut for cut in cuts if isinstance(cut, Cut)}.values())


def _corners(control: str) -> str:
    """G39 or G39.1, where a control has them: what was in force before does not count then."""
    if not control.startswith("nine-series"):
        return ""
    return "G39.1" if control.endswith("g39.1") else "G39"


def _led(cut: Cut, style: IsoStyle, offset: int) -> Ready | Finding:
    """The cut with the longest leads that cut nothing."""
    first, last = begin(cut.compensated), finish(cut.compensated)
    one, radius = cut.compensated, cut.compensated.radius
    depth = 0.0
    for reach in REACHES:
        if style.entry is Entry.OWN and reach <= LONGER:
            continue
        start, out = start_of(first, style, reach * radius), out_of(last, reach * radius)
        leads = (Path.from_pieces([Straight(*ends)]) for ends in ((start, first.at), (last.at, out)))
        verdicts = [judge(one.contour, one.side, cut.diameter / 2, lead) for lead in leads]
        depth = max(verdict.depth for verdict in verdicts)
        if all(verdict.judged for verdict in verdicts) and depth <= GOUGE:
            return ready(cut, style, reach * radius, offset)
    text = "There is no room for the straight move into the cut and out of it: it gouges by {0}."
    text += " Start elsewhere." if first.blend else " Enter BLEND OFFSET, or start elsewhere."
    return refusal(text, lengths=(depth,))


def _meant(
    lines: tuple[Line, ...], control: str, cuts: Sequence[Cut | Plain], tools: ToolTable, frame: Frame, decimals: int
) -> Meant:
    digit = to_mm(10.0**-decimals, frame.unit)
    return Meant(control, lines, tuple(cuts), tools, frame.unit, digit, leads=control != "klartext")


def _confirmed(make: Callable[[Sequence[Finding]], Meant | Finding]) -> Own | NotWritten:
    """The program once the control agrees, and once more with the notes in it."""
    notes: tuple[Finding, ...] = ()
    for _ in range(2):
        meant = make(notes)
        if isinstance(meant, Finding):
            return NotWritten((meant,))
        told = read_back(meant)
        if told.errors:
            return NotWritten(told.errors)
        if told.notes == notes:
            break
        notes = told.notes
    return Own(meant.text, notes)
