"""What is known of a program, block by block.  Needs no numpy, so that a first screen can be shown without."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.advice.block_paths import BlockPaths
from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.program.model import Block, Program
from core.program.solve.solved import SolvedBlock


class Tag(StrEnum):
    """Whether a look-ahead was calculated or typed."""

    CAL = "CAL"
    USR = "USR"


@dataclass(frozen=True, slots=True)
class LookAhead:
    """CUTCOMP LOOKAHEAD: the value in force, its tag, and what CAL would be."""

    value: int
    tag: Tag
    calculated: int


@dataclass(frozen=True, eq=False, slots=True)
class DerivedBlock:
    """One block with everything that follows from it.

    `radius` is the finish path's cutter radius in millimeters, None without a usable tool; `side` is None for ON.
    `profile` is whether CUTTER COMP. is PROFILE LEFT or RIGHT: roughing comes in from MAX OFFSET.  `paths` is None
    before they are made, and without a surface or a radius to make them of; `known` is whether that has been tried.
    """

    number: int
    block: Block
    solved: SolvedBlock
    lookahead: LookAhead
    side: Side | None
    profile: bool
    radius: float | None
    paths: BlockPaths | None
    known: bool
    findings: tuple[Finding, ...]

    @property
    def postable(self) -> bool:
        """Derived, with paths, and without a finding that is an error."""
        return self.known and self.paths is not None and not self.errors

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that forbid posting."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)


@dataclass(frozen=True, eq=False, slots=True)
class Derived:
    """A program and all its blocks derived; `program` tells whether a late result is still the right one."""

    program: Program
    blocks: tuple[DerivedBlock, ...]

    def block(self, number: int) -> DerivedBlock:
        """Block `number`, counted from 1."""
        return self.blocks[number - 1]
