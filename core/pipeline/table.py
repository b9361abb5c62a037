"""The look-ahead table: what becomes of a block's path at every value from 1 to 20."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.comp.advise import recommended
from core.comp.compensate import Crossed, compensate_all
from core.comp.lookahead import HIGHEST, LOWEST
from core.comp.result import Compensated
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Side
from core.pipeline.compensation import parameter
from core.pipeline.derive import stocks
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from core.verify.judge import Ground, rulings
from core.verify.ruling import Ruling
from core.verify.verdict import Verdict


@dataclass(frozen=True, eq=False, slots=True)
class Row:
    """One look-ahead value: the path it makes and what that path does; lengths in millimeters."""

    value: int
    compensated: Compensated
    ruling: Ruling
    rough: tuple[Ruling, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """All there is to say of the finish path."""
        return self.ruling.verdict

    @property
    def clean(self) -> bool:
        """There is a path, and neither it nor a roughing pass gouges anything."""
        return len(self.compensated.path) > 0 and self.ruling.clean and all(one.clean for one in self.rough)

    @property
    def gouge(self) -> float:
        """Depth of the deepest gouge, roughing passes included, 0 for none."""
        return max(one.verdict.depth for one in (self.ruling, *self.rough))

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
    """All rows, the value the operator is advised to use if any is clean, and what else is to be said.

    `notes` are left to whoever shows the table: what a better path would cut (`core.pipeline.derive.better`) and what
    the contour needs (`core.pipeline.needs`) take longer than all rows.  Until `complete` there may be more of them.
    """

    rows: tuple[Row, ...]
    recommended: int | None
    notes: tuple[Finding, ...] = ()
    complete: bool = False

    def work_out(self) -> None:
        """Complete what there is to say of every row, before it is read where nobody wants to wait."""
        for row in self.rows:
            for ruling in (row.ruling, *row.rough):
                ruling.complete()

    def row(self, value: int) -> Row:
        """The row of a look-ahead value."""
        return self.rows[value - LOWEST]


@dataclass(frozen=True, eq=False, slots=True)
class Trial:
    """A contour and how it is to be cut; lengths in millimeters, `blend` and `overlap` 0 for none.

    `stocks` are what the roughing passes leave, cut by a tool of radius `rougher`, of `radius` without a finish tool.
    `ground` is the surface as paths are judged over it, where that is known.
    """

    surface: Path
    side: Side
    radius: float
    closed: bool
    blend: float
    overlap: float
    stocks: tuple[float, ...] = ()
    rougher: float | None = None
    ground: Ground | None = None


def trial_of(found: DerivedBlock, program: Program) -> Trial | None:
    """What a derived block cuts; None for ON and while there is nothing to compensate."""
    if found.work is None or found.side is None or found.radius is None:
        return None
    return Trial(
        found.work.surface,
        found.side,
        found.radius,
        found.solved.closed,
        parameter(program, "blend_offset"),
        parameter(program, "blend_overlap"),
        () if found.solved.tool_diameter is None else stocks(found, program),
        None if found.solved.finish_diameter is None else (found.solved.tool_diameter or 0.0) / 2,
        found.work.ground,
    )


def look_ahead_table(found: DerivedBlock, program: Program) -> Table | None:
    """The table of a derived block; None for ON and while there is nothing to compensate."""
    trial = trial_of(found, program)
    return None if trial is None else table_of(trial, _judged(found))


def _judged(found: DerivedBlock) -> Judged | None:
    """The path in force and its verdict, where that is the control's."""
    work = found.work
    if work is None or work.verdict is None or work.compensated is None or work.best is not None:
        return None
    return Judged(work.compensated, Ruling.of(work.verdict), work.crossed)


class Judged(NamedTuple):
    """A path whose verdict is known, and what all look-aheads' paths are made of, as far as that was kept."""

    compensated: Compensated
    ruling: Ruling
    crossed: Crossed | None = None


def table_of(trial: Trial, judged: Judged | None = None) -> Table:
    """The table of any contour: a value's fate is that of its finish path and of the roughing passes before it.

    `judged` is a finish path that has been judged already, against this contour with this radius.
    """
    values = range(LOWEST, HIGHEST + 1)
    every, finish = _all(trial, trial.radius, trial.radius, judged)
    rougher = trial.radius if trial.rougher is None else trial.rougher
    passes = [_all(trial, rougher + stock, rougher)[1] for stock in trial.stocks]
    rough = list(zip(*passes, strict=True)) or [()] * len(values)
    rows = [Row(*row) for row in zip(values, every, finish, rough, strict=True)]
    return Table(tuple(rows), recommended(_fates(rows)))


def _fates(rows: Sequence[Row]) -> list[Row]:
    """Of rows with the same rulings the first, whose value is the smallest."""
    return list({(id(row.ruling), *map(id, row.rough)): row for row in reversed(rows)}.values())


def _all(
    trial: Trial, radius: float, cutter: float, judged: Judged | None = None
) -> tuple[Sequence[Compensated], Sequence[Ruling]]:
    """The path at `radius` of every value, and what a cutter of radius `cutter` does on it."""
    every = _every(trial, radius, judged)
    # values that test the same crossings have one path between them
    paths = {id(one.path): one for one in every}
    known = {} if judged is None else {key: judged.ruling for key, one in paths.items() if _same(one, judged)}
    rest = {key: one.whole for key, one in paths.items() if key not in known}
    told = rulings(trial.surface, trial.side, cutter, list(rest.values()), trial.ground) if rest else ()
    found = known | dict(zip(rest, told, strict=True))
    return every, [found[id(one.path)] for one in every]


def _every(trial: Trial, radius: float, judged: Judged | None) -> tuple[Compensated, ...]:
    """The path at `radius` of every value."""
    values = range(LOWEST, HIGHEST + 1)
    if judged is not None and judged.crossed is not None:
        return judged.crossed.at(values, judged.compensated)
    return compensate_all(
        trial.surface, trial.side, radius, values, closed=trial.closed, blend=trial.blend, overlap=trial.overlap
    )


def _same(one: Compensated, judged: Judged) -> bool:
    """Whether two paths are the same to the last bit, and so are their blends."""
    path, other = one.path, judged.compensated.path
    names = ("turns", "numbers", "points", "centers")
    return path is other or all(np.array_equal(getattr(path, name), getattr(other, name)) for name in names)
