"""Control program: the contour as typed, for a control that compensates by itself with G41 or G42, RL or RR."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from core.controls.write.iso_program import Frame, offsets
from core.controls.write.iso_style import STYLES, Radius
from core.controls.write.programmed_contour import Cut, Plain
from core.controls.write.written_program import NotWritten, write_program
from core.finding import Finding, Severity
from core.output.grid import Grid, length_text
from core.output.nc import Posted, Refusal, comments, program_titles
from core.output.objections import posting_errors
from core.output.passes import Job, level_floor
from core.units import Unit, printable, sentence


def control_program_errors(jobs: Sequence[Job], unit: Unit) -> tuple[Finding, ...]:
    """What forbids posting at all, and what a control's own compensation cannot be told.

    Nothing can be overridden here: the path that is cut is the control's, and nobody has judged it for that.
    """
    if not jobs:
        return (Finding("NO_BLOCK", Severity.ERROR, "There is no block to post."),)
    errors = list(posting_errors(jobs, Grid(unit), override=None))
    for job in jobs:
        if job.comp != "ON" and not level_floor(job):
            text = (
                "A segment climbs or falls (Z END) under compensation, where the heights at corners are the control's"
            )
            text += " own.  Post the center path, or choose CUTTER COMP. ON."
            errors.append(Finding("NOTWRITTEN", Severity.ERROR, f"Block {job.block}: {text}"))
    return tuple(dict.fromkeys(errors))


def control_program(
    jobs: Sequence[Job], cuts: Sequence[Cut | Plain], unit: Unit, *, name: str, control: str, part: str = ""
) -> Posted | Refusal:
    """The program of a control by its full name, or why there is none; `cuts` are those of the jobs, in order.

    `name` is the program's name, `part` the PART NAME.
    """
    against = control_program_errors(jobs, unit)
    if against:
        return Refusal(against, unit)

    def remarks(notes: Sequence[Finding]) -> Sequence[str]:
        # a semicolon would end the block even inside a remark, or begin another one
        texts = [
            text.replace(";", ",") for text in (*program_titles(name, part), *_header(jobs, cuts, unit, control, notes))
        ]
        if control == "klartext":
            return [line[1:-1] for text in texts for line in comments(text)]
        return [line for text in texts for line in comments(text)]

    frame = Frame(unit, jobs[0].work_offset)
    written = write_program(cuts, control, frame, _short_name(name), remarks)
    if isinstance(written, NotWritten):
        return Refusal(written.findings, unit)
    return Posted(written.text, notes=(*_unwritable(jobs, control), *_part_name_missing(part, control), *written.notes))


def _short_name(name: str) -> str:
    """A name every control takes: letters, digits, a dash."""
    kept = "".join(sign if sign.isascii() and (sign.isalnum() or sign in "-_") else "-" for sign in name)
    return kept[:24] or "PART"


def _unwritable(jobs: Sequence[Job], control: str) -> tuple[Finding, ...]:
    """What the text of this control cannot say."""
    if control in ("threeblock", "klartext") and jobs[0].work_offset != 54:
        text = f"Work offset G{jobs[0].work_offset} cannot be written for {control}; set its origin on the control."
        return (Finding("WORK_OFFSET", Severity.WARNING, text),)
    return ()


def _part_name_missing(part: str, control: str) -> tuple[Finding, ...]:
    """That the part's name is nowhere in a text that holds no comments."""
    style = STYLES.get(control)
    if style is None or style.comments or not part.strip():
        return ()
    text = f"PART NAME {printable(part)} is not in the file: {control} knows no comments."
    return (Finding("PART_NAME", Severity.INFO, text, field="name"),)


def _header(
    jobs: Sequence[Job], cuts: Sequence[Cut | Plain], unit: Unit, control: str, notes: Sequence[Finding]
) -> Iterator[str]:
    """The sentences of the header below its titles."""
    compensates = any(isinstance(cut, Cut) for cut in cuts)
    compensation = "THE CONTROL COMPENSATES" if compensates else "NOTHING IS COMPENSATED"
    yield f"WRITTEN BY CUTCOMP FOR {control}: THE CONTOUR AS TYPED, {compensation}"
    yield f"UNITS {'INCH' if unit is Unit.IN else 'MM'}"
    yield from dict.fromkeys(_tool_line(cut, unit, control) for cut in cuts)
    yield from _offsets(cuts, unit, control)
    for job in jobs:
        depth = f"Z {length_text(job.z_start, unit)} TO {length_text(job.z_bottom, unit)}"
        yield f"BLOCK {job.block} MILL CONTOUR CUTTER COMP. {job.comp} {depth}"
    for note in (*_unwritable(jobs, control), *notes):
        where = "" if note.segment is None else f"SEGMENT {note.segment:g}: "
        yield f"NOTE {note.code} {where}{sentence(note, unit)}"


def _tool_line(cut: Cut | Plain, unit: Unit, control: str) -> str:
    table = "" if control == "klartext" else ": THE CONTROL'S TABLE MUST SAY THE SAME"
    return f"TOOL {cut.tool} DIAMETER {length_text(cut.diameter, unit)}{table}"


def _offsets(cuts: Sequence[Cut | Plain], unit: Unit, control: str) -> Iterator[str]:
    """The offsets an operator has to enter."""
    style = STYLES.get(control)
    if style is None or style.radius is not Radius.OFFSET:
        return
    sizes = {(cut.tool, cut.stock): cut.diameter / 2 + cut.stock for cut in cuts if isinstance(cut, Cut)}
    numbers = offsets(cuts, style)
    for key, number in ((key, numbers[key]) for key in sizes):
        stock = f", LEAVES {length_text(key[1], unit)}" if key[1] else ""
        yield f"OFFSET D{number} RADIUS {length_text(sizes[key], unit)} OF TOOL {key[0]}{stock}"
