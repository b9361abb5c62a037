"""The same curves in many more parts: what the judge says of them must not change."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.verify import oracle

MANY = 310
"""Walls that a contour is parted into."""


def judge_finer(surface: Path, side: Side, radius: float, path: Path) -> Verdict:
    """The verdict on the same curves in MANY parts and more."""
    parts = -(-MANY // len(surface))
    finer = in_parts(surface, [np.arange(1, parts) / parts] * len(surface))
    walls = _nearest_walls(surface, path)
    feet = [_feet(piece, surface, finer, number, parts) for piece, number in zip(path, walls, strict=True)]
    return judge(finer, side, radius, in_parts(path, feet))


def _nearest_walls(surface: Path, path: Path) -> list[float]:
    """The numbers of the walls that the middles of the moves are nearest to; arcs about a joint have the joint's."""
    middles = np.concatenate([oracle.along(piece, np.array([0.5])) for piece in path])
    apart = np.array([oracle.apart(middles, surface.part(k, k + 1)) for k in range(len(surface))])
    numbers = surface.numbers[apart.argmin(axis=0)]
    for row in np.flatnonzero(path.turns):
        if np.hypot(*(surface.points - path.centers[row]).T).min() < 1e-9:
            numbers[row] += 0.5
    return [float(number) for number in numbers]


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
