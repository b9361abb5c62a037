"""The samples of the threeblock control against hand calculations, with a .5 cutter unless stated."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from core.controls.judging.judged_runs import deepest_gouge, judge_run
from core.finding import Severity
from core.units import from_mm
from tests.core.controls.hand import findings_of, run_of, same, sample, shape

HEAD = "T1\nG0G41X1.Y2.\nG1X4.Y0.F20.\n"


@pytest.mark.parametrize("radius", [0.1, 0.25, 0.5])
def test_the_approach_ends_square_to_the_first_line(radius: float) -> None:
    run = sample("threeblock-line.nc", "threeblock", t1=2 * radius)
    end = ("line", 8 - 0.6 * radius, 3 + 0.8 * radius)
    assert same(shape(run), [("rapid", 1, 2), ("line", 4 - 0.6 * radius, 0.8 * radius), end])


def test_the_misprinted_arc_is_reported_with_both_radii() -> None:
    run = sample("threeblock-arc.nc", "threeblock", t1=0.5)
    (arc,) = findings_of(run, "ARC")
    assert run.stopped_at == arc.line == 4
    assert [from_mm(value, run.unit) for value in arc.lengths] == pytest.approx([sqrt(2.5**2 + 1), 2.5])
    assert same(shape(run), [("rapid", 1, 2)])


def test_the_corrected_arc_is_approached_square() -> None:
    run = run_of("T1\nG0G41X1.Y2.\nG1X4.Y-1.F20.\nG2X6.5Y1.5I6.5J-1.\nG1X8.\nY0.\nG40X9.Y0.\n", "threeblock", t1=0.5)
    arc = ("cw", 6.5, 1.75, 6.5, -1)
    assert same(shape(run)[:3], [("rapid", 1, 2), ("line", 3.75, -1), arc])


def test_offsets_meet_at_inside_corners() -> None:
    run = sample("threeblock-inside.nc", "threeblock", t1=0.5)
    low = -sqrt(0.75**2 - 0.6**2)
    wanted = [
        ("rapid", -0.4, 0.8),
        ("line", 0, 0.25),
        ("line", 1, 0.25),
        ("cw", 1.25, 0, 1, 0),
        ("ccw", 1.4, low, 2, 0),
        ("ccw", 1.55, 0, 0.8, 0),
        ("cw", 1.8, 0.25, 1.8, 0),
        ("line", 2.8, 0.25),
        ("line", 3.2, 0.8),
    ]
    assert same(shape(run), wanted)
    assert not any(finding.severity is Severity.ERROR for finding in run.findings)


def test_outside_corners_get_arcs() -> None:
    run = sample("threeblock-outside.nc", "threeblock", t1=0.4)
    wanted = [
        ("rapid", -0.2, 0.6),
        ("line", 0, 0.2),
        ("line", 1, 0.2),
        ("cw", 1.2, 0, 1, 0),
        ("line", 1.2, -0.05),
        ("line", 2, -0.05),
        ("line", 2.2, 0.6),
    ]
    assert same(shape(run), wanted)


def test_a_step_smaller_than_the_radius_gouges_without_an_alarm() -> None:
    run = sample("threeblock-outside.nc", "threeblock", t1=0.6)
    assert run.stopped_at is None
    assert findings_of(run, "B17-STEP")[0].line == 5
    cut, line = deepest_gouge(judge_run(run))
    assert from_mm(cut, run.unit) == pytest.approx(0.05)
    assert line == 5


def test_the_square_is_entered_along_the_same_line() -> None:
    run = sample("threeblock-square.nc", "threeblock", t1=0.5)
    wanted = [
        ("rapid", -1, 1),
        ("rapid", -1, 0),
        ("line", 0, 0.25),
        ("line", 1.5, 0.25),
        ("cw", 1.75, 0, 1.5, 0),
        ("line", 1.75, -1.5),
        ("cw", 1.5, -1.75, 1.5, -1.5),
        ("line", 0, -1.75),
        ("cw", -0.25, -1.5, 0, -1.5),
        ("line", -0.25, 0.1),
        ("rapid", -1, 1),
    ]
    assert same(shape(run), wanted)


def test_the_triangle_is_compensated() -> None:
    run = sample("threeblock-triangle.nc", "threeblock", t1=0.5)
    a, b = 0.5 / sqrt(5), 0.25 / sqrt(5)
    wanted = [
        ("rapid", -1.75, -1),
        ("rapid", -1.75, 0),
        ("line", -0.75 - a, b),
        ("line", -a, 1.5 + b),
        ("cw", a, 1.5 + b, 0, 1.5),
        ("line", 0.75 + a, b),
        ("cw", 0.75, -0.25, 0.75, 0),
        ("line", -0.85, -0.25),
        ("rapid", -1.75, -1),
    ]
    assert same(shape(run), wanted)


def test_the_full_circle_is_one_arc() -> None:
    run = sample("threeblock-circle.nc", "threeblock", t1=0.5)
    wanted = [
        ("rapid", -1.25, 1.25),
        ("rapid", -1.25, 1.25),
        ("line", -0.5, 1),
        ("line", 0, 1),
        ("cw", 0, 1, 0, 0),
        ("line", 0.75, 1),
        ("rapid", -1.25, 1.25),
    ]
    assert same(shape(run), wanted)


def test_an_undersized_cutter_runs_on_the_other_side() -> None:
    run = run_of("T5//-.5;\n" + HEAD[3:] + "X8.Y3.\nX9.\nG40X9.Y5.\n", "threeblock")
    assert same(shape(run)[1:2], [("line", 4.15, -0.2)])


def test_diameter_0_starts_no_compensation() -> None:
    run = run_of(HEAD + "X8.Y3.\nX9.\nG40X9.Y5.\n", "threeblock", t1=0)
    assert findings_of(run, "B3-DIA0")
    assert same(shape(run)[1:3], [("line", 4, 0), ("line", 8, 3)])


@pytest.mark.parametrize(("arc", "feed"), [("G3X2.Y1.I1.J1.", 15.0), ("G2X1.75Y-.75I1.J-.75", 20 / 0.75)])
def test_g45_adjusts_the_feed_on_arcs_to_the_path(arc: str, feed: float) -> None:
    program = f"T1\nG45\nG0G41X-1.Y1.\nG1X0Y0F20.\nX1.\n{arc}\nG1X3.\nG40X4.Y4.\n"
    run = run_of(program, "threeblock", t1=0.5)
    (arc_move,) = [move for move in run.moves if move.line == 6 and move.turn]
    assert from_mm(arc_move.feed, run.unit) == pytest.approx(feed)


def test_z_in_a_line_is_not_compensated() -> None:
    program = HEAD + "X8.Y3.\nX9.\nX9.Y5.Z-.3\nX6.\nY7.\nX5.\nG40X4.Y9.\n"
    run = run_of(program, "threeblock", t1=0.5)
    heights = [round(from_mm(move.point[2], run.unit), 9) for move in run.moves]
    assert heights[-5:] == [-0.3] * 5
    assert run.stopped_at is None


def test_z_alone_within_the_contour_moves_at_the_corner() -> None:
    program = HEAD + "X8.\nY3.\nX5.\nZ-.3\nY5.\nX4.\nY6.\nG40X4.Y9.\n"
    run = run_of(program, "threeblock", t1=0.5)
    (lowered,) = [move for move in run.moves if move.line == 7]
    assert [from_mm(value, run.unit) for value in lowered.point] == pytest.approx([5, 2.75, -0.3])
    assert run.stopped_at is None


def test_the_block_that_starts_compensation_may_have_no_move_in_the_plane() -> None:
    run = run_of("T1\nG0X1.Y1.\nG41Z-.1\nG1X2.Y1.F10.\nY2.\nX1.\nG40X0Y0\n", "threeblock", t1=0.5)
    assert same(shape(run)[2:3], [("line", 1.75, 1)])


def test_corner_arcs_turn_by_the_corner() -> None:
    run = sample("threeblock-square.nc", "threeblock", t1=0.5)
    path = run.moves.path()
    swept = sum(abs(float(sweep)) for sweep, turn in zip(path.sweeps, path.turns, strict=True) if turn)
    assert swept == pytest.approx(3 * pi / 2)


def test_arcs_by_radius_are_run_and_reported() -> None:
    run = run_of("G0X0Y0\nG2X2.Y0R1.F10.\n", "threeblock")
    assert same(shape(run)[1:], [("cw", 2, 0, 1, 0)])
    assert [finding.column for finding in findings_of(run, "RADIUS")] == [8]


def test_g99_between_tangent_moves_is_reported_once() -> None:
    run = sample("threeblock-circle.nc", "threeblock", t1=0.5)
    assert [finding.line for finding in findings_of(run, "G99")] == [5]


@pytest.mark.parametrize("diameter", [0.5, -0.5])
def test_the_side_cannot_be_swapped_with_either_sign_of_the_diameter(diameter: float) -> None:
    swapped = run_of(f"{HEAD}X4.Y3.\nG42X0.Y3.\nG40X0.Y9.\nM2\n", "threeblock", t1=diameter)
    assert [finding.line for finding in findings_of(swapped, "B8-SIDE")] == [swapped.stopped_at] == [5]
    again = run_of(f"{HEAD}X4.Y3.\nG41X0.Y3.\nG40X0.Y9.\nM2\n", "threeblock", t1=diameter)
    assert [finding.severity for finding in findings_of(again, "B8-SIDE")] == [Severity.WARNING]
