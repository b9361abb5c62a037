"""Block cuts: where the path of one block cuts into the contour of another one, such as an island in a pocket."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from core.advice.block_paths import BlockPaths
from core.advice.path_findings import by_severity, move_names
from core.controls.judging.repeated_passes import PathKey, path_key
from core.controls.moves import Moves
from core.finding import Finding, Severity
from core.geometry.path import Floats
from core.output.passes import Job, heights
from core.pipeline.derived import DerivedBlock
from core.pipeline.jobs import job
from core.program.model import Program
from core.progress import Progress, silent
from core.verify.other_contours import ContourCut, Sweep, Wall, cuts_into_other_contours
from core.verify.report import Names


def with_block_cuts(
    blocks: Sequence[DerivedBlock], program: Program, progress: Progress = silent
) -> tuple[DerivedBlock, ...]:
    """Add to each block every other block's contour that its path cuts into, with a warning.

    Only blocks that can be posted are compared.
    """
    ready = [(block, block.paths, job(block, program)) for block in blocks if block.postable and block.paths]
    walls = [wall for block, paths, work in ready for wall in _walls(block, paths, work)] if len(ready) > 1 else []
    if not walls:
        return tuple(blocks)
    sweeps = {sweep: rows for block, paths, work in ready for sweep, rows in _sweeps(block, paths, work)}
    cuts = defaultdict[int, list[ContourCut]](list)
    for cut in _without_pairs(cuts_into_other_contours(walls, list(sweeps), progress)):
        cuts[cut.sweep.number].append(cut)
    return tuple(
        replace(
            block,
            findings=by_severity((*block.findings, *(_finding(cut, *sweeps[cut.sweep]) for cut in own))),
            cut_contours=tuple(cut.wall.path for cut in own),
        )
        if (own := cuts.get(block.number))
        else block
        for block in blocks
    )


def cuts_of_control(
    blocks: Sequence[DerivedBlock], works: Sequence[Job], runs: Sequence[tuple[int, Moves, float]], control: str
) -> tuple[Finding, ...]:
    """Warn of cuts into other blocks' contours by the moves of a control, where `with_block_cuts` found none.

    `works` are the blocks' jobs, in order.  `runs` are the control's compensated runs, each with its block's number and
    the cutter's radius.
    """
    walls = list[Wall]()
    for block, work in zip(blocks, works, strict=True):
        walls += [] if block.paths is None else _walls(block, block.paths, work)
    shapes = {wall.number: frozenset([wall.shape]) for wall in walls}
    sweeps = dict[tuple[int, PathKey, float], Sweep]()
    for number, moves, radius in runs:
        path, heights_of_moves = moves.path(), moves.heights()
        key = number, path_key(path), radius
        if len(path) and (key not in sweeps or heights_of_moves.min() < sweeps[key].heights.min()):
            sweeps[key] = Sweep(path, heights_of_moves, radius, shapes.get(number, frozenset()), number=number)
    known = {
        (block.number, wall.number)
        for block in blocks
        for wall in walls
        if any(path is wall.path for path in block.cut_contours)
    }
    deepest = dict[tuple[int, int], ContourCut]()
    for cut in cuts_into_other_contours(walls, list(sweeps.values())):
        pair = cut.sweep.number, cut.wall.number
        is_known = pair in known or (cut.through and pair[::-1] in known)
        if not is_known and (pair not in deepest or cut.gouge.depth > deepest[pair].gouge.depth):
            deepest[pair] = cut
    return tuple(_lead_finding(cut, control) for cut in deepest.values())


def _lead_finding(cut: ContourCut, control: str) -> Finding:
    does = "runs through" if cut.through else "cuts {value} into"
    text = f"The move of {control} into the cut or out of it {does} the contour of block {cut.wall.number} "
    text += "at X {x} Y {y}. Start elsewhere, or post the center path."
    gouge = cut.gouge
    return Finding(
        "OTHER_BLOCK", Severity.WARNING, text, at=gouge.surface_at, value=gouge.depth, block=cut.sweep.number
    )


def _walls(block: DerivedBlock, paths: BlockPaths, work: Job) -> Iterator[Wall]:
    """Yield the contour of a block; with CUTTER COMP. ON it is no wall."""
    if block.side is None:
        return
    # a cut that does not come down to the floor may be a step or a groove
    top = max((height for floor in work.floors for height in (floor.z_start, floor.z_end)), default=work.z_bottom)
    yield Wall(paths.surface, block.side, top, path_key(paths.surface), number=block.number)


def _sweeps(block: DerivedBlock, paths: BlockPaths, work: Job) -> Iterator[tuple[Sweep, tuple[Names, Floats]]]:
    """Yield each loop of a block's paths at its deepest, numbered by rows, and what these rows are."""
    assert work.cutter is not None
    stages = [(work.finisher or work.cutter, paths)]
    stages += [(work.cutter, replace(paths, loops=rough.loops)) for rough in paths.rough]
    shapes = frozenset([path_key(paths.surface)])
    for cutter, stage in stages:
        if not stage.loops:
            continue
        first, names, numbers = 0, move_names(stage), np.concatenate([loop.with_leads.numbers for loop in stage.loops])
        for loop in stage.loops:
            rows = np.arange(first, first + len(loop.with_leads), dtype=np.float64)
            path = replace(loop.with_leads, numbers=rows)
            yield Sweep(path, heights(work, loop), cutter.diameter / 2, shapes, number=block.number), (names, numbers)
            first += len(rows)


def _without_pairs(cuts: Sequence[ContourCut]) -> Iterator[ContourCut]:
    """Yield the cuts; where two paths run through each other's contours, only that of the later block."""
    through = {(cut.sweep.number, cut.wall.number) for cut in cuts if cut.through}
    for cut in cuts:
        path, wall = cut.sweep.number, cut.wall.number
        if path > wall or not {(path, wall), (wall, path)} <= through:
            yield cut


def _finding(cut: ContourCut, names: Names, numbers: Floats) -> Finding:
    """Return the warning; `names` and `numbers` are those of the rows of the cutting path."""
    gouge, row = cut.gouge, int(cut.gouge.path_number)
    name, segment = names(row, 0.0), numbers[row].item()
    does = "runs through" if cut.through else "cuts {value} into"
    text = f"{name[0].upper()}{name[1:]} {does} the contour of block {cut.wall.number} at X {{x}} Y {{y}}. "
    text += "Check that this wall may be cut."
    return Finding("OTHER_BLOCK", Severity.WARNING, text, segment, at=gouge.surface_at, value=gouge.depth)
