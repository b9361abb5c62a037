"""What is posted: each derived block as the job that passes and NC text are made of."""

from __future__ import annotations

from collections.abc import Iterator

from core.geometry.path import EMPTY
from core.output.job import Cutter, Job, Run
from core.pipeline.compensation import parameter
from core.pipeline.derived import Derived, DerivedBlock
from core.program.fields import default
from core.program.model import Entry, Program, Typed
from core.program.tools import find
from core.units import Kind, Unit, from_mm, show, to_mm


def jobs(derived: Derived) -> tuple[Job, ...]:
    """One job a block, in the program's order."""
    return tuple(job(found, derived.program) for found in derived.blocks)


def job(found: DerivedBlock, program: Program, *, noted: bool = True) -> Job:
    """One block's job; what is not known yet is zero there and stands among the findings.

    Only who writes a file needs it `noted`: a hundred deleted segments take longer to name than all the rest.
    """
    solved, tag = found.solved, f"{found.lookahead.tag} {found.lookahead.value}"
    finish_tool = _whole(found.block.finish_tool)
    return Job(
        block=found.number,
        comp=str(found.block.cutter_comp),
        cutter=_cutter(found.block.tool, solved.tool_diameter, program),
        finisher=_cutter(found.block.finish_tool, solved.finish_diameter, program) if finish_tool else None,
        surface=found.work.surface if found.work else EMPTY,
        floors=solved.segments[: solved.determined],
        finish=_finish(found),
        rough=_rough(found),
        z_start=solved.z_start or 0.0,
        z_bottom=solved.z_bottom or 0.0,
        peck_depth=solved.peck_depth,
        finish_z=parameter(program, "finish_z") if finish_tool else 0.0,
        retract_clearance=parameter(program, "retract_clearance"),
        peck_clearance=parameter(program, "peck_clearance"),
        plunge_feed=solved.plunge_feed or 0.0,
        speed=solved.speed or 0.0,
        safe_z=to_mm(_setup(program, "safe_z"), program.unit),
        finish_tool=finish_tool,
        work_offset=int(_setup(program, "work_offset")),
        lookahead="" if found.side is None else tag,
        findings=found.findings,
        notes=tuple(_notes(found, program.unit)) if noted else (),
    )


def _notes(found: DerivedBlock, unit: Unit) -> Iterator[str]:
    """What whoever runs the file should know of the part: segments that are not cut, and surface that stays."""
    work = found.work
    if work is None or work.compensated is None or work.verdict is None:
        return
    if work.best is not None:
        yield "PATH BEST: THE TRUE OFFSET, NOT THE CONTROL'S"
    elif len(work.compensated.deleted):
        numbers = dict.fromkeys(work.compensated.deleted.segments.tolist())
        which = f"SEGMENT{'S' if len(numbers) > 1 else ''} {', '.join(f'{number:g}' for number in numbers)}"
        yield f"DELETED BY THE LOOK-AHEAD: {which}"
    if work.verdict.uncut:
        left, whole = (from_mm(length, unit) for length in (work.verdict.uncut_length, work.verdict.surface_length))
        yield f"UNCUT {show(left, Kind.LENGTH, unit)} OF {show(whole, Kind.LENGTH, unit)}"


def _whole(typed: Typed) -> int:
    return int(typed.value) if isinstance(typed, Entry) else 0


def _cutter(number: Typed, diameter: float | None, program: Program) -> Cutter | None:
    if diameter is None or not isinstance(number, Entry):
        return None
    tool = find(program, number.value)
    return Cutter(int(number.value), diameter, "" if tool is None else tool.type)


def _setup(program: Program, name: str) -> float:
    typed = getattr(program.setup, name)
    value = typed.value if isinstance(typed, Entry) else default(name, program.unit)
    assert value is not None
    return value


def _finish(found: DerivedBlock) -> tuple[Run, ...]:
    loops = () if found.work is None else found.work.loops
    return tuple(Run(loop.path, loop.lead_in, loop.lead_out) for loop in loops)


def _rough(found: DerivedBlock) -> tuple[Run, ...]:
    rough = () if found.work is None else found.work.rough
    return tuple(Run(loop.path, loop.lead_in, loop.lead_out, one.stock) for one in rough for loop in one.loops)
