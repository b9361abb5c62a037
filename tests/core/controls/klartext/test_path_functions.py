"""Path functions without compensation: lines, arcs, polar words, helices, roundings, chamfers, planes."""

from __future__ import annotations

from itertools import pairwise
from math import cos, radians, sin, sqrt

import pytest

from core.controls.moves import Plane
from tests.core.controls.klartext.klartext_runs import clean, codes, flat, points, runs

NEAR = pytest.approx
START = "L X+0 Y+0 Z+0 R0 F100"


def told(*blocks: str) -> list[tuple[float, ...]]:
    return flat(clean(START, *blocks), 1)


def test_incremental_words_count_from_the_last_position() -> None:
    assert told("L X+10 IY+5", "L IX-4 IY+1 IZ-2") == [(10, 5), (6, 6)]


def test_words_need_no_signs_no_blanks_and_take_a_comma() -> None:
    assert told("LX10Y5,5R0FMAXM3", "L X-.5 Y1.") == [(10, 5.5), (-0.5, 1)]


def test_fmax_holds_for_its_block_and_f_from_there_on() -> None:
    made = clean(START, "L X+1 F300", "L X+2 FMAX", "L X+3")
    assert [(move.rapid, move.feed) for move in made.moves][1:] == [(False, 300), (True, 300), (False, 300)]


def test_fauto_is_the_feed_of_the_tool_call() -> None:
    made = clean("TOOL CALL 1 Z F250", START, "L X+1 FAUTO")
    assert made.moves[1].feed == 250


def test_blanks_inside_fmax_and_fauto() -> None:
    made = clean("TOOL CALL 1 Z F250", START, "L X+1 F AUTO", "L X+2 F MAX", "L X+3 F 90")
    assert [(move.rapid, move.feed) for move in made.moves][1:] == [(False, 250), (True, 250), (False, 90)]


def test_arc_about_the_pole_both_ways() -> None:
    assert told("CC X+10 Y+0", "C X+10 Y+10 DR-") == [(10, 10, 10, 0, -1)]
    assert told("CC X+10 Y+0", "C X+10 Y+10 DR+") == [(10, 10, 10, 0, 1)]


def test_incremental_pole_and_pole_where_the_tool_stands() -> None:
    assert told("CC IX+10 IY+0", "C X+20 Y+0 DR+") == [(20, 0, 10, 0, 1)]
    assert told("CC", "L X+5", "C X-5 Y+0 DR-")[-1] == (-5, 0, 0, 0, -1)


@pytest.mark.parametrize(
    "blocks",
    [
        ("L IX+0.1", "L IX+0.1", "L IX+0.1", "L X+0.3"),
        ("Q1 = 0.1 * 3", "L X+Q1", "L X+0.3"),
        ("CC X+0 Y+0", "LP PR+30 PA+0", "LP PR+30 PA+360"),
    ],
)
def test_what_rounding_leaves_between_equal_positions_is_no_move(blocks: tuple[str, ...]) -> None:
    ends = told(*blocks, "L X+50 Y+0")
    assert all(abs(before[0] - after[0]) > 0.01 for before, after in pairwise(ends))


def test_an_arc_that_ends_where_it_starts_is_a_full_circle() -> None:
    assert told("CC X+10 Y+0", "C X+0 Y+0 DR+") == [(0, 0, 10, 0, 1)]
    assert told("CC X+10 Y+0", "C DR+") == [(0, 0, 10, 0, 1)]


@pytest.mark.parametrize(("sign", "direction", "y"), [("+", "+", 8), ("+", "-", -8), ("-", "+", -8), ("-", "-", 8)])
def test_arc_by_its_radius_in_four_ways(sign: str, direction: str, y: float) -> None:
    (arc,) = told(f"CR X+12 Y+0 R{sign}10 DR{direction}")
    assert arc == NEAR((12, 0, 6, y, 1 if direction == "+" else -1))


def test_half_a_circle_by_its_radius() -> None:
    assert told("CR X+0 Y+20 R10 DR+") == [NEAR((0, 20, 0, 10, 1))]


def test_tangent_arcs() -> None:
    assert told("L X+10", "CT X+20 Y+10")[-1] == NEAR((20, 10, 10, 10, 1))
    assert told("L X+10", "CT X+20 Y-10", "CT X+30 Y-20")[-1] == NEAR((30, -20, 30, -10, 1))


def test_polar_lines() -> None:
    blocks = ("CC X+0 Y+0", "LP PR+30 PA+0", "LP PA+60", "LP IPA+60", "LP IPR+10 PA+180 IZ-3")
    moves = points(clean(START, *blocks), 1)
    assert moves[0] == (30, 0, 0)
    assert moves[1] == NEAR((15, 15 * sqrt(3), 0))
    assert moves[2] == NEAR((-15, 15 * sqrt(3), 0))
    assert moves[3] == NEAR((-40, 0, -3))


def test_polar_arcs() -> None:
    assert told("L X+10", "CC X+0 Y+0", "CP PA+90 DR+")[-1] == NEAR((0, 10, 0, 0, 1))
    assert told("L X+10", "CC X+0 Y+0", "CP IPA-90 DR-")[-1] == NEAR((0, -10, 0, 0, -1))
    assert told("L X+10", "CC X+20 Y+0", "CTP PR+10 PA+90")[-1] == NEAR((20, 10, 10, 10, 1))


def test_a_helix_of_two_turns_and_a_quarter_down() -> None:
    made = clean(START, "L X+10", "CC X+0 Y+0", "CP IPA+810 IZ-9 DR+")
    want = [(10, 0, -4), (10, 0, -8), (0, 10, -9)]
    assert points(made, 2) == [NEAR(point) for point in want]
    assert [move.turn for move in made.moves][2:] == [1, 1, 1]


def test_a_helix_of_whole_turns_ends_exactly_at_its_depth() -> None:
    made = clean(START, "L X+10", "CC X+0 Y+0", "CP IPA-1080 Z-0.1 DR-")
    assert points(made, 2)[-1] == (10, 0, -0.1)
    assert len(made.moves) == 5


def test_a_compensated_helix_is_offset_turn_by_turn() -> None:
    blocks = ("L X+10 Y+0 RL F100", "CP IPA+720 IZ-6 DR+", "L X+0 R0")
    made = clean("CC X+0 Y+0", START, *blocks, radius=3)
    want = [(7, 0, 0), (7, 0, -3), (7, 0, -6), (0, 0, -6)]
    assert points(made, 1) == [NEAR(point) for point in want]


@pytest.mark.parametrize(
    ("second", "want"),
    [
        ("L Y+40", [(15, 0), (20, 5, 15, 5, 1), (20, 40)]),
        ("L Y-40", [(15, 0), (20, -5, 15, -5, -1), (20, -40)]),
    ],
)
def test_rounding_between_lines(second: str, want: list[tuple[float, ...]]) -> None:
    assert told("L X+20", "RND R5 F20", second) == [NEAR(move) for move in want]


def test_rounding_between_a_line_and_an_arc() -> None:
    # A circle of radius 3 on the line y = 0 and inside the circle of radius 10 about (20, 0) has its center 7 from it.
    moves = told("L X+30", "RND R3", "CC X+20 Y+0", "C X+10 Y+0 DR+")
    foot = 20 + sqrt(40)
    touch = (20 + 10 * (foot - 20) / 7, 30 / 7)
    assert moves[0] == NEAR((foot, 0))
    assert moves[1] == NEAR((*touch, foot, 3, 1))
    assert moves[2] == NEAR((10, 0, 20, 0, 1))


def test_the_feed_of_a_rounding_is_its_own() -> None:
    made = clean(START, "L X+20 F100", "RND R5 F20", "L Y+40")
    assert [move.feed for move in made.moves][1:] == [100, 20, 100]


def test_chamfer_between_lines() -> None:
    want = [(17, 0), (20, 3), (20, 40)]
    assert told("L X+20", "CHF 3", "L Y+40") == [NEAR(move) for move in want]
    assert told("L X+20", "CHF R3 F20", "L Y+40") == [NEAR(move) for move in want]


def test_rounding_and_chamfer_one_after_the_other() -> None:
    moves = told("L X+20", "CHF 3", "L Y+40", "RND R2", "L X+0")
    assert moves[2:] == [NEAR((20, 38)), NEAR((18, 40, 18, 38, 1)), NEAR((0, 40))]


def test_rounding_inside_and_outside_is_compensated() -> None:
    blocks = ("L X+0 Y+0 RL F100", "L X+30", "RND R8", "L Y+30", "RND R4", "L X+60", "L Y+90 R0")
    made = clean("L X-20 Y+0 R0 FMAX", *blocks, radius=5)
    told = flat(made)
    assert told[1:3] == [NEAR((22, 5)), NEAR((25, 8, 22, 8, 1))]
    assert told[4] == NEAR((34, 35, 34, 26, -1))


@pytest.mark.parametrize(("axis", "plane", "end"), [("Y", Plane.ZX, (2, 0, 2)), ("X", Plane.YZ, (0, 2, 2))])
def test_the_working_plane_follows_the_tool_axis(axis: str, plane: Plane, end: tuple[float, ...]) -> None:
    first, second = plane.name[0], plane.name[1]
    made = clean(f"TOOL CALL 1 {axis}", START, f"CC {first}+0 {second}+2", f"C {first}+2 {second}+2 DR+")
    arc = made.moves[1]
    assert (arc.plane, arc.turn, arc.point) == (plane, 1, end)


def test_compensation_works_in_every_plane() -> None:
    made = clean("TOOL CALL 1 Y", "L Z-20 X+0 R0 F9", "L Z+0 X+0 RL", "L Z+30", "L X+30", "L Z-40 R0", radius=5)
    assert points(made) == [NEAR(point) for point in [(5, 0, 0), (5, 0, 25), (30, 0, 25), (30, 0, -40)]]
    assert made.stretches[0].plane is Plane.ZX


def test_a_datum_shift_moves_what_is_programmed_after_it() -> None:
    cycle = ("CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+100", "CYCL DEF 7.2 IY+5")
    for shift in (cycle, ("TRANS DATUM AXIS X+100 Y+5",)):
        assert told(*shift, "L X+1 Y+1", "L IX+1") == [(101, 6), (102, 6)]


def test_an_arc_may_miss_its_radius_by_sixteen_thousandths() -> None:
    assert codes(runs(START, "CC X+10 Y+0", "C X+20.015 Y+0 DR+")) == []
    assert codes(runs(START, "CC X+10 Y+0", "C X+20.017 Y+0 DR+")) == [("ARC", 6)]


def test_polar_points_by_angles_that_are_not_right_ones() -> None:
    (_, line) = told("CC X+1 Y+2", "LP PR+5 PA+0", "LP PR+5 PA+37")
    assert line == NEAR((1 + 5 * cos(radians(37)), 2 + 5 * sin(radians(37))))


@pytest.mark.parametrize("center", ["CC X+2 Z+0", "CC Z+0 X+2", "CC IX+2 IZ+0"])
def test_an_arc_about_a_center_in_zx_runs_there(center: str) -> None:
    """In the plane Z/X the angle's axis is +Z (TNC 310 pilot, page 8; TNC 620 ISO, page 84), and + turns from Z to X.

    By hand: from the center X2 Z0 the tool at X0 Z0 is 2 away toward -X: Z = 2 cos a = 0 and X = 2 sin a = -2, so
    a = -90.  IPA-90 goes on to -180, with DR- as its sign says: Z = 2 cos(-180) = -2, X = 2 + 2 sin(-180) = 2.
    """
    made = clean(START, center, "CP IPA-90 DR-", "C X+4 Z+0 DR-")
    assert [move.plane for move in list(made.moves)[1:]] == [Plane.ZX] * 2
    assert points(made, 1) == [NEAR((2, 0, -2)), NEAR((4, 0, 0))]
    assert made.moves[1].center == NEAR((2, 0, 0))


def test_polar_angles_in_zx_count_from_z() -> None:
    made = clean(START, "CC X+0 Z+0", "LP PR+10 PA+90", "LP PA+0", "CP PA+90 DR+", "CP PA+180 DR+")
    assert points(made, 1) == [NEAR((10, 0, 0)), NEAR((0, 0, 10)), NEAR((10, 0, 0)), NEAR((0, 0, -10))]


def test_arcs_of_cam_systems_sink_into_the_cut_and_rise_out_of_it() -> None:
    """As posts write ramps: down to the depth at which the next line goes on, and up to the height of the retract."""
    made = clean("L X+18 Y+0 Z+7 F9", "CC X+10 Z+7", "CP IPA+90 DR+", "L X-40 Z-1", "CC X-40 Z+7", "CP IPA+90 DR+")
    assert points(made, 1) == [NEAR((18, 0, 7)), NEAR((10, 0, -1)), NEAR((-40, 0, -1)), NEAR((-48, 0, 7))]


def test_an_arc_in_yz_runs_there() -> None:
    made = clean(START, "CC Y+5 Z+0", "C Y+5 Z-5 DR+", "CP IPA+90 DR+")
    assert [move.plane for move in list(made.moves)[1:]] == [Plane.YZ] * 2
    assert points(made, 1) == [NEAR((0, 5, -5)), NEAR((0, 10, 0))]


def test_an_arc_by_its_radius_runs_in_the_plane_of_its_axes() -> None:
    zx, yz = clean(START, "CR X+10 Z+10 R+10 DR+"), clean(START, "CR Y+10 IZ+10 R+10 DR+")
    assert (zx.moves[1].plane, yz.moves[1].plane) == (Plane.ZX, Plane.YZ)
    assert zx.moves[1].center == NEAR((10, 0, 0))
    assert yz.moves[1].center == NEAR((0, 0, 10))


def test_a_helix_across_zx_moves_y() -> None:
    made = clean(START, "CC X+2 Z+0", "CP IPA+360 IY+3 DR+")
    assert points(made, 1) == [NEAR((0, 3, 0))]


def test_an_arc_outside_the_working_plane_with_another_tool_axis() -> None:
    made = clean("TOOL CALL 1 Y S1", START, "CC X+2 Y+0", "CP IPA-90 DR-")
    assert made.moves[1].plane is Plane.XY
    assert made.moves[1].point == NEAR((2, 2, 0))


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
    made = runs(START, *blocks)
    assert made.stopped_at is not None
    assert codes(made)[-1][0] == rule


def test_a_polar_word_left_out_is_that_of_the_position_seen_from_the_pole() -> None:
    assert told("L X+10 Y+0", "CC X+4 Y-6", "LP PR+10")[-1] == NEAR((4 + 50**0.5, -6 + 50**0.5))
    assert told("L X+10 Y+0", "CC X+4 Y-6", "LP PA+90")[-1] == NEAR((4, -6 + 72**0.5))
