"""The compensated path: entry, corners, exit, M97, M98, feeds on arcs and what stops it, worked out by hand."""

from __future__ import annotations

from math import sqrt

import pytest

from core.controls.compensation.elements import arc_element
from core.controls.klartext.center_path import remaining
from tests.core.controls.klartext.klartext_runs import clean, codes, flat, points, runs

NEAR = pytest.approx
START = "L X-20 Y+0 R0 FMAX"


def test_entry_ends_square_to_the_next_element_and_exit_starts_square_to_the_last() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+8 Y+6", "L X+40 Y-20 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(-3, 4), (5, 10), (40, -20)]]
    (stretch,) = made.stretches
    assert (stretch.entry, stretch.exit, stretch.radius) == (1, 1, 5)
    assert (stretch.first, stretch.last) == (1, 5)
    assert stretch.programmed.points[:, :2].tolist() == [[-20, 0], [0, 0], [8, 6], [40, -20]]


def test_nearly_straight_corners_far_from_the_origin_are_no_alarm() -> None:
    ends = ["L X+14218.3464 Y+5934.4881", "L X+14219.2301 Y+5935.3814", "L X+14219.2301 Y+6000"]
    made = clean("L X+14210 Y+5930 R0 FMAX", "L X+14217.4626 Y+5933.5947 RL F100", *ends, "L X+0 R0", radius=0.5)
    assert len(made.moves) == 7


def test_entry_before_an_arc_is_radial() -> None:
    made = clean(START, "L X+0 Y+0 RR F100", "CC X+0 Y+20", "C X+20 Y+20 DR+", "L X+20 Y+60 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, -5), (25, 20, 0, 20, 1), (20, 60)]]


def test_outside_corner_is_an_arc_about_it() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30", "L Y-30", "L X-40 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, 5), (30, 5), (35, 0, 30, 0, -1), (35, -30), (-40, -30)]]


def test_outside_corner_on_the_right_turns_the_other_way() -> None:
    made = clean(START, "L X+0 Y+0 RR F100", "L X+30", "L Y+30", "L X-40 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, -5), (30, -5), (35, 0, 30, 0, 1), (35, 30), (-40, 30)]]


def test_inside_corner_is_the_meeting_of_the_offsets() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30", "L Y+30", "L X-40 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, 5), (25, 5), (25, 30), (-40, 30)]]


def test_a_reversal_is_an_outside_corner_of_half_a_turn() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30", "L X+10", "L Y-40 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, 5), (30, 5), (30, -5, 30, 0, -1), (10, -5), (10, -40)]]


def test_a_tangent_joint_gets_nothing() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30", "CC X+30 Y+20", "C X+50 Y+20 DR+", "L Y+60 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, 5), (30, 5), (45, 20, 30, 20, 1), (50, 60)]]


def test_inside_corner_of_a_line_and_an_arc() -> None:
    # The line y = 5 meets the circle of radius 20 - 5 about (30, 0) at x = 30 - sqrt(15 ** 2 - 5 ** 2).
    meeting = 30 - sqrt(200)
    blocks = ("CC X+30 Y+0", "L X+50", "C X+10 Y+0 DR+", "L X+0 Y-40 R0")
    made = clean("L X+0 Y-20 R0 FMAX", "L X+20 Y+0 RL F100", *blocks, radius=5)
    assert flat(made)[0] == NEAR((20, 5))
    assert flat(made)[1] == NEAR((30 + sqrt(200), 5))
    assert flat(made)[2] == NEAR((15, 0, 30, 0, 1))
    assert meeting == NEAR(15.857864)


def test_inside_corner_of_two_arcs() -> None:
    # Two arcs of radius 20 about (0, 0) and (24, 0) meet at (12, 16); offset to 15 they meet at (12, 9).
    blocks = ("CC X+0 Y+0", "C X+12 Y+16 DR+", "CC X+24 Y+0", "C X+24 Y-20 DR+", "L X+80 R0")
    made = clean("L X+40 Y-20 R0 FMAX", "L X+0 Y-20 RL F100", *blocks, radius=5)
    assert flat(made)[:3] == [NEAR(want) for want in [(0, -15), (12, 9, 0, 0, 1), (24, -15, 24, 0, 1)]]


def test_a_full_circle_stays_one() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "CC X+20 Y+0", "C X+0 Y+0 DR+", "L X-20 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(5, 0), (5, 0, 20, 0, 1), (-20, 0)]]
    assert made.moves[3].point == made.moves[2].point


def test_a_full_circle_between_tangent_lines_stays_one() -> None:
    circle = ("L X+20", "CC X+20 Y+20", "C X+20 Y+0 DR+", "L X+40", "L Y-20 R0")
    made = clean(START, "L X+0 Y+0 RL F100", *circle, radius=5)
    assert flat(made)[1:4] == [NEAR(want) for want in [(20, 5), (20, 5, 20, 20, 1), (40, 5)]]
    assert made.moves[4].point == made.moves[3].point


def test_depth_moves_go_down_where_the_element_before_them_ends() -> None:
    blocks = ("L Z-5", "L X+30", "L Z-8", "L Y+30", "L Z+50 FMAX", "L X-40 R0 F100")
    made = clean(START, "L X+0 Y+0 RL F100", *blocks, radius=5)
    want = [(0, 5, 0), (0, 5, -5), (25, 5, -5), (25, 5, -8), (25, 30, -8), (25, 30, 50), (-40, 30, 50)]
    assert points(made) == [NEAR(point) for point in want]


def test_height_in_a_contour_block_goes_with_it() -> None:
    made = clean("L X-20 Y+0 Z+2 R0 FMAX", "L X+0 Y+0 Z-1 RL F100", "L X+30 Z-4", "L X+60 R0", radius=5)
    assert points(made) == [NEAR(point) for point in [(0, 5, -1), (30, 5, -4), (60, 0, -4)]]


def test_sides_set_without_moving_in_the_plane_take_effect_with_the_next_line() -> None:
    made = runs(START, "L Z-5 RL F100", "L X+0 Y+0", "L X+30", "L Z+5 R0", "L X+60", radius=5)
    assert codes(made) == [("INTERPRETED", 5), ("INTERPRETED", 8)]
    want = [(-20, 0, -5), (0, 5, -5), (30, 5, -5), (30, 5, 5), (60, 0, 5)]
    assert points(made) == [NEAR(point) for point in want]


def test_r0_in_the_tool_axis_alone_is_enough_for_a_tool_change_and_the_end() -> None:
    contour = (START, "L Z-5 R0 F100", "L X+0 Y+0 RL", "L X+30", "L Z+50 R0 FMAX")
    made = runs(*contour, "TOOL DEF 2 L+0 R+3", "TOOL CALL 2 Z S1000", "L X+60 Y+0 FMAX")
    assert (codes(made), made.stopped_at) == ([("INTERPRETED", 8), ("INTERPRETED", 10)], None)
    want = [(-20, 0, -5), (0, 5, -5), (30, 5, -5), (30, 5, 50), (60, 0, 50)]
    assert points(made) == [NEAR(point) for point in want]
    assert codes(runs(*contour)) == [("INTERPRETED", 8)]
    assert codes(runs(*contour[:-1]))[-1][0] == "PROGRAM"
    assert codes(runs(*contour[:-1], "TOOL CALL 2 Z S1000"))[-1] == ("TOOL", 8)


def test_m97_takes_the_meeting_at_an_outside_corner() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30 M97", "L Y-0.5", "L X+60", "L Y+40 R0", radius=5)
    assert flat(made)[1:4] == [NEAR(want) for want in [(35, 5), (35, 4.5), (60, 4.5)]]


def test_the_step_that_needs_m97_stops_without_it() -> None:
    made = runs(START, "L X+0 Y+0 RL F100", "L X+30", "L Y-0.5", "L X+60", "L Y+40 R0", radius=5)
    assert codes(made) == [("HE3", 7)]
    assert made.stopped_at == 7
    assert flat(made)[-1] == NEAR((35, 0, 30, 0, -1))


def test_m98_runs_an_inside_corner_out() -> None:
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30 M98", "L Y+30", "L X-40 R0", radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, 5), (30, 5), (25, 0), (25, 30), (-40, 30)]]


@pytest.mark.parametrize(
    ("function", "inside", "outside"), [("M111", 200, 200), ("M109", 150, 250), ("M110", 150, 200)]
)
def test_feeds_on_arcs(function: str, inside: float, outside: float) -> None:
    arcs = ("CC X+0 Y+20", "C X+0 Y+40 DR+", "CC X+0 Y+60", "C X+0 Y+80 DR-", "L X-20 R0")
    made = clean(START, f"L X+0 Y+0 RL F200 {function}", *arcs, radius=5)
    feeds = {move.center[1]: move.feed for move in made.moves if move.turn}
    assert (feeds[20.0], feeds[60.0]) == NEAR((inside, outside))


def test_the_radius_counts_all_deltas() -> None:
    made = clean("TOOL DEF 2 L+0 R+4 DR+0.5", "TOOL CALL 2 Z S1000 DR+0.25", START, "L X+0 RL F9", "L X+9", "L X+30 R0")
    assert flat(made)[0] == NEAR((0, 4.75))


def test_a_negative_radius_turns_the_side_over_and_says_so() -> None:
    made = runs("TOOL CALL 1 Z DR-7", START, "L X+0 RL F9", "L X+9", "L X+30 R0", radius=5)
    assert codes(made) == [("TOOL", 6)]
    assert flat(made)[:2] == [NEAR((0, -2)), NEAR((9, -2))]
    assert made.stretches[0].side.value == "RIGHT"


def test_an_approach_under_compensation_connects_two_contours() -> None:
    more = ("APPR LT X+50 Y+0 LEN+5 RL", "L X+90", "DEP LT LEN+5")
    made = clean(START, "L X+0 Y+0 RL F100", "L X+30", *more, radius=5)
    assert flat(made) == [NEAR(want) for want in [(0, 5), (30, 5), (45, 5), (50, 5), (90, 5), (95, 5)]]
    assert len(made.stretches) == 2


def test_approaches_go_down_at_ph_and_lct_on_its_way() -> None:
    contour = ("L X+30", "DEP LN Z+20 LEN+10")
    made = clean("L X-20 Y+5 Z+2 R0 FMAX", "APPR LT X+0 Y+0 Z-5 LEN+10 RL F100", *contour, radius=5)
    want = [(-10, 5, 2), (-10, 5, -5), (0, 5, -5), (30, 5, -5), (30, 15, -5), (30, 15, 20)]
    assert points(made) == [NEAR(point) for point in want]
    assert [move.rapid for move in made.moves][2:] == [True, True, False, False, False, False]
    made = clean("L X-20 Y+15 Z+2 R0 FMAX", "APPR LCT X+0 Y+0 Z-5 R10 RL F100", *contour, radius=5)
    assert points(made)[0][2] == points(made)[1][2] == -5


def test_polar_approach_and_departure() -> None:
    blocks = ("CC X+0 Y+0", "APPR PLCT PR+20 PA+0 R6 RR F100", "L Y+30", "DEP PLCT PR+60 PA+0 R6")
    made = clean("L X+60 Y+0 R0 FMAX", *blocks, radius=5)
    told = flat(made)
    assert told[1] == NEAR((25, 0, 31, 0, -1))
    assert told[2] == NEAR((25, 30))
    assert told[4] == NEAR((60, 0))
    for form in ("PLT", "PLN", "PCT"):
        size = "CCA+90 R+3" if form == "PCT" else "LEN+4"
        lead = f"APPR {form} PR+20 PA+0 {size} RR F9"
        made = clean("L X+60 Y+0 R0 FMAX", "CC X+0 Y+0", lead, "L Y+30", "DEP LT LEN+1")
        assert flat(made)[1][:2] == NEAR((25, 0))


def test_what_is_left_of_an_arc_between_its_trims() -> None:
    arc = arc_element((10.0, 0.0), (0.0, 10.0), (0.0, 0.0), 1, 0.0, 0.0, 0.0, 1)
    quarter = 8.0 * 3.14159265358979 / 2
    assert remaining(arc, (8.0, 0.0), (0.0, 8.0), 2.0) == NEAR(quarter)
    half = 8.0 * sqrt(0.5)
    assert remaining(arc, (half, half), (0.0, 8.0), 2.0) == NEAR(quarter / 2)
    assert remaining(arc, (half, half), (8.0, 0.0), 2.0) == NEAR(-quarter / 2)


def test_an_approach_without_compensation_leads_the_center_itself() -> None:
    made = clean("L X-30 Y+20 R0 FMAX", "APPR LT X+0 Y+0 LEN+10 R0 F100", "L X+30", "DEP LT LEN+10", radius=5)
    assert flat(made) == [NEAR(want) for want in [(-10, 0), (0, 0), (30, 0), (40, 0)]]
    assert made.stretches == ()


def test_leads_on_an_arc_without_compensation_say_which_side_they_take() -> None:
    blocks = ("APPR LCT X+0 Y+0 R10 R0 F100", "L X+30", "DEP LCT X+60 Y-20 R10")
    made = runs("L X-30 Y+20 R0 FMAX", *blocks, radius=5)
    assert codes(made) == [("INTERPRETED", 5), ("INTERPRETED", 7)]
    assert [move.turn for move in made.moves] == [0, 0, 0, 1, 0, -1, 0]


def test_depth_at_an_outside_corner_comes_before_its_arc_and_says_so() -> None:
    made = runs(START, "L X+0 Y+0 RL F100", "L X+30", "L Z-3", "L Y-30", "L X-40 R0", radius=5)
    assert codes(made) == [("INTERPRETED", 7)]
    assert points(made)[1:4] == [NEAR(point) for point in [(30, 5, 0), (30, 5, -3), (35, 0, -3)]]
