"""Contours written for every control, read back here once more, and programs that must not be handed out."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.comp.result import Compensated
from core.controls.contouring import Cut, Line, begin, finish, programmed
from core.controls.iso_style import STYLES
from core.controls.read_back import Meant, farthest, read_back, same
from core.controls.registry import names, run
from core.controls.report import Run
from core.controls.write_iso import Frame, tools_of
from core.controls.write_own import NotWritten, Own, write_own
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Arc, Piece, Point, Turn
from core.geometry.piece import Line as Straight
from core.geometry.side import Side
from core.units import Unit
from tests.core.controls.klartext.test_centre_laws import LEGS, pieces_of

INCH = 25.4
EVERY = names()


def outline(*points: Point) -> Path:
    """Lines through points, in inches."""
    scaled = [(x * INCH, y * INCH) for x, y in points]
    return Path.from_pieces([Straight(a, b) for a, b in pairwise(scaled)])


SQUARE = outline((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))


def squared(side: Side, blend: float = 0.125, overlap: float = 0.0) -> Compensated:
    """The square from mid-side, for a half-inch cutter."""
    return compensate(SQUARE, side, 0.25 * INCH, 4, closed=True, blend=blend * INCH, overlap=overlap * INCH)


def cut(one: Compensated, *, tool: int = 1, stock: float = 0.0, depth: float = -0.25) -> Cut:
    """One run at a depth (inches), 10 inches a minute."""
    feeds = {int(number): 10.0 * INCH for number in one.contour.numbers}
    size = 2 * (one.radius - stock * INCH)
    up, near = 1.0 * INCH, 0.1 * INCH
    return Cut(
        compensated=one, tool=tool, diameter=size, stock=stock * INCH, speed=300.0, feeds=feeds,
        plunge_feed=20.0 * INCH, travel=up, near=near, depth=depth * INCH, leave=up,
    )  # fmt: skip


def write(control: str, *cuts: Cut) -> Own | NotWritten:
    """The program in inches, without remarks."""
    return write_own(cuts, control, Frame(Unit.IN), "PART", lambda _: ())


def text_of(control: str, *cuts: Cut) -> str:
    found = write(control, *cuts)
    assert isinstance(found, Own), found
    return found.text


def made_by(control: str, text: str, *cuts: Cut) -> Run:
    """What the control does with a program and the tools it counts on."""
    tools = tools_of(cuts, STYLES[control]) if control in STYLES else tools_of(cuts, STYLES["linuxcnc"])
    made = run(text.encode(), control, tools, Unit.IN)
    assert isinstance(made, Run)
    return made


def refused(control: str, *cuts: Cut) -> Finding:
    found = write(control, *cuts)
    assert isinstance(found, NotWritten), found
    return found.findings[0]


def test_threeblock_turns_on_in_the_plunge_and_centres_are_absolute() -> None:
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


def test_linuxcnc_is_entered_along_the_first_arc_by_more_than_the_radius() -> None:
    lines = text_of("linuxcnc", cut(squared(Side.LEFT))).splitlines()
    assert lines[:2] == ["G17 G20 G40 G49 G54 G80 G90 G91.1 G94", "G64 P0.0002"]
    assert lines[2:5] == ["T1 M6", "G43 H1", "S300 M3"]
    assert lines[6:11] == [
        "G0 X0.625 Y0.875",
        "G0 Z0.1",
        "G1 Z-0.25 F20.",
        "G41 D1 G1 X0.625 Y0.375 F10.",
        "G3 X1. Y0. I0.375 J0.",
    ]


def test_nist_is_entered_along_the_path_of_the_tool() -> None:
    lines = text_of("rosettacnc:nist", cut(squared(Side.RIGHT))).splitlines()
    assert lines[0] == "G17 G20 G40 G49 G54 G50 G69 G90"
    assert "G0 X0.875 Y-0.875" in lines
    assert "G42 D1 G1 X0.625 Y-0.375 F10." in lines


def test_a_9_series_program_says_how_corners_are_gone_round() -> None:
    for control, word in (("nine-series:a", "G39"), ("nine-series:b-g39.1", "G39.1")):
        assert text_of(control, cut(squared(Side.LEFT))).splitlines()[1] == word


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("overlap", [0.0, 0.125])
def test_a_square_reads_back_or_its_corners_are_the_reason(control: str, side: Side, overlap: float) -> None:
    one = cut(squared(side, overlap=overlap))
    found = write(control, one)
    if side is Side.LEFT and control in ("rosettacnc:nist", "rosettacnc:easy"):
        assert isinstance(found, NotWritten)
        assert "rule C6" in found.findings[0].text
        assert found.findings[0].segment == 2.0
        return
    assert isinstance(found, Own), found
    made = made_by(control, found.text, one)
    (stretch,) = made.stretches
    path = made.moves.part(stretch.first, stretch.last).path()
    own = path if control == "klartext" else path.part(1, len(path) - 1)
    mitred = side is Side.RIGHT and control.startswith("nine-series")
    whole = one.compensated.whole
    apart = max(farthest(own, whole)[0], farthest(whole, own)[0])
    assert (apart > 1e-3) is mitred
    assert same(own, whole, 1e-3) is not (mitred or (control == "threeblock" and overlap > 0.0))
    assert [note.code for note in found.notes] == (["DIFFERS"] if mitred else [])


def test_how_far_mitred_corners_are_off_is_told() -> None:
    found = write("nine-series:a", cut(squared(Side.RIGHT)))
    assert isinstance(found, Own)
    assert found.notes[0].lengths[0] / INCH == pytest.approx(0.25 * (sqrt(2) - 1), abs=1e-4)
    assert found.notes[0].segment in (1.0, 2.0, 3.0, 4.0)


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize("side", list(Side))
def test_arcs_and_a_full_circle_read_back(control: str, side: Side) -> None:
    pieces: list[Piece] = [
        Straight((0.0, 0.0), (40.0, 0.0)),
        Arc((40.0, 0.0), (60.0, 20.0), (40.0, 20.0), Turn.CCW),
        Arc((60.0, 20.0), (80.0, 40.0), (80.0, 20.0), Turn.CW),
        Straight((80.0, 40.0), (120.0, 40.0)),
    ]
    circle = Path.from_pieces([Arc((30.0, 0.0), (30.0, 0.0), (0.0, 0.0), Turn.CCW)])
    for one in (
        compensate(Path.from_pieces(pieces), side, 5.0, 2, closed=False, blend=2.0),
        compensate(circle, side, 5.0, 3, closed=True, blend=2.0, overlap=4.0),
    ):
        found = write_own([cut(one)], control, Frame(Unit.MM), "PART", lambda _: ())
        assert isinstance(found, Own), found
        assert not found.notes


@pytest.mark.parametrize("control", EVERY)
def test_passes_and_stock_are_runs_of_their_own(control: str) -> None:
    wide = compensate(SQUARE, Side.RIGHT, 0.3 * INCH, 4, closed=True, blend=0.125 * INCH)
    cuts = [cut(wide, stock=0.05, depth=-0.1), cut(squared(Side.RIGHT), depth=-0.1), cut(squared(Side.RIGHT))]
    text = text_of(control, *cuts)
    made = made_by(control, text, *cuts)
    assert [stretch.radius / INCH for stretch in made.stretches] == pytest.approx([0.3, 0.25, 0.25])
    depths = [float(made.moves.points[stretch.last - 2, 2]) / INCH for stretch in made.stretches]
    assert depths == pytest.approx([-0.1, -0.1, -0.25])


def test_how_each_control_is_told_of_stock() -> None:
    wide = cut(compensate(SQUARE, Side.RIGHT, 0.3 * INCH, 4, closed=True, blend=0.125 * INCH), stock=0.05)
    assert "T1//0.6\n" in text_of("threeblock", wide)
    assert "G42.1 D0.6 " in text_of("linuxcnc", wide)
    assert "G42 D1 I-0.05 " in text_of("rosettacnc:normal", wide)
    assert "G42 D51 " in text_of("nine-series:a", wide)
    assert "TOOL CALL 1 Z S300 DR+0.05\n" in text_of("klartext", wide)


def test_lines_on_one_line_are_one_block_for_threeblock() -> None:
    text = text_of("threeblock", cut(squared(Side.RIGHT, overlap=0.125)))
    assert "G1X1.125Y0.\n" in text
    assert "G1X1.Y0.\n" not in text
    assert "G1 X1. Y0.\nG1 X1.125 Y0.\n" in text_of("linuxcnc", cut(squared(Side.RIGHT, overlap=0.125)))


def test_no_more_than_what_a_control_has() -> None:
    assert "rule B19-TRANGE" in refused("threeblock", cut(squared(Side.RIGHT), tool=25)).text
    huge = compensate(outline((0, 0), (9, 0)), Side.LEFT, 1.7 * INCH, 2, closed=False, blend=0.125 * INCH)
    assert "rule B4-MAX" in refused("threeblock", cut(huge)).text


@pytest.mark.parametrize("control", ["linuxcnc", "rosettacnc:normal"])
def test_without_a_blend_an_entry_square_to_itself_would_cut(control: str) -> None:
    found = refused(control, cut(squared(Side.LEFT, blend=0.0)))
    assert "BLEND OFFSET" in found.text
    assert found.lengths[0] > 0.0
    assert isinstance(write("threeblock", cut(squared(Side.LEFT, blend=0.0))), Own)


def test_a_small_pocket_gets_a_shorter_entry() -> None:
    small = outline((0.4, 0), (0.8, 0), (0.8, 0.8), (0, 0.8), (0, 0), (0.4, 0))
    one = compensate(small, Side.LEFT, 0.25 * INCH, 4, closed=True, blend=0.05 * INCH)
    assert "G0X0.35Y0.425\n" in text_of("threeblock", cut(one))
    assert "no room" in refused("linuxcnc", cut(one)).text


@pytest.mark.parametrize("control", EVERY)
def test_what_only_the_look_ahead_does_is_refused(control: str) -> None:
    notch = outline((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    for lookahead in (2, 3):
        one = compensate(notch, Side.LEFT, 0.25 * INCH, lookahead, closed=False, blend=0.125 * INCH)
        found = refused(control, cut(one))
        assert found.code == "NOTWRITTEN"
        assert found.segment is not None


def test_a_bridge_is_refused() -> None:
    slot = Path.from_pieces([Straight((0.0, 0.0), (10.0, 0.0)), Arc((10.0, 0.0), (12.0, 2.0), (10.0, 2.0), Turn.CCW)])
    one = compensate(slot, Side.LEFT, 5.0, 1, closed=False, blend=2.0)
    assert one.bridged.any()
    assert isinstance(programmed(one), Finding)
    assert refused("linuxcnc", cut(one)).code == "NOTWRITTEN"


def meant(control: str = "linuxcnc") -> Meant:
    """A program that is right."""
    one = cut(squared(Side.RIGHT))
    lines = tuple(Line(text, 3.0) for text in text_of(control, one).splitlines())
    return Meant(control, lines, (one,), tools_of((one,), STYLES[control]), Unit.IN, 1e-6 * INCH, leads=True)


def changed(old: str, new: str) -> Meant:
    """The right program with one text changed in it."""
    right = meant()
    lines = tuple(line._replace(text=line.text.replace(old, new)) for line in right.lines)
    assert lines != right.lines
    return replace(right, lines=lines)


def test_a_program_that_is_wrong_is_never_let_through() -> None:
    assert not read_back(meant()).errors
    assert "gouges" in read_back(changed("G1 X2. Y2.", "G1 X1.99 Y2.")).errors[0].text
    assert "uncut" in read_back(changed("G1 X2. Y2.", "G1 X2.01 Y2.")).errors[0].text
    assert "depth" in read_back(changed("G1 X2. Y2.", "G1 X2. Y2. Z0.")).errors[0].text
    assert "N-ONWHENON" in read_back(changed("G1 X2. Y2.", "G42 D1 X2. Y2.")).errors[0].text
    assert "1 compensated" not in read_back(changed("G42 D1 ", "")).errors[0].text
    assert read_back(changed("G42", "G41")).errors


def test_a_right_program_with_another_tool_is_wrong() -> None:
    right = meant()
    bigger = replace(right, tools=tools_of((replace(right.cuts[0], diameter=0.6 * INCH),), STYLES["linuxcnc"]))
    assert "uncut" in read_back(bigger).errors[0].text


def test_ends_of_a_path_with_blends() -> None:
    one = squared(Side.LEFT)
    first, last = begin(one), finish(one)
    assert np.array(first.at) / INCH == pytest.approx([0.875, 0.375])
    assert np.array(first.corner) / INCH == pytest.approx([0.625, 0.375])
    assert first.way == pytest.approx((1.0, 0.0))
    assert first.off == pytest.approx((0.0, 1.0))
    assert np.array(last.at) / INCH == pytest.approx([1.125, 0.375])
    assert np.array(last.corner) / INCH == pytest.approx([1.375, 0.375])
    assert last.way == pytest.approx((1.0, 0.0))


def test_ends_of_a_path_without_blends() -> None:
    one = squared(Side.RIGHT, blend=0.0)
    first, last = begin(one), finish(one)
    assert np.array(first.at) / INCH == pytest.approx([1.0, -0.25])
    assert np.array(first.corner) / INCH == pytest.approx([1.0, 0.0])
    assert first.off == pytest.approx((0.0, -1.0))
    assert last.way == pytest.approx((1.0, 0.0))
    assert np.array(last.corner) / INCH == pytest.approx([1.0, 0.0])


def test_farthest_finds_the_piece_that_is_off() -> None:
    bent = outline((1, 0), (2, 0), (2, 1), (2.5, 2), (0, 2))
    apart, number = farthest(bent, SQUARE)
    assert apart / INCH == pytest.approx(0.5)
    assert number in (3.0, 4.0)


@settings(max_examples=120, deadline=None, derandomize=True)
@given(LEGS, st.sampled_from(Side), st.sampled_from([name for name in names() if name != "klartext"]))
def test_random_contours_read_back_or_the_reason_is_told(
    legs: list[tuple[float, float, int, float]], side: Side, control: str
) -> None:
    """Lines and arcs at any angle: the control's path is the block's, or nearly, and that is said; or nothing."""
    contour = Path.from_pieces(pieces_of(legs))
    one = compensate(contour, side, 4.0, 8, closed=False, blend=2.0)
    if not len(one.path) or bool(one.bridged.any()):
        return
    result = write(control, cut(one, depth=-0.2))
    if isinstance(result, NotWritten):
        assert all(len(finding.text) > 20 for finding in result.findings)
        assert result.findings
        return
    made = made_by(control, result.text, cut(one, depth=-0.2))
    assert made.stopped_at is None
    (stretch,) = made.stretches
    path = made.moves.part(stretch.first, stretch.last).path()
    inner = path.part(1, len(path) - 1)
    allowed = max(0.006, *(note.lengths[0] + 0.006 for note in result.notes if note.code == "DIFFERS"), 0.0)
    assert max(farthest(inner, one.whole)[0], farthest(one.whole, inner)[0]) <= allowed
