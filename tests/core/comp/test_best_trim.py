"""Inside corners of the best path, trimmed for a whole contour at once, are those of two neighbors alone."""

from __future__ import annotations

from cmath import rect
from math import pi
from random import Random

import numpy as np
import pytest

from core.comp.best_path.best_path import best_path
from core.comp.best_path.raw_offset import raw_offset, trimmed
from core.geometry.path import Path, as_complex
from core.geometry.piece import Side
from tests.core.comp.families import joined


def _chain(random: Random) -> tuple[Path, Side]:
    """Long lines that bend by at most a third of a turn, now left, now right, and the side that has the first corner
    inside."""
    places, way = [0j], random.uniform(0.0, 2.0 * pi)
    bends = [random.uniform(0.2, 2.0) * (-1) ** row for row in range(random.randint(2, 9))]
    for bend in (0.0, *bends):
        way += bend
        places.append(places[-1] + rect(random.uniform(8.0, 20.0), way))
    return joined(places), random.choice(list(Side))


@pytest.mark.parametrize("seed", range(60))
def test_all_joints_trimmed_at_once_are_those_trimmed_one_after_the_other(seed: int) -> None:
    random = Random(seed)
    contour, side = _chain(random)
    radius = random.choice((0.05, 0.5, 1.0))
    (whole,) = best_path(contour, side, radius, closed=False).loops
    made = as_complex(whole.points)
    corners = 0
    for row in range(len(contour) - 1):
        pair = contour.part(row, row + 2)
        (alone,) = best_path(pair, side, radius, closed=False).loops
        inner = as_complex(alone.points)[1:-1]
        corners += len(inner) == 1
        for place in inner:
            assert np.abs(made - place).min() <= 1e-9
    assert corners == sum(_inside(contour, side))
    assert len(made) == 2 + 2 * (len(contour) - 1) - corners


def _inside(contour: Path, side: Side) -> list[bool]:
    """Which corners of a chain of lines are inside ones."""
    span = np.diff(as_complex(contour.points))
    return [bool(bend > 0.0) for bend in side.sign * (np.conj(span[:-1]) * span[1:]).imag]


@pytest.mark.parametrize("seed", range(40))
def test_after_trimming_a_piece_is_followed_by_the_one_that_starts_at_its_end_or_by_none(seed: int) -> None:
    random, count = Random(seed), 60
    star = [rect(random.uniform(6.0, 10.0), 2.0 * pi * row / count) for row in range(count)]
    raw = raw_offset(joined([*star, star[0]]), Side.LEFT, 2.0, closed=True, crossing=False)
    found = trimmed(raw, Side.LEFT.sign, 2.0)
    assert len(found) < len(raw.raw)
    last = (found.following < 0).nonzero()[0]
    assert (found.following[last] == -1).all()
    assert not found.smooth[last].any()
    others = (found.following >= 0).nonzero()[0]
    assert np.abs(found.end[others] - found.start[found.following[others]]).max() <= 1e-9
