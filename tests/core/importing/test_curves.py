"""Ellipses and B-splines become few tangent arcs within FIT."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely

from core.geometry.piece import Arc, Line, Piece
from core.importing.curves import pieces_of_ellipse, pieces_of_spline
from core.importing.drawing import BSpline, EllipseArc
from tests.core.importing.drawings import ELLIPSES


def sampled(pieces: list[Piece], step: float) -> np.ndarray:
    """Points on the pieces, at most a step apart."""
    points = [complex(*pieces[0].start)]
    for piece in pieces:
        count = max(math.ceil(piece.length / step), 1)
        points += [complex(*piece.point_at(part / count)) for part in range(1, count + 1)]
    return np.array(points)


def apart(pieces: list[Piece], curve: np.ndarray, fit: float) -> float:
    """The Hausdorff distance between pieces and the points of a curve."""
    ours = sampled(pieces, max(fit * 5, 0.02))
    return max(_farthest(ours, curve), _farthest(curve, ours))


def _farthest(points: np.ndarray, curve: np.ndarray) -> float:
    """The largest distance of points from a line through the points of a curve."""
    rows = np.column_stack((curve.real, curve.imag))
    tree = shapely.STRtree(shapely.linestrings(np.stack((rows[:-1], rows[1:]), axis=1)))
    spots = shapely.points(points.real, points.imag)
    _, away = tree.query_nearest(spots, return_distance=True, all_matches=False)
    return float(away.max())


def turns_at_joints(pieces: list[Piece]) -> float:
    """The largest change of direction between consecutive pieces, in radians."""
    changes = []
    for first, second in itertools.pairwise(pieces):
        u, v = complex(*first.direction_at(first.end)), complex(*second.direction_at(second.start))
        changes.append(abs(np.angle(v / u)))
    return max(changes, default=0.0)


@pytest.mark.parametrize("case", ELLIPSES, ids=lambda case: f"{case['ellipse']}-{case['tolerance']}")
def test_an_ellipse_has_few_tangent_arcs_within_fit(case: dict[str, Any]) -> None:
    a, b = map(float, case["ellipse"])
    pieces = pieces_of_ellipse(EllipseArc(0j, complex(a), 1j * b, 0.0, 2 * math.pi), case["tolerance"])
    assert len(pieces) <= 1.25 * case["arcs"]
    assert turns_at_joints([*pieces, pieces[0]]) < 1e-6
    at = np.linspace(0.0, 2 * math.pi, 20001)
    assert apart(pieces, a * np.cos(at) + 1j * b * np.sin(at), case["tolerance"]) <= case["tolerance"] * 1.001
    assert sum(piece.length for piece in pieces) == pytest.approx(case["perimeter"], rel=2e-4)


def test_part_of_a_slanted_ellipse_keeps_its_ends() -> None:
    shape = EllipseArc(3 + 2j, 10 + 4j, -1 + 6j, 0.3, 2.9)
    pieces = pieces_of_ellipse(shape, 0.002)
    at = np.linspace(0.3, 2.9, 20001)
    curve = shape.center + np.cos(at) * shape.first + np.sin(at) * shape.second
    assert complex(*pieces[0].start) == pytest.approx(curve[0], abs=1e-9)
    assert complex(*pieces[-1].end) == pytest.approx(curve[-1], abs=1e-9)
    assert apart(pieces, curve, 0.002) <= 0.002


def test_a_degenerate_ellipse_becomes_lines() -> None:
    pieces = pieces_of_ellipse(EllipseArc(0j, 10 + 0j, 0j, 0.0, 2 * math.pi), 0.005)
    assert all(isinstance(piece, Line) for piece in pieces)
    assert sum(piece.length for piece in pieces) == pytest.approx(40.0)


def spline(points: list[complex], degree: int = 3, weights: list[float] | None = None) -> BSpline:
    inner = len(points) - degree
    knots = [0.0] * (degree + 1) + [float(k) for k in range(1, inner)] + [float(inner)] * (degree + 1)
    return BSpline(degree, np.array(points), np.array(weights or [1.0] * len(points)), np.array(knots))


def de_boor(shape: BSpline, count: int) -> np.ndarray:
    """`count` points in each span of a B-spline by de Boor's recursion, independent of the Bezier spans."""
    p, knots = shape.degree, shape.knots
    spans = itertools.pairwise(np.unique(knots))
    rows = np.column_stack((shape.points * shape.weights, shape.weights.astype(complex)))
    result = []
    for t in np.concatenate([np.linspace(begin, end, count) for begin, end in spans]):
        k = min(max(int(np.searchsorted(knots, t, side="right")) - 1, p), len(rows) - 1)
        d = [rows[j + k - p] for j in range(p + 1)]
        for r in range(1, p + 1):
            for j in range(p, r - 1, -1):
                low, high = knots[j + k - p], knots[j + 1 + k - r]
                share = (t - low) / (high - low)
                d[j] = (1 - share) * d[j - 1] + share * d[j]
        result.append(d[p][0] / d[p][1])
    return np.array(result)


@pytest.mark.parametrize("degree", [2, 3, 4])
@pytest.mark.parametrize("fit", [0.01, 0.001])
def test_a_spline_is_within_fit_in_both_directions(degree: int, fit: float) -> None:
    points = [0j, 10 + 15j, 25 - 5j, 40 + 20j, 55 + 3j, 60 + 30j, 30 + 45j]
    shape = spline(points, degree)
    pieces = pieces_of_spline(shape, fit)
    assert turns_at_joints(pieces) < 1e-3
    assert apart(pieces, de_boor(shape, 1001), fit) <= fit * 1.001


@pytest.mark.parametrize("gap", [1e-9, 1e-7, 1e-6, 1e-4, 1e-2])
def test_a_spline_with_nearly_equal_knots_is_within_fit(gap: float) -> None:
    points = [0j, 9.5 - 3j, 21.5 - 19j, 41.5 - 20.4j, 71.3 + 6.2j, 108.3 + 21.4j, 117.7 + 24.8j]
    knots = [0.0, 0, 0, 0, 1, 1 + gap, 1 + 2 * gap, 2, 2, 2, 2]
    shape = BSpline(3, np.array(points), np.ones(7), np.array(knots))
    assert apart(pieces_of_spline(shape, 0.005), de_boor(shape, 1001), 0.005) <= 0.005 * 1.02


def test_random_splines_with_spans_of_very_different_lengths_are_within_fit() -> None:
    rng = np.random.default_rng(11)
    for _ in range(20):
        corners = np.cumsum(rng.uniform(1.0, 30.0, 8) * np.exp(1j * np.cumsum(rng.uniform(-0.7, 0.7, 8))))
        inner = np.cumsum(10.0 ** rng.uniform(-5.0, 0.0, 4))
        knots = np.concatenate((np.zeros(4), inner, np.full(4, inner[-1] + 10.0 ** rng.uniform(-5.0, 0.0))))
        shape = BSpline(3, corners, np.ones(8), knots)
        assert apart(pieces_of_spline(shape, 0.005), de_boor(shape, 301), 0.005) <= 0.005 * 1.02


@pytest.mark.parametrize("center", [0j, 37.1 - 12.3j, 1000 / 3 + 200 / 7 * 1j])
@pytest.mark.parametrize("turned", [1 + 0j, 0.6 + 0.8j, -0.8 + 0.6j])
def test_a_weighted_spline_that_is_a_circle_is_one_arc(center: complex, turned: complex) -> None:
    root = math.sqrt(0.5)
    corners = [10 + 0j, 10 + 10j, 10j, -10 + 10j, -10 + 0j, -10 - 10j, -10j, 10 - 10j, 10 + 0j]
    knots = [0.0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
    rows = center + turned * np.array(corners)
    pieces = pieces_of_spline(BSpline(2, rows, np.array([1.0, root] * 4 + [1.0]), np.array(knots)), 0.005)
    assert len(pieces) == 1
    assert isinstance(pieces[0], Arc)
    assert pieces[0].start == pieces[0].end
    assert complex(*pieces[0].center) == pytest.approx(center)
    assert pieces[0].radius == pytest.approx(10.0)


def test_a_spline_keeps_its_corners() -> None:
    # a knot repeated as often as the degree gives two straight halves
    shape = BSpline(
        3,
        np.array([0j, 5 + 0j, 8 + 0j, 10 + 0j, 10 + 2j, 10 + 5j, 10 + 10j]),
        np.ones(7),
        np.array([0.0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]),
    )
    pieces = pieces_of_spline(shape, 0.005)
    assert pieces == [Line((0.0, 0.0), (10.0, 0.0)), Line((10.0, 0.0), (10.0, 10.0))]


def test_a_curve_that_ends_at_a_corner_has_no_extra_arcs() -> None:
    # two arches that meet at a corner; each end has the direction of the curve there
    arch = [0j, 2 + 8j, 12 + 9j, 20 + 0j]
    knots = np.array([0.0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2])
    both = BSpline(3, np.array([*arch, *(20 + point for point in arch[1:])]), np.ones(7), knots)
    alone = len(pieces_of_spline(spline(arch), 0.005))
    pieces = pieces_of_spline(both, 0.005)
    assert len(pieces) == 2 * alone
    assert apart(pieces, de_boor(both, 10001), 0.005) <= 0.005 * 1.001


def test_a_spline_of_degree_one_becomes_its_lines() -> None:
    pieces = pieces_of_spline(spline([0j, 10 + 0j, 10 + 5j, 3 + 9j], 1), 0.005)
    assert [piece.end for piece in pieces] == [(10.0, 0.0), (10.0, 5.0), (3.0, 9.0)]


def test_arcs_are_at_least_ten_times_fit_long_if_fit_allows() -> None:
    rng = np.random.default_rng(15)
    count, fit = int(rng.integers(6, 12)), 0.05
    points = np.cumsum(np.exp(1j * np.cumsum(rng.normal(scale=0.9, size=count)))) * 6
    knots = np.concatenate((np.zeros(3), np.arange(count - 2), np.full(3, count - 3))).astype(float)
    pieces = pieces_of_spline(BSpline(3, points, np.ones(count), knots), fit)
    assert min(piece.length for piece in pieces) >= 10.0 * fit
    assert turns_at_joints(pieces) < 1e-6


def test_quarters_of_an_ellipse_and_equal_ellipses_have_equal_arcs() -> None:
    near = pieces_of_ellipse(EllipseArc(0j, 30 + 0j, 20j, 0.0, math.tau), 0.005)
    far = pieces_of_ellipse(EllipseArc(300 + 70j, 30 + 0j, 20j, 0.0, math.tau), 0.005)
    lengths = sorted(piece.length for piece in near)
    assert len(near) % 4 == 0
    assert lengths == pytest.approx(sorted(piece.length for piece in far))
    assert min(piece.center[0] for piece in far if isinstance(piece, Arc)) > 250
    quarters = [lengths[row : row + 2] for row in range(0, len(lengths), 2)]
    assert all(first == pytest.approx(second) for first, second in quarters)
