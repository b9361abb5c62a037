"""Derived blocks: a program's blocks with all that follows from them.  The first paint loads this: no numpy here."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from core.advice.block_paths import BlockPaths
from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.program.model import Block, Program
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
