"""Compensated contours that cut into one another; the depths are worked out by hand beside each program."""

from __future__ import annotations

import pytest

from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, ToolTable
from core.controls.judged_runs import judge_run, judged_findings
from core.controls.registry import run
from core.finding import Severity

TOOLS = ToolTable.of(CutterTool(1, 10.0))
POCKET = "G0 X40 Y0\nG1 Z-5\nG41 D1 X50 Y0\nY50\nX-50\nY-50\nX50\nY0\nG40 X40\nG0 Z2\n"
"""A pocket of 100 by 100."""


def told(*contours: str) -> list[tuple[int | None, str]]:
    """The lines and places of what is said of contours cut by one another."""
    text = "G21 G17 G40 G90 F300\nG0 Z2\n" + "".join(contours) + "M2\n"
    done = run(text.encode(), "fanuc:a", TOOLS)
    assert isinstance(done, ControlRun)
    assert done.stopped_at is None, done.findings
    results = judge_run(done)
    assert not any(result.verdict.gouges for result in results)
    findings = [one for one in judged_findings(results) if one.code == "OTHER-CONTOUR"]
    assert all(one.severity is Severity.WARNING for one in findings)
    return [(one.line, f"{one.value:.3f}") for one in findings]


def box(x: float, y: float, size: float, z: float) -> str:
    """A boss of this size on its lower left corner, cut around with the tool on its left."""
    return (
        f"G0 X{x - 20} Y{y - 20}\nG1 Z{z}\nG41 D1 X{x} Y{y - 10}\nY{y + size}\nX{x + size}\nY{y}\nX{x - 10}\n"
        f"G40 X{x - 20} Y{y - 20}\nG0 Z2\n"
    )


def circle(radius: float, z: float = -5.0) -> str:
    """A round pocket about 0,0."""
    return f"G0 X0 Y0\nG1 Z{z}\nG41 D1 X{radius}\nG3 I-{radius}\nG40 G1 X0\nG0 Z2\n"


@pytest.mark.parametrize(("top", "depth"), [(39.0, None), (42.0, "2.000"), (44.5, "4.500")])
def test_an_island_too_near_to_its_pocket(top: float, depth: str | None) -> None:
    """Around the island the cutter reaches 10 beyond its wall, which is 50 - top from the pocket's."""
    island = f"G0 X-40 Y0\nG1 Z-5\nG41 D1 X-20 Y0\nY{top}\nX20\nY-20\nX-20\nY0\nG40 X-40\nG0 Z2\n"
    found = told(POCKET, island)
    assert max(found, key=lambda one: one[1])[1] == depth if depth else not found


def test_a_contour_at_a_wrong_place_is_told_whichever_is_cut_first() -> None:
    """The second boss stands 30 to the right of the first one: each path runs through the other."""
    assert told(box(0, 0, 40, -5), box(30, 0, 40, -5))
    assert not told(box(0, 0, 40, -5), box(70, 0, 40, -5))


def test_passes_that_widen_a_pocket_cut_away_only_what_they_leave() -> None:
    assert not told(*(circle(radius) for radius in (8.0, 14.0, 20.0, 26.0)))


def test_a_contour_cut_at_several_depths_is_no_other_contour() -> None:
    assert not told(*(box(0, 0, 40, z) for z in (-2, -4, -6)))


def test_a_step_above_a_deeper_wall_is_none() -> None:
    """The path around the upper boss, 3 inside two walls of the lower one, runs over these."""
    assert not told(box(0, 0, 40, -10), box(3, 3, 37, -5))
    assert told(box(0, 0, 40, -5), box(3, 3, 37, -10))


def test_a_slot_through_a_wall_is_asked_about() -> None:
    slot = "G0 X30 Y-20\nG1 Z-5\nG42 D1 X23 Y-12\nY20\nG2 X37 R7\nG1 Y-12\nG40 X30 Y-20\nG0 Z2\n"
    assert told(box(0, 0, 60, -5), slot)
