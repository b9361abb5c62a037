"""The setup sheet: what the operator needs at the machine, from the same jobs the NC text is made of.

A sheet is a head and sections of lines, as plain values; `core.output.sheet_text` and `core.output.sheet_page` put
it on paper.  It never calls a program ready that would be refused by `core.output.post`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import hypot, isfinite

import numpy as np

from core.finding import Finding, Severity
from core.geometry.piece import Arc, Line, Turn
from core.output.grid import Grid
from core.output.job import Cutter, Job
from core.output.motion import Motion, Pass
from core.output.override import OVERRIDE
from core.output.passes import passes, rough_runs
from core.output.ready import forbidding
from core.units import Kind, Unit, from_mm, sentence, show

Pair = tuple[str, str]
"""A label and what stands beside it."""


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the sheet: pairs, then a table whose first row is its heading, then findings as sentences."""

    title: str
    pairs: tuple[Pair, ...] = ()
    table: tuple[tuple[str, ...], ...] = ()
    findings: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Sheet:
    """A whole sheet.  `against` says why the program is not to be run as it is; empty for one that is ready."""

    title: str
    head: tuple[Pair, ...]
    against: tuple[str, ...]
    tools: Section
    blocks: tuple[Section, ...]


@dataclass(frozen=True, slots=True)
class About:
    """What the jobs do not know: the program's name, the part's, and the day, as text."""

    program: str
    part: str = ""
    day: str = ""


def sheet(jobs: Sequence[Job], unit: Unit, about: About) -> Sheet:
    """The sheet of a program's jobs; lengths on it are in program units."""
    against = forbidding(jobs, Grid(unit), override=None)
    head = (
        ("PROGRAM", about.program),
        ("PART NAME", about.part or "-"),
        ("DATE", about.day or "-"),
        ("UNITS", "INCH" if unit is Unit.IN else "MILLIMETRE"),
        ("WORK OFFSET", ", ".join(dict.fromkeys(f"G{job.work_offset}" for job in jobs)) or "-"),
        ("SAFE Z", ", ".join(dict.fromkeys(_length(job.safe_z, unit) for job in jobs)) or "-"),
    )
    told = tuple(dict.fromkeys(_told(finding, unit) for finding in against))
    if not jobs:
        told = ("There is no block.",)
    return Sheet(about.program, head, told, _tools(jobs, unit), tuple(_block(job, unit) for job in jobs))


def _length(value: float, unit: Unit) -> str:
    return show(from_mm(value, unit), Kind.LENGTH, unit)


def _feed(value: float | None, unit: Unit) -> str:
    return "-" if value is None else show(from_mm(value, unit), Kind.FEED, unit)


def _told(finding: Finding, unit: Unit) -> str:
    segment = "" if not finding.segment else f"segment {finding.segment:g}: "
    return f"{segment}{sentence(finding, unit)}"


def _tools(jobs: Sequence[Job], unit: Unit) -> Section:
    """Every tool once, with the blocks that use it."""
    used: dict[Cutter, list[str]] = {}
    for job in jobs:
        for cutter, role in ((job.cutter, ""), (job.finisher, " finish")):
            if cutter is not None:
                used.setdefault(cutter, []).append(f"{job.block}{role}")
    rows = [
        (str(cutter.number), cutter.type or "-", _length(cutter.diameter, unit), f"H{cutter.number}", ", ".join(blocks))
        for cutter, blocks in sorted(used.items(), key=lambda item: item[0].number)
    ]
    return Section("TOOLS", table=(("TOOL", "TYPE", "DIAMETER", "LENGTH OFFSET", "BLOCKS"), *rows))


def _block(job: Job, unit: Unit) -> Section:
    known = not forbidding([job], Grid(unit), override=OVERRIDE)
    every = passes(job) if known else ()
    return Section(
        f"BLOCK {job.block}  MILL CONTOUR",
        (*_set_up(job, unit), *_cut(job, every, unit)),
        _pass_table(every, unit),
        tuple(f"{_MARK[finding.severity]} {_told(finding, unit)}" for finding in job.findings),
    )


_MARK = {Severity.ERROR: "!!", Severity.WARNING: "!", Severity.INFO: "-"}


def _set_up(job: Job, unit: Unit) -> Iterator[Pair]:
    yield "CUTTER COMP.", job.comp
    yield "LOOKAHEAD", job.lookahead or "none: the center runs on the contour"
    yield "TOOL", _cutter(job.cutter)
    yield "FINISH TOOL", _cutter(job.finisher) if job.finish_tool else "none"
    if len(job.surface):
        yield "CONTOUR START", _place(job.surface.points[0].tolist(), unit)
    plunges = [run.plunge_point for run in (*rough_runs(job), *job.finish) if run.plunge_point is not None]
    if plunges:
        yield "FIRST PLUNGE AT", _place(plunges[0], unit)
    if reach := _reach(job, unit):
        yield "CUTTER REACHES", reach
    yield "Z START, Z BOTTOM", f"{_length(job.z_start, unit)}  {_length(job.z_bottom, unit)}"
    yield "PECK DEPTH", _length(job.peck_depth, unit) if job.peck_depth else "none: full depth in one pass"


def _cut(job: Job, every: Sequence[Pass], unit: Unit) -> Iterator[Pair]:
    yield "SPEED", f"{job.speed:g} RPM"
    yield "PLUNGE FEED", _feed(job.plunge_feed, unit)
    yield "FEEDS", _feeds(job, unit)
    if every:
        yield "CUTTING TIME", f"about {_minutes(every)}, rapids not counted"


def _cutter(cutter: Cutter | None) -> str:
    return "NOT KNOWN" if cutter is None else f"{cutter.number} {cutter.type}".strip()


def _place(point: Sequence[float], unit: Unit) -> str:
    return f"X {_length(point[0], unit)}  Y {_length(point[1], unit)}"


def _reach(job: Job, unit: Unit) -> str:
    """The rectangle the cutters stay in, for the clamps."""
    stages = ((job.cutter, rough_runs(job)), (job.finisher, job.finish))
    swept = [
        run.whole.boxes + np.array([-1.0, -1.0, 1.0, 1.0]) * cutter.diameter / 2
        for cutter, runs in stages
        for run in runs
        if cutter is not None and len(run.whole)
    ]
    if not swept:
        return ""
    every = np.concatenate(swept)
    (x0, y0), (x1, y1) = every[:, :2].min(axis=0).tolist(), every[:, 2:].max(axis=0).tolist()
    return f"X {_length(x0, unit)} to {_length(x1, unit)}  Y {_length(y0, unit)} to {_length(y1, unit)}"


def _feeds(job: Job, unit: Unit) -> str:
    """Feeds with the segments they hold for: 1-4 12.0, 5 8.0."""
    parts = []
    for feed, floors in groupby(job.floors, key=lambda floor: _feed(floor.feed, unit)):
        numbers = [floor.number for floor in floors]
        span = f"{numbers[0]}-{numbers[-1]}" if len(numbers) > 1 else f"{numbers[0]}"
        parts.append(f"{feed} (segment{'s' if len(numbers) > 1 else ''} {span})")
    return ", ".join(parts) or "-"


def _pass_table(every: Sequence[Pass], unit: Unit) -> tuple[tuple[str, ...], ...]:
    rows = [
        (
            str(number),
            str(one.cutter.number),
            "FINISH" if one.finishing else "PASS",
            f"{one.number} of {one.count}",
            _length(one.level, unit),
            _length(one.stock, unit),
        )
        for number, one in enumerate(every, 1)
    ]
    return (("NO.", "TOOL", "KIND", "DEPTH", "Z", "LEAVES ON SIDE"), *rows) if rows else ()


def _minutes(every: Sequence[Pass]) -> str:
    """Length over feed, all feeds at their programmed value."""
    time = 0.0
    for one in every:
        for before, motion in zip(one.motions, one.motions[1:], strict=False):
            if motion.feed:
                time += _way(before, motion) / motion.feed
    if not isfinite(time):
        return "-"
    return f"{time:.1f} min" if time < 100.0 else f"{time / 60.0:.1f} h"


def _way(before: Motion, motion: Motion) -> float:
    ends = (before.x, before.y), (motion.x, motion.y)
    straight = motion.turn is Turn.NONE
    piece = Line(*ends) if straight else Arc(*ends, motion.center, motion.turn)
    return hypot(piece.length, motion.z - before.z)
