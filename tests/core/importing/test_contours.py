"""Contours: clean-up, chaining, joints, nesting, start and direction, in any order of a drawing's entities."""

from __future__ import annotations

import itertools
import math
import random

import pytest

from core.geometry.piece import Arc, Line, Piece, Turn
from core.importing.clean_up import reversed_piece
from core.importing.contour import (
    ContourKind,
    fitted_contour,
    joined_open,
    reversed_contour,
    started_at,
    started_at_corner,
    started_at_side,
)
from core.importing.listing import matching, rows_of
from core.units import Unit
from tests.core.importing.drawings import (
    arc,
    circle,
    circle_of_lines,
    dxf,
    entity,
    line,
    listed,
    random_contour,
    square,
)

CONTOURS = 200


def same(first: tuple[Piece, ...], second: tuple[Piece, ...]) -> bool:
    """Whether two chains are the same pieces in the same order from the same start, to a nanometer."""
    return len(first) == len(second) and all(
        type(one) is type(other)
        and one.start == pytest.approx(other.start, abs=1e-6)
        and one.end == pytest.approx(other.end, abs=1e-6)
        and one.point_at(0.5) == pytest.approx(other.point_at(0.5), abs=1e-6)
        for one, other in zip(first, second, strict=True)
    )


@pytest.mark.parametrize("first_seed", range(0, CONTOURS, 20))
def test_shuffled_and_reversed_copies_give_the_same_chain(first_seed: int) -> None:
    for seed in range(first_seed, first_seed + 20):
        pieces = random_contour(seed)
        chance = random.Random(f"order of {seed}")
        copy = [reversed_piece(piece) if chance.random() < 0.5 else piece for piece in pieces]
        chance.shuffle(copy)
        original, shuffled = (listed(dxf(*map(entity, each))).contours for each in (pieces, copy))
        assert len(original) == 1, seed
        assert original[0].closed, seed
        assert original[0].drawn == len(pieces), seed
        assert same(original[0].pieces, shuffled[0].pieces), seed


@pytest.mark.parametrize("decimals", [3, 4, 5, 6])
def test_a_rounded_drawing_gives_the_closed_contour(decimals: int) -> None:
    for seed in range(30):
        pieces = random_contour(seed)
        exact, rounded = (listed(dxf(*(entity(piece, count) for piece in pieces))) for count in (12, decimals))
        assert [contour.closed for contour in rounded.contours] == [True], seed
        assert rounded.contours[0].drawn == len(pieces), seed
        assert rounded.gap <= 10.0**-decimals * 4, seed
        assert rounded.contours[0].area == pytest.approx(exact.contours[0].area, abs=0.5 * 10.0 ** (3 - decimals)), seed


def test_joints_leave_no_gap() -> None:
    for seed in range(30):
        contour = listed(dxf(*(entity(piece, 3) for piece in random_contour(seed)))).contours[0]
        ends = [piece.end for piece in contour.pieces]
        assert ends == [*(piece.start for piece in contour.pieces[1:]), contour.pieces[0].start]
        arcs = [piece for piece in contour.pieces if isinstance(piece, Arc)]
        for piece in arcs:
            out = complex(*piece.end) - complex(*piece.center)
            assert abs(out) == pytest.approx(piece.radius, abs=1e-6)


def test_a_gap_between_lines_is_closed_where_they_meet() -> None:
    entities = [line((0, 0), (9.995, 0)), line((10, 0.005), (10, 10)), line((10, 10), (0, 10)), line((0, 10), (0, 0))]
    contour = listed(dxf(*entities)).contours[0]
    corner = min(contour.pieces, key=lambda piece: abs(complex(*piece.start) - 10)).start
    assert corner == pytest.approx((10.0, 0.0))


def test_nothing_is_bridged_beyond_the_tolerance() -> None:
    entities = [line((0, 0), (10, 0)), line((10, 0.02), (10, 10)), line((10, 10), (0, 10)), line((0, 10), (0, 0))]
    contours = listed(dxf(*entities)).contours
    assert [contour.closed for contour in contours] == [False]
    assert contours[0].length == pytest.approx(39.98)


def test_holes_come_behind_what_they_lie_in_and_islands_behind_holes() -> None:
    squares = [*square(100, 0, 20), *square(0, 0, 80), *square(10, 10, 40), *square(20, 20, 10)]
    data = dxf(*squares, circle((70, 70), 3), circle((65, 10), 2))
    contours = listed(data).contours
    kinds = [(contour.number, contour.kind.value, contour.inside) for contour in contours]
    assert kinds == [
        (1, "OUTSIDE", 0),
        (2, "HOLE", 1),
        (3, "ISLAND", 2),
        (4, "HOLE", 1),
        (5, "HOLE", 1),
        (6, "OUTSIDE", 0),
    ]
    for contour in contours:
        assert contour.turn is (Turn.CCW if contour.kind is ContourKind.HOLE else Turn.CW)
        assert contour.side is not None
        assert contour.side.value == "LEFT"


def test_reversing_turns_left_into_right() -> None:
    contour = listed(dxf(*square(0, 0, 10))).contours[0]
    back = reversed_contour(contour)
    assert (contour.side.value, back.side.value) == ("LEFT", "RIGHT")
    assert back.start == contour.start
    assert back.turn is Turn.CCW


def test_two_squares_that_touch_in_a_corner_are_two_contours() -> None:
    contours = listed(dxf(*square(0, 0, 10), *square(10, 10, 10))).contours
    assert [(contour.closed, contour.drawn) for contour in contours] == [(True, 4), (True, 4)]
    assert contours[0].problems == ("touches or crosses chain 2",)


def test_a_dividing_line_stays_an_open_contour() -> None:
    contours = listed(dxf(*square(0, 0, 10), line((0, 0), (10, 10)))).contours
    assert [(contour.closed, contour.drawn) for contour in contours] == [(True, 4), (False, 1)]


def test_a_contour_and_a_tail_of_lines() -> None:
    tail = [line((10, 10), (15, 12)), line((15, 12), (20, 10)), line((20, 10), (25, 15))]
    made = listed(dxf(*square(0, 0, 10), *tail))
    assert [(contour.closed, contour.drawn) for contour in made.contours] == [(True, 4), (False, 3)]
    assert (made.branches[0].ways, made.branches[0].contours) == (3, (2,))


def test_open_contours_at_a_branch_are_joined_as_the_operator_says() -> None:
    made = listed(dxf(line((0, 0), (10, 0)), line((10, 0), (20, 5)), line((10, 0), (20, -5))))
    assert [contour.closed for contour in made.contours] == [False] * 3
    branch = made.branches[0]
    assert (branch.ways, branch.contours) == (3, (1, 2, 3))
    flat = next(contour for contour in made.contours if contour.size[1] == 0.0)
    other = next(contour for contour in made.contours if contour is not flat)
    joined = joined_open(flat, other, 0.01)
    assert joined is not None
    assert joined.length == pytest.approx(flat.length + other.length)
    assert len(joined.pieces) == 2


def test_duplicates_and_overlaps_of_arcs() -> None:
    made = listed(dxf(arc((0, 0), 10, 0, 180), arc((0, 0), 10, 0, 180), arc((0, 0), 10, 150, 360)))
    assert (made.duplicates, made.overlaps) == (1, 1)
    assert made.contours[0].circle == pytest.approx(10.0)


@pytest.mark.parametrize("center", [(0.0, 0.0), (40.0, 0.0), (6.3, 7.1)])
@pytest.mark.parametrize("arcs", [((0, 200), (180, 380)), ((0, 200), (0, 90), (190, 360)), ((10, 370), (30, 90))])
def test_overlapping_arcs_of_one_circle_are_the_circle(
    center: tuple[float, float], arcs: tuple[tuple[float, float], ...]
) -> None:
    made = listed(dxf(*(arc(center, 10, begin, end) for begin, end in arcs)))
    (contour,) = made.contours
    assert contour.circle == pytest.approx(10.0)


def test_overlapping_arcs_on_random_circles_are_joined_wherever_they_begin() -> None:
    rng = random.Random(5)
    for _ in range(200):
        center = (round(rng.uniform(-80, 80), 1), round(rng.uniform(-80, 80), 1))
        begin, middle, end = rng.uniform(0, 360), rng.uniform(20, 100), rng.uniform(110, 300)
        radius = rng.choice([4.0, 10.0, 12.0, 0.28])
        both = arc(center, radius, begin, begin + middle + 10), arc(center, radius, begin + middle, begin + end)
        made = listed(dxf(*both))
        assert (len(made.contours), made.overlaps) == (1, 1)
        assert made.contours[0].length == pytest.approx(math.radians(end) * radius, abs=1e-4)


@pytest.mark.parametrize("stray", [line((10, 8), (10, 15)), line((-5, 0), (15, 0)), line((4, 0), (4, 0.5))])
def test_a_stray_line_on_an_edge_opens_no_contour(stray: list[tuple[int, object]]) -> None:
    made = listed(dxf(*square(0, 0, 10), stray))
    (outside,) = [contour for contour in made.contours if contour.closed]
    assert outside.size == pytest.approx((10.0, 10.0))


@pytest.mark.parametrize("stray", [line((2, 0), (7, 0)), line((0, 0), (7, 0)), line((2, 0), (10, 0))])
def test_a_line_over_the_joint_of_two_that_go_straight_on_is_joined_with_both(stray: list[tuple[int, object]]) -> None:
    _, *sides = square(0, 0, 10)
    made = listed(dxf(line((0, 0), (5, 0)), line((5, 0), (10, 0)), *sides, stray))
    assert [(contour.closed, contour.drawn) for contour in made.contours] == [(True, 4)]
    assert made.overlaps == 2


def test_copies_of_a_piece_take_no_longer_than_others() -> None:
    made = listed(dxf(*([line((0, 0), (10, 0))] * 20_000)))
    assert (len(made.contours), made.duplicates) == (1, 19_999)


@pytest.mark.parametrize(("begin", "end"), [(4.0, 9.996), (0.004, 6.0), (9.996, 4.0), (6.0, 0.004)])
def test_a_line_that_lies_on_a_longer_one_to_within_the_tolerance_leaves_its_ends(begin: float, end: float) -> None:
    made = listed(dxf(line((0, 0), (10, 0)), line((begin, 0), (end, 0))))
    (piece,) = made.contours[0].pieces
    assert (made.overlaps, sorted([piece.start, piece.end])) == (1, [(0.0, 0.0), (10.0, 0.0)])


def test_lines_that_share_a_wall_of_two_contours_stay() -> None:
    inner = [line((2, 0), (8, 0)), line((8, 0), (8, 5)), line((8, 5), (2, 5)), line((2, 5), (2, 0))]
    made = listed(dxf(*square(0, 0, 10), *inner))
    assert [contour.drawn for contour in made.contours if contour.closed] == [4, 4]
    assert made.overlaps == 0


def test_a_curve_of_pieces_shorter_than_the_tolerance_stays() -> None:
    made = listed(circle_of_lines(400, 0.5))
    assert (made.tiny, [contour.drawn for contour in made.contours]) == (0, [400])
    assert listed(circle_of_lines(3000), tolerance=2.0).contours[0].drawn == 3000


def test_a_point_within_a_curve_of_short_pieces_is_dropped() -> None:
    # as in a drawing of letters: lines shorter than the tolerance, and one without any length between them
    corners = [(0.0, 0.0), (0.004, 0.0), (0.008, 0.001), (0.012, 0.004), (5.0, 0.0), (0.0, 5.0), (0.0, 0.0)]
    lines = [line(start, end) for start, end in itertools.pairwise(corners)]
    result = listed(dxf(*lines, line(corners[2], corners[2])))
    assert (len(result.contours), result.tiny) == (1, 1)
    assert result.contours[0].closed


def test_the_start_is_the_middle_of_the_longest_line() -> None:
    entities = [line((0, 0), (30, 0)), line((30, 0), (30, 10)), line((30, 10), (0, 10)), line((0, 10), (0, 0))]
    contour = listed(dxf(*entities)).contours[0]
    assert contour.start == pytest.approx((15.0, 0.0))
    assert (contour.drawn, len(contour.pieces)) == (4, 5)


def test_a_start_is_moved_to_corners_sides_and_typed_places() -> None:
    contour = listed(dxf(*square(0, 0, 10))).contours[0]
    corners = [started_at_corner(contour, step).start for step in (1, 2, 3, 4)]
    assert sorted(corners) == [(0.0, 0.0), (0.0, 10.0), (10.0, 0.0), (10.0, 10.0)]
    before = started_at_corner(contour, -1)
    assert before.start == pytest.approx(corners[3])
    assert len(before.pieces) == 4
    assert started_at_side(contour, 1).start == pytest.approx((0.0, 5.0))
    at_corner = started_at_corner(contour, 1)
    assert [started_at_side(at_corner, step).start for step in (1, -1)] == [
        started_at_side(contour, 1).start,
        contour.start,
    ]
    typed = started_at(contour, (3.0, -2.0))
    assert typed.start == pytest.approx((3.0, 0.0))
    assert len(typed.pieces) == 5
    assert typed.length == pytest.approx(40.0)
    assert started_at(typed, (10.0, 4.0)).start == pytest.approx((10.0, 4.0))


def test_equal_circles_fold_into_one_row() -> None:
    made = listed(dxf(*square(0, 0, 50), *(circle((10 + 5 * k, 10), 1) for k in range(6)), circle((10, 40), 2)))
    rows = rows_of(made.contours)
    assert [len(row.contours) for row in rows] == [1, 1, 6]
    assert len(rows_of(made.contours, folded=False)) == 8
    assert len(matching(made.contours, "hole", Unit.MM)) == 7


def test_fitting_keeps_corners_and_says_what_it_did() -> None:
    data = dxf(*square(0, 0, 10))
    assert fitted_contour(listed(data).contours[0], 0.005).drawn == 4


def test_a_sampled_notch_turns_the_other_way_than_the_outline() -> None:
    # a plate of 20 by 10 whose top edge has a half circle of radius 4 cut out, sampled by 100 lines
    notch = [(10 + 4 * math.cos(math.pi * k / 100), 10 - 4 * math.sin(math.pi * k / 100)) for k in range(101)]
    points = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), *notch, (0.0, 10.0), (0.0, 0.0)]
    contour = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours[0]
    fitted = fitted_contour(contour, 0.005)
    (arc,) = (piece for piece in fitted.pieces if isinstance(piece, Arc))
    assert fitted.drawn == 6
    assert arc.center == pytest.approx((10.0, 10.0), abs=0.005)
    assert arc.radius == pytest.approx(4.0, abs=0.005)


def test_a_side_that_wavers_by_less_than_fit_is_one_line() -> None:
    # the lower side of a square of 20, a point each 0.4, those near its ends off by half of FIT
    lower = [(0.4 * k, 0.0025 if k in (1, 2, 48, 49) else 0.0) for k in range(51)]
    points = [*lower, (20.0, 20.0), (0.0, 20.0), (0.0, 0.0)]
    contour = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours[0]
    fitted = fitted_contour(contour, 0.005)
    assert fitted.drawn == 4
    assert all(isinstance(piece, Line) for piece in fitted.pieces)


def test_lines_and_arcs_of_a_sampled_slot_come_back() -> None:
    # a slot of two lines and two half circles, the circles sampled by 200 lines each
    ends = [(20 + 5 * math.sin(math.pi * k / 200), -5 * math.cos(math.pi * k / 200)) for k in range(201)]
    other = [(-5 * math.sin(math.pi * k / 200), 5 * math.cos(math.pi * k / 200)) for k in range(201)]
    points = [*ends, *other, ends[0]]
    contour = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours[0]
    fitted = fitted_contour(contour, 0.005)
    assert fitted.fitted is not None
    assert fitted.fitted.before == 402
    assert fitted.drawn <= 6
    assert fitted.fitted.off <= 0.005
    assert fitted.area == pytest.approx(20 * 10 + math.pi * 25, abs=0.2)
    assert any(isinstance(piece, Line) for piece in fitted.pieces)


@pytest.mark.parametrize("angle", [100.0, 180.0, 235.0])
def test_a_contour_starts_on_its_arc_where_that_is_nearest_to_a_place(angle: float) -> None:
    slot = [line((0, -5), (20, -5)), arc((20, 0), 5, -90, 90), line((20, 5), (0, 5)), arc((0, 0), 5, 90, 270)]
    contour = listed(dxf(*slot)).contours[0]
    x, y = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    for start in (contour, reversed_contour(contour)):
        assert started_at(start, (9.0 * x, 9.0 * y)).start == pytest.approx((5.0 * x, 5.0 * y))
