"""Contours written for every control, read back here once more, and programs that must not be handed out."""

from __future__ import annotations

from dataclasses import replace
from math import nan, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.controls.registry import names
from core.controls.write.contour_pass import CenterMove, CompensatedPass, WrittenLine
from core.controls.write.iso_program import Frame, tools_of
from core.controls.write.iso_style import STYLES
from core.controls.write.read_back import (
    Intended,
    compare_path,
    different_move,
    largest_distance,
    read_back,
    same_pieces,
)
from core.controls.write.written_program import NotWritten, WrittenProgram, write_program
from core.finding import Finding, Severity
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Piece, Side, Turn
from core.geometry.piece import Line as Straight
from core.units import Unit
from tests.core.controls.klartext.test_center_path_laws import LEGS, pieces_of
from tests.core.controls.written_programs import (
    EVERY,
    INCH,
    SQUARE,
    cut,
    made_by,
    outline,
    squared,
    text_of,
    write,
)


def errors_of(*answer: Finding | None) -> list[Finding]:
    return [finding for finding in answer if finding is not None and finding.severity is Severity.ERROR]


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
    assert isinstance(found, WrittenProgram), found
    made = made_by(control, found.text, one)
    (stretch,) = made.stretches
    path = made.moves.part(stretch.first, stretch.last).path()
    own = path if control == "klartext" else path.part(1, len(path) - 1)
    mitred = side is Side.RIGHT and control.startswith(("nine-series", "fanuc", "haas")) and "yasnac" not in control
    whole = one.compensated.whole
    apart = max(largest_distance(own, whole)[0], largest_distance(whole, own)[0])
    assert (apart > 1e-3) is mitred
    assert same_pieces(own, whole, 1e-3) is not (mitred or (control == "threeblock" and overlap > 0.0))
    assert [note.code for note in found.notes] == (["DIFFERS"] if mitred else [])


def test_a_note_gives_the_distance_of_mitered_corners() -> None:
    found = write("nine-series:a", cut(squared(Side.RIGHT)))
    assert isinstance(found, WrittenProgram)
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
        found = write_program([cut(one)], control, Frame(Unit.MM), "PART", lambda _: ())
        assert isinstance(found, WrittenProgram), found
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


def meant(control: str = "linuxcnc") -> Intended:
    """A program that is right."""
    one = cut(squared(Side.RIGHT))
    lines = tuple(WrittenLine(text, 3.0) for text in text_of(control, one).splitlines())
    return Intended(control, lines, (one,), tools_of((one,), STYLES[control]), Unit.IN, 1e-6 * INCH, leads=True)


def changed(old: str, new: str) -> Intended:
    """The right program with one text changed in it."""
    right = meant()
    lines = tuple(line._replace(text=line.text.replace(old, new)) for line in right.lines)
    assert lines != right.lines
    return replace(right, lines=lines)


def test_a_program_that_is_wrong_is_never_let_through() -> None:
    assert not errors_of(*read_back(meant()))
    assert "gouges" in errors_of(*read_back(changed("G1 X2. Y2.", "G1 X1.99 Y2.")))[0].text
    assert "uncut" in errors_of(*read_back(changed("G1 X2. Y2.", "G1 X2.01 Y2.")))[0].text
    assert "depth" in errors_of(*read_back(changed("G1 X2. Y2.", "G1 X2. Y2. Z0.")))[0].text
    assert "N-ONWHENON" in errors_of(*read_back(changed("G1 X2. Y2.", "G42 D1 X2. Y2.")))[0].text
    assert "1 compensated" not in errors_of(*read_back(changed("G42 D1 ", "")))[0].text
    assert errors_of(*read_back(changed("G42", "G41")))


def test_a_right_program_with_another_tool_is_wrong() -> None:
    right = meant()
    bigger = replace(right, tools=tools_of((replace(right.cuts[0], diameter=0.6 * INCH),), STYLES["linuxcnc"]))
    assert "uncut" in errors_of(*read_back(bigger))[0].text


def test_farthest_finds_the_piece_that_is_off() -> None:
    bent = outline((1, 0), (2, 0), (2, 1), (2.5, 2), (0, 2))
    apart, number = largest_distance(bent, SQUARE)
    assert apart / INCH == pytest.approx(0.5)
    assert number in (3.0, 4.0)


def test_farthest_names_the_piece_after_those_of_no_length() -> None:
    bent = outline((1, 0), (1, 0), (1, 0), (2, 0), (2, 1), (2.5, 2), (0, 2))
    short = (bent.points[1:] == bent.points[:-1]).all(axis=1)
    assert short.any()
    assert largest_distance(bent, SQUARE)[1] in (3.0 + short.sum(), 4.0 + short.sum())


@pytest.mark.parametrize("row", range(4))
@pytest.mark.parametrize("end", [0, 1])
def test_what_is_no_number_is_never_near(row: int, end: int) -> None:
    """A maximum that is taken by comparisons passes it over."""
    points = SQUARE.points.copy()
    points[row, end] = nan
    bad = Path.of(points, SQUARE.centers, SQUARE.turns)
    assert not same_pieces(bad, SQUARE, 1e-3)
    assert not largest_distance(bad, SQUARE)[0] <= 1e-3
    assert not largest_distance(SQUARE, bad)[0] <= 1e-3
    assert largest_distance(bad, SQUARE)[1] in (row, row + 1)
    given = meant()
    (one,) = given.cuts
    assert isinstance(one, CompensatedPass)
    assert errors_of(compare_path(bad, one, replace(given, leads=False)))


def _with_lost_arc(path: Path) -> Path:
    """The path and an arc whose center is not a number, which ends where it begins: other paths pass it over."""
    points, centers = np.vstack((path.points, path.points[-1])), np.vstack((path.centers, (nan, nan)))
    return Path.of(points, centers, np.append(path.turns, 1), np.append(path.numbers, path.numbers[-1]))


@pytest.mark.parametrize("lost", ["made", "intended"])
def test_a_distance_that_is_not_a_number_in_one_direction_is_not_near(lost: str) -> None:
    given = replace(meant(), leads=False)
    (one,) = given.cuts
    assert isinstance(one, CompensatedPass)
    whole = one.compensated.whole
    made, cut_for = whole, one
    if lost == "made":
        made = _with_lost_arc(whole)
    else:
        bare = replace(one.compensated, path=whole, lead_in=EMPTY, lead_out=EMPTY)
        made, cut_for = bare.whole, replace(one, compensated=replace(bare, path=_with_lost_arc(whole)))
        assert compare_path(made, replace(one, compensated=bare), given) is None
    intended = cut_for.compensated.whole
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
def test_a_move_that_ends_at_no_number_is_another_one(array: str, line: int, axis: int, bad: float) -> None:
    plain = replace(meant(), lines=UNCOMPENSATED)
    made = made_by("linuxcnc", plain.text)
    assert different_move(made, plain) is None
    values = getattr(made.moves, array).copy()
    values[np.flatnonzero(made.moves.lines == line), axis] += bad
    spoilt = replace(made, moves=replace(made.moves, **{array: values}))
    found = different_move(spoilt, plain)
    assert found is not None
    assert f"ends line {line} " in found.text


@settings(max_examples=120, deadline=None, derandomize=True)
@given(LEGS, st.sampled_from(Side), st.sampled_from([name for name in names() if name != "klartext"]))
def test_random_contours_read_back_or_are_refused_with_a_reason(
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
    assert max(largest_distance(inner, one.whole)[0], largest_distance(one.whole, inner)[0]) <= allowed
