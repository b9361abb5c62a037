"""Contours written for every control: entries, stock, and refusals."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from core.comp.compensate import compensate
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.controls.write.contour_pass import (
    CenterMove,
    UncompensatedPass,
    path_begin,
    path_finish,
    programmed_elements,
)
from core.controls.write.written_program import Posted
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Arc, Side, Turn
from core.geometry.piece import Line as Straight
from core.verify.judge import judge
from tests.core.controls.some_controls import ENTRY_VARIANTS, FIRST_VARIANTS
from tests.core.controls.written_programs import (
    EVERY,
    INCH,
    SQUARE,
    cut,
    outline,
    refused,
    run_written,
    squared,
    text_of,
    write,
)


def test_threeblock_starts_compensation_in_the_plunge_with_absolute_centers() -> None:
    assert text_of("threeblock", cut(squared(Side.LEFT))).split() == [
        "G17G70G40G90",
        "T1//0.5",
        "T1M6",
        "S300M3",
        "G0Z1.",
        "G0X0.875Y0.875",
        "G0Z0.1",
        "G1G41Z-0.25F20.",
        "G1X0.625Y0.375F10.",
        "G3X1.Y0.I1.J0.375",
        "G1X2.Y0.",
        "G1X2.Y2.",
        "G1X0.Y2.",
        "G1X0.Y0.",
        "G1X1.Y0.",
        "G3X1.375Y0.375I1.J0.375",
        "G40G1X1.125Y0.875",
        "G0Z1.",
        "M5",
        "M30",
    ]


def test_linuxcnc_enters_along_the_first_arc_by_more_than_the_radius() -> None:
    lines = text_of("linuxcnc", cut(squared(Side.LEFT))).splitlines()
    assert lines[:2] == ["G17 G20 G40 G49 G54 G80 G90 G91.1 G94", "G64 P0.0002"]
    assert lines[2:5] == ["T1 M6", "S300 M3", "G0 G43 H1 Z1."]
    assert lines[5:10] == [
        "G0 X0.625 Y0.875",
        "G0 Z0.1",
        "G1 Z-0.25 F20.",
        "G41 D1 G1 X0.625 Y0.375 F10.",
        "G3 X1. Y0. I0.375 J0.",
    ]


def test_nist_enters_along_the_path_of_the_tool() -> None:
    lines = text_of("rosettacnc:nist", cut(squared(Side.RIGHT))).splitlines()
    assert lines[0] == "G17 G20 G40 G49 G54 G50 G69 G90"
    assert "G0 X0.875 Y-0.875" in lines
    assert "G42 D1 G1 X0.625 Y-0.375 F10." in lines


def test_a_9_series_program_names_its_corner_mode() -> None:
    for control, word in (("nine-series:a", "G39"), ("nine-series:b-g39.1", "G39.1")):
        assert text_of(control, cut(squared(Side.LEFT))).splitlines()[1] == word


def test_each_control_gets_the_stock_in_its_own_words() -> None:
    wide = cut(compensate(SQUARE, Side.RIGHT, 0.3 * INCH, 4, closed=True, blend=0.125 * INCH), stock=0.05)
    assert "T1//0.6\n" in text_of("threeblock", wide)
    assert "G42.1 D0.6 " in text_of("linuxcnc", wide)
    assert "G42 D1 I-0.05 " in text_of("rosettacnc:normal", wide)
    assert "G42 D51 " in text_of("nine-series:a", wide)
    assert "TOOL CALL 1 Z S300 DR+0.05\n" in text_of("klartext", wide)


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_a_speed_is_written_only_when_it_changes(control: str) -> None:
    contour = cut(squared(Side.RIGHT))
    same, faster = text_of(control, contour, contour), text_of(control, contour, replace(contour, speed=900.0))
    speeds = [re.findall(r"(?<![A-Z])S(\d+)", text) for text in (same, faster)]
    assert speeds == [["300"], ["300", "900"]]


DECIMALS = {"threeblock": 4, "rosettacnc": 6, "nine-series": 4, "fanuc": 4, "haas": 4, "klartext": 5, "linuxcnc": 6}


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_coordinates_in_inches_have_the_decimals_that_the_control_reads(control: str) -> None:
    third = outline((1 / 3, 0), (2 / 3, 0), (2 / 3, 2), (-4 / 3, 2), (-4 / 3, 0), (1 / 3, 0))
    text = text_of(control, cut(compensate(third, Side.RIGHT, 0.25 * INCH, 4, closed=True, blend=0.125 * INCH)))
    decimals = [len(digits) for digits in re.findall(r"[XY][-+]?\d*\.(\d*)", text)]
    assert max(decimals) == DECIMALS[control.partition(":")[0]]


def test_collinear_lines_are_one_block_for_threeblock() -> None:
    text = text_of("threeblock", cut(squared(Side.RIGHT, overlap=0.125)))
    assert "G1X1.125Y0.\n" in text
    assert "G1X1.Y0.\n" not in text
    assert "G1 X1. Y0.\nG1 X1.125 Y0.\n" in text_of("linuxcnc", cut(squared(Side.RIGHT, overlap=0.125)))


def test_tools_and_radii_beyond_the_range_of_a_control_are_refused() -> None:
    assert "rule B19-TRANGE" in refused("threeblock", cut(squared(Side.RIGHT), tool=25)).text
    huge = compensate(outline((0, 0), (9, 0)), Side.LEFT, 1.7 * INCH, 2, closed=False, blend=0.125 * INCH)
    assert "rule B4-MAX" in refused("threeblock", cut(huge)).text


@pytest.mark.parametrize("control", ["linuxcnc", "rosettacnc:normal"])
def test_an_entry_that_would_gouge_without_a_blend_is_refused(control: str) -> None:
    refusal = refused(control, cut(squared(Side.LEFT, blend=0.0)))
    assert "BLEND OFFSET" in refusal.text
    assert refusal.lengths[0] > 0.0
    assert isinstance(write("threeblock", cut(squared(Side.LEFT, blend=0.0))), Posted)


def test_a_small_pocket_gets_a_shorter_entry() -> None:
    small = outline((0.4, 0), (0.8, 0), (0.8, 0.8), (0, 0.8), (0, 0), (0.4, 0))
    path = compensate(small, Side.LEFT, 0.25 * INCH, 4, closed=True, blend=0.05 * INCH)
    assert "G0X0.35Y0.425\n" in text_of("threeblock", cut(path))
    assert "no room" in refused("linuxcnc", cut(path)).text


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_a_contour_that_needs_the_look_ahead_is_refused(control: str) -> None:
    notch = outline((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    for lookahead in (2, 3):
        path = compensate(notch, Side.LEFT, 0.25 * INCH, lookahead, closed=False, blend=0.125 * INCH)
        refusal = refused(control, cut(path))
        assert refusal.code == "NOTWRITTEN"
        assert refusal.segment is not None


def test_a_contour_with_a_bridged_corner_is_refused() -> None:
    slot = Path.from_pieces([Straight((0.0, 0.0), (10.0, 0.0)), Arc((10.0, 0.0), (12.0, 2.0), (10.0, 2.0), Turn.CCW)])
    path = compensate(slot, Side.LEFT, 5.0, 1, closed=False, blend=2.0)
    assert path.bridged.any()
    assert isinstance(programmed_elements(path), Finding)
    assert refused("linuxcnc", cut(path)).code == "NOTWRITTEN"


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "klartext", "linuxcnc", "threeblock"])
def test_a_bridge_that_rounding_leaves_at_a_tangent_joint_is_not_run(control: str) -> None:
    """The two arcs of an ellipse miss tangency by six decimals, so that a bridge of 2.6e-7 stays."""
    joint = (-24.828244, -32.775334)
    first = Arc((-16.68568, -34.579932), joint, (-1.2012652110939392, 54.56003138190792), Turn.CW)
    second = Arc(joint, (-32.746046, -30.165721), (-4.722930847834169, 41.54247593861214), Turn.CW)
    path = compensate(Path.from_pieces([first, second]), Side.LEFT, 4.0, 8, closed=False, blend=3.0)
    assert path.bridged.any()
    assert judge(path.contour, Side.LEFT, 4.0, path.path).backwards == ()
    assert text_of(control, cut(path))


def test_the_ends_of_a_path_with_blends_are_those_of_the_blends() -> None:
    contour = squared(Side.LEFT)
    first, last = path_begin(contour), path_finish(contour)
    assert np.array(first.at) / INCH == pytest.approx([0.875, 0.375])
    assert np.array(first.corner) / INCH == pytest.approx([0.625, 0.375])
    assert first.direction == pytest.approx((1.0, 0.0))
    assert first.outward == pytest.approx((0.0, 1.0))
    assert np.array(last.at) / INCH == pytest.approx([1.125, 0.375])
    assert np.array(last.corner) / INCH == pytest.approx([1.375, 0.375])
    assert last.direction == pytest.approx((1.0, 0.0))


def test_the_ends_of_a_path_without_blends_are_on_the_contour() -> None:
    contour = squared(Side.RIGHT, blend=0.0)
    first, last = path_begin(contour), path_finish(contour)
    assert np.array(first.at) / INCH == pytest.approx([1.0, -0.25])
    assert np.array(first.corner) / INCH == pytest.approx([1.0, 0.0])
    assert first.outward == pytest.approx((0.0, -1.0))
    assert last.direction == pytest.approx((1.0, 0.0))
    assert np.array(last.corner) / INCH == pytest.approx([1.0, 0.0])


@pytest.mark.parametrize(
    ("control", "overlap"), [*((control, 0.1) for control in EVERY), *((control, 0.0) for control in FIRST_VARIANTS)]
)
def test_a_clean_path_is_clean_when_its_program_is_read_back(control: str, overlap: float) -> None:
    one = cut(squared(Side.RIGHT, overlap=overlap))
    run = run_written(control, text_of(control, one), one)
    codes = {one.code for one in judged_findings(judge_run(run))}
    assert run.stretches
    assert not codes & {"GOUGE", "LEAD-GOUGE", "WRONG-SIDE", "CROSSES", "UNCUT"}


@pytest.mark.parametrize("control", ENTRY_VARIANTS)
@pytest.mark.parametrize("off", [-0.0001, 0.0001])
@pytest.mark.parametrize("side", Side)
def test_a_start_in_the_middle_of_a_wall_may_be_off_its_line_by_a_digit(control: str, off: float, side: Side) -> None:
    """The two parts of that wall meet at a corner of almost no angle, where the path overlaps."""
    square = outline((1, off), (2, 0), (2, 2), (0, 2), (0, 0), (1, off))
    path = compensate(square, side, 0.25 * INCH, 4, closed=True, blend=0.125 * INCH, overlap=0.1 * INCH)
    elements = programmed_elements(path)
    assert not isinstance(elements, Finding)
    assert elements.segments == (1.0, 2.0, 3.0, 4.0, 5.0, 1.0)
    if control == "threeblock" or (side is Side.LEFT and control in ("rosettacnc:nist", "rosettacnc:easy")):
        assert re.search("rule (B11-COLLINEAR|C6):", refused(control, cut(path)).text)
        return
    run = run_written(control, text_of(control, cut(path)), cut(path))
    assert not {finding.code for finding in judged_findings(judge_run(run))} & {"GOUGE", "LEAD-GOUGE", "WRONG-SIDE"}


def moved(x: float, y: float, z: float, feed: float | None = 10.0, turn: int = 0) -> CenterMove:
    """A move in inches; an arc turns around X1 Y0."""
    return CenterMove(x * INCH, y * INCH, z * INCH, None if feed is None else feed * INCH, turn, (1.0 * INCH, 0.0))


UNCOMPENSATED = (
    moved(0.0, 0.0, 1.0, None), moved(0.0, 0.0, -0.25, 20.0), moved(0.5, 0.0, -0.25), moved(1.5, 0.0, -0.25, turn=1),
    moved(0.5, 0.0, -0.5, turn=-1), moved(0.5, 1.0, -0.5), moved(1.0, 2.0, -0.75), moved(1.0, 2.0, 1.0, None),
)  # fmt: skip
"""Plunge, line, half circle, helix, line, ramp down, retract."""


def uncompensated() -> UncompensatedPass:
    return UncompensatedPass(
        travels=UNCOMPENSATED, tool=1, diameter=0.5 * INCH, stock=0.0, speed=300.0, feeds={1: 10.0 * INCH},
        plunge_feed=20.0 * INCH, travel=INCH, near=0.1 * INCH, depth=-0.5 * INCH, leave=INCH,
    )  # fmt: skip


def test_klartext_without_compensation_names_only_the_axes_that_move() -> None:
    lines = text_of("klartext", uncompensated()).splitlines()[4:14]
    assert [line.partition(" ")[2] for line in lines] == [
        "L X+0 Y+0 Z+1 R0 FMAX",
        "L Z-0.25 R0 F20",
        "L X+0.5 R0 F10",
        "CC X+1 Y+0",
        "C X+1.5 Y+0 DR+ R0 F10",
        "CC X+1 Y+0",
        "CP IPA-180.000000 Z-0.5 DR- R0 F10",
        "L Y+1 R0 F10",
        "L X+1 Y+2 Z-0.75 R0 F10",
        "L Z+1 R0 FMAX",
    ]


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_every_control_makes_the_moves_without_compensation(control: str) -> None:
    run = run_written(control, text_of(control, uncompensated()), uncompensated())
    moves = list(run.moves)[-len(UNCOMPENSATED) :]
    assert [move.turn for move in moves] == [move.turn for move in UNCOMPENSATED]
    for move, expected in zip(moves, UNCOMPENSATED, strict=True):
        assert move.point == pytest.approx(expected[:3], abs=1e-9)


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_remarks_are_written_for_controls_that_read_comments(control: str) -> None:
    note = "NOTE" if control == "klartext" else "(NOTE)"
    written = write(control, uncompensated(), remarks=(note,))
    assert isinstance(written, Posted), written
    assert written.text.count("NOTE") == (control != "threeblock")
