"""Surface: a contour prepared for any number of paths beside it, without the over-runs at its ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.path import Path
from core.geometry.piece import Point, Side
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import CLOSED, JOINED
from core.verify.crossing import NO_CROSSINGS, SelfCrossings, self_crossings
from core.verify.pairs import nearest, pairs_of, rounding_of
from core.verify.wrong_side import on_part_side, sided


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """The walls of a contour on whose `side` the cutter runs, and where they meet themselves.

    `over_run_at` is where the first and the last element meet, if what lies beyond is a lead-in or a lead-out: the
    walls are closed there.
    """

    path: Path
    side: Side
    walls: PieceArrays
    closed: bool
    crossings: SelfCrossings
    over_run_at: Point | None = None

    @staticmethod
    def prepare(path: Path, side: Side) -> Surface:
        """The surface of a contour that can be judged."""
        with np.errstate(all="ignore"):
            walls = piece_arrays(path)
            closed = bool(abs(walls.end[-1] - walls.start[0]) <= CLOSED)
            whole = Surface(path, side, walls, closed, self_crossings(walls, closed=closed))
            return _without_over_run(whole) or whole


def _without_over_run(surface: Surface) -> Surface | None:
    """The surface between the crossing of its first and its last element.

    One of them may begin, end or join the next element at the crossing, as long as either runs beyond it.  None where
    anything else crosses, where a run beyond the crossing is on the part's side of what is left, and where it is as
    long as that.
    """
    walls, places, points = surface.walls, surface.crossings.places, surface.crossings.points
    if surface.closed or not len(points) or len(walls) < 3:
        return None
    stations = walls.stations
    at_ends = (places[:, 0] <= stations[1] + JOINED) & (places[:, 1] >= stations[-2] - JOINED)
    if not at_ends.all() or np.abs(points - points[0]).max() > 2.0 * JOINED:
        return None
    first, last = float(places[:, 0].min()), float(places[:, 1].max())
    lead_in, lead_out = first, float(stations[-1]) - last
    if max(lead_in, lead_out) <= JOINED or max(lead_in, lead_out) >= last - first:
        return None
    x, y = points[0].real.item(), points[0].imag.item()
    begin, end = walls.rows[0] + (first >= stations[1] - JOINED), walls.rows[-1] - (last <= stations[-2] + JOINED)
    left = piece_arrays(_between(surface.path, int(begin), int(end), (x, y)))
    side = sided(surface.side, left, NO_CROSSINGS, closed=True)
    before, after = _beyond(surface.path, walls, (x, y))
    ends = [(before, walls.start[0])] * (lead_in > JOINED) + [(after, walls.end[-1])] * (lead_out > JOINED)
    runs, far = piece_arrays(*(run for run, _ in ends)), np.array([point for _, point in ends])
    near = nearest(pairs_of(runs, left, rounding_of(walls)), np.arange(len(runs)), far)
    if on_part_side(left, far, near, side).any():
        return None
    return Surface(surface.path, surface.side, left, True, NO_CROSSINGS, (x, y))


def _between(path: Path, begin: int, end: int, at: Point) -> Path:
    """The path's pieces from one row to another, begun and ended at a point; those outside have no length."""
    points, centers, turns = path.points.copy(), path.centers.copy(), path.turns.copy()
    points[: begin + 1], points[end + 1 :] = at, at
    turns[:begin], turns[end + 1 :] = 0, 0
    lines = turns == 0
    centers[lines] = points[:-1][lines]
    return Path(points, centers, turns, path.numbers)


def _beyond(path: Path, walls: PieceArrays, at: Point) -> tuple[Path, Path]:
    """What lies before a point of the first wall, and behind it on the last one."""
    first, last = (path.part(row, row + 1) for row in (int(walls.rows[0]), int(walls.rows[-1])))
    before = Path.of(np.array((first.points[0], at)), first.centers, first.turns)
    center = last.centers if last.turns[0] else np.array((at,))
    return before, Path.of(np.array((at, last.points[1])), center, last.turns)
