"""Where two center paths differ: stretches of the one that are not in the other, by the segments they belong to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import dist, inf
from typing import Final

from core.geometry.path import Path
from core.geometry.piece import Arc, Piece

PRINTED: Final = 2e-4
"""Points of two paths this near, in millimeters beside a cutter of 200, are one: LinuxCNC prints four decimals."""

SHORT: Final = 1e-3
"""Pieces shorter than this are left out of both paths: their ends can hardly be told apart in print."""


@dataclass(frozen=True)
class Difference:
    """Our pieces and theirs that stand for one another, and the numbers of our pieces before and behind them."""

    ours: tuple[Piece, ...]
    theirs: tuple[Piece, ...]
    first: float
    last: float


def differences(path: Path, theirs: Sequence[Piece]) -> list[Difference]:
    """Every difference of our path from theirs, along the way; none if they are the same."""
    numbered = [(piece, number) for piece, number in zip(path, path.numbers.tolist(), strict=True) if _long(piece)]
    ours, numbers = [piece for piece, _ in numbered], [-inf, *(number for _, number in numbered), inf]
    theirs = [piece for piece in theirs if _long(piece)]
    found, at = [], (0, 0)
    for i, j in [*_common(ours, theirs), (len(ours), len(theirs))]:
        if (i, j) != at:
            some = Difference(tuple(ours[at[0] : i]), tuple(theirs[at[1] : j]), numbers[at[0]], numbers[i + 1])
            found.append(some)
        at = (i + 1, j + 1)
    return found


def _long(piece: Piece) -> bool:
    """Whether a piece is long enough to be compared; an arc whose ends are one point in print is a full circle."""
    return dist(piece.start, piece.end) > SHORT or (isinstance(piece, Arc) and piece.length > SHORT)


def same(one: Piece, two: Piece) -> bool:
    """Whether two pieces are one to the printed decimals."""
    near = dist(one.start, two.start) < PRINTED and dist(one.end, two.end) < PRINTED
    if not near or isinstance(one, Arc) is not isinstance(two, Arc):
        return False
    if isinstance(one, Arc) and isinstance(two, Arc):
        return one.turn is two.turn and dist(one.center, two.center) < PRINTED
    return True


def _common(ours: Sequence[Piece], theirs: Sequence[Piece]) -> list[tuple[int, int]]:
    """The longest common sequence, as rows of both."""
    best = [[0] * (len(theirs) + 1) for _ in range(len(ours) + 1)]
    for i in reversed(range(len(ours))):
        for j in reversed(range(len(theirs))):
            longer = max(best[i + 1][j], best[i][j + 1])
            best[i][j] = best[i + 1][j + 1] + 1 if same(ours[i], theirs[j]) else longer
    return _walked(best, ours, theirs)


def _walked(best: list[list[int]], ours: Sequence[Piece], theirs: Sequence[Piece]) -> list[tuple[int, int]]:
    i = j = 0
    found = []
    while i < len(ours) and j < len(theirs):
        if best[i][j] == best[i + 1][j]:
            i += 1
        elif best[i][j] == best[i][j + 1]:
            j += 1
        else:
            found.append((i, j))
            i, j = i + 1, j + 1
    return found
