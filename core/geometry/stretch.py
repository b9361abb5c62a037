"""Stretch: the part of a contour between two of its points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Point

Ends = tuple[float, Point, float, Point]
"""A stretch's first segment and the point on it, its last segment and the point on that."""


def stretch(surface: Path, first: float, start: Point, last: float, end: Point) -> Path:
    """The part of a surface from the point `start` on segment `first` to the point `end` on segment `last`.

    Empty if there are no such segments; it runs past a closed contour's start if `last` lies before `first`.
    """
    return next(iter(stretches(surface, [(first, start, last, end)])), EMPTY)


def stretches(surface: Path, wanted: Sequence[Ends]) -> list[Path]:
    """Many of them, without those that are empty: cut out of the surface's arrays at once."""
    whole, spans = _cut_out(surface, wanted)
    return [
        Path(whole.points[head : tail + 1], whole.centres[head:tail], whole.turns[head:tail], whole.numbers[head:tail])
        for head, tail in spans
    ]


def stretch_lengths(surface: Path, wanted: Sequence[Ends]) -> list[list[tuple[float, float]]]:
    """Of the same stretches the pieces' segments and lengths."""
    whole, spans = _cut_out(surface, wanted)
    each = list(zip(whole.numbers.tolist(), whole.lengths.tolist(), strict=True))
    return [each[head:tail] for head, tail in spans]


def _cut_out(surface: Path, wanted: Sequence[Ends]) -> tuple[Path, list[tuple[int, int]]]:
    """The stretches one behind the other with a line between them, and the first row and one behind the last of each.

    Those of unknown segments are left out.
    """
    numbers, count = surface.numbers.tolist(), len(surface)
    begins = dict(zip(reversed(numbers), reversed(range(count)), strict=True))
    ends = dict(zip(numbers, range(count), strict=True))
    known = [
        (begins[first], start, ends[last], end)
        for first, start, last, end in wanted
        if first in begins and last in ends
    ]
    if not known:
        return EMPTY, []
    steps = [_steps(surface, *one) for one in known]
    behind = np.cumsum(np.array(steps) + 2)
    # rows of points, one more than of pieces: behind the last piece of each stretch its end
    runs = [np.arange(one[0], one[0] + more + 2) for one, more in zip(known, steps, strict=True)]
    rows = np.concatenate(runs) % count
    heads, tails = np.array([0, *behind[:-1].tolist()]), behind - 1
    points, centres, turns = surface.points[rows], surface.centres[rows], surface.turns[rows]
    points[heads], points[tails] = [one[1] for one in known], [one[3] for one in known]
    turns[tails] = 0
    # a line has its own start for a centre
    lines = np.concatenate((heads[turns[heads] == 0], tails))
    centres[lines] = points[lines]
    whole = Path(points, centres[:-1], turns[:-1], surface.numbers[rows[:-1]])
    return whole, list(zip(heads.tolist(), tails.tolist(), strict=True))


def _steps(surface: Path, row: int, start: Point, last: int, end: Point) -> int:
    """Rows from a point on one row to a point on another, or all round to the same one."""
    # from its start back to its start an arc is a full turn: what begins there ends behind that on any piece
    around = last == row and start != surface[row].start and _before(surface[row], end, start)
    return (last - row) % len(surface) + len(surface) * around


def _cut(piece: Piece, start: Point, end: Point) -> Piece:
    if isinstance(piece, Line):
        return Line(start, end)
    return Arc(start, end, piece.centre, piece.turn)


def _before(piece: Piece, point: Point, other: Point) -> bool:
    """Is `point` passed before `other` on this piece?"""
    to_point, to_other = _cut(piece, piece.start, point), _cut(piece, piece.start, other)
    return to_point.length < to_other.length
