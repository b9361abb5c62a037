"""Compensated contours that cut into one another; the depths are worked out by hand beside each program."""

from __future__ import annotations

import pytest

from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, table_of
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.controls.registry import run
from core.finding import Severity

TOOLS = table_of(CutterTool(1, 10.0))
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


def test_a_contour_at_a_wrong_place_is_reported_whichever_is_cut_first() -> None:
    """The second boss stands 30 to the right of the first one: each path runs through the other."""
    assert told(box(0, 0, 40, -5), box(30, 0, 40, -5))
    assert not told(box(0, 0, 40, -5), box(70, 0, 40, -5))


def test_a_pass_into_the_wall_of_the_next_stretch_is_reported() -> None:
    """The first pass has X78 for X80: it cuts 2 into the wall that the second pass leaves."""
    lap = "G41 D1 X-12 Y13\nG3 X0 Y25 R12\nG1 Y50\nX{}\nY0\nX0\nY25\nG3 X-12 Y37 R12\nG1 G40 X-30 Y25\n"
    assert told(f"G0 X-30 Y25\nG1 Z-6\n{lap.format(78)}{lap.format(80)}G0 Z50\n") == [(9, "2.000")]
    assert not told(f"G0 X-30 Y25\nG1 Z-6\n{lap.format(80)}{lap.format(80)}G0 Z50\n")


def test_passes_that_widen_a_pocket_cut_away_only_what_they_leave() -> None:
    assert not told(*(circle(radius) for radius in (8.0, 14.0, 20.0, 26.0)))


def test_a_contour_cut_at_several_depths_is_no_other_contour() -> None:
    assert not told(*(box(0, 0, 40, z) for z in (-2, -4, -6)))


def test_a_step_above_a_deeper_wall_is_none() -> None:
    """The path around the upper boss, 3 inside two walls of the lower one, runs over these."""
    assert not told(box(0, 0, 40, -10), box(3, 3, 37, -5))
    assert told(box(0, 0, 40, -5), box(3, 3, 37, -10))


def test_an_open_slot_is_no_wall_past_the_edge() -> None:
    """The boss ends at X 40, the slot at X 60: the path around the boss, at X 45, crosses what is no wall."""
    slot = "G0 X70 Y20\nG1 Z-5\nG41 D1 X60 Y30\nX20\nY10\nX60\nG40 X70 Y20\nG0 Z2\n"
    found = told(box(0, 0, 40, -5), slot)
    assert [line for line, _ in found] == [15]


def test_a_slot_through_a_wall_is_asked_about() -> None:
    slot = "G0 X30 Y-20\nG1 Z-5\nG42 D1 X23 Y-12\nY20\nG2 X37 R7\nG1 Y-12\nG40 X30 Y-20\nG0 Z2\n"
    assert told(box(0, 0, 60, -5), slot)


def pocket(stock: float, corner: float = 0.0) -> str:
    """A pocket of 100 by 60 with this stock on its walls, its corners rounded by a radius."""
    low, right, top = stock, 100 - stock, 60 - stock
    arc = [f"G3 X{x} Y{y} R{corner}\nG1 " if corner else "" for x, y in ((right, low + corner), (right - corner, top))]
    arc += [f"G3 X{x} Y{y} R{corner}\nG1 " if corner else "" for x, y in ((low, top - corner), (low + corner, low))]
    return (
        f"G0 X50 Y30\nG1 Z-5\nG41 D1 X50 Y{low}\nX{right - corner}\n{arc[0]}Y{top - corner}\n{arc[1]}X{low + corner}\n"
        f"{arc[2]}Y{low + corner}\n{arc[3]}X50\nG40 Y30\nG0 Z2\n"
    )


@pytest.mark.parametrize(("stock", "corner"), [(0.3, 0.0), (0.03, 6.0), (0.3, 6.0)])
def test_of_a_roughed_pocket_the_finishing_cut_is_no_cut_of_another_contour(stock: float, corner: float) -> None:
    """In sharp corners the rough wall stays where neither pass comes; stock of a few hundredths counts too."""
    assert not told(pocket(stock, corner), pocket(0.0, corner))


@pytest.mark.parametrize("first", [True, False])
def test_an_island_that_is_milled_away_is_reported(first: bool) -> None:
    """A pass of 10 around 22 to 38 goes over all of an island from 26 to 34: 64 square millimeters, and none left."""
    ring = (
        "G0 X30 Y30\nG1 Z-5\nG41 D1 X30 Y22\nX32\nG3 X38 Y28 R6\nG1 Y32\nG3 X32 Y38 R6\nG1 X28\nG3 X22 Y32 R6\n"
        "G1 Y28\nG3 X28 Y22 R6\nG1 X30\nG40 Y30\nG0 Z2\n"
    )
    island = "G0 X30 Y18\nG1 Z-5\nG41 D1 X30 Y26\nX26\nY34\nX34\nY26\nX30\nG40 Y18\nG0 Z2\n"
    assert len(told(*(ring, island) if first else (island, ring))) == 1


@pytest.mark.parametrize("between", ["G55\n", "G0 A90\n"])
def test_contours_under_different_work_offsets_or_clampings_are_not_compared(between: str) -> None:
    """Another work offset that is set on the control, or a turned part."""
    assert told(box(0, 0, 40, -5), box(30, 0, 40, -5))
    assert not told(box(0, 0, 40, -5), between, box(30, 0, 40, -5))


@pytest.mark.parametrize("back", ["G54\nG0 B0\n", "G91 B-90\nG90 G54\n", "G91 G28 B0\nG90 G54\n"])
def test_a_setup_that_comes_again_is_compared_with_itself(back: str) -> None:
    """Three faces on a rotary table, each with its own contours in the same X and Y."""
    face = box(0, 0, 40, -5)
    other_faces = f"G55 B90\n{box(10, 0, 40, -5)}B180\n{box(20, 0, 40, -5)}B90\n"
    assert not told(face, other_faces, back)
    assert told(face, other_faces, back, box(30, 0, 40, -5))
