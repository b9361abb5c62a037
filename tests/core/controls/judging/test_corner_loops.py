"""Loops around outside corners: moves that keep a corner sharp, and no walls."""

from __future__ import annotations

from itertools import pairwise

import pytest

from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, table_of
from core.controls.judging.corner_loops import without_corner_loops
from core.controls.judging.judged_contour import JudgedContour
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.controls.registry import run
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Line, Side
from core.verify.judge import judge

HEAD = "G21 G17 G40 G90 F300\nG0 X-20. Y-20.\nG1 Z-5.\nG41 D1 X0. Y-10.\n"
FOOT = "Y0.\nX-10.\nG40 X-20. Y-20.\nM30\n"
LOOPS = {
    "an arc": "Y48.\nG3 X-8. Y40. I-8. J0.\nG1 X60.\n",
    "straight": "Y52.\nX-12.\nY40.\nX60.\n",
    "straight at two corners": "Y52.\nX-12.\nY40.\nX72.\nY52.\nX60.\n",
}
"""Around the corner X0 Y40 of a plate of 60 by 40 that is cut around with the tool on its left."""


def judged(cut: str, control: str = "fanuc:a") -> tuple[tuple[JudgedContour, ...], list[Finding]]:
    """The verdicts on a cut with a tool of 10, and what is told of loops."""
    done = run(f"{HEAD}{cut}{FOOT}".encode(), control, table_of(CutterTool(1, 10.0)))
    assert isinstance(done, ControlRun)
    assert done.stopped_at is None, done.findings
    results = judge_run(done)
    return results, [finding for finding in judged_findings(results) if finding.code == "CORNER-LOOP"]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "nine-series:a"])
@pytest.mark.parametrize("cut", LOOPS)
def test_a_loop_around_an_outside_corner_is_no_wall(cut: str, control: str) -> None:
    (result,), told = judged(LOOPS[cut], control)
    assert result.verdict.clean
    assert not result.verdict.uncut
    assert len(told) == (2 if "two" in cut else 1)
    assert told[0].at == pytest.approx((0.0, 40.0))
    assert all(finding.severity is Severity.INFO for finding in told)


def test_a_long_loop_is_a_warning() -> None:
    _, (told,) = judged("Y62.\nX-22.\nY40.\nX60.\n")
    assert told.severity is Severity.WARNING


@pytest.mark.parametrize(
    "cut",
    [
        pytest.param("Y48.\nG2 X8. Y40. I8. J0.\nG1 X-9.\nY60.\nX60.\n", id="with other crossings"),
        pytest.param("Y140.\nX-100.\nY40.\nX60.\n", id="longer than half of the rest"),
    ],
)
def test_other_loops_stay_walls(cut: str) -> None:
    results, told = judged(cut)
    assert not told
    assert any(result.verdict.gouges for result in results)


def test_on_the_other_side_the_same_moves_are_no_loop() -> None:
    """There the part lies inside of the loop."""
    corners = [(0.0, -10.0), (0.0, 48.0), (-8.0, 48.0), (-8.0, 40.0), (60.0, 40.0), (60.0, 0.0)]
    path = Path.from_pieces([Line(*both) for both in pairwise(corners)])
    left, loops = without_corner_loops(path, Side.LEFT)
    assert left.points.tolist() == [[0.0, -10.0], [0.0, 40.0], [60.0, 40.0], [60.0, 0.0]]
    assert [loop.numbers for loop in loops] == [(1.0, 2.0, 3.0, 4.0)]
    assert without_corner_loops(path, Side.RIGHT) == (path, ())


def test_the_wall_behind_a_loop_is_judged() -> None:
    """The tool comes back along the next wall 3 too deep: that wall is programmed so, and the plate's is not cut."""
    (result,), told = judged("Y48.\nG3 X-8. Y40. I-8. J0.\nG1 X60.\nY35.\nX52.\n")
    assert told
    assert result.surface.points[:, 1].max() == 40.0
    # a center 3 from that wall, which should be 5 from it
    too_deep = Path.from_pieces([Line((-5.0, 43.0), (60.0, 43.0))])
    (gouge,) = judge(result.surface, Side.LEFT, 5.0, too_deep).gouges
    assert gouge.depth == pytest.approx(2.0)


REPEATED = (
    "G21 G17 G40 G90 F300\nG0 X-30. Y-30.\nG1 Z0.\nG41 D1 X0. Y-20.\nM98 P2000 L4\nG40 G1 X-30. Y-30.\nM30\n"
    "O2000\nG91 G1 Z-2.5\nG90 Y50.\n{around}X0.\nM99\n"
)
"""Four depths of a plate of 80 by 50, with a loop around the corner X0 Y0 from each one to the next."""


@pytest.mark.parametrize("control", ["haas:a", "haas:b-yasnac", "nine-series:a"])
def test_a_loop_may_lead_from_one_depth_to_the_next(control: str) -> None:
    text = REPEATED.format(around="X80.\nY0.\nX-20.\nY-20.\n")
    done = run(text.encode(), control, table_of(CutterTool(1, 16.0)))
    assert isinstance(done, ControlRun)
    (result,) = results = judge_run(done)
    assert result.verdict.clean
    (told,) = [finding for finding in judged_findings(results) if finding.code == "CORNER-LOOP"]
    assert told.at == pytest.approx((0.0, 0.0))
    # 80 of the loop against the 260 around the plate
    assert (told.severity, result.corner_loops[0].numbers) == (Severity.WARNING, (13.0, 14.0, 15.0, 10.0))


@pytest.mark.parametrize(
    ("control", "around"),
    [
        pytest.param("haas:a", "X80.\nY0.\nX-14.\nY-20.\n", id="a loop narrower than the cutter"),
        pytest.param("fanuc:a", "X80.\nY0.\nX10.\nY-20.\n", id="no loop"),
        pytest.param("haas:a", "X80.\nY20.\nX-20.\nY-20.\n", id="back through the plate"),
    ],
)
def test_a_gouge_where_a_loop_leads_to_the_next_depth_is_found(control: str, around: str) -> None:
    done = run(REPEATED.format(around=around).encode(), control, table_of(CutterTool(1, 16.0)))
    assert isinstance(done, ControlRun)
    assert done.stopped_at is not None or any(result.verdict.gouges for result in judge_run(done))


ROUGHED = (
    "G21 G17 G40 G90 F400\nG0 X-40. Y-40.\nG1 Z-10.\nG41 D2 X0. Y-30.\nY50.\nX80.\nY0.\nX-30.\nY-30.\n"
    "D1 X0.\n{finish}X-30.\nG40 X-40. Y-40.\nM30\n"
)
"""A plate of 80 by 50 cut with D2 and then with D1, with a loop around the corner X0 Y0 between both."""


@pytest.mark.parametrize(
    ("finish", "line"),
    [
        ("Y50.\nX80.\nY0.\n", None),
        pytest.param("Y48.\nX80.\nY0.\n", 12, id="a wall too low"),
        pytest.param("Y50.\nX77.\nY0.\n", 13, id="a wall too near"),
        pytest.param("Y50.\nX80.\nY3.\n", 14, id="a wall too high"),
    ],
)
def test_a_loop_may_lead_from_the_roughing_offset_to_the_finishing_one(finish: str, line: int | None) -> None:
    tools = table_of(CutterTool(1, 12.0), CutterTool(2, 12.5))
    done = run(ROUGHED.format(finish=finish).encode(), "fanuc:a", tools)
    assert isinstance(done, ControlRun)
    assert done.stopped_at is None, done.findings
    findings = judged_findings(judge_run(done))
    gouges = {finding.line for finding in findings if finding.severity is Severity.ERROR}
    assert (line in gouges) if line else not gouges
    assert line or not [finding for finding in findings if finding.code in ("LEADS", "LEAD-GOUGE", "UNCUT")]
