"""Stretch: the part of a contour between two of its points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Point


def stretch(surface: Path, first: float, start: Point, last: float, end: Point) -> Path:
    """The part of a surface from the point `start` on segment `first` to the point `end` on segment `last`.

    Empty if there are no such segments; it runs past a closed contour's start if `last` lies before `first`.
    """
    rows = _rows(surface, first, start, last, end)
    if not len(rows):
        return EMPTY
    points = np.concatenate((surface.points[rows[:1]], surface.points[rows + 1]))
    points[0], points[-1] = start, end
    centres, turns = surface.centres[rows], surface.turns[rows]
    if not turns[0]:
        centres[0] = start
    return Path.of(points, centres, turns, surface.numbers[rows])


def stretch_pieces(surface: Path, first: float, start: Point, last: float, end: Point) -> list[tuple[float, Piece]]:
    """`stretch` as pieces, each with the number of its segment."""
    part = stretch(surface, first, start, last, end)
    return list(zip(part.numbers.tolist(), part, strict=True))


def _rows(surface: Path, first: float, start: Point, last: float, end: Point) -> NDArray[np.intp]:
    """The rows of the segments, in the order in which the stretch runs over them."""
    begins, ends = (surface.numbers == first).nonzero()[0], (surface.numbers == last).nonzero()[0]
    if not len(begins) or not len(ends):
        return begins[:0]
    row, there, count = int(begins[0]), int(ends[-1]), len(surface)
    around = there == row and _before(surface[row], end, start)
    steps = (there - row) % count + (count if around else 0)
    rows: NDArray[np.intp] = np.arange(row, row + steps + 1) % count
    return rows


def _cut(piece: Piece, start: Point, end: Point) -> Piece:
    if isinstance(piece, Line):
        return Line(start, end)
    return Arc(start, end, piece.centre, piece.turn)


def _before(piece: Piece, point: Point, other: Point) -> bool:
    """Is `point` passed before `other` on this piece?"""
    to_point, to_other = _cut(piece, piece.start, point), _cut(piece, piece.start, other)
    return to_point.length < to_other.length
