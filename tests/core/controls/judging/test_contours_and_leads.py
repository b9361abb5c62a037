"""Contours are separated from their leads: no move that may be surface counts as a lead."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from core.controls.compared_controls import Compared, compare
from core.controls.judging.contours_and_leads import contour_of, contours_of, is_closed, split_where_it_closes
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import deepest_gouge, judge_run
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Turn
from core.units import Unit
from tests.core.controls.hand import run_of
from tests.tool_tables import end_mills

CONTROLS = ("linuxcnc", "nine-series:b", "rosettacnc:normal")


def lines_through(*corners: tuple[float, float]) -> Path:
    points = np.array(corners, np.float64)
    count = len(points) - 1
    return Path.of(points, points[:-1], np.zeros(count, np.int8), np.arange(1.0, count + 1))


RING = ((0, 0), (2, 0), (2, 2), (0, 0))
OTHER = ((10, 0), (12, 0), (12, 2), (10, 2), (10, 0))


def test_one_or_two_pieces_next_to_a_closed_contour_are_leads() -> None:
    path = lines_through((-1, -1), *RING, (-1, 1), (-2, 1))
    assert contours_of(path) == ((1, 4),)
    assert contour_of(path) == (1, 4)
    assert contour_of(path.part(0, 2)) == (0, 2)


def test_a_move_within_the_rounding_tolerance_is_no_closed_contour() -> None:
    """Its ends coincide, so the walls next to it are judged as without it."""
    open_walls = ((500.0, 400.0), (500.0, 450.0), (450.0, 450.0), (450.0, 400.0), (400.0, 400.0))
    for tiny in ((450.0005, 400.0005), (450.0, 400.001)):
        corners = list(open_walls)
        corners.insert(4, tiny)
        assert contours_of(lines_through(*corners)) == ((0, 5),)


@pytest.mark.parametrize("gap", [0.0001, 0.001, 0.0025])
def test_ends_within_the_rounding_tolerance_coincide_wherever_they_are(gap: float) -> None:
    """A contour also closes across the cell borders of the grid that sorts points."""
    for at in np.arange(0.0, 0.006, 0.0002):
        corners = np.array(RING, np.float64) + at
        corners[-1, 0] += gap
        assert contours_of(lines_through((-1, -1), *corners.tolist(), (-1, 1))) == ((1, 4),)


def blended(*, tangent: bool) -> Path:
    """A square whose last line passes the start, with an arc leading in to the middle of that side."""
    lead = Arc((-0.5, 1.0 - 0.5), (0.0, 1.0), (-0.5, 1.0), Turn.CCW) if tangent else Line((-0.5, 0.5), (0.0, 1.0))
    corners = ((0.0, 1.0), (0.0, 2.0), (2.0, 2.0), (2.0, 0.0), (0.0, 0.0), (0.0, 1.2), (-1.0, 1.5))
    return Path.from_pieces([lead, *(Line(start, end) for start, end in pairwise(corners))])


def test_a_contour_that_closes_within_its_last_line_is_split_there() -> None:
    split = split_where_it_closes(blended(tangent=True))
    path = split.path
    assert len(path) == len(blended(tangent=True)) + 1
    assert split.contours == ((1, 6),)
    assert np.allclose(path.points[6], (0, 1))
    assert path.numbers[5] == path.numbers[6]


def cornered(*, tangent: bool) -> Path:
    """A square that starts at a corner, with both leads between that corner and one point."""
    away = -0.5 if tangent else 0.5
    start, corner = (-0.5, -0.5), (0.0, 0.0)
    square = (corner, (0.0, 2.0), (2.0, 2.0), (2.0, 0.0), corner)
    first = Arc(start, corner, (-0.5, 0.0) if tangent else (0.0, -0.5), Turn.CCW if tangent else Turn.CW)
    last = Arc(corner, start, (0.0, away if tangent else -0.5), Turn.CCW if tangent else Turn.CW)
    return Path.from_pieces([first, *(Line(start, end) for start, end in pairwise(square)), last])


def test_blends_that_begin_and_end_at_one_point_are_leads() -> None:
    assert contours_of(cornered(tangent=True)) == ((1, 5),)
    assert contours_of(cornered(tangent=False)) == ((0, 6),)


BIG = (
    "G21 G17 G90 G40 F200\nT1 M6\nG0 X0 Y-10\nG41 {offset}G1 X0 Y-60\nX30 Y-10\nG3 X0 Y20 I-30 J0\n"
    "G2 X0 Y20 I0 J3\nG3 X-30 Y-10 I0 J-30\nG1 X0 Y-60\nG40 G1 X0 Y-10\nM30\n"
)
"""A teardrop that starts at its sharp inside corner, with a loop at its round end."""


BORE = (
    "G21 G17 G90 F300\nG0 X0. Y0.\nT1 M6\n{side} D1 G1 X-10.\nG3 X20. I15.\n{circle}G3 X-10. I-15.\nG40 G1 X0.\nM30\n"
)
"""Half turns of 15 mm in and out at one point of a circle of 20 mm."""


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc"])
@pytest.mark.parametrize("circle", ["I-20.\n", "G3 X-20. R20.\nX20. R20.\n"])
def test_half_turns_into_and_out_of_a_bore_at_one_point_are_leads(circle: str, control: str) -> None:
    (result,) = judge_run(run_of(BORE.format(side="G41", circle=circle), control, t1=10.0))
    assert (result.verdict.clean, result.verdict.uncut_length) == (True, 0.0)
    assert len(result.lead_lines) == 2


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc"])
def test_half_turns_through_a_boss_gouge_it(control: str) -> None:
    (result,) = judge_run(run_of(BORE.format(side="G42", circle="I-20.\n"), control, t1=10.0))
    assert result.verdict.gouges


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc:a", "haas:a"])
def test_a_contour_with_a_loop_at_its_far_end_is_no_lead(control: str) -> None:
    run = run_of(BIG.format(offset="" if control == "linuxcnc" else "D1 "), control, t1=10.0)
    assert any(result.verdict.gouges for result in judge_run(run))


@pytest.mark.parametrize("turned_round", [False, True])
def test_repeated_passes_of_lines_are_split_at_their_start(turned_round: bool) -> None:
    square = ((0, 2), (2, 2), (2, 0), (0, 0))
    laps = lines_through((-1, 1), (0, 1), *square, *square, (0, 1.2), (-1, 1.2))
    split = split_where_it_closes(laps.reversed() if turned_round else laps)
    assert len(split.path) == len(laps) + 2
    ((first, last),) = split.contours
    assert np.allclose(split.path.points[first], split.path.points[last])
    assert last - first == 10


def test_contours_that_close_or_are_retraced_in_reverse_are_not_split() -> None:
    backtrack = lines_through((0, 0), (2, 0), (2, 2), (1, 2), (1, 0), (0.5, 0), (-1, 0))
    for path in (lines_through((-1, -1), *RING, (-1, 1)), lines_through((0, 0), (1, 0)), backtrack):
        assert len(split_where_it_closes(path).path) == len(path)


FRAME = "G21 G17 G40 G90 F400\nT1 M6\nG0 X{start}\nG1 Z-3.\n{cut}\nM30\n"
ARC_IN = "G41 D1 G1 X-10. Y10.\nG3 X0. Y20. R10.\nG1 Y50.\nX80.\nY0.\n"
LARGE_ARC_IN = ARC_IN.replace("X-10. Y10.", "X-12. Y8.").replace("R10.", "R12.")
LAP = "Y50.\nX80.\nY0.\nX0.\n"
OUT = "G40 X-30."
LINK = "Y20.\nG3 X-12. Y32. R12.\nG1 Y8.\nG3 X0. Y20. R12.\nG1 "
"""Arcs out of a pass and into the next one."""
GOOD = {
    "an overlap, an arc and a line": ("-30. Y10.", f"{ARC_IN}X0.\nY25.\nG3 X-10. Y35. R10.\nG1 X-20.\n{OUT}"),
    "from beyond the corner": ("-30. Y-30.", f"G41 D1 X0. Y-20.\n{LAP}Y20.\nG3 X-10. Y30. R10.\nG1 {OUT}"),
    "in and out square": ("-30. Y10.", f"G41 D1 X0. Y10.\n{LAP}Y15.\nX-10.\n{OUT}"),
    "in and out square in two moves": ("-30. Y25.", f"G41 D1 X-20. Y25.\nX0.\n{LAP}Y25.\nX-20.\nG40 Y30."),
    "straight on from a corner and back": ("-40. Y10.", f"G41 D1 X-25. Y0.\nX0.\n{LAP}X-25.\nG40 X-40. Y10."),
    "straight on from the last wall": ("-30. Y-30.", f"G41 D1 X0. Y-20.\nY0.\n{LAP}Y-20.\nG40 X-30. Y-30."),
    "off a corner and back": ("-40. Y-40.", f"G41 D1 X-15. Y-15.\nX0. Y0.\n{LAP}X-15. Y-15.\nG40 X-40. Y-40."),
    "two laps": ("-30. Y20.", f"{ARC_IN}X0.\n{LAP}Y25.\nG3 X-10. Y35. R10.\nG1 {OUT}"),
    "two laps from beyond the corner": ("-30. Y-30.", f"G41 D1 X0. Y-20.\n{LAP}Y50.\nX80.\nY0.\nX-20.\n{OUT} Y-30."),
    "back to the start of the lead-in": ("-30. Y8.", f"{LARGE_ARC_IN}X0.\nY20.\nG3 X-12. Y32. R12.\nG1 Y8.\n{OUT}"),
    "an overlap, and back to the start": ("-30. Y8.", f"{LARGE_ARC_IN}X0.\nY24.\nG3 X-12. Y36. R12.\nG1 Y8.\n{OUT}"),
    "an overlap and arcs between two passes": (
        "-30. Y20.",
        f"{ARC_IN}X0.\n{LINK.replace('Y20', 'Y24', 1).replace('Y32', 'Y36')}{LAP}Y24.\nG3 X-10. Y34. R10.\nG1 {OUT}",
    ),
    "in along the wall, and arcs between two passes": (
        "-30. Y-5.",
        f"G41 D1 X0. Y10.\nY20.\n{LAP}{LINK}{LAP}Y20.\nG3 X-10. Y30. R10.\nG1 {OUT}",
    ),
    "arcs out and in between two passes": ("-30. Y20.", f"{ARC_IN}X0.\n{LINK}{LAP}Y20.\nG3 X-10. Y30. R10.\nG1 {OUT}"),
}
"""The start and the blocks of programs that do not gouge an 80 by 50 plate."""


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc"])
@pytest.mark.parametrize("name", GOOD)
def test_leads_and_repeated_passes_of_good_programs_do_not_gouge(name: str, control: str) -> None:
    start, cut = GOOD[name]
    text = FRAME.format(start=start, cut=cut.replace("D1 ", "") if control == "linuxcnc" else cut)
    run = run_of(text, control, t1=10.0)
    assert run.stopped_at is None
    (result,) = judge_run(run)
    assert result.verdict.clean
    # a square lead-out leaves a cusp
    assert result.verdict.uncut_length <= 10.0 + 1e-6


def test_arcs_between_two_passes_that_lead_into_the_part_gouge_it() -> None:
    start, cut = GOOD["arcs out and in between two passes"]
    link = "Y20.\nG2 X12. Y32. R12.\nG1 Y8.\nG2 X0. Y20. R12.\nG1 "
    assert errors(FRAME.format(start=start, cut=cut.replace(LINK, link)), "fanuc:a", t1=10.0)


def test_a_way_back_to_the_lead_in_through_the_part_gouges_it() -> None:
    start, cut = GOOD["back to the start of the lead-in"]
    through = cut.replace("G3 X-12. Y32. R12.", "G2 X12. Y32. R12.").replace("G1 Y8.", "G1 X-12. Y8.")
    assert errors(FRAME.format(start=start, cut=through), "fanuc:a", t1=10.0)


ROUND = {
    "boss": "G0 X-50. Y-15.\n{offset}G1 X-35.\nG3 X-20. Y0 J15.\n{laps}G3 X-33.5594 Y17.9934 I-14.9429 J1.3073\n",
    "bore": "G0 X0 Y0\n{offset}G1 X10. Y-10.\nG3 X20. Y0 I0 J10.\n{laps}G3 X9.0903 Y10.8336 I-9.9619 J-0.8716\n",
}
LAPS = {
    "boss": ("G2 X20. Y0 I20. J0\nG2 X-19.9239 Y1.7431 I-20. J0\n", "G2 I20. J0\nG2 X-19.9239 Y1.7431 I20. J0\n"),
    "bore": ("G3 X-20. Y0 I-20. J0\nG3 X19.9239 Y1.7431 I20. J0\n", "G3 I-20. J0\nG3 X19.9239 Y1.7431 I-20. J0\n"),
}


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc"])
@pytest.mark.parametrize("way", [0, 1])
@pytest.mark.parametrize("kind", ROUND)
def test_a_circle_that_runs_five_degrees_past_its_start_does_not_gouge(kind: str, way: int, control: str) -> None:
    offset = "G41 " if control == "linuxcnc" else "G41 D1 "
    text = (
        f"G21 G17 G40 G90 F400\nT1 M6\n{ROUND[kind].format(offset=offset, laps=LAPS[kind][way])}G40 G1 X0 Y60.\nM30\n"
    )
    run = run_of(text.replace("X0 Y60.", "X0 Y0") if kind == "bore" else text, control, t1=10.0)
    assert run.stopped_at is None
    (result,) = judge_run(run)
    assert (result.verdict.clean, result.verdict.uncut_length, len(result.lead_lines)) == (True, 0.0, 3)


OPEN = "G41 D1 G1 X-8. Y-6.\nG3 X0. Y2. J8.\nG1 Y30.\nG3 X-6. Y36. I-6.\nG1 X-40.\nG3 X-48. Y28. J-8.\nG1 G40 Y18."
"""An open wall with a rounded corner between two arcs that lead in and out."""


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "rosettacnc:normal"])
def test_a_cut_into_a_lead_arc_of_an_open_contour_is_a_warning(control: str) -> None:
    cut = OPEN.replace(" D1", "") if control in ("linuxcnc", "rosettacnc:normal") else OPEN
    run = run_of(FRAME.format(start="-18. Y-6.", cut=cut), control, t1=10.0)
    assert run.stopped_at is None
    told = [finding for finding in judged_findings(judge_run(run)) if "GOUGE" in finding.code]
    assert [(finding.code, finding.severity) for finding in told] == [("LEAD-GOUGE", Severity.WARNING)] * 2


@pytest.mark.parametrize(
    ("old", "new"),
    [
        # the arc turns toward the part, so it is a wall
        ("X-8. Y-6.\nG3 X0. Y2. J8.", "X8. Y-6.\nG2 X0. Y2. J8."),
        # not on tangent
        ("X-8. Y-6.\nG3 X0. Y2. J8.", "X-8. Y2.\nG3 X0. Y2. I4."),
    ],
)
def test_a_cut_into_a_wall_of_an_open_contour_is_a_gouge(old: str, new: str) -> None:
    findings = errors(FRAME.format(start="-18. Y-6.", cut=OPEN.replace(old, new)), "fanuc:a", t1=10.0)
    assert "GOUGE" in {finding.code for finding in findings}


def test_an_arc_that_runs_past_the_start_is_split_there() -> None:
    half = Arc((-1.0, 0.0), (1.0, 0.0), (0.0, 0.0), Turn.CW)
    over = Arc((1.0, 0.0), (-0.8, 0.6), (0.0, 0.0), Turn.CW)
    path = Path.from_pieces([Line((-1.0, -2.0), (-1.0, 0.0)), half, over, Line((-0.8, 0.6), (0.0, 2.0))])
    split = split_where_it_closes(path)
    assert split.contours == ((1, 3),)
    assert np.allclose(split.path.points[3:5], [(-1, 0), (-0.8, 0.6)], rtol=0.0, atol=1e-12)
    assert (split.path.centers[3].tolist(), split.path.turns[3]) == ([0.0, 0.0], Turn.CW)
    assert split.path.numbers.tolist() == [1, 2, 3, 3, 4]
    assert split_where_it_closes(path.reversed()).contours == ((1, 3),)


def test_each_of_two_passes_of_a_contour_is_judged() -> None:
    start, cut = GOOD["two laps"]
    narrow = FRAME.format(start=start, cut=cut.replace("X80.", "X79.", 1))
    assert any(result.verdict.gouges for result in judge_run(run_of(narrow, "fanuc:a", t1=10.0)))


ROUNDED = (
    "G21 G17 G90 G40\nT1 M6\nG0 X-8.883 Y28.655\nG1 Z-1. F100.\nG42 D1 X-3.553 Y11.462\nX0. Y0.\nX-28.655 Y-8.883\n"
    "X-16.811 Y-47.089\nX40.498 Y-29.324\nX28.655 Y8.883\nX0. Y0.\nX-6.205 Y-1.923\nX-9.758 Y9.539\n"
    "G40 X-15.087 Y26.731\nM30\n"
)
"""A rotated rectangle with rounded points: its overlap ends 0.0005 off the wall."""


def test_a_wall_is_not_bent_when_a_contour_runs_along_it_again() -> None:
    assert not [finding for finding in errors(ROUNDED, "fanuc:a", t1=10.0) if finding.code == "GOUGE"]


MISTYPED = {
    "rectangle": "G42 D1 X30. Y0. F200.\nX60. Y0.\nX60. Y40.\nX0. Y40.\nX60. Y0.\nX30. Y0.\nG40 X30. Y-30.",
    "house": "G42 D1 X30. Y-20. F200.\nX60. Y0.\nX60. Y40.\nX0. Y40.\nX60. Y0.\nX30. Y-20.\nG40 X30. Y-30.",
}


@pytest.mark.parametrize("name", MISTYPED)
def test_a_wall_that_is_cut_twice_up_to_a_corner_is_no_lead(name: str) -> None:
    """The last corner should be at X0."""
    findings = errors(FRAME.format(start="20. Y-30.", cut=f"G1 {MISTYPED[name]}"), "fanuc:a", t1=10.0)
    assert "GOUGE" in {finding.code for finding in findings}


SPIKES = {
    "there and back": "X60.\nY-40.\nY0.\nX100.",
    "an arc there and back": "X60.\nG2 X70. Y-40. R60.\nG3 X60. Y0. R60.\nG1 X100.",
}


@pytest.mark.parametrize("name", SPIKES)
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_moves_out_and_back_are_no_closed_contour(name: str, control: str) -> None:
    """The walls beside the moves are gouged and are not leads."""
    text = FRAME.format(start="-30. Y10.", cut=f"G41 D1 X-20. Y0.\n{SPIKES[name]}\nG40 Y20.")
    findings = judged_findings(judge_run(run_of(text, control, t1=10.0)))
    assert {finding.code for finding in findings if finding.severity is Severity.ERROR} >= {"GOUGE"}
    assert "LEADS" not in {finding.code for finding in findings}


def test_long_moves_beside_a_small_loop_may_be_walls() -> None:
    cut = "G41 D1 X-20. Y0.\nX40.\nX50. Y-20.\nX30. Y-20.\nX40. Y0.\nX100.\nG40 Y20."
    findings = judged_findings(judge_run(run_of(FRAME.format(start="-30. Y10.", cut=cut), "fanuc:a", t1=10.0)))
    (leads,) = [finding for finding in findings if finding.code == "LEADS"]
    assert leads.severity is Severity.WARNING
    cuts = [finding for finding in findings if finding.code == "LEAD-GOUGE"]
    assert [finding.severity for finding in cuts] == [Severity.WARNING] * 2


def test_three_pieces_next_to_a_closed_contour_are_a_contour() -> None:
    path = lines_through(*RING, (-1, 1), (-2, 1), (-2, 4))
    assert contours_of(path) == ((0, 3), (3, 6))
    assert contour_of(path) == (0, 6)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_later_contour_that_overlaps_its_start_closes_there(control: str) -> None:
    rings = "X14.\nY14.\nX-14.\nY-14.\nX0.\nY-20.\nX20.\nY20.\nX-20.\nY-20.\nX5.\n"
    program = f"G21 G17 G90 F100\nG0 X0. Y0.\nG1 Z-3.\nG41 D1 G1 X0. Y-14.\n{rings}G40 X0. Y0.\nM2\n"
    assert not errors(program, control, t1=10.0)


def test_two_closed_contours_are_separated_from_the_moves_between_them() -> None:
    assert contours_of(lines_through(*RING, *OTHER)) == ((0, 3), (4, 8))
    assert contours_of(lines_through(*OTHER, (5, 5), (4, 5), *RING, (-1, -1))) == ((0, 4), (4, 7), (7, 10))


def test_a_line_out_and_back_is_no_separate_contour() -> None:
    assert contours_of(lines_through(*OTHER, (5, 5), (6, 6), (5, 5))) == ((0, 4), (4, 7))


def test_a_full_circle_next_to_a_longer_contour_is_a_contour() -> None:
    points = np.array([*OTHER, (14, 0), (14, 0)], np.float64)
    centers, turns = points[:-1].copy(), np.zeros(6, np.int8)
    turns[5], centers[5] = 1, (15, 0)
    assert contours_of(Path.of(points, centers, turns, np.arange(1.0, 7.0))) == ((0, 4), (5, 6))


def test_walls_between_full_circles_are_walls() -> None:
    """A square with a relief at each of its corners; the walls are longer than the circles."""
    corners = ((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0))
    pieces = list[Line | Arc]()
    for at, to, (x, y) in zip(corners, (*corners[1:], corners[0]), ((1, 1), (-1, 1), (-1, -1), (1, -1)), strict=True):
        pieces += [Arc(at, at, (at[0] + x, at[1] + y), Turn.CCW), Line(at, to)]
    assert contours_of(Path.from_pieces(pieces)) == ((0, 8),)


def test_arcs_between_two_passes_are_leads_before_an_open_contour() -> None:
    corners = ((0.0, 2.0), (0.0, 5.0), (8.0, 5.0), (8.0, 0.0), (0.0, 0.0), (0.0, 2.0))
    around = [Line(start, end) for start, end in pairwise(corners)]
    link: list[Line | Arc] = [
        Arc((0.0, 2.0), (-1.0, 3.0), (-1.0, 2.0), Turn.CCW),
        Line((-1.0, 3.0), (-1.0, 1.0)),
        Arc((-1.0, 1.0), (0.0, 2.0), (-1.0, 2.0), Turn.CCW),
    ]
    walls = [Line(start, end) for start, end in pairwise(((0.0, 2.0), (-3.0, 2.0), (-3.0, 9.0), (0.0, 9.0)))]
    assert contours_of(Path.from_pieces([*around, *link, *around, *walls])) == ((0, 5), (8, 13), (13, 16))


def test_no_moves_count_as_leads_among_very_many_contours() -> None:
    corners = [(x + 4 * row, y) for row in range(40) for x, y in RING]
    path = lines_through(*corners)
    assert contours_of(path) == ((0, len(path)),)


KEY = "X-70. Y-50.\nY-20.\nX-62.\nY-30.\nX-67.\nY-40.\nX-48.\nY-30.\nX-58.\nY-20.\nX-45.\nY-50.\nX-70."
"""A pocket with a 4 mm neck that a 6 mm tool enters anyway, gouging 2 mm on either side."""


def ring_and_key(depths: int) -> str:
    ring = "".join(f"G1 Z-{depth}.\nY30.\nX40.\nY0.\nX0.\n" for depth in range(1, depths + 1))
    begin = "G21 G17 G90 G94 F100\nG0 X-20. Y-20. Z5.\nG41 D1 G1 X-5. Y-16.\nX0. Y-12.\nY0.\n"
    return begin + ring + f"X-20. Y14.\nX-90. Y14.\nX-90. Y-50.\nZ-1.\n{KEY}\nX-120.\nG40 X-140. Y-80.\nM2\n"


def errors(program: str, control: str, t1: float = 6.0) -> list[Finding]:
    findings = judged_findings(judge_run(run_of(program, control, t1=t1)))
    return [finding for finding in findings if finding.severity is Severity.ERROR]


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("depths", [1, 2, 3, 8])
def test_a_gouge_is_reported_after_any_number_of_passes_of_another_contour(control: str, depths: int) -> None:
    key = len(ring_and_key(depths).split("Z-1.\nX-70. ")[0].splitlines())
    key_errors = [finding for finding in errors(ring_and_key(depths), control) if (finding.line or 0) > key]
    assert [finding.value for finding in key_errors if finding.code == "GOUGE"][:2] == pytest.approx(
        [2.0, 2.0], abs=1e-6
    )


OPEN_KEY = (
    "G21 G17 G90 F100\nG0 X-30. Y30. Z5.\nG41 D1 G1 X-20. Y10.\nX0. Y0.\nX20.\nY-10.\nX0.\nY-40.\nX44.\nY-10.\nX24.\n"
    "Y0.\nX60.\nY20.\nX100.\n{circle}G40 X130. Y60.\nM2\n"
)


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("circle", ["", "G2 X100. Y20. I0. J-20.\nG1 "])
def test_a_full_circle_after_an_open_contour_does_not_hide_its_gouge(control: str, circle: str) -> None:
    gouges = [finding for finding in errors(OPEN_KEY.format(circle=circle), control) if finding.code == "GOUGE"]
    assert [finding.value for finding in gouges if finding.line in (6, 12)] == pytest.approx([2.0, 2.0], abs=1e-6)


FIRST_RING, SECOND_RING = "Y30.\nX40.\nY0.\nX0.\n", "Y30.\nX140.\nY0.\nX100.\n"


def two_rings(link: str) -> str:
    begin = "G21 G17 G90 G94 F100\nG0 X-30. Y-30. Z5.\nG41 D1 G1 X0. Y-10.\nY0.\n"
    return begin + FIRST_RING + link + SECOND_RING + "G40 X90. Y-40.\nM2\n"


@pytest.mark.parametrize("control", CONTROLS)
def test_long_moves_between_contours_are_reported_as_a_possible_contour(control: str) -> None:
    """Three moves may be an open contour: their gouges stay errors, with a hint on what to do."""
    findings = judged_findings(judge_run(run_of(two_rings("X-20.\nY-50.\nX100.\nY0.\n"), control, t1=6)))
    assert {9.0, 10.0} & {
        float(finding.text.split("line ")[1].split()[0]) for finding in findings if finding.code == "GOUGE"
    }
    (link,) = (finding for finding in findings if finding.code == "WAY")
    assert (link.severity, link.line) == (Severity.WARNING, 9)
    assert link.text.startswith("Lines 9-12 are treated as a contour")
    short = judged_findings(judge_run(run_of(two_rings("X-20. Y-50.\nX100. Y0.\n"), control, t1=6)))
    assert not {"WAY", "GOUGE"} & {finding.code for finding in short}


@pytest.mark.parametrize("way", ["X-20.\nG42 Y-50.\nX100.\nY0.\n", "X-20.\nY-50.\nX100.\nG42 Y0.\n"])
def test_moves_between_contours_with_a_side_change_are_reported_once(way: str) -> None:
    findings = judged_findings(judge_run(run_of(two_rings(way), "nine-series:a", t1=6)))
    assert "SIDES" in {finding.code for finding in findings}
    (warning,) = (finding for finding in findings if finding.code == "WAY")
    assert warning.line == 9
    assert warning.text.startswith("Lines 9-12 are treated as a contour")


NECK = "Y30.\nX10.\nY20.\nX5.\nY10.\nX19.\nY20.\nX14.\nY30.\nX40.\nY0.\nX0.\n"


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(("ring", "gouged"), [(FIRST_RING, False), (NECK, True)])
def test_long_moves_between_contours_without_gouges_are_not_reported(control: str, ring: str, gouged: bool) -> None:
    link = "G21 G17 G90 G94 F100\nG0 X-30. Y60. Z5.\nG41 D1 G1 X-60. Y30.\nY0.\nX-40.\nX-20.\nX0.\n"
    results = judge_run(run_of(link + ring + "G40 X0. Y-40.\nM2\n", control, t1=6))
    assert any(one.open_lines for one in results)
    codes = {one.code for one in judged_findings(results)}
    assert ("GOUGE" in codes) is gouged
    assert "WAY" not in codes


def test_closed_or_single_contours_are_not_reported_as_moves_between_contours() -> None:
    closed = lines_through(*RING, *OTHER, (5, 5), (4, 5), (3, 5), (-1, -1))
    assert [rows for rows in contours_of(closed) if not is_closed(closed, rows)] == [(8, 12)]
    alone = lines_through((0, 0), (1, 0), (1, 1), (5, 5))
    assert contours_of(alone) == ((0, 3),)
    assert not is_closed(alone, (0, 3))
    corners, circle = OPEN_KEY.format(circle=""), OPEN_KEY.format(circle="G2 X100. Y20. I0. J-20.\nG1 ")
    findings_by_program = [
        judged_findings(judge_run(run_of(program, "linuxcnc", t1=6))) for program in (corners, circle)
    ]
    assert [sum(finding.code == "WAY" for finding in findings) for findings in findings_by_program] == [0, 1]


def test_the_comparison_of_controls_reports_the_gouge() -> None:
    rows = compare(ring_and_key(3).encode(), end_mills({1: 6.0}), Unit.MM)
    (row,) = (row for row in rows if row.control == "linuxcnc")
    assert isinstance(row, Compared)
    assert deepest_gouge(row.results)[0] >= 2.0 - 1e-6


def test_a_gouge_of_a_line_out_and_back_at_a_corner_is_a_warning() -> None:
    """The line leads in and out along the line of the bottom wall, and may be a wall itself."""
    cut = "G41 D1 G1 X-30. Y0. F100.\nX0.\nY50.\nX50.\nY0.\nX0.\nX-30.\nG40 X-45. Y-15."
    findings = judged_findings(judge_run(run_of(FRAME.format(start="-45. Y-15.", cut=cut), "fanuc:a", t1=10.0)))
    assert {finding.severity for finding in findings if finding.code == "LEAD-GOUGE"} == {Severity.WARNING}


ROUNDED_BORES = {
    "0.01 mm": (
        "G21 G17 G90 G40\nT1 M6\nG0 X12.67 Y4.19 Z5.\nG1 Z-1. F100.\nG41 D1 G1 X17.67 Y9.19 F200.\n"
        "G3 X17.67 Y17.67 I-4.24 J4.24\nG3 X-15. Y-20. I-17.67 J-17.67\nG3 X14.33 Y20.47 I15. J20.\n"
        "G3 X5.97 Y19. I-3.44 J-4.91\nG40 G1 X9.6 Y14.8\nG0 Z50.\nM30\n",
        6.0,
    ),
    "0.0001 in": (
        "G20 G17 G90 G40\nT1 M6\nG0 X-.5557 Y.8448\nZ.1\nG1 Z-.1 F10.\nG42 D1 X-.4933 Y1.0881 F20.\n"
        "G2 X-.2178 Y1.3869 I.2871 J.0116\nG2 X.8062 Y.4034 I.0398 J-.9835\nG2 X-.0252 Y1.3758 I-.9842 J0.\n"
        "G2 X.2784 Y.959 I-.0566 J-.3602\nG40 G1 X.3163 Y.681\nG0 Z2.\nM30\n",
        0.375,
    ),
}
"""Bores that run a few degrees past their start, on arcs whose rounded ends have two radii."""


@pytest.mark.parametrize("control", ["fanuc:a", "fanuc:b", "haas:a"])
@pytest.mark.parametrize("digit", ROUNDED_BORES)
def test_an_over_run_on_rounded_arcs_is_no_gouge(digit: str, control: str) -> None:
    text, diameter = ROUNDED_BORES[digit]
    done = run_of(text, control, t1=diameter)
    assert done.stopped_at is None
    assert not any(finding.code == "GOUGE" for finding in judged_findings(judge_run(done)))
