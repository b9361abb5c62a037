"""This module leaves out of a path the whole passes that repeat, piece by piece, the pass just before them.

What a path does to a surface, and what of the surface a path meets, depends on the places it covers, not on how often:
each piece left out coincides with a piece that is kept.  Forty depths of one ring are judged as one.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.geometry.path import Path, Rows
from core.tolerance import GOUGE, ON_PATH

SWEEP_DECIMALS: Final = 3
"""Decimals of a radian to which sweeps are compared: between equal ends an arc is a full circle or empty."""

MIN_SHARE: Final = 4
"""A period is tried if at least one in this number of its pieces was last seen one period before."""


PathKey = tuple[bytes, ...]


def path_key(path: Path) -> PathKey:
    """Return a key that is the same for paths that are the same to GOUGE, whatever their lines."""
    grids = (np.round(points / GOUGE) + 0.0 for points in (path.points, path.centers))
    return (*(grid.tobytes() for grid in grids), path.turns.tobytes())


def without_repeats(path: Path) -> Path:
    """Return the path without repeated passes: the first one stays with its numbers, in the path's order.

    A pass is any number of pieces that the path repeats as a whole, with the same ends, centers and turns to ON_PATH,
    because the sums of incremental programs differ in the last digit.  One that differs in a single piece stays.  The
    path itself is returned if nothing is repeated, or if it has coordinates that no machine could have.
    """
    if len(path) < 2 or not path.reachable:
        return path
    names, rows = _piece_names(path), np.arange(len(path))
    before = len(rows) + 1
    while len(rows) < before:
        before = len(rows)
        for period in _periods(names[rows]):
            rows = _cut(path, names, rows, period)
    if len(rows) == len(path):
        return path
    # a piece starts where the one before it ends, which may move the start by rounding
    points = np.concatenate((path.points[:1], path.ends[rows]))
    return Path.of(points, path.centers[rows], path.turns[rows], path.numbers[rows])


def _piece_names(path: Path) -> Rows:
    """Return (n,) the same number for pieces that are one piece to ON_PATH."""
    grids = [np.round(points / ON_PATH) for points in (path.starts, path.ends, path.centers)]
    columns = np.column_stack((*grids, path.turns, np.round(path.sweeps, SWEEP_DECIMALS)))
    return np.unique(columns, axis=0, return_inverse=True)[1].reshape(-1)


def _periods(names: Rows) -> list[int]:
    """Return, ascending, how many pieces ago equal pieces were last seen, if that can be a pass's length."""
    order = np.argsort(names, kind="stable")
    same = names[order[1:]] == names[order[:-1]]
    distances, counts = np.unique((order[1:] - order[:-1])[same], return_counts=True)
    periods: list[int] = distances[MIN_SHARE * counts >= distances].tolist()
    return periods


def _cut(path: Path, names: Rows, rows: Rows, period: int) -> Rows:
    """Return the rows without whole passes of `period` pieces that are the same as the pieces one pass before them.

    A run of at least `period` pieces that each equal the piece a period before is closed: it ends with the piece before
    it, and so where it begins.  The rest of a last pass that is not whole stays.
    """
    named, repeats = names[rows], np.zeros(len(rows) + 2, np.bool_)
    repeats[period + 1 : -1] = named[period:] == named[:-period]
    edges = np.flatnonzero(repeats[1:] != repeats[:-1])
    first, repeated_rows = edges[::2], (edges[1::2] - edges[::2]) // period * period
    keep = np.ones(len(rows), np.bool_)
    for begin, count in zip(first[repeated_rows > 0].tolist(), repeated_rows[repeated_rows > 0].tolist(), strict=True):
        if _joins(path, rows, begin, begin + count):
            keep[begin : begin + count] = False
    return rows[keep]


def _joins(path: Path, rows: Rows, begin: int, after: int) -> bool:
    """True if piece `after` starts where the one before `begin` ends; it is not moved if that could bend it.

    An arc is a full circle only if its two points are the same to the last digit.
    """
    if after == len(rows):
        return bool(np.abs(path.points[-1] - path.ends[rows[begin - 1]]).max() <= 2.0 * ON_PATH)
    start, end = path.points[rows[after]], path.ends[rows[after]]
    moved = np.abs(start - path.ends[rows[begin - 1]]).max()
    return bool(moved == 0.0 or (moved <= 2.0 * ON_PATH and np.abs(end - start).max() > GOUGE))
