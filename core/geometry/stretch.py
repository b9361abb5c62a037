"""Stretch: the part of a contour between two of its points."""

from __future__ import annotations

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point


def stretch(surface: Path, first: float, start: Point, last: float, end: Point) -> Path:
    """The part of a surface from the point `start` on segment `first` to the point `end` on segment `last`.

    Empty if there are no such segments; it runs past a closed contour's start if `last` lies before `first`.
    """
    found = stretch_pieces(surface, first, start, last, end)
    return Path.from_pieces([piece for _, piece in found], [number for number, _ in found])


def stretch_pieces(surface: Path, first: float, start: Point, last: float, end: Point) -> list[tuple[float, Piece]]:
    """`stretch` as pieces, each with the number of its segment."""
    begins, ends = (surface.numbers == first).nonzero()[0], (surface.numbers == last).nonzero()[0]
    if not len(begins) or not len(ends):
        return []
    row, count = int(begins[0]), len(surface)
    backwards = ends[-1] < row or (ends[-1] == row and _before(surface[row], end, start))
    steps = (int(ends[-1]) - row) % count + (count if backwards and ends[-1] == row else 0)
    pieces = [surface[(row + step) % count] for step in range(steps + 1)]
    pieces[0] = _cut(pieces[0], start, pieces[0].end)
    pieces[-1] = _cut(pieces[-1], pieces[-1].start, end)
    numbers = [float(surface.numbers[(row + step) % count]) for step in range(steps + 1)]
    return list(zip(numbers, pieces, strict=True))


def _cut(piece: Piece, start: Point, end: Point) -> Piece:
    if isinstance(piece, Line):
        return Line(start, end)
    return Arc(start, end, piece.centre, piece.turn)


def _before(piece: Piece, point: Point, other: Point) -> bool:
    """Is `point` passed before `other` on this piece?"""
    to_point, to_other = _cut(piece, piece.start, point), _cut(piece, piece.start, other)
    return to_point.length < to_other.length
