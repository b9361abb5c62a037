"""Compared contours show where two programs, in whatever languages, describe different contours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.contours_and_leads import contour_of
from core.controls.judging.stretch_paths import programmed_surface
from core.geometry.distance import distance
from core.geometry.path import Path
from core.geometry.piece_arrays import at, piece_arrays
from core.tolerance import ON_PATH

MAX_SAME_DISTANCE: Final = 0.0005
"""Millimeters above which two paths or contours differ."""

MAX_PAIRS: Final = 20_000_000
"""Most measurements, points times pieces; longer contours are measured at fewer points."""


@dataclass(frozen=True, slots=True)
class Parting:
    """Where two paths part: the first line, the line where they are farthest apart, and how far in millimeters."""

    line: int
    farthest: int
    distance: float


@dataclass(frozen=True, slots=True)
class ContourPair:
    """One compensated stretch of each program, counted from 1: where each leaves the other, None if nowhere."""

    number: int
    first: Parting | None
    second: Parting | None
    same_side: bool

    @property
    def same(self) -> bool:
        """True if both describe one contour, cut on the same side."""
        return self.first is None and self.second is None and self.same_side


def contours(first: ControlRun, second: ControlRun) -> tuple[ContourPair, ...]:
    """Return the compensated stretches of two runs in pairs, compared without their leads."""
    pairs = zip(first.stretches, second.stretches, strict=False)
    return tuple(_pair(number, *pair) for number, pair in enumerate(pairs, 1))


def _pair(number: int, first: Stretch, second: Stretch) -> ContourPair:
    surfaces = programmed_surface(first), programmed_surface(second)
    ours, theirs = (surface.part(*contour_of(surface)) for surface in surfaces)
    same_side = first.side is second.side and first.plane is second.plane
    return ContourPair(
        number, apart(ours, theirs, MAX_SAME_DISTANCE), apart(theirs, ours, MAX_SAME_DISTANCE), same_side
    )


def apart(path: Path, other: Path, tolerance: float) -> Parting | None:
    """Return where a path is farther than `tolerance` from another one, by its lines; None if nowhere."""
    if not path.lengths.any():
        return None
    if not other.lengths.any():
        line = int(path.numbers[0])
        return Parting(line, line, float("inf"))
    off, rows = distances(path, other, (0.0, 0.5, 1.0))
    if off.max() <= tolerance:
        return None
    first, worst = int(rows[off > tolerance].min()), int(rows[off >= off.max() - ON_PATH].min())
    return Parting(int(path.numbers[first]), int(path.numbers[worst]), float(off.max()))


def distances(path: Path, other: Path, shares: tuple[float, ...]) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Return (k,) distances to another path from points at these shares of a path's pieces, and (k,) the pieces' rows.

    Both paths must have pieces; long ones are measured at only a few points.
    """
    pieces, onto = piece_arrays(path), piece_arrays(other)
    points = np.concatenate([at(pieces, np.full(len(pieces), share)) for share in shares])
    step = max(1, len(points) * len(onto) // MAX_PAIRS)
    off = [float(np.min(distance(onto, np.full(len(onto), point)))) for point in points[::step]]
    return np.array(off), np.tile(pieces.rows, len(shares))[::step]
