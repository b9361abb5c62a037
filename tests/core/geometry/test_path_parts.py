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
    firsts, starts, lasts, end_points = zip(*wanted, strict=True) if wanted else ((),) * 4
    begin, end = ([complex(*place) for place in places] for places in (starts, end_points))
    return PartEnds(np.array(firsts, float), np.array(begin, complex), np.array(lasts, float), np.array(end, complex))


def stretch(surface: Path, *wanted: *Stretch) -> Path:
    return next(iter(parts_between(surface, ends(wanted)).paths), EMPTY)


def test_a_stretch_may_be_within_one_segment():
    assert points(stretch(SQUARE, 1, (1, 0), 1, (3, 0))) == [[1, 0], [3, 0]]


def test_a_stretch_may_go_around_corners():
    assert points(stretch(SQUARE, 1, (1, 0), 3, (2, 4))) == [[1, 0], [4, 0], [4, 4], [2, 4]]


def test_a_stretch_may_go_past_the_start():
    assert points(stretch(SQUARE, 4, (0, 1), 1, (3, 0))) == [[0, 1], [0, 0], [3, 0]]


def test_a_stretch_may_go_all_around_to_its_first_segment():
    result = points(stretch(SQUARE, 1, (3, 0), 1, (1, 0)))
    assert result == [[3, 0], [4, 0], [4, 4], [0, 4], [0, 0], [1, 0]]


def test_a_stretch_of_an_arc_keeps_its_center():
    half = Path.from_pieces([Arc((2, 0), (-2, 0), (0, 0), Turn.CCW)])
    result = stretch(half, 1, (0, 2), 1, (-2, 0))
    assert result[0] == Arc((0, 2), (-2, 0), (0, 0), Turn.CCW)


def test_a_stretch_that_starts_at_the_start_of_an_arc_ends_on_that_arc():
    """An arc from its start to its start is a full turn, which is after every place on it."""
    half = Arc((4, 0), (4, 4), (4, 2), Turn.CCW)
    outline = Path.from_pieces([Line((0, 0), (4, 0)), half, Line((4, 4), (0, 4)), Line((0, 4), (0, 0))])
    assert points(stretch(outline, 2, half.start, 2, half.end)) == [[4, 0], [4, 4]]
    assert points(stretch(outline, 2, half.start, 2, (6, 2))) == [[4, 0], [6, 2]]
    assert points(stretch(outline, 2, (6, 2), 2, half.end)) == [[6, 2], [4, 4]]


def test_a_stretch_of_a_full_circle_ends_at_the_end_of_the_circle():
    circle = Path.from_pieces([Arc((2, 0), (2, 0), (0, 0), Turn.CCW)])
    assert points(stretch(circle, 1, (-2, 0), 1, (2, 0))) == [[-2, 0], [2, 0]]
    assert points(stretch(circle, 1, (2, 0), 1, (-2, 0))) == [[2, 0], [-2, 0]]
    assert points(stretch(circle, 1, (2, 0), 1, (2, 0))) == [[2, 0], [2, 0]]


def test_the_pieces_of_a_stretch_keep_their_segment_numbers():
    assert stretch(SQUARE, 4, (0, 1), 1, (3, 0)).numbers.tolist() == [4, 1]


def test_a_stretch_of_unknown_segments_is_empty():
    assert len(stretch(SQUARE, 7, (0, 0), 8, (1, 1))) == 0
    assert [
        len(part) for part in parts_between(SQUARE, ends((7, (0, 0), 8, (1, 1)), (1, (1, 0), 2, (4, 1)))).paths
    ] == [2]
    assert parts_between(SQUARE, ends()).paths == []
    assert parts_between(EMPTY, ends((1, (1, 0), 2, (4, 1)))).paths == []


def test_a_stretch_spans_all_pieces_of_its_segments_in_any_order():
    outline = Path.of(SQUARE.points, SQUARE.centers, SQUARE.turns, np.array([5.0, 5.0, 2.0, 2.0]))
    assert points(stretch(outline, 5, (1, 0), 2, (0, 1))) == [[1, 0], [4, 0], [4, 4], [0, 4], [0, 1]]
    assert points(stretch(outline, 2, (2, 4), 5, (4, 3))) == [[2, 4], [0, 4], [0, 0], [4, 0], [4, 3]]


def test_stretches_form_one_path_with_lines_between_them():
    result = parts_between(SQUARE, ends((1, (1, 0), 2, (4, 1)), (3, (3, 4), 3, (1, 4))))
    assert result.in_part.tolist() == [True, True, False, True]
    assert points(result.path) == [[1, 0], [4, 0], [4, 1], [3, 4], [1, 4]]
    assert [points(part) for part in result.paths] == [[[1, 0], [4, 0], [4, 1]], [[3, 4], [1, 4]]]


def test_neighboring_single_pieces_are_separate_parts():
    half = Arc((4, 0), (4, 4), (4, 2), Turn.CCW)
    outline = Path.from_pieces([Line((0, 0), (4, 0)), half, Line((4, 4), (0, 4)), Line((0, 4), (0, 0))])
    result = single_pieces(outline, np.array([1, 2]))
    assert [list(part) for part in result.paths] == [[half], [outline[2]]]
    assert [part.numbers.tolist() for part in result.paths] == [[2], [3]]
    assert single_pieces(outline, np.array([], np.intp)).paths == []


def test_the_center_of_the_first_line_of_a_stretch_is_its_start():
    result = stretch(SQUARE, 4, (0, 1), 1, (3, 0))
    assert result.centers.tolist() == result.starts.tolist()


@given(st.integers(0, 3), st.integers(0, 3), st.floats(0.1, 0.9), st.floats(0.1, 0.9))
def test_a_stretch_is_as_long_as_the_way_between_its_ends(first, last, begin, end):
    """On a square of side 4 the way between two points is the difference of their distances from the start."""
    at, to = 4.0 * (first + begin), 4.0 * (last + end)
    (x0, y0), (x1, y1) = (
        SQUARE.points[row] + part * (SQUARE.ends - SQUARE.starts)[row] for row, part in ((first, begin), (last, end))
    )
    wanted = (first + 1, (float(x0), float(y0)), last + 1, (float(x1), float(y1)))
    result = stretch(SQUARE, *wanted)
    assert result.lengths.sum() == pytest.approx((to - at) % 16.0)
