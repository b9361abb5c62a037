"""What is known of a program, block by block.  Needs no numpy, so that a first screen can be painted without."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.program.model import Block, Program
from core.program.solve.solved import SolvedBlock

if TYPE_CHECKING:
    from core.comp.best_path.best_path import BestPath
    from core.comp.compensate import Crossed
    from core.comp.result import Compensated
    from core.geometry.path import Path
    from core.verify.judge import Ground
    from core.verify.verdict import Verdict


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
class RoughPass:
    """One pass before the finish path: its `loops` leave `stock` millimeters on the surface.

    `compensated` is the control's path, whether posted or not.  `verdict` is that of a cutter larger by the stock: what
    it gouges deeper than the stock is cut into the part, the rest is stock that is not left.
    """

    stock: float
    loops: tuple[Loop, ...]
    compensated: Compensated
    verdict: Verdict


@dataclass(frozen=True, eq=False, slots=True)
class Loop:
    """One center path with its blend moves, cut in one go."""

    path: Path
    lead_in: Path
    lead_out: Path

    @property
    def whole(self) -> Path:
        """Blend-in, path and blend-out as one path."""
        from core.geometry.path import joined

        return joined((self.lead_in, self.path, self.lead_out))


@dataclass(frozen=True, eq=False, slots=True)
class Work:
    """What the cutter does in one block, in millimeters.

    `surface` is the determined part of the contour; `loops` the finish path that is posted, one or, for PATH BEST,
    one for each loop, and `verdict` what it does.  `compensated` is the control's path, whether posted or not.
    `compensated` and `verdict` are None for CUTTER COMP. ON, where the center runs on the contour itself.
    `rough` comes before, outermost first.  `best` is the best path where PATH is BEST.  `crossed` is what `compensated`
    and the paths of all other look-aheads were made of, `ground` the surface as they are judged over it; both are None
    for a contour so large that they are not kept.
    """

    surface: Path
    loops: tuple[Loop, ...]
    compensated: Compensated | None
    verdict: Verdict | None
    rough: tuple[RoughPass, ...] = ()
    best: BestPath | None = None
    crossed: Crossed | None = None
    ground: Ground | None = None

    @property
    def center(self) -> Path:
        """The first loop with its blends; the empty path if there is none."""
        from core.geometry.path import EMPTY

        return self.loops[0].whole if self.loops else EMPTY


@dataclass(frozen=True, eq=False, slots=True)
class DerivedBlock:
    """One block with everything that follows from it.

    `radius` is the finish path's cutter radius in millimeters, None without a usable tool; `side` is None for ON.
    `work` is None in an outline, and when there is no surface or no radius to work with; `known` tells the two apart.
    """

    number: int
    block: Block
    solved: SolvedBlock
    lookahead: LookAhead
    side: Side | None
    profile: bool
    radius: float | None
    work: Work | None
    known: bool
    findings: tuple[Finding, ...]

    @property
    def postable(self) -> bool:
        """Nothing is unread, undetermined or gouged."""
        return self.known and self.work is not None and not self.errors

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
