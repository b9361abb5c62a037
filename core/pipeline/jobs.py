"""Turns each derived block into a job, from which passes and NC text are made, with the parameters in force."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from core.geometry.path import EMPTY
from core.output.passes import Cutter, Floor, Job
from core.pipeline.derived import Derived, DerivedBlock
from core.program.fields import Form, default_value, field_of
from core.program.model import Number, Program, Typed
from core.program.tools import find_tool
from core.units import Kind, Unit, from_mm, length_text, show, to_mm

MAX_SIDE_PASSES: Final = 200
"""More passes than this are a typing mistake in MAX OFFSET, POCKET OVERLAP or the tool's diameter."""


def jobs(derived: Derived) -> tuple[Job, ...]:
    """Return one job per block, in the program's order."""
    return tuple(job(block, derived.program) for block in derived.blocks)


def job(block: DerivedBlock, program: Program) -> Job:
    """Return one block's job; a value that is not known yet is zero and has a finding."""
    solved, work, tag = block.solved, block.paths, f"{block.lookahead.tag} {block.lookahead.value}"
    finish_tool = int(block.block.finish_tool.value) if isinstance(block.block.finish_tool, Number) else 0
    return Job(
        block=block.number,
        comp=str(block.block.cutter_comp),
        cutter=_cutter(block.block.tool, solved.tool_diameter, program),
        finisher=_cutter(block.block.finish_tool, solved.finish_diameter, program) if finish_tool else None,
        surface=work.surface if work else EMPTY,
        floors=tuple(
            Floor(segment.number, segment.z_start, segment.z_end, segment.feed)
            for segment in solved.segments[: solved.determined]
        ),
        finish=work.loops if work else (),
        rough=tuple(
            replace(loop, offset=rough.stock) for rough in (work.rough if work else ()) for loop in rough.loops
        ),
        z_start=solved.z_start or 0.0,
        z_bottom=solved.z_bottom or 0.0,
        peck_depth=solved.peck_depth,
        finish_z=parameter(program, "finish_z") if finish_tool else 0.0,
        retract_clearance=parameter(program, "retract_clearance"),
        peck_clearance=parameter(program, "peck_clearance"),
        plunge_feed=solved.plunge_feed or 0.0,
        speed=solved.speed or 0.0,
        safe_z=parameter(program, "safe_z"),
        finish_tool=finish_tool,
        work_offset=int(parameter(program, "work_offset")),
        coolant=solved.coolant,
        lookahead="" if block.side is None else tag,
        rapid_rate=parameter(program, "rapid_feed"),
        rapid_assumed=not isinstance(program.parameters.rapid_feed, Number),
        findings=block.findings,
        notes=tuple(_notes(block, program.unit)),
    )


def _notes(block: DerivedBlock, unit: Unit) -> Iterator[str]:
    """Yield what the person who runs the file should know: segments that are not cut, and surface that stays."""
    work = block.paths
    if work is None or work.compensated is None or work.verdict is None:
        return
    if work.best is not None:
        yield "PATH BEST: THE TRUE OFFSET, NOT THE CONTROL'S"
    elif len(work.compensated.deleted):
        numbers = dict.fromkeys(work.compensated.deleted.segments.tolist())
        which = f"SEGMENT{'S' if len(numbers) > 1 else ''} {', '.join(f'{number:g}' for number in numbers)}"
        yield f"DELETED BY THE LOOK-AHEAD: {which}"
    if work.verdict.over_run_at is not None:
        x, y = (length_text(value, unit) for value in work.verdict.over_run_at)
        yield f"OVER-RUN AT X {x} Y {y}: THE ENDS ARE LEAD-IN AND LEAD-OUT"
    if work.verdict.uncut:
        left, whole = (from_mm(length, unit) for length in (work.verdict.uncut_length, work.verdict.surface_length))
        yield f"UNCUT {show(left, Kind.LENGTH, unit)} OF {show(whole, Kind.LENGTH, unit)}"


def _cutter(number: Typed, diameter: float | None, program: Program) -> Cutter | None:
    if diameter is None or not isinstance(number, Number):
        return None
    tool = find_tool(program, number.value)
    return Cutter(int(number.value), diameter, "" if tool is None else tool.type)


def parameter(program: Program, name: str) -> float:
    """Return a number of PROGRAM PARAMETERS or PART SETUP as typed or its default; lengths in millimeters."""
    form, part = (Form.SETUP, program.setup) if hasattr(program.setup, name) else (Form.PARAMETERS, program.parameters)
    typed = getattr(part, name)
    value = typed.value if isinstance(typed, Number) else default_value(name, program.unit)
    assert value is not None
    return to_mm(value, program.unit) if field_of(form, name).kind in (Kind.LENGTH, Kind.FEED) else value


def stocks(block: DerivedBlock, program: Program) -> tuple[float, ...]:
    """Return what each pass before the finish path leaves on the surface, in millimeters, outermost first.

    PROFILE comes in from MAX OFFSET; each pass overlaps the one before by POCKET OVERLAP percent of the cutter's
    diameter.  A finish tool follows a roughing pass that leaves FINISH XY.  If there are more than MAX_SIDE_PASSES, the
    inner ones are left out.
    """
    assert block.solved.tool_diameter is not None
    finishing = block.solved.finish_diameter is not None
    least = parameter(program, "finish_xy") if finishing else 0.0
    widths: list[float] = []
    if block.profile:
        stock = parameter(program, "max_offset")
        step = block.solved.tool_diameter * (1.0 - parameter(program, "pocket_overlap") / 100.0)
        while stock > least + 1e-9 and step > 0.0 and len(widths) <= MAX_SIDE_PASSES:
            widths.append(stock)
            stock -= step
    return (*widths, least) if finishing else tuple(widths)
