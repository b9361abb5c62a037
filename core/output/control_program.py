"""Posts jobs as contours that a control compensates with G41 or G42, RL or RR; or says why not.

`controls.write` writes the text and reads it back; this module has what forbids posting it, and its header comments.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from core.controls.control_names import display_name
from core.controls.registry import is_klartext
from core.controls.write.contour_pass import CompensatedPass, PassToWrite
from core.controls.write.iso_program import offsets
from core.controls.write.iso_style import STYLE_OF_CONTROL, Radius
from core.controls.write.written_program import Posted, Refusal, write_program
from core.finding import Finding, Severity
from core.output.ascii_text import in_ascii
from core.output.grid import Grid
from core.output.nc import block_notes, comments, program_titles
from core.output.objections import posting_errors
from core.output.passes import Job, level_floor
from core.program.model import Coolant
from core.units import Unit, length_text, printable, sentence

CLIMBS_TEXT: Final = (
    "A segment climbs or falls (Z END) under compensation, where the heights at corners are the control's own.  "
    "Post the center path, or choose CUTTER COMP. ON."
)


def control_program_errors(jobs: Sequence[Job], unit: Unit) -> tuple[Finding, ...]:
    """Return what forbids posting at all, and what a control's own compensation cannot do.

    Nothing can be overridden here: the control makes the path that is cut, and the verdict has not judged it.
    """
    errors = list(posting_errors(jobs, Grid(unit), override=None))
    for job in jobs:
        if job.comp != "ON" and not level_floor(job):
            errors.append(Finding("NOTWRITTEN", Severity.ERROR, CLIMBS_TEXT, block=job.block))
    return tuple(dict.fromkeys(errors))


def control_program(
    jobs: Sequence[Job],
    cuts: Sequence[PassToWrite],
    unit: Unit,
    *,
    name: str,
    control: str,
    part: str = "",
    warnings: Sequence[Finding] = (),
) -> Posted | Refusal:
    """Return the program for a control, given by its full name, or the refusal; `cuts` are those of the jobs, in order.

    `name` is the program's name, `part` the PART NAME.  `warnings` are added to its notes.
    """
    errors = control_program_errors(jobs, unit)
    if errors:
        return Refusal(errors, unit)

    def remarks(notes: Sequence[Finding]) -> Sequence[str]:
        # a semicolon would end the block even inside a comment, or begin another comment
        texts = (*program_titles(name, part), *_header(jobs, cuts, unit, control, (*notes, *warnings)))
        lines = [line for text in texts for line in comments(in_ascii(text).replace(";", ","))]
        return [line[1:-1] for line in lines] if is_klartext(control) else lines

    # a name that every control accepts: letters, digits, a dash
    short_name = "".join(
        sign if sign.isascii() and (sign.isalnum() or sign in "-_") else "-" for sign in in_ascii(name)
    )[:24]
    written = write_program(cuts, control, unit, short_name or "PART", remarks, jobs[0].work_offset)
    if isinstance(written, Refusal):
        return written
    style, notes = STYLE_OF_CONTROL.get(control), [*_operator_notes(jobs, cuts, unit, control)]
    if style is not None and not style.comments and part.strip():
        text = f"PART NAME {printable(part)} is not in the file: {display_name(control)} has no comments."
        notes.append(Finding("PART_NAME", Severity.INFO, text, field="name"))
    return replace(written, notes=(*notes, *written.notes, *warnings))


def _operator_notes(jobs: Sequence[Job], cuts: Sequence[PassToWrite], unit: Unit, control: str) -> Iterator[Finding]:
    """Yield what the operator has to look after at the control."""
    if deleted := _with_deleted_segments(cuts):
        text = (
            "The segments that the look-ahead deleted are not in this program: with a tool smaller than {0} it may "
            "cut another contour. Post it again for such a tool."
        )
        yield Finding("LEFT_OUT", Severity.WARNING, text, lengths=(max(cut.diameter for cut in deleted),))
    style, name = STYLE_OF_CONTROL.get(control), display_name(control)
    if (style is None or not style.writes_work_offset) and jobs[0].work_offset != 54:
        text = f"Work offset G{jobs[0].work_offset} cannot be written for {name}; set its origin on the control."
        yield Finding("WORK_OFFSET", Severity.WARNING, text)
    # not every control knows M7 and M8
    if coolants := dict.fromkeys(str(job.coolant) for job in jobs if job.coolant is not Coolant.OFF):
        text = f"COOLANT {' and '.join(coolants)} is not written for {name}; switch it on at the control."
        yield Finding("COOLANT", Severity.WARNING, text)
    if unit is Unit.IN and is_klartext(control):
        text = (
            "F is in inches per minute. A control that takes tenths of an inch per minute feeds ten times too slowly."
        )
        yield Finding("FEED_UNIT", Severity.WARNING, text)


def _with_deleted_segments(cuts: Sequence[PassToWrite]) -> list[CompensatedPass]:
    return [cut for cut in cuts if isinstance(cut, CompensatedPass) and len(cut.compensated.deleted)]


def _header(
    jobs: Sequence[Job], cuts: Sequence[PassToWrite], unit: Unit, control: str, notes: Sequence[Finding]
) -> Iterator[str]:
    """Yield the sentences of the header below its titles."""
    compensates = any(isinstance(cut, CompensatedPass) for cut in cuts)
    compensation = "THE CONTROL COMPENSATES" if compensates else "NOTHING IS COMPENSATED"
    contour = "THE CONTOUR WITHOUT ITS DELETED SEGMENTS" if _with_deleted_segments(cuts) else "THE CONTOUR AS TYPED"
    yield f"WRITTEN BY CUTCOMP FOR {display_name(control)}: {contour}, {compensation}"
    yield f"UNITS {'INCH' if unit is Unit.IN else 'MM'}"
    table = "" if is_klartext(control) else ": THE CONTROL'S TABLE MUST SAY THE SAME"
    yield from dict.fromkeys(f"TOOL {cut.tool} DIAMETER {length_text(cut.diameter, unit)}{table}" for cut in cuts)
    yield from _offsets(cuts, unit, control)
    for job in jobs:
        depth = f"Z {length_text(job.z_start, unit)} TO {length_text(job.z_bottom, unit)}"
        yield f"BLOCK {job.block} MILL CONTOUR CUTTER COMP. {job.comp} {depth}"
        yield from block_notes(job, unit)
    for note in (*_operator_notes(jobs, cuts, unit, control), *notes):
        places = [] if note.block is None or len(jobs) == 1 else [f"BLOCK {note.block}"]
        places += [] if note.segment is None else [f"SEGMENT {note.segment:g}"]
        where = f"{' '.join(places)}: " if places else ""
        text = sentence(note, unit)
        code = "" if text.startswith(note.code) else f"{note.code} "
        yield f"NOTE {code}{where}{text}"


def _offsets(cuts: Sequence[PassToWrite], unit: Unit, control: str) -> Iterator[str]:
    """Yield the offsets that the operator must enter."""
    style = STYLE_OF_CONTROL.get(control)
    if style is None or style.radius is not Radius.OFFSET:
        return
    sizes = {(cut.tool, cut.stock): cut.diameter / 2 + cut.stock for cut in cuts if isinstance(cut, CompensatedPass)}
    numbers = offsets(cuts, style)
    for (tool, stock), size in sizes.items():
        leaves = f", LEAVES {length_text(stock, unit)}" if stock else ""
        yield f"OFFSET D{numbers[tool, stock]} RADIUS {length_text(size, unit)} OF TOOL {tool}{leaves}"
