"""A surface that has been looked at for one path serves others, and never another surface."""

from __future__ import annotations

import pytest

from core.geometry.path import EMPTY
from core.geometry.piece import Side
from core.verify.judge import Ground, judge, judge_on_ground, rulings
from tests.core.verify.shapes import lines, square

PLATE = square(40.0)
ROUND = lines((-3, -3), (43, -3), (43, 43), (-3, 43), (-3, -3))
THROUGH = lines((-3, -3), (43, 2), (43, 43))


def known() -> Ground:
    _, ground = judge_on_ground(PLATE, Side.RIGHT, 3.0, (ROUND,))
    assert ground is not None
    return ground


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("radius", [3.0, 1.0, -1.0])
def test_other_sides_and_radii_are_judged_over_it_as_anew(side: Side, radius: float) -> None:
    for ruling, path in zip(rulings(PLATE, side, radius, (ROUND, THROUGH), known()), (ROUND, THROUGH), strict=True):
        alone, verdict = judge(PLATE, side, radius, path), ruling.verdict
        assert ruling.clean == verdict.clean
        assert (verdict.gouges, verdict.wrong_side, verdict.judged) == (alone.gouges, alone.wrong_side, alone.judged)
        assert verdict.uncut == alone.uncut


def test_that_of_another_surface_is_not_used() -> None:
    smaller = square(20.0)
    (ruling,) = rulings(smaller, Side.RIGHT, 3.0, (lines((-3, -3), (23, 2)),), known())
    assert ruling.verdict.gouges == judge(smaller, Side.RIGHT, 3.0, lines((-3, -3), (23, 2))).gouges
    assert ruling.verdict.gouges


def test_no_surface_and_what_is_not_judged_leave_none() -> None:
    assert judge_on_ground(EMPTY, Side.LEFT, 1.0, (ROUND,))[1] is None
    assert judge_on_ground(PLATE, Side.LEFT, float("nan"), (ROUND,))[1] is None
