"""Path parts: parts of a contour, each between two of its points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Floats, Path, Points, Rows, as_complex, coordinates
from core.geometry.piece import Line, Piece, point_of


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
    if not len(surface):
        return NO_PARTS
    begins, lasts, wanted = _rows(surface, wanted)
    if not len(begins):
        return NO_PARTS
    # rows of points, one more than of pieces: the end follows the last piece of each stretch
    counts = _steps(surface, begins, lasts, wanted) + 2
    bounds = counts.cumsum()
    heads, tails = bounds - counts, bounds - 1
    rows = (np.arange(bounds[-1]) + (begins - heads).repeat(counts)) % len(surface)
    points, centers, turns = as_complex(surface.points)[rows], as_complex(surface.centers)[rows], surface.turns[rows]
    points[heads], points[tails], turns[tails] = wanted.start, wanted.end, 0
    # a line has its own start for a center
    lines = (turns == 0).nonzero()[0]
    centers[lines] = points[lines]
    in_part = np.ones(len(turns) - 1, np.bool_)
    in_part[tails[:-1]] = False
    numbers = surface.numbers[rows[:-1]]
    return PathParts(Path(coordinates(points), coordinates(centers[:-1]), turns[:-1], numbers), in_part)


def parts_of(chains: Iterable[Sequence[Piece]]) -> PathParts:
    """Return chains of pieces, each joined, as parts of one path."""
    pieces: list[Piece] = []
    in_part: list[bool] = []
    for chain in chains:
        if pieces:
            pieces.append(Line(pieces[-1].end, chain[0].start))
            in_part.append(False)
        pieces += chain
        in_part += [True] * len(chain)
    return PathParts(Path.from_pieces(pieces), np.array(in_part, np.bool_))


def single_pieces(path: Path, rows: NDArray[np.intp]) -> PathParts:
    """Return the pieces of a path in `rows`, each as a part of its own."""
    if not len(rows):
        return NO_PARTS
    path_points, points = as_complex(path.points), np.empty(2 * len(rows), np.complex128)
    points[::2], points[1::2] = path_points[rows], path_points[rows + 1]
    centers, turns = points[:-1].copy(), np.zeros(len(points) - 1, np.int8)
    in_part = np.zeros(len(points) - 1, np.bool_)
    centers[::2], turns[::2], in_part[::2] = as_complex(path.centers)[rows], path.turns[rows], True
    return PathParts(Path(coordinates(points), coordinates(centers), turns, path.numbers[rows].repeat(2)[:-1]), in_part)


def _rows(surface: Path, wanted: PartEnds) -> tuple[Rows, Rows, PartEnds]:
    """Return the first row of each first segment, the last row of each last one, and the ends; known segments only."""
    numbers = surface.numbers
    order = numbers.argsort(kind="stable")
    ranked = numbers[order]
    begins = order.take(ranked.searchsorted(wanted.first), mode="clip")
    lasts = order.take(ranked.searchsorted(wanted.last, "right") - 1, mode="clip")
    known = (numbers[begins] == wanted.first) & (numbers[lasts] == wanted.last)
    if known.all():
        return begins, lasts, wanted
    return begins[known], lasts[known], PartEnds(*(column[known] for column in wanted))


def _steps(surface: Path, begins: Rows, lasts: Rows, wanted: PartEnds) -> Rows:
    """Return the number of rows from each start to its end; a full lap if the end is before the start on one row."""
    steps: Rows = (lasts - begins) % len(surface)
    for row in (begins == lasts).nonzero()[0].tolist():
        piece, start, end = surface[int(begins[row])], point_of(wanted.start[row]), point_of(wanted.end[row])
        # no stretch ends before a piece's start: an arc from start to start would count as a full turn
        if start != piece.start and replace(piece, end=end).length < replace(piece, end=start).length:
            steps[row] += len(surface)
    return steps
