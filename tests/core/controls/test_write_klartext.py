"""Contours written as Klartext: the text, and the path the control makes of it."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.comp.compensated import Compensated
from core.controls.klartext.control import run_klartext
from core.controls.write.contour_pass import CompensatedPass
from core.controls.write.klartext_program import write_klartext
from core.controls.write.read_back import MIN_TOLERANCE
from core.controls.write.written_program import Posted, Refusal, write_program
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.units import Unit


def cut(
    compensated: Compensated, depth: float = -5.0, feeds: dict[int, float] | None = None, tool: int = 1
) -> CompensatedPass:
    """One run at a depth, at 200 mm a minute unless a segment has its own feed."""
    every = {int(number): 200.0 for number in compensated.contour.numbers} | (feeds or {})
    size = 2 * compensated.radius
    return CompensatedPass(
        compensated=compensated, tool=tool, diameter=size, stock=0.0, speed=900.0, feeds=every, plunge_feed=100.0,
        travel=50.0, near=2.0, depth=depth, leave=50.0,
    )  # fmt: skip


def write(compensated: Compensated, unit: Unit = Unit.MM) -> str | Refusal:
    """The program of one run, without remarks."""
    return written([cut(compensated)], unit)


def written(cuts: list[CompensatedPass], unit: Unit = Unit.MM) -> str | Refusal:
    """The program of some runs."""
    found = write_program(cuts, "klartext", unit, "PART", lambda _: ())
    return found.text if isinstance(found, Posted) else found


def outline(*points: Point) -> Path:
    """Lines through points."""
    return Path.from_pieces([Line(a, b) for a, b in pairwise(points)])


def path_on_control(text: str, stretch: int = 0) -> Path:
    """The path the control makes of a program."""
    made = run_klartext(text.encode(), {})
    assert made.stopped_at is None, made.findings
    assert not made.findings, made.findings
    one = made.stretches[stretch]
    return made.moves.part(one.first, one.last).path()


def same_pieces(text: str, compensated: Compensated) -> bool:
    """Piece by piece the same path, but for entries of no length that rounding makes."""
    path, whole = path_on_control(text), compensated.with_leads
    kept = path.lengths > MIN_TOLERANCE
    assert path.turns[kept].tolist() == whole.turns.tolist()
    return float(np.abs(path.ends[kept] - whole.ends).max()) < MIN_TOLERANCE


SQUARE = outline((30.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0), (0.0, 0.0), (30.0, 0.0))


def test_the_text_of_a_square_from_mid_side() -> None:
    text = write(compensate(SQUARE, Side.LEFT, 5.0, 4, closed=True, blend=3.0))
    assert text == "\n".join(
        (
            "0 BEGIN PGM PART MM",
            "1 TOOL DEF 1 L+0 R+5",
            "2 TOOL CALL 1 Z S900",
            "3 L Z+50 R0 FMAX M3",
            "4 L X+27 Y+8 R0 FMAX",
            "5 L Z+2 R0 FMAX",
            "6 L Z-5 R0 F100",
            "7 APPR CT X+30 Y+0 CCA+90 R+3 RL F200",
            "8 L X+60 Y+0 F200",
            "9 L X+60 Y+60 F200",
            "10 L X+0 Y+60 F200",
            "11 L X+0 Y+0 F200",
            "12 L X+30 Y+0 F200",
            "13 DEP CT CCA+90 R+3",
            "14 L Z+50 R0 FMAX",
            "15 M30",
            "16 END PGM PART MM\n",
        )
    )


def test_between_two_depths_the_tool_goes_up_once() -> None:
    square = compensate(SQUARE, Side.LEFT, 5.0, 4, closed=True, blend=3.0)
    low = [replace(cut(square, depth), leave=2.0, travel=travel) for depth, travel in ((-2.0, 50.0), (-4.0, 2.0))]
    text = written([*low, cut(square, -6.0), cut(square, -6.0, tool=2)])
    lines = [line.partition(" ")[2] for line in text.splitlines()]
    assert not [first for first, second in pairwise(lines) if first == second]
    heights = [line for line in lines if line.startswith("L Z")]
    assert heights == [
        *("L Z+50 R0 FMAX M3", "L Z+2 R0 FMAX", "L Z-2 R0 F100", "L Z+2 R0 FMAX"),
        # the second pass begins where the first one ended, the third one begins higher
        *("L Z+2 R0 FMAX", "L Z-4 R0 F100", "L Z+2 R0 FMAX"),
        *("L Z+50 R0 FMAX", "L Z+2 R0 FMAX", "L Z-6 R0 F100", "L Z+50 R0 FMAX"),
        # a tool change names the height again, with M3
        *("L Z+50 R0 FMAX M3", "L Z+2 R0 FMAX", "L Z-6 R0 F100", "L Z+50 R0 FMAX"),
    ]


@pytest.mark.parametrize("blend", [0.0, 3.0])
def test_every_line_of_the_contour_and_its_leads_belongs_to_a_segment(blend: float) -> None:
    lines = write_klartext([cut(compensate(SQUARE, Side.LEFT, 5.0, 4, closed=True, blend=blend))], "PART", Unit.MM)
    assert isinstance(lines, tuple)
    numbers = [1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.0]
    assert [line.segment for line in lines] == [*[None] * 7, *numbers, *[None] * 3]


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("blend", [0.0, 3.0])
@pytest.mark.parametrize("overlap", [0.0, 4.0])
def test_a_square_reads_back_on_both_sides(side: Side, blend: float, overlap: float) -> None:
    compensated = compensate(SQUARE, side, 5.0, 4, closed=True, blend=blend, overlap=overlap)
    text = write(compensated)
    assert isinstance(text, str)
    assert same_pieces(text, compensated)


def test_arcs_and_a_full_circle_read_back() -> None:
    pieces: list[Piece] = [
        Line((0.0, 0.0), (40.0, 0.0)),
        Arc((40.0, 0.0), (60.0, 20.0), (40.0, 20.0), Turn.CCW),
        Arc((60.0, 20.0), (80.0, 40.0), (80.0, 20.0), Turn.CW),
        Line((80.0, 40.0), (120.0, 40.0)),
    ]
    for side in Side:
        compensated = compensate(Path.from_pieces(pieces), side, 5.0, 2, closed=False, blend=2.0)
        text = write(compensated)
        assert isinstance(text, str)
        assert same_pieces(text, compensated)
    circle = Path.from_pieces([Arc((20.0, 0.0), (20.0, 0.0), (0.0, 0.0), Turn.CCW)])
    compensated = compensate(circle, Side.LEFT, 5.0, 3, closed=True, blend=2.0, overlap=4.0)
    text = write(compensated)
    assert isinstance(text, str)
    assert same_pieces(text, compensated)


def test_inches_read_back() -> None:
    inch = Path.of(SQUARE.points * 0.8467, SQUARE.centers * 0.8467, SQUARE.turns)
    compensated = compensate(inch, Side.RIGHT, 6.35, 4, closed=True, blend=3.175)
    text = written([cut(compensated, -6.35, {number: 254.0 for number in range(1, 7)}, tool=2)], Unit.IN)
    assert isinstance(text, str)
    assert "TOOL DEF 2 L+0 R+0.25\n" in text
    assert "F10\n" in text
    made = run_klartext(text.encode(), {})
    (stretch,) = made.stretches
    path = made.moves.part(stretch.first, stretch.last).path()
    assert float(np.abs(path.points - compensated.with_leads.points).max()) < MIN_TOLERANCE


def test_deleted_segments_are_left_out_where_their_neighbors_meet() -> None:
    points = [(0.0, 0.0), (2.0, 0.0), (2.05, 0.05), (2.05, 2.0), (0.0, 2.0)]
    chamfer = outline(*((x * 25.4, y * 25.4) for x, y in points))
    compensated = compensate(chamfer, Side.LEFT, 6.35, 2, closed=False)
    assert len(compensated.deleted)
    text = write(compensated)
    assert isinstance(text, str)
    assert "L X+52.07 Y+0 " in text
    assert same_pieces(text, compensated)


def test_every_pass_goes_along_the_same_path() -> None:
    compensated = compensate(SQUARE, Side.LEFT, 5.0, 4, closed=True, blend=3.0)
    text = written([cut(compensated, depth, {2: 50.0}) for depth in (-2.0, -4.0)])
    assert isinstance(text, str)
    assert path_on_control(text, 0).points.tolist() == path_on_control(text, 1).points.tolist()
    assert text.count("L X+60 Y+60 F50\n") == 2


def test_a_path_by_another_rule_is_not_written() -> None:
    points = [(0.0, 0.0), (2.0, 0.0), (2.0, -0.3), (2.3, -0.3), (2.3, 0.0), (5.0, 0.0)]
    notch = outline(*((x * 25.4, y * 25.4) for x, y in points))
    for lookahead in (2, 3):
        refusal = write(compensate(notch, Side.LEFT, 6.35, lookahead, closed=False))
        assert isinstance(refusal, Refusal)
        assert [finding.code for finding in refusal.findings] == ["NOTWRITTEN"]


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    st.lists(st.tuples(st.floats(20, 60), st.floats(-1.2, 1.2)), min_size=2, max_size=8), st.sampled_from(list(Side))
)
def test_what_is_written_is_what_is_run(legs: list[tuple[float, float]], side: Side) -> None:
    points, heading = [(0.0, 0.0)], 0.0
    for length, turn in legs:
        heading += turn * pi / 2
        x, y = points[-1]
        points.append((round(x + length * cos(heading), 4), round(y + length * sin(heading), 4)))
    compensated = compensate(outline(*points), side, 4.0, 3, closed=False, blend=2.0)
    text = write(compensated)
    if isinstance(text, str):
        path, whole = path_on_control(text), compensated.with_leads
        assert float(np.hypot(*(path.points[0] - whole.points[0]))) < MIN_TOLERANCE
        assert float(path.lengths.sum()) == pytest.approx(float(whole.lengths.sum()), abs=0.01)
    else:
        assert [finding.code for finding in text.findings] == ["NOTWRITTEN"]
