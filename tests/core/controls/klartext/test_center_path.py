"""The compensated path calculated by hand: entry, corners, exit, M97, M98, feeds on arcs and stops."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

import pytest

from core.controls.compensation.elements import arc_element
from core.controls.klartext.center_path import remaining
from core.finding import Severity
from tests.core.controls.klartext.klartext_runs import clean, codes, flat, points, runs

NEAR = pytest.approx
START = "L X-20 Y+0 R0 FMAX"


def test_the_entry_and_the_exit_are_square_to_their_elements() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+8 Y+6", "L X+40 Y-20 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(-3, 4), (5, 10), (40, -20)]]
    (stretch,) = run.stretches
    assert (stretch.entry, stretch.exit, stretch.radius) == (1, 1, 5)
    assert (stretch.first, stretch.last) == (1, 5)
    assert stretch.programmed.points[:, :2].tolist() == [[-20, 0], [0, 0], [8, 6], [40, -20]]


def test_nearly_straight_corners_far_from_the_origin_are_no_alarm() -> None:
    ends = ["L X+14218.3464 Y+5934.4881", "L X+14219.2301 Y+5935.3814", "L X+14219.2301 Y+6000"]
    run = clean("L X+14210 Y+5930 R0 FMAX", "L X+14217.4626 Y+5933.5947 RL F100", *ends, "L X+0 R0", radius=0.5)
    assert len(run.moves) == 7


def test_the_entry_before_an_arc_is_radial() -> None:
    run = clean(START, "L X+0 Y+0 RR F100", "CC X+0 Y+20", "C X+20 Y+20 DR+", "L X+20 Y+60 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, -5), (25, 20, 0, 20, 1), (20, 60)]]


def test_an_outside_corner_gets_an_arc_about_it() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30", "L Y-30", "L X-40 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, 5), (30, 5), (35, 0, 30, 0, -1), (35, -30), (-40, -30)]]


def test_the_arc_of_an_outside_corner_on_the_right_is_counterclockwise() -> None:
    run = clean(START, "L X+0 Y+0 RR F100", "L X+30", "L Y+30", "L X-40 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, -5), (30, -5), (35, 0, 30, 0, 1), (35, 30), (-40, 30)]]


def test_offsets_meet_at_an_inside_corner() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30", "L Y+30", "L X-40 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, 5), (25, 5), (25, 30), (-40, 30)]]


def test_a_reversal_is_an_outside_corner_of_half_a_turn() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30", "L X+10", "L Y-40 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, 5), (30, 5), (30, -5, 30, 0, -1), (10, -5), (10, -40)]]


def test_a_tangent_joint_gets_no_arc() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30", "CC X+30 Y+20", "C X+50 Y+20 DR+", "L Y+60 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, 5), (30, 5), (45, 20, 30, 20, 1), (50, 60)]]


def test_offsets_of_a_line_and_an_arc_meet_at_an_inside_corner() -> None:
    # The line y = 5 meets the circle of radius 20 - 5 about (30, 0) at x = 30 - sqrt(15 ** 2 - 5 ** 2).
    meeting = 30 - sqrt(200)
    blocks = ("CC X+30 Y+0", "L X+50", "C X+10 Y+0 DR+", "L X+0 Y-40 R0")
    run = clean("L X+0 Y-20 R0 FMAX", "L X+20 Y+0 RL F100", *blocks, radius=5)
    assert flat(run)[0] == NEAR((20, 5))
    assert flat(run)[1] == NEAR((30 + sqrt(200), 5))
    assert flat(run)[2] == NEAR((15, 0, 30, 0, 1))
    assert meeting == NEAR(15.857864)


def test_offsets_of_two_arcs_meet_at_an_inside_corner() -> None:
    # Two arcs of radius 20 about (0, 0) and (24, 0) meet at (12, 16); offset to 15 they meet at (12, 9).
    blocks = ("CC X+0 Y+0", "C X+12 Y+16 DR+", "CC X+24 Y+0", "C X+24 Y-20 DR+", "L X+80 R0")
    run = clean("L X+40 Y-20 R0 FMAX", "L X+0 Y-20 RL F100", *blocks, radius=5)
    assert flat(run)[:3] == [NEAR(expected) for expected in [(0, -15), (12, 9, 0, 0, 1), (24, -15, 24, 0, 1)]]


def test_a_full_circle_stays_one() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "CC X+20 Y+0", "C X+0 Y+0 DR+", "L X-20 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(5, 0), (5, 0, 20, 0, 1), (-20, 0)]]
    assert run.moves[3].point == run.moves[2].point


def test_a_full_circle_between_tangent_lines_stays_one() -> None:
    circle = ("L X+20", "CC X+20 Y+20", "C X+20 Y+0 DR+", "L X+40", "L Y-20 R0")
    run = clean(START, "L X+0 Y+0 RL F100", *circle, radius=5)
    assert flat(run)[1:4] == [NEAR(expected) for expected in [(20, 5), (20, 5, 20, 20, 1), (40, 5)]]
    assert run.moves[4].point == run.moves[3].point


def test_depth_moves_are_at_the_end_of_the_element_before() -> None:
    blocks = ("L Z-5", "L X+30", "L Z-8", "L Y+30", "L Z+50 FMAX", "L X-40 R0 F100")
    run = clean(START, "L X+0 Y+0 RL F100", *blocks, radius=5)
    expected = [(0, 5, 0), (0, 5, -5), (25, 5, -5), (25, 5, -8), (25, 30, -8), (25, 30, 50), (-40, 30, 50)]
    assert points(run) == [NEAR(point) for point in expected]


def test_a_height_in_a_contour_block_changes_along_the_block() -> None:
    run = clean("L X-20 Y+0 Z+2 R0 FMAX", "L X+0 Y+0 Z-1 RL F100", "L X+30 Z-4", "L X+60 R0", radius=5)
    assert points(run) == [NEAR(point) for point in [(0, 5, -1), (30, 5, -4), (60, 0, -4)]]


def test_a_side_set_without_movement_takes_effect_in_the_next_line() -> None:
    run = runs(START, "L Z-5 RL F100", "L X+0 Y+0", "L X+30", "L Z+5 R0", "L X+60", radius=5)
    assert codes(run) == [("INTERPRETED", 5), ("INTERPRETED", 8)]
    expected = [(-20, 0, -5), (0, 5, -5), (30, 5, -5), (30, 5, 5), (60, 0, 5)]
    assert points(run) == [NEAR(point) for point in expected]


def test_r0_in_the_tool_axis_ends_compensation_for_a_tool_change_and_the_end() -> None:
    contour = (START, "L Z-5 R0 F100", "L X+0 Y+0 RL", "L X+30", "L Z+50 R0 FMAX")
    run = runs(*contour, "TOOL DEF 2 L+0 R+3", "TOOL CALL 2 Z S1000", "L X+60 Y+0 FMAX")
    assert (codes(run), run.stopped_at) == ([("INTERPRETED", 8), ("INTERPRETED", 10)], None)
    expected = [(-20, 0, -5), (0, 5, -5), (30, 5, -5), (30, 5, 50), (60, 0, 50)]
    assert points(run) == [NEAR(point) for point in expected]
    assert codes(runs(*contour)) == [("INTERPRETED", 8)]
    assert codes(runs(*contour[:-1]))[-1][0] == "PROGRAM"
    assert codes(runs(*contour[:-1], "TOOL CALL 2 Z S1000"))[-1] == ("TOOL", 8)


def test_m97_makes_offsets_meet_at_an_outside_corner() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30 M97", "L Y-0.5", "L X+60", "L Y+40 R0", radius=5)
    assert flat(run)[1:4] == [NEAR(expected) for expected in [(35, 5), (35, 4.5), (60, 4.5)]]


def test_a_step_that_needs_m97_stops_the_run_without_it() -> None:
    run = runs(START, "L X+0 Y+0 RL F100", "L X+30", "L Y-0.5", "L X+60", "L Y+40 R0", radius=5)
    assert codes(run) == [("HE3", 7)]
    assert run.stopped_at == 7
    assert flat(run)[-1] == NEAR((35, 0, 30, 0, -1))


def test_m98_runs_to_the_end_of_an_inside_corner() -> None:
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30 M98", "L Y+30", "L X-40 R0", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, 5), (30, 5), (25, 0), (25, 30), (-40, 30)]]


@pytest.mark.parametrize(
    ("function", "inside", "outside"), [("M111", 200, 200), ("M109", 150, 250), ("M110", 150, 200)]
)
def test_m109_to_m111_set_the_feed_on_arcs(function: str, inside: float, outside: float) -> None:
    arcs = ("CC X+0 Y+20", "C X+0 Y+40 DR+", "CC X+0 Y+60", "C X+0 Y+80 DR-", "L X-20 R0")
    run = clean(START, f"L X+0 Y+0 RL F200 {function}", *arcs, radius=5)
    feeds = {move.center[1]: move.feed for move in run.moves if move.turn}
    assert (feeds[20.0], feeds[60.0]) == NEAR((inside, outside))


def test_the_radius_includes_all_deltas() -> None:
    run = runs("TOOL DEF 2 L+0 R+4 DR+0.5", "TOOL CALL 2 Z S1000 DR+0.25", START, "L X+0 RL F9", "L X+9", "L X+30 R0")
    assert flat(run)[0] == NEAR((0, 4.75))


@pytest.mark.parametrize(
    ("delta", "severity", "lengths"),
    [("-0.05", Severity.INFO, (4.95,)), ("+0.5", Severity.INFO, (5.5,)), ("-3", Severity.WARNING, (2.0, 5.0, 3.0))],
)
def test_a_delta_that_is_more_than_wear_is_a_warning(delta: str, severity: Severity, lengths: Sequence[float]) -> None:
    run = runs(f"TOOL CALL 1 Z DR{delta}", START, "L X+0 RL F9", "L X+9", "L X+30 R0", radius=5)
    (told,) = run.findings
    assert (told.code, told.line, told.severity) == ("TOOL", 4, severity)
    assert told.lengths == NEAR(lengths)


def test_a_negative_radius_swaps_the_side_and_is_reported() -> None:
    run = runs("TOOL CALL 1 Z DR-7", START, "L X+0 RL F9", "L X+9", "L X+30 R0", radius=5)
    assert codes(run) == [("TOOL", 6)]
    assert flat(run)[:2] == [NEAR((0, -2)), NEAR((9, -2))]
    assert run.stretches[0].side.value == "RIGHT"


def test_an_approach_under_compensation_connects_two_contours() -> None:
    more = ("APPR LT X+50 Y+0 LEN+5 RL", "L X+90", "DEP LT LEN+5")
    run = clean(START, "L X+0 Y+0 RL F100", "L X+30", *more, radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(0, 5), (30, 5), (45, 5), (50, 5), (90, 5), (95, 5)]]
    assert len(run.stretches) == 2


def test_approaches_descend_at_ph_and_lct_on_its_way() -> None:
    contour = ("L X+30", "DEP LN Z+20 LEN+10")
    run = clean("L X-20 Y+5 Z+2 R0 FMAX", "APPR LT X+0 Y+0 Z-5 LEN+10 RL F100", *contour, radius=5)
    expected = [(-10, 5, 2), (-10, 5, -5), (0, 5, -5), (30, 5, -5), (30, 15, -5), (30, 15, 20)]
    assert points(run) == [NEAR(point) for point in expected]
    assert [move.rapid for move in run.moves][2:] == [True, True, False, False, False, False]
    run = clean("L X-20 Y+15 Z+2 R0 FMAX", "APPR LCT X+0 Y+0 Z-5 R10 RL F100", *contour, radius=5)
    assert points(run)[0][2] == points(run)[1][2] == -5


def test_polar_approaches_and_departures_run() -> None:
    blocks = ("CC X+0 Y+0", "APPR PLCT PR+20 PA+0 R6 RR F100", "L Y+30", "DEP PLCT PR+60 PA+0 R6")
    run = clean("L X+60 Y+0 R0 FMAX", *blocks, radius=5)
    moves = flat(run)
    assert moves[1] == NEAR((25, 0, 31, 0, -1))
    assert moves[2] == NEAR((25, 30))
    assert moves[4] == NEAR((60, 0))
    for form in ("PLT", "PLN", "PCT"):
        size = "CCA+90 R+3" if form == "PCT" else "LEN+4"
        lead = f"APPR {form} PR+20 PA+0 {size} RR F9"
        run = clean("L X+60 Y+0 R0 FMAX", "CC X+0 Y+0", lead, "L Y+30", "DEP LT LEN+1")
        assert flat(run)[1][:2] == NEAR((25, 0))


def test_remaining_is_the_length_of_an_arc_between_its_trims() -> None:
    arc = arc_element((10.0, 0.0), (0.0, 10.0), (0.0, 0.0), 1, 0.0, 0.0, 0.0, 1)
    quarter = 8.0 * 3.14159265358979 / 2
    assert remaining(arc, (8.0, 0.0), (0.0, 8.0), 2.0) == NEAR(quarter)
    half = 8.0 * sqrt(0.5)
    assert remaining(arc, (half, half), (0.0, 8.0), 2.0) == NEAR(quarter / 2)
    assert remaining(arc, (half, half), (8.0, 0.0), 2.0) == NEAR(-quarter / 2)


def test_an_approach_without_compensation_moves_the_center() -> None:
    run = clean("L X-30 Y+20 R0 FMAX", "APPR LT X+0 Y+0 LEN+10 R0 F100", "L X+30", "DEP LT LEN+10", radius=5)
    assert flat(run) == [NEAR(expected) for expected in [(-10, 0), (0, 0), (30, 0), (40, 0)]]
    assert run.stretches == ()


def test_arc_leads_without_compensation_report_their_side() -> None:
    blocks = ("APPR LCT X+0 Y+0 R10 R0 F100", "L X+30", "DEP LCT X+60 Y-20 R10")
    run = runs("L X-30 Y+20 R0 FMAX", *blocks, radius=5)
    assert codes(run) == [("INTERPRETED", 5), ("INTERPRETED", 7)]
    assert [move.turn for move in run.moves] == [0, 0, 0, 1, 0, -1, 0]


def test_a_depth_move_at_an_outside_corner_is_before_its_arc_and_is_reported() -> None:
    run = runs(START, "L X+0 Y+0 RL F100", "L X+30", "L Z-3", "L Y-30", "L X-40 R0", radius=5)
    assert codes(run) == [("INTERPRETED", 7)]
    assert points(run)[1:4] == [NEAR(point) for point in [(30, 5, 0), (30, 5, -3), (35, 0, -3)]]
