"""Blend moves: quarter circles away from the material, and the overlap of closed contours."""

from __future__ import annotations

from math import cos, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import blend_in, blend_out, compensate, past_start
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests.core.comp.contours import lines, loose

ALONG_X = lines((0, 0), (4, 0))
MID_SIDE = lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))
CIRCLE = Path.from_pieces([Arc((2, 0), (2, 0), (0, 0), Turn.CCW)])


def _near(one, other) -> bool:
    return abs(complex(*one) - complex(*other)) < 1e-12


@pytest.mark.parametrize(("side", "up"), [(Side.LEFT, 1), (Side.RIGHT, -1)])
def test_blends_of_a_line(side, up):
    (arc,) = blend_in(ALONG_X, side, 0.5)
    assert arc == Arc((-0.5, 0.5 * up), (0, 0), (0, 0.5 * up), Turn(up))
    (arc,) = blend_out(ALONG_X, side, 0.5, 0.0, closed=False)
    assert arc == Arc((4, 0), (4.5, 0.5 * up), (4, 0.5 * up), Turn(up))


def test_blends_carry_the_numbers_of_their_neighbors():
    path = Path.from_pieces([*ALONG_X, Line((4, 0), (4, 1))], [2, 7])
    assert blend_in(path, Side.LEFT, 1).numbers.tolist() == [2]
    assert blend_out(path, Side.LEFT, 1, 0, closed=False).numbers.tolist() == [7]


def test_no_blend_and_no_path_are_nothing():
    assert blend_in(ALONG_X, Side.LEFT, 0.0) is EMPTY
    assert not len(blend_out(ALONG_X, Side.LEFT, 0.0, 0.0, closed=True))
    assert blend_in(EMPTY, Side.LEFT, 1.0) is EMPTY
    assert blend_out(EMPTY, Side.LEFT, 1.0, 1.0, closed=True) is EMPTY


@settings(max_examples=100, deadline=None, derandomize=True)
@given(loose, st.sampled_from(Side), st.floats(0.05, 3))
def test_blends_are_tangent_quarters(path, side, blend):
    coming, going = blend_in(path, side, blend), blend_out(path, side, blend, 1.0, closed=False)
    for arc in (coming, going):
        assert arc.lengths.tolist() == [pytest.approx(blend * pi / 2)]
        assert arc.turns.tolist() == [side.sign]
    assert _near(coming.points[-1], path.points[0])
    assert _near(going.points[0], path.points[-1])
    assert abs(coming.end_directions[0] - path.start_directions[0]).max() < 1e-9
    assert abs(going.start_directions[0] - path.end_directions[-1]).max() < 1e-9


def test_overlap_repeats_the_first_pieces():
    done = compensate(MID_SIDE, Side.LEFT, 0.25, 4, closed=True, blend=0.1, overlap=0.5)
    assert done.lead_out[0] == Line((1, 0.25), (1.5, 0.25))
    assert done.lead_out.numbers.tolist() == [1, 1]
    assert _near(done.lead_out.points[-1], (1.6, 0.35))


def test_overlap_goes_round_the_corner():
    done = compensate(MID_SIDE, Side.LEFT, 0.25, 4, closed=True, overlap=1.0)
    again = past_start(done.path, 1.0)
    assert again.numbers.tolist() == done.lead_out.numbers.tolist() == [1, 2]
    assert again.lengths.sum() == pytest.approx(1.0)
    assert _near(again.points[-1], (1.75, 0.5))


def test_overlap_of_exactly_one_piece_has_no_sliver_behind_it():
    assert past_start(compensate(MID_SIDE, Side.LEFT, 0.25, 4, closed=True).path, 0.75).numbers.tolist() == [1]


def test_overlap_is_at_most_a_lap():
    path = compensate(MID_SIDE, Side.LEFT, 0.25, 4, closed=True).path
    assert past_start(path, 1000.0).lengths.sum() == pytest.approx(path.lengths.sum())
    assert past_start(CIRCLE, 1000.0).lengths.tolist() == [pytest.approx(4 * pi)]


@pytest.mark.parametrize("turn", [Turn.CCW, Turn.CW])
def test_overlap_on_a_full_circle(turn):
    circle = Path.from_pieces([Arc((2, 0), (2, 0), (0, 0), turn)])
    again = past_start(circle, pi)
    assert again.sweeps.tolist() == [pytest.approx(turn * pi / 2)]
    assert _near(again.points[-1], (0, 2 * turn))


def test_no_overlap_where_the_path_ends_apart():
    square = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
    done = compensate(square, Side.RIGHT, 0.25, 3, closed=True, blend=0.1, overlap=0.5)
    assert done.lead_out.lengths.tolist() == [pytest.approx(0.05 * pi)]


def test_open_contour_has_no_overlap():
    done = compensate(MID_SIDE, Side.LEFT, 0.25, 4, closed=False, overlap=0.5)
    assert not len(done.lead_out)


def test_whole_is_blend_in_path_and_blend_out():
    done = compensate(MID_SIDE, Side.LEFT, 0.25, 4, closed=True, blend=0.1, overlap=0.5)
    assert done.with_leads.numbers.tolist() == [1, 1, 2, 3, 4, 5, 1, 1]
    assert (abs(done.with_leads.ends[:-1] - done.with_leads.starts[1:]) == 0).all()


@pytest.mark.parametrize("gap", [1e-6, 1e-4, 0.0025])
@pytest.mark.parametrize("turned", [0.0, 0.8])
def test_overlap_of_a_contour_that_counts_as_closed_though_its_ends_are_a_little_apart(gap, turned):
    last = (1 - gap * cos(turned), gap * sin(turned))
    nearly = lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), last)
    done = compensate(nearly, Side.LEFT, 0.25, 4, closed=True, blend=0.1, overlap=0.5)
    step, along, out = done.lead_out
    assert step.start == done.path[-1].end
    assert gap / 2 < step.length < 2 * gap
    assert along == Line((1, 0.25), (1.5, 0.25))
    assert _near(out.end, (1.6, 0.35))
    assert done.lead_out.numbers.tolist() == [1, 1, 1]


def test_overlap_over_a_gap_begins_an_arc_on_its_own_circle():
    ring = Path.from_pieces([Arc((2, 0), (-2, 0), (0, 0), Turn.CCW), Arc((-2, 0), (2, -0.001), (0, -0.0005), Turn.CCW)])
    done = compensate(ring, Side.LEFT, 0.25, 4, closed=True, overlap=1.0)
    assert [type(piece) for piece in done.lead_out] == [Line, Arc]
    assert done.lead_out[1].start == done.path[0].start
    assert done.lead_out[1].radius == pytest.approx(1.75, abs=1e-12)
