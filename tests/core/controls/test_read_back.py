"""Contours written for every control and read back, and programs that must be refused."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import nan, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.controls.registry import names
from core.controls.write.contour_pass import CenterMove, CompensatedPass, WrittenLine
from core.controls.write.iso_program import tools_of
from core.controls.write.iso_style import STYLE_OF_CONTROL
from core.controls.write.read_back import (
    Intended,
    compare_path,
    different_move,
    largest_distance,
    read_back,
    same_pieces,
)
from core.controls.write.written_program import Posted, Refusal, write_program
from core.finding import Finding, Severity
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Piece, Side, Turn
from core.geometry.piece import Line as Straight
from core.units import Unit
from tests.core.controls.klartext.test_center_path_laws import LEGS, pieces_of
from tests.core.controls.some_controls import ENTRY_VARIANTS, FIRST_VARIANTS
from tests.core.controls.written_programs import (
    EVERY,
    INCH,
    SQUARE,
    cut,
    outline,
    run_written,
    squared,
    text_of,
    write,
)
from tests.properties import exercised, must_exercise


def errors_of(*answer: Finding | None) -> list[Finding]:
    return [finding for finding in answer if finding is not None and finding.severity is Severity.ERROR]


@pytest.mark.parametrize(
    ("control", "overlap"), [*((control, 0.125) for control in EVERY), *((control, 0.0) for control in FIRST_VARIANTS)]
)
@pytest.mark.parametrize("side", list(Side))
def test_a_square_reads_back_or_is_refused_for_its_corners(control: str, side: Side, overlap: float) -> None:
    square = cut(squared(side, overlap=overlap))
    written = write(control, square)
    if side is Side.LEFT and control in ("rosettacnc:nist", "rosettacnc:easy"):
        assert isinstance(written, Refusal)
        assert "rule C6" in written.findings[0].text
        assert written.findings[0].segment == 2.0
        return
    assert isinstance(written, Posted), written
    run = run_written(control, written.text, square)
    (stretch,) = run.stretches
    path = run.moves.part(stretch.first, stretch.last).path()
    path_in_contour = path if control == "klartext" else path.part(1, len(path) - 1)
    mitred = side is Side.RIGHT and control.startswith(("nine-series", "fanuc", "haas")) and "yasnac" not in control
    whole = square.compensated.with_leads
    apart = max(largest_distance(path_in_contour, whole)[0], largest_distance(whole, path_in_contour)[0])
    assert (apart > 1e-3) is mitred
    assert same_pieces(path_in_contour, whole, 1e-3) is not (mitred or (control == "threeblock" and overlap > 0.0))
    assert [note.code for note in written.notes] == (["DIFFERS"] if mitred else [])


def test_a_note_gives_the_distance_of_mitered_corners() -> None:
    written = write("nine-series:a", cut(squared(Side.RIGHT)))
    assert isinstance(written, Posted)
    assert written.notes[0].lengths[0] / INCH == pytest.approx(0.25 * (sqrt(2) - 1), abs=1e-4)
    assert written.notes[0].segment in (1.0, 2.0, 3.0, 4.0)


@pytest.mark.parametrize("control", ENTRY_VARIANTS)
@pytest.mark.parametrize("side", list(Side))
def test_arcs_and_a_full_circle_read_back(control: str, side: Side) -> None:
    pieces: list[Piece] = [
        Straight((0.0, 0.0), (40.0, 0.0)),
        Arc((40.0, 0.0), (60.0, 20.0), (40.0, 20.0), Turn.CCW),
        Arc((60.0, 20.0), (80.0, 40.0), (80.0, 20.0), Turn.CW),
        Straight((80.0, 40.0), (120.0, 40.0)),
    ]
    circle = Path.from_pieces([Arc((30.0, 0.0), (30.0, 0.0), (0.0, 0.0), Turn.CCW)])
    for contour in (
        compensate(Path.from_pieces(pieces), side, 5.0, 2, closed=False, blend=2.0),
        compensate(circle, side, 5.0, 3, closed=True, blend=2.0, overlap=4.0),
    ):
        written = write_program([cut(contour)], control, Unit.MM, "PART", lambda _: ())
        assert isinstance(written, Posted), written
        assert not written.notes


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_each_pass_and_each_stock_is_a_separate_run(control: str) -> None:
    wide = compensate(SQUARE, Side.RIGHT, 0.3 * INCH, 4, closed=True, blend=0.125 * INCH)
    cuts = [cut(wide, stock=0.05, depth=-0.1), cut(squared(Side.RIGHT), depth=-0.1), cut(squared(Side.RIGHT))]
    text = text_of(control, *cuts)
    run = run_written(control, text, *cuts)
    assert [stretch.radius / INCH for stretch in run.stretches] == pytest.approx([0.3, 0.25, 0.25])
    depths = [float(run.moves.points[stretch.last - 2, 2]) / INCH for stretch in run.stretches]
    assert depths == pytest.approx([-0.1, -0.1, -0.25])


@cache
def intended_program() -> Intended:
    """A correct program for LinuxCNC."""
    square = cut(squared(Side.RIGHT))
    lines = tuple(WrittenLine(text, 3.0) for text in text_of("linuxcnc", square).splitlines())
    tools = tools_of((square,), STYLE_OF_CONTROL["linuxcnc"])
    return Intended("linuxcnc", lines, (square,), tools, Unit.IN, 1e-6 * INCH, leads=True)


def changed(old: str, new: str) -> Intended:
    """The correct program with one text changed."""
    right = intended_program()
    lines = tuple(line._replace(text=line.text.replace(old, new)) for line in right.lines)
    assert lines != right.lines
    return replace(right, lines=lines)


def test_a_wrong_program_is_refused() -> None:
    assert not errors_of(*read_back(intended_program()))
    assert "gouges" in errors_of(*read_back(changed("G1 X2. Y2.", "G1 X1.99 Y2.")))[0].text
    assert "uncut" in errors_of(*read_back(changed("G1 X2. Y2.", "G1 X2.01 Y2.")))[0].text
    assert "depth" in errors_of(*read_back(changed("G1 X2. Y2.", "G1 X2. Y2. Z0.")))[0].text
    assert "N-ONWHENON" in errors_of(*read_back(changed("G1 X2. Y2.", "G42 D1 X2. Y2.")))[0].text
    assert "1 compensated" not in errors_of(*read_back(changed("G42 D1 ", "")))[0].text
    assert errors_of(*read_back(changed("G42", "G41")))


def test_a_right_program_with_another_tool_is_refused() -> None:
    right = intended_program()
    bigger = replace(
        right, tools=tools_of((replace(right.cuts[0], diameter=0.6 * INCH),), STYLE_OF_CONTROL["linuxcnc"])
    )
    assert "uncut" in errors_of(*read_back(bigger))[0].text


def test_largest_distance_finds_the_piece_that_is_off() -> None:
    bent = outline((1, 0), (2, 0), (2, 1), (2.5, 2), (0, 2))
    apart, number = largest_distance(bent, SQUARE)
    assert apart / INCH == pytest.approx(0.5)
    assert number in (3.0, 4.0)


def test_largest_distance_names_the_piece_after_zero_length_pieces() -> None:
    bent = outline((1, 0), (1, 0), (1, 0), (2, 0), (2, 1), (2.5, 2), (0, 2))
    short = (bent.points[1:] == bent.points[:-1]).all(axis=1)
    assert short.any()
    assert largest_distance(bent, SQUARE)[1] in (3.0 + short.sum(), 4.0 + short.sum())


@pytest.mark.parametrize("row", range(4))
@pytest.mark.parametrize("end", [0, 1])
def test_a_path_with_an_invalid_number_is_never_near(row: int, end: int) -> None:
    """A maximum found by comparisons would ignore it."""
    points = SQUARE.points.copy()
    points[row, end] = nan
    bad = Path.of(points, SQUARE.centers, SQUARE.turns)
    assert not same_pieces(bad, SQUARE, 1e-3)
    assert not largest_distance(bad, SQUARE)[0] <= 1e-3
    assert not largest_distance(SQUARE, bad)[0] <= 1e-3
    assert largest_distance(bad, SQUARE)[1] in (row, row + 1)
    given = intended_program()
    (square,) = given.cuts
    assert isinstance(square, CompensatedPass)
    assert errors_of(compare_path(bad, square, replace(given, leads=False)))


def _with_lost_arc(path: Path) -> Path:
    """The path with an added arc whose center is not a number and whose ends coincide: other paths ignore it."""
    points, centers = np.vstack((path.points, path.points[-1])), np.vstack((path.centers, (nan, nan)))
    return Path.of(points, centers, np.append(path.turns, 1), np.append(path.numbers, path.numbers[-1]))


@pytest.mark.parametrize("lost", ["made", "intended"])
def test_an_invalid_distance_in_one_direction_is_not_near(lost: str) -> None:
    given = replace(intended_program(), leads=False)
    (square,) = given.cuts
    assert isinstance(square, CompensatedPass)
    whole = square.compensated.with_leads
    made, cut_for = whole, square
    if lost == "made":
        made = _with_lost_arc(whole)
    else:
        bare = replace(square.compensated, path=whole, lead_in=EMPTY, lead_out=EMPTY)
        made, cut_for = bare.with_leads, replace(square, compensated=replace(bare, path=_with_lost_arc(whole)))
        assert compare_path(made, replace(square, compensated=bare), given) is None
    intended = cut_for.compensated.with_leads
    apart = [largest_distance(made, intended)[0], largest_distance(intended, made)[0]]
    assert sorted(distance <= 1e-3 for distance in apart) == [False, True]
    assert errors_of(compare_path(made, cut_for, given))


UNCOMPENSATED = (
    WrittenLine("G21 G17 G90 G94 F100"),
    WrittenLine("G0 X10. Y0. Z5.", travel=CenterMove(10.0, 0.0, 5.0, None, 0, (10.0, 0.0))),
    WrittenLine("G1 X20.", travel=CenterMove(20.0, 0.0, 5.0, 100.0, 0, (20.0, 0.0))),
    WrittenLine("G3 X30. Y10. I0. J10.", travel=CenterMove(30.0, 10.0, 5.0, 100.0, 1, (20.0, 10.0))),
    WrittenLine("M2"),
)


@pytest.mark.parametrize("bad", [nan, 0.5])
@pytest.mark.parametrize(
    ("array", "line", "axis"),
    [*(("points", line, axis) for line in (2, 3, 4) for axis in range(3)), ("centers", 4, 0), ("centers", 4, 1)],
)
def test_a_move_with_a_wrong_or_invalid_number_is_a_difference(array: str, line: int, axis: int, bad: float) -> None:
    plain = replace(intended_program(), lines=UNCOMPENSATED)
    run = run_written("linuxcnc", plain.text)
    assert different_move(run, plain) is None
    values = getattr(run.moves, array).copy()
    values[np.flatnonzero(run.moves.lines == line), axis] += bad
    spoilt = replace(run, moves=replace(run.moves, **{array: values}))
    difference = different_move(spoilt, plain)
    assert difference is not None
    assert f"ends line {line} " in difference.text


@must_exercise(0.5)
@settings(max_examples=60, deadline=None, derandomize=True)
@given(LEGS, st.sampled_from(Side), st.sampled_from([name for name in names() if name != "klartext"]))
def test_random_contours_read_back_or_are_refused_with_a_reason(
    legs: list[tuple[float, float, int, float]], side: Side, control: str
) -> None:
    """The path of the control is that of the block, apart from noted differences, or the contour is refused."""
    contour = Path.from_pieces(pieces_of(legs))
    compensated = compensate(contour, side, 4.0, 8, closed=False, blend=2.0)
    if not len(compensated.path) or bool(compensated.bridged.any()):
        return
    result = write(control, cut(compensated, depth=-0.2))
    if isinstance(result, Refusal):
        assert all(len(finding.text) > 20 for finding in result.findings)
        assert result.findings
        return
    exercised()
    run = run_written(control, result.text, cut(compensated, depth=-0.2))
    assert run.stopped_at is None
    (stretch,) = run.stretches
    path = run.moves.part(stretch.first, stretch.last).path()
    inner = path.part(1, len(path) - 1)
    allowed = max(0.006, *(note.lengths[0] + 0.006 for note in result.notes if note.code == "DIFFERS"), 0.0)
    assert (
        max(largest_distance(inner, compensated.with_leads)[0], largest_distance(compensated.with_leads, inner)[0])
        <= allowed
    )
