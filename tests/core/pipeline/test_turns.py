"""A contour that turns straight back says so, and no other does."""

from __future__ import annotations

from math import cos, radians, sin

import pytest

from core.advice.path_findings import turning_back
from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Turn
from core.pipeline.derive import derive
from core.program.model import CutterComp
from core.units import Unit, sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, OUTSIDE_SQUARE, OVER_RUN_SQUARE, block, program


def rounded(turn: Turn) -> list[Piece]:
    """Two lines and the arc between them, of the right or of the wrong direction."""
    return [Line((0, 0), (2, 0)), Arc((2, 0), (3, 1), (2, 1), turn), Line((3, 1), (3, 4))]


def turned(*pieces: Piece, closed: bool = False) -> list[float | None]:
    path = Path.from_pieces(pieces, [float(number) for number in range(1, len(pieces) + 1)])
    return [one.segment for one in turning_back(path, closed=closed)]


def test_an_arc_of_the_wrong_direction_turns_back_at_both_ends() -> None:
    assert turned(*rounded(Turn.CCW)) == []
    assert turned(*rounded(Turn.CW)) == [2.0, 3.0]


@pytest.mark.parametrize(("angle", "back"), [(0.0, True), (0.9, True), (1.1, False), (90.0, False), (180.0, False)])
def test_a_line_that_lies_nearly_on_the_one_before(angle: float, back: float) -> None:
    end = 2.0 - cos(radians(angle)), sin(radians(angle))
    assert turned(Line((0, 0), (2, 0)), Line((2, 0), end)) == ([2.0] if back else [])


def test_the_last_segment_meets_the_first_where_the_contour_is_closed() -> None:
    pieces = (Line((0, 0), (2, 0)), Line((2, 0), (2, 2)), Line((2, 2), (3, 0)), Line((3, 0), (0, 0)))
    assert turned(*pieces) == []
    assert turned(*pieces, closed=True) == [1.0]


def test_where_scallops_meet_they_may() -> None:
    scallops = [Arc((2 * k, 0), (2 * k + 2, 0), (2 * k + 1, 0), Turn.CW) for k in range(3)]
    assert turned(*scallops) == []
    assert turned(Line((0, -1), (0, 0)), *scallops) == []
    assert turned(Line((0, 1), (0, 0)), *scallops) == [2.0]


def test_the_arc_is_named_whichever_of_the_two_it_is() -> None:
    path = Path.from_pieces(rounded(Turn.CW), [1.0, 2.0, 3.0])
    told = [sentence(one, Unit.MM).partition("Check ")[2] for one in turning_back(path, closed=False)]
    assert told == ["its DIRECTION and its end.", "DIRECTION of segment 2."]


def test_a_circle_does_not() -> None:
    assert turned(Arc((1, 0), (1, 0), (0, 0), Turn.CCW), closed=True) == []


def test_it_is_a_warning_beside_the_path_that_names_the_place_and_what_to_do() -> None:
    (found,) = derive(program(block(((0, 0), (2, 0), (1, 0), (1, 3)), CutterComp.LEFT))).blocks
    (one,) = (one for one in found.findings if one.code == "TURNS_BACK")
    assert one.severity is Severity.WARNING
    assert sentence(one, Unit.IN) == "It begins straight back along segment 1, at X 2.0000 Y 0.0000. Check its end."
    warnings = [told for told in found.findings if told.severity is Severity.WARNING]
    assert warnings[0] == one
    assert {told.code for told in warnings[1:]} == {"PLUNGE_FED", "CROSSES_ITSELF"}


def test_where_the_center_runs_on_the_contour_it_may() -> None:
    (found,) = derive(program(block(((0, 0), (2, 0), (0, 0)), CutterComp.ON))).blocks
    assert all(one.code != "TURNS_BACK" for one in found.findings)


@pytest.mark.parametrize("points", [OUTSIDE_SQUARE, OVER_RUN_SQUARE, MID_SIDE_SQUARE])
def test_a_plain_part_does_not(points: tuple[tuple[float, float], ...]) -> None:
    (found,) = derive(program(block(points, CutterComp.RIGHT))).blocks
    assert all(one.code != "TURNS_BACK" for one in found.findings)
