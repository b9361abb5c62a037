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
    where = np.zeros(count, np.intp)
    where[link[link < count - 1] + 1] = 1
    where = np.cumsum(where) + np.arange(count)
    between = where[link] + 1
    starts = np.empty(count + len(link), np.complex128)
    starts[where], starts[between] = beside.starts[:count], beside.ends[link]
    arcs = (contour.turns[first:last] != 0) & ~beside.vanished[:count]
    centres = starts.copy()
    centres[where[arcs]] = planes(contour.centres)[first:last][arcs]
    centres[between[outside]] = planes(contour.points)[first + 1 + link[outside]]
    turns = np.empty(len(starts), np.int8)
    turns[where], turns[between] = np.where(arcs, contour.turns[first:last], 0), np.where(outside, -sign, 0)
    parts = np.empty(len(starts), np.uint8)
    parts[where] = np.where(beside.vanished[:count], Part.VANISHED.value, Part.SEGMENT.value)
    parts[between] = np.where(outside, Part.CORNER.value, Part.BRIDGE.value)
    numbers = np.empty(len(starts))
    numbers[where] = contour.numbers[first:last]
    numbers[between] = numbers[between - 1] + 0.5
    places = np.empty(len(starts), np.int32)
    places[where], places[between] = 2 * np.arange(first, last), 2 * (link + first) + 1
    points = starts if joints == count else np.append(starts, beside.ends[-1])
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
    circles = ((contour.turns != 0) & (ends[1:] == ends[:-1])).nonzero()[0]
    for row in np.searchsorted(places, 2 * circles)[::-1].tolist():
        points[row] = points[row + 1]
