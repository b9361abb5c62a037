"""Result of cutting one block: its surface, rough and finish paths in millimeters, and the verdict.  Needs no numpy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from core.comp.best_path.best_path import BestPath
    from core.comp.compensated import Compensated
    from core.geometry.path import Path
    from core.verify.verdict import Verdict


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
class BlockPaths:
    """Every path of a block and what it does to the surface.

    `surface` is the determined part of the contour; `loops` the finish path that is posted, one or, for PATH BEST,
    one for each loop, and `verdict` what it does.  `compensated` is the control's path, whether posted or not.
    `compensated` and `verdict` are None for CUTTER COMP. ON, where the center runs on the contour itself.
    `rough` comes before, outermost first.  `best` is the best path where PATH is BEST.
    """

    surface: Path
    loops: tuple[Loop, ...]
    compensated: Compensated | None
    verdict: Verdict | None
    rough: tuple[RoughPass, ...] = ()
    best: BestPath | None = None

    @property
    def center(self) -> Path:
        """The first loop with its blends; the empty path if there is none."""
        from core.geometry.path import EMPTY

        return self.loops[0].whole if self.loops else EMPTY
