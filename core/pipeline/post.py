"""Posts a derived program as NC text, for the tool center or for a control that compensates by itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import pi

from core.comp.compensated import Compensated
from core.controls.control_names import display_name
from core.controls.moves import Moves
from core.controls.registry import is_klartext, run
from core.controls.write.contour_pass import CenterMove, CompensatedPass, PassToWrite, UncompensatedPass
from core.controls.write.iso_program import tools_of
from core.controls.write.iso_style import STYLE_OF_CONTROL
from core.controls.write.lead_moves import LEAD_LENGTHS
from core.controls.write.written_program import Posted, Refusal
from core.finding import Finding, Severity
from core.geometry.construct import rotated
from core.geometry.piece import Arc, Turn
from core.output.control_program import control_program, control_program_errors
from core.output.nc import center_path_program
from core.output.passes import Job, Pass, passes
from core.pipeline.block_cuts import cuts_of_control
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.jobs import jobs
from core.program.model import PathChoice
from core.tolerance import CLOSED


def post_center_path(derived: Derived, *, name: str, override: str | None = None) -> Posted | Refusal:
    """Return the NC text of the tool center path, or the refusal; `override` as in `center_path_program`."""
    program = derived.program
    return center_path_program(jobs(derived), program.unit, name=name, part=program.setup.name, override=override)


def post_control_program(derived: Derived, *, name: str, control: str) -> Posted | Refusal:
    """Return the program for a control, by its full name in the registry, or the refusal.

    A lead that cuts into the contour of another block is made shorter; if that does not help, a warning says so.
    """
    unit, all_jobs = derived.program.unit, jobs(derived)
    best = _best_path_refused(derived) if any(job.comp != "ON" for job in all_jobs) else ()
    errors = (*control_program_errors(all_jobs, unit), *best)
    if errors:
        return Refusal(errors, unit)
    cuts = [cut for block, job in zip(derived.blocks, all_jobs, strict=True) for cut in _cuts(block, job)]

    def written(cuts: Sequence[PassToWrite], warnings: tuple[Finding, ...] = ()) -> Posted | Refusal:
        part = derived.program.setup.name
        return control_program(all_jobs, cuts, unit, name=name, control=control, part=part, warnings=warnings)

    posted = written(cuts)
    if isinstance(posted, Refusal) or len(derived.blocks) < 2:
        return posted
    warnings = _cuts_by_leads(derived, all_jobs, cuts, posted, control)
    # Klartext needs no leads
    for longest in () if is_klartext(control) else LEAD_LENGTHS[1:]:
        if not warnings:
            return posted
        cutting = {warning.block for warning in warnings}
        shorter = [
            replace(cut, longest_lead=longest) if isinstance(cut, CompensatedPass) and cut.block in cutting else cut
            for cut in cuts
        ]
        trial = written(shorter)
        if isinstance(trial, Refusal):
            break
        cuts, posted, warnings = shorter, trial, _cuts_by_leads(derived, all_jobs, shorter, trial, control)
    return written(cuts, warnings) if warnings else posted


def _cuts_by_leads(
    derived: Derived, jobs_of_blocks: Sequence[Job], cuts: Sequence[PassToWrite], posted: Posted, control: str
) -> tuple[Finding, ...]:
    """Warn of each block whose path on the control cuts into the contour of another, where its own path does not.

    The moves into the cut and out of it are the control's: the block's verdict does not know them.
    """
    tools = {} if is_klartext(control) else tools_of(cuts, STYLE_OF_CONTROL[control])
    control_run = run(posted.text.encode("ascii"), control, tools, derived.program.unit)
    # read back, it has a stretch for each of them
    compensated = [cut for cut in cuts if isinstance(cut, CompensatedPass)]
    sweeps = list[tuple[int, Moves, float]]()
    for cut, stretch in zip(compensated, control_run.stretches, strict=True):
        sweeps.append((cut.block or 0, control_run.moves.part(stretch.first, stretch.last), cut.diameter / 2))
    return cuts_of_control(derived.blocks, jobs_of_blocks, sweeps, display_name(control))


def _best_path_refused(derived: Derived) -> tuple[Finding, ...]:
    """Refuse the best path: it is a tool center path that no control makes from a contour."""
    if derived.program.parameters.path is not PathChoice.BEST:
        return ()
    text = "PATH is BEST, which no control's own compensation runs.  Post the center path, or choose PATH CONTROL."
    return (Finding("NOTWRITTEN", Severity.ERROR, text, field="path"),)


def _cuts(block: DerivedBlock, job: Job) -> list[PassToWrite]:
    if job.comp == "ON":
        return [_uncompensated(a_pass, job) for a_pass in passes(job)]
    feeds = {floor.number: floor.feed or 0.0 for floor in job.floors}
    return [_cut(a_pass, _compensated(block, job, a_pass), feeds, job) for a_pass in passes(job)]


def _uncompensated(a_pass: Pass, job: Job) -> UncompensatedPass:
    """Return a pass with nothing to compensate: the tool center runs on the contour."""
    heights = [motion.z for motion in a_pass.motions]
    return UncompensatedPass(
        travels=tuple(_travels(a_pass.motions)),
        tool=a_pass.cutter.number,
        diameter=a_pass.cutter.diameter,
        stock=0.0,
        speed=a_pass.speed,
        feeds={},
        plunge_feed=job.plunge_feed,
        travel=heights[0],
        near=heights[0],
        depth=min(heights),
        leave=heights[-1],
        block=job.block,
    )


def _travels(motions: Sequence[CenterMove]) -> Iterator[CenterMove]:
    """Yield the moves; an arc whose end is next to its start becomes a line, or two halves, not a full circle.

    The digits of most controls cannot tell such an end from the start.
    """
    before = motions[0]
    for motion in motions:
        start, end = (before.x, before.y), (motion.x, motion.y)
        turn, center, z = motion.turn, motion.center, (before.z + motion.z) / 2
        if turn and start != end and max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= CLOSED:
            sweep = Arc(start, end, center, Turn(turn)).sweep
            if abs(sweep) < pi:
                turn = 0
            else:
                yield CenterMove(*rotated(start, center, sweep / 2), z, motion.feed, turn, center)
        yield motion._replace(turn=turn)
        before = motion


def _compensated(block: DerivedBlock, job: Job, a_pass: Pass) -> Compensated:
    """Return the compensated run that a pass follows."""
    work = block.paths
    assert work is not None
    assert work.compensated is not None
    if a_pass.finishing or (job.finisher is None and a_pass.stock == 0.0):
        return work.compensated
    return next(rough.compensated for rough in work.rough if rough.stock == a_pass.stock)


def _cut(a_pass: Pass, run: Compensated, feeds: dict[int, float], job: Job) -> CompensatedPass:
    first_feed = next(index for index, motion in enumerate(a_pass.motions) if not motion.rapid)
    return CompensatedPass(
        compensated=run,
        tool=a_pass.cutter.number,
        diameter=a_pass.cutter.diameter,
        stock=a_pass.stock,
        speed=a_pass.speed,
        feeds=feeds,
        plunge_feed=job.plunge_feed,
        travel=a_pass.motions[0].z,
        near=a_pass.motions[first_feed - 1].z,
        depth=a_pass.motions[first_feed].z,
        leave=a_pass.motions[-1].z,
        block=job.block,
    )
