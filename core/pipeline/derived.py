"""Derived blocks: a program's blocks with all that follows from them, and the first stage, which cuts nothing yet.

The first stage calculates fields and the look-ahead.  The first paint loads this: no numpy here.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from core.advice.block_paths import BlockPaths
from core.advice.field_findings import field_findings, typed_lookahead_warning
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD, calculated
from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.program.model import Block, CutterComp, Number, Program
from core.program.solve.block import solve_block
from core.program.solve.reading import shared_findings
from core.program.solve.solved import SolvedBlock

if TYPE_CHECKING:
    from core.geometry.path import Path


class Tag(StrEnum):
    """The origin of a look-ahead: calculated or typed."""

    CAL = "CAL"
    USR = "USR"


@dataclass(frozen=True, slots=True)
class LookAhead:
    """CUTCOMP LOOKAHEAD: the value in force, its tag, and the calculated value."""

    value: int
    tag: Tag
    calculated: int


@dataclass(frozen=True, eq=False, slots=True)
class DerivedBlock:
    """One block with everything derived from it.

    `radius` is the finish path's cutter radius in millimeters, None without a usable tool; `side` is None for ON.
    `profile`: CUTTER COMP. is PROFILE LEFT or RIGHT, so that roughing comes in from MAX OFFSET.  After the first stage
    only fields and look-ahead are calculated, and `complete` is False.  In a complete block `paths` is None if there is
    no surface or no radius.  `cut_contours` are those of other blocks that its path cuts into.
    """

    number: int
    block: Block
    solved: SolvedBlock
    lookahead: LookAhead
    side: Side | None
    profile: bool
    radius: float | None
    paths: BlockPaths | None
    complete: bool
    findings: tuple[Finding, ...]
    cut_contours: tuple[Path, ...] = ()

    @property
    def postable(self) -> bool:
        """True if the block is complete, has paths, and has no finding that is an error."""
        return self.complete and self.paths is not None and not self.errors

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that forbid posting."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)


@dataclass(frozen=True, eq=False, slots=True)
class Derived:
    """A program and all its blocks, derived; `program` identifies it, so that a late result can be discarded."""

    program: Program
    blocks: tuple[DerivedBlock, ...]

    def block(self, number: int) -> DerivedBlock:
        """Return block `number`, counted from 1."""
        return self.blocks[number - 1]


def solve_fields(program: Program) -> Derived:
    """Return every block with its blanks and its look-ahead calculated, without geometry."""
    return Derived(program, tuple(solve_block_fields(program, number) for number in range(1, len(program.blocks) + 1)))


def solve_block_fields(program: Program, number: int) -> DerivedBlock:
    """Return block `number`, counted from 1, with its blanks and its look-ahead calculated, without paths."""
    block = program.blocks[number - 1]
    solved = solve_block(block, program)
    lookahead = _look_ahead(block, solved)
    comp = block.cutter_comp
    side = None if comp is CutterComp.ON else Side(comp.removeprefix("PROFILE "))
    diameter = solved.finish_diameter if solved.finish_diameter is not None else solved.tool_diameter
    usr = () if side is None or lookahead.tag is Tag.CAL else (lookahead.value, lookahead.calculated)
    return DerivedBlock(
        number=number,
        block=block,
        solved=solved,
        lookahead=lookahead,
        side=side,
        profile=comp.startswith("PROFILE"),
        radius=None if diameter is None else diameter / 2,
        paths=None,
        complete=False,
        findings=(
            *shared_findings(program),
            *solved.all_findings,
            *field_findings(block, solved, program),
            *((typed_lookahead_warning(*usr),) if usr else ()),
        ),
    )


def _look_ahead(block: Block, solved: SolvedBlock) -> LookAhead:
    """Return the look-ahead in force: the operator's value, or the calculated one."""
    empty = sum(finding.code == "ZERO_LENGTH" for finding in solved.all_findings)
    value, typed = calculated(len(solved.segments) - empty, closed=solved.closed), block.lookahead
    if isinstance(typed, Number) and MIN_LOOKAHEAD <= typed.value <= MAX_LOOKAHEAD:
        return LookAhead(int(typed.value), Tag.USR, value)
    return LookAhead(value, Tag.CAL, value)
