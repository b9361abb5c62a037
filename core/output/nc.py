"""Writes jobs as the ISO G-code that LinuxCNC runs: the tool center path, without G41 or G42.

Every file states before the first move: G17 XY plane, G20 or G21, G40 no cutter compensation, G49 no tool length,
the work offset, G80 no canned cycle, G90 absolute, G91.1 I and J from the arc's start, G94 feed per minute, and
G64 P: the machine may round a corner by no more than P.  Only inside corners of the path are corners, and rounding
those keeps the cutter off the part.  G43 H names the tool's own length offset, so that no other is in force.
The first move after a tool change is straight up.  G53 is not used: the position of its zero depends on the machine.
There is no % line: LinuxCNC needs none, and a lone one would end the file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Final

from core.controls.write.contour_pass import CenterMove
from core.controls.write.iso_program import CORNER_TOLERANCE, speed_text
from core.controls.write.written_program import Posted, Refusal
from core.finding import Finding
from core.geometry.piece import Arc, Turn
from core.output.ascii_text import in_ascii
from core.output.grid import EXTRA_CENTER_DECIMALS, Grid, arc_parts, feed_text
from core.output.objections import OVERRIDE_PHRASE, overridable_errors, posting_errors
from core.output.passes import Cutter, Job, Pass, at_one_safe_z, clear_height, passes
from core.program.model import Coolant
from core.units import Unit, length_text, located_sentence, sentence

COMMENT_WIDTH: Final = 72
"""Characters inside the parentheses; longer text continues in another comment."""
ACTIVE: Final = re.compile(r"\s*[A-Za-z_]+\s*,")
"""A comment that begins like this is a command to some controls: (MSG, ...), (LOGOPEN, ...), (PY, ...)."""
AXIS_AND_NUMBER: Final = re.compile(r"\b([XYZ]) (?=[-.\d])")
COMMENT_REPLACEMENTS: Final = str.maketrans({"(": "[", ")": "]", "%": " PERCENT"})


def comments(text: str) -> Iterator[str]:
    """Yield the comment lines for `text`: one, or several if it is long; none for blank text.

    A line never ends between an axis and its number.
    """
    plain = in_ascii(text).translate(COMMENT_REPLACEMENTS)
    spaced = "".join(character if character.isprintable() else " " for character in plain)
    unbroken = AXIS_AND_NUMBER.sub(r"\1\0", spaced)
    for line in (part.replace("\0", " ") for part in wrap(unbroken, COMMENT_WIDTH)):
        yield f"(* {line})" if ACTIVE.match(line) else f"({line})"


Place = tuple[float | None, float | None, float | None]
"""X, Y and Z in millimeters; None for an axis whose position is not known yet."""


@dataclass(slots=True)
class _MoveWriter:
    """Writes motions as text, with the tool's position and the feed in force, as text, before the next one."""

    grid: Grid
    place: Place = (None, None, None)
    feed: str = ""

    def motion(self, motion: CenterMove) -> Iterator[str]:
        """Yield the lines of a motion.

        A rapid never moves Z together with X and Y: up comes before, down after.
        """
        x, y, z = self.place
        if motion.feed is None:
            high = motion.z if z is None else max(motion.z, z)
            for end in ((x, y, high), (motion.x, motion.y, high), (motion.x, motion.y, motion.z)):
                yield from self.move("G0", end, self.feed)
            return
        feed = feed_text(motion.feed, self.grid)
        if not motion.turn:
            yield from self.move("G1", (motion.x, motion.y, motion.z), feed)
            return
        assert x is not None
        assert y is not None
        assert z is not None
        arc = Arc((x, y), (motion.x, motion.y), motion.center, Turn(motion.turn))
        for part in arc_parts(arc, self.grid):
            end = (*part.end, motion.z if part.share == 1.0 else z + part.share * (motion.z - z))
            if part.center is None:
                yield from self.move("G1", end, feed)
            else:
                i, j = (self.grid.text(steps, EXTRA_CENTER_DECIMALS) for steps in part.center)
                yield from self.move("G3" if motion.turn > 0 else "G2", end, feed, f" I{i} J{j}")

    def move(self, word: str, end: Place, feed: str, center: str = "") -> Iterator[str]:
        """Yield the line of one G word, with an arc's I and J; none if nothing moves as written."""
        axes = ""
        for name, old, new in zip("XYZ", self.place, end, strict=True):
            moved = new is not None and (old is None or self.grid.steps(old) != self.grid.steps(new))
            if new is not None and (moved or (center and name != "Z")):
                axes += f" {name}{self.grid.text(self.grid.steps(new))}"
        self.place = end
        if axes:
            yield f"{word}{axes}{center}{f' F{feed}' if feed != self.feed else ''}"
            self.feed = feed


def center_path_program(
    jobs: Sequence[Job], unit: Unit, *, name: str, part: str = "", override: str | None = None
) -> Posted | Refusal:
    """Return the NC text of all jobs, or the findings that forbid it.

    `name` is the program's name and `part` the PART NAME; both become comments at the top, whatever they contain.
    `override` counts only if it is the sentence `core.output.objections.OVERRIDE_PHRASE`, and only against findings on
    a path that is known; the header then says what was overridden.
    """
    grid = Grid(unit)
    errors = posting_errors(jobs, grid, override=override)
    if errors:
        return Refusal(errors, unit)
    safe, highest = max(job.safe_z for job in jobs), max(jobs, key=clear_height)
    waived = overridable_errors(jobs)
    lines = (
        *_header(jobs, unit, program_titles(name, part), waived),
        *_raised_safe_z(safe, highest, unit),
        *_body(at_one_safe_z(jobs), grid),
    )
    return Posted("\n".join(lines) + "\n", waived)


def program_titles(name: str, part: str) -> tuple[str, ...]:
    """Return the titles at the top of every NC file: the program's name, and the part's if it has one."""
    return (f"PROGRAM {name}", f"PART {part}") if part.strip() else (f"PROGRAM {name}",)


def _header(jobs: Sequence[Job], unit: Unit, head: tuple[str, ...], waived: tuple[Finding, ...]) -> Iterator[str]:
    for title in head:
        yield from comments(title)
    yield from comments("WRITTEN BY CUTCOMP.  THE PATH IS THAT OF THE TOOL CENTER: NO G41 OR G42")
    yield from comments(f"UNITS {'INCH' if unit is Unit.IN else 'MM'}")
    for cutter, role in _cutters(jobs).items():
        size = length_text(cutter.diameter, unit)
        yield from comments(f"TOOL {cutter.number} {cutter.type} DIAMETER {size} {role}".rstrip())
    for job in jobs:
        yield from _block_lines(job, unit)
    if waived:
        yield from comments(f"OVERRIDDEN BY THE OPERATOR: {OVERRIDE_PHRASE}")
    for finding in waived:
        yield from comments(f"OVERRIDDEN {finding.code}: {located_sentence(finding, unit)}")
    yield from comments(f"G64 P{CORNER_TOLERANCE[unit]}: CORNER TOLERANCE {CORNER_TOLERANCE[unit]}")


def _cutters(jobs: Sequence[Job]) -> dict[Cutter, str]:
    """Return every tool once, in order of use, with its role."""
    roles: dict[Cutter, str] = {}
    for job in jobs:
        for cutter, role in ((job.cutter, "" if job.finisher is None else "ROUGH"), (job.finisher, "FINISH")):
            if cutter is not None:
                roles.setdefault(cutter, role)
    return roles


def _block_lines(job: Job, unit: Unit) -> Iterator[str]:
    comp = f"CUTTER COMP. {job.comp}" + (f" LOOKAHEAD {job.lookahead}" if job.lookahead else "")
    depth = f"Z {length_text(job.z_start, unit)} TO {length_text(job.z_bottom, unit)}"
    peck = f" PECK {length_text(job.peck_depth, unit)}" if job.peck_depth > 0.0 else ""
    title, depth_text = f"BLOCK {job.block} MILL CONTOUR {comp}", f"{depth}{peck}"
    together = len(title) + 1 + len(depth_text) <= COMMENT_WIDTH
    for line in (f"{title} {depth_text}",) if together else (title, depth_text):
        yield from comments(line)
    for note in block_notes(job, unit):
        yield from comments(note)


def block_notes(job: Job, unit: Unit) -> Iterator[str]:
    """Yield what the person who runs the file should know of a block: its notes, and its cuts into other blocks."""
    yield from job.notes
    for finding in job.findings:
        if finding.code == "OTHER_BLOCK":
            yield f"NOTE {finding.code} {sentence(finding, unit)}"


def _raised_safe_z(safe: float, highest: Job, unit: Unit) -> Iterator[str]:
    """Yield a comment, with the reason, if SAFE Z alone would not clear every block; `highest` needs most."""
    clear = clear_height(highest)
    if clear > safe:
        over, top = length_text(highest.retract_clearance, unit), length_text(highest.z_start, unit)
        yield from comments(f"SAFE Z {length_text(safe, unit)} RAISED TO {length_text(clear, unit)}")
        yield from comments(f"THAT IS RETRACT CLEARANCE {over} OVER Z START {top}")


def _body(jobs: Sequence[Job], grid: Grid) -> Iterator[str]:
    inch = grid.unit is Unit.IN
    yield f"G17 {'G20' if inch else 'G21'} G40 G49 G{jobs[0].work_offset} G80 G90 G91.1 G94"
    yield f"G64 P{CORNER_TOLERANCE[grid.unit]}"
    writer, tool, speed, coolant = _MoveWriter(grid), None, 0.0, Coolant.OFF
    for job in jobs:
        for a_pass in passes(job):
            changed = a_pass.cutter.number != tool
            if changed:
                yield from _coolant_change(coolant, Coolant.OFF)
                if tool is not None:
                    yield "M5"
                yield f"T{a_pass.cutter.number} M6"
                yield f"S{speed_text(a_pass.speed)} M3"
                writer, tool, speed, coolant = _MoveWriter(grid), a_pass.cutter.number, a_pass.speed, Coolant.OFF
            elif a_pass.speed != speed:
                yield f"S{speed_text(a_pass.speed)}"
                speed = a_pass.speed
            yield from _coolant_change(coolant, job.coolant)
            coolant = job.coolant
            yield from comments(_title(a_pass, grid.unit))
            lines = [line for motion in a_pass.motions for line in writer.motion(motion)]
            if changed:
                # the length offset stands in the block of the tool's first move, which goes to SAFE Z: on some controls
                # G43 in a block of its own moves Z by the length at once
                code, first = lines[0].split(" ", 1)
                lines[0] = f"{code} G43 H{tool} {first}"
            yield from lines
    yield from _coolant_change(coolant, Coolant.OFF)
    yield "M5"
    yield "M30"


def _coolant_change(current: Coolant, wanted: Coolant) -> Iterator[str]:
    """Yield the coolant words: M7 is mist, M8 flood; M9 switches both off."""
    if current is wanted:
        return
    if current is not Coolant.OFF:
        yield "M9"
    if wanted is not Coolant.OFF:
        yield "M7" if wanted is Coolant.MIST else "M8"


def _title(a_pass: Pass, unit: Unit) -> str:
    stock = f" LEAVES {length_text(a_pass.stock, unit)} ON SIDE" if a_pass.stock > 0.0 else ""
    kind = " FINISH" if a_pass.finishing else ""
    side = f" SIDE PASS {a_pass.side} OF {a_pass.sides}" if a_pass.sides > 1 else ""
    peck = f" PECK {a_pass.number} OF {a_pass.count}" if a_pass.count > 1 else ""
    numbers = f"{side}{peck}" or " PASS 1 OF 1"
    return f"BLOCK {a_pass.block}{kind}{numbers} Z {length_text(a_pass.level, unit)}{stock}"
