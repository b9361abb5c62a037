"""The tree of boxes finds what comparing every pair finds."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from core.geometry import boxes as module
from core.geometry.boxes import FAN, closest_pairs, grouped, near_pairs, nearest_boxes

Floats = NDArray[np.float64]


def wander(seed: int, count: int) -> Floats:
    """Boxes (4, n) along a random walk, which meets itself often."""
    random = np.random.default_rng(seed)
    corners = np.cumsum(random.normal(size=(2, count + 1)), axis=1)
    return np.vstack((np.minimum(corners[:, :-1], corners[:, 1:]), np.maximum(corners[:, :-1], corners[:, 1:])))


def apart(a: Floats, b: Floats) -> Floats:
    """(n, m) distances of boxes."""
    x = np.maximum(a[0][:, None] - b[2], b[0] - a[2][:, None])
    y = np.maximum(a[1][:, None] - b[3], b[1] - a[3][:, None])
    return np.asarray(np.hypot(np.maximum(x, 0.0), np.maximum(y, 0.0)))


@pytest.fixture(params=[65_536, 16], ids=["at once", "by the tree"])
def at_once(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "AT_ONCE", request.param)


@pytest.mark.parametrize("few", [0, 500], ids=["a member of all at a time", "group by group"])
@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 7, 8, 61])
def test_grouped_holds_all_of_each_group(few: int, count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "FEW_GROUPED", few)
    boxes = wander(3, count)
    boxes[1, count // 2] = np.nan
    parts = [boxes[:, first : first + FAN] for first in range(0, count, FAN)]
    expected = [np.concatenate((part[:2].min(axis=1), part[2:].max(axis=1))) for part in parts]
    np.testing.assert_array_equal(grouped(boxes), np.array(expected).T)


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize(("n", "m"), [(1, 1), (3, 40), (57, 5), (130, 131), (256, 64)])
@pytest.mark.parametrize("reach", [0.0, 0.7])
def test_near_pairs(n: int, m: int, reach: float) -> None:
    a, b = wander(1, n), wander(2, m)
    i, j = near_pairs(a, b, reach)
    assert set(zip(i.tolist(), j.tolist(), strict=True)) == set(
        zip(*map(np.ndarray.tolist, np.nonzero(apart(a, b) <= reach)), strict=True)
    )
    assert np.all(np.diff(i) >= 0)


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize(("n", "m"), [(1, 1), (3, 40), (57, 5), (130, 131), (256, 64), (300, 300)])
@pytest.mark.parametrize("reach", [0.0, 0.7])
def test_a_box_that_is_no_number_is_near_all_and_hides_none(n: int, m: int, reach: float) -> None:
    a, b = wander(1, n), wander(2, m)
    unknown = np.zeros((n, m), np.bool_)
    for boxes, of in ((a, unknown), (b, unknown.T)):
        row = boxes.shape[1] // 2
        boxes[:, row], of[row] = np.nan, True
    i, j = near_pairs(a, b, reach)
    wanted = np.nonzero((apart(a, b) <= reach) | unknown)
    assert set(zip(i.tolist(), j.tolist(), strict=True)) == set(zip(*map(np.ndarray.tolist, wanted), strict=True))


@pytest.mark.usefixtures("at_once")
def test_a_bound_that_is_no_number_hides_neither_its_box_nor_its_group() -> None:
    for bound in range(4):
        a, b = wander(1, 130), wander(2, 131)
        wanted = np.nonzero(apart(a, b) <= 0.7)
        a[bound, ::7] = np.nan
        for i, j in (near_pairs(a, b, 0.7), near_pairs(b, a, 0.7)[::-1]):
            assert set(zip(*map(np.ndarray.tolist, wanted), strict=True)) <= set(
                zip(i.tolist(), j.tolist(), strict=True)
            )


@pytest.mark.usefixtures("at_once")
def test_closest_pairs_are_held_beside_a_box_that_is_no_number() -> None:
    a, b = wander(1, 40), wander(2, 50) + 100.0
    best = divmod(int(apart(a, b).argmin()), 50)
    other = (best[1] + 1) % 50
    b[:, other] = np.nan
    found = set(zip(*map(np.ndarray.tolist, closest_pairs(a, b)), strict=True))
    assert found >= {best, *((row, other) for row in range(40))}


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize(("n", "m"), [(1, 1), (3, 40), (130, 131)])
def test_closest_pairs_hold_the_closest(n: int, m: int) -> None:
    a, b = wander(1, n), wander(2, m) + 100.0
    x, y = np.maximum(b[0] - a[2][:, None], 0.0), np.maximum(b[1] - a[3][:, None], 0.0)
    best = np.unravel_index(np.argmin(np.hypot(x, y)), (n, m))
    assert tuple(map(int, best)) in set(zip(*map(np.ndarray.tolist, closest_pairs(a, b)), strict=True))


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("m", [1, 5, 64, 200])
def test_nearest_boxes_hold_the_nearest(m: int) -> None:
    bounds = wander(3, m)
    spots = np.random.default_rng(4).uniform(-20.0, 20.0, (30, 2))
    points = spots[:, 0] + 1j * spots[:, 1]
    middles = ((bounds[0] + bounds[2]) + 1j * (bounds[1] + bounds[3])) / 2.0
    gaps = np.abs(points[:, None] - middles)
    for known in (np.full(30, np.inf), gaps.min(axis=1)):
        k, j = nearest_boxes(points, bounds, known, 1e-9)
        found = set(zip(k.tolist(), j.tolist(), strict=True))
        assert np.all(np.diff(k) >= 0)
        assert all((point, int(gaps[point].argmin())) in found for point in range(30))
