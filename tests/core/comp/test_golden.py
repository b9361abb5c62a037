"""The golden contours at every look-ahead from 1 to 20, with coordinates found by hand; radius 0.25 everywhere."""

from __future__ import annotations

from math import sqrt

import pytest

from core.comp.compensate import compensate, compensate_all
from core.comp.compensated import Compensated
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD, calculated
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests.core.comp.golden import (
    CHAMFER_AT_THE_SEAM,
    CHAMFER_FROM_MID_SIDE,
    HALF,
    INSIDE_FROM_A_CORNER,
    INSIDE_FROM_MID_SIDE,
    MISSED,
    NARROW_NOTCH,
    OUTSIDE_FROM_A_CORNER,
    OVERRUN_L,
    OVERRUN_SQUARE,
    RADIUS,
    SHORT_CHAMFER,
    SMALL_STEP,
    TRIANGLE,
    Expected,
)

NEAR = 1e-9

CASES = {
    "over-run square": OVERRUN_SQUARE,
    "over-run L": OVERRUN_L,
    "inside square from a corner": INSIDE_FROM_A_CORNER,
    "outside square from a corner": OUTSIDE_FROM_A_CORNER,
    "inside square from mid-side": INSIDE_FROM_MID_SIDE,
    "narrow notch": NARROW_NOTCH,
    "small step": SMALL_STEP,
    "short chamfer inside": SHORT_CHAMFER,
    "chamfer at the seam": CHAMFER_AT_THE_SEAM,
    "the same from mid-side": CHAMFER_FROM_MID_SIDE,
    "triangle from a corner": TRIANGLE,
}

every_case = pytest.mark.parametrize("golden", CASES.values(), ids=CASES.keys())
every_lookahead = pytest.mark.parametrize("lookahead", range(MIN_LOOKAHEAD, MAX_LOOKAHEAD + 1))


def _near(one, other) -> bool:
    return all(abs(a - b) <= NEAR for a, b in zip(one, other, strict=True))


def _check(done: Compensated, wanted: Expected) -> None:
    assert done.path.numbers.tolist() == wanted.numbers
    assert len(done.path.points) == len(wanted.points)
    for point, place in zip(done.path.points.tolist(), wanted.points, strict=True):
        assert _near(point, place)
    assert [one.segment for one in done.deleted] == list(wanted.deleted)
    assert all(one.by == wanted.by and _near(one.at, wanted.at) for one in done.deleted)
    assert {finding.code for finding in done.findings} == wanted.findings


@every_lookahead
@every_case
def test_golden_case_at_every_lookahead(golden, lookahead):
    done = compensate(golden.contour, golden.side, RADIUS, lookahead, closed=golden.closed)
    _check(done, [one for one in golden.expected if one.since <= lookahead][-1])


@every_case
def test_table_of_all_lookaheads_is_the_same(golden):
    values = range(MIN_LOOKAHEAD, MAX_LOOKAHEAD + 1)
    for value, done in zip(
        values, compensate_all(golden.contour, golden.side, RADIUS, values, closed=golden.closed), strict=True
    ):
        assert done.lookahead == value
        _check(done, [one for one in golden.expected if one.since <= value][-1])


@every_case
def test_calculated_lookahead(golden):
    assert calculated(len(golden.contour), closed=golden.closed) == golden.calculated


@every_case
def test_arcs_of_the_path_are_about_the_corners(golden):
    for done in compensate_all(golden.contour, golden.side, RADIUS, range(1, 21), closed=golden.closed):
        arcs = [
            (piece, number)
            for piece, number in zip(done.path, done.path.numbers, strict=True)
            if isinstance(piece, Arc)
        ]
        assert all(number % 1 == 0.5 for _, number in arcs)
        for piece, number in arcs:
            assert _near(piece.center, golden.contour.points[int(number)])
            assert piece.turn == (Turn.CW if golden.side is Side.LEFT else Turn.CCW)
            assert abs(piece.radius - RADIUS) <= NEAR


POCKET = Path.from_pieces(
    [
        Line((2, 0.25), (4, 0.25)),
        Arc((4, 0.25), (4.75, 1), (4, 1), Turn.CCW),
        Line((4.75, 1), (4.75, 3)),
        Arc((4.75, 3), (4.25, 3.5), (4.25, 3), Turn.CCW),
        Line((4.25, 3.5), (3, 3.5)),
        Line((3, 3.5), (2.5, 3)),
        Line((2.5, 3), (1, 3)),
        Arc((1, 3), (0.5, 3.5), (1, 3.5), Turn.CW),
        Line((0.5, 3.5), (0.25, 3.5)),
        Line((0.25, 3.5), (0.25, 0.25)),
        Line((0.25, 0.25), (2, 0.25)),
    ]
)
"""A pocket with a boss at the top left: the slot between boss and wall is narrower than the cutter."""
MEETING = (0.5, 3.5 - sqrt(0.75**2 - 0.5**2))
"""Arc 8 has radius 0.75 about (1, 3.5); wall 10 runs on x = 0.5.  y = 2.94098."""


def test_pocket_at_its_calculated_lookahead():
    assert calculated(len(POCKET), closed=True) == 8
    done = compensate(POCKET, Side.LEFT, RADIUS, 8, closed=True)
    assert [(one.segment, one.by) for one in done.deleted] == [(9, (8, 10))]
    assert _near(next(iter(done.deleted)).at, MEETING)
    assert done.path.numbers.tolist() == [1, 2, 3, 4, 5, 6, 6.5, 7, 8, 10, 11]
    by_hand = [(2, 0.5), (4, 0.5), (4.5, 1), (4.5, 3), (4.25, 3.25)]
    corner = (3 + HALF * 2 - 0.25, 3.25)
    rest = [corner, (2.5 + HALF, 3 - HALF), (2.5, 2.75), (1, 2.75), MEETING, (0.5, 0.5), (2, 0.5)]
    for point, place in zip(done.path.points.tolist(), [*by_hand, *rest], strict=True):
        assert _near(point, place)
    assert not done.findings


def test_pocket_without_reach_keeps_the_slot():
    done = compensate(POCKET, Side.LEFT, RADIUS, 1, closed=True)
    assert not len(done.deleted)
    assert [finding.code for finding in done.findings] == [MISSED]
    assert done.findings[0].segment == 9.5
