"""M120 LA: what the tool cannot reach is left out, worked out by hand with a tool of radius 5 on the left."""

from __future__ import annotations

from math import sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.controls.control_run import ControlRun
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.finding import Severity
from tests.core.controls.klartext.klartext_runs import codes, flat, runs
from tests.properties import exercised, must_exercise

NEAR = pytest.approx
START = "L X-30 Y-30 R0 FMAX"
GROOVE = ("L Y+20", "L X+3", "L Y+24", "L X+0", "L Y+50")
"""A groove of width 4 in the wall X 0: a tool of radius 5 over it stands between the corners (0, 20) and (0, 24)."""
OVER = [(-5, 0), (-5, 20), (-sqrt(21), 22, 0, 20, -1), (-5, 24, 0, 24, -1), (-5, 50)]


def left_out(made: ControlRun) -> list[int | None]:
    return [one.line for one in made.findings if one.code == "M120"]


def test_without_it_the_control_stops_at_the_groove() -> None:
    made = runs(START, "L X+0 Y+0 RL F100", *GROOVE, "L X-30 R0")
    assert (made.stopped_at, codes(made)[0]) == (7, ("HE3", 7))


def test_with_it_the_tool_runs_over_the_groove() -> None:
    made = runs(START, "L X+0 Y+0 RL F100 M120 LA5", *GROOVE, "L X-30 R0")
    assert made.stopped_at is None
    assert flat(made) == [NEAR(want) for want in [*OVER, (-30, 50)]]
    assert left_out(made) == [7, 8, 9]
    told = judged_findings(judge_run(made))
    assert [one.code for one in told] == ["UNCUT"]


def test_the_surface_is_all_that_is_programmed() -> None:
    (stretch,) = runs(START, "L X+0 Y+0 RL F100 M120 LA5", *GROOVE, "L X-30 R0").stretches
    assert stretch.programmed.lines.tolist()[1:] == [5, 6, 7, 8, 9, 10, 11]
    assert (stretch.entry, stretch.exit) == (1, 1)


def test_with_leads() -> None:
    blocks = ("APPR LCT X+0 Y+0 R3 RL F100 M120 LA5", *GROOVE, "DEP LCT X-30 Y+60 R3")
    made = runs(START, *blocks)
    assert flat(made)[1] == NEAR((-5, 0, -8, 0, 1))
    assert flat(made)[2:6] == [NEAR(want) for want in OVER[1:]]
    assert flat(made)[-1] == NEAR((-30, 60))


def test_an_arc_under_the_radius_is_left_out() -> None:
    # the quarters about (0, 20) and (0, 26) meet at y = 23: x = -sqrt(25 - 9)
    blocks = ("L Y+20", "CC X+0 Y+23", "C X+0 Y+26 DR+", "L Y+50", "L X-30 R0")
    made = runs(START, "L X+0 Y+0 RL F100 M120 LA5", *blocks)
    assert flat(made)[2:4] == [NEAR((-4, 23, 0, 20, -1)), NEAR((-5, 26, 0, 26, -1))]
    assert left_out(made) == [8]


def test_too_few_blocks_ahead_still_stop() -> None:
    made = runs(START, "L X+0 Y+0 RL F100 M120 LA2", *GROOVE, "L X-30 R0")
    assert (made.stopped_at, codes(made)[-1]) == (7, ("HE3", 7))
    # the moves up to there: the entry, the wall, and round its corner as far as over the groove's first side
    assert flat(made)[:2] == [NEAR((-5, 0)), NEAR((-5, 20))]
    assert {move.line for move in made.moves} <= {0, 4, 5, 6}


def test_it_begins_and_ends_within_a_contour() -> None:
    blocks = ("L Y+10", "L Y+20 M120 LA6", *GROOVE[1:], "L X-30 M120 LA0", "L Y+90", "L X-60 R0")
    made = runs(START, "L X+0 Y+0 RL F100", *blocks)
    assert made.stopped_at is None, made.findings
    # up to the groove, over it, and the inside corner at (0, 50), which is no longer looked ahead
    assert flat(made)[:5] == [NEAR(want) for want in [(-5, 0), (-5, 10), *OVER[1:4]]]
    behind = [(-5, 45), (-30, 45), (-35, 50, -30, 50, -1), (-35, 90), (-60, 90)]
    assert flat(made)[5:] == [NEAR(want) for want in behind]


AFTER_A_CORNER = ("L X+0 Y+0 RL F100", "L Y+20")
"""A wall, after whose corner one block more comes before M120; its offset is cut off at X-5."""


@pytest.mark.parametrize(
    ("blocks", "path"),
    [
        # a slanted wall: its offset runs through (-4, 17) with a slope of -4 to 3
        (("L X-30 Y+60",), [(-5, 17 + 4 / 3), (-32.5, 55)]),
        # an arc of 25 about (-20, 5): its offset has the radius 20, and 400 = 15^2 + 175
        (("CC X-20 Y+5", "C X-5 Y+25 DR+"), [(-5, 5 + sqrt(175)), (-20 + sqrt(175), 20, -20, 5, 1)]),
    ],
)
def test_the_block_before_it_keeps_its_trimmed_start(blocks: tuple[str, ...], path: list[tuple[float, ...]]) -> None:
    made = runs(START, *AFTER_A_CORNER, *blocks, "L X-60 M120 LA5", "L Y+90 R0")
    assert made.stopped_at is None
    assert flat(made)[1:-2] == [NEAR(want) for want in path]


@pytest.mark.parametrize("blocks", [("L X-1.8 Y+22.4",), ("CC X-20 Y+5", "C X-2.5 Y+22.8535711 DR+")])
def test_a_block_before_it_that_is_trimmed_away_stops_the_control(blocks: tuple[str, ...]) -> None:
    made = runs(START, *AFTER_A_CORNER, *blocks, "L X-60 M120 LA5", "L Y+90 R0")
    assert (made.stopped_at, codes(made)[0]) == (6 + len(blocks), ("HE3", 6 + len(blocks)))
    assert "no length left" in made.findings[0].text


def test_it_ends_with_r0() -> None:
    again = (START, "L X+0 Y+0 RL F100", *GROOVE, "L X-30 R0")
    made = runs(START, "L X+0 Y+0 RL F100 M120 LA5", *GROOVE, "L X-30 R0", *again)
    assert (made.stopped_at, codes(made)[-1][0]) == (15, "HE3")


@pytest.mark.parametrize(
    ("blocks", "rule", "line"),
    [
        (("L X+0 Y+0 RL F100 M120 LA5", "L Y+9", "L Z-3", "L Y+20"), "WORD", 7),
        (("L X+0 Y+0 RL F100 M120 LA5", "L Y+9 M97", "L Y+20"), "WORD", 6),
        (("L X+0 Y+0 RL F100 M120 LA100", "L Y+9"), "NUMBER", 5),
        (("L X+0 Y+0 RL F100 M120 LA2.5", "L Y+9"), "NUMBER", 5),
        (("L X+0 Y+0 RL F100 M120 LA", "L Y+9"), "NUMBER", 5),
        (("L X+0 Y+0 RL F100 M120 LA5",), "HE7", 5),
    ],
)
def test_what_stops(blocks: tuple[str, ...], rule: str, line: int) -> None:
    made = runs(START, *blocks)
    assert (rule, line) in codes(made)
    assert made.stopped_at == line


def test_the_tool_axis_may_move_before_the_contour() -> None:
    made = runs(START, "L X+0 Y+0 RL F100 M120 LA5", "L Z-3", *GROOVE, "L X-30 R0")
    assert made.stopped_at is None
    assert {move.point[2] for move in list(made.moves)[3:]} == {-3.0}


def test_without_compensation_it_does_nothing_and_says_so() -> None:
    made = runs(START, "L X+5 F100 M120 LA5", "L X+0 Y+0 RL", *GROOVE, "L X-30 R0")
    assert codes(made)[0] == ("M", 5)
    assert codes(made)[-1] == ("HE3", 8)


@must_exercise(0.3, "runs")
@must_exercise(0.03, "leaves out")
@given(
    st.lists(st.tuples(st.integers(-12, 12), st.integers(1, 12)), min_size=2, max_size=14),
    st.integers(1, 99),
    st.sampled_from(["RL", "RR"]),
)
def test_where_it_runs_its_moves_join_and_no_line_is_lost(steps: list[tuple[int, int]], depth: int, side: str) -> None:
    """A staircase of any kind: a run that does not stop has every block as surface, and says what it leaves out."""
    blocks = [f"L IX{dx:+d} IY+{dy}" for dx, dy in steps]
    made = runs("L X+0 Y-40 R0 FMAX", f"L X+0 Y+0 {side} F100 M120 LA{depth}", *blocks, "L IY+40 R0")
    if made.stopped_at is not None:
        assert made.findings[-1].severity is Severity.ERROR
        return
    exercised("runs")
    (stretch,) = made.stretches
    assert stretch.programmed.lines.tolist()[1:] == list(range(5, 5 + len(blocks) + 2))
    cut = set(made.moves.lines.tolist())
    assert cut | set(left_out(made)) >= set(range(6, 6 + len(blocks)))
    if left_out(made):
        exercised("leaves out")
