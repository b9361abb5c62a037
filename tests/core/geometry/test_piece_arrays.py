"""Pieces as arrays: lengths, boxes, places, and tiny pieces."""

from __future__ import annotations

from math import nan, pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.geometry.piece_arrays import (
    FEW_PAIRS,
    PAIRS_PER_BATCH,
    at,
    batches_by_kind,
    direction,
    piece_arrays,
    piece_at,
)
from core.verify.judge import judge
from tests.core.verify import oracle
from tests.core.verify.shapes import lines, paths

QUARTER = Path.from_pieces([Line((0, 0), (3, 4)), Arc((3, 4), (4, 5), (4, 4), Turn.CW), Line((4, 5), (4, 9))])


def test_pieces_have_lengths_and_stations() -> None:
    pieces = piece_arrays(QUARTER)
    assert pieces.length == pytest.approx([5.0, pi / 2, 4.0])
    assert pieces.stations == pytest.approx([0.0, 5.0, 5.0 + pi / 2, 9.0 + pi / 2])
    assert pieces.radius[1] == 1.0


def test_pieces_have_points_and_directions() -> None:
    pieces, half = piece_arrays(QUARTER), np.full(3, 0.5)
    assert at(pieces, half) == pytest.approx([1.5 + 2j, 4 + 4j + (-1 + 1j) / sqrt(2), 4 + 7j])
    assert direction(pieces, half) == pytest.approx([0.6 + 0.8j, (1 + 1j) / sqrt(2), 1j])


def test_a_joint_belongs_to_the_piece_that_starts_there() -> None:
    pieces = piece_arrays(QUARTER)
    index, t = piece_at(pieces, pieces.stations, np.array((-1.0, 0.0, 5.0, 5.0 + pi / 4, 100.0)))
    assert index.tolist() == [0, 0, 1, 1, 2]
    assert t == pytest.approx([0.0, 0.0, 0.0, 0.5, 1.0])


def test_pieces_without_length_are_left_out_unless_all_are() -> None:
    assert piece_arrays(lines((0, 0), (0, 0), (1, 0), (1, 0))).rows.tolist() == [1]
    assert piece_arrays(lines((1, 1), (1, 1), (1, 1))).rows.tolist() == [0]
    assert len(piece_arrays(EMPTY)) == 0


def test_an_invalid_piece_is_not_left_out() -> None:
    path = lines((0, 0), (1, 0), (1, 0), (nan, 1), (2, 1))
    assert piece_arrays(path).rows.tolist() == [0, 2, 3]


def test_an_uneven_arc_gets_a_circle_through_both_ends() -> None:
    arc = piece_arrays(Path.from_pieces([Arc((10.0, 0.0), (0.0, 10.002), (0.0, 0.0), Turn.CCW)]))
    assert at(arc, np.array((1.0,)))[0] == pytest.approx(10.002j, abs=1e-9)
    assert 0.001 < arc.slack[0] < 0.003
    wild = piece_arrays(Path.from_pieces([Arc((10.0, 0.0), (0.0, 11.0), (0.0, 0.0), Turn.CCW)]))
    assert wild.slack[0] == 1.0


@settings(deadline=None, max_examples=80, derandomize=True)
@given(paths())
def test_boxes_contain_all_points_tightly(path: Path) -> None:
    box = piece_arrays(path).boxes
    for index, piece in enumerate(path):
        x, y = oracle.along(piece, np.linspace(0.0, 1.0, 400)).T
        low_x, low_y, high_x, high_y = box[:, index]
        step = oracle.length(piece) / 300
        assert low_x - 1e-9 <= x.min() <= low_x + step
        assert low_y - 1e-9 <= y.min() <= low_y + step
        assert high_x - step <= x.max() <= high_x + 1e-9
        assert high_y - step <= y.max() <= high_y + 1e-9


@settings(deadline=None, max_examples=150, derandomize=True)
@given(st.floats(-6.0, 0.0), st.floats(-7.0, -2.6), st.sampled_from((-1, 1)), st.sampled_from((-1, 1)))
def test_an_uneven_arc_is_near_its_circle_everywhere(power: float, differ: float, out: int, way: int) -> None:
    """The length of the chord does not matter, even for a nearly full arc with a short chord."""
    chord, off = 10.0**power, 10.0**differ
    last = (10.0 + out * off) * np.exp(1j * way * chord / 10.0)
    arc = piece_arrays(Path.from_pieces([Arc((10.0, 0.0), (last.real, last.imag), (0.0, 0.0), Turn.CCW)]))
    assert arc.slack[0] == pytest.approx(off, rel=1e-3)
    turned = chord if way > 0 else 20.0 * pi - chord
    assert arc.length[0] == pytest.approx(abs(complex(turned, off)) if way > 0 else turned, abs=10.0 * off)
    for part in np.linspace(0.0, 1.0, 9):
        assert abs(abs(at(arc, np.array((part,)))[0]) - 10.0) <= off * (1.0 + 1e-3) + 1e-9


def test_uneven_radii_of_a_nearly_full_arc_hide_no_gouge() -> None:
    """The arc ends 0.01 from its start with radii 0.001 apart; the path is 0.3 too near on the far side."""
    hole = Path.from_pieces([Arc((10.0, 0.0), (10.001, -0.01), (0.0, 0.0), Turn.CCW)])
    path = Path.from_pieces([Arc((9.2, 0.0), (9.2, 0.0), (-0.3, 0.0), Turn.CCW)])
    verdict = judge(hole, Side.LEFT, 0.5, path)
    assert verdict.depth == pytest.approx(0.3, abs=2e-3)


@pytest.mark.parametrize("count", [0, 1, 500, 501, 10_000])
def test_every_pair_is_in_one_block_and_large_blocks_are_of_one_kind(count: int) -> None:
    random = np.random.default_rng(1)
    first, second = random.random((2, count)) < 0.5
    result = list(batches_by_kind(first, second))
    assert sorted(np.concatenate([np.empty(0, np.intp), *result]).tolist()) == list(range(count))
    for rows in result if count > FEW_PAIRS else ():
        assert 0 < len(rows) <= PAIRS_PER_BATCH
        assert len(np.unique(first[rows])) == len(np.unique(second[rows])) == 1
