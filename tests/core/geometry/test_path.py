"""Paths: chains of lines and arcs as arrays, agreeing with the plain pieces they are made of."""

from __future__ import annotations

from math import pi, sqrt, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.path import EMPTY, Path, joined
from core.geometry.piece import Arc, Line, Piece, Turn
from tests.core.comp.contours import mixed

PIECES: list[Piece] = [
    Line((0, 0), (2, 0)),
    Arc((2, 0), (3, 1), (2, 1), Turn.CCW),
    Arc((3, 1), (3, 1), (4, 1), Turn.CW),
    Line((3, 1), (3, 3)),
]
PATH = Path.from_pieces(PIECES)


def test_pieces_come_back():
    assert list(PATH) == PIECES
    assert PATH[-1] == PIECES[-1]
    assert len(PATH) == 4
    with pytest.raises(IndexError):
        PATH[4]


def test_numbers_count_from_one_unless_given():
    assert PATH.numbers.tolist() == [1, 2, 3, 4]
    assert Path.from_pieces(PIECES, [1, 1.5, 2, 7]).numbers.tolist() == [1, 1.5, 2, 7]


def test_arrays_cannot_be_written():
    with pytest.raises(ValueError, match="read-only"):
        PATH.points[0, 0] = 1


def test_lengths_radii_and_sweeps():
    assert PATH.lengths.tolist() == pytest.approx([2, pi / 2, tau, 2])
    assert PATH.radii.tolist() == pytest.approx([0, 1, 1, 0])
    assert PATH.sweeps.tolist() == pytest.approx([0, pi / 2, -tau, 0])


def test_directions():
    assert PATH.start_directions.tolist() == [[1, 0], [1, 0], [0, 1], [0, 1]]
    assert PATH.end_directions.tolist() == [[1, 0], [0, 1], [0, 1], [0, 1]]


def test_line_without_length_has_no_direction():
    assert Path.from_pieces([Line((1, 1), (1, 1))]).start_directions.tolist() == [[0, 0]]


def test_boxes():
    assert PATH.boxes.T.tolist() == [[0, 0, 2, 0], [2, 0, 3, 1], [3, 0, 5, 2], [3, 1, 3, 3]]
    low = Arc((-1, 0), (sqrt(0.5), -sqrt(0.5)), (0, 0), Turn.CCW)
    assert Path.from_pieces([low]).boxes.T.tolist() == [pytest.approx([-1, -1, sqrt(0.5), 0])]


def test_backwards():
    back = PATH.reversed()
    assert list(back) == [
        Line((3, 3), (3, 1)),
        Arc((3, 1), (3, 1), (4, 1), Turn.CCW),
        Arc((3, 1), (2, 0), (2, 1), Turn.CW),
        Line((2, 0), (0, 0)),
    ]
    assert back.numbers.tolist() == [4, 3, 2, 1]


def test_part_and_join():
    first, last = PATH.part(0, 1), PATH.part(1, 4)
    assert list(first) == PIECES[:1]
    whole = joined([first, EMPTY, last])
    assert list(whole) == PIECES
    assert whole.numbers.tolist() == [1, 2, 3, 4]


def test_without_pieces_of_no_length_each_piece_starts_where_the_one_before_ends():
    near = 0.001
    lines = [Line((0, 0), (2, 0)), Line((2, 0), (2, near)), Line((2, near), (2, 5)), Line((2, 5), (0, 5))]
    circle = Arc((2, near), (2, near), (3, near), Turn.CW)
    path = Path.from_pieces([*lines[:2], circle, *lines[2:]])
    left = path.without(np.array([1]))
    assert left.numbers.tolist() == [1, 3, 4, 5]
    # the full circle stays full
    assert left.points.tolist() == [[0, 0], [2, near], [2, near], [2, 5], [0, 5]]


def test_nothing():
    assert Path.from_pieces([]) is EMPTY
    assert joined([]) is EMPTY
    assert joined([EMPTY, EMPTY]) is EMPTY
    assert joined([EMPTY, PATH, EMPTY]) is PATH
    assert list(EMPTY) == []


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed)
def test_arrays_agree_with_the_pieces(path):
    assert path.lengths.tolist() == pytest.approx([piece.length for piece in path], abs=1e-9)
    arcs = [piece.sweep if isinstance(piece, Arc) else 0.0 for piece in path]
    assert path.sweeps.tolist() == pytest.approx(arcs, abs=1e-9)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed)
def test_backwards_twice_is_the_same_path(path):
    twice = path.reversed().reversed()
    assert np.array_equal(twice.points, path.points)
    assert np.array_equal(twice.centers, path.centers)
    assert np.array_equal(twice.turns, path.turns)
    assert np.allclose(path.reversed().lengths, path.lengths[::-1], atol=1e-9)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed, st.floats(0, 1))
def test_boxes_hold_every_point_of_their_piece(path, share):
    turned = np.exp(1j * path.sweeps * share)
    radial = (path.starts - path.centers) @ np.array([1, 1j])
    arcs = path.centers @ np.array([1, 1j]) + radial * turned
    straight = (path.starts + share * (path.ends - path.starts)) @ np.array([1, 1j])
    on = np.where(path.turns == 0, straight, arcs)
    boxes = path.boxes.T
    assert (on.real >= boxes[:, 0] - 1e-9).all()
    assert (on.imag >= boxes[:, 1] - 1e-9).all()
    assert (on.real <= boxes[:, 2] + 1e-9).all()
    assert (on.imag <= boxes[:, 3] + 1e-9).all()
