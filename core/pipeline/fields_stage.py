"""The first stage calculates fields and the look-ahead, and cuts nothing yet.  It needs no numpy."""

from __future__ import annotations

from collections.abc import Iterable

from core.advice.field_findings import field_findings, typed_lookahead_warning
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD, calculated
from core.finding import Finding
from core.geometry.piece import Side
from core.pipeline.derived import Derived, DerivedBlock, LookAhead, Tag
from core.program.model import Block, CutterComp, Number, Program
from core.program.solve.block import solve_block
from core.program.solve.reading import shared_findings
from core.program.solve.solved import SolvedBlock

_SIDES = {
    CutterComp.ON: None,
    CutterComp.LEFT: Side.LEFT,
    CutterComp.RIGHT: Side.RIGHT,
    CutterComp.PROFILE_LEFT: Side.LEFT,
    CutterComp.PROFILE_RIGHT: Side.RIGHT,
}


def solve_fields(program: Program) -> Derived:
    """Return every block with its blanks and its look-ahead calculated, without geometry."""
    return Derived(program, tuple(solve_block_fields(program, number) for number in range(1, len(program.blocks) + 1)))


def solve_block_fields(program: Program, number: int) -> DerivedBlock:
    """Return block `number`, counted from 1, with its blanks and its look-ahead calculated, without paths."""
    block = program.blocks[number - 1]
    solved = solve_block(block, program)
    lookahead = _look_ahead(block, solved, solved.every_finding)
    side = _SIDES[block.cutter_comp]
    diameter = solved.finish_diameter if solved.finish_diameter is not None else solved.tool_diameter
    usr = () if side is None or lookahead.tag is Tag.CAL else (lookahead.value, lookahead.calculated)
    return DerivedBlock(
        number=number,
        block=block,
        solved=solved,
        lookahead=lookahead,
        side=side,
        profile=block.cutter_comp in (CutterComp.PROFILE_LEFT, CutterComp.PROFILE_RIGHT),
        radius=None if diameter is None else diameter / 2,
        paths=None,
        complete=False,
        findings=(
            *shared_findings(program),
            *solved.every_finding,
            *field_findings(block, solved, program),
            *((typed_lookahead_warning(*usr),) if usr else ()),
        ),
    )


def _look_ahead(block: Block, solved: SolvedBlock, findings: Iterable[Finding]) -> LookAhead:
    """Return the look-ahead in force: the operator's value, or the calculated one."""
    empty = sum(finding.code == "ZERO_LENGTH" for finding in findings)
    value = calculated(len(solved.segments) - empty, closed=solved.closed)
    match block.lookahead:
        case Number(typed) if MIN_LOOKAHEAD <= typed <= MAX_LOOKAHEAD:
            return LookAhead(int(typed), Tag.USR, value)
        case _:
            return LookAhead(value, Tag.CAL, value)
