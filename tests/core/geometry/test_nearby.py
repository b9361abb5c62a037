"""The searches for near pieces find the same pairs as comparing all pairs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from core.geometry.distance import distance
from core.geometry.nearby import (
    near_pairs,
    near_pairs_within,
    nearest_pairs,
    sorted_pairs,
)
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Line
from core.geometry.piece_arrays import PieceArrays, at, piece_arrays

Floats = NDArray[np.float64]
Rows = NDArray[np.signedinteger[Any]]

SIZES = [(1, 1), (3, 40), (57, 5), (130, 131), (300, 700)]


def walk(seed: int, count: int, *, arcs: bool = True) -> PieceArrays:
    """A random walk of lines and arcs that often meets itself."""
    random = np.random.default_rng(seed)
    points = np.cumsum(random.normal(size=(count + 1, 2)), axis=0)
    turns = (random.integers(-1, 2, count) * arcs).astype(np.int8)
    chord = np.diff(points, axis=0)
    normal = np.stack((-chord[:, 1], chord[:, 0]), axis=1)
    centers = (points[1:] + points[:-1]) / 2.0 + normal * random.normal(size=(count, 1))
    return piece_arrays(Path.of(points, np.where(turns[:, None] == 0, points[:-1], centers), turns))


def boxes_apart(a: Floats, b: Floats) -> Floats:
    """(n, m) distances of boxes."""
    x = np.maximum(a[0][:, None] - b[2], b[0] - a[2][:, None])
    y = np.maximum(a[1][:, None] - b[3], b[1] - a[3][:, None])
    return np.asarray(np.hypot(np.maximum(x, 0.0), np.maximum(y, 0.0)))


def pairs(found: tuple[Rows, ...]) -> set[tuple[int, int]]:
    return set(zip(found[0].tolist(), found[1].tolist(), strict=True))


@pytest.mark.parametrize(("n", "m"), SIZES)
@pytest.mark.parametrize("reach", [0.0, 0.7])
def test_near_boxes_are_within_the_reach(n: int, m: int, reach: float) -> None:
    a, b = walk(1, n).boxes, walk(2, m).boxes
    batches = list(near_pairs(a, b, reach))
    assert pairs(sorted_pairs(batches)) == pairs(np.nonzero(boxes_apart(a, b) <= reach))
    assert np.all(np.diff(np.concatenate([i for i, _ in batches])) >= 0)


@pytest.mark.parametrize("n", [1, 2, 40, 700])
def test_each_pair_of_near_boxes_of_one_set_comes_once(n: int) -> None:
    a = walk(3, n).boxes
    i, j = sorted_pairs(near_pairs_within(a, 0.2))
    assert len(i) == len(pairs((i, j)))
    assert pairs((i, j)) == pairs(np.nonzero(np.triu(boxes_apart(a, a) <= 0.2, 1)))


def test_empty_sets_have_no_near_boxes() -> None:
    none, some = np.zeros((4, 0)), walk(1, 5).boxes
    assert not list(near_pairs(none, some, 1.0))
    assert not list(near_pairs(some, none, 1.0))
    assert len(sorted_pairs(near_pairs(none, none, 1.0))[0]) == 0


def test_overlapping_boxes_come_in_batches() -> None:
    a = np.tile([[0.0], [0.0], [1.0], [1.0]], (1, 3000))
    sizes = [len(i) for i, _ in near_pairs(a, a, 0.0)]
    assert sum(sizes) == 9_000_000
    assert max(sizes) < 500_000


@pytest.mark.parametrize("bound", range(4))
def test_an_invalid_box_hides_no_other_pair(bound: int) -> None:
    a, b = walk(1, 130).boxes, walk(2, 131).boxes
    wanted = pairs(np.nonzero(boxes_apart(a, b) <= 0.7))
    a[bound, ::7] = np.nan
    for near in (sorted_pairs(near_pairs(a, b, 0.7)), sorted_pairs(near_pairs(b, a, 0.7))[::-1]):
        assert pairs(near) >= wanted


def waves(count: int, radius: float) -> PieceArrays:
    angle = np.linspace(0.0, 2.0 * np.pi, count + 1)
    size = radius + 0.01 * np.sin(40.0 * angle)
    points = np.stack((size * np.cos(angle), size * np.sin(angle)), axis=1)
    return piece_arrays(Path.of(points, points[:-1], np.zeros(count, np.int8)))


@pytest.mark.parametrize("scattered", [False, True])
@pytest.mark.parametrize("arcs", [False, True])
@pytest.mark.parametrize(("n", "m"), SIZES)
def test_nearest_pairs_contain_the_piece_nearest_to_every_place(n: int, m: int, arcs: bool, scattered: bool) -> None:
    first, second = walk(4, n, arcs=arcs), walk(5, m, arcs=arcs)
    if scattered:
        # consecutive pieces then have gaps between them
        random = np.random.default_rng(6)
        first, second = first.take(random.permutation(n)), second.take(random.permutation(m))
    near = pairs(nearest_pairs(first, second, 1e-9))
    for part in np.linspace(0.0, 1.0, 9):
        places = at(first, np.full(len(first), part))
        nearest = distance(second, np.repeat(places[:, None], len(second), axis=1)).argmin(axis=1)
        assert set(enumerate(nearest.tolist())) <= near


def test_a_path_without_pieces_has_no_pairs() -> None:
    wall, nothing = piece_arrays(Path.from_pieces([Line((0.0, 0.0), (9.0, 0.0))])), piece_arrays(EMPTY)
    for first, second in ((wall, nothing), (nothing, wall), (nothing, nothing)):
        assert [len(rows) for rows in nearest_pairs(first, second, 1e-9)] == [0, 0]
    assert list(near_pairs_within(np.empty((4, 0)), 1.0)) == []


def test_nearest_pairs_of_short_chords_within_one_radius_are_few() -> None:
    wall, move = waves(2000, 1.0), waves(2000, 7.0)
    assert len(nearest_pairs(move, wall, 1e-9)[0]) < 8 * 2000


def test_nearest_pairs_stay_few_for_fine_chords_that_are_gouged() -> None:
    for count in (1000, 8000):
        wall, move = waves(count, 1.0), waves(count, 1.3)
        assert len(nearest_pairs(move, wall, 1e-9)[0]) < 4 * count
        assert len(nearest_pairs(wall, move, 1e-9)[0]) < 4 * count


@pytest.mark.parametrize("aside", [0.0, 1e-9, 1e-7, 1e-4])
@pytest.mark.parametrize("origin", [0.0, 1e3, 1e6])
def test_nearest_pairs_miss_nothing_for_nearly_coincident_pieces(aside: float, origin: float) -> None:
    random = np.random.default_rng(7)
    points = np.cumsum(random.normal(size=(201, 2)), axis=0) + origin
    shifted = points + random.normal(scale=aside, size=points.shape)
    first, second = (piece_arrays(Path.of(way, way[:-1], np.zeros(200, np.int8))) for way in (points, shifted))
    tie = 1e-9 + 1e-15 * origin
    i, j = nearest_pairs(first, second, tie)
    for part in random.uniform(size=40):
        places = at(first, np.full(len(first), part))
        least = distance(second, np.repeat(places[:, None], len(second), axis=1)).min(axis=1)
        found_distance = np.full(len(first), np.inf)
        np.minimum.at(found_distance, i, distance(second.take(j), places[i]))
        assert np.all(found_distance <= least + tie)
