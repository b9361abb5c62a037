"""Blend moves: the quarter circles on which the cutter approaches the path and leaves it.

With E the path's end point, t its direction there and n the normal away from the material, a blend arc of radius B has
its center at E + B n; it comes from E + B n - B t (the plunge point), or leaves to E + B n + B t.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import Final

import numpy as np

from core.geometry.path import EMPTY, Floats, Path, joined
from core.geometry.piece import Line, Piece, Point, Side, point_of
from core.tolerance import CLOSED, JOINED

_AT_ITS_START: Final = 2.0 * CLOSED
"""Millimeters: largest gap between the ends of a closed contour's path; a gap in the contour also turns a segment."""


def blend_in(path: Path, side: Side, blend: float) -> Path:
    """Return the arc of radius `blend` mm (0 = none) tangent to the path at its start, with the path's first number."""
    if not len(path) or blend <= 0.0:
        return EMPTY
    first = path[0]
    along = complex(*first.direction_at(first.start))
    start, center = _quarter(first.start, -along, along, side, blend)
    return _arc(start, first.start, center, side, path.numbers[:1])


def blend_out(path: Path, side: Side, blend: float, overlap: float, *, closed: bool) -> Path:
    """Return the moves after the path: the overlap, then the arc of radius `blend` millimeters, with the last number.

    If a closed contour's path ends where it starts, it runs `overlap` millimeters past the start before it leaves:
    it repeats its own first pieces, under their own numbers.
    """
    again = past_start(path, overlap) if closed else EMPTY
    whole = again if len(again) else path
    if not len(whole) or blend <= 0.0:
        return again
    last = whole[-1]
    along = complex(*last.direction_at(last.end))
    end, center = _quarter(last.end, along, along, side, blend)
    return joined((again, _arc(last.end, end, center, side, whole.numbers[-1:])))


def _arc(start: Point, end: Point, center: Point, side: Side, number: Floats) -> Path:
    turn = np.array((side.sign,), np.int8)
    return Path(np.array((start, end)), np.array((center,)), turn, number)


def past_start(path: Path, overlap: float) -> Path:
    """Return the path's first `overlap` millimeters, at most one lap, if it ends where it starts; else nothing.

    A contour counts as closed even with a small gap between its ends, and so does its path; the overlap then begins
    with a straight move to the path's start.
    """
    gap = abs(complex(*(path.points[-1] - path.points[0]).tolist())) if len(path) else inf
    if overlap <= JOINED or gap > _AT_ITS_START:
        return EMPTY
    pieces, left = [], overlap
    for piece in path:
        if left <= JOINED:
            break
        pieces.append(
            piece if piece.length <= left + JOINED else replace(piece, end=piece.point_at(left / piece.length))
        )
        left -= piece.length
    numbers = path.numbers[: len(pieces)].tolist()
    if gap > JOINED:
        return Path.from_pieces([Line(path[-1].end, path[0].start), *pieces], [numbers[0], *numbers])
    return Path.from_pieces([_from(path[-1].end, pieces[0]), *pieces[1:]], numbers)


def _from(start: Point, piece: Piece) -> Piece:
    """Return the same piece from a start that is the same point within rounding; full circles stay full."""
    return replace(piece, start=start, end=start if piece.end == piece.start else piece.end)


def _quarter(at: Point, outer: complex, along: complex, side: Side, blend: float) -> tuple[Point, Point]:
    """Return the far end, toward `outer` from the center, and the center of the quarter circle at a path's end."""
    center = complex(*at) + blend * side.sign * 1j * along
    return point_of(center + blend * outer), point_of(center)
