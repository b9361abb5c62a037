"""Path parts: parts of a contour, each between two of its points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Floats, Path, Points
from core.geometry.piece import Line, Piece, Point, point_of


class PartEnds(NamedTuple):
    """Where k parts of a contour begin and end (k,): first segment and point on it, last segment and point on it.

    Points are complex numbers.
    """

    first: Floats
    start: Points
    last: Floats
    end: Points


class PathParts(NamedTuple):
    """Parts of a path, strung together as one path: `in_part` (n,) marks their pieces; the other pieces link the parts.

    One path, since a hundred little ones would take longer to make than to use.
    """

    path: Path
    in_part: NDArray[np.bool_]

    @property
    def paths(self) -> list[Path]:
        """Each part as a path of its own."""
        edges = np.flatnonzero(np.diff(self.in_part, prepend=False, append=False)).reshape(-1, 2)
        return [self.path.part(first, last) for first, last in edges.tolist()]


NO_PARTS: Final = PathParts(EMPTY, np.empty(0, np.bool_))


def parts_between(surface: Path, wanted: PartEnds) -> PathParts:
    """Return the parts of a surface between the `wanted` ends; those on unknown segments are left out.

    A part whose last segment lies before its first one runs past a closed contour's start.
    """
    numbers = surface.numbers.tolist()
    first_rows = {number: row for row, number in reversed(list(enumerate(numbers)))}
    last_rows = {number: row for row, number in enumerate(numbers)}
    chains, rows = list[list[Piece]](), list[int]()
    for first, start, last, end in zip(*(column.tolist() for column in wanted), strict=True):
        if first in first_rows and last in last_rows:
            ends = point_of(start), point_of(end)
            part = _rows_between(surface, first_rows[first], last_rows[last], *ends)
            chain = [surface[row] for row in part]
            chain[0] = replace(chain[0], start=ends[0])
            chain[-1] = replace(chain[-1], end=ends[1])
            chains.append(chain)
            rows += part
    return parts_of(chains, surface.numbers[rows])


def _rows_between(surface: Path, first: int, last: int, start: Point, end: Point) -> list[int]:
    """Return the rows from the first to the last one; all around if the end is before the start on one row."""
    steps, piece = (last - first) % len(surface), surface[first]
    # no part ends before a piece's start: an arc from start to start would count as a full turn
    if not steps and start != piece.start and replace(piece, end=end).length < replace(piece, end=start).length:
        steps = len(surface)
    return [row % len(surface) for row in range(first, first + steps + 1)]


def parts_of(chains: Iterable[Sequence[Piece]], numbers: Floats | None = None) -> PathParts:
    """Return chains of pieces, each joined, as parts of one path, with the numbers of all their pieces in order."""
    pieces: list[Piece] = []
    in_part: list[bool] = []
    for chain in chains:
        if pieces:
            pieces.append(Line(pieces[-1].end, chain[0].start))
            in_part.append(False)
        pieces += chain
        in_part += [True] * len(chain)
    path, marks = Path.from_pieces(pieces), np.array(in_part, np.bool_)
    if numbers is not None:
        path_numbers = np.zeros(len(marks))
        path_numbers[marks] = numbers
        path = Path(path.points, path.centers, path.turns, path_numbers)
    return PathParts(path, marks)


def single_pieces(path: Path, rows: NDArray[np.intp]) -> PathParts:
    """Return the pieces of a path in `rows`, each as a part of its own."""
    return parts_of(([path[row]] for row in rows.tolist()), path.numbers[rows])
