"""The judge against a slow one on many contours, with correct and spoiled paths.

`python -m tests.core.verify.test_brute [seeds]` compares more of them.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from math import cos, inf, pi, sin, tau
from random import Random

import numpy as np
import pytest

from core.comp.best_path.best_path import best_path
from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Arc, Side, Turn
from core.tolerance import STOCK
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.verify import oracle
from tests.core.verify.brute import Slow, point_to, slow
from tests.core.verify.corpus import Chain, gouged
from tests.core.verify.shapes import circle, moved


def _spots(random: Random, count: int) -> list[tuple[float, float]]:
    return [(round(random.uniform(-5, 5), 3), round(random.uniform(-5, 5), 3)) for _ in range(count)]


def wander(random: Random) -> Path:
    """A random chain that usually crosses itself."""
    spots = _spots(random, random.randint(2, 7))
    return Chain(tuple(spots), tuple(random.choice((0.0, 0.0, 0.4, -0.7, 1.0)) for _ in spots[1:])).path()


def convex(random: Random) -> Path:
    """A closed convex outline that starts at a corner or mid-side."""
    count = random.randint(3, 14)
    angles = sorted(random.uniform(0, tau) for _ in range(count))
    spots = [(5 * cos(a), 5 * sin(a)) for a in angles]
    share = random.choice((0.0, 0.5))
    (x0, y0), (x1, y1) = spots[-1], spots[0]
    spots.insert(0, (x0 + share * (x1 - x0), y0 + share * (y1 - y0)))
    bulges = [0.0, *(random.choice((0.0, 0.1)) for _ in range(count - 1)), 0.0]
    spots = [*spots, spots[0]] if share else [*spots[:1], *spots[1:]]
    return Chain(tuple(spots), tuple(bulges[: len(spots) - 1])).path()


def walls(random: Random) -> Path:
    """Slots and fins about as wide as the cutter, with parallel walls."""
    width, x, spots = random.choice((1.0, 1.0, 0.98, 1.02, 1.3)), 0.0, [(0.0, 0.0)]
    for k in range(random.randint(2, 6)):
        y = 3.0 if k % 2 == 0 else random.choice((0.0, 0.5))
        spots.append((x, y))
        x += width if k % 2 == 0 else random.choice((0.0, width, 2.0))
        spots.append((x + 1e-3 * (spots[-1] == (x, y)), y))
    return Chain(tuple(dict.fromkeys(spots)), (0.0,) * (len(dict.fromkeys(spots)) - 1)).path()


def spiral(random: Random) -> Path:
    """A spiral of lines or arcs, with turns closer or farther apart than the cutter is wide."""
    grow, step = random.choice((0.1, 0.16, 0.3)), random.choice((0.3, 0.7, 1.2))
    angles = np.arange(0.0, random.uniform(6.0, 16.0), step)
    spots = [((0.5 + grow * a) * cos(a), (0.5 + grow * a) * sin(a)) for a in angles.tolist()]
    bulge = random.choice((0.0, float(np.tan(step / 4.0))))
    return Chain(tuple(spots), (bulge,) * (len(spots) - 1)).path()


def waves(random: Random) -> Path:
    """Small steps under a large cutter."""
    x = np.arange(0.0, random.uniform(1.0, 3.0), random.choice((0.1, 0.25)))
    y = random.choice((0.05, 0.4, 1.0)) * np.sin(random.choice((1.0, 2.5, 6.0)) * x)
    return Chain(tuple(zip(x.tolist(), y.tolist(), strict=True)), (0.0,) * (len(x) - 1)).path()


def rounds(random: Random) -> Path:
    """A full circle, or consecutive large arcs about one center."""
    if random.random() < 0.4:
        return circle((random.uniform(-2, 2), 1.0), random.choice((0.4, 0.5, 2.0)), random.choice((Turn.CW, Turn.CCW)))
    pieces, radius, angle = [], 2.0, 0.0
    for _ in range(random.randint(1, 3)):
        sweep = random.choice((0.3, pi, 4.0, 5.9))
        ends = [(radius * cos(a), radius * sin(a)) for a in (angle, angle + sweep)]
        pieces.append(Arc(ends[0], ends[1], (0.0, 0.0), Turn.CCW))
        angle += sweep
    return Path.from_pieces(pieces)


FAMILIES: tuple[Callable[[Random], Path], ...] = (wander, convex, walls, spiral, waves, rounds)


def centers(random: Random, surface: Path) -> Iterator[tuple[Side, float, Path]]:
    """Paths along a surface: the control's and the best path, with other radii, slightly or badly spoiled."""
    side, radius = random.choice(list(Side)), random.choice((0.1, 0.5, 0.5, 1.3))
    closed = bool(np.hypot(*(surface.points[0] - surface.points[-1])) < 1e-6)
    control_path = compensate(surface, side, radius, random.choice((1, 3, 20)), closed=closed).path
    loops = best_path(surface, side, radius, closed=closed).loops
    for path in (control_path, *loops[:1]):
        if not len(path):
            continue
        yield side, radius, path
        yield side, radius * random.choice((0.998, 1.00002, 0.5)), path
        yield side, radius, moved(path, 10.0 ** random.uniform(-7, -1), (10.0 ** random.uniform(-8, 0), 0.0))
        if np.all(path.starts == path.ends, axis=1).any():
            continue
        index, size = random.randrange(len(path.points)), 10.0 ** random.uniform(-7, 0)
        x, y = path.points[index].tolist()
        yield side, radius, Chain.of(path).moved(index, x + size, y - size / 3.0).path()


@pytest.mark.parametrize("family", FAMILIES)
def test_the_judge_agrees_with_the_slow_judge(family: Callable[[Random], Path]) -> None:
    assert compared(family, 0, 3) > 9


def compared(family: Callable[[Random], Path], seed: int, contours: int) -> int:
    """The number of paths judged by both."""
    random, count = Random(f"{family.__name__} {seed}"), 0
    for _ in range(contours):
        surface = family(random)
        for side, radius, path in centers(random, surface):
            if len(path):
                agree(surface, side, radius, path)
                count += 1
    return count


def agree(surface: Path, side: Side, radius: float, path: Path) -> None:
    """The judge agrees with the slow judge, which knows no over-runs and gets the contour without them."""
    verdict = judge(surface, side, radius, path)
    if verdict.over_run is not None:
        surface = _between_leads(surface, verdict.over_run.at)
    truth = slow(surface, radius, path, STOCK)
    _agree(verdict, truth, surface, radius, path)
    _as_deep(verdict, truth, surface, side, path)


def _between_leads(surface: Path, crossing: tuple[float, float]) -> Path:
    """The contour with its first and last piece cut at their crossing."""
    points, centers = surface.points.copy(), surface.centers.copy()
    points[0] = points[-1] = crossing
    if not surface.turns[0]:
        centers[0] = crossing
    return Path.of(points, centers, surface.turns, surface.numbers)


def _as_deep(verdict: Verdict, truth: Slow, surface: Path, side: Side, path: Path) -> None:
    """The depth agrees; behind an open contour it is at least that of the nearest place."""
    inside_depth, radius = -inf, verdict.radius
    closed = bool(np.hypot(*(surface.points[0] - surface.points[-1])) < 1e-6)
    if closed and not verdict.crosses_itself:
        room_inside = (oracle.turning(surface) > 0.0) == (side is Side.LEFT)
        inside_depth = oracle.deepest(path, surface, truth.step, room_inside=room_inside)
    depth = gouged(radius, truth.clearance, inside_depth)
    if inside_depth > 0.0:
        assert verdict.depth == pytest.approx(depth, abs=1e-6)
        assert verdict.wrong_side or inside_depth < 1e-5
    elif closed or verdict.crosses_itself or verdict.depth <= radius:
        assert verdict.depth == pytest.approx(depth, abs=1e-9)
    else:
        assert depth < verdict.depth <= 2.0 * radius
        assert verdict.wrong_side


def _agree(verdict: Verdict, truth: Slow, surface: Path, radius: float, path: Path) -> None:
    assert verdict.judged
    assert verdict.clearance == pytest.approx(truth.clearance, abs=1e-9)
    steps = truth.step * (2.0 * len(path) + 2.0 * len(verdict.gouges) + 2.0)
    assert sum(gouge.extent for gouge in verdict.gouges) == pytest.approx(truth.gouging, abs=steps)
    thickest = max((stretch.thickness for stretch in verdict.uncut), default=0.0)
    # dense points may miss a short stretch, which its own values then prove
    assert thickest > (truth.farthest - radius if truth.farthest - radius > STOCK else 0.0) - 1e-6
    for stretch in verdict.uncut:
        farthest = min(point_to(piece, *stretch.thickest) for piece in path)
        assert stretch.thickness == pytest.approx(farthest - radius, abs=1e-8)
    # stretches are told whole where they are thicker than STOCK somewhere, dense points count only where they are
    # an overlap along the first wall counts once
    left = min(truth.left, verdict.surface_length)
    assert verdict.uncut_length > left - truth.step * (2.0 * len(surface) + 2.0 * len(verdict.uncut) + 2.0)
    for stretch in verdict.uncut:
        assert stretch.length <= verdict.surface_length + 1e-9


if __name__ == "__main__":
    parser = argparse.ArgumentParser("tests.core.verify.test_brute", description=__doc__)
    parser.add_argument("seeds", type=int, nargs="?", default=10, help="seeds for each family of contours")
    seeds = range(parser.parse_args().seeds)
    print(sum(compared(family, seed, 5) for family in FAMILIES for seed in seeds), "paths are judged alike")
