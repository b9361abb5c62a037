"""Meetings of lines and arcs: cases calculated by hand, then properties of all meetings."""

from __future__ import annotations

from cmath import rect
from math import cos, inf, pi, sin, sqrt, tau

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.geometry.intersect import MeetingKind, Meetings, meet
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Turn
from tests.properties import exercised, must_exercise

APART, TOUCH, CROSS, OVERLAP = MeetingKind
CIRCLE = Arc((1, 0), (1, 0), (0, 0), Turn.CCW)
UPPER = Arc((1, 0), (-1, 0), (0, 0), Turn.CCW)
LOWER = Arc((1, 0), (-1, 0), (0, 0), Turn.CW)
ONLY = np.array([0])


def _meet(a: Piece, b: Piece) -> Meetings:
    return meet(Path.from_pieces([a]), ONLY, Path.from_pieces([b]), ONLY)


def _points(meetings: Meetings) -> list[tuple[float, float]]:
    return [(point.real, point.imag) for point in meetings.points.tolist()]


def _expect(a: Piece, b: Piece, kind: MeetingKind, *points: tuple[float, float]) -> None:
    meetings = _meet(a, b)
    assert meetings.kinds.tolist() == [kind]
    assert _points(meetings) == [pytest.approx(point, abs=1e-12) for point in points]


@pytest.mark.parametrize(
    ("a", "b", "kind", "points"),
    [
        (Line((0, 0), (2, 0)), Line((1, -1), (1, 1)), CROSS, [(1, 0)]),
        (Line((0, 0), (2, 0)), Line((3, -1), (3, 1)), APART, []),
        (Line((0, 0), (2, 0)), Line((2, 0), (2, 1)), CROSS, [(2, 0)]),
        (Line((0, 0), (2, 0)), Line((2, 1), (2, 1e-10)), CROSS, [(2, 0)]),
        (Line((0, 0), (2, 0)), Line((2, 1), (2, 1e-8)), APART, []),
        (Line((0, 0), (2, 0)), Line((0, 1), (2, 1)), APART, []),
        (Line((0, 0), (2, 0)), Line((1, 0), (3, 0)), OVERLAP, []),
        (Line((0, 0), (2, 0)), Line((3, 0), (1, 0)), OVERLAP, []),
        (Line((0, 0), (2, 0)), Line((2, 0), (3, 0)), TOUCH, [(2, 0)]),
        (Line((0, 0), (2, 0)), Line((3, 0), (4, 0)), APART, []),
        (Line((0, 0), (0, 0)), Line((-1, 0), (1, 0)), APART, []),
    ],
)
@pytest.mark.parametrize("shift", [(0, 0), (7, -3)])
def test_two_lines_meet_as_expected(a, b, kind, points, shift):
    (x, y), first, second = shift, _shifted(a, shift), _shifted(b, shift)
    _expect(first, second, kind, *((px + x, py + y) for px, py in points))


def _shifted(line: Line, shift: tuple[float, float]) -> Line:
    x, y = shift
    return Line((line.start[0] + x, line.start[1] + y), (line.end[0] + x, line.end[1] + y))


@pytest.mark.parametrize(
    ("line", "arc", "kind", "points"),
    [
        (Line((-2, 0), (2, 0)), CIRCLE, CROSS, [(-1, 0), (1, 0)]),
        (Line((2, 0), (-2, 0)), CIRCLE, CROSS, [(1, 0), (-1, 0)]),
        (Line((0, 0), (2, 0)), CIRCLE, CROSS, [(1, 0)]),
        (Line((0, 0.5), (0, 2)), UPPER, CROSS, [(0, 1)]),
        (Line((0, 0.5), (0, 2)), LOWER, APART, []),
        (Line((0, -2), (0, 2)), LOWER, CROSS, [(0, -1)]),
        (Line((-2, 1), (2, 1)), UPPER, TOUCH, [(0, 1)]),
        (Line((-2, 1), (2, 1)), LOWER, APART, []),
        (Line((-2, 1 + 1e-10), (2, 1 + 1e-10)), UPPER, TOUCH, [(0, 1)]),
        (Line((-2, 1 + 1e-8), (2, 1 + 1e-8)), UPPER, APART, []),
        (Line((-2, 3), (2, 3)), CIRCLE, APART, []),
        (Line((-1, 0), (-3, 0)), UPPER, CROSS, [(-1, 0)]),
        (Line((0, 0), (0, 0)), CIRCLE, APART, []),
    ],
)
def test_a_line_and_an_arc_meet_alike_in_both_orders(line, arc, kind, points):
    meetings, other = _meet(line, arc), _meet(arc, line)
    assert meetings.kinds.tolist() == other.kinds.tolist() == [kind]
    assert _points(meetings) == [pytest.approx(point, abs=1e-9) for point in points]
    assert sorted(_points(other)) == sorted(_points(meetings))


@pytest.mark.parametrize(
    ("a", "b", "kind", "points"),
    [
        (CIRCLE, Arc((2, 0), (2, 0), (1, 0), Turn.CCW), CROSS, [(0.5, sqrt(0.75)), (0.5, -sqrt(0.75))]),
        (UPPER, Arc((2, 0), (2, 0), (1, 0), Turn.CCW), CROSS, [(0.5, sqrt(0.75))]),
        (UPPER, Arc((0, 0), (2, 0), (1, 0), Turn.CCW), APART, []),
        (CIRCLE, Arc((3, 0), (3, 0), (2, 0), Turn.CCW), TOUCH, [(1, 0)]),
        (CIRCLE, Arc((1, 0), (1, 0), (0.5, 0), Turn.CCW), TOUCH, [(1, 0)]),
        (CIRCLE, Arc((4, 0), (4, 0), (3, 0), Turn.CCW), APART, []),
        (CIRCLE, Arc((0.5, 0), (0.5, 0), (0, 0), Turn.CW), APART, []),
        (CIRCLE, Arc((0.3, 0), (0.3, 0), (0.2, 0), Turn.CW), APART, []),
        (CIRCLE, CIRCLE, OVERLAP, []),
        (UPPER, UPPER, OVERLAP, []),
        (UPPER, LOWER, APART, []),
        (UPPER, Arc((0, 1), (0, -1), (0, 0), Turn.CCW), OVERLAP, []),
        (UPPER, Arc((0, 1), (1, 0), (0, 0), Turn.CW), OVERLAP, []),
    ],
)
def test_two_arcs_meet_as_expected(a, b, kind, points):
    _expect(a, b, kind, *points)


def test_two_arcs_of_one_huge_circle_share_only_their_ends():
    start, end = (-5706746.431163, -3219422.0117399995), (5706746.431163, 3219422.01174)
    center = (-1662944.930787329, 2947735.653910788)
    _expect(Arc(start, end, center, Turn.CCW), Arc(end, start, center, Turn.CCW), APART)


def test_meetings_have_the_distance_along_both_pieces_and_the_rest():
    meetings = _meet(UPPER, Line((0, 0), (0, 3)))
    assert meetings.along_a.tolist() == [pytest.approx(pi / 2)]
    assert meetings.to_end_a.tolist() == [pytest.approx(pi / 2)]
    assert meetings.along_b.tolist() == [pytest.approx(1)]
    assert meetings.to_end_b.tolist() == [pytest.approx(2)]


def test_distances_along_clockwise_arcs_follow_the_travel():
    meetings = _meet(Arc((-1, 0), (1, 0), (0, 0), Turn.CW), Line((-2, 0.5), (2, 0.5)))
    assert meetings.along_a.tolist() == [pytest.approx(pi / 6), pytest.approx(5 * pi / 6)]


def test_lines_that_touch_end_to_end_have_their_place():
    meetings = _meet(Line((0, 0), (2, 0)), Line((5, 0), (2, 0)))
    assert (meetings.along_a.tolist(), meetings.to_end_a.tolist()) == ([2], [0])
    assert (meetings.along_b.tolist(), meetings.to_end_b.tolist()) == ([3], [0])


def test_no_pairs_have_no_meetings():
    none = np.empty(0, np.intp)
    meetings = meet(Path.from_pieces([CIRCLE]), none, Path.from_pieces([CIRCLE]), none)
    assert len(meetings.kinds) == len(meetings.points) == 0


def test_many_pairs_keep_their_order():
    pieces: list[Piece] = [Line((-2, 0), (2, 0)), Arc((2, 0), (2, 0), (0, 0), Turn.CCW), Line((2, 0), (0, 3))]
    path = Path.from_pieces(pieces)
    across = Path.from_pieces([Line((0, -5), (0, 5)), Line((0, 5), (9, 5)), Arc((9, 5), (7, 5), (8, 5), Turn.CW)])
    meetings = meet(path, np.array([0, 1, 2, 0, 1]), across, np.array([0, 0, 0, 2, 0]))
    assert meetings.kinds.tolist() == [CROSS, CROSS, CROSS, APART, CROSS]
    assert meetings.pair.tolist() == [0, 1, 1, 2, 4, 4]
    assert _points(meetings) == [
        pytest.approx(point, abs=1e-12) for point in [(0, 0), (0, 2), (0, -2), (0, 3), (0, 2), (0, -2)]
    ]


numbers = st.floats(-10, 10).map(lambda value: round(value, 4))
places = st.builds(complex, numbers, numbers)


def _line(start: complex, end: complex) -> Line:
    return Line((start.real, start.imag), (end.real, end.imag))


def _arc(center: complex, radius: float, begin: float, sweep: float) -> Arc:
    start, end = center + rect(radius, begin), center + rect(radius, begin + sweep)
    turn = Turn.CCW if sweep > 0 else Turn.CW
    return Arc((start.real, start.imag), (end.real, end.imag), (center.real, center.imag), turn)


sweeps = st.floats(0.05, 6.2) | st.floats(-6.2, -0.05)
any_line = st.tuples(places, places).filter(lambda ends: abs(ends[0] - ends[1]) > 0.01).map(lambda ends: _line(*ends))
any_arc = st.builds(_arc, places, st.floats(0.1, 8), st.floats(0, tau), sweeps)
any_piece = any_line | any_arc


def _distance(piece: Piece, point: complex) -> float:
    """The distance of a point from the infinite line or full circle of a piece."""
    if isinstance(piece, Arc):
        return abs(abs(point - complex(*piece.center)) - piece.radius)
    along = complex(*piece.end) - complex(*piece.start)
    return abs((along.conjugate() * (point - complex(*piece.start))).imag) / abs(along)


def _clear(meetings: Meetings) -> bool:
    """Whether all points are well inside both pieces and none is near tangent, so rounding does not decide."""
    ends = np.concatenate((meetings.along_a, meetings.along_b, meetings.to_end_a, meetings.to_end_b))
    return bool((ends > 1e-4).all()) and meetings.kinds[0] in (APART, CROSS)


@must_exercise(0.12)
@settings(max_examples=150, deadline=None, derandomize=True)
@given(any_piece, any_piece)
def test_meeting_points_lie_on_both_pieces(a, b):
    meetings = _meet(a, b)
    if len(meetings.points):
        exercised()
    for point in meetings.points.tolist():
        assert _distance(a, point) < 1e-8
        assert _distance(b, point) < 1e-8
    assert np.allclose(meetings.along_a + meetings.to_end_a, a.length, atol=1e-9)
    assert np.allclose(meetings.along_b + meetings.to_end_b, b.length, atol=1e-9)
    assert (np.diff(meetings.along_a) >= 0).all()


@settings(max_examples=100, deadline=None, derandomize=True)
@given(any_piece, any_piece)
def test_the_order_of_a_pair_does_not_matter(a, b):
    forward, backward = _meet(a, b), _meet(b, a)
    assert forward.kinds.tolist() == backward.kinds.tolist()
    order = np.argsort(backward.along_b)
    assert np.allclose(forward.points, backward.points[order], atol=1e-6)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(any_piece, any_piece, st.floats(0, tau), st.builds(complex, st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)))
def test_meeting_points_move_and_rotate_with_the_pieces(a, b, angle, shift):
    meetings = _meet(a, b)
    assume(_clear(meetings))
    turned = rect(1.0, angle)

    def moved(point: tuple[float, float]) -> tuple[float, float]:
        place = complex(*point) * turned + shift
        return place.real, place.imag

    def carried(piece: Piece) -> Piece:
        if isinstance(piece, Line):
            return Line(moved(piece.start), moved(piece.end))
        return Arc(moved(piece.start), moved(piece.end), moved(piece.center), piece.turn)

    other = _meet(carried(a), carried(b))
    assume(len(other.points) == len(meetings.points) or _steep(a, b, meetings))
    assert len(other.points) == len(meetings.points)
    assert np.allclose(other.along_a, meetings.along_a, atol=1e-6)


def _steep(a: Piece, b: Piece, meetings: Meetings) -> bool:
    """Whether a pair that does not meet is clearly apart: sampled points of a are not near the curve of b."""
    if len(meetings.points):
        return True
    path = Path.from_pieces([a])
    shares = np.linspace(0.0, 1.0, 400)
    if isinstance(a, Line):
        on = path.starts + shares[:, None] * (path.ends - path.starts)
    else:
        angle = np.arctan2(*(path.starts - path.centers)[0][::-1]) + shares * path.sweeps[0]
        on = path.centers + a.radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    return min(_distance(b, complex(x, y)) for x, y in on.tolist()) > 0.1


@settings(max_examples=100, deadline=None, derandomize=True)
@given(any_piece, any_piece)
def test_reversed_pieces_meet_at_the_same_points(a, b):
    meetings = _meet(a, b)
    back = meet(Path.from_pieces([a]).reversed(), ONLY, Path.from_pieces([b]), ONLY)
    assume(_clear(meetings))
    assert len(back.points) == len(meetings.points)
    assert np.allclose(back.along_a[::-1], meetings.to_end_a, atol=1e-7)
    assert np.allclose(back.points[::-1], meetings.points, atol=1e-7)


@pytest.mark.parametrize("seed", range(3))
def test_a_line_through_an_end_of_an_arc_meets_it_there(seed: int) -> None:
    random = np.random.default_rng(seed)
    for _ in range(100):
        radius, begin, sweep = random.uniform((0.5, 0.0, 0.2), (5.0, tau, 3.0)).tolist()
        (x, y), (dx, dy) = random.normal(0.0, 10.0, 2).tolist(), random.normal(0.0, 1.0, 2).tolist()
        turn = Turn.CCW if random.random() < 0.5 else Turn.CW
        ends = [(x + radius * cos(angle), y + radius * sin(angle)) for angle in (begin, begin + turn * sweep)]
        arc = Path.from_pieces([Arc(ends[0], ends[1], (x, y), turn)])
        for end_x, end_y in ends:
            line = Path.from_pieces([Line((end_x - dx, end_y - dy), (end_x + dx, end_y + dy))])
            result = meet(arc, ONLY, line, ONLY)
            assert np.abs(result.points - complex(end_x, end_y)).min(initial=inf) < 1e-6
