"""Stretch: the part of a contour between two of its points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Point

Ends = tuple[float, Point, float, Point]
"""A stretch's first segment and the point on it, its last segment and the point on that."""


class Parts(NamedTuple):
    """Parts of a path one behind the other, as one path: its pieces where `own` (n,) is True; the others join them.

    A hundred little paths take longer to make than all that is done with them.
    """

    path: Path
    own: NDArray[np.bool_]

    @property
    def paths(self) -> list[Path]:
        """Each part by itself."""
        edges = np.flatnonzero(np.diff(self.own, prepend=False, append=False)).reshape(-1, 2)
        return [self.path.part(first, last) for first, last in edges.tolist()]


NO_PARTS: Final = Parts(EMPTY, np.empty(0, np.bool_))


def stretches(surface: Path, wanted: Sequence[Ends]) -> Parts:
    """The parts of a surface from a point on one segment to a point on another, without those of unknown segments.

    One runs past a closed contour's start if its last segment lies before its first.
    """
    whole, spans = _cut_out(surface, wanted)
    own = np.ones(len(whole), np.bool_)
    own[[tail for _, tail in spans[:-1]]] = False
    return Parts(whole, own)


def pieces_joined(path: Path, rows: NDArray[np.intp]) -> Parts:
    """Single pieces of a path, by their rows, each a part of its own."""
    if not len(rows):
        return NO_PARTS
    points = np.stack((path.points.take(rows, axis=0), path.points.take(rows + 1, axis=0)), axis=1).reshape(-1, 2)
    centres, turns, own = points[:-1].copy(), np.zeros(len(points) - 1, np.int8), np.zeros(len(points) - 1, np.bool_)
    centres[::2], turns[::2], own[::2] = path.centres.take(rows, axis=0), path.turns[rows], True
    return Parts(Path(points, centres, turns, np.repeat(path.numbers[rows], 2)[:-1]), own)


def stretch_lengths(surface: Path, wanted: Sequence[Ends]) -> list[list[tuple[float, float]]]:
    """Of the same stretches, each by itself, the pieces' segments and lengths."""
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
    # rows of points, one more than of pieces: behind the last piece of each stretch its end
    counts = np.array([_steps(surface, *one) for one in known]) + 2
    behind = np.cumsum(counts)
    heads, tails = behind - counts, behind - 1
    rows = (np.arange(behind[-1]) + np.repeat(np.array([one[0] for one in known]) - heads, counts)) % count
    # rows of pairs: an array's own `take` takes a fifth of the time of an index
    points, centres, turns = surface.points.take(rows, axis=0), surface.centres.take(rows, axis=0), surface.turns[rows]
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
