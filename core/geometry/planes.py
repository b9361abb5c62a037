"""Points as complex numbers, and pieces that need not join: what is calculated with many pieces at once.

conj(u) v has the dot product as real and the cross product as imaginary part.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Floats, Path, Turns

Indices = NDArray[np.intp]
Planes = NDArray[np.complex128]
Masks = NDArray[np.bool_]


class Pieces(NamedTuple):
    """k pieces that need not join: ends and centers as complex numbers, turns as in `Path`."""

    start: Planes
    end: Planes
    center: Planes
    turn: Turns


def planes(pairs: Floats) -> Planes:
    """(n, 2) coordinates as (n,) complex numbers, without a copy where they lie together in memory."""
    flat: Planes = np.ascontiguousarray(pairs).view(np.complex128)[:, 0]
    return flat


def coordinates(points: Planes) -> Floats:
    """(n,) complex numbers as (n, 2) coordinates, without a copy where they lie together in memory."""
    return np.ascontiguousarray(points).view(np.float64).reshape(-1, 2)


def onward(values: NDArray[Any]) -> NDArray[Any]:
    """The next one of each value round a ring: that of the last is the first.  `np.roll` takes five times as long."""
    return np.concatenate((values[1:], values[:1]))


def pieces_of(path: Path) -> Pieces:
    """The pieces of a path, without a copy."""
    points = planes(path.points)
    return Pieces(points[:-1], points[1:], planes(path.centers), path.turns)


def taken(pieces: Pieces, rows: Indices) -> Pieces:
    """Some of the pieces."""
    return Pieces(pieces.start[rows], pieces.end[rows], pieces.center[rows], pieces.turn[rows])
