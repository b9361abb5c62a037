"""Loops: stitched slices as paths of whole pieces."""

from __future__ import annotations

import numpy as np

from core.comp.best_path.raw_offset import Raw
from core.comp.best_path.slices import Slices
from core.geometry.path import Floats, Path, Rows, coordinates


def loop_of(raw: Raw, cut: Slices, rows: Rows, origin: Floats) -> Path:
    """The path along slices `rows` in this order, moved by `origin`; slices of one piece are one piece again."""
    first, until = cut.piece[rows], cut.until[rows]
    counts = until - first + 1
    begins = np.cumsum(counts) - counts
    piece = np.arange(int(counts.sum())) + np.repeat(first - begins, counts)
    points = np.append(raw.start[piece], cut.points[cut.last[rows[-1]]])
    points[begins] = cut.points[cut.first[rows]]
    again = (first[1:] == until[:-1]) & (cut.first[rows[1:]] == cut.last[rows[:-1]])
    if again.any():
        fresh = np.ones(len(points), np.bool_)
        fresh[begins[1:][again]] = False
        piece, points = piece[fresh[:-1]], points[fresh]
    turns = raw.turns[piece]
    centers = np.where(turns == 0, points[:-1], raw.center[piece])
    return Path.of(coordinates(points) + origin, coordinates(centers) + origin, turns, raw.numbers[piece])
