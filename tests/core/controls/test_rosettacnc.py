"""RosettaCNC's samples and entries against hand calculations: diameter 6 in the square, 10 in the window."""

from __future__ import annotations

from math import acos, cos, radians, sin, sqrt

import pytest

from core.controls.control_run import ControlRun
from core.controls.judging.judged_runs import judge_run
from tests.core.controls.hand import findings_of, lines_and_ends, run_of, same, sample, shape

AFTER_ENTRY = [
    ("ccw", 30, 3, 30, 10),
    ("line", 40, 3),
    ("ccw", 47, 10, 40, 10),
    ("line", 47, 40),
    ("ccw", 40, 47, 40, 40),
    ("line", 10, 47),
    ("ccw", 3, 40, 10, 40),
    ("line", 3, 10),
    ("ccw", 10, 3, 10, 10),
    ("line", 30, 3),
    ("rapid", 30, 10),
]


def test_nist_refuses_the_inside_corner_of_the_lead_in() -> None:
    run = sample("rosettacnc-square.ngc", "rosettacnc", t1=6)
    assert (run.control, run.stopped_at) == ("rosettacnc:nist", 15)
    assert findings_of(run, "C6")[0].line == 15


def test_nist_enters_along_the_tangent_to_the_tool_at_its_start() -> None:
    run = run_of("G21 F100\nG0 X0 Y0\nG41 D1\nG1 X10\nX20\n", "rosettacnc:nist", t1=6)
    angle = radians(180) - acos(3 / 10)
    wanted = ("line", 10 + 3 * cos(angle), 3 * sin(angle))
    assert same(shape(run)[1:2], [wanted])
    assert same(shape(run)[2:], [("cw", 10, 3, 10, 0), ("line", 20, 3)])


def test_nist_enters_on_the_right_as_the_mirror_image() -> None:
    left = shape(run_of("G21 F100\nG0 X0 Y0\nG41 D1\nG1 X10\nX20 Y-5\n", "rosettacnc:nist", t1=6))
    right = shape(run_of("G21 F100\nG0 X0 Y0\nG42 D1\nG1 X10\nX20 Y5\n", "rosettacnc:nist", t1=6))
    mirrored = [
        ("ccw" if move[0] == "cw" else move[0], *((-1) ** index * float(str(v)) for index, v in enumerate(move[1:])))
        for move in left
    ]
    assert same(right, mirrored)


def test_easy_enters_at_the_tangent_point_of_the_second_move() -> None:
    run = sample("rosettacnc-square.ngc", "rosettacnc:easy", t1=6)
    assert run.stopped_at is None
    assert same(shape(run)[-12:], [("line", 23, 10), *AFTER_ENTRY])


def test_normal_enters_like_linuxcnc_and_reports_the_assumption() -> None:
    run = sample("rosettacnc-square.ngc", "rosettacnc:normal", t1=6)
    assert same(shape(run)[-12:], [("line", 30 - sqrt(49 - 9), 7), *AFTER_ENTRY])
    assert "cutcomp assumes" in findings_of(run, "ENTRY")[0].text


@pytest.mark.parametrize("variant", ["easy", "normal"])
def test_the_square_is_clean_apart_from_its_leads(variant: str) -> None:
    (result,) = judge_run(sample("rosettacnc-square.ngc", f"rosettacnc:{variant}", t1=6))
    assert result.verdict.clean
    assert not result.verdict.uncut
    assert (len(result.surface), result.lead_lines) == (9, (15,))


def window(run: ControlRun, first: int, second: int) -> list[tuple[float, float]]:
    """The compensated window in the coordinates of its plane, in order."""
    stretch = next(stretch for stretch in run.stretches if stretch.plane.axes[:2] == (first, second))
    moves = run.moves.part(stretch.first + 1, stretch.first + 7)
    return [(round(float(point[first]), 6), round(float(point[second]), 6)) for point in moves.points]


def test_the_gothic_window_is_compensated_in_all_three_planes() -> None:
    run = sample("rosettacnc-window.ngc", "rosettacnc:normal", t3=10)
    wanted = [(55.0, 5.0), (95.0, 5.0), (95.0, 100.0), (5.0, 100.0), (5.0, 5.0), (50.0, 5.0)]
    assert window(run, 0, 1) == wanted
    lower = [(55.0, 155.0), (95.0, 155.0), (95.0, 250.0), (5.0, 250.0), (5.0, 155.0), (50.0, 155.0)]
    assert window(run, 2, 0) == lower
    assert window(run, 1, 2) == wanted


def test_g52_places_the_windows_side_by_side() -> None:
    run = sample("rosettacnc-window.ngc", "rosettacnc:normal", t3=10)
    assert lines_and_ends(run, 26) == [(150.0, 0.0)]
    assert lines_and_ends(run, 46) == [(-150.0, 0.0)]


def test_the_other_entries_refuse_the_window() -> None:
    for variant in ("nist", "easy"):
        assert findings_of(sample("rosettacnc-window.ngc", f"rosettacnc:{variant}", t3=10), "C6")


def test_a_dynamic_radius_is_subtracted_from_that_of_the_table() -> None:
    run = run_of("G21 F100\nG41 D1 I1\nG1 X10\nX20 Y-5\n", "rosettacnc:easy", t1=6)
    assert run.stretches[0].radius == pytest.approx(2)


def test_g42_1_takes_a_diameter() -> None:
    run = run_of("G21 F100\nG42.1 D4\nG1 X10\nX20\n", "rosettacnc:easy")
    assert same(shape(run), [("line", 10, -2), ("line", 20, -2)])


def test_a_negative_radius_changes_the_side_and_is_reported() -> None:
    run = run_of("G21 F100\nG41 D1 I5\nG1 X10\nX20\n", "rosettacnc:easy", t1=6)
    assert same(shape(run), [("line", 10, -2), ("line", 20, -2)])
    assert findings_of(run, "NEGATIVE")


def test_lower_case_and_comments_of_both_kinds_are_read() -> None:
    run = run_of("g21 (millimeters) f100 ; feed\n\tg1x10y-.5 ; there\n\n", "rosettacnc")
    assert same(shape(run), [("line", 10, -0.5)])


@pytest.mark.parametrize("text", ["T1 M6", "M6 T1"])
def test_the_loaded_tool_gives_the_radius_without_d(text: str) -> None:
    run = run_of(f"G21 F100\n{text}\nG41\nG1 X10\nX20\n", "rosettacnc:easy", t1=6)
    assert run.stretches[0].radius == pytest.approx(3)


@pytest.mark.parametrize("entry", ["nist", "easy", "normal"])
@pytest.mark.parametrize(
    "code",
    [
        *("G18", "G19", "G28", "G30", "G52 X1", "G53 X1", "G92 X1", "G54", "G55", "G56", "G57", "G58", "G59"),
        *("G59.1", "G59.2", "G59.3"),
    ],
)
def test_planes_origins_and_machine_positions_are_refused_under_compensation(entry: str, code: str) -> None:
    text = "G21 G17 G90\nT1 M6\nG0 X-20 Y0\nF100\nG41 D1\nG1 X10\nX20\n{}X40\nG40\nG0 X80\nM2\n"
    assert run_of(text.format("G17\n"), f"rosettacnc:{entry}", t1=6.0).stopped_at is None
    assert run_of(text.format(f"{code}\n"), f"rosettacnc:{entry}", t1=6.0).stopped_at == 8


def test_a_wear_in_i_without_a_tool_compensates_without_a_warning() -> None:
    run = run_of("G21 F100\nG0 X0 Y0\nG41 I-3\nG1 X10\nX20\n", "rosettacnc:nist")
    assert [stretch.radius for stretch in run.stretches] == [3.0]
    assert not findings_of(run, "RADIUS0")
