"""The findings that the operator reads for a verdict."""

from __future__ import annotations

from math import nan, pi

import pytest

from core.finding import Severity
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.units import Unit, sentence
from core.verify.air_cuts import air_cuts
from core.verify.judge import judge
from core.verify.report import contact_findings, move_name, verdict_findings
from tests.core.verify.shapes import around, lines, square
from tests.core.verify.test_judge import CORNERS, MID_SIDE, MID_SIDE_PATH, OVER_RUN, OVER_RUN_PATH, R

INCH = 25.4
WALL = lines((0, 0), (10, 0))


def test_a_clean_and_complete_path_has_no_findings() -> None:
    assert verdict_findings(judge(square(), Side.RIGHT, R, around(CORNERS, R)), square()) == ()


def test_the_depth_of_a_gouge_from_behind_is_limited_to_the_diameter() -> None:
    for move, depth in ((lines((5, 3), (5, -0.5), (9, -0.5)), "1.500"), (lines((5, 3), (5, -4)), "2.000 or more")):
        gouge, wrong, *_ = verdict_findings(judge(WALL, Side.LEFT, 1.0, move), WALL)
        assert sentence(gouge, Unit.MM).startswith(
            f"GOUGE {depth} deep in segment 1 at X 5.000 Y 0.000, by the path of segment 1."
        )
        assert sentence(wrong, Unit.MM).startswith("The cutter is on the wrong side for ")


def test_a_gouge_names_both_segments_and_the_place() -> None:
    verdict = judge(WALL, Side.LEFT, 1.0, lines((0, 1), (5, 0.5), (10, 1)))
    (gouge,) = (finding for finding in verdict_findings(verdict, WALL) if finding.code == "GOUGE")
    assert gouge.severity is Severity.ERROR
    assert gouge.segment == 1
    assert gouge.at == (5.0, 0.0)
    assert gouge.value == 0.5
    assert sentence(gouge, Unit.MM) == "GOUGE 0.500 deep in segment 1 at X 5.000 Y 0.000, by the path of segment 1."
    assert gouge.lengths == pytest.approx((verdict.gouges[0].extent,))


def test_a_move_is_named_by_its_kind() -> None:
    surface = Path.from_pieces([Line((0, 0), (4, 0)), Arc((4, 0), (5, 1), (4, 1), Turn.CCW), Line((5, 1), (5, 4))])
    pieces: list[Piece] = [
        Line((0, 1), (3, 1)),
        Line((3, 1), (3.5, 1.5)),
        Line((3.5, 1.5), (4, 2)),
        Arc((4, 2), (5, 3), (4, 3), Turn.CCW),
    ]
    path = Path.from_pieces(pieces, [1.0, 1.5, 2.0, 2.5])
    assert [move_name(path, row, surface) for row in range(4)] == [
        "the path of segment 1",
        "the straight move across the corner after segment 1",
        "the straight move across segment 2",
        "the corner arc after segment 2",
    ]


def test_a_half_number_without_its_corner_arc_names_the_corner() -> None:
    path = lines((0, 1), (5, 0.5), (10, 1))
    half = type(path).of(path.points, path.centers, path.turns, path.numbers + 0.5)
    (gouge,) = verdict_findings(judge(WALL, Side.LEFT, 1.0, half), WALL)
    assert gouge.text.endswith("by the path at the corner after segment 1.")


def test_small_values_are_not_shown_as_zero() -> None:
    for unit, digit in ((Unit.MM, "0.003"), (Unit.IN, "0.0001")):
        (gouge, *_) = verdict_findings(judge(WALL, Side.LEFT, 1.0, lines((0, 0.9995), (10, 0.9995))), WALL)
        assert f"GOUGE less than {digit} deep in" in sentence(gouge, unit)
        (uncut,) = verdict_findings(judge(WALL, Side.LEFT, 1.0, lines((0, 1.0005), (10, 1.0005))), WALL)
        assert f"UNCUT less than {digit} thick, " in sentence(uncut, unit)


def test_equal_inside_corners_sharper_than_the_cutter_are_one_finding() -> None:
    (uncut,) = verdict_findings(judge(MID_SIDE, Side.LEFT, R, MID_SIDE_PATH), MID_SIDE)
    assert (uncut.code, uncut.severity, uncut.segment) == ("UNCUT", Severity.INFO, 1)
    assert uncut.at == pytest.approx((2.0, 0.0))
    assert uncut.value == pytest.approx(4 * 2 * R)
    assert uncut.area == pytest.approx(4 * R * R * (1.0 - pi / 4.0), abs=1e-8)
    assert sentence(uncut, Unit.MM) == (
        "4 inside corners are sharper than the cutter: 0.104 left in each, segments 1-2, 2-3, 3-4, 4-5."
    )


def test_equal_inside_roundings_smaller_than_the_cutter_are_one_finding() -> None:
    half, radius, turn = 5.0, 1.0, Turn.CCW
    pieces: list[Piece] = [
        Line((0, -half), (4, -half)),
        Arc((4, -half), (half, -4), (4, -4), turn),
        Line((half, -4), (half, 4)),
        Arc((half, 4), (4, half), (4, 4), turn),
        Line((4, half), (0, half)),
    ]
    surface, far = Path.from_pieces(pieces), half - 2 * radius
    path = lines((0, -far), (far, -far), (far, far), (0, far))
    (uncut,) = verdict_findings(judge(surface, Side.LEFT, 2 * radius, path), surface)
    assert uncut.text.endswith("left in each, segments 1-3, 3-5.")
    assert uncut.lengths[0] == pytest.approx(radius * (2**0.5 - 1.0))


@pytest.mark.filterwarnings("error")
def test_an_uncut_slot_without_a_path_is_one_finding() -> None:
    turn = Turn.CCW
    pieces: list[Piece] = [
        Line((0, 0), (30, 0)),
        Arc((30, 0), (30, 10), (30, 5), turn),
        Line((30, 10), (0, 10)),
        Arc((0, 10), (0, 0), (0, 5), turn),
    ]
    surface = Path.from_pieces(pieces, [1.0, 2.0, 3.0, 4.0])
    verdict = judge(surface, Side.LEFT, 5.0005, [])
    assert [finding.text for finding in verdict_findings(verdict, surface)] == [
        "UNCUT: nothing of segments 1-4 is cut. There is no path."
    ]


def test_each_different_corner_is_a_finding_with_its_segments() -> None:
    surface = lines((0, 0), (10, 0), (10, 10), (0, 5))
    # one millimeter below the line y = 5 + x / 2
    path = lines((0, 1), (9, 1), (9, 9.5 - 5**0.5 / 2), (0, 5.0 - 5**0.5 / 2))
    findings = verdict_findings(judge(surface, Side.LEFT, 1.0, path), surface)
    assert [finding.text.partition(" at ")[0] for finding in findings] == [
        "UNCUT {0} thick, {value} long, segments 1-2",
        "UNCUT {0} thick, {value} long, segments 2-3",
    ]
    assert findings[0].value == pytest.approx(2.0)
    assert sentence(findings[0], Unit.MM) == "UNCUT 0.414 thick, 2.000 long, segments 1-2 at X 10.000 Y 0.000."


def test_corners_that_the_cutter_could_reach_are_separate_findings() -> None:
    low, high, cut = R, 2.0 - R, 0.2
    path = lines(
        (1.0, low), (high - cut, low), (high, low + cut), (high, high - cut), (high - cut, high), (low + cut, high),
        (low, high - cut), (low, low + cut), (low + cut, low), (1.0, low),
    )  # fmt: skip
    findings = verdict_findings(judge(square(), Side.LEFT, R, path), square())
    assert [finding.text.partition(" ")[0] for finding in findings] == ["UNCUT"] * 4


def test_only_the_first_of_many_equal_corners_are_named() -> None:
    steps = [(0.0, 0.0)]
    for step in range(8):
        steps += [(step + 1.0, float(step)), (step + 1.0, step + 1.0)]
    surface = lines(*steps)
    path = lines(*((x - 0.1, y + 0.1) for x, y in steps))
    (uncut,) = verdict_findings(judge(surface, Side.LEFT, 0.1, path), surface)
    assert uncut.text == (
        "8 inside corners are sharper than the cutter: {0} left in each, segments 1-2, 3-4, 5-6, 7-8, 9-10, 11-12 "
        "and 2 more."
    )


def test_a_stretch_across_start_says_so() -> None:
    path = lines((R, R), (1.5, R), (1.5, 1.5), (R, 1.5), (R, R))
    (*_, last) = verdict_findings(judge(square(), Side.LEFT, R, path), square())
    assert "segments 4 and over START to 1 at" in last.text


def test_lengths_are_shown_in_program_units() -> None:
    wall = lines((0, 0), (10 * INCH, 0))
    path = lines((0, INCH), (5 * INCH, INCH / 2), (10 * INCH, INCH))
    (gouge,) = verdict_findings(judge(wall, Side.LEFT, INCH, path), wall)
    assert "GOUGE 0.5000 deep in segment 1 at X 5.0000 Y 0.0000" in sentence(gouge, Unit.IN)


def test_the_over_run_is_reported() -> None:
    findings = verdict_findings(judge(OVER_RUN, Side.RIGHT, R, OVER_RUN_PATH), OVER_RUN)
    assert [finding.code for finding in findings] == ["OVER_RUN", "UNCUT"]
    assert findings[0].severity is Severity.INFO
    assert findings[0].at == (0.0, 0.0)
    assert sentence(findings[0], Unit.MM) == "Over-run at X 0.000 Y 0.000: the ends are lead-in and lead-out."
    assert "segments 1-4 at" in findings[1].text


def test_a_crossing_is_a_warning() -> None:
    bow = lines((0, 0), (4, 4), (4, 0), (0, 4), (-1, 2))
    findings = verdict_findings(judge(bow, Side.LEFT, R, lines((9, 9), (8, 9))), bow)
    assert findings[-2].code == "CROSSES_ITSELF"
    assert findings[-2].severity is Severity.WARNING
    assert sentence(findings[-2], Unit.MM) == "The contour crosses itself at X 2.000 Y 2.000."


def test_the_wrong_side_is_an_error() -> None:
    findings = verdict_findings(judge(square(), Side.RIGHT, 0.1, lines((0.5, 1), (1.5, 1))), square())
    assert findings[0].code == "WRONG_SIDE"
    assert findings[0].severity is Severity.ERROR
    assert findings[0].text == "The cutter is on the wrong side for 1 move. Check CUTTER COMP."
    along = lines((-0.1, -0.1), (2.1, -0.1), (2.1, 1.5), (1.5, 2.1), (-0.1, 2.1), (-0.1, -0.1))
    crossing = verdict_findings(judge(square(), Side.RIGHT, 0.1, along), square())
    texts = [finding.text for finding in crossing if finding.code == "WRONG_SIDE"]
    assert texts == ["The path crosses the contour: 1 move on the wrong side."]


def test_a_contour_without_a_path_is_uncut() -> None:
    (uncut,) = verdict_findings(judge(square(), Side.RIGHT, R, EMPTY), square())
    assert uncut.text == "UNCUT: nothing of segments 1-4 is cut. There is no path."
    assert uncut.value == pytest.approx(8.0)


def test_a_path_that_cannot_be_judged_is_an_error() -> None:
    (unjudged,) = verdict_findings(judge(square(), Side.RIGHT, nan, MID_SIDE_PATH), square())
    assert unjudged.code == "UNJUDGED"
    assert unjudged.severity is Severity.ERROR
    assert unjudged.text.startswith("Not judged: a coordinate or the tool radius")
    spiral = Path.from_pieces([Arc((9.0, 0.0), (0.0, 9.01), (0.0, 0.0), Turn.CCW)], [7.0])
    (unjudged,) = verdict_findings(judge(square(), Side.RIGHT, R, spiral), square())
    assert sentence(unjudged, Unit.MM) == (
        "Not judged: the arc's radii at start and end, in path of segment 7, differ by 0.010."
    )
    either = Path.from_pieces([Arc((10.0, 0.0), (10.001, 0.0), (0.0, 0.0), Turn.CCW)], [7.0])
    (unjudged,) = verdict_findings(judge(square(), Side.RIGHT, R, either), square())
    assert unjudged.text == "Not judged: the arc in path of segment 7 may be empty or a full circle."


def test_air_cuts_and_backward_moves_are_reported() -> None:
    path = lines((10, 1), (6, 1), (5, 2), (4, 1), (0, 1))
    findings = contact_findings(air_cuts(WALL, 1.0, path), judge(WALL, Side.LEFT, 1.0, path).backwards)
    assert [finding.code for finding in findings] == ["BACKWARDS", "AWAY"]
    assert findings[0].text == "2 moves run against the direction of the contour."
    assert sentence(findings[1], Unit.MM) == "2.828 of path cuts air: 1.000 off the part at X 5.000 Y 2.000."
