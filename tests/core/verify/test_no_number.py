"""Invalid numbers are never clean: no finding is lost in a false comparison."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import numpy as np
import pytest
from numpy.typing import NDArray

from core.geometry.path import Path
from core.geometry.piece import Arc, Side, Turn
from core.geometry.piece_arrays import piece_arrays
from core.verify.air_cuts import air_cuts
from core.verify.gouge import gouging
from core.verify.judge import judge, judge_prepared
from core.verify.pairs import NotMeasurableError, measurable, pairs_of, rounding_of
from core.verify.surface import Surface
from tests.core.verify.shapes import lines

WALL, DEEP = lines((0, 0), (10, 0), (20, 0)), lines((1, 0.5), (9, 0.5), (19, 0.5))


ODD = (1e7, -1e7, 9.9e6, 1e6, 1e-7, 1e-9, 1e-10, 1e-160, 5e-324, 0.0)


def _odd_path(random: np.random.Generator) -> Path:
    """Pieces of any size, repeated points, and arcs about their own ends or distant centers."""
    count, size = int(random.integers(1, 8)), 10.0 ** float(random.integers(-9, 7))
    points = random.integers(-4, 5, (count + 1, 2)) * (size if random.random() < 0.5 else 10.0)
    odd = np.flatnonzero(random.random(points.size) < 0.05)
    points.flat[odd] = random.choice(ODD, len(odd))
    again = random.random(count) < 0.15
    points[1:][again] = points[:-1][again]
    turns = random.choice((0, 0, 1, -1), count)
    span = points[1:] - points[:-1]
    aside = np.stack((-span[:, 1], span[:, 0]), axis=1) * 10.0 ** random.integers(-9, 6, (count, 1))
    centers = (points[:-1] + points[1:]) / 2.0 + aside * random.choice((-1.0, 0.0, 1.0), (count, 1))
    own = random.random(count) < 0.1
    centers[own] = points[1:][own]
    return Path.of(points, np.where(turns[:, None] == 0, points[:-1], centers), turns.astype(np.int8))


def _places(path: Path) -> NDArray[np.float64]:
    """(17 n, 2) points on pieces; on an uneven arc they are between both radii."""
    share, radial = np.linspace(0.0, 1.0, 17)[:, None, None], path.starts - path.centers
    angle = share[..., 0] * path.sweeps
    turned = np.stack(
        (
            radial[:, 0] * np.cos(angle) - radial[:, 1] * np.sin(angle),
            radial[:, 0] * np.sin(angle) + radial[:, 1] * np.cos(angle),
        ),
        axis=2,
    )
    straight = path.starts + share * (path.ends - path.starts)
    return np.where(path.turns[:, None] == 0, straight, path.centers + turned).reshape(-1, 2)


@pytest.mark.parametrize("seed", range(3))
def test_findings_on_odd_paths_have_finite_numbers(seed: int) -> None:
    random, judged, gouged = np.random.default_rng(seed), 0, 0
    for _ in range(50):
        surface, center = _odd_path(random), _odd_path(random)
        radius = float(10.0 ** random.uniform(-6.0, 6.0))
        verdict = judge(surface, Side.LEFT, radius, center)
        air_cuts(surface, radius, center)
        # the ends beyond a crossing are no surface
        if not verdict.judged or verdict.over_run_at is not None:
            continue
        judged += 1
        values = [number for one in verdict.gouges for number in (one.depth, *one.at, *one.surface_at, one.extent)]
        values += [number for one in verdict.uncut for number in (one.length, one.thickness, *one.thickest)]
        assert np.isfinite([verdict.clearance, verdict.surface_length, *values]).all()
        one, other = _places(surface), _places(center)
        least = np.hypot(*(one[:, None] - other).transpose(2, 0, 1)).min()
        # allows for uneven radii and the last digits of ten kilometers
        assert verdict.clearance <= least + 0.006
        gouged += least < radius - 0.01
        assert verdict.depth >= radius - least - 0.01
    assert judged > 8
    assert gouged > 2


ROUND = Path.from_pieces([Arc((0.0, 0.0), (20.0, 0.0), (10.0, 0.0), Turn.CCW)])


@pytest.mark.parametrize(("contour", "column"), [(WALL, "vector"), (WALL, "start"), (ROUND, "start")])
def test_a_wall_at_an_invalid_distance_is_not_judged(contour: Path, column: str) -> None:
    """A comparison would ignore it, and the path along it would be clean."""
    surface = Surface.prepare(contour, Side.LEFT)
    far = lines((-50, 30), (-60, 30))
    for path in (DEEP, far):
        assert judge_prepared(surface, 1.0, [path]).judged
        values = getattr(surface.walls, column).copy()
        values[-1] = nan
        spoiled = replace(surface, walls=replace(surface.walls, **{column: values}))
        verdict = judge_prepared(spoiled, 1.0, [path])
        assert not verdict.judged
        assert not verdict.clean


@pytest.mark.parametrize("column", ["start", "arm"])
def test_gouges_at_an_invalid_distance_are_not_left_out(column: str) -> None:
    contour, path = (ROUND, Path.from_pieces([Arc((1.0, 0.0), (19.0, 0.0), (10.0, 0.0), Turn.CCW)]))
    walls, moves = piece_arrays(contour), piece_arrays(path)
    with np.errstate(all="ignore"):
        pairs = pairs_of(moves, walls, rounding_of(walls))
        assert len(gouging(pairs, 2.0))
    values = getattr(moves, column) * nan
    with np.errstate(all="ignore"), pytest.raises(NotMeasurableError):
        gouging(replace(pairs, pieces=replace(moves, **{column: values})), 2.0)


@pytest.mark.parametrize("bad", [nan, np.inf, -np.inf, 1e300, 1.1e7])
@pytest.mark.parametrize("where", ["points", "centers"])
def test_invalid_numbers_are_never_judged(bad: float, where: str) -> None:
    for row in range(2):
        for axis in range(2):
            arrays = {"points": DEEP.points.copy(), "centers": DEEP.centers.copy()}
            arrays[where][row, axis] = bad
            path = Path(arrays["points"], arrays["centers"], DEEP.turns, DEEP.numbers)
            assert not measurable(1.0, WALL, path)
            assert not judge(WALL, Side.LEFT, 1.0, path).judged
            assert not judge(path, Side.LEFT, 1.0, [WALL, DEEP]).judged
            assert not judge(path, Side.LEFT, 1.0, DEEP).clean
