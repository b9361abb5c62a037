"""Remedies for a contour that no look-ahead value cuts clean: each is proved by cutting and judging it.

The number of trials is bounded, so that a remedy that exists may not be found; one that is given is true.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, sin
from typing import Final

import numpy as np

from core.comp.compensate import compensate_all
from core.geometry.path import Path
from core.geometry.piece import Arc, Piece, Point
from core.pipeline.table import Trial, table_of
from core.verify.judge import judge

STEP: Final = 0.001
"""Millimetres to which the largest diameter is found."""

MOST_STARTS: Final = 6
"""So many of the longest sides are tried as the start."""

USUAL: Final = (8, 3, 1, 20)
"""Look-aheads tried while a tool is looked for; the one it is then told with is chosen from all."""


@dataclass(frozen=True, slots=True)
class ToolFits:
    """A cutter of `diameter` millimetres is clean at `value`, one of STEP more at no value."""

    diameter: float
    value: int


@dataclass(frozen=True, slots=True)
class StartMoved:
    """Started at `at`, the middle of `segment`, the contour is clean at `value`."""

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


def largest_tool(trial: Trial, hint: float | None = None, wanted: Callable[[], bool] = always) -> ToolFits | None:
    """The largest clean diameter below the cutter's, a multiple of STEP, rounded down; by halving what is left.

    `hint` is a radius that may be the limit, such as that of the smallest inside arc: it is tried first.
    """
    known, fails = 0, _steps(2.0 * trial.radius)
    tries = [_steps(2.0 * hint), _steps(2.0 * hint) + 1] if hint is not None else []
    while fails - known > 1:
        size = tries.pop(0) if tries else (known + fails) // 2
        if known < size < fails:
            _still(wanted)
            known, fails = (size, fails) if _clean(_with_tool(trial, size)) else (known, size)
    _still(wanted)
    value = table_of(_with_tool(trial, known)).recommended if known else None
    return None if value is None else ToolFits(known * STEP, value)


def _with_tool(trial: Trial, size: int) -> Trial:
    return replace(trial, radius=size * STEP / 2.0)


def _clean(trial: Trial) -> bool:
    """Whether a value of the usual ones is clean."""
    every = compensate_all(
        trial.surface, trial.side, trial.radius, USUAL, closed=trial.closed, blend=trial.blend, overlap=trial.overlap
    )
    wholes = {id(one.path): one.whole for one in every if len(one.path)}
    return any(judge(trial.surface, trial.side, trial.radius, whole).clean for whole in wholes.values())


def _steps(diameter: float) -> int:
    """Whole steps in a diameter, rounding forgiven."""
    return int(diameter / STEP + 1e-6)


def start_mid_side(trial: Trial, wanted: Callable[[], bool] = always) -> StartMoved | None:
    """The longest side of a closed contour whose middle is a clean start."""
    for row in longest(trial.surface)[:MOST_STARTS] if trial.closed else ():
        _still(wanted)
        value = table_of(replace(trial, surface=started(trial.surface, row))).recommended
        if value is not None:
            return StartMoved(float(trial.surface.numbers[row]), middle(trial.surface[row]), value)
    return None


def longest(contour: Path) -> list[int]:
    """The rows of a contour's segments, the longest first."""
    rows: list[int] = np.argsort(-contour.lengths, kind="stable").tolist()
    return rows


def without_blends(trial: Trial, wanted: Callable[[], bool] = always) -> int | None:
    """The value that is clean when the blend moves are left out."""
    if trial.blend <= 0.0:
        return None
    _still(wanted)
    return table_of(replace(trial, blend=0.0, overlap=0.0)).recommended


def middle(piece: Piece) -> Point:
    """The point half way along a piece."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    if not isinstance(piece, Arc):
        return (x0 + x1) / 2.0, (y0 + y1) / 2.0
    (cx, cy), half = piece.centre, piece.sweep / 2.0
    dx, dy = x0 - cx, y0 - cy
    return cx + dx * cos(half) - dy * sin(half), cy + dx * sin(half) + dy * cos(half)


def started(contour: Path, row: int) -> Path:
    """A closed contour of n segments started in the middle of segment `row`, from 0: n + 1 segments, numbered anew."""
    at = np.array([middle(contour[row])])
    points = np.concatenate((at, contour.points[row + 1 :], contour.points[1 : row + 1], at))
    turns = np.concatenate((contour.turns[row:], contour.turns[: row + 1]))
    centres = np.concatenate((contour.centres[row:], contour.centres[: row + 1]))
    return Path.of(points, np.where(turns[:, None] == 0, points[:-1], centres), turns)
