"""Result of cutting a block: its surface, rough and finish paths in millimeters, and the verdict.  No numpy needed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from core.comp.best_path.best_path import BestPath
    from core.comp.compensated import CenterPath, Compensated
    from core.geometry.path import Path
    from core.verify.verdict import Verdict


@dataclass(frozen=True, eq=False, slots=True)
class RoughPass:
    """One pass before the finish path: its `loops` leave `stock` millimeters on the surface.

    `compensated` is the control's path, whether posted or not.  `verdict` judges a cutter that is larger by the stock:
    a gouge deeper than the stock cuts into the part, a shallower one leaves too little stock.
    """

    stock: float
    loops: tuple[CenterPath, ...]
    compensated: Compensated
    verdict: Verdict


@dataclass(frozen=True, eq=False, slots=True)
class BlockPaths:
    """Every path of a block and its effect on the surface."""

    surface: Path
    """The determined part of the contour."""
    loops: tuple[CenterPath, ...]
    """The finish path that is posted: a single loop or, for PATH BEST, all of its loops."""
    compensated: Compensated | None
    """The control's path, posted or not; None for CUTTER COMP. ON, where the center runs on the contour."""
    verdict: Verdict | None
    """The judgment on `loops`; None for CUTTER COMP. ON."""
    rough: tuple[RoughPass, ...] = ()
    """The passes before, outermost first."""
    best: BestPath | None = None
    """The best path if PATH is BEST."""
