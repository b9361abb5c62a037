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

from core.geometry.intersect import Indices, Masks, Planes, coordinates, planes
from core.geometry.path import Floats, Path, Turns
from core.geometry.side import Side
from core.tolerance import JOINED

_STRETCH: Final = 16384
"""Segments offset at a time: few enough to stay in the processor's cache and off the memory's peak."""


class Part(IntEnum):
    """What a piece of the raw chain is."""

    SEGMENT = 0
    CORNER = 1
    BRIDGE = 2
    VANISHED = 3


_SEGMENT, _CORNER, _BRIDGE, _VANISHED = (np.uint8(part) for part in Part)


@dataclass(frozen=True, eq=False, slots=True)
class Chain:
    """The raw chain of m pieces: `raw`, the `parts` (m,) they are and their `places` (m,) in half steps."""

    raw: Path
    parts: NDArray[np.uint8]
    places: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.parts)


class _Stretch(NamedTuple):
    """The chain's pieces of a run of segments, as complex numbers; `points` are starts, and the chain's very end."""

    points: Planes
    centres: Planes
    turns: Turns
    numbers: Floats
    parts: NDArray[np.uint8]
    places: NDArray[np.int32]


class _Beside(NamedTuple):
    """Offset segments: start and end points, unit normals there towards the cutter's left, and which vanish."""

    starts: Planes
    ends: Planes
    start_normals: Planes
    end_normals: Planes
    vanished: Masks


def offset(contour: Path, side: Side, radius: float) -> Chain:
    """The raw chain of a contour without zero-length segments, at `radius` > 0 millimetres to `side`."""
    count = len(contour)
    bounds = [*range(0, count, _STRETCH), count]
    points, centres, turns, numbers, parts, places = stacked(
        [_stretch(contour, side.sign, radius, first, last) for first, last in pairwise(bounds)]
    )
    _close_circles(points, contour, places)
    return Chain(Path(coordinates(points), coordinates(centres), turns, numbers), parts, places)


def stacked(rows: list[tuple[Any, ...]]) -> Iterator[Any]:
    """Each column of arrays as one array; the rows are taken apart, so that a column's parts go when it is done."""
    columns = [list(column) for column in zip(*rows, strict=True)][::-1]
    rows.clear()
    while columns:
        column = columns.pop()
        yield column[0] if len(column) == 1 else np.concatenate(column)


def _stretch(contour: Path, sign: int, radius: float, first: int, last: int) -> _Stretch:
    """The chain's part of segments first ... last - 1, with the joint behind each but the contour's last."""
    count, joints = last - first, min(last, len(contour) - 1) - first
    beside = _beside(contour, sign * radius, first, first + joints + 1 if joints == count else last)
    link, outside = _joints(beside, sign, radius, joints)
    between = link + np.arange(1, len(link) + 1)
    own = np.ones(count + len(link), np.bool_)
    own[between] = False
    # the segment of each piece: its own, or the one before the joint
    rows = own.cumsum()
    rows -= 1
    starts = beside.starts[rows]
    starts[between] = beside.ends[link]
    vanished = beside.vanished[rows]
    turns = contour.turns[first:last][rows]
    turns[vanished] = 0
    turns[between] = 0
    arcs = turns.nonzero()[0]
    centres = starts.copy()
    centres[arcs] = planes(contour.centres)[first:last][rows[arcs]]
    corners = between[outside]
    centres[corners], turns[corners] = planes(contour.points)[first + 1 + link[outside]], -sign
    parts = np.where(vanished, _VANISHED, _SEGMENT)
    parts[between] = np.where(outside, _CORNER, _BRIDGE)
    numbers = contour.numbers[first:last][rows]
    numbers[between] += 0.5
    places = (2 * (rows + first)).astype(np.int32)
    places[between] += 1
    points = starts if joints == count else np.concatenate((starts, beside.ends[-1:]))
    return _Stretch(points, centres, turns, numbers, parts, places)


def _beside(contour: Path, shift: float, first: int, last: int) -> _Beside:
    """Segments first ... last - 1 moved by `shift` along their left normals."""
    points, centres = planes(contour.points)[first : last + 1], planes(contour.centres)[first:last]
    turns = contour.turns[first:last]
    straight = turns == 0
    across = 1j * (points[1:] - points[:-1])
    radial = points[:-1] - centres
    size = np.abs(radial)
    start_normals = _unit(np.where(straight, across, -turns * radial))
    end_normals = _unit(np.where(straight, across, turns * (centres - points[1:])))
    vanished = ~straight & (size - turns * shift <= JOINED)
    starts, ends = points[:-1] + shift * start_normals, points[1:] + shift * end_normals
    return _Beside(starts, ends, start_normals, end_normals, vanished)


def _unit(vectors: Planes) -> Planes:
    return vectors / np.abs(vectors)


def _joints(beside: _Beside, sign: int, radius: float, count: int) -> tuple[Indices, Masks]:
    """Which of the first `count` joints need a link, and which of those are outside corners.

    The offset ends' distance decides about tangency: the radius times that of the normals.
    An exact reversal is an outside corner: its offsets would meet nowhere on the other side.
    """
    before, behind = beside.end_normals[:count], beside.start_normals[1 : count + 1]
    link = (radius * np.abs(behind - before) > JOINED).nonzero()[0]
    bend = before[link].conj() * behind[link]
    reversal = (bend.real < 0.0) & (radius * np.abs(bend.imag) <= JOINED)
    return link, (sign * bend.imag < 0.0) | reversal


def _close_circles(points: Planes, contour: Path, places: NDArray[np.int32]) -> None:
    """Keep full circles full where the next piece's start was taken for their end: equal ends are what makes them."""
    ends = planes(contour.points)
    circles = (ends[1:] == ends[:-1]).nonzero()[0]
    for row in places.searchsorted(2 * circles)[::-1].tolist() if len(circles) else ():
        points[row] = points[row + 1]
