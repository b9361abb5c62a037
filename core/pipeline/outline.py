"""The first stage: fields calculated, look-ahead known, nothing cut yet.  Needs no numpy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from operator import attrgetter
from typing import Final

from core.comp.lookahead import HIGHEST, LOWEST, calculated
from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.pipeline.derived import Derived, DerivedBlock, LookAhead, Tag
from core.pipeline.safe_height import safe_height_findings
from core.pipeline.unsaid import unsaid_findings
from core.program.model import Block, CutterComp, Entry, Program
from core.program.shared import shared_findings
from core.program.solve.solve import solve_block
from core.program.solve.solved import SolvedBlock
from core.tolerance import JOINED

_SIDES = {
    CutterComp.ON: None,
    CutterComp.LEFT: Side.LEFT,
    CutterComp.RIGHT: Side.RIGHT,
    CutterComp.PROFILE_LEFT: Side.LEFT,
    CutterComp.PROFILE_RIGHT: Side.RIGHT,
}


def outline(program: Program, before: Derived | None = None) -> Derived:
    """Every block with its blanks calculated and its look-ahead, without geometry.

    Segments that are the same objects as in `before` are taken from there.
    """
    blocks = (
        outline_block(number, block, program, former(number, before)) for number, block in enumerate(program.blocks, 1)
    )
    return Derived(program, tuple(blocks))


def former(number: int, before: Derived | None) -> DerivedBlock | None:
    """What a block was before, by its place in the program."""
    return before.block(number) if before is not None and number <= len(before.blocks) else None


def outline_block(number: int, block: Block, program: Program, before: DerivedBlock | None = None) -> DerivedBlock:
    """One block's outline."""
    solved = solve_block(block, program, None if before is None else before.solved)
    told = solved.every_finding
    lookahead = look_ahead(block, solved, told)
    side = _SIDES[block.cutter_comp]
    diameter = solved.finish_diameter if solved.finish_diameter is not None else solved.tool_diameter
    return DerivedBlock(
        number=number,
        block=block,
        solved=solved,
        lookahead=lookahead,
        side=side,
        profile=block.cutter_comp in (CutterComp.PROFILE_LEFT, CutterComp.PROFILE_RIGHT),
        radius=None if diameter is None else diameter / 2,
        work=None,
        known=False,
        findings=(
            *shared_findings(program),
            *told,
            *_heights(solved),
            *safe_height_findings(solved, program),
            *unsaid_findings(block, solved, program),
            *_usr_warning(lookahead, side),
        ),
    )


def look_ahead(block: Block, solved: SolvedBlock, told: Iterable[Finding]) -> LookAhead:
    """The look-ahead in force: the operator's value, or the calculated one; `told` is all that is found in fields."""
    empty = sum(one.code == "ZERO_LENGTH" for one in told)
    value = calculated(len(solved.segments) - empty, closed=solved.closed)
    match block.lookahead:
        case Entry(typed) if LOWEST <= typed <= HIGHEST:
            return LookAhead(int(typed), Tag.USR, value)
        case _:
            return LookAhead(value, Tag.CAL, value)


def _heights(solved: SolvedBlock) -> Iterator[Finding]:
    """Typed Z ENDs that are not between Z START and Z BOTTOM: no pass goes deeper, and rapid moves run above."""
    if solved.z_start is None or solved.z_bottom is None:
        return
    high, low = solved.z_start + JOINED, solved.z_bottom - JOINED
    # few contours end at more than one depth
    if all(low <= depth <= high for depth in set(map(_depth, solved.segments))):
        return
    for one in solved.segments:
        if low <= one.z_end <= high or not isinstance(one.values.get("z_end"), Entry):
            continue
        if one.z_end > high:
            text = "Z END {value} lies above Z START {0}: rapid moves would run into it. Enter Z END between Z START "
            yield _height(one.number, text + "and Z BOTTOM.", one.z_end, solved.z_start)
        elif one.z_end < low:
            text = "Z END {value} lies below Z BOTTOM {0}: no pass goes so deep. Enter Z END between Z START "
            yield _height(one.number, text + "and Z BOTTOM.", one.z_end, solved.z_bottom)


_depth: Final = attrgetter("z_end")


def _height(number: int, text: str, height: float, limit: float) -> Finding:
    return Finding("Z_END", Severity.ERROR, text, float(number), "z_end", value=height, lengths=(limit,))


def _usr_warning(lookahead: LookAhead, side: Side | None) -> tuple[Finding, ...]:
    if side is None or lookahead.tag is Tag.CAL:
        return ()
    text = f"CUTCOMP LOOKAHEAD {lookahead.value} was typed; the calculated value is {lookahead.calculated}."
    text += " RECALCULATE LOOKAHEAD goes back to it."
    return (Finding("USR_LOOKAHEAD", Severity.WARNING, text, field="lookahead"),)
