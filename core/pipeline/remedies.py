"""Remedies for a contour that no look-ahead value cuts clean: each is proved by cutting and judging it.

The number of trials is bounded, so that a remedy that exists may not be found; one that is given is true.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, sin
from typing import Final

import numpy as np

from core.comp.advise import recommended
from core.comp.compensate import compensate_all
from core.comp.lookahead import HIGHEST, LOWEST
from core.comp.result import Compensated
from core.geometry.path import Path
from core.geometry.piece import Arc, Piece, Point
from core.pipeline.beginning import FEWEST, Walls, gouge_at_once, gouging
from core.pipeline.table import Row, Trial, table_of
from core.tolerance import CLOSED
from core.verify.judge import rulings

STEP: Final = 0.001
"""Millimeters to which the largest diameter is found."""

MOST_STARTS: Final = 6
"""So many of the longest sides are tried as the start."""

MOST_BARE_STARTS: Final = 2
"""So many of them without blend moves: where the path begins then matters little."""

WORTH: Final = 1.02
"""A tool that fits without blend moves is told beside one that fits with them if it is so many times as large."""

PARTS: Final = 7
"""So many diameters are looked at together when it is only asked how their path begins."""

USUAL: Final = (8, 3, 1, 20)
"""Look-aheads tried while a tool is looked for; the one it is then told with is chosen from all."""


@dataclass(frozen=True, slots=True)
class ToolFits:
    """A cutter of `diameter` millimeters is clean at `value`, one of STEP more at no value."""

    diameter: float
    value: int


@dataclass(frozen=True, slots=True)
class StartMoved:
    """Started at `at`, the middle of `segment` or its new start, the contour is clean at `value`."""

    segment: float
    at: Point
    value: int


class Unwanted(Exception):
    """Nobody waits for the remedies any more."""


def always() -> bool:
    """Somebody waits to the end."""
    return True


def _still(wanted: Callable[[], bool]) -> None:
    if not wanted():
        raise Unwanted


def bare(trial: Trial) -> Trial:
    """The same with BLEND OFFSET 0; what runs past the start stays."""
    return replace(trial, blend=0.0)


def larger_bare_tool(
    trial: Trial, than: ToolFits | None, hint: float | None = None, wanted: Callable[[], bool] = always
) -> ToolFits | None:
    """The largest tool without blend moves, if there are any to leave out and it is larger enough to be told."""
    if trial.blend <= 0.0:
        return None
    least = 0 if than is None else max(int(_steps(than.diameter) * WORTH), _steps(than.diameter) + 1)
    return largest_tool(bare(trial), hint, wanted, least=least)


def largest_tool(
    trial: Trial, hint: float | None = None, wanted: Callable[[], bool] = always, *, least: int = 0
) -> ToolFits | None:
    """The largest clean diameter below the cutter's, a multiple of STEP, rounded down; by halving what is left.

    `hint` is a radius that may be the limit, such as that of the smallest inside arc: it is tried first.  There is none
    where one of `least` STEPs is not clean.

    Mostly the limit is where the path begins, which is known before there is one.  So the halving first goes by that
    alone, and what it finds is then cut and judged; only if that is not clean, every half is.
    """
    search = _Search(trial, hint, wanted, least)
    if least >= _steps(2.0 * trial.radius) or not search.clean(least):
        return None
    guess = search.guess()
    known = guess if search.clean(guess) else search.halved(search.clean)
    value = search.cuts(known).recommended if known else None
    return None if value is None else ToolFits(known * STEP, value)


class _Search:
    """The search between a diameter that is clean and one that is not, in STEPs."""

    def __init__(self, trial: Trial, hint: float | None, wanted: Callable[[], bool], least: int) -> None:
        self._trial, self._walls, self._wanted = trial, Walls.of(trial.surface), wanted
        self._hints = () if hint is None else (_steps(2.0 * hint), _steps(2.0 * hint) + 1)
        self._least, self._fails = least, _steps(2.0 * trial.radius)
        self._hopeless: dict[int, bool] = {}
        self._cuts: dict[int, Cuts] = {}

    def guess(self) -> int:
        """The largest diameter with which the path begins well, or a hint that turns out to be the limit."""
        known, fails = self._least, self._fails
        while fails - known > 1:
            sizes = sorted({known + (fails - known) * part // (PARTS + 1) for part in range(1, PARTS + 1)} - {known})
            self._begin(sizes)
            known = max((size for size in sizes if not self._hopeless[size]), default=known)
            fails = min((size for size in sizes if size > known), default=fails)
        return self.halved(lambda size: self.clean(size) if size in self._hints else size <= known)

    def halved(self, clean: Callable[[int], bool]) -> int:
        """The diameter at which `clean` ends, known to be at least the one that was asked for."""
        known, fails = self._least, self._fails
        tries = list(self._hints)
        while fails - known > 1:
            size = tries.pop(0) if tries else (known + fails) // 2
            if known < size < fails:
                known, fails = (size, fails) if clean(size) else (known, size)
        return known

    def clean(self, size: int) -> bool:
        """Whether a value of the usual ones is clean with this diameter, judged from its finish path; 0 is."""
        if not size:
            return True
        if size not in self._hopeless:
            self._begin([size])
        return not self._hopeless[size] and self.cuts(size).usual

    def cuts(self, size: int) -> Cuts:
        """What becomes of the contour with this diameter."""
        if size not in self._cuts:
            _still(self._wanted)
            self._cuts[size] = Cuts(_with_tool(self._trial, size), self._walls)
        return self._cuts[size]

    def _begin(self, sizes: list[int]) -> None:
        """Find out which diameters gouge where the path begins."""
        own = (0, len(self._trial.surface) - 1)
        found = gouge_at_once([_with_tool(self._trial, size) for size in sizes], self._walls, [own] * len(sizes))
        self._hopeless |= dict(zip(sizes, found, strict=True))


def _with_tool(trial: Trial, size: int) -> Trial:
    return replace(trial, radius=size * STEP / 2.0)


class Cuts:
    """What becomes of a contour at all look-aheads, judged no further than a remedy has to know."""

    def __init__(self, trial: Trial, walls: Walls) -> None:
        self._trial = trial
        every = compensate_all(
            trial.surface,
            trial.side,
            trial.radius,
            range(LOWEST, HIGHEST + 1),
            closed=trial.closed,
            blend=trial.blend,
            overlap=trial.overlap,
        )
        # values that test the same crossings have one path between them, and the first of them stands for all
        distinct = {id(one.path): one for one in reversed(every) if len(one.path)}
        usual = {id(every[value - LOWEST].path) for value in USUAL}
        every = tuple(reversed(distinct.values()))
        gouges = gouging([one.whole for one in every], trial.radius, walls)
        hopeful = [one for one, no in zip(every, gouges, strict=True) if not no]
        self._usual = [one for one in hopeful if id(one.path) in usual]
        self._rest = [one for one in hopeful if id(one.path) not in usual]

    @cached_property
    def usual(self) -> bool:
        """Whether the finish path of one of the usual values is clean."""
        return any(row.clean for row in self._judged)

    @cached_property
    def recommended(self) -> int | None:
        """The value that the look-ahead table recommends.

        What gouges beyond doubt need not be judged for that, nor the roughing passes where all finish paths do.
        """
        if not self._usual and not self._rest:
            return None
        if self._trial.stocks:
            return table_of(self._trial).recommended
        return recommended([*self._judged, *self._rows(self._rest)])

    @cached_property
    def _judged(self) -> list[Row]:
        return self._rows(self._usual)

    def _rows(self, paths: list[Compensated]) -> list[Row]:
        trial, wholes = self._trial, [one.whole for one in paths]
        found = rulings(trial.surface, trial.side, trial.radius, wholes, trial.ground) if paths else ()
        return [Row(one.lookahead, one, ruling) for one, ruling in zip(paths, found, strict=True)]


def _steps(diameter: float) -> int:
    """Whole steps in a diameter, rounding forgiven."""
    return int(diameter / STEP + 1e-6)


def bare_start(trial: Trial, wanted: Callable[[], bool] = always) -> StartMoved | None:
    """The longest side of a closed contour whose middle is a clean start without blend moves, if there are any."""
    return start_mid_side(bare(trial), wanted, MOST_BARE_STARTS) if trial.blend > 0.0 else None


def start_mid_side(trial: Trial, wanted: Callable[[], bool] = always, most: int = MOST_STARTS) -> StartMoved | None:
    """The longest side of a closed contour whose middle is a clean start; `most` of them are tried."""
    if not trial.closed:
        return None
    walls, rows = Walls.of(trial.surface), longest(trial.surface)[:most]
    moved = [replace(trial, surface=started(trial.surface, row)) for row in rows]
    hopeless = gouge_at_once(moved, walls, [(row, row) for row in rows])
    for row, one, no in zip(rows, moved, hopeless, strict=True):
        _still(wanted)
        value = None if no else Cuts(one, walls).recommended
        if value is not None:
            return StartMoved(float(trial.surface.numbers[row]), middle(trial.surface[row]), value)
    return None


def start_at_end(trial: Trial, wanted: Callable[[], bool] = always) -> StartMoved | None:
    """The end of an open contour, if the contour is clean and closed when START is typed there.

    Only where one number of START is that of the end and the first segment is a line, which is then another one: both
    may be meant as they are, but one mistyped number is what it takes.
    """
    surface = trial.surface
    gap = np.abs(surface.points[0] - surface.points[-1])
    if trial.closed or len(surface) < FEWEST or surface.turns[0] or float(gap.min()) > CLOSED:
        return None
    _still(wanted)
    points = np.concatenate((surface.points[-1:], surface.points[1:]))
    centers = np.concatenate((points[:1], surface.centers[1:]))
    closed = replace(trial, surface=Path.of(points, centers, surface.turns, surface.numbers), closed=True)
    value = Cuts(closed, Walls.of(closed.surface)).recommended
    x, y = points[0].tolist()
    return None if value is None else StartMoved(float(surface.numbers[0]), (x, y), value)


def longest(contour: Path) -> list[int]:
    """The rows of a contour's segments, the longest first."""
    rows: list[int] = np.argsort(-contour.lengths, kind="stable").tolist()
    return rows


def without_blends(trial: Trial, wanted: Callable[[], bool] = always) -> int | None:
    """The value that is clean when the blend moves are left out."""
    if trial.blend <= 0.0:
        return None
    _still(wanted)
    walls = Walls.of(trial.surface)
    (hopeless,) = gouge_at_once([bare(trial)], walls, [(0, len(trial.surface) - 1)])
    return None if hopeless else Cuts(bare(trial), walls).recommended


def middle(piece: Piece) -> Point:
    """The point half way along a piece."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    if not isinstance(piece, Arc):
        return (x0 + x1) / 2.0, (y0 + y1) / 2.0
    (cx, cy), half = piece.center, piece.sweep / 2.0
    dx, dy = x0 - cx, y0 - cy
    return cx + dx * cos(half) - dy * sin(half), cy + dx * sin(half) + dy * cos(half)


def started(contour: Path, row: int) -> Path:
    """A closed contour of n segments started in the middle of segment `row`, from 0: n + 1 segments, numbered anew."""
    at = np.array([middle(contour[row])])
    points = np.concatenate((at, contour.points[row + 1 :], contour.points[1 : row + 1], at))
    turns = np.concatenate((contour.turns[row:], contour.turns[: row + 1]))
    centers = np.concatenate((contour.centers[row:], contour.centers[: row + 1]))
    return Path.of(points, np.where(turns[:, None] == 0, points[:-1], centers), turns)
