"""Compared contours: two programs compared by the contours they describe, whatever their languages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.contours_and_leads import contour_of
from core.controls.control_run import ControlRun, Stretch
from core.controls.judged_runs import programmed_surface
from core.geometry.distance import distance
from core.geometry.path import Path
from core.geometry.piece_arrays import at, piece_arrays
from core.tolerance import ON_PATH

APART: Final = 0.0005
"""Millimeters from which on two paths or contours differ."""

MAX_PAIRS: Final = 20_000_000
"""Places times pieces that are measured; of longer contours fewer places are."""


@dataclass(frozen=True, slots=True)
class Parting:
    """Where two paths part: the first line, the line at which they are farthest apart, and how far in millimeters."""

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
        """Whether both describe one contour, cut on the same side."""
        return self.first is None and self.second is None and self.same_side


def contours(first: ControlRun, second: ControlRun) -> tuple[ContourPair, ...]:
    """The compensated stretches of two runs in pairs, without their leads."""
    pairs = zip(first.stretches, second.stretches, strict=False)
    return tuple(_pair(number, *pair) for number, pair in enumerate(pairs, 1))


def _pair(number: int, first: Stretch, second: Stretch) -> ContourPair:
    surfaces = programmed_surface(first), programmed_surface(second)
    ours, theirs = (surface.part(*contour_of(surface)) for surface in surfaces)
    same_side = first.side is second.side and first.plane is second.plane
    return ContourPair(number, apart(ours, theirs, APART), apart(theirs, ours, APART), same_side)


def apart(path: Path, other: Path, tolerance: float) -> Parting | None:
    """Where a path is farther than `tolerance` from another one, by its lines; None if nowhere."""
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
    """(k,) how far places at these shares of a path's pieces are from another path, and (k,) the rows of the pieces.

    Both paths have pieces; of long ones only a few places are measured.
    """
    pieces, onto = piece_arrays(path), piece_arrays(other)
    places = np.concatenate([at(pieces, np.full(len(pieces), share)) for share in shares])
    step = max(1, len(places) * len(onto) // MAX_PAIRS)
    off = [float(np.min(distance(onto, np.full(len(onto), place)))) for place in places[::step]]
    return np.array(off), np.tile(pieces.rows, len(shares))[::step]
