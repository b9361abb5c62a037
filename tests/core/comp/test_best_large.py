"""The best path where the cutter is far larger than the segments, where an arc is far larger than the cutter, and where
a contour's end turns into itself."""

from __future__ import annotations

import numpy as np
import pytest

from core.comp.best_path.best_path import best_path
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.verify.judge import judge
from tests.core.comp.best_truth import assert_true, distance
from tests.core.comp.contours import lines


def test_a_cutter_hundreds_of_segments_wide_goes_over_teeth_and_steps():
    """Each tip's circle crosses hundreds of others: only the arcs between neighboring tips are left, and no loop is
    refused as tangled."""
    step = np.arange(2001)
    tips = [(0.1 * x, 0.3 * (x % 2)) for x in step.tolist()]
    best = best_path(lines(*tips), Side.LEFT, 20.0, closed=False)
    assert [len(loop) for loop in best.loops] == [1002]
    assert not best.findings
    assert distance(lines(*tips[900:1100]), best.loops[0].points[450:550]).min() > 20.0 - 1e-7


def hook(sweep: float) -> Path:
    """A line, an arc of radius 2 to the left and a line back by which the open contour's end comes inside."""
    center = 2j
    end = center - 2j * np.exp(1j * sweep)
    away = end + 1.2 * np.exp(1j * (sweep + 1.2))
    points = [(-4.0, 0.0), (0.0, 0.0), (end.real, end.imag), (away.real, away.imag)]
    return Path.from_pieces(
        [Line(points[0], points[1]), Arc(points[1], points[2], (0.0, 2.0), Turn.CCW), Line(points[2], points[3])]
    )


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize("sweep", [2.5, 3.2, 4.0, 4.8, 5.4])
@pytest.mark.parametrize("radius", [0.05, 0.3, 0.6, 0.9])
def test_an_open_contour_whose_end_turns_into_itself_is_cut_by_its_other_side_too(side, sweep, radius):
    assert_true(hook(sweep), side, radius, closed=False)


@pytest.mark.parametrize("inch", [False, True])
@pytest.mark.parametrize("size", [1e5, 1e6, 3e6, 9e6])
def test_arcs_of_kilometers_have_a_path_on_both_sides(size: float, inch: bool):
    """A joint of the surface is exactly the radius away from all of the offset that its own arc has there."""
    rng = np.random.default_rng(int(size))
    for _ in range(5):
        radius, turn, angles = size * rng.uniform(0.3, 1.1), rng.choice((-1, 1)), rng.uniform(0.0, 6.0, 2)
        ends = radius * np.array([(np.cos(angle), np.sin(angle)) for angle in angles])
        first, last = np.round(ends / 25.4, 5) * 25.4 if inch else np.round(ends, 4)
        for points in ((first, last), (first, last, first), (first, first)):
            count = len(points) - 1
            arcs = Path.of(np.array(points), np.zeros((count, 2)), np.full(count, turn, np.int8))
            for side in Side:
                best = best_path(arcs, side, 3.0, closed=bool((points[0] == points[-1]).all()))
                assert [finding.code for finding in best.findings] == []
                verdict = judge(arcs, side, 3.0, best.loops)
                assert verdict.judged
                assert not verdict.gouges
                assert not verdict.uncut


def test_s_curves_of_half_circles_are_no_crossing():
    points = np.stack((2.0 * np.arange(9.0), np.zeros(9)), axis=1)
    waves = Path.of(points, points[:-1] + np.array((1.0, 0.0)), np.where(np.arange(8) % 2, 1, -1).astype(np.int8))
    for side in Side:
        best = assert_true(waves, side, 0.25, closed=False)
        assert not best.findings
        assert [len(loop) for loop in best.loops] == [8]
