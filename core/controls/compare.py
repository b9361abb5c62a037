"""One program on all controls side by side: who runs it, who stops, who gouges, and where two paths part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.controls.moves import Moves
from core.controls.registry import UnknownControl, compared, reads, run
from core.controls.report import Run
from core.controls.tools import ToolTable
from core.controls.verdicts import Judged, depth, judged
from core.units import Unit

APART: Final = 0.0005
"""Millimetres from which on two paths are told to part."""


@dataclass(frozen=True, slots=True)
class Parting:
    """Where two paths part: the first line, the line at which they are farthest apart, and how far in millimetres."""

    line: int
    farthest: int
    distance: float


@dataclass(frozen=True, eq=False, slots=True)
class Compared:
    """A control's run of the program; `parts` tells where it leaves the path of the first control that runs it."""

    control: str
    run: Run
    results: tuple[Judged, ...]
    gouge: float
    gouge_line: int | None
    parts: Parting | None


@dataclass(frozen=True, slots=True)
class OtherLanguage:
    """A control that does not read the program's language."""

    control: str


def compare(text: bytes, tools: ToolTable, unit: Unit | None = None) -> tuple[Compared | OtherLanguage, ...]:
    """The program on every control, in the registry's order; `unit` where it names none, inches if none is given."""
    first: Run | None = None
    rows: list[Compared | OtherLanguage] = []
    for control in compared():
        if not reads(control, text):
            rows.append(OtherLanguage(control))
            continue
        done = run(text, control, tools, unit or Unit.IN)
        if isinstance(done, UnknownControl):
            continue
        results = judged(done)
        cut, line = depth(results)
        parts = None if first is None else parting(first.moves, done.moves)
        rows.append(Compared(control, done, results, cut, line, parts))
        if first is None and done.stopped_at is None:
            first = done
    return tuple(rows)


def parting(one: Moves, other: Moves) -> Parting | None:
    """Where two lists of moves of one program part, line by line; None if they are the same as far as both go.

    Compared are the points a line's moves go through: each point of the one with the nearest of the other.
    """
    ours, theirs = _by_line(one), _by_line(other)
    found = [(line, _apart(ours[line], theirs[line])) for line in sorted(ours.keys() & theirs.keys())]
    apart = [(line, distance) for line, distance in found if distance > APART]
    if not apart:
        return None
    farthest, distance = max(apart, key=lambda pair: pair[1])
    return Parting(apart[0][0], farthest, distance)


def _by_line(moves: Moves) -> dict[int, np.ndarray[tuple[int, int], np.dtype[np.float64]]]:
    """Line to the points (n, 3) its moves begin and end with."""
    order = np.argsort(moves.lines[1:], kind="stable") + 1
    lines = moves.lines[order]
    edges = np.flatnonzero(np.diff(lines)) + 1
    groups = np.split(order, edges)
    return {
        int(moves.lines[rows[0]]): np.vstack((moves.points[rows - 1], moves.points[rows]))
        for rows in groups
        if len(rows)
    }


def _apart(
    one: np.ndarray[tuple[int, int], np.dtype[np.float64]], other: np.ndarray[tuple[int, int], np.dtype[np.float64]]
) -> float:
    if len(one) * len(other) > 1_000_000:
        return float(np.max(np.linalg.norm(one[-1] - other[-1])))
    between = np.linalg.norm(one[:, None, :] - other[None, :, :], axis=2)
    return float(max(between.min(axis=0).max(), between.min(axis=1).max()))
