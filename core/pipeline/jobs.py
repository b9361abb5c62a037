"""Turns each derived block into a job, from which passes and NC text are made."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from core.geometry.path import EMPTY
from core.output.passes import Cutter, Floor, Job
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.parameters import parameter
from core.program.model import Number, Program, Typed
from core.program.tools import find_tool
from core.units import Kind, Unit, from_mm, length_text, show


def jobs(derived: Derived) -> tuple[Job, ...]:
    """Return one job per block, in the program's order."""
    return tuple(job(block, derived.program) for block in derived.blocks)


def job(block: DerivedBlock, program: Program) -> Job:
    """Return one block's job; a value that is not known yet is zero and has a finding."""
    solved, work, tag = block.solved, block.paths, f"{block.lookahead.tag} {block.lookahead.value}"
    finish_tool = _whole(block.block.finish_tool)
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


def _whole(typed: Typed) -> int:
    return int(typed.value) if isinstance(typed, Number) else 0


def _cutter(number: Typed, diameter: float | None, program: Program) -> Cutter | None:
    if diameter is None or not isinstance(number, Number):
        return None
    tool = find_tool(program, number.value)
    return Cutter(int(number.value), diameter, "" if tool is None else tool.type)
