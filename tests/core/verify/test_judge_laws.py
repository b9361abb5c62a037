"""What holds of every verdict: it agrees with dense points, and with itself when the whole drawing is moved."""

from __future__ import annotations

from math import isnan
from random import Random

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Side
from core.tolerance import GOUGE
from core.verify.judge import judge
from tests.core.verify import oracle
from tests.core.verify.shapes import lines, mirrored, moved, paths
from tests.core.verify.test_sides import star

NASTY = st.sampled_from((0.0, 1.0, -1.0, 2.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-200, 5e-324, 1e7, -9.9e6, 0.1, 1e4))


@st.composite
def nasty_paths(draw: st.DrawFn) -> Path:
    """Paths of repeated points, arcs without radius, radii that do not fit, coordinates of any size."""
    count = draw(st.integers(0, 5))
    points = np.array([draw(st.tuples(NASTY, NASTY)) for _ in range(count + 1)])
    turns = np.array([draw(st.sampled_from((0, 0, 1, -1))) for _ in range(count)], np.int8)
    centers = [
        points[k] if not turns[k] or draw(st.booleans()) else (points[k] + points[k + 1]) / 2 for k in range(count)
    ]
    return Path.of(points, np.array(centers).reshape(-1, 2), turns)


@settings(deadline=None, max_examples=120, derandomize=True)
@given(nasty_paths(), nasty_paths(), st.sampled_from((0.0, 1e-7, 0.5, 1.0, 1e3, 1e7)), st.sampled_from(Side))
def test_nothing_is_raised_whatever_the_paths(surface: Path, center: Path, radius: float, side: Side) -> None:
    verdict = judge(surface, side, radius, center)
    assert verdict.judged != isnan(verdict.clearance)
    assert all(np.isfinite((gouge.depth, gouge.extent, *gouge.at, *gouge.surface_at)).all() for gouge in verdict.gouges)
    assert all(np.isfinite((stretch.length, *stretch.start, *stretch.end)).all() for stretch in verdict.uncut)


@pytest.mark.parametrize("size", [5e-324, 1e-310, 1e-200, 1e-163, 1e-155])
@pytest.mark.parametrize("radius", [0.0, 1.0])
def test_a_segment_so_short_that_its_square_is_nothing_is_a_point(size: float, radius: float) -> None:
    surface, point = lines((0.0, 0.0), (size, 0.0)), lines((0.0, 0.0), (0.0, 0.0))
    path = lines((1.0, 0.0), (20.0, 2.0), (0.0, -5.0), (size, 2.0))
    verdict, alike = judge(surface, Side.LEFT, radius, path), judge(point, Side.LEFT, radius, path)
    assert verdict.clearance == pytest.approx(alike.clearance)
    assert len(verdict.gouges) == len(alike.gouges)
    assert judge(path, Side.LEFT, radius, surface).judged


STEP = 4e-3


@settings(deadline=None, max_examples=30, derandomize=True)
@given(paths(), paths(), st.sampled_from((0.1, 0.5, 1.0, 2.5)))
def test_dense_points_say_the_same(surface: Path, center: Path, radius: float) -> None:
    verdict = judge(surface, Side.LEFT, radius, center)
    # the runs beyond a crossing are no surface
    assume(verdict.over_run_at is None)
    least = oracle.least(center, surface, STEP)
    assert least - STEP / 2 - 1e-9 < verdict.clearance < least + 1e-9
    steps = 4.0 * STEP * len(center) * len(surface)
    gouged = sum(gouge.extent for gouge in verdict.gouges)
    least, most = (oracle.length_near(center, surface, radius - GOUGE + hair, STEP) for hair in (-1e-8, 1e-8))
    assert least - steps <= gouged <= most + steps
    cut = verdict.surface_length - verdict.uncut_length
    least, most = (oracle.length_near(surface, center, radius + hair, STEP) for hair in (-1e-8, 1e-8))
    assert least - steps <= cut <= most + steps
    points, _ = oracle.samples(surface, STEP)
    thickest = max(0.0, float(oracle.apart(points, center).max()) - radius)
    told = max((stretch.thickness for stretch in verdict.uncut), default=0.0)
    assert thickest - 1e-6 < told < thickest + STEP


@settings(deadline=None, max_examples=30, derandomize=True)
@given(paths(), paths(), st.sampled_from((0.1, 0.5, 1.0, 2.5)))
def test_every_reported_place_is_as_far_away_as_reported(surface: Path, center: Path, radius: float) -> None:
    verdict = judge(surface, Side.LEFT, radius, center)
    for gouge in verdict.gouges:
        (apart,) = oracle.apart(np.array([gouge.at]), surface)
        # where all of the cutter is behind the surface, the gouge ends short of the radius by what is no gouge
        behind = gouge.depth > radius
        assert abs(radius - gouge.depth) == pytest.approx(apart, abs=2e-6 if behind else 1e-9)
        assert np.hypot(*np.subtract(gouge.at, gouge.surface_at)) == pytest.approx(apart, abs=1e-9)
        (on_piece,) = oracle.apart(np.array([gouge.at]), center.part(gouge.path_piece, gouge.path_piece + 1))
        assert on_piece < 1e-9
    for stretch in verdict.uncut:
        (apart,) = oracle.apart(np.array([stretch.thickest]), center)
        assert radius + stretch.thickness == pytest.approx(apart, abs=1e-7)


@settings(deadline=None, max_examples=30, derandomize=True)
@given(paths(), paths(), st.sampled_from((0.1, 1.0)), st.floats(-3.0, 3.0), st.sampled_from((0.5, 25.4)))
def test_motion_changes_nothing(surface: Path, center: Path, radius: float, angle: float, scale: float) -> None:
    verdict = judge(surface, Side.LEFT, radius, center)
    there = [moved(path, angle, (30.0, -7.0), scale) for path in (surface, center)]
    other = judge(there[0], Side.LEFT, radius * scale, there[1])
    assert other.clearance == pytest.approx(verdict.clearance * scale, abs=1e-6)
    assert other.depth == pytest.approx(verdict.depth * scale, abs=1e-5)
    assert other.uncut_length == pytest.approx(verdict.uncut_length * scale, abs=1e-2)
    flipped = judge(mirrored(surface), Side.RIGHT, radius, mirrored(center))
    assert flipped.clean == verdict.clean
    assert flipped.wrong_side == verdict.wrong_side
    back = judge(surface.reversed(), Side.RIGHT, radius, center)
    assert back.depth == pytest.approx(verdict.depth, abs=1e-7)
    assert back.uncut_length == pytest.approx(verdict.uncut_length, abs=1e-4)
    assert back.wrong_side == verdict.wrong_side


def _loops(random: Random, surface: Path) -> list[Path]:
    """Paths along and across a surface: correct ones of several radii, one moved, and lines across the whole."""
    found = [
        compensate(surface, side, random.choice((0.1, 0.3, 0.9)), 20, closed=True).path
        for side in random.choices(list(Side), k=3)
    ]
    x, y = random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0)
    shifted = moved(found[0], random.uniform(-0.1, 0.1), (random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)))
    return random.sample([*(path for path in found if len(path)), shifted, lines((x, -12), (x, y), (12, y))], 3)


@pytest.mark.parametrize("seed", range(30))
def test_loops_judged_together_are_judged_as_each_alone(seed: int) -> None:
    """Of gouges at the end of one loop and the start of the next the deeper one stands for both; less stays uncut."""
    random = Random(seed)
    surface, side, radius = star(random), random.choice(list(Side)), random.choice((0.1, 0.3, 0.5))
    loops = _loops(random, surface)
    together, alone = judge(surface, side, radius, loops), [judge(surface, side, radius, one) for one in loops]
    first = np.cumsum([0, *(len(loop) for loop in loops)]).tolist()
    depths = sorted(
        (gouge.path_piece + row, gouge.surface_number, gouge.depth)
        for row, verdict in zip(first, alone, strict=False)
        for gouge in verdict.gouges
    )
    for gouge in together.gouges:
        assert any(
            (gouge.path_piece, gouge.surface_number) == (row, number) and gouge.depth == pytest.approx(depth, abs=1e-8)
            for row, number, depth in depths
        )
    assert together.depth == pytest.approx(max(one.depth for one in alone), abs=1e-8)
    gouged = sum(gouge.extent for one in alone for gouge in one.gouges)
    assert sum(gouge.extent for gouge in together.gouges) == pytest.approx(gouged, abs=1e-5)
    # where a contour crosses itself sides are asked outside of gouges only
    for name in ("backwards", "may_cut_air", *(() if together.crosses_itself else ("wrong_side",))):
        rows = [row + k for row, one in zip(first, alone, strict=False) for k in getattr(one, name)]
        assert list(getattr(together, name)) == rows
    assert together.clearance == pytest.approx(min(one.clearance for one in alone), abs=1e-12)
    assert together.clean == all(one.clean for one in alone)
    assert together.uncut_length <= min(one.uncut_length for one in alone) + 1e-9
    assert (
        together.uncut_length
        >= together.surface_length - sum(one.surface_length - one.uncut_length for one in alone) - 1e-9
    )
