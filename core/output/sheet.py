"""Makes the setup sheet that an operator needs at the machine, as values, as plain text, and as one HTML page.

It uses the same jobs as the NC text, and never calls a program ready that `core.output.nc` would refuse.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import chain, groupby
from textwrap import wrap
from typing import Final

import numpy as np

from core.finding import Severity
from core.output.grid import Grid
from core.output.objections import OVERRIDE_PHRASE, posting_errors
from core.output.passes import Cutter, Job, Pass, block_times, passes, program_times, rough_runs, times_text
from core.units import Kind, Unit, from_mm, length_text, located_sentence, plain, show

PAGE_COLUMNS: Final = 78
"""Columns of the plain text."""
LABEL_COLUMNS: Final = 18
"""Columns of a label in the plain text."""
READY_TEXT: Final = "READY to post."
READY_BUT_TEXT: Final = "READY to post. Know before you run it:"
NOT_READY_TEXT: Final = "NOT READY. DO NOT RUN THIS PROGRAM AS IT IS:"
STYLE: Final = """\
body { font: 14px/1.4 sans-serif; color: #1b1f23; max-width: 60em; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.5em } h2 { font-size: 1.15em; border-bottom: 1px solid; margin-top: 2em }
table { border-collapse: collapse; margin: .6em 0 }
th, td { text-align: left; padding: .1em 1em .1em 0; vertical-align: top }
.passes th, .passes td { text-align: right }
.bad { border: 3px solid #c4001a; padding: .5em 1em; font-weight: bold }
.good { border: 1px solid #00856a; padding: .5em 1em }
.marked { list-style: none; padding-left: 0 }
figure { margin: 1em 0 } svg { max-width: 100%; max-height: 18em; height: auto }
@media print { section { break-inside: avoid } body { margin: 0 } }
"""
_MARK = {Severity.ERROR: "!!", Severity.WARNING: "!", Severity.INFO: "-"}

Pair = tuple[str, str]
"""A label and its text."""


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the sheet: pairs, then a table whose first row is its heading, then findings as sentences."""

    title: str
    pairs: tuple[Pair, ...] = ()
    table: tuple[tuple[str, ...], ...] = ()
    findings: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Sheet:
    """A whole sheet.  `errors` say why the program must not run as it is, and are empty if it is ready.

    `notes` say, block by block, what is not cut as drawn: segments that the look-ahead deletes, and what stays uncut.
    `warnings` is the sentence that counts the warnings and says under which blocks they are, empty if there are none.
    """

    title: str
    head: tuple[Pair, ...]
    errors: tuple[str, ...]
    tools: Section
    blocks: tuple[Section, ...]
    notes: tuple[str, ...] = ()
    warnings: str = ""

    @property
    def verdict(self) -> tuple[str, tuple[str, ...]]:
        """The line that says whether the program is ready, and the sentences below it."""
        warnings = (self.warnings,) if self.warnings else ()
        if self.errors:
            return NOT_READY_TEXT, (*self.errors, *warnings)
        notes = (*warnings, *self.notes)
        return (READY_BUT_TEXT, notes) if notes else (READY_TEXT, ())


def sheet(jobs: Sequence[Job], unit: Unit, program: str, part: str = "", day: str = "") -> Sheet:
    """Return the sheet of a program's jobs, with its name, the part's and the day; its lengths are in program units."""
    head: tuple[Pair, ...] = (
        ("PROGRAM", program),
        ("PART NAME", part or "-"),
        ("DATE", day or "-"),
        ("UNITS", "INCH" if unit is Unit.IN else "MILLIMETERS"),
        ("WORK OFFSET", ", ".join(dict.fromkeys(f"G{job.work_offset}" for job in jobs)) or "-"),
        ("SAFE Z", ", ".join(dict.fromkeys(length_text(job.safe_z, unit) for job in jobs)) or "-"),
    )
    head = (*head, *_times(jobs, unit))
    errors = dict.fromkeys(located_sentence(error, unit) for error in posting_errors(jobs, Grid(unit), override=None))
    notes = tuple(f"Block {job.block}: {note}" for job in jobs for note in job.notes)
    blocks = tuple(_block(job, unit) for job in jobs)
    return Sheet(program, head, tuple(errors), _tools(jobs, unit), blocks, notes, _warnings(jobs))


def _warnings(jobs: Sequence[Job]) -> str:
    """Return how many warnings there are and under which blocks: `3 warnings: see FINDINGS of blocks 1 (2), 3 (1).`."""
    counts = {job.block: sum(finding.severity is Severity.WARNING for finding in job.findings) for job in jobs}
    counts = {block: count for block, count in counts.items() if count}
    if not counts:
        return ""
    total = sum(counts.values())
    warnings = f"{total} warning{'' if total == 1 else 's'}: see FINDINGS of block"
    if len(counts) == 1:
        return f"{warnings} {next(iter(counts))}."
    return f"{warnings}s {', '.join(f'{block} ({count})' for block, count in counts.items())}."


def _times(jobs: Sequence[Job], unit: Unit) -> Iterator[Pair]:
    """Yield the time of the whole program, and the rapid rate that it is based on."""
    ready = [job for job in jobs if not posting_errors([job], Grid(unit), override=OVERRIDE_PHRASE)]
    if ready:
        yield "TIME", times_text(program_times(ready, ready[0].rapid_rate))
        rate, assumed = _feed(ready[0].rapid_rate, unit), ready[0].rapid_assumed
        yield "RAPID RATE", f"{rate} a minute{', assumed, not typed' if assumed else ''}"


def _feed(value: float | None, unit: Unit) -> str:
    return "-" if value is None else show(from_mm(value, unit), Kind.FEED, unit)


def _tools(jobs: Sequence[Job], unit: Unit) -> Section:
    """Return every tool once, with the blocks that use it."""
    used: dict[Cutter, list[str]] = {}
    for job in jobs:
        for cutter, role in ((job.cutter, ""), (job.finisher, " finish")):
            if cutter is not None:
                used.setdefault(cutter, []).append(f"{job.block}{role}")
    rows = [("TOOL", "TYPE", "DIAMETER", "LENGTH OFFSET", "BLOCKS")]
    for cutter in sorted(used, key=lambda cutter: cutter.number):
        size, blocks = length_text(cutter.diameter, unit), ", ".join(used[cutter])
        rows.append((str(cutter.number), cutter.type or "-", size, f"H{cutter.number}", blocks))
    return Section("TOOLS", table=tuple(rows))


def _block(job: Job, unit: Unit) -> Section:
    known = not posting_errors([job], Grid(unit), override=OVERRIDE_PHRASE)
    all_passes = passes(job) if known else ()
    return Section(
        f"BLOCK {job.block}  MILL CONTOUR",
        (*_set_up(job, unit), *_cutting_data(job, all_passes, unit)),
        _pass_table(all_passes, unit),
        tuple(f"{_MARK[finding.severity]} {located_sentence(finding, unit)}" for finding in job.findings),
    )


def _set_up(job: Job, unit: Unit) -> Iterator[Pair]:
    yield "CUTTER COMP.", job.comp
    yield "LOOKAHEAD", job.lookahead or "none: the center runs on the contour"
    for note in job.notes:
        yield "NOTE", note
    yield "TOOL", _cutter(job.cutter)
    yield "FINISH TOOL", _cutter(job.finisher) if job.finish_tool else "none"
    if len(job.surface):
        yield "CONTOUR START", _point_text(job.surface.points[0].tolist(), unit)
    plunges = [run.plunge_point for run in (*rough_runs(job), *job.finish) if run.plunge_point is not None]
    if plunges:
        yield "FIRST PLUNGE AT", _point_text(plunges[0], unit)
    if reach := _reach_text(job, unit):
        yield "CUTTER REACHES", reach
        if job.comp != "ON":
            yield "", "on the center path; a G41/G42 program plunges farther off"
    yield "Z START, Z BOTTOM", f"{length_text(job.z_start, unit)}  {length_text(job.z_bottom, unit)}"
    yield "PECK DEPTH", length_text(job.peck_depth, unit) if job.peck_depth else "none: full depth in one pass"


def _cutting_data(job: Job, all_passes: Sequence[Pass], unit: Unit) -> Iterator[Pair]:
    yield "SPEED", f"{job.speed:g} RPM"
    yield "COOLANT", str(job.coolant)
    yield "PLUNGE FEED", _feed(job.plunge_feed, unit)
    yield "FEEDS", _feeds(job, unit)
    if all_passes:
        yield "TIME", times_text(block_times(job, job.rapid_rate))


def _cutter(cutter: Cutter | None) -> str:
    return "NOT KNOWN" if cutter is None else f"{cutter.number} {cutter.type}".strip()


def _point_text(point: Sequence[float], unit: Unit) -> str:
    return f"X {length_text(point[0], unit)}  Y {length_text(point[1], unit)}"


def _reach_text(job: Job, unit: Unit) -> str:
    """Return the rectangle that the cutters stay in, for placing the clamps."""
    stages = ((job.cutter, rough_runs(job)), (job.finisher, job.finish))
    swept = [
        run.with_leads.boxes.T + np.array([-1.0, -1.0, 1.0, 1.0]) * cutter.diameter / 2
        for cutter, runs in stages
        for run in runs
        if cutter is not None and len(run.with_leads)
    ]
    if not swept:
        return ""
    boxes = np.concatenate(swept)
    (x0, y0), (x1, y1) = boxes[:, :2].min(axis=0).tolist(), boxes[:, 2:].max(axis=0).tolist()
    return f"X {length_text(x0, unit)} to {length_text(x1, unit)}  Y {length_text(y0, unit)} to {length_text(y1, unit)}"


def _feeds(job: Job, unit: Unit) -> str:
    """Return the feeds with their segments, such as `12.0 (segments 1-4), 8.0 (segment 5)`."""
    parts = []
    for feed, floors in groupby(job.floors, key=lambda floor: _feed(floor.feed, unit)):
        numbers = [floor.number for floor in floors]
        span = f"{numbers[0]}-{numbers[-1]}" if len(numbers) > 1 else f"{numbers[0]}"
        parts.append(f"{feed} (segment{'s' if len(numbers) > 1 else ''} {span})")
    return ", ".join(parts) or "-"


def _pass_table(all_passes: Sequence[Pass], unit: Unit) -> tuple[tuple[str, ...], ...]:
    rows = [("NO.", "TOOL", "KIND", "DEPTH", "Z", "LEAVES ON SIDE")]
    for number, a_pass in enumerate(all_passes, 1):
        kind, depth = "FINISH" if a_pass.finishing else "PASS", f"{a_pass.number} of {a_pass.count}"
        level, stock = length_text(a_pass.level, unit), length_text(a_pass.stock, unit)
        rows.append((str(number), str(a_pass.cutter.number), kind, depth, level, stock))
    return tuple(rows) if all_passes else ()


def as_text(sheet: Sheet) -> str:
    """Return the sheet as plain text, each line ended by a line feed."""
    lines = ["SETUP SHEET", "=" * PAGE_COLUMNS, *_text_pairs(sheet.head), ""]
    first, reasons = sheet.verdict
    marked = (f"{'!!' if text in sheet.errors else '!'} {text}" for text in reasons)
    lines += [first, *(line for text in marked for line in _wrapped(text))]
    for section in (sheet.tools, *sheet.blocks):
        lines += ["", section.title, "-" * PAGE_COLUMNS, *_text_section(section)]
    return "\n".join(plain(line).rstrip() for line in lines) + "\n"


def _text_section(section: Section) -> Iterator[str]:
    yield from _text_pairs(section.pairs)
    if section.table:
        yield from ("",) if section.pairs else ()
        yield from _table(section.table)
    if section.findings:
        yield ""
        yield "FINDINGS"
        for text in section.findings:
            yield from _wrapped(text)


def _text_pairs(pairs: Sequence[tuple[str, str]]) -> Iterator[str]:
    for label, text in pairs:
        first, *rest = wrap(plain(text), PAGE_COLUMNS - LABEL_COLUMNS - 1) or [""]
        yield f"{label:<{LABEL_COLUMNS}} {first}"
        yield from (f"{'':<{LABEL_COLUMNS}} {line}" for line in rest)


def _table(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield rows with columns as wide as their longest text, aligned right."""
    widths = [max(len(plain(row[column])) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        yield "  ".join(f"{plain(text):>{width}}" for text, width in zip(row, widths, strict=True))


def _wrapped(text: str) -> list[str]:
    return wrap(plain(text), PAGE_COLUMNS - 2, initial_indent="  ", subsequent_indent="     ")


def as_page(sheet: Sheet, drawings: Sequence[str]) -> str:
    """Return the sheet as an HTML page; `drawings` are SVG texts of `core.output.svg`, one per block."""
    title = f"Setup sheet: {_escaped(sheet.title)}"
    lines = (
        "<!DOCTYPE html>",
        f'<html lang="en"><head><meta charset="utf-8"><title>{title}</title>',
        f"<style>\n{STYLE}</style></head><body>",
        f"<h1>{title}</h1>",
        *_page_table(sheet.head),
        *_page_verdict(sheet),
        *_page_section(sheet.tools, ""),
        *chain.from_iterable(map(_page_section, sheet.blocks, drawings)),
        "</body></html>",
    )
    return "\n".join(lines) + "\n"


def _escaped(text: str) -> str:
    return escape(plain(text))


def _page_verdict(sheet: Sheet) -> Iterator[str]:
    first, reasons = sheet.verdict
    if not reasons:
        yield f'<p class="good">{_escaped(first)}</p>'
        return
    yield f'<div class="{"bad" if sheet.errors else "good"}">{_escaped(first)}<ul>'
    yield from (f"<li>{_escaped(text)}</li>" for text in reasons)
    yield "</ul></div>"


def _page_section(section: Section, drawing: str) -> Iterator[str]:
    yield f"<section><h2>{_escaped(section.title)}</h2>"
    if drawing:
        yield f"<figure>{drawing}</figure>"
    yield from _page_table(section.pairs)
    if section.findings:
        yield '<h3>FINDINGS</h3><ul class="marked">'
        yield from (f"<li>{_escaped(text)}</li>" for text in section.findings)
        yield "</ul>"
    yield "</section>"
    if section.table:
        yield f'<table class="{"passes" if section.pairs else "tools"}">'
        for number, row in enumerate(section.table):
            cell = "td" if number else "th"
            yield f"<tr>{''.join(f'<{cell}>{_escaped(text)}</{cell}>' for text in row)}</tr>"
        yield "</table>"


def _page_table(pairs: Sequence[tuple[str, str]]) -> Iterator[str]:
    if pairs:
        yield "<table>"
        yield from (f"<tr><th>{_escaped(label)}</th><td>{_escaped(text)}</td></tr>" for label, text in pairs)
        yield "</table>"
