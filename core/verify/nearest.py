"""Nearest: where a center path comes nearest to the surface, for whoever asks after the verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.geometry.distance import foot
from core.geometry.path import Path
from core.geometry.piece import Point
from core.geometry.piece_arrays import at
from core.tolerance import GOUGE, ON_PATH
from core.verify.course import courses
from core.verify.judge import judgeable
from core.verify.pairs import approaches, pairs_of


@dataclass(frozen=True, slots=True)
class Nearest:
    """The least distance from path to surface, millimeters, and the first place along the path that is so near.

    `at` is the center there, `surface_at` the surface point, `surface_number` the contour's segment.
    """

    distance: float
    at: Point
    surface_at: Point
    surface_number: float


def nearest(surface: Path, centers: Sequence[Path], clearance: float) -> Nearest | None:
    """Where these paths, all cut, come as near to the surface as `clearance`, their verdict's; None if nowhere.

    Places that differ by no more than GOUGE are as near as each other.
    """
    with np.errstate(all="ignore"):
        if not (len(surface) and centers and judgeable(clearance, surface, *centers)):
            return None
        wall_course, move_course = courses((surface,), centers)
        walls, moves = wall_course.pieces, move_course.pieces
        slack = 2.0 * float(walls.slack.max() + moves.slack.max(initial=0.0))
        reach = clearance + slack + 2.0 * GOUGE
        near = approaches(pairs_of(move_course, wall_course, clearance, reach), reach)
        k, pair = np.nonzero(near.apart <= clearance + GOUGE)
        if not len(pair):
            return None
        stations = move_course.stations[near.i[pair]] + near.places[k, pair] * moves.length[near.i[pair]]
        first = int(np.lexsort((near.j[pair], np.round(stations / ON_PATH)))[0])
        row = pair[first : first + 1]
        place = at(moves.take(near.i[row]), near.places[k[first : first + 1], row])
        wall = walls.take(near.j[row])
        touched, center = at(wall, foot(wall, place)).item(), place.item()
    number = surface.numbers[wall.rows].item()
    return Nearest(clearance, (center.real, center.imag), (touched.real, touched.imag), number)
