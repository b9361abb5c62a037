"""Derives all of a program: fields, surface, paths, verdict, findings; the look-ahead table and remedies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from core.advice.block_paths import BlockPaths, RoughPass
from core.advice.largest_blend import with_largest_blend
from core.advice.lookahead_table import CuttingSetup, Row, Table, judge_lookaheads
from core.advice.path_findings import (
    better_path_findings,
    by_severity,
    open_finding,
    path_findings,
    size_warning,
    tight_arcs,
    turning_back,
    z_step_findings,
)
from core.advice.remedies import advice_for, largest_tool, without_blends
from core.comp.best_path.best_path import BestPath, best_path
from core.comp.best_path.separation import separation
from core.comp.compensate import blend_in, blend_out
from core.comp.compensated import CenterPath, Compensated
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Side
from core.output.grid import Grid
from core.output.objections import OVERRIDABLE_CODES, job_errors
from core.output.passes import z_steps
from core.pipeline.block_cuts import with_block_cuts
from core.pipeline.derived import Derived, DerivedBlock, solve_block_fields
from core.pipeline.jobs import MAX_SIDE_PASSES, job, parameter, stocks
from core.program.model import PathChoice, Program
from core.progress import Progress, part, silent
from core.units import Kind, decimals_shown, from_mm, to_mm
from core.verify.judge import judge
from core.verify.verdict import Verdict

SOLVED_SHARE = 0.4
"""Share of the work on a block that is done when its fields are solved."""
BLOCKS_SHARE = 0.9
"""Share of the work on a program that is done when its blocks are derived; then they are compared."""
JUDGED_SHARE = 0.9
"""Share of the work on a block that is done when its paths are judged."""


def derive(program: Program, progress: Progress = silent) -> Derived:
    """Derive every block of a program, and what they cut of one another; `progress` may raise Stopped."""
    count = len(program.blocks)
    each = part(progress, 0.0, BLOCKS_SHARE)
    blocks = [derive_block(program, at + 1, part(each, at / count, (at + 1) / count)) for at in range(count)]
    return Derived(program, with_block_cuts(blocks, program, part(progress, BLOCKS_SHARE, 1.0)))


def derive_block(program: Program, number: int, progress: Progress = silent) -> DerivedBlock:
    """Derive block `number`, counted from 1."""
    block = solve_block_fields(program, number)
    progress(SOLVED_SHARE)
    if not block.solved.pieces or block.radius is None:
        return replace(block, complete=True)
    paths = _block_paths(block, program, part(progress, SOLVED_SHARE, JUDGED_SHARE))
    progress(JUDGED_SHARE)
    return _with_findings(block, paths, program, part(progress, JUDGED_SHARE, 1.0))


def with_better_paths(derived: Derived) -> Derived:
    """Add to the findings what separates each posted control path from the best path."""
    blocks = (replace(block, findings=(*block.findings, *better_path(block))) for block in derived.blocks)
    return Derived(derived.program, tuple(blocks))


def better_path(block: DerivedBlock) -> tuple[Finding, ...]:
    """Return how far the control's path is from the best one, if the control's path is the one posted."""
    paths = block.paths
    if paths is None or paths.compensated is None or paths.best is not None or block.side is None:
        return ()
    best = best_path(paths.surface, block.side, paths.compensated.radius, closed=block.solved.closed)
    findings = better_path_findings(best, separation(paths.compensated.path, best, paths.compensated.radius))
    # the corner at START belongs to the last segment
    last = float(paths.surface.numbers[-1])
    return tuple(item if item.segment is None else replace(item, segment=min(item.segment, last)) for item in findings)


def _block_paths(block: DerivedBlock, program: Program, progress: Progress) -> BlockPaths:
    """Return the surface of a block, its paths and the verdict on them."""
    numbers, pieces = zip(*block.solved.pieces, strict=True)
    surface = Path.from_pieces(pieces, numbers)
    setup = _setup(block, surface, program)
    if setup is None:
        return BlockPaths(surface, (CenterPath(surface),), None, None)
    control, best, loops = _paths(setup, setup.radius, block, program)
    progress(0.3)
    verdict = _verdict(setup, setup.radius, loops)
    progress(0.6)
    rough = []
    for stock in setup.stocks:
        radius = (block.solved.tool_diameter or 0.0) / 2 + stock
        rough_control, _, rough_loops = _paths(setup, radius, block, program)
        rough.append(RoughPass(stock, rough_loops, rough_control, _verdict(setup, radius, rough_loops)))
        progress(0.6)
    return BlockPaths(surface, loops, control, verdict, tuple(rough), best)


def _paths(
    setup: CuttingSetup, radius: float, block: DerivedBlock, program: Program
) -> tuple[Compensated, BestPath | None, tuple[CenterPath, ...]]:
    """Return the control's path, the best path if PATH is BEST, and the loops that are posted, with their blends.

    Those are the control's path, or every loop of the best one.
    """
    (control,) = setup.paths(radius, (block.lookahead.value,))
    if program.parameters.path is not PathChoice.BEST:
        return control, None, (control,) if len(control.path) else ()
    best = best_path(setup.surface, setup.side, radius, closed=setup.closed)
    side, blend, overlap = setup.side, setup.blend, setup.overlap
    loops = tuple(
        CenterPath(loop, blend_in(loop, side, blend), blend_out(loop, side, blend, overlap, closed=ring))
        for loop, ring in zip(best.loops, best.closed, strict=True)
    )
    return control, best, loops


def _verdict(setup: CuttingSetup, radius: float, loops: tuple[CenterPath, ...]) -> Verdict:
    """Return the verdict on a cutter that runs these loops."""
    return judge(setup.surface, setup.side, radius, [loop.with_leads for loop in loops])


def _with_findings(block: DerivedBlock, paths: BlockPaths, program: Program, progress: Progress) -> DerivedBlock:
    """Add a block's paths and their findings, and whatever else forbids posting, such as a SPEED of 0."""
    assert block.radius is not None
    closed = block.solved.closed
    back: tuple[Finding, ...] = ()
    trouble: tuple[Finding, ...] = ()
    if paths.verdict is not None:
        # a typing mistake comes before its consequences
        back = turning_back(paths.surface, closed=closed)
        trouble = path_findings(paths)
        if block.side is not None:
            if block.solved.fully_determined:
                trouble += size_warning(block.radius, paths.surface, block.side, closed=closed)
            trouble = _with_largest_blend(trouble, paths, block.side, program, progress)
            trouble += tight_arcs(paths.verdict, paths.surface, block.side, block.radius)
    if len(paths.rough) > MAX_SIDE_PASSES:
        text = f"MAX OFFSET makes more than {MAX_SIDE_PASSES} side passes. "
        text += "Reduce it or POCKET OVERLAP, or use a larger tool."
        trouble += (Finding("SIDE_PASSES", Severity.ERROR, text, field="max_offset"),)
    if block.solved.fully_determined:
        trouble += open_finding(paths.surface, 2 * block.radius, closed=closed)
    findings = by_severity((*back, *block.findings, *trouble))
    block = replace(block, paths=paths, complete=True, findings=findings)
    block_job = job(block, program)
    further = (*dict.fromkeys(job_errors(block_job, Grid(program.unit))), *z_step_findings(z_steps(block_job)))
    return replace(block, findings=by_severity((*findings, *further)))


def _with_largest_blend(
    findings: tuple[Finding, ...], paths: BlockPaths, side: Side, program: Program, progress: Progress
) -> tuple[Finding, ...]:
    decimals, unit = decimals_shown(Kind.LENGTH, program.unit), program.unit
    typed = int(from_mm(parameter(program, "blend_offset"), unit) * 10**decimals + 1e-6)
    return with_largest_blend(findings, paths, side, lambda steps: to_mm(steps / 10**decimals, unit), typed, progress)


def look_ahead_table(
    block: DerivedBlock,
    program: Program,
    progress: Progress = silent,
    report_rows: Callable[[tuple[Row, ...]], None] | None = None,
) -> Table | None:
    """Return the table of a derived block; None for ON and while there is nothing to compensate.

    Call `report_rows` with all rows so far whenever some are complete.
    """
    setup = cutting_setup(block, program)
    return None if setup is None else judge_lookaheads(setup, progress, report_rows)


def cutting_setup(block: DerivedBlock, program: Program) -> CuttingSetup | None:
    """Return what a derived block cuts; None for ON and while there is nothing to compensate."""
    return None if block.paths is None else _setup(block, block.paths.surface, program)


def _setup(block: DerivedBlock, surface: Path, program: Program) -> CuttingSetup | None:
    if block.side is None or block.radius is None:
        return None
    return CuttingSetup(
        surface,
        block.side,
        block.radius,
        block.solved.closed,
        parameter(program, "blend_offset"),
        parameter(program, "blend_overlap"),
        () if block.solved.tool_diameter is None else stocks(block, program),
        None if block.solved.finish_diameter is None else (block.solved.tool_diameter or 0.0) / 2,
        to_mm(10.0 ** -decimals_shown(Kind.LENGTH, program.unit), program.unit),
    )


def advice_for_block(
    block: DerivedBlock, program: Program, table: Table | None = None, progress: Progress = silent
) -> tuple[Finding, ...]:
    """Return what a derived block needs; `table` is its look-ahead table if known.  Empty if nothing is compensated.

    `progress` may raise Stopped before each remedy is tried.
    """
    setup = cutting_setup(block, program)
    if setup is None:
        return ()
    return advice_for(setup, block.lookahead.calculated, table or judge_lookaheads(setup), progress)


def remedy_for_gouge(block: DerivedBlock, program: Program) -> Finding | None:
    """Return what cuts a gouging block clean: the look-ahead that the table recommends, else the largest fitting tool.

    None if the block does not gouge, if only its blend arcs do, which their findings mend, and if neither helps.
    """
    setup = cutting_setup(block, program)
    if setup is None or not any(finding.code in OVERRIDABLE_CODES for finding in block.errors):
        return None
    table = judge_lookaheads(setup)
    if table.recommended is not None:
        effect, lengths = table.row(table.recommended).effect
        text = f"Block {block.number}: CUTCOMP LOOKAHEAD {table.recommended} {effect}."
        return Finding("LOOKAHEAD_FITS", Severity.INFO, text, field="lookahead", lengths=lengths)
    bare = without_blends(setup)
    if bare is not None and judge_lookaheads(bare).row(block.lookahead.value).clean:
        return None
    fits = largest_tool(setup)
    if fits is None:
        return None
    text = f"Block {block.number}: the tool is too big; {fits.sentence()}"
    return Finding("TOOL_FITS", Severity.INFO, text, field="tool", value=fits.diameter, lengths=fits.lengths)
