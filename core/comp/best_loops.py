"""Loops: stitched slices as paths of whole pieces."""

from __future__ import annotations

import numpy as np

from core.comp.best_raw import Raw
from core.comp.best_slices import Slices
from core.geometry.intersect import Indices, coordinates
from core.geometry.path import Floats, Path


def loop_of(raw: Raw, cut: Slices, rows: Indices, origin: Floats) -> Path:
    """The path along slices `rows` in this order, moved by `origin`; slices of one piece are one piece again."""
    piece, first, last = cut.piece[rows], cut.first[rows], cut.last[rows]
    fresh = np.ones(len(rows), np.bool_)
    fresh[1:] = (piece[1:] != piece[:-1]) | (first[1:] != last[:-1])
    piece = piece[fresh]
    points = cut.points[np.append(first[fresh], last[-1])]
    turns = raw.turns[piece]
    centres = np.where(turns == 0, points[:-1], raw.centre[piece])
    numbers = raw.path.numbers[raw.rows[piece]]
    return Path.of(coordinates(points) + origin, coordinates(centres) + origin, turns, numbers)
