"""The walk agrees with the slow, obviously correct one."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.comp.compensated import Compensated
from core.geometry.path import Path
from core.geometry.piece import Arc, Side
from tests.core.comp.contours import lines, mixed, polygons, shut
from tests.core.comp.walked import Cut, Walk, walk

NEAR = 1e-9
radii = st.sampled_from([0.05, 0.1, 0.25, 0.25, 0.3, 0.5, 1.0]) | st.floats(0.03, 2.0)
lookaheads = st.integers(1, 20)


def _agree(contour: Path, side: Side, radius: float, lookahead: int, *, closed: bool) -> None:
    fast = compensate(contour, side, radius, lookahead, closed=closed)
    slow = walk(list(contour), side.sign, radius, lookahead, closed=closed)
    assert fast.path.numbers.tolist() == [cut.label for cut in slow.path]
    for piece, cut in zip(fast.path, slow.path, strict=True):
        _same_piece(piece, cut)
    _same_deletions(fast, slow)


def _same_piece(piece, cut: Cut) -> None:
    assert abs(complex(*piece.start) - cut.start) <= NEAR
    assert abs(complex(*piece.end) - cut.end) <= NEAR
    assert isinstance(piece, Arc) == (cut.turn != 0)
    if isinstance(piece, Arc):
        assert piece.turn == cut.turn
        assert abs(complex(*piece.center) - cut.center) <= NEAR
        assert abs(piece.length - (cut.high - cut.low)) <= NEAR


def _same_deletions(fast: Compensated, slow: Walk) -> None:
    told = sorted(slow.deleted, key=lambda one: one[0])
    assert [(one.segment, one.by) for one in fast.deleted] == [one[:2] for one in told]
    for one, (_, _, at) in zip(fast.deleted, told, strict=True):
        assert abs(complex(*one.at) - at) <= NEAR


@settings(max_examples=150, deadline=None, derandomize=True)
@given(polygons, st.sampled_from(Side), radii, lookaheads)
def test_open_polygons_are_walked_alike(contour, side, radius, lookahead):
    _agree(contour, side, radius, lookahead, closed=False)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed, st.sampled_from(Side), radii, lookaheads)
def test_open_contours_of_lines_and_arcs_are_walked_alike(contour, side, radius, lookahead):
    _agree(contour, side, radius, lookahead, closed=False)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed | polygons, st.sampled_from(Side), radii, lookaheads)
def test_closed_contours_are_walked_alike(contour, side, radius, lookahead):
    _agree(shut(contour), side, radius, lookahead, closed=True)


def test_a_segment_before_those_that_meet_first_goes_with_the_pair_that_spans_it():
    contour = lines((0, 0), (-2, -2), (-4, -2), (-1, 0), (-3, -1), (-5, -1), (-3, -3))
    _agree(contour, Side.LEFT, 0.5, 20, closed=False)
    deleted = compensate(contour, Side.LEFT, 0.5, 20, closed=False).deleted
    assert [(one.segment, one.by) for one in deleted] == [(3, (2, 6)), (4, (3, 5)), (5, (2, 6))]
