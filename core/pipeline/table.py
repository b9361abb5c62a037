"""The look-ahead table: what becomes of a block's path at every value from 1 to 20."""

from __future__ import annotations

from dataclasses import dataclass, replace

from core.comp.advise import recommended
from core.comp.compensate import compensate_all
from core.comp.lookahead import HIGHEST, LOWEST
from core.comp.result import Compensated
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.side import Side
from core.pipeline.cut import parameter
from core.pipeline.derive import better
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from core.verify.judge import judge_all
from core.verify.verdict import Verdict


@dataclass(frozen=True, eq=False, slots=True)
class Row:
    """One look-ahead value: the path it makes and what that path does; lengths in millimetres."""

    value: int
    compensated: Compensated
    verdict: Verdict

    @property
    def clean(self) -> bool:
        """There is a path and it gouges nothing."""
        return len(self.compensated.path) > 0 and self.verdict.clean

    @property
    def gouge(self) -> float:
        """Depth of its deepest gouge, 0 for none."""
        return self.verdict.depth

    @property
    def uncut(self) -> float:
        """Length of surface it leaves."""
        return self.verdict.uncut_length

    @property
    def deleted(self) -> tuple[float, ...]:
        """Numbers of the segments it deletes, each once."""
        return tuple(dict.fromkeys(self.compensated.deleted.segments.tolist()))


@dataclass(frozen=True, eq=False, slots=True)
class Table:
    """All rows, the value the operator is advised to use if any is clean, and what else is to be said."""

    rows: tuple[Row, ...]
    recommended: int | None
    notes: tuple[Finding, ...] = ()

    def row(self, value: int) -> Row:
        """The row of a look-ahead value."""
        return self.rows[value - LOWEST]


@dataclass(frozen=True, eq=False, slots=True)
class Cut:
    """A contour and how it is to be cut; lengths in millimetres, `blend` and `overlap` 0 for none."""

    surface: Path
    side: Side
    radius: float
    closed: bool
    blend: float
    overlap: float


def cut_of(found: DerivedBlock, program: Program) -> Cut | None:
    """What a derived block cuts; None for ON and while there is nothing to compensate."""
    if found.work is None or found.side is None or found.radius is None:
        return None
    return Cut(
        found.work.surface,
        found.side,
        found.radius,
        found.solved.closed,
        parameter(program, "blend_offset"),
        parameter(program, "blend_overlap"),
    )


def look_ahead_table(found: DerivedBlock, program: Program) -> Table | None:
    """The table of a derived block; None for ON and while there is nothing to compensate."""
    cut = cut_of(found, program)
    return None if cut is None else replace(table_of(cut), notes=better(found))


def table_of(cut: Cut) -> Table:
    """The table of any contour."""
    values = range(LOWEST, HIGHEST + 1)
    every = compensate_all(
        cut.surface, cut.side, cut.radius, values, closed=cut.closed, blend=cut.blend, overlap=cut.overlap
    )
    verdicts = judge_all(cut.surface, cut.side, cut.radius, [one.whole for one in every])
    rows = [Row(value, one, verdict) for value, one, verdict in zip(values, every, verdicts, strict=True)]
    return Table(tuple(rows), recommended(rows))
