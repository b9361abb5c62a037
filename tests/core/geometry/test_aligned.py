"""Rows of boxes that run along each other: shifting and opening groups finds what comparing every pair finds."""

from __future__ import annotations

import numpy as np
import pytest

from core.geometry.aligned import aligned_pairs
from tests.core.geometry.test_boxes import Floats, apart, wander


def beside(seed: int, count: int) -> Floats:
    """The boxes of the walk of this seed, moved a little, and some of them nowhere."""
    random = np.random.default_rng(seed + 100)
    boxes = wander(seed, count) + 0.1 * random.normal(size=(1, count))
    nowhere = np.flatnonzero(random.random(count) < 0.2)
    boxes[:2, nowhere], boxes[2:, nowhere] = np.inf, -np.inf
    return boxes


@pytest.mark.parametrize("count", [1, 2, 9, 101, 130, 257, 600])
@pytest.mark.parametrize("least", [1, 2])
@pytest.mark.parametrize("both", [True, False])
@pytest.mark.parametrize("reach", [0.0, 0.7])
def test_every_near_pair_is_found_once(count: int, least: int, both: bool, reach: float) -> None:
    a, b = beside(count, count), wander(count, count)
    i, j = aligned_pairs(a, b, reach, least, both=both)
    k, m = np.nonzero(apart(a, b) <= reach)
    far = m - k if not both else np.abs(m - k)
    wanted = set(zip(k[far >= least].tolist(), m[far >= least].tolist(), strict=True))
    assert sorted(zip(i.tolist(), j.tolist(), strict=True)) == sorted(wanted)


@pytest.mark.parametrize("count", [9, 257, 600])
@pytest.mark.parametrize("both", [True, False])
def test_a_box_that_is_no_number_is_near_all_and_hides_none(count: int, both: bool) -> None:
    a, b = beside(count, count), wander(count, count)
    met = apart(a, b) <= 0.7
    for boxes, of in ((a, met), (b, met.T)):
        row = count // 3
        boxes[:, row], of[row] = np.nan, True
    i, j = aligned_pairs(a, b, 0.7, 1, both=both)
    k, m = np.nonzero(met & ~np.eye(count, dtype=np.bool_))
    rising = k < m if not both else k != m
    known = a[0, k] < np.inf
    wanted = set(zip(k[rising & known].tolist(), m[rising & known].tolist(), strict=True))
    assert wanted <= set(zip(i.tolist(), j.tolist(), strict=True))


def test_the_corpus_of_walks_has_pairs_far_along() -> None:
    i, j = aligned_pairs(wander(600, 600), wander(600, 600), 0.7, 2)
    assert (np.abs(i - j) > 64).sum() > 50
