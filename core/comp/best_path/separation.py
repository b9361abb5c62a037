"""Separation: the parts of the best path that the control's path misses, that is, what more could be cut.

The best path is FOLLOWED where a piece of the control's path runs along it: on the same line or circle within GOUGE,
in either direction.  The rest is returned in stretches, the longest runs of the best path that are not followed.
A crossing of the best path does not follow it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import tau

import numpy as np

from core.comp.best_path.best_path import BestPath
from core.geometry.distance import distance
from core.geometry.nearby import near_pairs
from core.geometry.path import Floats, Path, coordinates
from core.geometry.piece_arrays import PieceArrays, at, piece_arrays, traveled
from core.tolerance import GOUGE


@dataclass(frozen=True, eq=False, slots=True)
class Separation:
    """`length` millimeters of the best path's `whole` length are not followed, in `stretches` in the path's order."""

    length: float
    whole: float
    stretches: tuple[Path, ...]


def separation(control: Path, best: BestPath, radius: float) -> Separation:
    """Return the parts of the best path that the control's path, without its blends, does not follow.

    Two paths closer than GOUGE, or a thousandth of `radius` (millimeters) if that is less, are the same.  Stretches
    shorter than that are rounding.
    """
    limit = min(GOUGE, radius / 1000.0)
    stretches = []
    length = whole = 0.0
    moves = piece_arrays(control)
    for path in best.loops:
        loop = piece_arrays(path)
        whole += float(loop.length.sum())
        for first, last in _unfollowed(moves, loop, limit):
            stretches.append(_part(path, loop, first, last))
            length += last - first
    return Separation(length, whole, tuple(stretches))


def _unfollowed(control: PieceArrays, loop: PieceArrays, limit: float) -> list[tuple[float, float]]:
    """Return the gaps between the intervals in which the control's path follows the loop, in millimeters traveled."""
    stations = loop.stations
    first, last = [np.zeros(1), stations[-1:]], [np.zeros(1), stations[-1:]]
    for i, j in near_pairs(loop.boxes, control.boxes, 2.0 * limit):
        same_kind = loop.arcs[i] == control.arcs[j]
        i, j = i[same_kind], j[same_kind]
        piece, move = loop.take(i), control.take(j)
        for begin, end in _abreast(piece, move):
            begin, end = (np.minimum(np.maximum(along, 0.0), piece.length) for along in (begin, end))
            followed = end > begin
            for along in (begin, (begin + end) / 2.0, end):
                followed &= distance(move, at(piece, along / piece.length)) <= limit
            first.append((stations[i] + begin)[followed])
            last.append((stations[i] + end)[followed])
    begin, end = np.concatenate(first), np.concatenate(last)
    order = np.argsort(begin, kind="stable")
    begin, reached = begin[order], np.maximum.accumulate(end[order])
    gaps = (begin[1:] - reached[:-1] > limit).nonzero()[0]
    return list(zip(reached[gaps].tolist(), begin[gaps + 1].tolist(), strict=True))


def _abreast(piece: PieceArrays, move: PieceArrays) -> Iterator[tuple[Floats, Floats]]:
    """Yield the interval on each piece between the projections of its move's ends; twice, as arcs may pass a start."""
    ends = [(piece.unit.conj() * (point - piece.start)).real for point in (move.start, move.end)]
    entry = np.where(move.turn == piece.turn, move.start, move.end)
    begin = traveled(piece, entry - piece.center) * piece.radius
    end = begin + move.angle * piece.radius
    full_turn = np.where(piece.arcs, tau * piece.radius, 0.0)
    begin, end = np.where(piece.arcs, begin, np.minimum(*ends)), np.where(piece.arcs, end, np.maximum(*ends))
    yield begin, end
    yield begin - full_turn, end - full_turn


def _part(path: Path, loop: PieceArrays, first: float, last: float) -> Path:
    """Return the part of a path between two lengths traveled."""
    stations = loop.stations
    low = int(np.searchsorted(stations[1:], first, side="right"))
    high = min(int(np.searchsorted(stations[1:], last, side="left")), len(loop) - 1)
    part = path.part(int(loop.rows[low]), int(loop.rows[high]) + 1)
    rows = np.array([low, high])
    ends = at(loop.take(rows), (np.array([first, last]) - stations[rows]) / loop.length[rows])
    points = part.points.copy()
    points[[0, -1]] = coordinates(ends)
    return Path.of(points, part.centers, part.turns, part.numbers)
