"""Offset: the raw chain of all pieces one radius beside the contour, before any test.

Words: the chain's parts are offset SEGMENTs, CORNER arcs about outside corners, BRIDGEs (provisional lines where
an inside corner's two offsets are to be tested), and VANISHED segments (inside arcs not larger than the tool,
bridged likewise).  A part's `place` counts half steps: 2 k for the k-th segment (from 0), 2 k + 1 for what stands
between it and the next, so that two parts are within a look-ahead of v when their places are within 2 v.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from itertools import pairwise
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Flags, Floats, Path, Points, Rows, Turns, as_complex, coordinates
from core.geometry.piece import Side
from core.tolerance import JOINED

_STRETCH: Final = 16384
"""Segments offset at a time: few enough to stay in the processor's cache and off the memory's peak."""


class Part(IntEnum):
    """What a piece of the raw chain is."""

    SEGMENT = 0
    CORNER = 1
    BRIDGE = 2
    VANISHED = 3


CORNER, BRIDGE, VANISHED = (np.uint8(part) for part in (Part.CORNER, Part.BRIDGE, Part.VANISHED))
"""As they stand in a chain: a member of an enumeration takes longer to compare than the rest of it."""


@dataclass(frozen=True, eq=False, slots=True)
class Chain:
    """The raw chain of m pieces: `raw`, the `parts` (m,) they are and their `places` (m,) in half steps."""

    raw: Path
    parts: NDArray[np.uint8]
    places: Rows

    def __len__(self) -> int:
        return len(self.parts)


class _Stretch(NamedTuple):
    """The chain's pieces of a run of segments, as complex numbers; `points` are starts, and the chain's very end."""

    points: Points
    centers: Points
    turns: Turns
    numbers: Floats
    parts: NDArray[np.uint8]
    places: Rows


class _Beside(NamedTuple):
    """n offset segments: their starts and ends (2, n), and the unit normals there towards the cutter's left (2, n).

    `arcs` are the rows of arcs that do not vanish, `vanished` those of the arcs that do.
    """

    ends: Points
    normals: Points
    arcs: Rows
    vanished: Rows


def offset(contour: Path, side: Side, radius: float) -> Chain:
    """The raw chain of a contour without zero-length segments, at `radius` > 0 millimeters to `side`."""
    count = len(contour)
    bounds = [*range(0, count, _STRETCH), count]
    parts = [_stretch(contour, side.sign, radius, first, last) for first, last in pairwise(bounds)]
    chain = parts.pop() if len(parts) == 1 else _Stretch(*stacked(parts))
    _close_circles(chain.points, contour, chain.places)
    raw = Path(coordinates(chain.points), coordinates(chain.centers), chain.turns, chain.numbers)
    return Chain(raw, chain.parts, chain.places)


def stacked(rows: list[Any]) -> Iterator[Any]:
    """Each column of arrays as one array; the rows are taken apart, so that a column's parts go when it is done."""
    columns = [list(column) for column in zip(*rows, strict=True)][::-1]
    rows.clear()
    while columns:
        column = columns.pop()
        yield column[0] if len(column) == 1 else np.concatenate(column)


def _stretch(contour: Path, sign: int, radius: float, first: int, last: int) -> _Stretch:
    """The chain's part of segments first ... last - 1, with the joint behind each but the contour's last.

    Each segment has two slots, for itself and for its joint with the next one or its end; the chain takes some of them.
    """
    count, joints = last - first, min(last, len(contour) - 1) - first
    reached = slice(first, first + joints + 1)
    beside = _beside(contour, sign * radius, reached)
    link, outside = _joints(beside.normals, sign, radius)
    own, between, many = slice(0, None, 2), slice(1, -1, 2), 2 * (joints + 1)
    taken, turns, parts = np.zeros(many, np.bool_), np.zeros(many, np.int8), np.zeros(many, np.uint8)
    points, numbers = np.empty(many, np.complex128), np.empty(many)
    # behind the contour's last segment there is the chain's end
    taken[: 2 * count : 2], taken[between], taken[-1] = True, link, joints < count
    points[own], points[1::2] = beside.ends[0], beside.ends[1]
    numbers[own] = contour.numbers[reached]
    numbers[1::2] = numbers[own] + 0.5
    centers, arcs = points.copy(), beside.arcs
    turns[own][arcs], centers[own][arcs] = contour.turns[reached][arcs], as_complex(contour.centers)[reached][arcs]
    corners = outside.nonzero()[0]
    turns[between][corners], centers[between][corners] = -sign, as_complex(contour.points)[1:][reached][corners]
    parts[own][beside.vanished], parts[between] = VANISHED, BRIDGE
    parts[between][corners] = CORNER
    slots = taken.nonzero()[0]
    pieces = slots[:-1] if joints < count else slots
    places = pieces + 2 * first
    return _Stretch(points[slots], centers[pieces], turns[pieces], numbers[pieces], parts[pieces], places)


def _beside(contour: Path, shift: float, rows: slice) -> _Beside:
    """A run of segments moved by `shift` along their left normals."""
    points, turns = as_complex(contour.points), contour.turns[rows]
    starts, stops, arcs = points[:-1][rows], points[1:][rows], turns.nonzero()[0]
    ends, normals = np.empty((2, len(turns)), np.complex128), np.empty((2, len(turns)), np.complex128)
    ends[0], ends[1] = starts, stops
    normals[0] = normals[1] = 1j * (stops - starts)
    centers, around = as_complex(contour.centers)[rows][arcs], turns[arcs].astype(np.float64)
    normals[0][arcs], normals[1][arcs] = (centers - starts[arcs]) * around, (centers - stops[arcs]) * around
    sizes = np.abs(normals)
    normals /= sizes
    ends += shift * normals
    vanish = sizes[0][arcs] - shift * around <= JOINED
    return _Beside(ends, normals, arcs[~vanish], arcs[vanish])


def _joints(normals: Points, sign: int, radius: float) -> tuple[Flags, Flags]:
    """Which joints of segments with each other need a link, and which are outside corners.

    The offset ends' distance decides about tangency: the radius times that of the normals.
    An exact reversal is an outside corner: its offsets would meet nowhere on the other side.
    """
    before, behind = normals[1, :-1], normals[0, 1:]
    bend = before.conj() * behind
    reversal = (bend.real < 0.0) & (radius * np.abs(bend.imag) <= JOINED)
    return radius * np.abs(behind - before) > JOINED, (sign * bend.imag < 0.0) | reversal


def _close_circles(points: Points, contour: Path, places: Rows) -> None:
    """Keep full circles full where the next piece's start was taken for their end: equal ends are what makes them."""
    ends = as_complex(contour.points)
    circles = (ends[1:] == ends[:-1]).nonzero()[0]
    for row in places.searchsorted(2 * circles)[::-1].tolist() if len(circles) else ():
        points[row] = points[row + 1]
