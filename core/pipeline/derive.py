"""Every stage in its order: fields, surface, compensation, verdict, findings."""

from __future__ import annotations

from dataclasses import replace
from itertools import compress, count
from operator import is_not
from typing import Final

from core.comp.best_path.best_path import best_path, separation
from core.finding import Finding
from core.geometry.path import EMPTY, Path
from core.output.grid import Grid
from core.output.ready import objections
from core.pipeline.compensation import Compensation, parameter
from core.pipeline.derived import Derived, DerivedBlock, Loop, RoughPass, Work
from core.pipeline.jobs import job
from core.pipeline.outline import former, outline_block
from core.pipeline.steps import step_findings
from core.pipeline.trouble import better_findings, by_weight, open_finding, path_findings, size_warning
from core.pipeline.turns import turning_back
from core.program.model import Block, PathChoice, Program
from core.verify.judge import judge_on_ground, judge_together

MOST_PASSES: Final = 1000
"""More passes than this are a slip of the finger in MAX OFFSET or POCKET OVERLAP."""


def derive(program: Program, before: Derived | None = None) -> Derived:
    """The whole program derived; what does not change from `before` is taken from there."""
    blocks = (derive_block(number, block, program, before) for number, block in enumerate(program.blocks, 1))
    return Derived(program, tuple(blocks))


def derive_block(number: int, block: Block, program: Program, before: Derived | None = None) -> DerivedBlock:
    """One block derived, with all of its former self that depends on nothing that has changed."""
    old, then = former(number, before), None if before is None else before.program
    if old is not None and then is not None and old.known and _alike(block, program, old.block, then):
        return old
    found = outline_block(number, block, program, old)
    if not found.solved.pieces or found.radius is None:
        return replace(found, known=True)
    if old is None or then is None or old.work is None or _cuts(found, program) != _cuts(old, then):
        return _told(found, _worked(found, program, old), program)
    return _told(found, old.work, program)


def _alike(block: Block, program: Program, old: Block, then: Program) -> bool:
    """Whether a block and all it depends on are the same objects as before."""
    same = old is block and then.tools is program.tools and then.setup is program.setup
    return same and then.parameters is program.parameters and then.unit is program.unit


def _cuts(found: DerivedBlock, program: Program) -> tuple[object, ...]:
    """All that the paths depend on: depths, feeds and speeds change no path."""
    solved = found.solved
    shape = (solved.pieces, solved.closed, found.side, found.profile, found.lookahead.value)
    return (*shape, found.radius, solved.tool_diameter, solved.finish_diameter, program.parameters, program.unit)


def _surface(found: DerivedBlock, old: DerivedBlock | None) -> Path:
    """The surface; where an edit left nearly all of its pieces the objects they were, the others are put into it."""
    new = found.solved.pieces
    if old is not None and old.work is not None and len(old.solved.pieces) == len(new):
        rows = [*compress(count(), map(is_not, new, old.solved.pieces))]
        if 4 * len(rows) < len(new):
            return old.work.surface.altered((row, *new[row]) for row in rows)
    numbers, pieces = zip(*new, strict=True)
    return Path.from_pieces(pieces, numbers)


def _worked(found: DerivedBlock, program: Program, old: DerivedBlock | None) -> Work:
    surface = _surface(found, old)
    if found.side is None:
        return Work(surface, (Loop(surface, EMPTY, EMPTY),), None, None)
    assert found.radius is not None
    how = Compensation(surface, found.side, found.solved.closed, found.lookahead.value, program)
    crossed = how.crossed(found.radius)
    control = how.control(found.radius) if crossed is None else crossed.at([how.lookahead])[0]
    best = how.best(found.radius) if program.parameters.path is PathChoice.BEST else None
    chosen = how.posted(control, found.radius, best)
    before = None if old is None or old.work is None else old.work.ground
    verdict, ground = judge_on_ground(surface, found.side, found.radius, [loop.whole for loop in chosen], before)
    kept = None if crossed is None else ground
    return Work(surface, chosen, control, verdict, _rough(found, how), best, crossed, kept)


def _told(found: DerivedBlock, work: Work, program: Program) -> DerivedBlock:
    """The block with its paths, and with what is to be said of them."""
    assert found.radius is not None
    closed = found.solved.closed
    trouble: tuple[Finding, ...] = ()
    back: tuple[Finding, ...] = ()
    if work.verdict is not None:
        # what is typed wrong comes before what follows from it
        back = turning_back(work.surface, closed=closed)
        trouble = (*path_findings(work), *size_warning(found.radius, work.surface))
    if found.solved.whole:
        trouble += open_finding(work.surface, 2 * found.radius, closed=closed)
    findings = by_weight((*back, *found.findings, *trouble))
    return _checked(replace(found, work=work, known=True, findings=findings), program)


def _checked(found: DerivedBlock, program: Program) -> DerivedBlock:
    """With what forbids posting though every path is right, such as a SPEED of 0, and the steps in Z."""
    due = job(found, program, noted=False)
    new = (*dict.fromkeys(objections(due, Grid(program.unit))), *step_findings(due))
    return replace(found, findings=by_weight((*found.findings, *new))) if new else found


def compared(derived: Derived) -> Derived:
    """The same with the best path beside every control's path: what separates the two is among the findings."""
    return replace(derived, blocks=tuple(_compared(found) for found in derived.blocks))


def _compared(found: DerivedBlock) -> DerivedBlock:
    return replace(found, findings=(*found.findings, *better(found)))


def better(found: DerivedBlock) -> tuple[Finding, ...]:
    """How far the control's path is from the best one, where the control's path is the one that is posted."""
    work = found.work
    if work is None or work.compensated is None or work.best is not None or found.side is None:
        return ()
    best = best_path(work.surface, found.side, work.compensated.radius, closed=found.solved.closed)
    return better_findings(best, separation(work.compensated.path, best, work.compensated.radius))


def stocks(found: DerivedBlock, program: Program) -> tuple[float, ...]:
    """What each pass before the finish path leaves on the surface, in millimeters, outermost first.

    PROFILE comes in from MAX OFFSET, each pass overlapping the one before by POCKET OVERLAP percent of the cutter's
    diameter; a finish tool has a roughing pass in front of it that leaves FINISH XY.
    """
    assert found.solved.tool_diameter is not None
    finishing = found.solved.finish_diameter is not None
    least = parameter(program, "finish_xy") if finishing else 0.0
    widths: list[float] = []
    if found.profile:
        stock = parameter(program, "max_offset")
        step = found.solved.tool_diameter * (1.0 - parameter(program, "pocket_overlap") / 100.0)
        while stock > least + 1e-9 and step > 0.0 and len(widths) < MOST_PASSES:
            widths.append(stock)
            stock -= step
    return (*widths, least) if finishing else tuple(widths)


def _rough(found: DerivedBlock, how: Compensation) -> tuple[RoughPass, ...]:
    if found.solved.tool_diameter is None:
        return ()
    cutter = found.solved.tool_diameter / 2
    passes = []
    for stock in stocks(found, how.program):
        control = how.control(cutter + stock)
        loops = how.posted(control, cutter + stock)
        verdict = judge_together(how.surface, how.side, cutter + stock, [loop.whole for loop in loops])
        passes.append(RoughPass(stock, loops, control, verdict))
    return tuple(passes)
