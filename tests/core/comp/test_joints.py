"""Both forms of joining offset elements agree: arrays of a whole contour, and element by element in the controls."""

from __future__ import annotations

from cmath import rect
from itertools import product
from math import pi
from random import Random

import numpy as np
import pytest

from core.comp.compensate import compensate
from core.comp.crossings import crossings
from core.comp.offset import RawPart, offset
from core.controls.compensation.corner_rules import CornerKind, CornerRules, join
from core.controls.compensation.elements import Element, arc_element, line_element, meetings, offset_end, offset_start
from core.geometry.distance import distance
from core.geometry.path import Path, as_complex
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.geometry.piece_arrays import piece_arrays
from core.tolerance import JOINED

RULES = CornerRules(touching=JOINED)
"""What the control of this program does: an arc outside, the meeting inside, tangent as `comp` has it."""

NEAR = 1e-7
"""Millimeters by which the points may differ: what rounding makes of a meeting of two nearly tangent circles."""

KINDS = {RawPart.CORNER: CornerKind.OUTSIDE, RawPart.BRIDGE: CornerKind.INSIDE}


def _point(place: complex) -> Point:
    return place.real, place.imag


def _piece(random: Random, start: complex, way: complex, turn: int) -> tuple[Piece, complex, complex]:
    """A piece that leaves `start` in the direction `way`, its end and its direction there."""
    if not turn:
        end = start + way * random.uniform(0.5, 3.0)
        return Line(_point(start), _point(end)), end, way
    center, turned = start + 1j * turn * way * random.uniform(0.1, 3.0), rect(1.0, turn * random.uniform(0.3, 5.0))
    end = center + (start - center) * turned
    return Arc(_point(start), _point(end), _point(center), Turn(turn)), end, way * turned


def _corners(turns: tuple[int, int], bend: str) -> list[tuple[Piece, Piece, Side, float]]:
    random, found = Random(f"{turns} {bend}"), []
    for _ in range(60):
        place = complex(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0))
        first, at, way = _piece(random, place, rect(1.0, random.uniform(-pi, pi)), turns[0])
        angle = {"any": random.uniform(-3.1, 3.1), "sharp": random.choice((-2.6, 2.6)), "tangent": 0.0}[bend]
        second, _, _ = _piece(random, at, way * rect(1.0, angle), turns[1])
        found.append((first, second, random.choice(list(Side)), random.uniform(0.05, 1.5)))
    return found


def _element(piece: Piece) -> Element:
    if isinstance(piece, Line):
        return line_element(piece.start, piece.end, 0.0, 0.0, False, 100.0, 1)
    return arc_element(piece.start, piece.end, piece.center, piece.turn, 0.0, 0.0, 100.0, 1)


def _near(one: complex, other: Point) -> bool:
    return abs(one - complex(*other)) <= NEAR


@pytest.mark.parametrize("bend", ["any", "sharp", "tangent"])
@pytest.mark.parametrize("turns", list(product((0, 1, -1), repeat=2)), ids=str)
def test_arrays_and_elements_see_the_same_corner(turns: tuple[int, int], bend: str) -> None:
    for first, second, side, radius in _corners(turns, bend):
        one, two = _element(first), _element(second)
        chain = offset(Path.from_pieces([first, second]), side, radius)
        parts = [RawPart(part) for part in chain.parts.tolist()]
        joint = join(one, two, side.sign * radius, RULES)
        assert joint.corner is (KINDS[parts[1]] if len(parts) == 3 else CornerKind.TANGENT)
        points = as_complex(chain.raw.points)
        assert _near(points[1], offset_end(one, side.sign * radius))
        assert _near(points[-2], offset_start(two, side.sign * radius))
        if joint.corner is CornerKind.OUTSIDE:
            assert _near(as_complex(chain.raw.centers)[1], joint.center or (0.0, 0.0))


@pytest.mark.parametrize("bend", ["any", "sharp"])
@pytest.mark.parametrize("turns", list(product((0, 1, -1), repeat=2)), ids=str)
def test_arrays_and_elements_meet_in_the_same_points(turns: tuple[int, int], bend: str) -> None:
    met = 0
    for first, second, side, radius in _corners(turns, bend):
        one, two = _element(first), _element(second)
        contour = Path.from_pieces([first, second])
        chain = offset(contour, side, radius)
        joint = join(one, two, side.sign * radius, RULES)
        if joint.corner is not CornerKind.INSIDE or RawPart.VANISHED in chain.parts.tolist():
            continue
        found = crossings(chain, 1, closed=False).joints.points.tolist()
        pieces = piece_arrays(chain.raw.part(0, 1), chain.raw.part(2, 3))
        everywhere = [complex(*at) for at in meetings(one, two, side.sign * radius, side.sign * radius)]
        on_both = [at for at in everywhere if distance(pieces, np.full(2, at)).max() <= NEAR / 10]
        assert all(any(abs(at - other) <= NEAR for other in found) for at in on_both)
        assert all(any(abs(at - other) <= NEAR for other in everywhere) for at in found)
        met += len(found) == 1
        if len(found) == len(everywhere) == 1:
            path = compensate(contour, side, radius, 1, closed=False).path
            assert _near(as_complex(path.points)[1], joint.start)
    assert met
