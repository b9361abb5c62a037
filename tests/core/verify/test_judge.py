"""The judge against numbers calculated by hand."""

from __future__ import annotations

from math import inf, isnan, nan, pi, sqrt

import numpy as np
import pytest

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.tolerance import GOUGE
from core.verify.judge import judge
from tests.core.verify.shapes import around, circle, lines, moved, square

R = 0.25
OVER_RUN = lines((-1, 0), (2, 0), (2, 2), (0, 2), (0, -1))
OVER_RUN_PATH = lines((-1, -R), (-R, -R), (-R, -1))
MID_SIDE = lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))
MID_SIDE_PATH = lines((1, R), (1.75, R), (1.75, 1.75), (R, 1.75), (R, R), (1, R))
CORNERS = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)]


def test_a_path_at_the_outer_corner_of_an_over_run_square_leaves_all_of_it_uncut() -> None:
    verdict = judge(OVER_RUN, Side.RIGHT, R, OVER_RUN_PATH)
    assert verdict.clean
    assert verdict.over_run_at == pytest.approx((0.0, 0.0))
    assert not verdict.crosses_itself
    assert verdict.crossing_at is None
    assert verdict.clearance == pytest.approx(sqrt(2.0) * R, abs=1e-12)
    assert verdict.surface_length == pytest.approx(8.0)
    assert verdict.uncut_length == pytest.approx(8.0, abs=1e-9)
    (stretch,) = verdict.uncut
    assert (stretch.first_number, stretch.last_number) == (1.0, 4.0)
    assert stretch.thickest == pytest.approx((2.0, 2.0))
    assert stretch.thickness == pytest.approx(2.25 * sqrt(2) - R)
    assert stretch.area is None


def over_run_path(radius: float = R) -> Path:
    """The path around the square with all four sides kept."""
    pieces: list[Piece] = [
        Line((-1, -radius), (2, -radius)),
        Arc((2, -radius), (2 + radius, 0), (2, 0), Turn.CCW),
        Line((2 + radius, 0), (2 + radius, 2)),
        Arc((2 + radius, 2), (2, 2 + radius), (2, 2), Turn.CCW),
        Line((2, 2 + radius), (0, 2 + radius)),
        Arc((0, 2 + radius), (-radius, 2), (0, 2), Turn.CCW),
        Line((-radius, 2), (-radius, -1)),
    ]
    return Path.from_pieces(pieces, [1, 1.5, 2, 2.5, 3, 3.5, 4])


def test_a_path_that_keeps_every_segment_of_an_over_run_square_is_clean() -> None:
    verdict = judge(OVER_RUN, Side.RIGHT, R, over_run_path())
    assert verdict.clean
    assert verdict.over_run_at == pytest.approx((0.0, 0.0))
    assert verdict.uncut == ()


def test_a_path_too_near_to_an_over_run_square_gouges_it() -> None:
    verdict = judge(OVER_RUN, Side.RIGHT, R, over_run_path(R - 0.01))
    assert not verdict.clean
    assert verdict.depth == pytest.approx(0.01)


def test_an_over_run_into_the_part_is_a_crossing() -> None:
    verdict = judge(OVER_RUN, Side.LEFT, R, lines((-1, R), (1.75, R), (1.75, 1.75), (R, 1.75), (R, -1)))
    assert verdict.over_run_at is None
    assert verdict.crosses_itself
    assert verdict.crossing_at == pytest.approx((0.0, 0.0))
    assert not verdict.clean


def test_a_crossing_without_the_first_segment_is_no_over_run() -> None:
    ell = lines((-1, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4), (0, -1), (-1, -1))
    verdict = judge(ell, Side.RIGHT, R, lines((-1, -R), (-R, -R), (-R, -1)))
    assert verdict.over_run_at is None
    assert verdict.crosses_itself


def test_arcs_that_over_run_are_lead_in_and_lead_out() -> None:
    leaf = Path.from_pieces(
        [Arc((-1, -0.5), (4, 2), (0.75, 2.25), Turn.CCW), Line((4, 2), (0, 2)), Line((0, 2), (0, -2.5))]
    )
    verdict = judge(leaf, Side.RIGHT, R, lines((9, 9), (8, 9)))
    assert verdict.over_run_at is not None
    assert verdict.over_run_at[0] == pytest.approx(0.0, abs=1e-9)
    assert verdict.clean


def test_the_path_inside_a_square_leaves_each_corner_uncut() -> None:
    verdict = judge(MID_SIDE, Side.LEFT, R, MID_SIDE_PATH)
    assert verdict.clean
    assert not verdict.crosses_itself
    assert [(stretch.first_number, stretch.last_number) for stretch in verdict.uncut] == [
        (1, 2),
        (2, 3),
        (3, 4),
        (4, 5),
    ]
    for stretch in verdict.uncut:
        assert stretch.length == pytest.approx(2 * R, abs=1e-9)
        assert stretch.thickness == pytest.approx((sqrt(2) - 1) * R, abs=1e-9)


def test_an_uncut_inside_corner_at_the_start_is_one_stretch() -> None:
    verdict = judge(square(), Side.LEFT, R, lines((R, R), (1.75, R), (1.75, 1.75), (R, 1.75), (R, R)))
    assert [(stretch.first_number, stretch.last_number) for stretch in verdict.uncut] == [
        (1, 2),
        (2, 3),
        (3, 4),
        (4, 1),
    ]
    assert verdict.uncut[-1].thickest == pytest.approx((0.0, 0.0), abs=1e-12)


def test_the_path_outside_a_square_is_clean_and_cuts_all_of_it() -> None:
    verdict = judge(square(), Side.RIGHT, R, around(CORNERS, R))
    assert verdict.clean
    assert verdict.uncut == ()
    assert verdict.clearance == pytest.approx(R, abs=1e-12)


def test_a_path_that_starts_at_an_inside_corner_gouges_the_other_wall() -> None:
    verdict = judge(square(), Side.LEFT, R, lines((0, R), (1.75, R), (1.75, 1.75), (R, 1.75), (R, 0)))
    assert [gouge.depth for gouge in verdict.gouges] == pytest.approx([R, R])
    assert sorted(gouge.surface_number for gouge in verdict.gouges) == [1, 4]
    assert verdict.wrong_side == ()


def test_the_depth_of_a_gouge_of_an_arc_is_exact() -> None:
    verdict = judge(circle((0.0, 0.0), 2.0), Side.LEFT, 0.5, circle((0.1, 0.0), 1.5))
    (gouge,) = verdict.gouges
    assert gouge.depth == pytest.approx(0.1, abs=1e-12)
    assert gouge.at == pytest.approx((1.6, 0.0))
    assert gouge.surface_at == pytest.approx((2.0, 0.0))
    assert verdict.clearance == pytest.approx(0.4)
    assert gouge.extent == pytest.approx(1.5 * pi, abs=0.11)
    (stretch,) = verdict.uncut
    assert stretch.thickness == pytest.approx(0.1, abs=1e-9)
    assert stretch.thickest == pytest.approx((-2.0, 0.0), abs=1e-3)


def test_a_gouge_counts_only_beyond_the_tolerance() -> None:
    wall = lines((0, 0), (10, 0))
    assert judge(wall, Side.LEFT, 1.0, lines((0, 1 - GOUGE * 0.9), (10, 1 - GOUGE * 0.9))).clean
    assert not judge(wall, Side.LEFT, 1.0, lines((0, 1 - GOUGE * 1.1), (10, 1 - GOUGE * 1.1))).clean


def test_a_long_gouge_over_several_moves_is_one_gouge() -> None:
    verdict = judge(lines((0, 0), (10, 0)), Side.LEFT, 1.0, lines((0, 2), (2, 0.5), (4, 0.25), (6, 0.5), (8, 2)))
    (gouge,) = verdict.gouges
    assert gouge.depth == pytest.approx(0.75)
    assert gouge.at == pytest.approx((4.0, 0.25))


def test_the_uncut_stretch_under_an_arc_is_thickest_in_the_middle() -> None:
    verdict = judge(lines((0, 0), (10, 0)), Side.LEFT, 1.0, Path.from_pieces([Arc((0, 1), (10, 1), (5, 1), Turn.CW)]))
    (stretch,) = verdict.uncut
    assert stretch.thickest == pytest.approx((5.0, 0.0), abs=1e-6)
    assert stretch.thickness == pytest.approx(sqrt(26) - 1, abs=1e-7)


def test_a_path_on_the_wrong_side_is_reported_at_any_distance() -> None:
    inside = lines((0.5, 0.5), (1.5, 0.5), (1.5, 1.5), (0.5, 1.5), (0.5, 0.5))
    verdict = judge(square(), Side.RIGHT, 0.5, inside)
    assert verdict.gouges == ()
    assert verdict.wrong_side == (0, 1, 2, 3)
    assert not verdict.clean
    assert judge(square(), Side.RIGHT, 0.125, lines((1, 1), (1.25, 1.25))).wrong_side == (0,)
    assert judge(square(), Side.LEFT, 0.125, lines((1, 1), (1.25, 1.25))).clean
    assert judge(square(), Side.LEFT, 0.125, lines((4, 4), (5, 4))).wrong_side == (0,)


def test_all_directions_beyond_a_sharp_point_are_outside() -> None:
    needle = lines((0, 0), (10, -0.1), (0, -0.2), (0, 0))
    for y in (-3.0, -0.1, 3.0):
        assert judge(needle, Side.LEFT, 1.0, lines((11.5, y), (13, y))).clean
        assert judge(needle, Side.RIGHT, 1.0, lines((11.5, y), (13, y))).wrong_side == (0,)


def test_an_open_contour_has_no_side_beyond_its_ends() -> None:
    wall = lines((0, 0), (10, 0))
    assert judge(wall, Side.LEFT, 1.0, lines((-3, -3), (-3, 3))).clean
    assert judge(wall, Side.LEFT, 1.0, lines((0, 1), (10, 1), (14, 1))).clean
    assert judge(wall, Side.LEFT, 1.0, lines((5, -3), (6, -3))).wrong_side == (0,)


def test_the_ends_of_an_over_run_have_no_side_but_its_walls_have_one() -> None:
    beside = lines((-0.5, 0.5), (-0.5, 1.5))
    assert judge(OVER_RUN, Side.RIGHT, R, beside).clean
    assert judge(OVER_RUN, Side.RIGHT, R, lines((1.0, 0.5), (1.0, 1.5))).wrong_side == (0,)


def test_all_is_uncut_without_a_path() -> None:
    verdict = judge(square(), Side.LEFT, R, EMPTY)
    assert verdict.clearance == inf
    assert verdict.uncut_length == pytest.approx(8.0)
    assert verdict.uncut[0].thickness == inf
    assert verdict.clean


def test_an_empty_surface_has_no_gouges_and_no_uncut_stretches() -> None:
    verdict = judge(EMPTY, Side.LEFT, R, MID_SIDE_PATH)
    assert verdict.clearance == inf
    assert verdict.uncut == ()
    assert verdict.gouges == ()


@pytest.mark.parametrize("bad", [nan, inf, -inf, 1e300, 1e8])
def test_invalid_lengths_are_never_clean(bad: float) -> None:
    for surface, radius, center in (
        (lines((0, 0), (bad, 0)), R, MID_SIDE_PATH),
        (square(), R, lines((1, 1), (1, bad))),
        (square(), bad, MID_SIDE_PATH),
    ):
        verdict = judge(surface, Side.LEFT, radius, center)
        assert not verdict.judged
        assert not verdict.clean
        assert isnan(verdict.clearance)
    assert not judge(square(), Side.LEFT, -1.0, MID_SIDE_PATH).clean


def test_pieces_without_length_are_ignored() -> None:
    surface = lines((0, 0), (2, 0), (2, 0), (2, 2), (0, 2), (0, 0), (0, 0))
    path = lines((1, R), (1, R), (1.75, R), (1.75, 1.75), (R, 1.75), (R, 1.75), (R, R), (1, R))
    verdict = judge(surface, Side.LEFT, R, path)
    assert verdict.clean
    assert not verdict.crosses_itself
    assert verdict.uncut_length == pytest.approx(8 * R)
    point = judge(square(), Side.LEFT, R, lines((1, 0.1), (1, 0.1)))
    assert point.depth == pytest.approx(0.15)


def test_the_tolerance_includes_the_radius_difference_of_an_uneven_arc() -> None:
    surface = Path.from_pieces([Arc((10.0, 0.0), (0.0, 10.002), (0.0, 0.0), Turn.CCW)])
    path = Path.from_pieces([Arc((9.0, 0.0), (0.0, 9.002), (0.0, 0.0), Turn.CCW)])
    assert judge(surface, Side.LEFT, 1.0, path).clean
    assert judge(surface, Side.LEFT, 1.0, path).radius_slack == pytest.approx(0.002)


@pytest.mark.parametrize("sweep", [5.0, 45.0, 90.0, 180.0, 300.0])
@pytest.mark.parametrize("difference", [0.002, -0.0127, 0.05])
def test_an_uneven_arc_and_its_offset_share_one_radius_difference(sweep: float, difference: float) -> None:
    """The offset of an uneven arc about its center is equally uneven: it is the radius away everywhere."""

    def spiral(radius: float) -> Path:
        angle, last = np.radians(sweep).item(), radius + difference
        end = (last * np.cos(angle).item(), last * np.sin(angle).item())
        return Path.from_pieces([Arc((radius, 0.0), end, (0.0, 0.0), Turn.CCW)])

    for offset, side in ((-4.0, Side.LEFT), (4.0, Side.RIGHT)):
        wall, center = spiral(10.0), spiral(10.0 + offset)
        verdict = judge(wall, side, 4.0, center, arc_tolerance=0.1)
        assert not verdict.gouges
        assert verdict.radius_slack == pytest.approx(abs(difference))
        deep = judge(wall, side, 4.0 + 1.3 * abs(difference), center, arc_tolerance=0.1)
        assert deep.depth == pytest.approx(1.3 * abs(difference), rel=0.2)


def test_uneven_arcs_about_two_centers_add_their_radius_differences() -> None:
    wall = Path.from_pieces([Arc((10.0, 0.0), (0.0, 10.002), (0.0, 0.0), Turn.CCW)])
    path = Path.from_pieces([Arc((9.0, 0.0), (0.5, 8.501), (0.5, 0.0), Turn.CCW)])
    assert judge(wall, Side.LEFT, 1.0, path).radius_slack == pytest.approx(0.003)


def test_an_uneven_arc_is_judged_up_to_the_accepted_radius_difference() -> None:
    wall = Path.from_pieces([Arc((10.0, 0.0), (0.0, 10.0), (0.0, 0.0), Turn.CCW)])
    spiral = Path.from_pieces([Arc((9.0, 0.0), (0.0, 9.01), (0.0, 0.0), Turn.CCW)])
    refused = judge(wall, Side.LEFT, 1.0, spiral)
    assert not refused.judged
    assert refused.uneven_arc is not None
    assert refused.uneven_arc.difference == pytest.approx(0.01)
    assert not refused.uneven_arc.on_surface
    accepted = judge(wall, Side.LEFT, 1.0, spiral, arc_tolerance=0.0127)
    assert accepted.clean
    assert accepted.radius_slack == pytest.approx(0.01)
    deep = judge(wall, Side.LEFT, 1.02, spiral, arc_tolerance=0.0127)
    assert deep.depth == pytest.approx(0.02, abs=0.0101)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_an_uneven_arc_with_both_ends_on_one_ray_is_not_judged(turn: Turn) -> None:
    """The arc may be empty or a full circle that gouges the wall; with equal radii it is empty."""
    wall = lines((-50, 12), (50, 12))
    for off, beside in ((1e-6, 0.0), (0.001, 0.0), (-0.002, 0.0), (0.001, 1e-8), (0.001, -1e-8)):
        around_it = Path.from_pieces([Arc((10.0, 0.0), (10.0 + off, beside), (0.0, 0.0), turn)])
        assert not judge(wall, Side.RIGHT, 3.0, around_it).judged
    assert judge(wall, Side.RIGHT, 3.0, Path.from_pieces([Arc((10.0, 0.0), (10.0, 1e-10), (0.0, 0.0), turn)])).clean


def test_rounding_far_from_the_origin_is_no_gouge() -> None:
    shift = (6.0e6, -3.0e6)
    verdict = judge(moved(MID_SIDE, 0.0, shift), Side.LEFT, R, moved(MID_SIDE_PATH, 0.0, shift))
    assert verdict.clean
    assert verdict.uncut_length == pytest.approx(8 * R, abs=1e-3)


def test_a_ring_of_ten_thousand_pieces_is_judged_exactly() -> None:
    """The ring has too many pieces to compare all with all."""
    teeth, radius, depth = 2500, 1000.0, 0.6
    angle = np.linspace(0.0, 2 * pi, 2 * teeth + 1)
    size = np.where(np.arange(2 * teeth) % 2, radius, radius + depth)
    spots = [(r * np.cos(a), r * np.sin(a)) for r, a in zip(size, angle[:-1], strict=True)]
    pieces: list[Piece] = []
    for (x, y), far, a in zip(spots, angle[1:], size, strict=True):
        end = (a * np.cos(far), a * np.sin(far))
        pieces.append(Arc((x, y), end, (0.0, 0.0), Turn.CCW))
        other = (radius + depth if a == radius else radius) / a
        pieces.append(Line(end, (end[0] * other, end[1] * other)))
    verdict = judge(Path.from_pieces(pieces), Side.RIGHT, 3.0, circle((0.0, 0.0), radius + depth + 3.0))
    assert verdict.clean
    assert verdict.clearance == pytest.approx(3.0, abs=1e-9)
    assert len(verdict.uncut) == teeth
    half = radius * pi / (2 * teeth)
    thickness = {round(stretch.thickness, 6) for stretch in verdict.uncut}
    assert max(thickness) - min(thickness) < 1e-5
    assert depth - 0.01 < max(thickness) <= depth + 1e-9
    assert verdict.uncut[0].length == pytest.approx(2 * (half + depth), abs=2e-3)


def test_loops_that_are_cut_together_share_one_verdict() -> None:
    """Each half loop alone leaves the other half of the wall uncut; both together leave nothing."""
    ring = Path.from_pieces([Arc((0, -1), (0, -1), (0, 0), Turn.CCW)])
    halves = [
        Path.from_pieces([Arc((0, -0.75), (0, 0.75), (0, 0), Turn.CCW)]),
        Path.from_pieces([Arc((0, 0.75), (0, -0.75), (0, 0), Turn.CCW)]),
    ]
    alone = [judge(ring, Side.LEFT, 0.25, loop) for loop in halves]
    together = judge(ring, Side.LEFT, 0.25, halves)
    assert all(verdict.uncut_length == pytest.approx(pi, abs=1e-6) for verdict in alone)
    assert together.clean
    assert together.uncut == ()


def test_piece_numbers_of_gouges_continue_in_the_second_loop() -> None:
    wall = Path.from_pieces([Line((0, 0), (10, 0))])
    loops = [Path.from_pieces([Line((0, 1), (4, 1))]), Path.from_pieces([Line((5, 0.5), (9, 0.5))], [7.0])]
    (gouge,) = judge(wall, Side.LEFT, 1.0, loops).gouges
    assert (gouge.path_piece, gouge.path_number) == (1, 7.0)
    assert gouge.depth == pytest.approx(0.5)


@pytest.mark.parametrize("surface", [square(20.0), lines((0, 40), (0, 0), (40, 0))])
def test_gouges_at_the_end_of_a_loop_and_the_start_of_the_next_are_two(surface: Path) -> None:
    """The first loop ends 1 behind the left wall; the second begins 2.9 behind it, with all of the cutter."""
    first, second = lines((-6, 5), (1, 5)), lines((2.9, 12), (10, 12))
    verdict = judge(surface, Side.RIGHT, 3.0, (first, second))
    assert [gouge.path_piece for gouge in verdict.gouges] == [1, 0]
    assert [gouge.depth for gouge in verdict.gouges] == pytest.approx([6.0, 4.0])
    assert [gouge.extent for gouge in verdict.gouges] == pytest.approx([0.1, 4.0], abs=1e-5)
    alone = judge(surface, Side.RIGHT, 3.0, (first, lines((9, 12), (10, 12))))
    assert [gouge.depth for gouge in alone.gouges] == pytest.approx([4.0])


def test_a_gouge_across_the_start_of_a_loop_is_one_gouge() -> None:
    wall = lines((-20, 0), (20, 0))
    loops = [lines((x, 0.5), (x + 2, 3), (x - 2, 3), (x, 0.5)) for x in (-8, 0, 8)]
    alone = [judge(wall, Side.LEFT, 1.0, loop).gouges for loop in loops]
    together = judge(wall, Side.LEFT, 1.0, loops).gouges
    assert [len(gouges) for gouges in alone] == [1, 1, 1]
    assert [gouge.extent for gouge in together] == pytest.approx([gouge.extent for (gouge,) in alone])
    assert [gouge.path_piece for gouge in together] == [0, 3, 6]


def test_all_is_uncut_without_a_loop() -> None:
    wall = Path.from_pieces([Line((0, 0), (10, 0))])
    assert judge(wall, Side.LEFT, 1.0, ()).uncut_length == pytest.approx(10.0)


def test_loops_that_cannot_be_judged_are_never_clean() -> None:
    wall = Path.from_pieces([Line((0, 0), (10, 0))])
    lost = Path.from_pieces([Line((0, 1), (nan, 1))])
    assert not judge(wall, Side.LEFT, 1.0, [Path.from_pieces([Line((0, 1), (10, 1))]), lost]).clean


def test_piece_numbers_of_several_loops_count_pieces_without_length() -> None:
    still = lines((1, 1), (1, 1), (1.2, 1))
    verdict = judge(square(), Side.LEFT, R, (still, lines((1, 1), (1, 0.1))))
    assert [gouge.path_piece for gouge in verdict.gouges] == [2]


def test_without_what_stays_uncut_the_rest_of_the_verdict_is_the_same() -> None:
    contour, path = lines((0, 0), (4, 0), (4, 3), (0, 3), (0, 0)), lines((0.2, 0.5), (2, 0.5), (2, 1))
    whole = judge(contour, Side.LEFT, 0.5, path)
    gouged = judge(contour, Side.LEFT, 0.5, path, measures_uncut=False)
    assert whole.uncut
    assert whole.gouges
    assert not gouged.uncut
    assert (gouged.gouges, gouged.wrong_side, gouged.may_cut_air) == (whole.gouges, whole.wrong_side, whole.may_cut_air)
