"""Path functions without compensation: lines, arcs, polar words, helices, roundings, chamfers, planes."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, radians, sin, sqrt

import pytest

from core.controls.moves import Plane
from tests.core.controls.klartext.klartext_runs import clean, codes, flat, points, runs

NEAR = pytest.approx
START = "L X+0 Y+0 Z+0 R0 F100"


def moves_of(*blocks: str) -> list[tuple[float, ...]]:
    return flat(clean(START, *blocks), 1)


def test_incremental_words_count_from_the_last_position() -> None:
    assert moves_of("L X+10 IY+5", "L IX-4 IY+1 IZ-2") == [(10, 5), (6, 6)]


def test_words_need_no_signs_or_blanks_and_accept_a_comma() -> None:
    assert moves_of("LX10Y5,5R0FMAXM3", "L X-.5 Y1.") == [(10, 5.5), (-0.5, 1)]


def test_fmax_applies_to_its_block_and_f_to_all_blocks_after_it() -> None:
    run = clean(START, "L X+1 F300", "L X+2 FMAX", "L X+3")
    assert [(move.rapid, move.feed) for move in run.moves][1:] == [(False, 300), (True, 300), (False, 300)]


def test_old_listings_write_r_f_and_m_without_a_value_where_nothing_changes() -> None:
    run = runs(START, "L X+1,000 R F300 M", "L X+2,000 R F M", "CC X+2,000 Y+1,000", "C X+3,000 Y+1,000 DR+ R F M")
    assert [(move.rapid, move.feed) for move in run.moves][1:] == [(False, 300)] * 3
    assert codes(run) == [("INTERPRETED", 5)]


def test_fauto_is_the_feed_of_the_tool_call() -> None:
    run = clean("TOOL CALL 1 Z F250", START, "L X+1 FAUTO")
    assert run.moves[1].feed == 250


def test_fmax_and_fauto_may_contain_blanks() -> None:
    run = clean("TOOL CALL 1 Z F250", START, "L X+1 F AUTO", "L X+2 F MAX", "L X+3 F 90")
    assert [(move.rapid, move.feed) for move in run.moves][1:] == [(False, 250), (True, 250), (False, 90)]


def test_an_arc_about_the_pole_runs_in_both_directions() -> None:
    assert moves_of("CC X+10 Y+0", "C X+10 Y+10 DR-") == [(10, 10, 10, 0, -1)]
    assert moves_of("CC X+10 Y+0", "C X+10 Y+10 DR+") == [(10, 10, 10, 0, 1)]


def test_the_pole_may_be_incremental_or_at_the_tool() -> None:
    assert moves_of("CC IX+10 IY+0", "C X+20 Y+0 DR+") == [(20, 0, 10, 0, 1)]
    assert moves_of("CC", "L X+5", "C X-5 Y+0 DR-")[-1] == (-5, 0, 0, 0, -1)


@pytest.mark.parametrize(
    "blocks",
    [
        ("L IX+0.1", "L IX+0.1", "L IX+0.1", "L X+0.3"),
        ("Q1 = 0.1 * 3", "L X+Q1", "L X+0.3"),
        ("CC X+0 Y+0", "LP PR+30 PA+0", "LP PR+30 PA+360"),
    ],
)
def test_rounding_between_equal_positions_is_no_move(blocks: tuple[str, ...]) -> None:
    ends = moves_of(*blocks, "L X+50 Y+0")
    assert all(abs(before[0] - after[0]) > 0.01 for before, after in pairwise(ends))


def test_an_arc_that_ends_where_it_starts_is_a_full_circle() -> None:
    assert moves_of("CC X+10 Y+0", "C X+0 Y+0 DR+") == [(0, 0, 10, 0, 1)]
    assert moves_of("CC X+10 Y+0", "C DR+") == [(0, 0, 10, 0, 1)]


@pytest.mark.parametrize("end", ["0.3", "0.1 + 0.2", "1.2 - 0.9"])
@pytest.mark.parametrize(("direction", "turn"), [("DR+", 1), ("DR-", -1)])
def test_an_end_at_the_start_but_for_rounding_makes_a_full_circle(end: str, direction: str, turn: int) -> None:
    run = clean("L X+0.3 Y+0 R0 F100", f"Q1 = {end}", "CC X+10 Y+0", f"C X+Q1 Y+0 {direction}")
    circle = run.moves.path()[-1]
    assert circle.length == NEAR(2 * pi * 9.7)
    assert run.moves.turns[-1] == turn


@pytest.mark.parametrize(("sign", "direction", "y"), [("+", "+", 8), ("+", "-", -8), ("-", "+", -8), ("-", "-", 8)])
def test_the_signs_of_radius_and_direction_select_one_of_four_arcs(sign: str, direction: str, y: float) -> None:
    (arc,) = moves_of(f"CR X+12 Y+0 R{sign}10 DR{direction}")
    assert arc == NEAR((12, 0, 6, y, 1 if direction == "+" else -1))


def test_a_half_circle_by_its_radius_has_one_center() -> None:
    assert moves_of("CR X+0 Y+20 R10 DR+") == [NEAR((0, 20, 0, 10, 1))]


def test_ct_makes_tangent_arcs() -> None:
    assert moves_of("L X+10", "CT X+20 Y+10")[-1] == NEAR((20, 10, 10, 10, 1))
    assert moves_of("L X+10", "CT X+20 Y-10", "CT X+30 Y-20")[-1] == NEAR((30, -20, 30, -10, 1))


def test_lp_makes_polar_lines() -> None:
    blocks = ("CC X+0 Y+0", "LP PR+30 PA+0", "LP PA+60", "LP IPA+60", "LP IPR+10 PA+180 IZ-3")
    moves = points(clean(START, *blocks), 1)
    assert moves[0] == (30, 0, 0)
    assert moves[1] == NEAR((15, 15 * sqrt(3), 0))
    assert moves[2] == NEAR((-15, 15 * sqrt(3), 0))
    assert moves[3] == NEAR((-40, 0, -3))


def test_cp_and_ctp_make_polar_arcs() -> None:
    assert moves_of("L X+10", "CC X+0 Y+0", "CP PA+90 DR+")[-1] == NEAR((0, 10, 0, 0, 1))
    assert moves_of("L X+10", "CC X+0 Y+0", "CP IPA-90 DR-")[-1] == NEAR((0, -10, 0, 0, -1))
    assert moves_of("L X+10", "CC X+20 Y+0", "CTP PR+10 PA+90")[-1] == NEAR((20, 10, 10, 10, 1))


def test_a_helix_of_two_and_a_quarter_turns_descends_evenly() -> None:
    run = clean(START, "L X+10", "CC X+0 Y+0", "CP IPA+810 IZ-9 DR+")
    expected = [(10, 0, -4), (10, 0, -8), (0, 10, -9)]
    assert points(run, 2) == [NEAR(point) for point in expected]
    assert [move.turn for move in run.moves][2:] == [1, 1, 1]


def test_a_helix_of_whole_turns_ends_exactly_at_its_depth() -> None:
    run = clean(START, "L X+10", "CC X+0 Y+0", "CP IPA-1080 Z-0.1 DR-")
    assert points(run, 2)[-1] == (10, 0, -0.1)
    assert len(run.moves) == 5


def test_a_compensated_helix_is_offset_turn_by_turn() -> None:
    blocks = ("L X+10 Y+0 RL F100", "CP IPA+720 IZ-6 DR+", "L X+0 R0")
    run = clean("CC X+0 Y+0", START, *blocks, radius=3)
    expected = [(7, 0, 0), (7, 0, -3), (7, 0, -6), (0, 0, -6)]
    assert points(run, 1) == [NEAR(point) for point in expected]


@pytest.mark.parametrize(
    ("second", "expected"),
    [
        ("L Y+40", [(15, 0), (20, 5, 15, 5, 1), (20, 40)]),
        ("L Y-40", [(15, 0), (20, -5, 15, -5, -1), (20, -40)]),
    ],
)
def test_rnd_rounds_the_corner_of_two_lines(second: str, expected: list[tuple[float, ...]]) -> None:
    assert moves_of("L X+20", "RND R5 F20", second) == [NEAR(move) for move in expected]


def test_rnd_rounds_the_corner_of_a_line_and_an_arc() -> None:
    # A circle of radius 3 on the line y = 0 and inside the circle of radius 10 about (20, 0) has its center 7 from it.
    moves = moves_of("L X+30", "RND R3", "CC X+20 Y+0", "C X+10 Y+0 DR+")
    foot = 20 + sqrt(40)
    touch = (20 + 10 * (foot - 20) / 7, 30 / 7)
    assert moves[0] == NEAR((foot, 0))
    assert moves[1] == NEAR((*touch, foot, 3, 1))
    assert moves[2] == NEAR((10, 0, 20, 0, 1))


def test_the_feed_of_a_rounding_applies_to_the_rounding_only() -> None:
    run = clean(START, "L X+20 F100", "RND R5 F20", "L Y+40")
    assert [move.feed for move in run.moves][1:] == [100, 20, 100]


def test_chf_chamfers_the_corner_of_two_lines() -> None:
    expected = [(17, 0), (20, 3), (20, 40)]
    assert moves_of("L X+20", "CHF 3", "L Y+40") == [NEAR(move) for move in expected]
    assert moves_of("L X+20", "CHF R3 F20", "L Y+40") == [NEAR(move) for move in expected]


def test_a_chamfer_and_a_rounding_may_follow_each_other() -> None:
    moves = moves_of("L X+20", "CHF 3", "L Y+40", "RND R2", "L X+0")
    assert moves[2:] == [NEAR((20, 38)), NEAR((18, 40, 18, 38, 1)), NEAR((0, 40))]


def test_inside_and_outside_roundings_are_compensated() -> None:
    blocks = ("L X+0 Y+0 RL F100", "L X+30", "RND R8", "L Y+30", "RND R4", "L X+60", "L Y+90 R0")
    run = clean("L X-20 Y+0 R0 FMAX", *blocks, radius=5)
    moves = flat(run)
    assert moves[1:3] == [NEAR((22, 5)), NEAR((25, 8, 22, 8, 1))]
    assert moves[4] == NEAR((34, 35, 34, 26, -1))


@pytest.mark.parametrize(("axis", "plane", "end"), [("Y", Plane.ZX, (2, 0, 2)), ("X", Plane.YZ, (0, 2, 2))])
def test_the_working_plane_follows_the_tool_axis(axis: str, plane: Plane, end: tuple[float, ...]) -> None:
    first, second = plane.name[0], plane.name[1]
    run = clean(f"TOOL CALL 1 {axis}", START, f"CC {first}+0 {second}+2", f"C {first}+2 {second}+2 DR+")
    arc = run.moves[1]
    assert (arc.plane, arc.turn, arc.point) == (plane, 1, end)


def test_compensation_works_in_every_plane() -> None:
    run = clean("TOOL CALL 1 Y", "L Z-20 X+0 R0 F9", "L Z+0 X+0 RL", "L Z+30", "L X+30", "L Z-40 R0", radius=5)
    assert points(run) == [NEAR(point) for point in [(5, 0, 0), (5, 0, 25), (30, 0, 25), (30, 0, -40)]]
    assert run.stretches[0].plane is Plane.ZX


def test_a_datum_shift_moves_the_blocks_after_it() -> None:
    cycle = ("CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+100", "CYCL DEF 7.2 IY+5")
    for shift in (cycle, ("TRANS DATUM AXIS X+100 Y+5",)):
        assert moves_of(*shift, "L X+1 Y+1", "L IX+1") == [(101, 6), (102, 6)]


def test_an_arc_may_miss_its_radius_by_sixteen_thousandths() -> None:
    assert codes(runs(START, "CC X+10 Y+0", "C X+20.015 Y+0 DR+")) == []
    assert codes(runs(START, "CC X+10 Y+0", "C X+20.017 Y+0 DR+")) == [("ARC", 6)]


def test_polar_points_at_any_angle_are_exact() -> None:
    (_, line) = moves_of("CC X+1 Y+2", "LP PR+5 PA+0", "LP PR+5 PA+37")
    assert line == NEAR((1 + 5 * cos(radians(37)), 2 + 5 * sin(radians(37))))


@pytest.mark.parametrize("center", ["CC X+2 Z+0", "CC Z+0 X+2", "CC IX+2 IZ+0"])
def test_an_arc_about_a_center_in_zx_runs_in_zx(center: str) -> None:
    """In the plane Z/X angles count from +Z (TNC 310 pilot, page 8; TNC 620 ISO, page 84), and + turns from Z to X.

    By hand: from the center X2 Z0 the tool at X0 Z0 is 2 away toward -X: Z = 2 cos a = 0 and X = 2 sin a = -2, so
    a = -90.  IPA-90 goes on to -180, with DR- as its sign says: Z = 2 cos(-180) = -2, X = 2 + 2 sin(-180) = 2.
    """
    run = clean(START, center, "CP IPA-90 DR-", "C X+4 Z+0 DR-")
    assert [move.plane for move in list(run.moves)[1:]] == [Plane.ZX] * 2
    assert points(run, 1) == [NEAR((2, 0, -2)), NEAR((4, 0, 0))]
    assert run.moves[1].center == NEAR((2, 0, 0))


def test_polar_angles_in_zx_count_from_z() -> None:
    run = clean(START, "CC X+0 Z+0", "LP PR+10 PA+90", "LP PA+0", "CP PA+90 DR+", "CP PA+180 DR+")
    assert points(run, 1) == [NEAR((10, 0, 0)), NEAR((0, 0, 10)), NEAR((10, 0, 0)), NEAR((0, 0, -10))]


def test_vertical_arcs_lead_into_and_out_of_the_cut() -> None:
    """CAM posts write such ramps: down to the depth of the next line and up to the retract height."""
    run = clean("L X+18 Y+0 Z+7 F9", "CC X+10 Z+7", "CP IPA+90 DR+", "L X-40 Z-1", "CC X-40 Z+7", "CP IPA+90 DR+")
    assert points(run, 1) == [NEAR((18, 0, 7)), NEAR((10, 0, -1)), NEAR((-40, 0, -1)), NEAR((-48, 0, 7))]


def test_an_arc_about_a_center_in_yz_runs_in_yz() -> None:
    run = clean(START, "CC Y+5 Z+0", "C Y+5 Z-5 DR+", "CP IPA+90 DR+")
    assert [move.plane for move in list(run.moves)[1:]] == [Plane.YZ] * 2
    assert points(run, 1) == [NEAR((0, 5, -5)), NEAR((0, 10, 0))]


def test_an_arc_by_its_radius_runs_in_the_plane_of_its_axes() -> None:
    zx, yz = clean(START, "CR X+10 Z+10 R+10 DR+"), clean(START, "CR Y+10 IZ+10 R+10 DR+")
    assert (zx.moves[1].plane, yz.moves[1].plane) == (Plane.ZX, Plane.YZ)
    assert zx.moves[1].center == NEAR((10, 0, 0))
    assert yz.moves[1].center == NEAR((0, 0, 10))


def test_a_helix_across_zx_moves_y() -> None:
    run = clean(START, "CC X+2 Z+0", "CP IPA+360 IY+3 DR+")
    assert points(run, 1) == [NEAR((0, 3, 0))]


def test_an_arc_may_run_outside_the_working_plane_of_another_tool_axis() -> None:
    run = clean("TOOL CALL 1 Y S1", START, "CC X+2 Y+0", "CP IPA-90 DR-")
    assert run.moves[1].plane is Plane.XY
    assert run.moves[1].point == NEAR((2, 2, 0))


@pytest.mark.parametrize(
    ("blocks", "rule"),
    [
        (("CC X+2 Z+0", "C X+4 Y+1 DR+"), "ARC"),
        (("CC X+2 Y+0", "C X+2 Z+2 DR+"), "ARC"),
        (("CC X+2 Z+0", "CR X+4 R+3 DR+"), "ARC"),
        (("CR Z+4 R+3 DR+",), "ARC"),
        (("CR X+1 Y+1 Z+4 R+3 DR+",), "ARC"),
        (("CC X+2 Y+0 Z+0",), "ARC"),
        (("CC X+2",), "ARC"),
        (("L X+1", "CC X+2 Z+0", "CTP PR+3 PA+9"), "ARC"),
        (("CC X+2 Z+0", "APPR PLT PR+3 PA+9 LEN5 RL"), "ARC"),
        (("CC X+2 Z+0", "LP PR+3 PA+9 X+1"), "WORD"),
        (("L X+5 RL", "CC X+7 Z+0", "C X+7 Z-2 DR-"), "HE2"),
        (("L X+5", "CC X+7 Z+0", "C X+7 Z-2 DR- RL"), "HE2"),
        (("CC X+2 Z+0", "CP IPA-90 DR-", "CT X+4 Y+4"), "HE6"),
        (("CC X+2 Z+0", "CP IPA-90 DR-", "RND R1", "L X+9"), "CORNER"),
        (("L X+9", "RND R1", "CC X+11 Z+0", "CP IPA-90 DR-"), "CORNER"),
        (("APPR LT X+1 Y+1 LEN2 R0", "CC X+2 Z+0", "C X+2 Z+1 DR-"), "HE7"),
    ],
)
def test_an_arc_that_cannot_run_in_its_plane_is_refused(blocks: tuple[str, ...], rule: str) -> None:
    run = runs(START, *blocks)
    assert run.stopped_at is not None
    assert codes(run)[-1][0] == rule


def test_an_omitted_polar_word_is_that_of_the_position_relative_to_the_pole() -> None:
    assert moves_of("L X+10 Y+0", "CC X+4 Y-6", "LP PR+10")[-1] == NEAR((4 + 50**0.5, -6 + 50**0.5))
    assert moves_of("L X+10 Y+0", "CC X+4 Y-6", "LP PA+90")[-1] == NEAR((4, -6 + 72**0.5))


@pytest.mark.parametrize(
    ("radius_words", "end"), [("", (0, 5)), ("PR+5", (0, 5)), ("IPR+0", (0, 5)), ("IPR+0.004", (0, 5.004))]
)
def test_a_helix_ends_at_its_angle_and_its_radius(radius_words: str, end: tuple[float, float]) -> None:
    moves = points(clean("L X+5 Y+0 Z+0 R0 F100", "CC X+0 Y+0", f"CP {radius_words} IPA+450 Z+5 DR+"))
    assert moves == [NEAR((5, 0, 4)), NEAR((*end, 5))]
