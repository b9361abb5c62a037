"""Contours of a drawing: cleanup, chaining, joints, nesting, start and direction, in any order of entities."""

from __future__ import annotations

import itertools
import math
import random
from functools import cache

import pytest
import shapely

from core.geometry.path import Path, chords_of
from core.geometry.piece import Arc, Line, Piece, Turn
from core.importing.clean_up import LayeredPiece, clean_up
from core.importing.contour import (
    ContourKind,
    fitted_contour,
    joined_open,
    reversed_contour,
    started_at,
    started_at_corner,
    started_at_side,
    traveled_like,
)
from core.importing.contours import ContourList, frame_notes, with_joined
from core.importing.listing import matching, rows_of
from core.importing.segments import with_contours
from core.program.model import CutterComp, LineSegment, Number, Program
from core.units import Unit
from tests.core.importing.drawings import (
    arc,
    block,
    circle,
    circle_of_lines,
    dxf,
    entity,
    line,
    listed,
    polyline,
    random_contour,
    square,
)

CONTOURS = 100


@cache
def drawn_contours(seed: int, decimals: int) -> ContourList:
    """The listing of a random contour whose drawing has rounded numbers."""
    return listed(dxf(*(entity(piece, decimals) for piece in random_contour(seed))))


def same(first: tuple[Piece, ...], second: tuple[Piece, ...]) -> bool:
    """Whether two chains have the same pieces in the same order, to a nanometer."""
    return len(first) == len(second) and all(
        type(piece) is type(other_piece)
        and piece.start == pytest.approx(other_piece.start, abs=1e-6)
        and piece.end == pytest.approx(other_piece.end, abs=1e-6)
        and piece.point_at(0.5) == pytest.approx(other_piece.point_at(0.5), abs=1e-6)
        for piece, other_piece in zip(first, second, strict=True)
    )


@pytest.mark.parametrize("first_seed", range(0, CONTOURS, 20))
def test_shuffled_and_reversed_copies_give_the_same_chain(first_seed: int) -> None:
    for seed in range(first_seed, first_seed + 20):
        pieces = random_contour(seed)
        rng = random.Random(f"order of {seed}")
        copy = [piece.reversed() if rng.random() < 0.5 else piece for piece in pieces]
        rng.shuffle(copy)
        original, shuffled = (listed(dxf(*map(entity, each))).contours for each in (pieces, copy))
        assert len(original) == 1, seed
        assert original[0].closed, seed
        assert original[0].drawn == len(pieces), seed
        assert same(original[0].pieces, shuffled[0].pieces), seed


@pytest.mark.parametrize("decimals", [3, 4, 5, 6])
def test_a_rounded_drawing_gives_one_closed_contour(decimals: int) -> None:
    for seed in range(15):
        exact, rounded = drawn_contours(seed, 12), drawn_contours(seed, decimals)
        assert [contour.closed for contour in rounded.contours] == [True], seed
        assert rounded.contours[0].drawn == len(random_contour(seed)), seed
        assert rounded.gap <= 10.0**-decimals * 4, seed
        assert rounded.contours[0].area == pytest.approx(exact.contours[0].area, abs=0.5 * 10.0 ** (3 - decimals)), seed


def test_pieces_of_a_contour_join_exactly() -> None:
    for seed in range(30):
        contour = drawn_contours(seed, 3).contours[0]
        ends = [piece.end for piece in contour.pieces]
        assert ends == [*(piece.start for piece in contour.pieces[1:]), contour.pieces[0].start]
        arcs = [piece for piece in contour.pieces if isinstance(piece, Arc)]
        for piece in arcs:
            out = complex(*piece.end) - complex(*piece.center)
            assert abs(out) == pytest.approx(piece.radius, abs=1e-6)


def test_a_gap_between_lines_is_closed_at_their_intersection() -> None:
    entities = [line((0, 0), (9.995, 0)), line((10, 0.005), (10, 10)), line((10, 10), (0, 10)), line((0, 10), (0, 0))]
    contour = listed(dxf(*entities)).contours[0]
    corner = min(contour.pieces, key=lambda piece: abs(complex(*piece.start) - 10)).start
    assert corner == pytest.approx((10.0, 0.0))


def test_a_gap_beyond_the_tolerance_stays_open() -> None:
    entities = [line((0, 0), (10, 0)), line((10, 0.02), (10, 10)), line((10, 10), (0, 10)), line((0, 10), (0, 0))]
    contours = listed(dxf(*entities)).contours
    assert [contour.closed for contour in contours] == [False]
    assert contours[0].length == pytest.approx(39.98)


@pytest.mark.parametrize("corner", [(5e6, 400.0), (-5e6, 400.0), (0.0, -260_000.0), (254_001.0, 254_001.0)])
def test_a_drawing_beyond_the_range_of_the_form_is_moved_to_the_origin(corner: tuple[float, float]) -> None:
    x, y = corner
    drawing = listed(dxf(*square(x, y, 40), circle((x + 15, y + 20), 5)))
    outside, hole = drawing.contours
    assert outside.start == pytest.approx((20.0, 0.0))
    assert hole.start == pytest.approx((10.0, 20.0))
    text = f"The drawing begins at X {x:.3f} Y {y:.3f}, farther out than the form takes: it is moved to X 0 Y 0."
    assert drawing.notes == (text,)


def test_a_drawing_that_reaches_into_the_range_of_the_form_stays_where_it_is() -> None:
    drawing = listed(dxf(*square(5e6, 0, 40), *square(0, 0, 10)))
    assert [max(piece.start[0] for piece in contour.pieces) for contour in drawing.contours] == [5e6 + 40, 10]
    assert drawing.notes == ()


def test_holes_follow_their_outlines_and_islands_follow_their_holes() -> None:
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


@pytest.mark.parametrize(
    ("numbers", "around"),
    [
        # 1 holds 2 and 4, 2 holds 3; 5 holds 6
        ({1, 2, 3, 4, 5, 6}, ()),
        ({2, 3}, ("Chain 1 around chains 2, 3",)),
        ({2, 3, 4, 6}, ("Chain 1 around chains 2, 3, 4",)),
        ({1, 3}, ()),
        ({2, 4}, ()),
    ],
)
def test_a_chain_around_an_outline_that_is_not_taken_is_named(numbers: set[int], around: tuple[str, ...]) -> None:
    plate = [*square(0, 0, 80), *square(5, 5, 40), *square(15, 15, 20), circle((60, 60), 5)]
    drawing = listed(dxf(*plate, *square(100, 0, 70), circle((120, 20), 3)))
    notes = frame_notes(drawing, numbers)
    assert notes == [f"{which} is not taken. If it is only a frame, reverse them." for which in around]


def test_reversing_a_contour_changes_its_side() -> None:
    contour = listed(dxf(*square(0, 0, 10))).contours[0]
    back = reversed_contour(contour)
    assert (contour.side.value, back.side.value) == ("LEFT", "RIGHT")
    assert back.start == contour.start
    assert back.turn is Turn.CCW


def test_two_squares_that_touch_at_a_corner_are_two_contours() -> None:
    contours = listed(dxf(*square(0, 0, 10), *square(10, 10, 10))).contours
    assert [(contour.closed, contour.drawn) for contour in contours] == [(True, 4), (True, 4)]
    assert contours[0].problems == ("touches or crosses chain 2",)


def test_a_contour_that_crosses_itself_says_so() -> None:
    bow_tie = polyline((0, 0), (40, 30), (40, 0), (0, 30))
    touching = polyline((100, 0), (140, 0), (140, 30), (120, 0), (100, 30))
    contours = listed(dxf(bow_tie, touching, circle((200, 0), 5), *square(220, 0, 10))).contours
    assert sorted(contour.problems for contour in contours) == [(), (), *[("touches or crosses itself",)] * 2]
    crossed = listed(dxf(bow_tie, *square(-10, -10, 20))).contours
    assert ("touches or crosses chain 1", "touches or crosses itself") in [contour.problems for contour in crossed]


@pytest.mark.parametrize("decimals", [3, 12])
def test_a_contour_crosses_itself_exactly_if_its_chords_do(decimals: int) -> None:
    crossing = 0
    for seed in range(130):
        contour = drawn_contours(seed, decimals).contours[0]
        simple = shapely.LineString(chords_of(Path.from_pieces(contour.pieces), 1e-5)).is_simple
        assert contour.problems == (() if simple else ("touches or crosses itself",)), seed
        crossing += not simple
    assert crossing == 3


def test_a_dividing_line_stays_an_open_contour() -> None:
    contours = listed(dxf(*square(0, 0, 10), line((0, 0), (10, 10)))).contours
    assert [(contour.closed, contour.drawn) for contour in contours] == [(True, 4), (False, 1)]


def test_a_dividing_line_at_a_concave_corner_stays_an_open_contour() -> None:
    """The line goes straight on where the outline turns into the corner."""
    corners = [(0, 0), (40, 0), (40, 20), (20, 20), (20, 40), (0, 40), (0, 20), (0, 0)]
    outline = [line(start, end) for start, end in itertools.pairwise(corners)]
    contours = listed(dxf(*outline, line((20, 20), (0, 20)))).contours
    assert [(contour.closed, contour.area) for contour in contours] == [(True, 1200.0), (False, 0.0)]


@pytest.mark.parametrize("angle", [90, 270])
def test_a_line_across_a_rounded_end_stays_an_open_contour(angle: float) -> None:
    sides = [line((0, 0), (40, 0)), line((0, 12), (40, 12)), line((0, 0), (0, 12)), line((40, 0), (40, 12))]
    contours = listed(dxf(*sides, arc((0 if angle == 90 else 40, 6), 6, angle, angle + 180))).contours
    assert [(contour.closed, contour.drawn) for contour in contours] == [(True, 4), (False, 1)]
    assert contours[0].area == pytest.approx(480.0 + 18.0 * math.pi)


def test_rings_of_lines_that_touch_at_tips_are_an_outer_and_an_inner_one() -> None:
    tips = [(10, 0), (0, 10), (-10, 0), (0, -10)]
    star = [(10, 0), (30, 30), (0, 10), (-30, 30), (-10, 0), (-30, -30), (0, -10), (30, -30), (10, 0)]
    rings = [*itertools.pairwise(star), *itertools.pairwise([*tips, tips[0]])]
    contours = listed(dxf(*(line(start, end) for start, end in rings))).contours
    assert [(str(contour.kind), contour.area) for contour in contours] == [("OUTSIDE", 1200.0), ("HOLE", 200.0)]


def test_a_tail_of_lines_is_separated_from_its_contour() -> None:
    tail = [line((10, 10), (15, 12)), line((15, 12), (20, 10)), line((20, 10), (25, 15))]
    drawing = listed(dxf(*square(0, 0, 10), *tail))
    assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4), (False, 3)]
    assert (drawing.branches[0].end_count, drawing.branches[0].contours) == (3, (2,))


def test_two_chosen_open_contours_at_a_branch_are_joined() -> None:
    drawing = listed(dxf(line((0, 0), (10, 0)), line((10, 0), (20, 5)), line((10, 0), (20, -5))))
    assert [contour.closed for contour in drawing.contours] == [False] * 3
    branch = drawing.branches[0]
    assert (branch.end_count, branch.contours) == (3, (1, 2, 3))
    flat = next(contour for contour in drawing.contours if contour.size[1] == 0.0)
    other = next(contour for contour in drawing.contours if contour is not flat)
    joined = joined_open(flat, other, 0.01)
    assert joined is not None
    assert joined.length == pytest.approx(flat.length + other.length)
    assert len(joined.pieces) == 2


def test_contours_joined_in_the_list_are_numbered_again() -> None:
    """Three lines meet in (10, 0); the list has them by length, then from the lower left."""
    drawing = listed(dxf(line((0, 0), (10, 0)), line((10, 0), (30, 0)), line((10, 0), (10, 5)), line((50, 0), (90, 0))))
    assert [contour.length for contour in drawing.contours] == [40.0, 20.0, 10.0, 5.0]
    joined = with_joined(drawing, 2, 3)
    assert joined is not None
    assert [(contour.number, contour.length) for contour in joined.contours] == [(1, 40.0), (2, 30.0), (3, 5.0)]
    assert [branch.contours for branch in joined.branches] == [(3,)]
    assert with_joined(drawing, 1, 2) is None


def test_duplicate_and_overlapping_arcs_are_joined() -> None:
    drawing = listed(dxf(arc((0, 0), 10, 0, 180), arc((0, 0), 10, 0, 180), arc((0, 0), 10, 150, 360)))
    assert (drawing.cleaned.duplicates, drawing.cleaned.overlaps) == (1, 1)
    assert drawing.contours[0].circle == pytest.approx(10.0)


@pytest.mark.parametrize("center", [(0.0, 0.0), (40.0, 0.0), (6.3, 7.1)])
@pytest.mark.parametrize("arcs", [((0, 200), (180, 380)), ((0, 200), (0, 90), (190, 360)), ((10, 370), (30, 90))])
def test_overlapping_arcs_of_one_circle_become_the_circle(
    center: tuple[float, float], arcs: tuple[tuple[float, float], ...]
) -> None:
    drawing = listed(dxf(*(arc(center, 10, begin, end) for begin, end in arcs)))
    (contour,) = drawing.contours
    assert contour.circle == pytest.approx(10.0)


def test_overlapping_arcs_on_random_circles_are_joined_wherever_they_begin() -> None:
    rng = random.Random(5)
    for _ in range(200):
        center = (round(rng.uniform(-80, 80), 1), round(rng.uniform(-80, 80), 1))
        begin, middle, end = rng.uniform(0, 360), rng.uniform(20, 100), rng.uniform(110, 300)
        radius = rng.choice([4.0, 10.0, 12.0, 0.28])
        both = arc(center, radius, begin, begin + middle + 10), arc(center, radius, begin + middle, begin + end)
        drawing = listed(dxf(*both))
        assert (len(drawing.contours), drawing.cleaned.overlaps) == (1, 1)
        assert drawing.contours[0].length == pytest.approx(math.radians(end) * radius, abs=1e-4)


@pytest.mark.parametrize("stray", [line((10, 8), (10, 15)), line((-5, 0), (15, 0)), line((4, 0), (4, 0.5))])
def test_a_stray_line_on_an_edge_leaves_the_contour_closed(stray: list[tuple[int, object]]) -> None:
    drawing = listed(dxf(*square(0, 0, 10), stray))
    (outside,) = [contour for contour in drawing.contours if contour.closed]
    assert outside.size == pytest.approx((10.0, 10.0))


@pytest.mark.parametrize("stray", [line((2, 0), (7, 0)), line((0, 0), (7, 0)), line((2, 0), (10, 0))])
def test_a_line_over_the_joint_of_two_collinear_lines_joins_both(stray: list[tuple[int, object]]) -> None:
    _, *sides = square(0, 0, 10)
    drawing = listed(dxf(line((0, 0), (5, 0)), line((5, 0), (10, 0)), *sides, stray))
    assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4)]
    assert drawing.cleaned.overlaps == 2


def test_ten_thousand_copies_of_a_line_are_dropped() -> None:
    drawing = listed(dxf(*([line((0, 0), (10, 0))] * 10_000)))
    assert (len(drawing.contours), drawing.cleaned.duplicates) == (1, 9_999)


@pytest.mark.parametrize(("begin", "end"), [(4.0, 9.996), (0.004, 6.0), (9.996, 4.0), (6.0, 0.004)])
def test_a_line_on_a_longer_one_leaves_the_ends_of_the_longer_one(begin: float, end: float) -> None:
    drawing = listed(dxf(line((0, 0), (10, 0)), line((begin, 0), (end, 0))))
    (piece,) = drawing.contours[0].pieces
    assert (drawing.cleaned.overlaps, sorted([piece.start, piece.end])) == (1, [(0.0, 0.0), (10.0, 0.0)])


def test_two_contours_may_share_part_of_a_wall() -> None:
    inner = [line((2, 0), (8, 0)), line((8, 0), (8, 5)), line((8, 5), (2, 5)), line((2, 5), (2, 0))]
    drawing = listed(dxf(*square(0, 0, 10), *inner))
    assert [contour.drawn for contour in drawing.contours if contour.closed] == [4, 4]
    assert drawing.cleaned.overlaps == 0


def rectangle(x: float, y: float) -> list[tuple[int, object]]:
    """A closed polyline 40 wide and 30 high."""
    return polyline((x, y), (x + 40, y), (x + 40, y + 30), (x, y + 30))


@pytest.mark.parametrize(("columns", "rows"), [(1, 2), (2, 1), (3, 3)])
def test_closed_polylines_that_share_edges_stay_closed(columns: int, rows: int) -> None:
    cells = [rectangle(40 * column, 30 * row) for column in range(columns) for row in range(rows)]
    for entities in (cells, cells[::-1], [*cells, cells[0], line((0, 0), (40, 0))]):
        drawing = listed(dxf(*entities))
        assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4)] * (columns * rows)
        assert drawing.branches == ()
        assert drawing.cleaned.duplicates == (0 if len(entities) == len(cells) else 5)


@pytest.mark.parametrize(
    "corners",
    [
        # three that touch in a ring, two that cross at both tips, two of which one ends where the other bends
        (((0, 0), (10, 0), (5, -3)), ((10, 0), (5, 8), (9, 8)), ((5, 8), (0, 0), (1, 8))),
        (((0, 0), (20, 0), (10, 15)), ((0, 0), (10, -15), (20, 0), (10, -5))),
        (((0, 0), (10, 0), (10, 10)), ((10, 0), (20, 0), (10, 10), (14, 5))),
    ],
)
def test_closed_polylines_that_touch_at_corners_stay_apart(
    corners: tuple[tuple[tuple[float, float], ...], ...],
) -> None:
    drawing = listed(dxf(*(polyline(*points) for points in corners)))
    assert [contour.closed for contour in drawing.contours] == [True] * len(corners)
    areas = sorted(shapely.Polygon(points).area for points in corners)
    assert sorted(contour.area for contour in drawing.contours) == pytest.approx(areas)


@pytest.mark.parametrize(("columns", "rows"), [(1, 2), (3, 1), (3, 3)])
@pytest.mark.parametrize("times", [1, 2])
def test_outlines_of_lines_that_share_edges_stay_closed(columns: int, rows: int, times: int) -> None:
    entities = [side for x in range(columns) for y in range(rows) for side in square(10 * x, 10 * y, 10)] * times
    random.Random(columns).shuffle(entities)
    drawing = listed(dxf(*entities))
    assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4)] * (columns * rows)
    inner = (columns - 1) * rows + columns * (rows - 1)
    assert (drawing.cleaned.shared, drawing.cleaned.duplicates) == (inner, len(entities) * (times - 1) // times)


def test_outlines_of_arcs_and_lines_share_an_arc() -> None:
    half = arc((0, 0), 10, 0, 180)
    above = [line((10, 0), (10, 20)), line((10, 20), (-10, 20)), line((-10, 20), (-10, 0)), half]
    drawing = listed(dxf(*above, line((-10, 0), (10, 0)), half))
    areas = [contour.area for contour in drawing.contours if contour.closed]
    assert areas == pytest.approx([400 - 50 * math.pi, 50 * math.pi])


def test_a_line_outline_keeps_its_edge_on_a_closed_polyline() -> None:
    drawing = listed(dxf(rectangle(0, 0), *square(40, 0, 30)))
    assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4)] * 2
    assert (drawing.cleaned.shared, drawing.cleaned.duplicates) == (1, 0)
    lines = [line(a, b) for a, b in itertools.pairwise([(0, 0), (40, 0), (40, 30), (0, 30), (0, 0)])]
    drawing = listed(dxf(rectangle(0, 0), *lines))
    assert (len(drawing.contours), drawing.cleaned.shared, drawing.cleaned.duplicates) == (1, 0, 4)


@pytest.mark.parametrize(
    ("corners", "area"),
    [
        ([(0.005, 0.005), (6, 0.005), (6, 9.995), (0.005, 9.995)], 59.890),
        ([(0.005, 0.005), (9, 2), (9, 8), (0.005, 9.995)], 71.915),
    ],
)
def test_a_contour_keeps_the_edge_that_runs_near_another_contour(
    corners: list[tuple[float, float]], area: float
) -> None:
    inner = [line(start, end) for start, end in itertools.pairwise([*corners, corners[0]])]
    drawing = listed(dxf(*square(0, 0, 10), *inner))
    assert [contour.area for contour in drawing.contours] == pytest.approx([100.0, area], abs=1e-3)
    assert (drawing.cleaned.duplicates, drawing.cleaned.largest_difference[0]) == (0, 0.0)


@pytest.mark.parametrize(
    ("copy", "count"), [(square(0.003, 0.004, 10), 4), ([line((0.003, 0.004), (10.003, 0.004))], 1)]
)
def test_a_copy_near_its_original_is_dropped(copy: list[list[tuple[int, object]]], count: int) -> None:
    drawing = listed(dxf(*square(0, 0, 10), *copy))
    assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4)]
    assert (drawing.cleaned.duplicates, drawing.cleaned.largest_difference[0]) == pytest.approx((count, 0.005))


def test_a_doubled_drawing_keeps_its_dividing_line() -> None:
    drawing = listed(dxf(*([*square(0, 0, 10), line((0, 0), (10, 10))] * 2)))
    assert [(contour.closed, contour.drawn) for contour in drawing.contours] == [(True, 4), (False, 1)]
    assert (drawing.cleaned.shared, drawing.cleaned.duplicates) == (0, 5)


def test_an_inserted_block_beside_itself_shares_an_edge() -> None:
    at = [[(0, "INSERT"), (8, "0"), (2, "B"), (10, x), (20, 0), (30, 0)] for x in (0, 40)]
    drawing = listed(dxf(*at, more=block("B", rectangle(0, 0))))
    assert [contour.closed for contour in drawing.contours] == [True, True]


def test_a_polyline_out_and_back_is_one_line() -> None:
    drawing = listed(dxf(polyline((0, 0), (10, 0)), rectangle(0, 0)))
    assert (drawing.cleaned.duplicates, [contour.closed for contour in drawing.contours]) == (1, [True])


def test_a_curve_of_pieces_shorter_than_the_tolerance_is_kept() -> None:
    drawing = listed(circle_of_lines(400, 0.5))
    assert (drawing.cleaned.tiny, [contour.drawn for contour in drawing.contours]) == (0, [400])
    assert listed(circle_of_lines(3000), tolerance=2.0).contours[0].drawn == 3000


def test_a_point_within_a_curve_of_short_pieces_is_dropped() -> None:
    # as in drawings of letters: lines shorter than the tolerance with a zero-length line between them
    corners = [(0.0, 0.0), (0.004, 0.0), (0.008, 0.001), (0.012, 0.004), (5.0, 0.0), (0.0, 5.0), (0.0, 0.0)]
    lines = [line(start, end) for start, end in itertools.pairwise(corners)]
    result = listed(dxf(*lines, line(corners[2], corners[2])))
    assert (len(result.contours), result.cleaned.tiny) == (1, 1)
    assert result.contours[0].closed


@pytest.mark.parametrize("sliver", [0.00009, 0.00002])
def test_a_sliver_within_a_curve_of_short_pieces_is_dropped(sliver: float) -> None:
    corners = [(0.009 * k, 0.0) for k in range(4)]
    corners += [(0.027, sliver), *((0.027 + 0.009 * k, sliver) for k in range(1, 4)), (5.0, 0.0), (0.0, 5.0)]
    result = listed(dxf(*(line(start, end) for start, end in itertools.pairwise([*corners, corners[0]]))))
    assert (result.cleaned.tiny, result.branches) == (1, ())
    assert [(contour.closed, contour.drawn) for contour in result.contours] == [(True, 9)]


def test_the_start_is_the_middle_of_the_longest_line() -> None:
    entities = [line((0, 0), (30, 0)), line((30, 0), (30, 10)), line((30, 10), (0, 10)), line((0, 10), (0, 0))]
    contour = listed(dxf(*entities)).contours[0]
    assert contour.start == pytest.approx((15.0, 0.0))
    assert (contour.drawn, len(contour.pieces)) == (4, 5)


def test_the_start_can_be_moved_to_corners_sides_and_typed_places() -> None:
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


SLOT = [line((0, -5), (20, -5)), arc((20, 0), 5, -90, 90), line((20, 5), (0, 5)), arc((0, 0), 5, 90, 270)]
"""Traveled clockwise from (10, -5), the middle of the lower line."""


@pytest.mark.parametrize(
    ("first", "corners", "sides"),
    [
        # from the middle of a line, from a corner, from the middle of an arc: steps -2, -1, 1, 2
        ((10, -9), [(20, 5), (20, -5), (0, -5), (0, 5)], [(10, 5), (25, 0), (-5, 0), (10, 5)]),
        ((0, -9), [(20, 5), (20, -5), (0, 5), (20, 5)], [(25, 0), (10, -5), (-5, 0), (10, 5)]),
        ((-9, 0), [(20, -5), (0, -5), (0, 5), (20, 5)], [(25, 0), (10, -5), (10, 5), (25, 0)]),
    ],
)
def test_the_start_of_a_slot_moves_from_corner_to_corner_and_from_side_to_side(
    first: tuple[float, float], corners: list[tuple[float, float]], sides: list[tuple[float, float]]
) -> None:
    contour = started_at(listed(dxf(*SLOT)).contours[0], first)
    assert len(contour.pieces) == (4 if first == (0, -9) else 5)
    for move, starts, count in ((started_at_corner, corners, 4), (started_at_side, sides, 5)):
        moved = [move(contour, step) for step in (-2, -1, 1, 2)]
        assert [each.start for each in moved] == [pytest.approx(start) for start in starts]
        assert {(len(each.pieces), round(each.length, 9), each.turn) for each in moved} == {
            (count, round(40 + 10 * math.pi, 9), Turn.CW)
        }


def test_a_circle_starts_at_its_quarters_and_nearest_to_a_place() -> None:
    contour = listed(dxf(circle((3, 4), 5))).contours[0]
    starts = [started_at_side(contour, step).start for step in (0, 1, 2, -1)]
    assert starts == [pytest.approx(point) for point in [(-2, 4), (3, 9), (8, 4), (3, -1)]]
    assert started_at(contour, (3, 20)).start == pytest.approx((3, 9))
    assert started_at_corner(contour, 1) is contour


def test_an_open_contour_starts_at_the_nearer_of_its_ends_only() -> None:
    contour = listed(dxf(line((0, 0), (10, 0)), line((10, 0), (10, 5)))).contours[0]
    assert [started_at(contour, place).start for place in ((4, 0), (9, 1))] == [(0.0, 0.0), (10.0, 5.0)]
    assert started_at_corner(contour, 1) is started_at_side(contour, 1) is contour
    assert (contour.turn, contour.side, contour.area) == (Turn.NONE, None, 0.0)


@pytest.mark.parametrize("place", [(10.0, -5.0), (0.0, 5.0), (20.0, 1.0)])
@pytest.mark.parametrize("turned", [False, True])
def test_a_contour_made_again_is_traveled_in_the_same_direction(place: tuple[float, float], turned: bool) -> None:
    contour = listed(dxf(*SLOT)).contours[0]
    before = started_at(reversed_contour(contour) if turned else contour, place)
    again = traveled_like(contour, before)
    assert again.turn is before.turn
    assert same(again.pieces, before.pieces)


def test_an_arc_whose_ends_are_within_the_tolerance_is_a_circle() -> None:
    (contour,) = listed(dxf(arc((1, 2), 10, 0, 359.97))).contours
    assert contour.circle == pytest.approx(10.0)
    assert contour.gap == pytest.approx(10.0 * math.radians(0.03), rel=1e-6)


def test_equal_circles_fold_into_one_row() -> None:
    drawing = listed(dxf(*square(0, 0, 50), *(circle((10 + 5 * k, 10), 1) for k in range(6)), circle((10, 40), 2)))
    rows = rows_of(drawing.contours)
    assert [len(row) for row in rows] == [1, 1, 6]
    assert len(drawing.contours) == 8
    assert len(matching(drawing.contours, "hole", Unit.MM)) == 7


def test_fitting_keeps_corners() -> None:
    data = dxf(*square(0, 0, 10))
    assert fitted_contour(listed(data).contours[0], 0.005).drawn == 4


def test_a_circle_of_72_lines_becomes_a_circle() -> None:
    """Its corners turn by 5 degrees each, a bit more or less where the coordinates are rounded."""
    turns = [math.radians(degrees) for degrees in range(0, 365, 5)]
    points = [(round(120.0 + 20.0 * math.cos(turn), 4), round(30.0 + 20.0 * math.sin(turn), 4)) for turn in turns]
    data = dxf(*(line(*pair) for pair in itertools.pairwise(points)))
    assert fitted_contour(listed(data).contours[0], 0.02).drawn == 1


def test_a_sampled_notch_becomes_one_arc() -> None:
    # a 20 by 10 plate with a half circle of radius 4 cut out of its top edge, sampled by 100 lines
    notch = [(10 + 4 * math.cos(math.pi * k / 100), 10 - 4 * math.sin(math.pi * k / 100)) for k in range(101)]
    points = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), *notch, (0.0, 10.0), (0.0, 0.0)]
    contour = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours[0]
    fitted = fitted_contour(contour, 0.005)
    (arc,) = (piece for piece in fitted.pieces if isinstance(piece, Arc))
    assert fitted.drawn == 6
    assert arc.center == pytest.approx((10.0, 10.0), abs=0.005)
    assert arc.radius == pytest.approx(4.0, abs=0.005)


def test_no_line_is_farther_from_its_arc_than_fit() -> None:
    """The point of a line that is farthest from the arc is not its midpoint."""
    fitted_count = 0
    for seed in range(100):
        corners, at, turn = [(0.0, 0.0)], 0j, math.radians(3.4 + 0.004 * seed)
        for row in range(4):
            at += (60.0 if row == 3 else 1.0) * complex(math.cos(row * turn), math.sin(row * turn))
            corners.append((at.real, at.imag))
        ends = itertools.pairwise(corners)
        fitted = fitted_contour(listed(dxf(*(line(*pair) for pair in ends))).contours[0], 0.005)
        path = shapely.LineString(chords_of(Path.from_pieces(fitted.pieces), 1e-6))
        off = shapely.hausdorff_distance(path, shapely.LineString(corners), densify=0.02)
        assert off < 0.00501, seed
        fitted_count += any(isinstance(piece, Arc) for piece in fitted.pieces)
    assert 20 < fitted_count < 100


@pytest.mark.parametrize("chords", range(3, 18))
def test_as_many_chords_as_lie_on_one_circle_become_its_arc(chords: int) -> None:
    """A line of another length follows, in the direction of the circle at its end."""
    turned = [math.radians(4.0 * row) for row in range(chords + 1)]
    ends = [(10.0 * math.sin(angle), 10.0 - 10.0 * math.cos(angle)) for angle in turned]
    ends.append((ends[-1][0] + 20.0 * math.cos(turned[-1]), ends[-1][1] + 20.0 * math.sin(turned[-1])))
    (contour,) = listed(dxf(*(line(start, end) for start, end in itertools.pairwise(ends)))).contours
    bend, straight = sorted(fitted_contour(contour, 0.01).pieces, key=lambda piece: piece.length)
    assert isinstance(bend, Arc)
    assert bend.length == pytest.approx(10.0 * turned[-1], rel=1e-3)
    assert isinstance(straight, Line)
    assert straight.length == pytest.approx(20.0, abs=1e-3)


def test_a_side_that_wavers_by_less_than_fit_becomes_one_line() -> None:
    # the lower side of a square of 20 with a point every 0.4, those near its ends off by half of FIT
    lower = [(0.4 * k, 0.0025 if k in (1, 2, 48, 49) else 0.0) for k in range(51)]
    points = [*lower, (20.0, 20.0), (0.0, 20.0), (0.0, 0.0)]
    contour = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours[0]
    fitted = fitted_contour(contour, 0.005)
    assert fitted.drawn == 4
    assert all(isinstance(piece, Line) for piece in fitted.pieces)


def test_a_sampled_slot_becomes_lines_and_arcs_again() -> None:
    # a slot of two lines and two half circles, each sampled by 200 lines
    ends = [(20 + 5 * math.sin(math.pi * k / 200), -5 * math.cos(math.pi * k / 200)) for k in range(201)]
    other = [(-5 * math.sin(math.pi * k / 200), 5 * math.cos(math.pi * k / 200)) for k in range(201)]
    points = [*ends, *other, ends[0]]
    contour = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours[0]
    fitted = fitted_contour(contour, 0.005)
    assert fitted.fitted is not None
    assert fitted.fitted.before == 402
    assert fitted.drawn <= 6
    assert fitted.fitted.deviation <= 0.005
    assert fitted.area == pytest.approx(20 * 10 + math.pi * 25, abs=0.2)
    assert any(isinstance(piece, Line) for piece in fitted.pieces)


def test_fitting_leaves_drawn_arcs_between_the_runs_of_lines() -> None:
    # the slot with an ARC at each end and twenty lines along each side
    sides = [[(x, y) for x in range(21)] for y in (-5, 5)]
    entities = [arc((20, 0), 5, -90, 90), arc((0, 0), 5, 90, 270)]
    entities += [line(p, q) for side in sides for p, q in itertools.pairwise(side)]
    fitted = fitted_contour(listed(dxf(*entities)).contours[0], 0.005)
    assert [piece.end for piece in fitted.pieces] == [piece.start for piece in (*fitted.pieces[1:], fitted.pieces[0])]
    assert fitted.drawn == 4
    assert fitted.area == pytest.approx(20 * 10 + math.pi * 25)


@pytest.mark.parametrize("angle", [100.0, 180.0, 235.0])
def test_a_contour_starts_on_its_arc_where_that_is_nearest_to_a_place(angle: float) -> None:
    slot = [line((0, -5), (20, -5)), arc((20, 0), 5, -90, 90), line((20, 5), (0, 5)), arc((0, 0), 5, 90, 270)]
    contour = listed(dxf(*slot)).contours[0]
    x, y = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    for start in (contour, reversed_contour(contour)):
        assert started_at(start, (9.0 * x, 9.0 * y)).start == pytest.approx((5.0 * x, 5.0 * y))


@pytest.mark.parametrize("side", [CutterComp.LEFT, CutterComp.RIGHT, CutterComp.ON, None])
def test_the_side_that_is_answered_is_that_of_open_contours_only(side: CutterComp | None) -> None:
    closed, opened = listed(dxf(*square(0, 0, 10), line((20, 0), (30, 0)), line((30, 0), (30, 5)))).contours
    hole = reversed_contour(closed)
    program, made = with_contours(Program(unit=Unit.MM), [closed, hole, opened], side)
    wanted = [CutterComp.LEFT, CutterComp.RIGHT, side or CutterComp.ON]
    assert [block.cutter_comp for block in program.blocks] == wanted
    asked = ("Chain 2 is open: choose CUTTER COMP. on START.",)
    assert [item.notes for item in made] == [(), (), asked if side is None else ()]


def test_a_number_that_rounds_to_0_is_written_without_a_sign() -> None:
    contour = listed(dxf(*square(-1e-5, -1e-5, 10))).contours[0]
    _, (item,) = with_contours(Program(unit=Unit.MM), [contour])
    ends = [(segment.x_end, segment.y_end) for segment in item.block.segments if isinstance(segment, LineSegment)]
    written = {str(number.value) for end in ends for number in end if isinstance(number, Number)}
    assert written == {"0.0", "5.0", "10.0"}


@pytest.mark.parametrize("center", [(0.0, 0.0), (35.0, -12.0)])
@pytest.mark.parametrize("turned", [False, True])
def test_a_circle_of_many_lines_becomes_a_circle_wherever_it_lies(center: tuple[float, float], turned: bool) -> None:
    angles = [math.tau * k / 360 for k in range(361)]
    points = [(center[0] + 20 * math.cos(angle), center[1] + 20 * math.sin(angle)) for angle in angles]
    (contour,) = listed(dxf(*(line(p, q) for p, q in itertools.pairwise(points)))).contours
    (piece,) = fitted_contour(reversed_contour(contour) if turned else contour, 0.005).pieces
    assert isinstance(piece, Arc)
    assert piece.center == pytest.approx(center, abs=1e-6)
    assert piece.radius == pytest.approx(20.0, abs=1e-6)
    assert piece.turn is (Turn.CCW if turned else Turn.CW)


@pytest.mark.parametrize("turns", [(1, 1), (1, -1), (-1, 1), (-1, -1)])
@pytest.mark.parametrize(
    ("first", "second", "loose"),
    [((0, 90), (60, 150), (150, 0)), ((60, 150), (0, 90), (150, 0)), ((0, 150), (30, 90), (150, 0))],
)
def test_arcs_that_overlap_keep_what_continues_at_their_ends(
    turns: tuple[int, int], first: tuple[int, int], second: tuple[int, int], loose: tuple[int, int]
) -> None:
    """The arc from 0 to 150 degrees and a line away from each of its ends are one open contour."""

    def at(angle: float, radius: float = 10.0) -> tuple[float, float]:
        return radius * math.cos(math.radians(angle)), radius * math.sin(math.radians(angle))

    def piece(angles: tuple[int, int], turn: int) -> Arc:
        begin, end = angles[::turn]
        return Arc(at(begin), at(end), (0.0, 0.0), Turn(turn))

    arcs = [LayeredPiece(piece(angles, turn), "0") for angles, turn in zip((first, second), turns, strict=True)]
    lines = [LayeredPiece(Line(at(angle), at(angle, 15.0)), "0") for angle in loose]
    cleaned = clean_up([*arcs, *lines], 0.01)
    assert (cleaned.overlaps, len(cleaned.pieces)) == (1, 3)
    (joined,) = (item.piece for item in cleaned.pieces if isinstance(item.piece, Arc))
    assert abs(joined.sweep) == pytest.approx(math.radians(150))


def test_a_thousand_rings_in_one_another_are_listed_from_the_outermost_in() -> None:
    # more than Python's calls may be nested
    rings = 1010
    contours = listed(dxf(*(circle((0.0, 0.0), 1.0 + 0.5 * ring) for ring in range(rings)))).contours
    assert [contour.depth for contour in contours] == list(range(rings))
    assert [contour.inside for contour in contours] == list(range(rings))
