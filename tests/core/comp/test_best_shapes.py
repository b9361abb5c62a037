"""The best path of whole shapes: dumbbells, circles, gears, spirals, a pocket."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt

import numpy as np
import pytest

from core.comp.best_path.best_path import best_path
from core.comp.best_path.prepared_contour import winds
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests.core.comp.best_truth import CLOSE, assert_true, only
from tests.core.comp.contours import lines


def circle(radius: float, turn: Turn = Turn.CCW) -> Path:
    return Path.from_pieces([Arc((radius, 0.0), (radius, 0.0), (0.0, 0.0), turn)])


def test_a_dumbbell_with_a_narrow_neck_splits_into_two_loops():
    dumbbell = lines(
        (0, 0), (2, 0), (2, 0.8), (3, 0.8), (3, 0), (5, 0), (5, 2), (3, 2), (3, 1.2), (2, 1.2), (2, 2), (0, 2), (0, 0)
    )
    best = assert_true(dumbbell, Side.LEFT, 0.25, closed=True)
    assert best.closed == (True, True)
    assert [loop.numbers[0] for loop in best.loops] == [1, 3.5]
    left, right = (loop.points for loop in best.loops)
    assert left[:, 0].max() < 2.5 < right[:, 0].min()


def test_a_dumbbell_with_a_wide_neck_is_one_loop():
    dumbbell = lines(
        (0, 0), (2, 0), (2, 0.5), (3, 0.5), (3, 0), (5, 0), (5, 2), (3, 2), (3, 1.5), (2, 1.5), (2, 2), (0, 2), (0, 0)
    )
    assert only(dumbbell, Side.LEFT, 0.25).numbers.tolist() == [
        1,
        2,
        2.5,
        3,
        3.5,
        4,
        5,
        6,
        7,
        8,
        8.5,
        9,
        9.5,
        10,
        11,
        12,
    ]


@pytest.mark.parametrize("turn", [Turn.CCW, Turn.CW])
def test_a_full_circle_is_its_own_offset(turn):
    inside = Side.LEFT if turn is Turn.CCW else Side.RIGHT
    for side, radius in ((inside, 0.75), (Side.RIGHT if inside is Side.LEFT else Side.LEFT, 1.25)):
        loop = only(circle(1.0, turn), side, 0.25)
        assert (len(loop), loop.turns[0]) == (1, turn)
        assert loop.points == pytest.approx(np.array([(radius, 0), (radius, 0)]), abs=CLOSE)


def test_there_is_no_path_inside_a_circle_of_the_radius_of_the_cutter():
    for radius in (1.0, 1.5):
        best = best_path(circle(1.0), Side.LEFT, radius, closed=True)
        assert best.loops == ()
        assert [finding.code for finding in best.findings] == ["NO_PATH"]


def test_the_path_outside_a_lens_has_two_corner_arcs():
    lens = Path.from_pieces(
        [Arc((-1.0, 0.0), (1.0, 0.0), (0.0, 1.0), Turn.CCW), Arc((1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), Turn.CCW)]
    )
    out = only(lens, Side.RIGHT, 0.5)
    assert out.numbers.tolist() == [1, 1.5, 2, 2.5]
    radius = sqrt(2)
    assert out.lengths.sum() == pytest.approx(2 * (radius + 0.5) * pi / 2 + 2 * 0.5 * pi / 2, abs=CLOSE)
    inside = only(lens, Side.LEFT, 0.2)
    assert inside.numbers.tolist() == [1, 2]
    assert inside.points[0] == pytest.approx((-sqrt((radius - 0.2) ** 2 - 1), 0), abs=CLOSE)


def test_a_big_cutter_around_a_star_runs_on_corner_arcs_only():
    angles = [k * pi / 5 for k in range(10)]
    tips = [((1.0, 0.3)[k % 2] * cos(angle), (1.0, 0.3)[k % 2] * sin(angle)) for k, angle in enumerate(angles)]
    star = lines(*tips, tips[0])
    loop = only(star, Side.RIGHT, 5.0)
    assert loop.numbers.tolist() == [2.5, 4.5, 6.5, 8.5, 10.5]
    assert loop.radii == pytest.approx(np.full(5, 5.0), abs=CLOSE)


def gear(teeth: int) -> Path:
    """Root arcs and tip arcs about the center with radial flanks."""
    pieces: list[Arc | Line] = []
    for tooth in range(teeth):
        angles = [2 * pi * (tooth + part) / teeth for part in (0.0, 0.5, 1.0)]
        a, b, c, d = (
            (radius * cos(angle), radius * sin(angle))
            for radius, angle in ((8.0, angles[0]), (8.0, angles[1]), (10.0, angles[1]), (10.0, angles[2]))
        )
        end = (8.0 * cos(angles[2]), 8.0 * sin(angles[2])) if tooth < teeth - 1 else (8.0, 0.0)
        pieces += [Arc(a, b, (0.0, 0.0), Turn.CCW), Line(b, c), Arc(c, d, (0.0, 0.0), Turn.CCW), Line(d, end)]
    return Path.from_pieces(pieces)


def test_a_cutter_around_a_gear_enters_gaps_it_fits_in():
    teeth = 12
    loop = only(gear(teeth), Side.RIGHT, 0.5)
    assert np.count_nonzero(np.mod(loop.numbers, 4) == 1) == teeth
    assert np.hypot(*loop.points.T).min() == pytest.approx(8.5, abs=CLOSE)


def test_a_cutter_too_big_for_the_gaps_of_a_gear_stays_on_the_tips():
    loop = only(gear(12), Side.RIGHT, 1.5)
    assert not np.isin(np.mod(loop.numbers, 4), (0, 1, 2)).any()
    assert np.hypot(*loop.points.T).min() > 10.0


def spiral(turns: int) -> Path:
    """Counterclockwise half circles outwards, with walls 1 apart."""
    pieces, x = [], 0.0
    for k in range(turns):
        end = x + (k + 1.0) * (k % 2 * 2 - 1)
        pieces.append(Arc((x, 0.0), (end, 0.0), ((x + end) / 2, 0.0), Turn.CCW))
        x = end
    return Path.from_pieces(pieces)


def test_a_spiral_is_followed_to_its_ends_if_the_cutter_fits_between_its_walls():
    for side, shift in ((Side.LEFT, -0.45), (Side.RIGHT, 0.45)):
        path = only(spiral(8), side, 0.45, closed=False)
        assert path.numbers.tolist() == [1, 2, 3, 4, 5, 6, 7, 8]
        assert path.radii == pytest.approx(np.arange(0.5, 4.5, 0.5) + shift, abs=CLOSE)


def test_only_the_outermost_turn_of_a_spiral_tighter_than_the_cutter_is_followed():
    assert best_path(spiral(8), Side.LEFT, 0.51, closed=False).findings[0].code == "NO_PATH"
    assert only(spiral(8), Side.RIGHT, 0.51, closed=False).numbers.tolist() == [7, 8]


def test_the_path_in_a_nearly_closed_hook_starts_where_the_cutter_passes_its_end():
    path = only(lines((0, 0), (4, 0), (4, 4), (0, 4), (0, 0.4), (3, 0.4)), Side.LEFT, 0.5, closed=False)
    expected = [(3 + sqrt(0.5**2 - 0.1**2), 0.5), (3.5, 0.5), (3.5, 3.5), (0.5, 3.5), (0.5, 0.9), (3, 0.9)]
    assert path.points == pytest.approx(np.array(expected), abs=CLOSE)


def test_a_cusp_has_a_corner_arc_outside_only():
    cusp = Path.from_pieces([Line((0.0, 0.0), (2.0, 0.0)), Arc((2.0, 0.0), (1.0, 1.0), (2.0, 1.0), Turn.CW)])
    outside = only(cusp, Side.RIGHT, 0.25, closed=False)
    assert outside.numbers.tolist() == [1, 1.5, 2]
    best = assert_true(cusp, Side.LEFT, 0.25, closed=False)
    assert 1.5 not in np.concatenate([loop.numbers for loop in best.loops])


POCKET = Path.from_pieces(
    [
        Line((2.0, 0.25), (4.0, 0.25)),
        Arc((4.0, 0.25), (4.75, 1.0), (4.0, 1.0), Turn.CCW),
        Line((4.75, 1.0), (4.75, 3.0)),
        Arc((4.75, 3.0), (4.25, 3.5), (4.25, 3.0), Turn.CCW),
        Line((4.25, 3.5), (3.0, 3.5)),
        Line((3.0, 3.5), (2.5, 3.0)),
        Line((2.5, 3.0), (1.0, 3.0)),
        Arc((1.0, 3.0), (0.5, 3.5), (1.0, 3.5), Turn.CW),
        Line((0.5, 3.5), (0.25, 3.5)),
        Line((0.25, 3.5), (0.25, 0.25)),
        Line((0.25, 0.25), (2.0, 0.25)),
    ]
)


def test_a_slot_that_is_too_narrow_beside_a_boss_is_left_out():
    loop = only(POCKET, Side.LEFT, 0.25)
    assert loop.points[0] == pytest.approx((2, 0.5), abs=CLOSE)
    assert 9 not in loop.numbers.tolist()
    row = loop.numbers.tolist().index(8)
    assert loop.points[row + 1] == pytest.approx((0.5, 3.5 - sqrt(0.75**2 - 0.5**2)), abs=CLOSE)


@pytest.mark.parametrize("turn", [Turn.CCW, Turn.CW])
@pytest.mark.parametrize(("degrees_turned", "wound"), [(90.0, False), (170.0, False), (185.0, True), (200.0, True)])
def test_an_open_contour_winds_from_half_a_turn_on_in_both_directions(turn, degrees_turned, wound):
    angle = radians(degrees_turned)
    end = (10 + 2 * sin(angle), turn * (2 - 2 * cos(angle)))
    last = (end[0] + 4 * cos(angle), end[1] + 4 * turn * sin(angle))
    hook = Path.from_pieces([Line((0, 0), (10, 0)), Arc((10, 0), end, (10, 2 * turn), turn), Line(end, last)])
    assert winds(hook, 2.1) is wound


@pytest.mark.parametrize("side", list(Side))
def test_a_contour_that_goes_around_twice_is_cut_once(side):
    square = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (0.0, 5.0)]
    (once,) = best_path(lines(*square, square[0]), side, 1.0, closed=True).loops
    best = best_path(lines(*square, *square, square[0]), side, 1.0, closed=True)
    assert best.closed == (True,)
    assert best.loops[0].lengths.sum() == pytest.approx(once.lengths.sum())
