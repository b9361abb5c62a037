"""Roads: the ways the judge may take to a verdict, each of which has to lead to the same.

Few walls are measured one and all; of many the judge proves what runs beside its own wall, and measures the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from typing import Any
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from core.geometry import aligned
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side
from core.verify import judge as module
from core.verify.beside import Beside, beside
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.verify import oracle

MANY = 310
"""Walls of which the judge proves what runs beside them, whoever asks."""


@dataclass(frozen=True)
class Road:
    """One way to a verdict; `words` say which."""

    name: str
    words: str
    verdict: Callable[[Path, Side, float, Path], Verdict]


def measured(surface: Path, side: Side, radius: float, path: Path) -> Verdict:
    """Every pair of a move and a wall is measured."""
    with thresholds(len(surface)):
        return judge(surface, side, radius, path)


def proved(surface: Path, side: Side, radius: float, path: Path) -> Verdict:
    """All that can be proved is; every number is that of the nearest wall."""
    with thresholds(0):
        return judge(surface, side, radius, hinted(surface, path))


def parted(surface: Path, side: Side, radius: float, path: Path) -> Verdict:
    """The same curves in so many parts that the judge proves of itself, long runs of walls among them."""
    parts = -(-MANY // len(surface))
    finer = in_parts(surface, [np.arange(1, parts) / parts] * len(surface))
    walls = hinted(surface, path).numbers.tolist()
    feet = [_feet(piece, surface, finer, number, parts) for piece, number in zip(path, walls, strict=True)]
    return judge(finer, side, radius, hinted(finer, in_parts(path, feet)))


ROADS = (
    Road("measured", "every pair of a move and a wall is measured", measured),
    Road("proved", "what runs beside its own wall is proved, from the first wall on", proved),
    Road("parted", f"the same curves in {MANY} walls and more, judged as they come", parted),
)


@contextmanager
def thresholds(few: int) -> Iterator[None]:
    """From more than `few` walls on the judge proves; without any threshold it looks along the contour too."""
    with patch.object(module, "FEW", few), patch.object(aligned, "FEW", aligned.FEW if few else 0):
        yield


@contextmanager
def proofs() -> Iterator[list[Beside]]:
    """All that the judge asks for meanwhile of what runs beside its own wall."""
    found: list[Beside] = []

    def seen(*given: Any) -> Beside:
        found.append(beside(*given))
        return found[-1]

    with patch.object(module, "beside", seen):
        yield found


def hinted(surface: Path, path: Path) -> Path:
    """The path with the number of the wall its middles are nearest to; arcs about a joint have the joint's."""
    middles = np.concatenate([oracle.along(piece, np.array([0.5])) for piece in path])
    apart = np.array([oracle.apart(middles, surface.part(k, k + 1)) for k in range(len(surface))])
    numbers = surface.numbers[apart.argmin(axis=0)]
    for row in np.flatnonzero(path.turns):
        if np.hypot(*(surface.points - path.centers[row]).T).min() < 1e-9:
            numbers[row] += 0.5
    return Path.of(path.points, path.centers, path.turns, numbers)


def in_parts(path: Path, shares: list[NDArray[np.float64]]) -> Path:
    """The path with each piece cut at these shares of it, which rise."""
    pieces: list[Piece] = []
    for piece, cuts in zip(path, shares, strict=True):
        spots = [piece.start, *map(_point, oracle.along(piece, cuts).tolist()), piece.end]
        for a, b in pairwise(spots):
            pieces.append(Line(a, b) if isinstance(piece, Line) else Arc(a, b, piece.center, piece.turn))
    return Path.from_pieces(pieces)


def _point(pair: list[float]) -> Point:
    return pair[0], pair[1]


def _feet(piece: Piece, surface: Path, finer: Path, number: float, parts: int) -> NDArray[np.float64]:
    """Shares of a move that are over the parts' ends of its wall, as seen from the move; none of a corner."""
    row = int(np.flatnonzero(surface.numbers == np.floor(number))[0])
    joints = finer.points[row * parts + 1 : (row + 1) * parts] if number % 1.0 == 0.0 else np.zeros((0, 2))
    if isinstance(piece, Line):
        way = np.subtract(piece.end, piece.start)
        shares = (joints - piece.start) @ way / max(float(way @ way), 1e-300)
    else:
        first, towards = np.subtract(piece.start, piece.center), joints - piece.center
        angle = np.arctan2(towards @ (-first[1], first[0]), towards @ first) * int(piece.turn)
        shares = np.mod(angle, 2.0 * np.pi) / oracle.swept(piece)
    kept = np.sort(shares[(shares > 1e-6) & (shares < 1.0 - 1e-6)])
    return np.asarray(kept[np.diff(kept, prepend=-1.0) > 1e-9])
