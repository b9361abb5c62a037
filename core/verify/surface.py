"""Surface: a contour prepared for any number of paths beside it, without the over-runs at its ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.path import Path
from core.geometry.piece import Point, Side
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import CLOSED, JOINED
from core.verify.crossing import NO_CROSSINGS, Crossings, crossings
from core.verify.pairs import nearest, pairs_of, rounding_of
from core.verify.wrong_side import on_part_side, sided


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """The walls of a contour on whose `side` the cutter runs, and where they meet themselves.

    `over_run_at` is where the first and the last element cross, if what lies beyond is a lead-in and a lead-out: the
    walls are closed there.
    """

    path: Path
    side: Side
    walls: PieceArrays
    closed: bool
    crossings: Crossings
    over_run_at: Point | None = None

    @staticmethod
    def prepare(path: Path, side: Side) -> Surface:
        """The surface of a contour that can be judged."""
        with np.errstate(all="ignore"):
            walls = piece_arrays(path)
            closed = bool(abs(walls.end[-1] - walls.start[0]) <= CLOSED)
            whole = Surface(path, side, walls, closed, crossings(walls, closed=closed))
            return _without_over_run(whole) or whole


def _without_over_run(surface: Surface) -> Surface | None:
    """The surface between the crossing of its first and its last element.

    None where anything else crosses, where a run beyond the crossing is on the part's side of what is left, and where
    it is as long as that or has no length.
    """
    walls, places, points = surface.walls, surface.crossings.places, surface.crossings.points
    if surface.closed or not len(points) or len(walls) < 3:
        return None
    stations = walls.stations
    ends = (places[:, 0] <= stations[1] - JOINED) & (places[:, 1] >= stations[-2] + JOINED)
    first, last = places[0]
    shortest, longest = sorted((float(first), float(stations[-1] - last)))
    one = bool(ends.all() and np.abs(points - points[0]).max() <= 2.0 * JOINED)
    if not one or shortest <= JOINED or longest >= last - first:
        return None
    x, y = points[0].real.item(), points[0].imag.item()
    left = piece_arrays(_cut(surface.path, walls, (x, y)))
    if len(left) != len(walls):
        return None
    runs = piece_arrays(*_runs(surface.path, walls, (x, y)))
    pairs, index = pairs_of(runs, left, rounding_of(walls)), np.array((0, len(runs) - 1))
    far = np.array((runs.start[0], runs.end[-1]))
    side = sided(surface.side, left, NO_CROSSINGS, closed=True)
    if on_part_side(left, far, nearest(pairs, index, far), side).any():
        return None
    return Surface(surface.path, surface.side, left, True, NO_CROSSINGS, (x, y))


def _cut(path: Path, walls: PieceArrays, at: Point) -> Path:
    """The path from a point of its first wall to the same point of its last one."""
    points, centers = path.points.copy(), path.centers.copy()
    first, last = int(walls.rows[0]), int(walls.rows[-1])
    points[: first + 1], points[last + 1 :] = at, at
    lines = path.turns == 0
    centers[lines] = points[:-1][lines]
    return Path(points, centers, path.turns, path.numbers)


def _runs(path: Path, walls: PieceArrays, at: Point) -> tuple[Path, Path]:
    """What lies before that point on the first wall, and behind it on the last one."""
    first, last = (path.part(row, row + 1) for row in (int(walls.rows[0]), int(walls.rows[-1])))
    before = Path.of(np.array((first.points[0], at)), first.centers, first.turns)
    center = last.centers if last.turns[0] else np.array((at,))
    return before, Path.of(np.array((at, last.points[1])), center, last.turns)
