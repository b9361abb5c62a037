"""Distances of points and pieces, by hand, against dense points and against shapely."""

from __future__ import annotations

from math import hypot, sqrt

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from core.geometry.distance import (
    band_fractions,
    distance,
    distances_at,
    farthest_fractions,
    foot,
    fractions_on_circle,
    fractions_on_line,
    nearest_fractions,
)
from core.geometry.path import Floats, Path
from core.geometry.piece import Arc, Line, Piece, Turn
from core.geometry.piece_arrays import PieceArrays, at, piece_arrays
from tests.core.verify import oracle
from tests.core.verify.shapes import circle, lines, moved, paths

HALF = Arc((2.0, 0.0), (-2.0, 0.0), (0.0, 0.0), Turn.CCW)


def piece_array(piece: Piece) -> PieceArrays:
    return piece_arrays(Path.from_pieces([piece]))


def pairs(first: Path, second: Path) -> tuple[PieceArrays, PieceArrays]:
    """Every piece of the one paired with every piece of the other."""
    i, j = np.divmod(np.arange(len(first) * len(second)), len(second))
    return piece_arrays(first).take(i), piece_arrays(second).take(j)


@pytest.fixture(autouse=True)
def quiet() -> object:
    with np.errstate(all="ignore"):
        yield


@pytest.mark.parametrize(
    ("piece", "point", "apart", "share"),
    [
        (Line((0, 0), (4, 0)), 1 + 3j, 3.0, 0.25),
        (Line((0, 0), (4, 0)), -3 + 4j, 5.0, 0.0),
        (Line((0, 0), (4, 0)), 7 - 4j, 5.0, 1.0),
        (HALF, 0 + 5j, 3.0, 0.5),
        (HALF, 0 + 1j, 1.0, 0.5),
        (HALF, 2 - 1j, 1.0, 0.0),
        (HALF, -3 - 1j, sqrt(2), 1.0),
        (HALF, -0.5 - 3j, hypot(1.5, 3.0), 1.0),
        (HALF, 0j, 2.0, 0.0),
        (circle((0.0, 0.0), 2.0)[0], 0 - 5j, 3.0, 0.75),
    ],
)
def test_a_point_beside_a_piece(piece: Piece, point: complex, apart: float, share: float) -> None:
    assert distance(piece_array(piece), np.array((point,)))[0] == pytest.approx(apart, abs=1e-12)
    assert foot(piece_array(piece), np.array((point,)))[0] == pytest.approx(share, abs=1e-12)
    elsewhere = piece_arrays(moved(Path.from_pieces([piece]), 0.0, (7.0, -3.0)))
    assert distance(elsewhere, np.array((point + 7 - 3j,)))[0] == pytest.approx(apart, abs=1e-12)
    assert foot(elsewhere, np.array((point + 7 - 3j,)))[0] == pytest.approx(share, abs=1e-12)


def test_meetings_with_a_line_and_a_circle() -> None:
    line = piece_array(Line((0, 0), (10, 0)))
    assert fractions_on_line(line, np.array((3 + 5j,)), np.array((1j,)))[0] == pytest.approx([0.3])
    assert fractions_on_circle(line, np.array((5 + 3j,)), np.array((5.0,)))[:, 0] == pytest.approx([0.1, 0.9])
    assert np.isnan(fractions_on_circle(line, np.array((5 + 6j,)), np.array((5.0,)))).all()
    met = fractions_on_circle(piece_array(HALF), np.array((0 + 2j,)), np.array((2.0,)))[:, 0]
    assert sorted(met) == pytest.approx([1 / 6, 5 / 6])
    assert sorted(
        fractions_on_line(piece_array(HALF), np.array((-9 + 1j,)), np.array((1.0 + 0j,)))[:, 0]
    ) == pytest.approx([1 / 6, 5 / 6])


def test_a_meeting_near_a_touch_on_a_huge_arc_keeps_its_digits() -> None:
    """A circle about a point r off the arc that reaches d beyond a touch meets the arc sqrt(2 r d) on."""
    size, r, beyond = 1.0e5, 0.3, 1e-9
    arc = piece_array(Arc((size, 0.0), (0.0, size), (0.0, 0.0), Turn.CCW))
    center = (size - r) * np.exp(0.5j)
    met = fractions_on_circle(arc, np.array((center,)), np.array((r + beyond,)))[:, 0] * arc.length
    assert met - 0.5 * size == pytest.approx([-sqrt(2 * r * beyond), sqrt(2 * r * beyond)], rel=0.1)


def dense(piece: Piece) -> Floats:
    return oracle.along(piece, np.linspace(0.0, 1.0, 1501))


@settings(deadline=None, max_examples=60, derandomize=True)
@given(paths(most=3), paths(most=3))
def test_extremes_are_among_the_places(first: Path, second: Path) -> None:
    piece, other = pairs(first, second)
    least = distances_at(piece, other, nearest_fractions(piece, other)).min(axis=0)
    inner = distances_at(piece, other, farthest_fractions(piece, other)).max(axis=0)
    ends = distances_at(piece, other, np.vstack((np.zeros(len(piece)), np.ones(len(piece))))).max(axis=0)
    for k in range(len(piece)):
        mine, theirs = first[k // len(second)], second.part(k % len(second), k % len(second) + 1)
        apart = oracle.apart(dense(mine), theirs)
        step = oracle.length(mine) / 3000 + 1e-9
        assert apart.min() - step <= least[k] <= apart.min() + 1e-9
        assert apart.max() - 1e-9 <= max(inner[k], ends[k]) <= apart.max() + step


@settings(deadline=None, max_examples=60, derandomize=True)
@given(paths(most=3), paths(most=3))
def test_between_band_places_the_distance_stays_on_one_side(first: Path, second: Path) -> None:
    piece, other = pairs(first, second)
    reach = np.full(len(piece), 0.77)
    places = band_fractions(piece, other, reach)
    assert np.all(np.diff(places, axis=0) >= 0.0)
    low, high = places[:-1], places[1:]
    for share in (0.1, 0.5, 0.9):
        near = distances_at(piece, other, low + share * (high - low)) < reach
        wide = high - low > 1e-6
        middle = distances_at(piece, other, (low + high) / 2) < reach
        assert np.all(near[wide] == middle[wide])


@settings(deadline=None, max_examples=40, derandomize=True)
@given(paths(most=4), paths(most=4))
def test_shapely_finds_the_same_distance_on_chords(first: Path, second: Path) -> None:
    piece, other = pairs(first, second)
    least = distances_at(piece, other, nearest_fractions(piece, other)).min()
    strings = [shapely.LineString(np.concatenate([dense(piece) for piece in path])) for path in (first, second)]
    assert shapely.distance(*strings) == pytest.approx(least, abs=1e-4)


def test_places_are_on_the_piece() -> None:
    piece, other = pairs(lines((0, 0), (4, 0)), circle((2.0, 0.0), 1.0))
    assert sorted(at(piece, nearest_fractions(piece, other)).real[:, 0].tolist())[0] == 0.0
    assert {round(x, 9) for x in at(piece, nearest_fractions(piece, other)).real[:, 0].tolist()} >= {0.0, 1.0, 3.0, 4.0}
