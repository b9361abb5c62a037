import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.path import EMPTY, Path
from core.geometry.path_parts import PartEnds, parts_between, single_pieces
from core.geometry.piece import Arc, Line, Point, Turn

SQUARE = Path.from_pieces([Line((0, 0), (4, 0)), Line((4, 0), (4, 4)), Line((4, 4), (0, 4)), Line((0, 4), (0, 0))])


def points(path: Path) -> list[list[float]]:
    return [[x, y] for x, y in path.points.tolist()]


Stretch = tuple[float, Point, float, Point]


def ends(*wanted: Stretch) -> PartEnds:
    """Stretches as columns."""
    firsts, starts, lasts, behind = zip(*wanted, strict=True) if wanted else ((),) * 4
    begin, end = ([complex(*place) for place in places] for places in (starts, behind))
    return PartEnds(np.array(firsts, float), np.array(begin, complex), np.array(lasts, float), np.array(end, complex))


def stretch(surface: Path, *one: *Stretch) -> Path:
    return next(iter(parts_between(surface, ends(one)).paths), EMPTY)


def test_a_stretch_of_one_segment():
    assert points(stretch(SQUARE, 1, (1, 0), 1, (3, 0))) == [[1, 0], [3, 0]]


def test_a_stretch_round_a_corner():
    assert points(stretch(SQUARE, 1, (1, 0), 3, (2, 4))) == [[1, 0], [4, 0], [4, 4], [2, 4]]


def test_a_stretch_past_the_start():
    assert points(stretch(SQUARE, 4, (0, 1), 1, (3, 0))) == [[0, 1], [0, 0], [3, 0]]


def test_a_stretch_all_round_back_to_its_own_segment():
    found = points(stretch(SQUARE, 1, (3, 0), 1, (1, 0)))
    assert found == [[3, 0], [4, 0], [4, 4], [0, 4], [0, 0], [1, 0]]


def test_a_stretch_of_an_arc_keeps_its_center():
    half = Path.from_pieces([Arc((2, 0), (-2, 0), (0, 0), Turn.CCW)])
    found = stretch(half, 1, (0, 2), 1, (-2, 0))
    assert found[0] == Arc((0, 2), (-2, 0), (0, 0), Turn.CCW)


def test_a_stretch_that_begins_where_its_arc_begins_ends_on_the_same_arc():
    """From its start back to its start an arc is a full turn, which lies behind every place on it."""
    half = Arc((4, 0), (4, 4), (4, 2), Turn.CCW)
    outline = Path.from_pieces([Line((0, 0), (4, 0)), half, Line((4, 4), (0, 4)), Line((0, 4), (0, 0))])
    assert points(stretch(outline, 2, half.start, 2, half.end)) == [[4, 0], [4, 4]]
    assert points(stretch(outline, 2, half.start, 2, (6, 2))) == [[4, 0], [6, 2]]
    assert points(stretch(outline, 2, (6, 2), 2, half.end)) == [[6, 2], [4, 4]]


def test_a_stretch_of_a_full_circle_ends_where_the_circle_does():
    circle = Path.from_pieces([Arc((2, 0), (2, 0), (0, 0), Turn.CCW)])
    assert points(stretch(circle, 1, (-2, 0), 1, (2, 0))) == [[-2, 0], [2, 0]]
    assert points(stretch(circle, 1, (2, 0), 1, (-2, 0))) == [[2, 0], [-2, 0]]
    assert points(stretch(circle, 1, (2, 0), 1, (2, 0))) == [[2, 0], [2, 0]]


def test_its_pieces_keep_their_segments_numbers():
    assert stretch(SQUARE, 4, (0, 1), 1, (3, 0)).numbers.tolist() == [4, 1]


def test_a_stretch_of_unknown_segments_is_empty():
    assert len(stretch(SQUARE, 7, (0, 0), 8, (1, 1))) == 0
    assert [len(one) for one in parts_between(SQUARE, ends((7, (0, 0), 8, (1, 1)), (1, (1, 0), 2, (4, 1)))).paths] == [
        2
    ]
    assert parts_between(SQUARE, ends()).paths == []
    assert parts_between(EMPTY, ends((1, (1, 0), 2, (4, 1)))).paths == []


def test_a_stretch_begins_on_the_first_and_ends_on_the_last_piece_of_its_segments_whatever_their_order():
    outline = Path.of(SQUARE.points, SQUARE.centers, SQUARE.turns, np.array([5.0, 5.0, 2.0, 2.0]))
    assert points(stretch(outline, 5, (1, 0), 2, (0, 1))) == [[1, 0], [4, 0], [4, 4], [0, 4], [0, 1]]
    assert points(stretch(outline, 2, (2, 4), 5, (4, 3))) == [[2, 4], [0, 4], [0, 0], [4, 0], [4, 3]]


def test_stretches_are_one_path_with_lines_between_them_that_are_not_theirs():
    found = parts_between(SQUARE, ends((1, (1, 0), 2, (4, 1)), (3, (3, 4), 3, (1, 4))))
    assert found.in_part.tolist() == [True, True, False, True]
    assert points(found.path) == [[1, 0], [4, 0], [4, 1], [3, 4], [1, 4]]
    assert [points(one) for one in found.paths] == [[[1, 0], [4, 0], [4, 1]], [[3, 4], [1, 4]]]


def test_single_pieces_are_parts_of_their_own_though_they_be_neighbors():
    half = Arc((4, 0), (4, 4), (4, 2), Turn.CCW)
    outline = Path.from_pieces([Line((0, 0), (4, 0)), half, Line((4, 4), (0, 4)), Line((0, 4), (0, 0))])
    found = single_pieces(outline, np.array([1, 2]))
    assert [list(one) for one in found.paths] == [[half], [outline[2]]]
    assert [one.numbers.tolist() for one in found.paths] == [[2], [3]]
    assert single_pieces(outline, np.array([], np.intp)).paths == []


def test_the_first_line_of_a_stretch_begins_in_its_own_center():
    found = stretch(SQUARE, 4, (0, 1), 1, (3, 0))
    assert found.centers.tolist() == found.starts.tolist()


@given(st.integers(0, 3), st.integers(0, 3), st.floats(0.1, 0.9), st.floats(0.1, 0.9))
def test_a_stretch_is_as_long_as_what_lies_between_its_ends(first, last, begin, end):
    """On a square of side 4 the way from one point to another is what their distances from its start tell."""
    at, to = 4.0 * (first + begin), 4.0 * (last + end)
    (x0, y0), (x1, y1) = (
        SQUARE.points[row] + part * (SQUARE.ends - SQUARE.starts)[row] for row, part in ((first, begin), (last, end))
    )
    wanted = (first + 1, (float(x0), float(y0)), last + 1, (float(x1), float(y1)))
    found = stretch(SQUARE, *wanted)
    assert found.lengths.sum() == pytest.approx((to - at) % 16.0)
