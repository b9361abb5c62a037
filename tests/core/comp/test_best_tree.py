"""The tree of boxes finds every pair that looking at all of them finds, and its boxes hold their pieces."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.best_path.clear import distances
from core.comp.best_path.raw_offset import lengths
from core.comp.best_path.tree import near, near_selves, piece_boxes, tree
from core.geometry.path import Floats, Path, as_complex
from tests.core.comp.best_truth import distance, sampled
from tests.core.comp.contours import mixed

counts = st.sampled_from([1, 2, 4, 5, 17, 64, 65, 300])


def boxes(seed: int, count: int) -> Floats:
    """Boxes one behind the other on a walk, of sizes up to 1."""
    rng = np.random.default_rng(seed)
    low = np.cumsum(rng.uniform(-1, 1, (2, count)), axis=1)
    return np.concatenate((low, low + rng.uniform(0, 1, (2, count))))


def apart(one: Floats, two: Floats) -> Floats:
    """Distances (n, m) of all boxes from all others."""
    gaps = np.maximum(one[:2, :, None] - two[2:, None], two[:2, None] - one[2:, :, None])
    return np.asarray(np.hypot(*np.maximum(gaps, 0.0)))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.integers(0, 1000), counts, counts, st.sampled_from([0.0, 0.3, 5.0]))
def test_all_pairs_within_reach_are_found_once_and_none_beyond(seed, first, second, reach):
    one, two = boxes(seed, first), boxes(seed + 1, second)
    pairs = [pair for i, j in near(tree(one), tree(two), reach) for pair in zip(i.tolist(), j.tolist(), strict=True)]
    assert len(set(pairs)) == len(pairs)
    gaps = apart(one, two)
    assert set(zip(*np.nonzero(gaps <= reach), strict=True)) <= set(pairs)
    assert all(gaps[pair] <= reach + 1e-4 for pair in pairs)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.integers(0, 1000), counts)
def test_all_pairs_of_one_tree_that_meet_are_found_once(seed, count):
    one = boxes(seed, count)
    pairs = [pair for i, j in near_selves(tree(one)) for pair in zip(i.tolist(), j.tolist(), strict=True)]
    assert len(set(pairs)) == len(pairs)
    assert all(i < j for i, j in pairs)
    assert set(zip(*np.nonzero(np.triu(apart(one, one) == 0.0, 1)), strict=True)) <= set(pairs)


def test_no_boxes_are_near_nothing():
    assert list(near(tree(np.empty((4, 0))), tree(boxes(0, 5)), 1.0)) == []
    assert list(near_selves(tree(np.empty((4, 0))))) == []


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed)
def test_a_box_holds_its_piece_and_is_no_larger_than_its_circle(contour):
    points, centers = as_complex(contour.points), as_complex(contour.centers)
    found = piece_boxes(points[:-1], points[1:], centers, contour.turns, 0.0)
    for row in range(len(contour)):
        spots = sampled(contour.part(row, row + 1)).T
        low, high = found[:2, row, None], found[2:, row, None]
        assert (spots >= low - 1e-12).all()
        assert (spots <= high + 1e-12).all()
        size = 2.0 * contour.radii[row] if contour.turns[row] else contour.lengths[row]
        assert ((high - low) <= size + 1e-12).all()


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed, st.integers(0, 1000))
def test_distances_and_lengths_of_pieces(contour, seed):
    spots = np.random.default_rng(seed).uniform(-5, 5, (len(contour), 2))
    found = distances(contour, np.arange(len(contour)), as_complex(spots))
    exact = [distance(contour.part(row, row + 1), spots[row : row + 1])[0] for row in range(len(contour))]
    assert found == pytest.approx(np.array(exact), abs=1e-12)
    points = as_complex(contour.points)
    measured = lengths(points[:-1], points[1:], as_complex(contour.centers), contour.turns)
    assert measured == pytest.approx(contour.lengths, abs=1e-12)


def test_a_full_circle_has_the_box_of_its_circle_whatever_rounding_makes_of_its_ends():
    angles = np.linspace(0.0, 6.28, 100)
    for x, y in zip(np.cos(angles), np.sin(angles), strict=True):
        circle = Path.of(np.array([(x, y), (x, y)]), np.zeros((1, 2)), np.ones(1, np.int8))
        points = as_complex(circle.points)
        box = piece_boxes(points[:-1], points[1:], as_complex(circle.centers), circle.turns, 0.0)
        assert box[:, 0] == pytest.approx((-1, -1, 1, 1), abs=1e-12)
