"""Air cuts and backward moves on paths small enough to check by hand."""

from __future__ import annotations

from math import cos, inf, pi, sin, sqrt

import pytest

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.verify.air_cuts import air_cuts
from core.verify.judge import judge
from tests.core.verify.shapes import around, circle, lines, square
from tests.core.verify.test_judge import CORNERS, MID_SIDE, MID_SIDE_PATH, R

WALL = lines((0, 0), (10, 0))


def backwards(surface: Path, radius: float, center: Path) -> tuple[int, ...]:
    return judge(surface, Side.LEFT, radius, center).backwards


def test_a_correct_path_has_no_air_cuts_or_backward_moves() -> None:
    for surface, path in ((MID_SIDE, MID_SIDE_PATH), (square(), around(CORNERS, R))):
        assert air_cuts(surface, R, path) == ()
        assert backwards(surface, R, path) == ()


def test_a_lead_cuts_air() -> None:
    path = Path.from_pieces([Arc((1, 3), (3, 1), (3, 3), Turn.CCW), Line((3, 1), (10, 1))], [1, 1])
    (away,) = air_cuts(WALL, 1.0, path)
    assert away.start == (1, 3)
    assert away.end == pytest.approx((3, 1), abs=1e-3)
    assert away.length == pytest.approx(pi, abs=1e-3)
    assert away.thickness == pytest.approx(2.0)
    assert away.thickest == pytest.approx((1, 3))


def test_a_detour_over_several_moves_is_one_stretch() -> None:
    (away,) = air_cuts(WALL, 1.0, lines((0, 1), (4, 1), (5, 2), (6, 1), (10, 1)))
    assert away.length == pytest.approx(2 * sqrt(2), abs=1e-6)
    assert (away.first_number, away.last_number) == (2, 3)
    assert away.thickest == pytest.approx((5, 2))
    assert away.thickness == pytest.approx(1.0)


def test_moves_against_the_contour_are_listed() -> None:
    assert backwards(WALL, 1.0, lines((0, 1), (6, 1), (4, 1), (10, 1))) == (1,)
    assert backwards(WALL, 1.0, lines((10, 1), (0, 1))) == (0,)
    assert backwards(WALL, 1.0, lines((0, 2), (10, 2))) == ()


def test_a_long_move_against_a_short_wall_is_backwards() -> None:
    assert backwards(lines((0, 0), (1, 0)), 1.0, lines((1, 1), (-20, 1))) == (0,)


def test_an_arc_in_the_opposite_direction_is_backwards() -> None:
    hole = circle((0, 0), 5.0)
    assert backwards(hole, 1.0, circle((0, 0), 4.0)) == ()
    assert backwards(hole, 1.0, circle((0, 0), 4.0, Turn.CW)) == (0,)


@pytest.mark.parametrize("sweep", [0.3, pi / 2.0, 3.0, 6.0])
@pytest.mark.parametrize("start", [0.0, 1.0, pi, 4.0])
def test_the_direction_of_a_full_circle_does_not_depend_on_its_start(sweep: float, start: float) -> None:
    ends = [(5.0 * cos(angle), 5.0 * sin(angle)) for angle in (0.0, sweep)]
    wall = Path.from_pieces([Arc(ends[0], ends[1], (0.0, 0.0), Turn.CCW)])
    place = (4.0 * cos(start), 4.0 * sin(start))
    for turn, expected in ((Turn.CCW, ()), (Turn.CW, (0,))):
        assert backwards(wall, 1.0, Path.from_pieces([Arc(place, place, (0.0, 0.0), turn)])) == expected


def test_a_move_in_a_slot_as_wide_as_the_cutter_is_not_backwards() -> None:
    slot = lines((0, 0), (10, 0), (10, 2), (0, 2))
    assert backwards(slot, 1.0, lines((0, 1), (9, 1))) == ()


def test_a_move_that_gouges_the_nearest_wall_is_not_backwards() -> None:
    slot = lines((0, 0), (10, 0), (10, 1.5), (0, 1.5))
    for path in (lines((9, 1), (1, 1)), lines((1, 1), (9, 1))):
        verdict = judge(slot, Side.LEFT, 1.0, path)
        assert verdict.gouges[0].depth == pytest.approx(0.5)
        assert verdict.backwards == ()


def test_paths_that_cannot_be_judged_have_no_air_cuts_or_backward_moves() -> None:
    for surface, path in ((EMPTY, MID_SIDE_PATH), (MID_SIDE, EMPTY), (MID_SIDE, lines((0, 0), (inf, 0)))):
        assert air_cuts(surface, R, path) == ()
        assert backwards(surface, R, path) == ()
