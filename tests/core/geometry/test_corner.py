"""Blends of two pieces: hand calculations, and properties of all pairs of lines and arcs."""

from __future__ import annotations

from math import cos, dist, pi, sin, sqrt, tau

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.geometry.corner import Corner, NoCorner, Reason, chamfer, fillet
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from tests.properties import exercised, must_exercise


def near(first: Point, second: Point, tolerance: float = 1e-9) -> bool:
    return dist(first, second) <= tolerance


def blended(before: Piece, after: Piece, radius: float) -> Corner:
    result = fillet(before, after, radius)
    assert isinstance(result, Corner)
    return result


def largest_of(before: Piece, after: Piece) -> float | None:
    refused = fillet(before, after, 1e4)
    assert isinstance(refused, NoCorner)
    assert refused.reason is Reason.TOO_LARGE
    return refused.largest


def test_a_square_corner_is_blended():
    result = blended(Line((0.0, 0.0), (10.0, 0.0)), Line((10.0, 0.0), (10.0, 10.0)), 2.0)
    assert result.before == Line((0.0, 0.0), (8.0, 0.0))
    assert near(result.between.center, (8.0, 2.0))
    assert result.between.turn is Turn.CCW
    assert result.after == Line((10.0, 2.0), (10.0, 10.0))


def test_a_corner_to_the_right_is_blended_clockwise():
    result = blended(Line((0.0, 0.0), (10.0, 0.0)), Line((10.0, 0.0), (10.0, -10.0)), 2.0)
    assert near(result.between.center, (8.0, -2.0))
    assert result.between.turn is Turn.CW


def test_a_blend_may_use_a_whole_line():
    result = blended(Line((0.0, 0.0), (2.0, 0.0)), Line((2.0, 0.0), (2.0, 10.0)), 2.0)
    assert result.before is None
    assert near(result.between.start, (0.0, 0.0))


def test_a_radius_that_does_not_fit_gives_the_largest_that_fits():
    short, long = Line((0.0, 0.0), (2.0, 0.0)), Line((2.0, 0.0), (2.0, 10.0))
    assert largest_of(short, long) == pytest.approx(2.0)
    sharp = Line((2.0, 0.0), (0.0, 2.0))
    largest = sqrt(2) - 1
    assert largest_of(short, sharp) == pytest.approx(2.0 * largest)
    assert isinstance(fillet(short, long, 2.1), NoCorner)
    assert isinstance(fillet(short, sharp, 2.0 * largest - 1e-6), Corner)


def test_tangent_pieces_and_reversals_are_not_blended():
    line = Line((0.0, 0.0), (2.0, 0.0))
    assert fillet(line, Line((2.0, 0.0), (5.0, 0.0)), 1.0) == NoCorner(Reason.TANGENT)
    assert fillet(line, Arc((2.0, 0.0), (3.0, 1.0), (2.0, 1.0), Turn.CCW), 1.0) == NoCorner(Reason.TANGENT)
    assert fillet(line, Line((2.0, 0.0), (0.0, 0.0)), 1.0) == NoCorner(Reason.REVERSAL)


def test_a_line_and_an_arc_are_blended():
    """A line along X meets a circle of radius 5 about (5, 0) at (0, 0): the blend of radius 1 is at (h, 1)."""
    before = Line((-10.0, 0.0), (0.0, 0.0))
    after = Arc((0.0, 0.0), (5.0, 5.0), (5.0, 0.0), Turn.CW)
    result = blended(before, after, 1.0)
    assert result.between.turn is Turn.CCW
    assert near(result.between.center, (5.0 - sqrt(35.0), 1.0))
    assert near(result.between.start, (5.0 - sqrt(35.0), 0.0))
    assert dist(result.between.end, (5.0, 0.0)) == pytest.approx(5.0)


def test_two_arcs_are_blended():
    """Two half circles of radius 3 meet at a cusp; the blend of radius 1 is above it."""
    before = Arc((-6.0, 0.0), (0.0, 0.0), (-3.0, 0.0), Turn.CW)
    after = Arc((0.0, 0.0), (6.0, 0.0), (3.0, 0.0), Turn.CW)
    result = blended(before, after, 1.0)
    assert near(result.between.center, (0.0, sqrt(7.0)))
    assert result.between.turn is Turn.CCW
    assert near(result.between.start, (-0.75, sqrt(7.0) * 0.75))


def test_an_arc_too_short_for_the_radius_is_refused():
    before = Line((-10.0, 0.0), (0.0, 0.0))
    after = Arc((0.0, 0.0), (0.1, 1.0), (5.0, 0.0), Turn.CW)
    refused = fillet(before, after, 3.0)
    assert isinstance(refused, NoCorner)
    assert refused.reason is Reason.TOO_LARGE
    assert refused.largest is not None
    assert isinstance(fillet(before, after, refused.largest), Corner)
    assert isinstance(fillet(before, after, refused.largest + 1e-6), NoCorner)


def piece_from(corner: Point, heading: float, length: float, bend: float) -> Piece:
    """A piece that starts at a corner: a line, or an arc that turns by `bend`."""
    if abs(bend) < 0.1:
        return Line(corner, (corner[0] + length * cos(heading), corner[1] + length * sin(heading)))
    radius, turn = length / abs(bend), Turn.CCW if bend > 0 else Turn.CW
    center = (corner[0] - turn * radius * sin(heading), corner[1] + turn * radius * cos(heading))
    out = heading + bend
    return Arc(corner, (center[0] + turn * radius * sin(out), center[1] - turn * radius * cos(out)), center, turn)


def back(piece: Piece) -> Piece:
    if isinstance(piece, Line):
        return Line(piece.end, piece.start)
    return Arc(piece.end, piece.start, piece.center, Turn(-piece.turn))


pieces = st.tuples(st.floats(0, tau), st.floats(2, 30), st.floats(-3.0, 3.0))


@settings(derandomize=True, max_examples=150)
@given(pieces, pieces, st.floats(0.05, 3.0))
def test_a_blend_is_tangent_to_both_pieces_and_within_them(first, second, radius):
    before, after = back(piece_from((1.0, 2.0), *first)), piece_from((1.0, 2.0), *second)
    result = fillet(before, after, radius)
    assume(isinstance(result, Corner))
    assert isinstance(result, Corner)
    arc = result.between
    assert arc.radius == pytest.approx(radius, abs=1e-7)
    assert dist(arc.end, arc.center) == pytest.approx(radius, abs=1e-7)
    for piece, point, left in ((before, arc.start, result.before), (after, arc.end, result.after)):
        assert near(piece.direction_at(point), arc.direction_at(point), 1e-6)
        assert (left.length if left else 0.0) <= piece.length + 1e-7
    if result.before:
        assert (result.before.start, result.before.end) == (before.start, arc.start)
    if result.after:
        assert (result.after.start, result.after.end) == (arc.end, after.end)


@must_exercise(0.2)
@settings(derandomize=True, max_examples=100)
@given(pieces, pieces, st.floats(0.05, 3.0))
def test_a_reversed_corner_has_the_same_blend(first, second, radius):
    before, after = back(piece_from((0.0, 0.0), *first)), piece_from((0.0, 0.0), *second)
    forward, backward = fillet(before, after, radius), fillet(back(after), back(before), radius)
    assert type(forward) is type(backward)
    if isinstance(forward, Corner) and isinstance(backward, Corner):
        exercised()
        assert near(forward.between.center, backward.between.center, 1e-6)
        assert forward.between.turn == -backward.between.turn


@settings(derandomize=True, max_examples=100)
@given(st.floats(0.2, pi - 0.2), st.floats(5, 20), st.floats(5, 20))
def test_the_largest_radius_of_a_corner_fits(corner, before_length, after_length):
    before, after = Line((-before_length, 0.0), (0.0, 0.0)), piece_from((0.0, 0.0), corner, after_length, 0.0)
    largest = largest_of(before, after)
    assert largest is not None
    assert isinstance(fillet(before, after, largest * (1 - 1e-9)), Corner)
    assert isinstance(fillet(before, after, largest * (1 + 1e-6)), NoCorner)


UP = Line((10.0, 0.0), (10.0, 10.0))
RIGHT = Line((0.0, 0.0), (10.0, 0.0))
QUARTER = Arc((10.0, 0.0), (20.0, 10.0), (10.0, 10.0), Turn.CCW)
"""A quarter circle that leaves (10, 0) to the right, radius 10."""


@pytest.mark.parametrize(
    ("before", "after", "length", "between"),
    [
        (RIGHT, UP, 2.0, Line((8.0, 0.0), (10.0, 2.0))),
        (Line((0.0, 0.0), (2.0, 0.0)), Line((2.0, 0.0), (2.0, 10.0)), 2.0, Line((0.0, 0.0), (2.0, 2.0))),
        # 6 along the tangent of a circle of 10: 8 is left to its center
        (Line((10.0, -10.0), (10.0, 0.0)), QUARTER, 6.0, Line((10.0, -6.0), (16.0, 2.0))),
        (Line((10.0, -10.0), (10.0, 0.0)), QUARTER, 10.0, Line((10.0, -10.0), (20.0, 10.0))),
        (
            Arc((20.0, 10.0), (10.0, 0.0), (10.0, 10.0), Turn.CW),
            Line((10.0, 0.0), (10.0, -10.0)),
            6.0,
            Line((16.0, 2.0), (10.0, -6.0)),
        ),
    ],
)
def test_a_chamfer_takes_its_length_off_both_pieces(before: Piece, after: Piece, length: float, between: Line) -> None:
    corner = chamfer(before, after, length)
    assert isinstance(corner, Corner)
    assert isinstance(corner.between, Line)
    assert near(corner.between.start, between.start)
    assert near(corner.between.end, between.end)
    ends = (None if corner.before is None else corner.before.end, None if corner.after is None else corner.after.start)
    whole = (near(between.start, before.start), near(between.end, after.end))
    assert ends == (None if whole[0] else corner.between.start, None if whole[1] else corner.between.end)


@pytest.mark.parametrize(
    ("before", "after", "length", "refusal"),
    [
        (RIGHT, Line((10.0, 0.0), (20.0, 0.0)), 1.0, NoCorner(Reason.TANGENT)),
        (RIGHT, Line((10.0, 0.0), (0.0, 0.0)), 1.0, NoCorner(Reason.REVERSAL)),
        (RIGHT, Line((10.0, 0.0), (10.0, 3.0)), 3.1, NoCorner(Reason.TOO_LARGE, 3.0)),
        # an arc takes no more than its radius, and no more than its end is away along the tangent
        (Line((10.0, -20.0), (10.0, 0.0)), QUARTER, 10.1, NoCorner(Reason.TOO_LARGE, 10.0)),
        (
            Line((10.0, -20.0), (10.0, 0.0)),
            Arc((10.0, 0.0), (16.0, 2.0), (10.0, 10.0), Turn.CCW),
            6.1,
            NoCorner(Reason.TOO_LARGE, 6.0),
        ),
    ],
)
def test_a_chamfer_that_does_not_fit_says_why(before: Piece, after: Piece, length: float, refusal: NoCorner) -> None:
    found = chamfer(before, after, length)
    assert isinstance(found, NoCorner)
    assert found.reason is refusal.reason
    assert found.largest == (None if refusal.largest is None else pytest.approx(refusal.largest))
