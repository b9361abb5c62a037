"""Laws of the best path: its symmetries, and its agreement with the control's path where that is clean and complete."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, sin

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core.comp.best_path.best_path import BestPath, best_path
from core.comp.compensate import compensate
from core.geometry.path import Floats, Path
from core.geometry.piece import Side
from tests.core.comp.best_truth import distance, from_loops, sampled
from tests.core.comp.contours import lines, loose, shut
from tests.properties import exercised, must_exercise

sides = st.sampled_from(Side)
radii = st.floats(0.05, 1.5)
TWO_ROOMS = lines(
    *((1, 0), (2, 0), (2, 0.8), (3, 0.8), (3, 0), (5, 0), (5, 2), (3, 2), (3, 1.2), (2, 1.2), (2, 2), (0, 2), (0, 0)),
    (1, 0),
)
"""Two squares with a passage between them that is too narrow for a cutter of radius 0.25."""
OTHER = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT}


def assert_same(one: BestPath, two: BestPath, moved: Callable[[Floats], Floats], tolerance: float) -> None:
    """The loops of `one`, moved, are those of `two`: as many, as long, and on each other."""
    assert sorted(one.closed) == sorted(two.closed)
    first, second = (sorted(loop.lengths.sum() for loop in best.loops) for best in (one, two))
    assert first == pytest.approx(second, abs=100 * tolerance)
    for loop in one.loops:
        assert from_loops(two, moved(sampled(loop))).max() < tolerance


def mapped(contour: Path, moved: Callable[[Floats], Floats], *, turn: int) -> Path:
    return Path.of(moved(contour.points), moved(contour.centers), turn * contour.turns, contour.numbers)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(loose, sides, radii, st.booleans())
def test_reversed_on_the_other_side_it_is_the_same(contour, side, radius, closed):
    contour = shut(contour) if closed else contour
    back = best_path(contour.reversed(), OTHER[side], radius, closed=closed)
    assert_same(best_path(contour, side, radius, closed=closed), back, lambda points: points, 1e-7)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(loose, sides, radii, st.booleans())
def test_mirrored_on_the_other_side_it_is_mirrored(contour, side, radius, closed):
    contour = shut(contour) if closed else contour
    mirror = best_path(mapped(contour, lambda points: points * (1, -1), turn=-1), OTHER[side], radius, closed=closed)
    assert_same(best_path(contour, side, radius, closed=closed), mirror, lambda points: points * (1, -1), 1e-7)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(loose, sides, radii, st.booleans(), st.floats(0.0, 6.28))
def test_rotated_it_is_rotated(contour, side, radius, closed, angle):
    contour = shut(contour) if closed else contour
    turned = np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
    other = best_path(mapped(contour, lambda points: points @ turned, turn=1), side, radius, closed=closed)
    assert_same(best_path(contour, side, radius, closed=closed), other, lambda points: points @ turned, 1e-7)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(loose, sides, radii, st.booleans())
def test_ten_meters_away_it_is_moved(contour, side, radius, closed):
    contour = shut(contour) if closed else contour
    far = best_path(mapped(contour, lambda points: points + 1e4, turn=1), side, radius, closed=closed)
    assert_same(best_path(contour, side, radius, closed=closed), far, lambda points: points + 1e4, 1e-6)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(loose.map(shut), sides, radii, st.integers(1, 10))
def test_started_elsewhere_it_is_the_same(contour, side, radius, first):
    first %= len(contour)
    points = np.concatenate((contour.points[first:], contour.points[1 : first + 1]))
    order = np.roll(np.arange(len(contour)), -first)
    other = Path.of(points, contour.centers[order], contour.turns[order])
    one, two = (best_path(path, side, radius, closed=True) for path in (contour, other))
    assert_same(one, two, lambda points: points, 1e-7)


@must_exercise(0.3, "pieces", "corners")
@must_exercise(0.003, "order")
@settings(max_examples=120, deadline=None, derandomize=True)
@given(loose, sides, radii, st.booleans())
@example(TWO_ROOMS, Side.LEFT, 0.25, True)
def test_it_lies_on_its_own_pieces_in_the_contours_order_and_direction(contour, side, radius, closed):
    contour = shut(contour) if closed else contour
    best = best_path(contour, side, radius, closed=closed)
    for loop in best.loops:
        for row, number in enumerate(loop.numbers.tolist()):
            exercised("pieces" if number % 1 == 0 else "corners")
            assert loop.turns[row] == (contour.turns[int(number) - 1] if number % 1 == 0 else -side.sign)
    starts = [loop.numbers.min() for loop, ring in zip(best.loops, best.closed, strict=True) if ring]
    assert starts == sorted(starts)
    if len(starts) > 1:
        exercised("order")


def clean_path(contour: Path, side: Side, radius: float, *, closed: bool) -> Path | None:
    """The control's path with as much look-ahead as it needs, if it has one that gouges nothing."""
    control = compensate(contour, side, radius, 20, closed=closed).path
    clean = len(control) and distance(contour, sampled(control)).min() >= radius - 1e-7
    return control if clean else None


@must_exercise(0.3)
@settings(max_examples=120, deadline=None, derandomize=True)
@given(loose, sides, radii)
def test_a_clean_path_of_the_control_is_on_the_best_path(contour, side, radius):
    control = clean_path(contour, side, radius, closed=False)
    if control is not None:
        exercised()
        assert from_loops(best_path(contour, side, radius, closed=False), sampled(control)).max() < 1e-6


AGREEING = {
    "L": (lines((0, 0), (3, 0), (3, 2)), Side.LEFT, False),
    "notch": (lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0)), Side.LEFT, False),
    "small step": (lines((0, 0), (2, 0), (2, 0.1), (4, 0.1), (4, 2)), Side.LEFT, False),
    "short chamfer": (lines((0, 0), (2, 0), (2.05, 0.05), (2.05, 2), (0, 2)), Side.LEFT, False),
    "square from mid-side": (lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0)), Side.LEFT, True),
    "chamfer from mid-side": (lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0), (1, 0)), Side.LEFT, True),
}


@pytest.mark.parametrize("name", AGREEING)
def test_where_the_controls_path_is_clean_and_complete_the_two_are_one_curve(name):
    contour, side, closed = AGREEING[name]
    control = clean_path(contour, side, 0.25, closed=closed)
    best = best_path(contour, side, 0.25, closed=closed)
    assert control is not None
    assert from_loops(best, sampled(control)).max() < 1e-6
    (loop,) = best.loops
    assert loop.lengths.sum() < control.lengths.sum() + 1e-6
