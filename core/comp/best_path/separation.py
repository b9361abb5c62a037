"""Separation: what separates the control's path from the best path, that is, what more could be cut.

The best path is FOLLOWED where a piece of the control's path runs along it: on the same line or circle within GOUGE,
whichever way it travels.  The rest is given in stretches, the longest runs of the best path that are not followed.
Crossing the best path is not following it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import tau

import numpy as np

from core.comp.best_path.clear import distances
from core.comp.best_path.raw_offset import lengths
from core.comp.best_path.result import BestPath
from core.comp.best_path.tree import Tree, near, piece_boxes, tree
from core.geometry.path import Flags, Floats, Path, Points, Rows, as_complex, coordinates
from core.tolerance import GOUGE


@dataclass(frozen=True, eq=False, slots=True)
class Separation:
    """`length` millimeters of the best path's `whole` length are not followed; `stretches` are these, in its order."""

    length: float
    whole: float
    stretches: tuple[Path, ...]


def separation(control: Path, best: BestPath, radius: float) -> Separation:
    """What of the best path the control's path does not follow, blends left out of `control`.

    Two paths closer than GOUGE, or a thousandth of `radius` (millimeters) if that is less, are the same.  Stretches
    shorter than that are rounding.
    """
    limit = min(GOUGE, radius / 1000.0)
    stretches = []
    length = 0.0
    for loop in best.loops:
        for first, last in _unfollowed(control, loop, limit):
            stretches.append(_part(loop, first, last))
            length += last - first
    whole = sum(float(loop.lengths.sum()) for loop in best.loops)
    return Separation(length, whole, tuple(stretches))


def _unfollowed(control: Path, loop: Path, limit: float) -> list[tuple[float, float]]:
    """The gaps between the intervals in which the control's path follows the loop, as millimeters traveled on it."""
    size = loop.lengths
    stations = np.concatenate((np.zeros(1), np.cumsum(size)))
    first, last = [np.zeros(1), stations[-1:]], [np.zeros(1), stations[-1:]]
    for i, j in _near(loop, control, limit):
        if not len(i):
            continue
        for begin, end in _along(loop, i, control, j):
            begin, end = (np.minimum(np.maximum(one, 0.0), size[i]) for one in (begin, end))
            on = _follows(loop, i, control, j, (begin, (begin + end) / 2.0, end), limit) & (end > begin)
            first.append((stations[i] + begin)[on])
            last.append((stations[i] + end)[on])
    begin, end = np.concatenate(first), np.concatenate(last)
    order = np.argsort(begin, kind="stable")
    begin, reached = begin[order], np.maximum.accumulate(end[order])
    gaps = (begin[1:] - reached[:-1] > limit).nonzero()[0]
    return list(zip(reached[gaps].tolist(), begin[gaps + 1].tolist(), strict=True))


def _near(loop: Path, control: Path, limit: float) -> Iterator[tuple[Rows, Rows]]:
    """Pairs of pieces of the same kind near each other."""
    for i, j in near(_boxes(loop, limit), _boxes(control, limit), 0.0):
        same = (loop.turns[i] != 0) == (control.turns[j] != 0)
        yield i[same], j[same]


def _boxes(path: Path, limit: float) -> Tree:
    points = as_complex(path.points)
    return tree(piece_boxes(points[:-1], points[1:], as_complex(path.centers), path.turns, limit))


def _along(loop: Path, i: Rows, control: Path, j: Rows) -> Iterator[tuple[Floats, Floats]]:
    """From where to where on pieces i the ends of pieces j project; twice, because an arc may run over the start."""
    points, ends = as_complex(loop.points), as_complex(control.points)
    start, turns = points[i], loop.turns[i]
    straight = turns == 0
    chord = points[i + 1] - start
    unit = chord / np.where(straight & (chord != 0.0), np.abs(chord), 1.0)
    one, two = (unit.conj() * (ends[j] - start)).real, (unit.conj() * (ends[j + 1] - start)).real
    arm = start - as_complex(loop.centers)[i]
    radius = np.abs(arm)
    other = control.turns[j] != turns
    entry = np.where(other, ends[j + 1], ends[j]) - as_complex(loop.centers)[i]
    begin = np.mod(np.angle(arm.conj() * entry) * turns, tau) * radius
    centers = as_complex(control.centers)
    swept = lengths(ends[j], ends[j + 1], centers[j], control.turns[j])
    scale = np.abs(ends[j] - centers[j])
    end = begin + swept * radius / np.where(scale == 0.0, 1.0, scale)
    yield np.where(straight, np.minimum(one, two), begin), np.where(straight, np.maximum(one, two), end)
    yield np.where(straight, 0.0, begin - tau * radius), np.where(straight, 0.0, end - tau * radius)


def _follows(loop: Path, i: Rows, control: Path, j: Rows, along: tuple[Floats, ...], limit: float) -> Flags:
    """Which pieces i are at all of these places along them within the limit of pieces j."""
    near = np.ones(len(i), np.bool_)
    for at in along:
        near &= distances(control, j, _places(loop, i, at)) <= limit
    return near


def _places(path: Path, rows: Rows, along: Floats) -> Points:
    """(k,) points at distances from the starts of pieces."""
    start, turns = as_complex(path.points)[rows], path.turns[rows]
    arm = np.where(turns == 0, start - as_complex(path.points)[rows + 1], start - as_complex(path.centers)[rows])
    size = np.abs(arm)
    part = along / np.where(size == 0.0, 1.0, size)
    points: Points = np.where(turns == 0, start - arm * part, start - arm + arm * np.exp(1j * turns * part))
    return points


def _part(path: Path, first: float, last: float) -> Path:
    """The stretch of a path between two lengths traveled."""
    stations = np.cumsum(path.lengths)
    low = int(np.searchsorted(stations, first, side="right"))
    high = min(int(np.searchsorted(stations, last, side="left")), len(path) - 1)
    part = path.part(low, high + 1)
    ends = _places(path, np.array([low, high]), np.array([first, last]) - (stations - path.lengths)[[low, high]])
    points = part.points.copy()
    points[[0, -1]] = coordinates(ends)
    return Path.of(points, part.centers, part.turns, part.numbers)
