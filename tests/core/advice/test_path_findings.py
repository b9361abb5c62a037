"""What is said of a surface: where it turns straight back, where it ends, and how large it is."""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np
import pytest

from core.advice.path_findings import ZStep, open_finding, size_warning, turning_back, z_step_findings
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Turn
from core.units import Unit, sentence


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


@pytest.mark.parametrize(("radius", "told"), [(0.99, False), (1.0, False), (1.01, True)])
def test_the_size_of_a_contour_is_that_of_its_arcs(radius, told):
    """The points of this circle span 1 mm by 0."""
    half = Path.of(np.array([[0.0, 0], [1, 0], [0, 0]]), np.array([[0.5, 0], [1, 0]]), np.array([1, 0], np.int8))
    whole = Path.of(np.zeros((2, 2)), np.array([[1.0, 0]]), np.array([1], np.int8))
    assert bool(size_warning(radius, whole)) is told
    assert bool(size_warning(radius / 2, half)) is told


@pytest.mark.parametrize(
    ("gap", "closed", "code"),
    [(0.0, False, None), (0.002, True, "NEARLY_CLOSED"), (5.0, False, "NEARLY_CLOSED"), (5.1, False, "OPEN")],
)
def test_a_gap_is_told_by_its_size_beside_the_tool(gap: float, closed: bool, code: str | None) -> None:
    surface = Path.from_pieces([Line((0, 0), (20, 0)), Line((20, 0), (20, 20)), Line((20, 20), (0, gap))])
    assert [finding.code for finding in open_finding(surface, 5.0, closed=closed)] == ([code] if code else [])


@pytest.mark.parametrize(
    ("gap", "words"),
    [
        (0.0005, "it ends at X 0.0000 Y 0.00002, 0.00002 from START."),
        (0.00001, "it ends at X 0.0000 Y 0.0000004, 0.0000004 from START."),
        (1.27, "it ends at X 0.0000 Y 0.0500, 0.0500 from START."),
    ],
)
def test_a_gap_is_told_with_the_digits_that_show_it(gap: float, words: str) -> None:
    surface = Path.from_pieces([Line((0, 0), (20, 0)), Line((20, 0), (20, 20)), Line((20, 20), (0, gap))])
    (finding,) = open_finding(surface, 5.0, closed=True)
    assert words in sentence(finding, Unit.IN)


def test_a_gap_between_two_segments_is_no_gap_but_an_open_contour() -> None:
    surface = Path.from_pieces([Line((0, 0), (20, 0)), Line((20, 0), (0, 1))])
    assert [finding.code for finding in open_finding(surface, 5.0, closed=False)] == []


def test_the_deepest_and_the_highest_step_are_told_with_their_numbers() -> None:
    steps = [ZStep(-1.0, 2.0, (0, 0)), ZStep(-3.0, 4.0, (5, 0)), ZStep(2.0, 6.0, (7, 1))]
    down, up = z_step_findings(steps)
    assert (down.segment, down.value, down.at) == (4.0, 3.0, (5, 0))
    assert sentence(down, Unit.MM).endswith("cut off there. There are 2 such places.")
    assert (up.segment, up.value) == (6.0, 2.0)
    assert "straight up 2.000" in sentence(up, Unit.MM)
    assert z_step_findings([]) == ()
