"""A surface most of which has been looked at before meets itself where it would if all of it were new."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import cos, sin, tau
from random import Random

import numpy as np
import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Turn
from core.verify import crossing as module
from core.verify.course import Course, courses
from core.verify.crossing import crossings
from tests.core.verify.corpus import Chain
from tests.core.verify.shapes import lines

Points = list[tuple[float, float]]


@pytest.fixture(autouse=True)
def _as_the_judge_asks() -> Iterator[None]:
    with np.errstate(all="ignore"):
        yield


def course(path: Path) -> Course:
    (one,) = courses((path,))
    return one


def ring(random: Random, *, closed: bool) -> tuple[Points, list[float]]:
    """Corners round about, and the bulges of the sides between them."""
    count = random.choice((12, 30, 60))
    points = []
    for k in range(count):
        size = random.uniform(16.0, 20.0)
        points.append((size * cos(tau * k / count), size * sin(tau * k / count)))
    points += points[:1] if closed else []
    return points, [random.choice((0.0, 0.0, 0.2, -0.2)) for _ in points[1:]]


def edited(random: Random, points: Points, bulges: list[float]) -> Path:
    """Corners moved, a little, back along their sides or far away; or one side bent otherwise."""
    points, bulges = list(points), list(bulges)
    if random.random() < 0.5:
        bulges[random.randrange(len(bulges))] = random.choice((0.9, -0.9, 2.0, -2.0, 4.0, -4.0, 0.0))
        return Chain(tuple(points), tuple(bulges)).path()
    for _ in range(random.choice((1, 2))):
        row = random.randrange(len(points))
        (x, y), (before, _) = points[row], points[row - 1]
        points[row] = random.choice(((x + 0.01, y), (-x, -y), (0.0, 0.0), points[row - 2], (before, y), (1.5 * x, y)))
    return Chain(tuple(points), tuple(bulges)).path()


@pytest.mark.parametrize("seed", range(40))
def test_it_meets_itself_where_it_would_if_all_were_new(seed: int) -> None:
    random, free, met = Random(seed), 0, 0
    while free < 3:
        closed = random.random() < 0.7
        points, bulges = ring(random, closed=closed)
        before = course(Chain(tuple(points), tuple(bulges)).path())
        if len(crossings(before, closed=closed)):
            continue
        free += 1
        for _ in range(16):
            surface = course(edited(random, points, bulges))
            told, fresh = crossings(surface, closed=closed, free=before), crossings(surface, closed=closed)
            np.testing.assert_array_equal(told.places, fresh.places)
            np.testing.assert_array_equal(told.points, fresh.points)
            met += len(fresh) > 0
    assert met


@pytest.mark.parametrize(
    "moved",
    [
        ((0, 0), (9, 0), (9, 1), (9, 2), (9, 3), (0, 3), (0, 2), (0, 1), (3, -1), (0, 0)),
        ((0, 0), (9, 0), (9, 1), (9, 2), (9, 1.5), (0, 3), (0, 2), (0, 1), (0, 0.5), (0, 0)),
        ((0, 0), (9, 0), (9, 1), (9, 2), (9, 3), (0, 3), (0, 2), (0, 1), (6, 0), (0, 0)),
        ((0, 0), (0, 2.5), (9, 1), (9, 2), (9, 3), (0, 3), (0, 2), (0, 1), (0, 0.5), (0, 0)),
    ],
)
def test_the_one_corner_that_moved_is_enough(moved: Points) -> None:
    before = course(lines((0, 0), (9, 0), (9, 1), (9, 2), (9, 3), (0, 3), (0, 2), (0, 1), (0, 0.5), (0, 0)))
    assert not len(crossings(before, closed=True))
    assert len(crossings(course(lines(*moved)), closed=True, free=before))


CORNERS: Points = [(0, 0), (4, 0), (3, -1), (3, -2), (3, -3), (3, -9), (0, -9), (0, -2), (0, -1), (0, 0)]
HALF = Arc((4, 0), (3, -1), (3.5, -0.5), Turn.CW)
OVER = Arc((4, 0), (3, -1), (3, 0), Turn.CCW)
WIDE = Arc((4, 0), (3, -1), (-2, 5), Turn.CCW)


@pytest.mark.parametrize(("was", "now"), [(Line((4, 0), (3, -1)), OVER), (HALF, OVER), (HALF, WIDE)])
@pytest.mark.parametrize("turned", [False, True])
def test_the_one_side_that_was_bent_is_enough(was: Piece, now: Piece, *, turned: bool) -> None:
    """OVER comes back over the side before it, and meets nothing else."""
    sides: list[Piece] = [Line(one, other) for one, other in pairwise(CORNERS)]
    before, after = (Path.from_pieces([sides[0], side, *sides[2:]]) for side in (was, now))
    if turned:
        before, after = before.reversed(), after.reversed()
    assert not len(crossings(course(before), closed=True))
    assert len(crossings(course(after), closed=True))
    assert len(crossings(course(after), closed=True, free=course(before)))


def test_what_has_been_looked_at_is_not_looked_at_again(monkeypatch: pytest.MonkeyPatch) -> None:
    points, bulges = ring(Random(1), closed=True)
    before = course(Chain(tuple(points), tuple(bulges)).path())
    points[5] = (1.01 * points[5][0], points[5][1])
    monkeypatch.setattr(module, "aligned_pairs", None)
    assert not len(crossings(course(Chain(tuple(points), tuple(bulges)).path()), closed=True, free=before))
