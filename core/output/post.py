"""The program as ISO G-code that LinuxCNC runs: the tool center's path, no G41 or G42.

What every file states before anything moves: G17 XY plane, G20 or G21, G40 no cutter compensation, G49 no tool length,
the work offset, G80 no canned cycle, G90 absolute, G91.1 I and J from the arc's start, G94 feed a minute, and
G64 P: the machine may round a corner by no more than P.  Only inside corners of the path are corners, and rounding
those keeps the cutter off the part.  G43 H names the tool's own length offset, so that no other is in force.
The first move after a tool change is straight up.  G53 is not used: where its zero lies is the machine's affair.
There is no % line: LinuxCNC needs none, and a lone one would end the file.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from core.finding import Finding, Severity
from core.output.comment import comments
from core.output.grid import Grid
from core.output.job import Cutter, Job
from core.output.motion import Pass
from core.output.nc import Place, nc_lines
from core.output.override import OVERRIDE
from core.output.passes import clear_height, passes
from core.output.ready import forbidding, overridden
from core.units import Kind, Unit, from_mm, sentence, show

ROUNDING: Final = {Unit.IN: "0.0002", Unit.MM: "0.005"}
"""How far the machine may leave the path at a corner, in program units."""


@dataclass(frozen=True, slots=True)
class Posted:
    """NC text, the errors that were overridden to have it, and what is to be said with it."""

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
        """Every reason as a sentence, with its segment."""
        return " ".join(_sentence(finding, self.unit) for finding in self.findings)


def post(
    jobs: Sequence[Job], unit: Unit, *, name: str, part: str = "", override: str | None = None
) -> Posted | Refusal:
    """The NC text of all jobs, or the findings that forbid it.

    `name` is the program's name and `part` the PART NAME that stand at its head, in comments that nothing typed brings
    to life.
    `override` counts only if it is the sentence `core.output.ready.OVERRIDE`, and only against findings on a path that
    is known; the header then says what was overridden.
    """
    grid = Grid(unit)
    if not jobs:
        return Refusal((Finding("NO_BLOCK", Severity.ERROR, "There is no block to post."),), unit)
    against = forbidding(jobs, grid, override=override)
    if against:
        return Refusal(against, unit)
    safe, highest = max(job.safe_z for job in jobs), max(jobs, key=clear_height)
    level = [replace(job, safe_z=max(safe, clear_height(highest))) for job in jobs]
    waived = overridden(jobs)
    lines = (*_header(jobs, unit, titles(name, part), waived), *_raised(safe, highest, unit), *_body(level, grid))
    return Posted("\n".join(lines) + "\n", waived)


def titles(name: str, part: str) -> tuple[str, ...]:
    """What stands at the head of every NC file: the program's name, and the part's where it has one."""
    return (f"PROGRAM {name}", f"PART {part}") if part.strip() else (f"PROGRAM {name}",)


def _header(jobs: Sequence[Job], unit: Unit, head: tuple[str, ...], waived: tuple[Finding, ...]) -> Iterator[str]:
    for title in head:
        yield from comments(title)
    yield from comments("WRITTEN BY CUTCOMP.  THE PATH IS THAT OF THE TOOL CENTER: NO G41 OR G42")
    yield from comments(f"UNITS {'INCH' if unit is Unit.IN else 'MM'}")
    for cutter, role in _cutters(jobs).items():
        yield from comments(_told(cutter, role, unit))
    for job in jobs:
        yield from _about(job, unit)
    if waived:
        yield from comments(f"OVERRIDDEN BY THE OPERATOR: {OVERRIDE}")
    for finding in waived:
        yield from comments(f"OVERRIDDEN {finding.code}: {_sentence(finding, unit)}")
    yield from comments(f"G64 P{ROUNDING[unit]}: THE MACHINE MAY ROUND INSIDE CORNERS BY SO MUCH")


def _sentence(finding: Finding, unit: Unit) -> str:
    where = "" if finding.segment is None else f"Segment {finding.segment:g}: " if finding.segment else "START: "
    return f"{where}{sentence(finding, unit)}"


def _cutters(jobs: Sequence[Job]) -> dict[Cutter, str]:
    """Every tool once, in order of use, with what it does."""
    found: dict[Cutter, str] = {}
    for job in jobs:
        for cutter, role in ((job.cutter, "" if job.finisher is None else "ROUGH"), (job.finisher, "FINISH")):
            if cutter is not None:
                found.setdefault(cutter, role)
    return found


def _told(cutter: Cutter, role: str, unit: Unit) -> str:
    return f"TOOL {cutter.number} {cutter.type} DIAMETER {_length(cutter.diameter, unit)} {role}".rstrip()


def _about(job: Job, unit: Unit) -> Iterator[str]:
    comp = f"CUTTER COMP. {job.comp}" + (f" LOOKAHEAD {job.lookahead}" if job.lookahead else "")
    depth = f"Z {_length(job.z_start, unit)} TO {_length(job.z_bottom, unit)}"
    peck = f" PECK {_length(job.peck_depth, unit)}" if job.peck_depth > 0.0 else ""
    yield from comments(f"BLOCK {job.block} MILL CONTOUR {comp} {depth}{peck}")
    for note in job.notes:
        yield from comments(note)


def _raised(safe: float, highest: Job, unit: Unit) -> Iterator[str]:
    """Say so, and why, where SAFE Z alone would not clear every block; `highest` is the one that needs most."""
    clear = clear_height(highest)
    if clear > safe:
        over, top = _length(highest.retract_clearance, unit), _length(highest.z_start, unit)
        yield from comments(f"SAFE Z {_length(safe, unit)} RAISED TO {_length(clear, unit)}")
        yield from comments(f"THAT IS RETRACT CLEARANCE {over} OVER Z START {top}")


def _length(value: float, unit: Unit) -> str:
    return show(from_mm(value, unit), Kind.LENGTH, unit)


def _body(jobs: Sequence[Job], grid: Grid) -> Iterator[str]:
    inch = grid.unit is Unit.IN
    yield f"G17 {'G20' if inch else 'G21'} G40 G49 G{jobs[0].work_offset} G80 G90 G91.1 G94"
    yield f"G64 P{ROUNDING[grid.unit]}"
    place, tool, speed = Place(), None, 0.0
    for job in jobs:
        for one in passes(job):
            if one.cutter.number != tool:
                yield from _change(one, first=tool is None)
                tool, speed, place = one.cutter.number, one.speed, Place()
            elif one.speed != speed:
                yield f"S{_speed(one.speed)}"
                speed = one.speed
            yield from comments(_title(one, grid.unit))
            found = nc_lines(one.motions, place, grid)
            yield from found.lines
            place = found.place
    yield "M5"
    yield "M30"


def _change(one: Pass, *, first: bool) -> Iterator[str]:
    if not first:
        yield "M5"
    yield f"T{one.cutter.number} M6"
    yield f"G43 H{one.cutter.number}"
    yield f"S{_speed(one.speed)} M3"


def _speed(speed: float) -> str:
    return f"{speed:.1f}".removesuffix(".0")


def _title(one: Pass, unit: Unit) -> str:
    stock = f" LEAVES {_length(one.stock, unit)} ON SIDE" if one.stock > 0.0 else ""
    kind = " FINISH" if one.finishing else ""
    return f"BLOCK {one.block}{kind} {_which(one)} Z {_length(one.level, unit)}{stock}"


def _which(one: Pass) -> str:
    """Which side pass, and which peck of it, where there are several."""
    side = (f"SIDE PASS {one.side} OF {one.sides}",) if one.sides > 1 else ()
    peck = (f"PECK {one.number} OF {one.count}",) if one.count > 1 else ()
    return " ".join((*side, *peck)) or "PASS 1 OF 1"
