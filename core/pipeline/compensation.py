"""Compensation: one contour and how it is compensated, whatever the radius."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from core.comp.best_path.best_path import BestPath, best_path
from core.comp.blend import blend_in, blend_out
from core.comp.compensate import Crossed, compensate, crossed
from core.comp.lookahead import HIGHEST, LOWEST
from core.comp.result import Compensated
from core.geometry.path import Path
from core.geometry.piece import Side
from core.pipeline.derived import Loop
from core.program.fields import default
from core.program.model import Entry, PathChoice, Program
from core.units import to_mm

SHARED: Final = 1000
"""Segments up to which the crossings of all look-aheads are found at once and kept for the look-ahead table."""


def parameter(program: Program, name: str) -> float:
    """A program parameter as typed or its default; lengths in millimeters, a percentage as it is."""
    typed = getattr(program.parameters, name)
    value = typed.value if isinstance(typed, Entry) else default(name, program.unit)
    if value is None:
        return 0.0
    return value if name == "pocket_overlap" else to_mm(value, program.unit)


@dataclass(frozen=True, eq=False, slots=True)
class Compensation:
    """A surface, the side on which it is cut, and the look-ahead in force; radii in millimeters."""

    surface: Path
    side: Side
    closed: bool
    lookahead: int
    program: Program

    def control(self, radius: float) -> Compensated:
        """The control's path."""
        return compensate(
            self.surface,
            self.side,
            radius,
            self.lookahead,
            closed=self.closed,
            blend=parameter(self.program, "blend_offset"),
            overlap=parameter(self.program, "blend_overlap"),
        )

    def crossed(self, radius: float) -> Crossed | None:
        """What the control's path has in common with those of all other look-aheads; None for a large contour."""
        if len(self.surface) > SHARED:
            return None
        return crossed(
            self.surface,
            self.side,
            radius,
            range(LOWEST, HIGHEST + 1),
            closed=self.closed,
            blend=parameter(self.program, "blend_offset"),
            overlap=parameter(self.program, "blend_overlap"),
        )

    def best(self, radius: float) -> BestPath:
        """The true offset."""
        return best_path(self.surface, self.side, radius, closed=self.closed)

    def posted(self, control: Compensated, radius: float, best: BestPath | None = None) -> tuple[Loop, ...]:
        """What PATH says is posted: the control's path, or the best one, which is worked out if it is not given."""
        if self.program.parameters.path is PathChoice.BEST:
            return self._loops(best or self.best(radius))
        return (Loop(control.path, control.lead_in, control.lead_out),) if len(control.path) else ()

    def _loops(self, best: BestPath) -> tuple[Loop, ...]:
        """Every loop of the best path with blends of its own."""
        blend, overlap = parameter(self.program, "blend_offset"), parameter(self.program, "blend_overlap")
        return tuple(
            Loop(loop, blend_in(loop, self.side, blend), blend_out(loop, self.side, blend, overlap, closed=ring))
            for loop, ring in zip(best.loops, best.closed, strict=True)
        )
