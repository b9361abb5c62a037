"""What the operator reads of a verdict."""

from __future__ import annotations

from math import nan, pi

import pytest

from core.finding import Severity
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.units import Unit, sentence
from core.verify.judge import judge
from core.verify.names import move_name
from core.verify.report import findings, stray_findings
from core.verify.stray import stray
from tests.core.verify.shapes import around, lines, moved, square
from tests.core.verify.test_judge import CORNERS, MID_SIDE, MID_SIDE_PATH, OVER_RUN, OVER_RUN_PATH, R

INCH = 25.4
WALL = lines((0, 0), (10, 0))


def test_a_clean_path_that_cuts_all_has_nothing_to_report() -> None:
    assert findings(judge(square(), Side.RIGHT, R, around(CORNERS, R)), square()) == ()


def test_a_gouge_behind_the_wall_is_told_as_deep_as_the_cutter_gets_and_no_deeper_than_it_is_wide() -> None:
    for move, much in ((lines((5, 3), (5, -0.5), (9, -0.5)), "1.500"), (lines((5, 3), (5, -4)), "2.000 or more")):
        gouge, wrong, *_ = findings(judge(WALL, Side.LEFT, 1.0, move), WALL)
        assert sentence(gouge, Unit.MM).startswith(
            f"The path of segment 1 gouges segment 1 by {much} at X 5.000 Y 0.000, over"
        )
        assert sentence(wrong, Unit.MM).startswith("The cutter runs on the part's side of the contour, on ")


def test_a_gouge_names_both_segments_and_the_place() -> None:
    verdict = judge(WALL, Side.LEFT, 1.0, lines((0, 1), (5, 0.5), (10, 1)))
    (gouge,) = (finding for finding in findings(verdict, WALL) if finding.code == "GOUGE")
    assert gouge.severity is Severity.ERROR
    assert gouge.segment == 1
    assert gouge.at == (5.0, 0.0)
    assert gouge.value == 0.5
    assert sentence(gouge, Unit.MM).startswith(
        "The path of segment 1 gouges segment 1 by 0.500 at X 5.000 Y 0.000, over"
    )


def test_a_move_is_named_by_what_it_is() -> None:
    surface = Path.from_pieces([Line((0, 0), (4, 0)), Arc((4, 0), (5, 1), (4, 1), Turn.CCW), Line((5, 1), (5, 4))])
    pieces: list[Piece] = [
        Line((0, 1), (3, 1)),
        Line((3, 1), (3.5, 1.5)),
        Line((3.5, 1.5), (4, 2)),
        Arc((4, 2), (5, 3), (4, 3), Turn.CCW),
    ]
    path = Path.from_pieces(pieces, [1.0, 1.5, 2.0, 2.5])
    assert [move_name(path, row, surface) for row in range(4)] == [
        "The path of segment 1",
        "The straight move across the corner after segment 1",
        "The straight move across segment 2",
        "The corner arc after segment 2",
    ]


def test_without_the_path_a_half_number_is_a_corner_s() -> None:
    path = lines((0, 1), (5, 0.5), (10, 1))
    half = type(path).of(path.points, path.centers, path.turns, path.numbers + 0.5)
    (gouge,) = findings(judge(WALL, Side.LEFT, 1.0, half), WALL)
    assert gouge.text.startswith("The path at the corner after segment 1 gouges segment 1")


def test_nothing_is_told_as_zeros() -> None:
    for unit, digit in ((Unit.MM, "0.003"), (Unit.IN, "0.0001")):
        (gouge, *_) = findings(judge(WALL, Side.LEFT, 1.0, lines((0, 0.9995), (10, 0.9995))), WALL)
        assert f"by less than {digit} at X" in sentence(gouge, unit)
        (uncut,) = findings(judge(WALL, Side.LEFT, 1.0, lines((0, 1.0005), (10, 1.0005))), WALL)
        assert f"stays uncut, less than {digit} at the thickest" in sentence(uncut, unit)


def test_uncut_stretches_name_their_segments() -> None:
    found = findings(judge(MID_SIDE, Side.LEFT, R, MID_SIDE_PATH), MID_SIDE)
    assert [finding.code for finding in found] == ["UNCUT"] * 4
    assert [finding.segment for finding in found] == [1, 2, 3, 4]
    assert found[0].severity is Severity.INFO
    assert found[0].value == pytest.approx(2 * R)
    assert sentence(found[0], Unit.MM) == (
        "0.500 of segments 1 to 2 stays uncut (segment 1 0.250, segment 2 0.250), 0.104 at the thickest, "
        "at X 2.000 Y 0.000."
    )
    assert found[0].area == pytest.approx(R * R * (1.0 - pi / 4.0), abs=1e-8)


def test_the_area_is_told_in_program_units_where_it_is_worth_it() -> None:
    surface, path = (moved(one, 0.0, (0.0, 0.0), INCH) for one in (MID_SIDE, MID_SIDE_PATH))
    (first, *_) = findings(judge(surface, Side.LEFT, R * INCH, path), surface)
    assert sentence(first, Unit.IN).endswith(", area 0.0134.")
    assert sentence(first, Unit.MM).endswith(", area 8.653.")


def test_a_stretch_over_start_says_so() -> None:
    path = lines((R, R), (1.75, R), (1.75, 1.75), (R, 1.75), (R, R))
    (*_, last) = findings(judge(square(), Side.LEFT, R, path), square())
    assert "of segments 4 to 4 and on over START to 1 stays uncut" in last.text


def test_lengths_are_shown_in_program_units() -> None:
    wall = lines((0, 0), (10 * INCH, 0))
    path = lines((0, INCH), (5 * INCH, INCH / 2), (10 * INCH, INCH))
    (gouge,) = findings(judge(wall, Side.LEFT, INCH, path), wall)
    assert "by 0.5000 at X 5.0000 Y 0.0000" in sentence(gouge, Unit.IN)


def test_the_over_run_is_told() -> None:
    found = findings(judge(OVER_RUN, Side.RIGHT, R, OVER_RUN_PATH), OVER_RUN)
    assert [finding.code for finding in found] == ["CROSSES_ITSELF", "UNCUT"]
    assert found[0].severity is Severity.WARNING
    assert found[0].at == (0.0, 0.0)
    assert "of segments 1 to 4 stays uncut" in found[1].text


def test_the_wrong_side_is_an_error() -> None:
    found = findings(judge(square(), Side.RIGHT, 0.1, lines((0.5, 1), (1.5, 1))), square())
    assert found[0].code == "WRONG_SIDE"
    assert found[0].severity is Severity.ERROR
    assert found[0].text == "The cutter runs on the part's side of the contour, on 1 move."


def test_no_path_leaves_everything() -> None:
    (uncut,) = findings(judge(square(), Side.RIGHT, R, EMPTY), square())
    assert uncut.text == "Nothing of segments 1 to 4 is cut: there is no path."
    assert uncut.value == pytest.approx(8.0)


def test_what_cannot_be_judged_is_an_error() -> None:
    (unjudged,) = findings(judge(square(), Side.RIGHT, nan, MID_SIDE_PATH), square())
    assert unjudged.code == "UNJUDGED"
    assert unjudged.severity is Severity.ERROR


def test_strays_are_told() -> None:
    found = stray_findings(stray(WALL, 1.0, lines((10, 1), (6, 1), (5, 2), (4, 1), (0, 1))))
    assert [finding.code for finding in found] == ["BACKWARDS", "AWAY"]
    assert found[0].text == "2 moves run against the direction of the contour."
    assert sentence(found[1], Unit.MM) == (
        "2.828 of path does not touch the part: at X 5.000 Y 2.000 the cutter is 1.000 off it."
    )
