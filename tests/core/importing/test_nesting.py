"""Nesting: the boxes of several chains at once, and which chain lies in which."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import pytest

from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.importing.nesting import box_of, containers

STEPS = 3600


def points_on(piece: Piece) -> list[Point]:
    """Points along a piece, a tenth of a degree apart on an arc."""
    if isinstance(piece, Line):
        return [piece.start, piece.end]
    (x, y), (cx, cy) = piece.start, piece.center
    first = math.atan2(y - cy, x - cx)
    angles = [first + piece.sweep * step / STEPS for step in range(STEPS + 1)]
    return [(cx + piece.radius * math.cos(angle), cy + piece.radius * math.sin(angle)) for angle in angles]


def test_the_box_of_pieces_holds_all_of_them() -> None:
    corners = [(100.0, 50.0), (110.0, 50.0), (110.0, 58.0), (100.0, 50.0)]
    far_triangle: list[Piece] = [Line(start, end) for start, end in pairwise(corners)]
    full_circle: list[Piece] = [Arc((5.0, 0.0), (5.0, 0.0), (0.0, 0.0), Turn.CCW)]
    half_circle: list[Piece] = [
        Arc((-20.0, 3.0), (-30.0, 3.0), (-25.0, 3.0), Turn.CW),
        Line((-30.0, 3.0), (-20.0, 3.0)),
    ]
    for chain in (far_triangle, full_circle, half_circle, [*half_circle, *far_triangle]):
        xs, ys = zip(*(point for piece in chain for point in points_on(piece)), strict=True)
        assert box_of(chain) == pytest.approx((min(xs), min(ys), max(xs), max(ys)), abs=1e-5)


@pytest.mark.parametrize("degrees", range(0, 360, 15))
def test_a_contour_on_the_edge_of_a_larger_one_lies_outside_it(degrees: int) -> None:
    """The smaller one begins with the edge at which they touch."""
    turned = cmath.rect(1.0, math.radians(degrees))
    corners = [[-2.5, 13.0, 13.0 + 10.0j, -2.5 + 10.0j], [0.0, 10.0, 10.0 - 5.0j, -5.0j]]
    chains: list[list[Piece]] = []
    for points in corners:
        places = [(point.real, point.imag) for point in (corner * turned for corner in points)]
        chains.append([Line(start, end) for start, end in pairwise([*places, places[0]])])
    assert containers(chains) == [[], []]
