"""Look-ahead table: a contour is cut at every look-ahead value from 1 to 20, and each path is judged."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from core.comp.compensate import compensate_all
from core.comp.compensated import Compensated
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Side
from core.progress import Progress, part, silent
from core.tolerance import JOINED
from core.verify.judge import judge
from core.verify.report import enumerated
from core.verify.verdict import Verdict

VALUES = range(MIN_LOOKAHEAD, MAX_LOOKAHEAD + 1)
"""The look-ahead values that an operator may type."""


@dataclass(frozen=True, eq=False, slots=True)
class CuttingSetup:
    """A contour and the settings for cutting it; lengths in millimeters, `blend` and `overlap` 0 for none.

    `stocks` are the allowances that the roughing passes leave; their tool has radius `rougher`, or `radius` if that is
    None.  The search for another tool uses steps of `diameter_step`, the last digit on a screen.
    """

    surface: Path
    side: Side
    radius: float
    closed: bool
    blend: float
    overlap: float
    stocks: tuple[float, ...] = ()
    rougher: float | None = None
    diameter_step: float = 0.001

    def paths(self, radius: float, lookaheads: tuple[int, ...] | range = VALUES) -> tuple[Compensated, ...]:
        """Return the control's path at a radius for each look-ahead; paths with equal `tested` are the same."""
        return compensate_all(
            self.surface, self.side, radius, lookaheads, closed=self.closed, blend=self.blend, overlap=self.overlap
        )


class Effect(NamedTuple):
    """The end of a sentence that says what a clean value does, and the lengths (mm) for its places {0}, {1}."""

    text: str
    lengths: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Row:
    """One look-ahead value: its path and the verdicts on it; lengths in millimeters."""

    value: int
    compensated: Compensated
    verdict: Verdict
    rough: tuple[Verdict, ...] = ()

    @property
    def clean(self) -> bool:
        """True if there is a path, and both it and the roughing passes are clean."""
        return len(self.compensated.path) > 0 and all(verdict.clean for verdict in (self.verdict, *self.rough))

    @property
    def gouge(self) -> float:
        """Depth of the deepest gouge, roughing passes included, 0 for none."""
        return max(verdict.depth for verdict in (self.verdict, *self.rough))

    @property
    def uncut(self) -> float:
        """Length of surface that it leaves uncut."""
        return self.verdict.uncut_length

    @property
    def deleted(self) -> tuple[float, ...]:
        """Numbers of the segments that it deletes, each once."""
        return tuple(dict.fromkeys(self.compensated.deleted.segments.tolist()))

    @property
    def effect(self) -> Effect:
        """What a clean value does."""
        if self.verdict.uncut:
            return Effect("does not gouge but leaves {0} uncut", (self.uncut,))
        segments = [number for number in self.deleted if number == int(number)]
        if segments:
            return Effect(f"does not gouge but deletes {enumerated('segment', segments)}")
        return Effect("is clean")


@dataclass(frozen=True, eq=False, slots=True)
class Table:
    """All rows, the recommended value if any is clean, and further `notes`.

    The code that displays the table adds the notes: what a better path would cut, and what would mend the contour, take
    longer to find than all rows.  Until `complete` there may be more of them.
    """

    rows: tuple[Row, ...]
    recommended: int | None
    notes: tuple[Finding, ...] = ()
    complete: bool = False

    def row(self, value: int) -> Row:
        """Return the row of a look-ahead value."""
        return self.rows[value - MIN_LOOKAHEAD]


def recommended(rows: Sequence[Row]) -> int | None:
    """Return the smallest of the clean values that leave the least uncut; None if no value is clean."""
    clean = [row for row in rows if row.clean]
    least = min((row.uncut for row in clean), default=0.0)
    return min((row.value for row in clean if row.uncut <= least + JOINED), default=None)


def judge_lookaheads(
    setup: CuttingSetup, progress: Progress = silent, report_rows: Callable[[tuple[Row, ...]], None] | None = None
) -> Table:
    """Make the table of a contour: a value is judged by its finish path and by the roughing passes before it.

    Call `report_rows` with all rows so far whenever some are complete.
    """
    count = 1 + len(setup.stocks)
    shares = [part(progress, at / count, (at + 1) / count) for at in range(count)]
    finish, passes = setup.paths(setup.radius), list[list[Verdict | None]]()
    rougher = setup.radius if setup.rougher is None else setup.rougher
    rows = tuple[Row, ...]()
    for at, share in enumerate(shares):
        cutter, paths = (rougher, setup.paths(rougher + setup.stocks[at - 1])) if at else (setup.radius, finish)
        for verdicts in _verdicts(setup, cutter, paths, share):
            if at == count - 1:
                rows = _rows(finish, [*passes, verdicts])
                if report_rows is not None:
                    report_rows(rows)
        passes.append(verdicts)
    return Table(rows, recommended(rows))


def _rows(finish: tuple[Compensated, ...], passes: list[list[Verdict | None]]) -> tuple[Row, ...]:
    """Return the rows of the values with a verdict on every pass."""
    rows = []
    for value, path, *verdicts in zip(VALUES, finish, *passes, strict=True):
        judged = [verdict for verdict in verdicts if verdict is not None]
        if len(judged) == len(verdicts):
            rows.append(Row(value, path, judged[0], tuple(judged[1:])))
    return tuple(rows)


def _verdicts(
    setup: CuttingSetup, cutter: float, paths: tuple[Compensated, ...], progress: Progress
) -> Iterator[list[Verdict | None]]:
    """Yield the verdict on a cutter of this radius for each path, None for those that are not judged yet.

    A path that several values share is judged once; the last list is complete.
    """
    distinct = {path.tested: path for path in paths}
    verdicts = {}
    for done, (key, path) in enumerate(distinct.items()):
        progress(done / len(distinct))
        verdicts[key] = judge(setup.surface, setup.side, cutter, path.with_leads)
        yield [verdicts.get(each.tested) for each in paths]
