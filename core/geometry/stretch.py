"""Stretch: the part of a contour between two of its points."""

from __future__ import annotations

from collections.abc import Sequence

from core.geometry.path import EMPTY, Path, joined
from core.geometry.piece import Arc, Line, Piece, Point

Ends = tuple[float, Point, float, Point]
"""A stretch's first segment and the point on it, its last segment and the point on that."""


def stretch(surface: Path, first: float, start: Point, last: float, end: Point) -> Path:
    """The part of a surface from the point `start` on segment `first` to the point `end` on segment `last`.

    Empty if there are no such segments; it runs past a closed contour's start if `last` lies before `first`.
    """
    place = _place(surface, first, last)
    return EMPTY if place is None else _between(surface, place[0], start, place[1], end)


def stretches(surface: Path, wanted: Sequence[Ends]) -> list[Path]:
    """Many of them, the rows of all segments looked up at once."""
    if not wanted:
        return []
    numbers = surface.numbers.tolist()
    rows = range(len(numbers))
    begins, ends = dict(zip(reversed(numbers), reversed(rows), strict=True)), dict(zip(numbers, rows, strict=True))
    return [
        _between(surface, begins[first], start, ends[last], end) if first in begins and last in ends else EMPTY
        for first, start, last, end in wanted
    ]


def stretch_pieces(surface: Path, first: float, start: Point, last: float, end: Point) -> list[tuple[float, Piece]]:
    """`stretch` as pieces, each with the number of its segment."""
    place = _place(surface, first, last)
    if place is None:
        return []
    (row, there), count = place, len(surface)
    around = there == row and _before(surface[row], end, start)
    rows = [one % count for one in range(row, row + (there - row) % count + count * around + 1)]
    pieces = [surface[one] for one in rows]
    pieces[0] = _cut(pieces[0], start, pieces[0].end)
    pieces[-1] = _cut(pieces[-1], pieces[-1].start, end)
    numbers = surface.numbers[rows].tolist()
    return list(zip(numbers, pieces, strict=True))


def _place(surface: Path, first: float, last: float) -> tuple[int, int] | None:
    """The first row of one segment and the last of another; None where there are no such segments."""
    begins, ends = (surface.numbers == first).nonzero()[0], (surface.numbers == last).nonzero()[0]
    return (int(begins[0]), int(ends[-1])) if len(begins) and len(ends) else None


def _between(surface: Path, row: int, start: Point, last: int, end: Point) -> Path:
    """From a point on one row to a point on another, or all round to the same one."""
    if last > row or (last == row and not _before(surface[row], end, start)):
        part = surface.part(row, last + 1)
    else:
        part = joined((surface.part(row, len(surface)), surface.part(0, last + 1)))
    points, centres = part.points.copy(), part.centres
    points[0], points[-1] = start, end
    if not part.turns[0]:
        # a line has its own start for a centre
        centres = centres.copy()
        centres[0] = start
    return Path(points, centres, part.turns, part.numbers)


def _cut(piece: Piece, start: Point, end: Point) -> Piece:
    if isinstance(piece, Line):
        return Line(start, end)
    return Arc(start, end, piece.centre, piece.turn)


def _before(piece: Piece, point: Point, other: Point) -> bool:
    """Is `point` passed before `other` on this piece?"""
    to_point, to_other = _cut(piece, piece.start, point), _cut(piece, piece.start, other)
    return to_point.length < to_other.length
