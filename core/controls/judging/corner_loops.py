"""Corner loops are removed from a contour before it is judged.

A loop goes on past an outside corner, turns around in the open, and comes back along the next wall.

It keeps a corner sharp that a control would round.  The loop is not a wall: it begins on the cutter's side of both
walls, and because it crosses nothing else it stays there.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from core.geometry.path import Floats, Path, joined, point_of_row
from core.geometry.piece import Side
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import JOINED
from core.verify.self_crossings import self_crossings

MIN_CONTOUR_SHARE: Final = 0.5
"""Share of the rest of the contour above which a loop counts as part of the contour."""

MAX_LOOP_SHARE: Final = 0.25
"""Share of the rest of the contour above which a loop may be part of the contour."""

MIN_CORNER_TURN: Final = 1e-3
"""Least turn of a corner in radians; the loop's whole turn may be off by as much."""


@dataclass(frozen=True, slots=True)
class CornerLoop:
    """Where a contour crosses itself, and the numbers of the moves beyond that place, up to its return.

    A `long` loop may be part of the contour.
    """

    at: tuple[float, float]
    numbers: tuple[float, ...]
    long: bool


def without_corner_loops(contour: Path, side: Side) -> tuple[Path, tuple[CornerLoop, ...]]:
    """Return the contour with each loop cut back to its outside corner, and the loops.

    A closed contour may begin within a loop, as repeated passes do that a loop leads from one to the next.
    """
    shorter, loops = _cut_back(contour, side)
    if not len(shorter) or np.abs(shorter.points[0] - shorter.points[-1]).max() > JOINED or not _crosses(shorter):
        return shorter, loops
    middle = int(np.abs(shorter.lengths.cumsum() - 0.5 * shorter.lengths.sum()).argmin()) + 1
    elsewhere = joined([shorter.part(middle, len(shorter)), shorter.part(0, middle)])
    shortest, other_loops = _cut_back(elsewhere, side)
    return (shortest, (*loops, *other_loops)) if other_loops else (shorter, loops)


def _crosses(contour: Path) -> bool:
    with np.errstate(all="ignore"):
        return bool(len(self_crossings(piece_arrays(contour), closed=True)))


def _cut_back(contour: Path, side: Side) -> tuple[Path, tuple[CornerLoop, ...]]:
    """Return the contour without the loops that it does not begin in, and these loops."""
    loops = list[CornerLoop]()
    while len(contour) > 3 and (loop := _first_loop(contour, side)) is not None:
        first, last, at = loop
        shorter = _cut_short(contour, first, last, at)
        around = float(contour.lengths.sum() - shorter.lengths.sum())
        numbers = tuple(contour.numbers[first : last + 1].tolist())
        loops.append(CornerLoop(point_of_row(at), numbers, around > MAX_LOOP_SHARE * float(shorter.lengths.sum())))
        contour = shorter
    return contour, tuple(loops)


def _first_loop(contour: Path, side: Side) -> tuple[int, int, Floats] | None:
    """Return the rows of the two lines that cross at the first loop, and the place; None if there is no loop."""
    with np.errstate(all="ignore"):
        walls = piece_arrays(contour)
        crossings = self_crossings(walls, closed=False).places
    length = float(walls.stations[-1])
    for begin, end in crossings.tolist():
        inside = (crossings > begin + JOINED) & (crossings < end - JOINED)
        if inside.any() or end - begin > MIN_CONTOUR_SHARE * (length - end + begin):
            continue
        first, last = (int(np.searchsorted(walls.stations[1:-1], at, side="right")) for at in (begin, end))
        if last > first + 1 and _goes_around(contour, walls, first, last, side):
            at = contour.starts[first] + (begin - walls.stations[first]) * contour.start_directions[first]
            return int(walls.rows[first]), int(walls.rows[last]), at
    return None


def _goes_around(contour: Path, walls: PieceArrays, first: int, last: int, side: Side) -> bool:
    """True if the pieces between two crossing lines loop around an outside corner, on the cutter's side."""
    rows = walls.rows[first : last + 1]
    if walls.arcs[first] or walls.arcs[last]:
        return False
    leaving, coming = walls.unit[first], walls.unit[last]
    corner = float(np.angle(coming * np.conj(leaving))) * side.sign
    ends, starts = (contour.end_directions[rows[:-1]], contour.start_directions[rows[1:]])
    cross = ends[:, 0] * starts[:, 1] - ends[:, 1] * starts[:, 0]
    turned = float(np.arctan2(cross, (ends * starts).sum(axis=1)).sum() + contour.sweeps[rows].sum()) * side.sign
    # the long way round: a full turn more than the corner itself
    return corner < -MIN_CORNER_TURN and abs(turned - corner - 2.0 * pi) < MIN_CORNER_TURN


def _cut_short(contour: Path, first: int, last: int, at: Floats) -> Path:
    """Return the contour from row `first` straight to row `last` at a point where both cross."""
    points = np.concatenate((contour.points[: first + 1], at[None], contour.points[last + 1 :]))
    rows = [*range(first + 1), *range(last, len(contour))]
    return Path.of(points, contour.centers[rows], contour.turns[rows], contour.numbers[rows])
