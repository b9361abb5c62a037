"""Course: a surface or a center path as the judge measures it, worked out once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.geometry.path import Floats, Path, Rows
from core.geometry.piece_arrays import PieceArrays, boxes, piece_arrays
from core.verify.columns import columns as columns_of

FEW: Final = 2_000
"""Pieces of all paths that are worked out in one go."""


@dataclass(frozen=True, eq=False, slots=True)
class Course:
    """n pieces, (n + 1,) lengths traveled at their starts and at the end, (4, n) boxes and the pieces' `columns`.

    Many pieces have no columns until they are `whole`: of nearly all of them nothing is asked.
    """

    pieces: PieceArrays
    stations: Floats
    boxes: Floats
    columns: Floats | None

    def whole(self) -> Course:
        """The course with columns of all its pieces."""
        return self if self.columns is not None else replace(self, columns=columns_of(self.pieces))

    def columns_at(self, rows: Rows, count: int) -> Floats:
        """The first `count` columns of these pieces; without arcs among them there are few."""
        if self.columns is None:
            return columns_of(self.pieces.take(rows))[:count]
        return self.columns[:count].take(rows, axis=1)


def courses(*groups: Sequence[Path]) -> Iterator[Course]:
    """One course after the other for each group of paths, whose pieces count as those of one path.

    Few pieces are worked out in one go: the steps cost more than the pieces.
    """
    counts = [sum(map(len, group)) for group in groups]
    if sum(counts) > FEW:
        for group in groups:
            yield _course(piece_arrays(*group))
        return
    pieces = piece_arrays(*(path for group in groups for path in group))
    around, bends, whole = boxes(pieces), columns_of(pieces), len(pieces) == sum(counts)
    first = before = 0
    for count in counts:
        behind = before + count
        last = behind if whole else int(pieces.rows.searchsorted(behind))
        part, piece = slice(first, last), pieces.part(first, last)
        np.subtract(piece.rows, before, out=piece.rows)
        # of rows that do not lie together every `take` would copy all
        yield Course(piece, piece.stations, around[:, part].copy(), bends[:, part].copy())
        first, before = last, behind


def _course(pieces: PieceArrays) -> Course:
    return Course(pieces, pieces.stations, boxes(pieces), None)
