"""The 9/Series against hand calculations with radius .25 and the tool on the left, unless stated."""

from __future__ import annotations

from math import sqrt, tan

import pytest

from core.units import Unit, from_mm
from tests.core.controls.hand import findings_of, run_of, same, sample, shape

ROOT = sqrt(0.5)


def path(body: str, control: str = "nine-series:a", diameter: float = 0.5) -> list[tuple[object, ...]]:
    """The shape of a program that starts at 0, 0 in inches."""
    return shape(run_of(f"G20 G17 G1 F10\n{body}", control, t1=diameter, t2=0.2))


def test_one_two_and_three_blocks_enter_alike() -> None:
    shapes = [shape(sample(f"nine-series-{name}.nc", "nine-series", t1=0.5)) for name in ("one-block", "two-blocks")]
    shapes.append(shape(sample("nine-series-three-blocks.nc", "nine-series", t1=0.5)))
    entered = [("line", 0, -1), ("line", 1, 0.75), ("line", 3.25, 0.75), ("line", 3.25, 3), ("line", 0, 3)]
    assert all(same(entry_shape, entered) for entry_shape in shapes)


def test_d_may_be_in_the_motion_block_after_g41() -> None:
    assert same(path("G41\nX1 Y1 D1\nX3")[:2], [("line", 1, 1.25), ("line", 3, 1.25)])


@pytest.mark.parametrize("body", ["G41 X1 Y1;\nD1;", "G41 X1 Y1; D1;", "G41;\nX1 Y1;\nS9\nD1;", "G41 X1 Y1\nZ0\nD1"])
def test_d_on_its_own_line_after_the_entry_applies_to_the_entry(body: str) -> None:
    run = run_of(f"G20 G17 G1 F10\n{body}\nX3\n", "nine-series:a", t1=0.5)
    assert shape(run)[0][1:] == (1, 1.25)
    assert same(shape(run)[-1:], [("line", 3, 1.25)])
    assert not findings_of(run, "RADIUS0")
    assert [round(from_mm(stretch.radius, Unit.IN), 9) for stretch in run.stretches] == [0.25]


@pytest.mark.parametrize("rest", ["X3", "X3\nD1\nX5", "G40\nX3", "M2"])
def test_an_entry_without_d_is_reported(rest: str) -> None:
    assert [
        finding.line
        for finding in findings_of(run_of(f"G20 G1 F10\nG41 X1 Y1\n{rest}\n", "nine-series", t1=0.5), "RADIUS0")
    ] == [2]


def test_type_a_goes_straight_to_the_square_start() -> None:
    assert same(path("G41 D1 X1 Y1\nX1 Y-3")[:1], [("line", 1.25, 1)])


def test_type_b_at_an_obtuse_angle_goes_through_the_intersection_of_extended_offsets() -> None:
    bent = path("G41 D1 X2 Y0\nX2 Y-3", "nine-series:b")
    assert same(bent[:2], [("line", 2.25, 0.25), ("line", 2.25, 0)])


def test_type_b_at_an_acute_angle_makes_three_blocks() -> None:
    bent = path("G41 D1 X2 Y0\nX0 Y-2", "nine-series:b")
    out = (2 + 0.25 * ROOT, -0.25 * ROOT)
    wanted = [("line", 2, 0.25), ("line", 2.25, 0.25), ("line", out[0] + 0.25 * ROOT, out[1] + 0.25 * ROOT)]
    assert same(bent[:4], [*wanted, ("line", *out)])


def test_type_b_with_g39_1_rounds_the_corner() -> None:
    out = (2 + 0.25 * ROOT, -0.25 * ROOT)
    bent = path("G39.1\nG41 D1 X2 Y0\nX0 Y-2", "nine-series:b")
    assert same(bent[:2], [("line", 2, 0.25), ("cw", *out, 2, 0)])
    assert same(path("G41 D1 X2 Y0\nX0 Y-2", "nine-series:b-g39.1"), bent)


def test_type_b_at_an_inside_corner_equals_type_a() -> None:
    body = "G41 D1 X2 Y0\nX2 Y3\nG40 X0 Y3"
    assert same(path(body, "nine-series:b"), path(body, "nine-series:a"))


def test_offsets_at_an_obtuse_outside_corner_are_extended() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nX4 Y-3")
    assert same(bent[1:3], [("line", 4.25, 1.25), ("line", 4.25, -3)])


def test_the_extension_is_the_radius_times_the_tangent_of_half_the_turn() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nX8 Y-3")
    assert same(bent[1:2], [("line", 4 + 0.25 * tan(0.7853981633974483 / 2), 1.25)])


def test_an_acute_outside_corner_gets_a_generated_block() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nX0 Y-3")
    second = (4 + 0.5 * ROOT, 1)
    assert same(bent[1:3], [("line", 4.25, 1.25), ("line", *second)])


def test_g39_1_makes_an_arc_between_lines_only() -> None:
    bent = path("G39.1\nG41 D1 X0 Y1\nX4 Y1\nX0 Y-3")
    assert same(bent[1:3], [("line", 4, 1.25), ("cw", 4 + 0.25 * ROOT, 1 - 0.25 * ROOT, 4, 1)])
    arc = path("G39.1\nG41 D1 X0 Y1\nX4 Y1\nG2 X4 Y-1 I0 J-1\nG2 X4 Y1 I0 J1")
    assert not any(move[0] == "cw" and move[3:] == (4, -1) for move in arc)


def test_g39_ends_the_mode_of_g39_1() -> None:
    assert same(
        path("G39.1\nG39\nG41 D1 X0 Y1\nX4 Y1\nX0 Y-3"),
        path("G41 D1 X0 Y1\nX4 Y1\nX0 Y-3"),
    )


def test_a_corner_of_a_line_and_an_arc_uses_the_tangent_of_the_arc() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nG2 X5 Y0 I0 J-1\nG1 X5 Y-3")
    assert same(bent[1:4], [("line", 4, 1.25), ("cw", 5.25, 0, 4, 0), ("line", 5.25, -3)])
    sharp = path("G41 D1 X0 Y1\nX4 Y1\nG2 X5 Y2 I1 J0")
    assert sharp[1][0] == "line"


def test_an_outside_corner_onto_an_arc_follows_the_extended_tangents() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nG3 X8 Y1 I2 J0\nG1 Y5")
    assert same(bent[1:4], [("line", 4.25, 1.25), ("line", 4.25, 1), ("ccw", 7.75, 1, 6, 1)])


def test_offsets_meet_at_inside_corners() -> None:
    assert same(path("G41 D1 X0 Y1\nX4 Y1\nX4 Y4")[1:2], [("line", 3.75, 1.25)])


def test_type_a_exits_from_the_square_end() -> None:
    assert same(path("G41 D1 X0 Y1\nX4 Y1\nG40 X4 Y-3")[1:], [("line", 4, 1.25), ("line", 4, -3)])


def test_type_b_exits_as_the_mirror_image_of_its_entry() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nG40 X4 Y-3", "nine-series:b")
    assert same(bent[-3:], [("line", 4, 1.25), ("line", 4.25, 1.25), ("line", 4, -3)])


def test_a_vector_bends_the_exit_by_one_radius_at_most() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nG40 X6 Y4 I0 J1")
    assert same(bent[1:], [("line", 3.75, 1.25), ("line", 6, 4)])
    far = path("G41 D1 X0 Y1\nX4 Y1\nG40 X6 Y4 I-1 J.1")
    assert same(far[1:2], [("line", 3.75, 1.25)])


def test_a_vector_along_the_path_shifts_against_itself() -> None:
    assert same(path("G41 D1 X0 Y1\nX4 Y1\nG40 X6 Y4 I1")[1:2], [("line", 3.75, 1.25)])


def test_a_side_change_runs_square_to_both_moves() -> None:
    run = run_of("G20 G1 F10\nG41 D1 X0 Y1\nX4 Y1\nG42 X4 Y4\nG40 X0 Y9", "nine-series", t1=0.5)
    assert same(shape(run)[1:4], [("line", 4, 1.25), ("line", 4.25, 1), ("line", 4.25, 4)])
    assert "cutcomp assumes" in findings_of(run, "CHANGE")[0].text


def test_the_side_may_change_in_an_arc_block() -> None:
    run = run_of("G20 G1 F10\nG41 D1 X0 Y1\nX4 Y1\nG42 G3 X5 Y2 I0 J1\nG40 G1 X0 Y9", "nine-series", t1=0.5)
    assert run.stopped_at is None


def test_a_new_radius_takes_effect_at_the_start_of_its_block() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nD2 X4 Y4\nG40 X0 Y9")
    assert same(bent[1:4], [("line", 4, 1.25), ("line", 3.9, 1), ("line", 3.9, 4)])


def test_d0_continues_with_radius_0() -> None:
    bent = path("G41 D1 X0 Y1\nX4 Y1\nD0 X4 Y4\nX8\nG40 X0 Y9")
    assert same(bent[2:5], [("line", 4, 1), ("line", 4, 4), ("line", 8, 4)])


def test_inside_arcs_keep_the_feed_of_the_surface() -> None:
    run = run_of("G20 G1 F10\nG41 D1 X0 Y1\nX4 Y1\nG3 X5 Y2 I0 J1\nG1 Y4\nG40 X0", "nine-series", t1=0.5)
    (arc,) = [move for move in run.moves if move.turn]
    assert from_mm(arc.feed, run.unit) == pytest.approx(7.5)


def test_too_many_blocks_without_motion_end_the_move_square() -> None:
    quiet = "S100\n" * 11
    run = run_of(f"G20 G1 F10\nG41 D1 X0 Y1\nX4 Y1\n{quiet}X4 Y4\nX8 Y4\nG40 X0 Y9", "nine-series", t1=0.5)
    assert same(shape(run)[1:3], [("line", 4, 1.25), ("line", 4, 4.25)])
    few = run_of("G20 G1 F10\nG41 D1 X0 Y1\nX4 Y1\nS100\nX4 Y4\nX8 Y4\nG40 X0 Y9", "nine-series", t1=0.5)
    assert same(shape(few)[1:2], [("line", 3.75, 1.25)])


def test_a_change_of_origin_exits_and_enters_again() -> None:
    run = run_of("G20 G1 F10\nG41 D1 X0 Y1\nX4 Y1\nX4 Y4\nG55\nX8 Y4\nX8 Y9\nG40 X0 Y9", "nine-series", t1=0.5)
    wanted = [("line", 4, 1.25), ("line", 4, 4), ("line", 7.75, 4), ("line", 7.75, 9), ("line", 0, 9)]
    assert same(shape(run)[1:], wanted)


def test_m800_allows_a_backwards_move() -> None:
    body = "G41 D1 X1 Y1\nX5 Y1\nX5 Y1.1\nX1 Y1.1\nG40 X0 Y0\n"
    assert run_of(f"G20 G1 F10\n{body}", "nine-series", t1=0.5).stopped_at == 4
    assert run_of(f"G20 G1 F10\nM800\n{body}", "nine-series", t1=0.5).stopped_at is None
    assert run_of(f"G20 G1 F10\nM800\nM801\n{body}", "nine-series", t1=0.5).stopped_at == 6


def test_corner_words_are_unsupported() -> None:
    """Only the lathe manual has `,C` and `,R`; it does not say how they combine with compensation."""
    run = run_of("G21 F100\nG1 X10. Y0 ,R2.\nX10. Y20.\nM2\n", "nine-series:a", t1=10.0)
    assert [(finding.code, finding.line, finding.column) for finding in run.findings][-1] == ("BEYOND", 2, 12)


def test_rotation_mirror_image_scaling_and_polar_codes_are_unsupported() -> None:
    for code in ("G68", "G51.1 X0", "G14.1", "G16"):
        (finding,) = findings_of(run_of(f"G21 G0 X0 Y0\n{code}\nX1\nM2\n", "allen-bradley:a"), "BEYOND")
        assert finding.line == 2
    off = run_of("G21 G14 G15 G50.1 G69 G0 X0 Y0\nX1\nM2\n", "allen-bradley:a")
    assert (off.stopped_at, off.findings) == (None, ())


@pytest.mark.parametrize("code", ["G52 X0", "G92 X1", "G54", "G55", "G56", "G57", "G58", "G59"])
def test_a_new_origin_interrupts_compensation(code: str) -> None:
    run = run_of(f"G20 G17 G1 F10\nG41 D1 X1 Y1\nX3\n{code}\nX5\nG40 X6\nM2\n", "nine-series:a", t1=0.5)
    assert [finding.line for finding in findings_of(run, "R7")] == [4]


@pytest.mark.parametrize("code", ["G52 X0", "G54", "G92 X3 Y1"])
@pytest.mark.parametrize("kind", ["a", "b"])
def test_a_new_origin_after_g40_ends_compensation_with_the_last_move(kind: str, code: str) -> None:
    body = f"G41 D1 X1 Y1\nX3\nG40\n{code}\nX5\nX5 Y4\nM2\n"
    run = run_of(f"G20 G17 G1 F10\n{body}", f"nine-series:{kind}", t1=0.5)
    assert same(shape(run)[-3:], [("line", 3, 1), ("line", 5, 1), ("line", 5, 4)])
    assert [finding.text.partition(":")[2] for finding in findings_of(run, "R7")] == [" the last move leaves it."]
    assert len(run.stretches) == 1
    assert not findings_of(run, "OPEN")
