"""What the control's path leaves of the best path, on contours small enough to check by hand."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.best_path.best_path import BestPath, best_path
from core.comp.best_path.separation import separation
from core.comp.compensate import compensate
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests.core.comp.best_truth import distance, sampled
from tests.core.comp.contours import lines, loose
from tests.properties import exercised, must_exercise

CLOSE = 1e-9
SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))


def single_loop(loop: Path) -> BestPath:
    return BestPath((loop,), (True,), ())


def test_a_path_follows_itself_in_either_direction():
    best = best_path(SQUARE, Side.RIGHT, 0.25, closed=True)
    for control in (best.loops[0], best.loops[0].reversed()):
        found = separation(control, best, 0.25)
        assert (found.length, found.stretches) == (0.0, ())
        assert found.whole == pytest.approx(8 + pi / 2, abs=CLOSE)


def test_the_arc_across_the_start_is_the_best_paths_alone():
    control = compensate(SQUARE, Side.RIGHT, 0.25, 3, closed=True).path
    found = separation(control, best_path(SQUARE, Side.RIGHT, 0.25, closed=True), 0.25)
    assert found.length == pytest.approx(pi / 8, abs=CLOSE)
    (stretch,) = found.stretches
    assert stretch.points == pytest.approx(np.array([(-0.25, 0), (0, -0.25)]), abs=CLOSE)
    assert stretch.numbers.tolist() == [4.5]


def test_the_big_side_that_the_look_ahead_deletes_is_missing():
    chamfer = lines((0.1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0))
    control = compensate(chamfer, Side.LEFT, 0.25, 4, closed=True).path
    found = separation(control, best_path(chamfer, Side.LEFT, 0.25, closed=True), 0.25)
    assert (found.length, found.whole) == pytest.approx((6, 6), abs=CLOSE)


def test_half_of_a_line_is_followed():
    found = separation(lines((1, 0), (5, 0)), single_loop(lines((0, 0), (2, 0), (2, 1))), 0.25)
    assert found.length == pytest.approx(2, abs=CLOSE)
    assert [stretch.points.tolist() for stretch in found.stretches] == [[[0, 0], [1, 0]], [[2, 0], [2, 1]]]


def test_an_arc_over_the_start_of_a_full_circle():
    circle = Path.from_pieces([Arc((1.0, 0.0), (1.0, 0.0), (0.0, 0.0), Turn.CCW)])
    quarters = Path.from_pieces([Arc((0.0, -1.0), (0.0, 1.0), (0.0, 0.0), Turn.CCW)])
    for control in (quarters, quarters.reversed()):
        found = separation(control, single_loop(circle), 0.25)
        assert found.length == pytest.approx(pi, abs=CLOSE)
        (stretch,) = found.stretches
        assert stretch.points == pytest.approx(np.array([(0, 1), (0, -1)]), abs=CLOSE)


def test_crossing_and_running_beside_are_not_following():
    best = single_loop(lines((0, 0), (2, 0)))
    for control in (lines((1, -1), (1, 1)), lines((0, 1e-5), (2, 1e-5)), lines((0, -1e-3), (2, 1e-3)), EMPTY):
        assert separation(control, best, 0.25).length == pytest.approx(2, abs=CLOSE)


def test_arcs_of_other_circles_do_not_follow():
    half = Path.from_pieces([Arc((1.0, 0.0), (-1.0, 0.0), (0.0, 0.0), Turn.CCW)])
    other = Path.from_pieces([Arc((1.0, 0.0), (-1.0, 0.0), (0.0, -1e-3), Turn.CCW), Line((-1.0, 0.0), (1.0, 0.0))])
    assert separation(other, single_loop(half), 0.25).length == pytest.approx(pi, abs=CLOSE)


def test_without_a_best_path_nothing_is_missing():
    found = separation(SQUARE, BestPath((), (), ()), 0.25)
    assert (found.length, found.whole, found.stretches) == (0.0, 0.0, ())


@must_exercise(0.1)
@settings(max_examples=80, deadline=None, derandomize=True)
@given(loose, st.sampled_from(Side), st.floats(0.05, 1.0), st.integers(1, 5))
def test_stretches_are_off_the_controls_path_and_the_rest_is_on_it(contour, side, radius, lookahead):
    control = compensate(contour, side, radius, lookahead, closed=False).path
    best = best_path(contour, side, radius, closed=False)
    found = separation(control, best, radius)
    assert found.length == pytest.approx(sum(stretch.lengths.sum() for stretch in found.stretches), abs=1e-6)
    if found.stretches:
        exercised()
    for stretch in found.stretches:
        assert best.loops
        assert np.min([distance(loop, sampled(stretch)) for loop in best.loops], axis=0).max() < 1e-6
    off = sum(_off(loop, control) for loop in best.loops)
    assert found.length == pytest.approx(off, abs=0.02 * (1.0 + found.whole))


def _off(loop: Path, control: Path, parts: int = 400) -> float:
    """The length of a loop that lies off a path, by many small parts of each piece."""
    length = 0.0
    for row in range(len(loop)):
        piece = loop.part(row, row + 1)
        shares = (np.arange(parts) + 0.5) / parts
        angles = piece.sweeps[0] * shares
        arm = piece.points[0] - piece.centers[0]
        turned = np.stack(
            (arm[0] * np.cos(angles) - arm[1] * np.sin(angles), arm[0] * np.sin(angles) + arm[1] * np.cos(angles)), 1
        )
        line = piece.points[0] + shares[:, None] * (piece.points[1] - piece.points[0])
        points = piece.centers[0] + turned if piece.turns[0] else line
        length += piece.lengths[0] * float(np.mean(distance(control, points) > 1e-6))
    return length
