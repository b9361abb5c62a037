"""Two programs compared by the contours they describe, whatever their languages: Klartext beside ISO."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.contours_and_leads import contour_of
from core.controls.control_run import Run, Stretch
from core.controls.judged_runs import surface_of
from core.geometry.distance import distance
from core.geometry.path import Path
from core.geometry.piece_arrays import piece_arrays

APART: Final = 0.0005
"""Millimeters from which on two contours are told to part."""

MOST_PAIRS: Final = 20_000_000
"""Places times pieces that are worked out; of longer contours only every so manyth place is."""


@dataclass(frozen=True, slots=True)
class Parting:
    """Where two paths part: the first line, the line at which they are farthest apart, and how far in millimeters."""

    line: int
    farthest: int
    distance: float


@dataclass(frozen=True, slots=True)
class ContourParting:
    """How far one contour is from another at most, and at which line of its program; `sides` and planes may differ."""

    line: int
    distance: float


@dataclass(frozen=True, slots=True)
class ContourPair:
    """One compensated stretch of each program, counted from 1: what differs, None where nothing does."""

    number: int
    first: ContourParting | None
    second: ContourParting | None
    same_side: bool

    @property
    def same(self) -> bool:
        """Whether both describe one contour, cut on the same side."""
        return self.first is None and self.second is None and self.same_side


def contours(first: Run, second: Run) -> tuple[ContourPair, ...]:
    """The compensated stretches of two runs in pairs; leads that are told from the contour are left out."""
    pairs = zip(first.stretches, second.stretches, strict=False)
    return tuple(_pair(number, one, other) for number, (one, other) in enumerate(pairs, 1))


def _pair(number: int, first: Stretch, second: Stretch) -> ContourPair:
    one, other = _contour(first), _contour(second)
    same_side = first.side is second.side and first.plane is second.plane
    return ContourPair(number, _parting(one, other), _parting(other, one), same_side)


def _contour(stretch: Stretch) -> Path:
    whole = surface_of(stretch)
    return whole.part(*contour_of(whole))


def _parting(path: Path, other: Path) -> ContourParting | None:
    """The place of a path that is farthest from the other one, None where they are one."""
    found = apart(path, other, APART)
    return None if found is None else ContourParting(found.farthest, found.distance)


def apart(path: Path, other: Path, tolerance: float) -> Parting | None:
    """Where a path is further than `tolerance` from another one, by its lines; None if nowhere."""
    if not len(path):
        return None
    if not len(other):
        line = int(path.numbers[0])
        return Parting(line, line, float("inf"))
    places, rows = _places(path)
    step = max(1, len(places) * len(other) // MOST_PAIRS)
    places, rows = places[::step], rows[::step]
    pieces = piece_arrays(other)
    least = np.array([float(np.min(distance(pieces, np.full(len(other), place)))) for place in places])
    first, worst = int(np.argmax(least > tolerance)), int(np.argmax(least))
    if least[worst] <= tolerance:
        return None
    return Parting(int(path.numbers[rows[first]]), int(path.numbers[rows[worst]]), float(least[worst]))


def _places(path: Path) -> tuple[NDArray[np.complex128], NDArray[np.intp]]:
    """Start, middle and end of every piece as x + iy, and the rows they belong to."""
    middles = (path.starts + path.ends) / 2
    bent = path.turns != 0
    radial = path.starts - path.centers
    half = path.sweeps / 2
    turned = np.stack(
        (
            radial[:, 0] * np.cos(half) - radial[:, 1] * np.sin(half),
            radial[:, 0] * np.sin(half) + radial[:, 1] * np.cos(half),
        ),
        axis=1,
    )
    middles = np.where(bent[:, None], path.centers + turned, middles)
    points = np.stack((path.starts, middles, path.ends), axis=1).reshape(-1, 2)
    return points[:, 0] + 1j * points[:, 1], np.repeat(np.arange(len(path)), 3)
