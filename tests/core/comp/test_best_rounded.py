"""The best path of contours whose numbers are rounded, as drawings carry them: neighbors that just miss tangency."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, sin

import numpy as np
import pytest

from core.comp.best_path.best_path import BestPath, best_path
from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.verify.judge import judge
from tests.core.comp.rounded import DECIMALS, drawing, widest_end_gap


def nearly_tangent(miss: float) -> Path:
    """A line, an arc whose center is not where tangency needs it, and lines back to the start."""
    arc = Arc((20.0, 0.0), (30.0, -10.0), (20.0 + miss, -10.0), Turn.CW)
    corners = [(30.0, -10.0), (30.0, -60.0), (90.0, -60.0), (90.0, 50.0), (0.0, 50.0), (0.0, 0.0)]
    back = [Line(*ends) for ends in pairwise(corners)]
    return Path.from_pieces([Line((0.0, 0.0), (20.0, 0.0)), arc, *back])


def assert_clean(contour: Path, side: Side, radius: float, best: BestPath) -> None:
    """All loops are closed and follow the contour's order, and the judge finds nothing wrong with them."""
    assert all(best.closed)
    for loop in best.loops:
        numbers = [*loop.numbers, loop.numbers[0]]
        assert sum(following < number for number, following in pairwise(numbers)) <= 1, "past START once"
    assert "BEST_BROKEN" not in {finding.code for finding in best.findings}
    verdict = judge(contour, side, radius, best.loops)
    assert (verdict.judged, verdict.gouges, verdict.wrong_side) == (True, (), ())


@pytest.mark.parametrize("miss", [sign * gap for gap in (2e-8, 2e-7, 1.4e-6, 1e-5, 1e-4) for sign in (-1, 1)])
@pytest.mark.parametrize("side", Side)
def test_neighbors_that_miss_tangency_by_a_rounding_give_one_closed_loop(miss, side):
    contour = nearly_tangent(miss)
    best = best_path(contour, side, 10.0, closed=True)
    assert len(best.loops) == 1
    assert_clean(contour, side, 10.0, best)


def test_the_largest_joined_gap_is_reported_once():
    """The arc's two radii are made one by moving its center half way back: so much of the miss stays at either end."""
    best = best_path(nearly_tangent(2e-6), Side.LEFT, 10.0, closed=True)
    (finding,) = best.findings
    assert (finding.code, finding.severity) == ("BEST_JOINED", Severity.INFO)
    assert finding.lengths == pytest.approx((1e-6, 0.0), abs=1e-10)
    assert finding.segment in (1.0, 2.0)
    place = (20.0, 10.0) if finding.segment == 1.0 else (40.0, -10.0)
    assert finding.at == pytest.approx(place, abs=2e-6)


@pytest.mark.parametrize("first", range(7))
def test_the_largest_gap_is_reported_wherever_the_contour_starts(first: int) -> None:
    pieces = list(nearly_tangent(2e-6))
    (finding,) = best_path(Path.from_pieces([*pieces[first:], *pieces[:first]]), Side.LEFT, 10.0, closed=True).findings
    assert finding.lengths == pytest.approx((1e-6, 0.0), abs=1e-10)
    # at one of the arc's two ends
    assert finding.segment in ((0 - first) % 7 + 1, (1 - first) % 7 + 1)


@pytest.mark.parametrize("miss", [0.0, *(sign * gap for gap in (1e-9, 1e-8, 9.9e-8, 1e-6) for sign in (-1, 1))])
def test_a_last_end_that_misses_start_by_a_rounding_leaves_no_side_uncut(miss):
    corners = [(0.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0), (miss, 0.0)]
    contour = Path.from_pieces([Line(*ends) for ends in pairwise(corners)])
    best = best_path(contour, Side.LEFT, 5.0, closed=True)
    # a radius on both sides of each corner
    assert judge(contour, Side.LEFT, 5.0, best.loops).uncut_length == pytest.approx(40.0, abs=0.01)


def test_a_tangent_contour_joins_nothing():
    assert best_path(nearly_tangent(0.0), Side.LEFT, 10.0, closed=True).findings == ()


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_a_drawing_gives_the_same_closed_loops_at_every_rounding(seed):
    part = drawing(seed)
    best = {decimals: part.best(decimals) for decimals in DECIMALS}
    for decimals, path in best.items():
        assert_clean(part.rounded(decimals), part.side, part.radius, path)
        assert widest_end_gap(path) <= 10.0**-decimals
        assert len(path.loops) == len(best[7].loops) or part.is_neck(decimals)


@pytest.mark.parametrize(("seed", "decimals"), [(47, 4), (291, 5), (527, 4), (1695, 5), (3112, 5)])
def test_neighbors_that_rounding_lets_run_past_each_other_are_cut_back_and_joined(seed: int, decimals: int) -> None:
    """Otherwise the path would turn straight back for a few nanometers, and gouge there."""
    part = drawing(seed)
    best = part.best(decimals)
    assert_clean(part.rounded(decimals), part.side, part.radius, best)
    for loop in best.loops:
        leaving = np.roll(loop.start_directions, -1, axis=0)
        assert (loop.end_directions * leaving).sum(axis=1).min() > -0.9


@pytest.mark.parametrize("side", Side)
def test_an_inside_radius_as_large_as_the_tool_s_to_a_rounding_closes(side):
    """The offset of such an arc is shorter than the gaps on both its sides."""
    for more in (-1e-5, -1e-6, -2e-7, 1.4e-7, 1e-6, 3e-6, 1e-5):
        size = 5.0 + more
        pieces: list[Piece] = [
            Line((0.0, 0.0), (40.0 - size, 0.0)),
            Arc((40.0 - size, 0.0), (40.0, size), (40.0 - size, size), Turn.CCW),
            Line((40.0, size), (40.0, 30.0)),
            Line((40.0, 30.0), (0.0, 30.0)),
            Line((0.0, 30.0), (0.0, 0.0)),
        ]
        contour = Path.from_pieces(pieces)
        best = best_path(contour, side, 5.0, closed=True)
        assert len(best.loops) == 1
        assert_clean(contour, side, 5.0, best)


def test_circles_of_two_uneven_arcs_close():
    rng = np.random.default_rng(7)
    for _ in range(80):
        size, swept, off = rng.uniform(1.0, 20.0), rng.uniform(0.3, 5.9), 10.0 ** rng.uniform(-9.0, -2.7)
        end = ((size + off) * cos(swept), (size + off) * sin(swept))
        arcs = [Arc((size, 0.0), end, (0.0, 0.0), Turn.CCW), Arc(end, (size, 0.0), (0.0, 0.0), Turn.CCW)]
        contour = Path.from_pieces(arcs)
        for side in Side:
            best = best_path(contour, side, 0.5, closed=True)
            assert len(best.loops) == 1
            assert_clean(contour, side, 0.5, best)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
@pytest.mark.parametrize("side", Side)
def test_a_sliver_of_an_arc_of_kilometers_is_followed(turn, side):
    """40 nm high over 34 mm: a radius of 3.6 km."""
    radius = 34.0**2 / (8.0 * 4e-5)
    center = (17.0, -int(turn) * -radius)
    pieces: list[Piece] = [
        Arc((0.0, 0.0), (34.0, 0.0), center, turn),
        Line((34.0, 0.0), (34.0, 20.0)),
        Arc((34.0, 20.0), (0.0, 20.0), (17.0, 20.0 - int(turn) * radius), turn),
        Line((0.0, 20.0), (0.0, 0.0)),
    ]
    contour = Path.from_pieces(pieces)
    best = best_path(contour, side, 3.0, closed=True)
    assert len(best.loops) == 1
    assert_clean(contour, side, 3.0, best)
    assert best.loops[0].lengths.sum() == pytest.approx(108.0 + (6.0 * pi if side is Side.RIGHT else -24.0), abs=0.01)
