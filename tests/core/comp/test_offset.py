"""The raw chain: the offset of every segment, the pieces at the joints, the segments that vanish."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.offset import RawChain, RawPart, offset
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from tests.core.comp.contours import lines, mixed

SEGMENT, CORNER, BRIDGE, VANISHED = RawPart


def _chain(contour: Path, side: Side, radius: float) -> RawChain:
    chain = offset(contour, side, radius)
    assert len(chain) == len(chain.raw) == len(chain.half_steps)
    return chain


def test_outside_corner_gets_an_arc():
    chain = _chain(lines((0, 0), (1, 0), (1, -1)), Side.LEFT, 0.5)
    assert list(chain.raw) == [
        Line((0, 0.5), (1, 0.5)),
        Arc((1, 0.5), (1.5, 0), (1, 0), Turn.CW),
        Line((1.5, 0), (1.5, -1)),
    ]
    assert chain.parts.tolist() == [SEGMENT, CORNER, SEGMENT]
    assert chain.half_steps.tolist() == [0, 1, 2]
    assert chain.raw.numbers.tolist() == [1, 1.5, 2]


def test_inside_corner_gets_a_bridge():
    chain = _chain(lines((0, 0), (1, 0), (1, 1)), Side.LEFT, 0.5)
    assert list(chain.raw) == [Line((0, 0.5), (1, 0.5)), Line((1, 0.5), (0.5, 0)), Line((0.5, 0), (0.5, 1))]
    assert chain.parts.tolist() == [SEGMENT, BRIDGE, SEGMENT]


def test_tangent_joint_gets_nothing():
    contour = Path.from_pieces([Line((0, 0), (1, 0)), Arc((1, 0), (2, 1), (1, 1), Turn.CCW)])
    for side, radius in ((Side.LEFT, 0.75), (Side.RIGHT, 1.25)):
        chain = _chain(contour, side, 0.25)
        assert chain.parts.tolist() == [SEGMENT, SEGMENT]
        assert chain.half_steps.tolist() == [0, 2]
        assert chain.raw.radii[1] == pytest.approx(radius)


@pytest.mark.parametrize(("bend", "parts"), [(1e-7, [SEGMENT] * 2), (1.2e-7, [SEGMENT, BRIDGE, SEGMENT])])
def test_the_distance_of_the_ends_decides_what_is_tangent(bend, parts):
    assert _chain(lines((0, 0), (1, 0), (2, bend)), Side.LEFT, 0.9).parts.tolist() == parts


@pytest.mark.parametrize("side", Side)
def test_reversal_gets_a_half_circle(side):
    chain = _chain(lines((0, 0), (1, 0), (0, 0)), side, 0.5)
    assert chain.parts.tolist() == [SEGMENT, CORNER, SEGMENT]
    assert chain.raw.sweeps[1] == pytest.approx(-side.sign * pi)


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.0, 4.0])
def test_reversal_at_any_angle(angle):
    out = (float(np.cos(angle)), float(np.sin(angle)))
    for side in Side:
        assert _chain(lines((0, 0), out, (0, 0)), side, 0.5).parts.tolist() == [SEGMENT, CORNER, SEGMENT]


def test_inside_arc_not_larger_than_the_tool_vanishes():
    contour = Path.from_pieces(
        [Line((0, 0), (2, 0)), Arc((2, 0), (2.5, 0.5), (2, 0.5), Turn.CCW), Line((2.5, 0.5), (2.5, 3))]
    )
    chain = _chain(contour, Side.LEFT, 0.75)
    assert chain.parts.tolist() == [SEGMENT, VANISHED, SEGMENT]
    assert chain.raw[1] == Line((2, 0.75), (1.75, 0.5))
    assert _chain(contour, Side.RIGHT, 0.75).parts.tolist() == [SEGMENT] * 3


def test_arc_exactly_as_large_as_the_tool_becomes_a_point():
    contour = Path.from_pieces(
        [Line((0, 0), (2, 0)), Arc((2, 0), (2.5, 0.5), (2, 0.5), Turn.CCW), Line((2.5, 0.5), (2.5, 3))]
    )
    chain = _chain(contour, Side.LEFT, 0.5)
    assert chain.parts.tolist() == [SEGMENT, VANISHED, SEGMENT]
    assert chain.raw[1].length == 0


def test_full_circle_stays_full():
    circle = Arc((2, 0), (2, 0), (0, 0), Turn.CCW)
    assert _chain(Path.from_pieces([circle]), Side.LEFT, 0.5).raw[0] == Arc((1.5, 0), (1.5, 0), (0, 0), Turn.CCW)
    between = Path.from_pieces([Line((2, -3), (2, 0)), circle, Line((2, 0), (2, 3))])
    for contour in (between, between.reversed()):
        for side in Side:
            circles = [piece for piece in _chain(contour, side, 0.3).raw if isinstance(piece, Arc)]
            assert [abs(piece.sweep) for piece in circles] == [2 * pi]


def test_full_circle_stays_full_where_rounding_moves_the_next_start():
    at = (0.1 + 0.7 * sqrt(0.5), 0.2 + 0.7 * sqrt(0.5))
    circle = Arc(at, at, (0.1, 0.2), Turn.CCW)
    ahead = (at[0] - 1.0, at[1] + 1.0)
    chain = _chain(Path.from_pieces([circle, Line(at, ahead)]), Side.LEFT, 0.123)
    assert chain.parts.tolist() == [SEGMENT, SEGMENT]
    assert abs(chain.raw.sweeps[0]) == 2 * pi


def test_labels_come_from_the_contour():
    contour = Path.from_pieces([Line((0, 0), (1, 0)), Line((1, 0), (1, -1)), Line((1, -1), (2, -1))], [1, 3, 4])
    assert _chain(contour, Side.LEFT, 0.5).raw.numbers.tolist() == [1, 1.5, 3, 3.5, 4]


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed, st.sampled_from(Side), st.floats(0.05, 2.0))
def test_whole_pieces_keep_the_radius_from_their_own_segment(contour, side, radius):
    chain = _chain(contour, side, radius)
    for piece, part, place in zip(chain.raw, chain.parts.tolist(), chain.half_steps.tolist(), strict=True):
        if part == SEGMENT:
            before = contour[place // 2]
            assert piece.length == pytest.approx(_grown(before, side, radius), abs=1e-6)
        if part == CORNER:
            assert isinstance(piece, Arc)
            assert piece.center == contour[place // 2].end
            assert piece.radius == pytest.approx(radius)


def _grown(piece: Piece, side: Side, radius: float) -> float:
    if isinstance(piece, Line):
        return piece.length
    return (piece.radius - piece.turn * side.sign * radius) * abs(piece.sweep)


def test_long_chains_are_the_same_however_they_are_cut():
    count = 40_000
    x = np.arange(count + 1.0)
    points = np.stack((x, 0.3 * np.sin(x)), axis=1)
    whole = Path.of(points, points[:-1], np.zeros(count, np.int8))
    chain, start = _chain(whole, Side.LEFT, 0.4), _chain(whole.part(0, 20_000), Side.LEFT, 0.4)
    assert np.array_equal(chain.raw.points[: len(start)], start.raw.points[:-1])
    assert np.array_equal(chain.parts[: len(start)], start.parts)
    assert np.array_equal(chain.half_steps[: len(start)], start.half_steps)
    assert np.array_equal(chain.raw.numbers[: len(start)], start.raw.numbers)
