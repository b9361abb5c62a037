"""Properties of the center path: its distance from the contour, its order and its symmetries."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate, compensate_all
from core.comp.compensated import Compensated
from core.comp.crossings import crossings
from core.comp.offset import offset
from core.geometry.path import Floats, Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.tolerance import JOINED
from tests.core.comp.contours import lines, loose, mixed, polygons, shut

sides = st.sampled_from(Side)
radii = st.floats(0.05, 1.5)
lookaheads = st.integers(1, 20)
OTHER = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT}


def _off(piece: Piece, points: Floats) -> Floats:
    """The distance of points from the infinite line or full circle of a piece."""
    if isinstance(piece, Arc):
        return np.asarray(np.abs(np.hypot(*(points - piece.center).T) - piece.radius))
    along = np.subtract(piece.end, piece.start) / piece.length
    dx, dy = (points - piece.start).T
    return np.asarray(np.abs(along[0] * dy - along[1] * dx))


def _sampled(piece: Piece) -> Floats:
    """Points along a piece, including both ends."""
    shares = np.linspace(0.0, 1.0, 7)
    if isinstance(piece, Line):
        return piece.start + shares[:, None] * np.subtract(piece.end, piece.start)
    dx, dy = np.subtract(piece.start, piece.center)
    angle = np.arctan2(dy, dx) + shares * piece.sweep
    return piece.center + piece.radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed | polygons, sides, radii, lookaheads, st.booleans())
def test_every_piece_is_the_radius_away_from_its_segment(contour, side, radius, lookahead, closed):
    contour = shut(contour) if closed else contour
    done = compensate(contour, side, radius, lookahead, closed=closed)
    for piece, number, bridged in zip(done.path, done.path.numbers.tolist(), done.bridged.tolist(), strict=True):
        if bridged:
            continue
        if number % 1:
            away = np.hypot(*(_sampled(piece) - contour.points[int(number)]).T)
        else:
            away = _off(contour[int(number) - 1], _sampled(piece))
        assert np.abs(away - radius).max() < 2 * JOINED


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed | polygons, sides, radii, lookaheads, st.booleans())
def test_the_path_is_finite_and_in_order(contour, side, radius, lookahead, closed):
    contour = shut(contour) if closed else contour
    done = compensate(contour, side, radius, lookahead, closed=closed, blend=0.1, overlap=0.1)
    path, whole = done.path, done.with_leads
    assert np.isfinite(whole.points).all()
    assert len(path.points) == len(path) + 1 or not len(path)
    assert len(done.bridged) == len(path)
    assert (path.lengths > 0).all()
    assert (np.diff(path.numbers) > 0).all()
    assert not set(done.deleted.segments.tolist()) & set(path.numbers.tolist())
    arcs = path.turns != 0
    last = np.hypot(*(path.ends - path.centers).T)
    assert np.abs(last - path.radii)[arcs].max(initial=0.0) < 2 * JOINED


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed | polygons, sides, radii, st.booleans())
def test_lookaheads_calculated_together_equal_those_calculated_singly(contour, side, radius, closed):
    contour = shut(contour) if closed else contour
    for done in compensate_all(contour, side, radius, (7, 1, 2, 20), closed=closed, blend=0.1):
        alone = compensate(contour, side, radius, done.lookahead, closed=closed, blend=0.1)
        assert np.array_equal(done.path.numbers, alone.path.numbers)
        assert np.array_equal(done.with_leads.points, alone.with_leads.points)
        assert list(done.deleted) == list(alone.deleted)
        assert done.findings == alone.findings


def test_lookaheads_that_test_the_same_crossings_make_the_same_path():
    notch = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    every = compensate_all(notch, Side.LEFT, 0.25, range(1, 21), closed=False, blend=0.1)
    assert [one.lookahead for one in every] == list(range(1, 21))
    assert [one.tested for one in every] == [0, 0] + [1] * 18
    for one in every:
        alone = compensate(notch, Side.LEFT, 0.25, one.lookahead, closed=False, blend=0.1)
        assert np.array_equal(one.with_leads.points, alone.with_leads.points)
        assert list(one.deleted) == list(alone.deleted)


def _moved(path: Path, move: Callable[[Floats], Floats], *, mirrored: bool = False) -> Path:
    turns = -path.turns if mirrored else path.turns
    return Path.of(move(path.points), move(path.centers), turns, path.numbers)


def _same(one: Compensated, two: Compensated, move: Callable[[Floats], Floats], near: float) -> None:
    """Assert that `move` turns the first path into the second."""
    for before, after in ((one.raw, two.raw), (one.path, two.path)):
        assert before.numbers.tolist() == after.numbers.tolist()
        assert np.abs(move(before.points) - after.points).max(initial=0.0) < near
        assert np.abs(before.turns).tolist() == np.abs(after.turns).tolist()
    assert [(gone.segment, gone.by) for gone in one.deleted] == [(gone.segment, gone.by) for gone in two.deleted]
    assert one.bridged.tolist() == two.bridged.tolist()


def _findings_of(one: Compensated) -> list[tuple[str, float | None]]:
    return [(finding.code, finding.segment) for finding in one.findings]


@settings(max_examples=80, deadline=None, derandomize=True)
@given(mixed | polygons, sides, radii, lookaheads, st.booleans())
def test_a_mirrored_contour_gives_the_mirrored_path_on_the_other_side(contour, side, radius, lookahead, closed):
    def mirror(points: Floats) -> Floats:
        return np.asarray(points * np.array([1.0, -1.0]), np.float64)

    contour = shut(contour) if closed else contour
    one = compensate(contour, side, radius, lookahead, closed=closed)
    two = compensate(_moved(contour, mirror, mirrored=True), OTHER[side], radius, lookahead, closed=closed)
    _same(one, two, mirror, 1e-9)
    assert _findings_of(one) == _findings_of(two)
    assert one.path.turns.tolist() == (-two.path.turns).tolist()


@settings(max_examples=80, deadline=None, derandomize=True)
@given(loose, sides, radii, lookaheads, st.floats(0, 2 * pi))
def test_a_rotated_contour_gives_the_rotated_path(contour, side, radius, lookahead, angle):
    matrix = np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])

    def turn(points: Floats) -> Floats:
        return np.asarray(points @ matrix, np.float64)

    one = compensate(contour, side, radius, lookahead, closed=False)
    two = compensate(_moved(contour, turn), side, radius, lookahead, closed=False)
    _same(one, two, turn, 1e-7)
    assert _findings_of(one) == _findings_of(two)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(loose, sides, radii, lookaheads, st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)))
def test_a_contour_far_from_the_origin_gives_the_same_path_there(contour, side, radius, lookahead, by):
    def shift(points: Floats) -> Floats:
        return np.asarray(points + np.array(by), np.float64)

    one = compensate(contour, side, radius, lookahead, closed=False)
    two = compensate(_moved(contour, shift), side, radius, lookahead, closed=False)
    _same(one, two, shift, 1e-6)
    assert _findings_of(one) == _findings_of(two)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(loose, sides, radii, lookaheads, st.sampled_from([25.4, 1 / 25.4, 0.5, 1000.0]))
def test_a_scaled_contour_and_tool_give_the_scaled_path(contour, side, radius, lookahead, factor):
    def scale(points: Floats) -> Floats:
        return np.asarray(points * factor, np.float64)

    one = compensate(contour, side, radius, lookahead, closed=False)
    two = compensate(_moved(contour, scale), side, radius * factor, lookahead, closed=False)
    _same(one, two, scale, 1e-7 * factor)


def _one_way(contour: Path, side: Side, radius: float) -> bool:
    """Whether every inside corner has just one crossing, so that the order of pieces does not matter."""
    joints = crossings(offset(contour, side, radius), 1, closed=False).joints
    return len(np.unique(joints.b)) == len(joints)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(loose, sides, radii)
def test_a_reversed_contour_gives_the_reversed_path(contour, side, radius):
    one = compensate(contour, side, radius, 1, closed=False)
    two = compensate(contour.reversed(), OTHER[side], radius, 1, closed=False)
    assume(_one_way(contour, side, radius))
    assume(not len(one.deleted) and not len(two.deleted) and not one.bridged.any() and not two.bridged.any())
    assume(len(crossings(offset(contour, side, radius), 1, closed=False).others) == 0)
    assert np.abs(one.path.points[::-1] - two.path.points).max() < 1e-7
    assert one.path.turns.tolist() == (-two.path.turns[::-1]).tolist()


def test_the_offset_of_a_full_circle_is_a_full_circle():
    circle = Path.from_pieces([Arc((2, 0), (2, 0), (0, 0), Turn.CCW)])
    for side, radius in ((Side.LEFT, 1.75), (Side.RIGHT, 2.25)):
        done = compensate(circle, side, 0.25, 3, closed=True)
        assert list(done.path) == [Arc((radius, 0), (radius, 0), (0, 0), Turn.CCW)]
        assert not done.findings


def test_a_contour_of_one_line_gives_one_line():
    done = compensate(lines((0, 0), (4, 0)), Side.LEFT, 0.25, 2, closed=False)
    assert list(done.path) == [Line((0, 0.25), (4, 0.25))]


def test_the_path_around_a_small_star_has_corner_arcs_only():
    """A cutter much larger than a star touches it at its points only."""
    angles = [pi / 2 + row * pi / 5 for row in range(11)]
    star = lines(*((r * cos(a), r * sin(a)) for a, r in zip(angles, [1.0, 0.4] * 5 + [1.0], strict=True)))
    done = compensate(star.part(1, 9), Side.RIGHT, 30.0, 20, closed=False)
    inner = done.path.numbers[1:-1]
    assert len(inner)
    assert (inner % 1 == 0.5).all()


def test_a_closed_contour_of_two_segments_takes_the_latest_point_at_its_first_corner():
    lens = Path.from_pieces([Arc((-1, 0), (1, 0), (0, 1), Turn.CCW), Arc((1, 0), (-1, 0), (0, -1), Turn.CCW)])
    done = compensate(lens, Side.LEFT, 0.25, 3, closed=True)
    across = float(np.sqrt((np.sqrt(2) - 0.25) ** 2 - 1))
    assert done.path.numbers.tolist() == [1, 2]
    assert done.path.points[1] == pytest.approx((across, 0))
    assert compensate(lens, Side.LEFT, 0.25, 3, closed=False).path.points[1] == pytest.approx((-across, 0))


def test_three_offsets_that_meet_at_one_point_leave_no_sliver():
    """The offset of the short side shrinks to the point where the offsets of its neighbors meet."""
    slot = lines((0, 2), (0, 0), (0.5, 0), (0.5, 2))
    done = compensate(slot, Side.LEFT, 0.25, 3, closed=False)
    assert done.path.numbers.tolist() == [1, 3]
    assert done.path.points.tolist() == [[0.25, 2], [0.25, 0.25], [0.25, 2]]
    assert not len(done.deleted)
    assert not done.findings


@pytest.mark.parametrize("side", Side)
def test_a_line_out_and_back_is_rounded_at_its_end(side):
    done = compensate(lines((0, 0), (4, 0), (0, 0)), side, 0.5, 8, closed=True)
    assert done.path.numbers.tolist() == [1, 1.5, 2]
    assert done.path.lengths.tolist() == pytest.approx([4, pi / 2, 4])


def test_inches_and_millimeters_give_the_same_path():
    pocket = lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0), (1, 0))
    inch = compensate(pocket, Side.LEFT, 0.25, 5, closed=True)
    metric = compensate(_moved(pocket, lambda points: points * 25.4), Side.LEFT, 6.35, 5, closed=True)
    assert np.abs(inch.path.points * 25.4 - metric.path.points).max() < 1e-9
