"""Contours and center paths for the judge's tests, built by hand and by Hypothesis."""

from __future__ import annotations

from itertools import pairwise
from math import cos, sin

import numpy as np
from hypothesis import strategies as st

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Turn


def lines(*points: Point) -> Path:
    """The path of lines through points."""
    return Path.from_pieces([Line(a, b) for a, b in pairwise(points)])


def square(size: float = 2.0, *, x: float = 0.0, y: float = 0.0) -> Path:
    """A square traveled counter-clockwise from its lower left corner."""
    return lines((x, y), (x + size, y), (x + size, y + size), (x, y + size), (x, y))


def circle(center: Point, radius: float, turn: Turn = Turn.CCW) -> Path:
    """A full circle from its rightmost point."""
    start = (center[0] + radius, center[1])
    return Path.from_pieces([Arc(start, start, center, turn)])


def around(corners: list[Point], radius: float) -> Path:
    """The path of a cutter outside a convex outline traveled counter-clockwise: lines, and arcs about its corners."""
    pieces: list[Piece] = []
    for before, corner, after in zip(corners[-2:-1] + corners[:-2], corners[:-1], corners[1:], strict=True):
        first, second = _beside(before, corner, radius)[1], _beside(corner, after, radius)[0]
        pieces.append(Arc(first, second, corner, Turn.CCW))
        pieces.append(Line(second, _beside(corner, after, radius)[1]))
    return Path.from_pieces(pieces)


def _beside(a: Point, b: Point, offset: float) -> tuple[Point, Point]:
    """Both ends of the line a b moved to its right."""
    way = np.array(b) - np.array(a)
    off = np.array((way[1], -way[0])) / np.hypot(*way) * offset
    return tuple((np.array(a) + off).tolist()), tuple((np.array(b) + off).tolist())


def moved(path: Path, angle: float, shift: Point, scale: float = 1.0) -> Path:
    """The path turned by `angle` radians about the origin, scaled, then shifted."""
    turn = scale * np.array(((cos(angle), sin(angle)), (-sin(angle), cos(angle))))
    return Path.of(path.points @ turn + shift, path.centers @ turn + shift, path.turns, path.numbers)


def mirrored(path: Path) -> Path:
    """The path with x negated: arcs turn the other way, left becomes right."""
    flip = np.array((-1.0, 1.0))
    return Path.of(path.points * flip, path.centers * flip, -path.turns, path.numbers)


COORDINATES = st.one_of(st.integers(-5, 5).map(float), st.floats(-5.0, 5.0).map(lambda value: round(value, 3)))
POINTS = st.tuples(COORDINATES, COORDINATES)


@st.composite
def paths(draw: st.DrawFn, most: int = 5) -> Path:
    """Any chain of lines, arcs and full circles, most of them crossing themselves; no piece is without length."""
    points = draw(st.lists(POINTS, min_size=2, max_size=most + 1))
    points = [points[0], *(b for a, b in pairwise(points) if a != b)]
    if len(points) == 1:
        return circle(points[0], 1.0, draw(st.sampled_from((Turn.CW, Turn.CCW))))
    return Path.from_pieces([_piece(draw, a, b) for a, b in pairwise(points)])


def _piece(draw: st.DrawFn, start: Point, end: Point) -> Piece:
    turn = draw(st.sampled_from((Turn.NONE, Turn.CW, Turn.CCW)))
    if turn is Turn.NONE:
        return Line(start, end)
    rise = draw(st.sampled_from((0.0, 0.5, -0.5, 1.25, -1.25, 0.123)))
    (x0, y0), (x1, y1) = start, end
    return Arc(start, end, ((x0 + x1) / 2 - rise * (y1 - y0), (y0 + y1) / 2 + rise * (x1 - x0)), turn)
