"""Contours that are refused, and findings on those that are not."""

from __future__ import annotations

from itertools import pairwise
from math import cos, inf, nan, pi, sin

import numpy as np
import pytest

from core.comp.compensate import compensate, compensate_all
from core.comp.compensated import Compensated
from core.comp.findings import MAX_NAMED_PLACES, NO_PATH, segment_list
from core.finding import Finding, Severity
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from tests.core.comp.contours import lines

TRIANGLE = [(2.0, 0.0), (1.0, 3.0**0.5), (0.0, 0.0)]
L = lines((0, 0), (2, 0), (2, 2))
BAD = [nan, inf, -inf, 1e8, 1e300]


def _only(compensated: Compensated) -> Finding:
    (finding,) = compensated.findings
    return finding


def _refused(compensated: Compensated, code: str) -> Finding:
    finding = _only(compensated)
    assert (finding.code, finding.severity) == (code, Severity.ERROR)
    assert len(compensated.path) == len(compensated.raw) == len(compensated.deleted) == len(compensated.with_leads) == 0
    return finding


@pytest.mark.parametrize("radius", [0.0, -1.0, nan, inf, 1e300])
def test_an_invalid_radius_is_refused(radius):
    _refused(compensate(L, Side.LEFT, radius, 2, closed=False), "RADIUS")


@pytest.mark.parametrize("lookahead", [0, -3])
def test_an_invalid_lookahead_is_refused(lookahead):
    _refused(compensate(L, Side.LEFT, 0.25, lookahead, closed=False), "LOOKAHEAD")


def test_an_empty_contour_is_refused():
    _refused(compensate(EMPTY, Side.LEFT, 0.25, 2, closed=False), "EMPTY_CONTOUR")


@pytest.mark.parametrize("bad", BAD)
def test_an_invalid_point_is_refused(bad):
    contour = lines((0, 0), (2, 0), (2, bad), (0, 2))
    assert _refused(compensate(contour, Side.LEFT, 0.25, 2, closed=False), "NOT_FINITE").segment == 2


@pytest.mark.parametrize("bad", BAD)
def test_an_invalid_center_is_refused(bad):
    contour = Path.from_pieces([Line((0, 0), (1, 0)), Arc((1, 0), (2, 0), (bad, 0), Turn.CW)])
    assert _refused(compensate(contour, Side.LEFT, 0.25, 2, closed=False), "NOT_FINITE").segment == 2


def test_an_arc_with_two_radii_is_refused():
    contour = Path.from_pieces([Line((0, 0), (1, 0)), Arc((1, 0), (2, 0), (1.6, 0), Turn.CW)])
    finding = _refused(compensate(contour, Side.LEFT, 0.25, 2, closed=False), "ARC_RADII")
    assert finding.segment == 2
    assert finding.lengths == pytest.approx((0.6, 0.4))


def test_an_arc_about_its_own_start_is_refused():
    contour = Path.from_pieces([Arc((1, 0), (1.002, 0), (1, 0), Turn.CW)])
    _refused(compensate(contour, Side.LEFT, 0.25, 2, closed=False), "ARC_RADII")


def test_every_lookahead_has_the_refusal():
    for done in compensate_all(EMPTY, Side.LEFT, 0.25, (1, 2, 3), closed=False):
        _refused(done, "EMPTY_CONTOUR")
    assert compensate_all(L, Side.LEFT, 0.25, (), closed=False) == ()


def test_segments_without_length_are_skipped():
    contour = lines((0, 0), (0, 0), (2, 0), (2, 0), (2, 2))
    done = compensate(contour, Side.LEFT, 0.25, 2, closed=False)
    assert [(finding.code, finding.segment, finding.severity) for finding in done.findings] == [
        ("ZERO_LENGTH", 1, Severity.WARNING),
        ("ZERO_LENGTH", 3, Severity.WARNING),
    ]
    assert done.path.numbers.tolist() == [2, 4]
    assert done.contour.numbers.tolist() == [2, 4]


def test_segments_without_length_do_not_extend_the_lookahead():
    stepped = lines((0, 0), (2, 0), (2, 0.1), (4, 0.1), (4, 2))
    padded = lines((0, 0), (2, 0), (2, 0), (2, 0), (2, 0.1), (4, 0.1), (4, 2))
    plain, with_points = (compensate(contour, Side.LEFT, 0.25, 2, closed=False) for contour in (stepped, padded))
    assert np.array_equal(plain.path.points, with_points.path.points)
    assert [deleted.segment for deleted in with_points.deleted] == [4]


def test_arcs_that_are_points_are_skipped():
    contour = Path.from_pieces([Line((0, 0), (2, 0)), Arc((2, 0), (2, 0), (2, 0), Turn.CW), Line((2, 0), (2, 2))])
    done = compensate(contour, Side.LEFT, 0.25, 2, closed=False)
    assert _only(done).code == "ZERO_LENGTH"
    assert done.path.numbers.tolist() == [1, 3]


@pytest.mark.parametrize("turn", list(Turn))
@pytest.mark.parametrize("far", [(0.0, 6e-8), (-6e-8, 0.0), (4e-8, -4e-8)])
def test_arcs_about_one_of_their_own_ends_are_skipped(turn, far):
    """Such an arc has no defined angle: there is no direction from the center to that end."""
    for start, end, center in (((0, 0), far, far), (far, (0, 0), (0, 0)), (far, (0, 0), far)):
        first, last = Arc(start, end, center, turn), Line(end, (10, 0))
        round_: list[Piece] = [first, last, Line((10, 0), (0, 10)), Line((0, 10), start)]
        for pieces, closed in ((round_[1:] + round_[:1], True), (round_, True), (round_[3:] + round_[:2], False)):
            done = compensate(Path.from_pieces(pieces), Side.RIGHT, 1.0, 3, closed=closed, blend=1.0)
            assert [finding.code for finding in done.findings] == ["ZERO_LENGTH"]
            assert len(done.path)
            assert np.isfinite(done.with_leads.points).all()


def test_a_contour_of_points_only_is_empty():
    done = compensate(lines((1, 1), (1, 1)), Side.LEFT, 0.25, 2, closed=True)
    assert [finding.code for finding in done.findings] == ["ZERO_LENGTH", "EMPTY_CONTOUR"]
    assert not len(done.path)


def test_a_full_circle_is_not_skipped():
    circle = Arc((2, 0), (2, 0), (0, 0), Turn.CCW)
    contour = Path.from_pieces([Line((5, 0), (2, 0)), circle, Line((2, 0), (2, 1e-8)), Line((2, 1e-8), (5, 0))])
    done = compensate(contour, Side.RIGHT, 0.25, 2, closed=False)
    assert abs(done.contour.sweeps).max() == pytest.approx(2 * pi)
    assert done.contour.numbers.tolist() == [1, 2, 4]


@pytest.mark.parametrize("short", [2e-8, 5e-8])
def test_an_arc_short_of_a_full_circle_by_less_than_a_point_is_a_full_circle(short):
    contour = Path.from_pieces([Arc((1, 0), (cos(short), -sin(short)), (0, 0), Turn.CCW)])
    done = compensate(contour, Side.RIGHT, 0.5, 2, closed=True)
    assert done.path.lengths.tolist() == [pytest.approx(3 * pi)]
    assert done.path[0].start == done.path[0].end


def test_an_inside_arc_too_small_for_the_tool_vanishes():
    contour = Path.from_pieces(
        [Line((0, 0), (2, 0)), Arc((2, 0), (2.2, 0.2), (2, 0.2), Turn.CCW), Line((2.2, 0.2), (2.2, 3))]
    )
    finding = _only(compensate(contour, Side.LEFT, 0.25, 1, closed=False))
    assert (finding.code, finding.severity, finding.segment) == ("VANISHED", Severity.WARNING, 2)
    assert finding.value == pytest.approx(0.2)
    pruned = compensate(contour, Side.LEFT, 0.25, 2, closed=False)
    assert not pruned.findings
    assert [(deleted.segment, deleted.by) for deleted in pruned.deleted] == [(2, (1, 3))]


@pytest.mark.parametrize("lookahead", [1, 2, 8])
def test_an_inside_arc_exactly_as_large_as_the_tool_becomes_a_corner(lookahead):
    contour = Path.from_pieces(
        [Line((0, 0), (2, 0)), Arc((2, 0), (2.25, 0.25), (2, 0.25), Turn.CCW), Line((2.25, 0.25), (2.25, 3))]
    )
    done = compensate(contour, Side.LEFT, 0.25, lookahead, closed=False)
    assert not done.findings
    assert done.path.points.tolist() == [[0, 0.25], [2, 0.25], [2, 3]]
    assert not len(done.deleted)


@pytest.mark.parametrize("radius", [2.0, 2.5])
def test_a_hole_too_small_for_the_tool_is_an_error(radius):
    contour = Path.from_pieces([Arc((2, 0), (2, 0), (0, 0), Turn.CCW)])
    done = compensate(contour, Side.LEFT, radius, 3, closed=True, blend=0.1, overlap=0.1)
    assert len(done.with_leads) == 0
    assert Severity.ERROR in {finding.severity for finding in done.findings}
    assert len(compensate(contour, Side.RIGHT, radius, 3, closed=True).path) == 1


def test_a_start_at_an_inside_corner_of_arcs_is_reported():
    lens = Path.from_pieces([Arc((-1, 0), (1, 0), (0, 1), Turn.CCW), Arc((1, 0), (-1, 0), (0, -1), Turn.CCW)])
    assert [finding.code for finding in compensate(lens, Side.LEFT, 0.25, 3, closed=True).findings] == [
        "START_INSIDE_CORNER"
    ]
    assert not compensate(lens, Side.RIGHT, 0.25, 3, closed=True).findings


def test_a_tangent_start_is_no_corner():
    slot = Path.from_pieces(
        [
            Line((0, 0), (4, 0)),
            Arc((4, 0), (4, 2), (4, 1), Turn.CCW),
            Line((4, 2), (0, 2)),
            Arc((0, 2), (0, 0), (0, 1), Turn.CCW),
        ]
    )
    for side in Side:
        done = compensate(slot, side, 0.25, 3, closed=True)
        assert not done.findings
        assert done.path.numbers.tolist() == [1, 2, 3, 4]


def test_a_long_way_names_the_deleted_segments():
    contour = lines((0.1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0))
    finding = compensate(contour, Side.LEFT, 0.25, 4, closed=True).findings[-1]
    assert finding.code == "LONG_WAY"
    assert finding.value == pytest.approx(4.0)
    assert "segments 2-3" in finding.text


def test_a_bridged_corner_is_named_wherever_the_contour_lies():
    notch = [(0.0, 0.0), (2.0, 0.0), (2.0, -0.3), (2.3, -0.3), (2.3, 0.0), (4.0, 0.0)]
    done = compensate(lines(*notch), Side.LEFT, 0.25, 1, closed=False)
    row = int(done.bridged.nonzero()[0][0])
    x, y = done.path.points[row : row + 2].mean(axis=0).tolist()
    about_origin = compensate(lines(*((px - x, py - y) for px, py in notch)), Side.LEFT, 0.25, 1, closed=False)
    for result in (done, about_origin):
        assert [(finding.code, finding.segment) for finding in result.findings] == [("CORNER_MISSED", 3.5)]


def test_many_places_are_counted_and_not_listed():
    notch = [(0.0, 0.0), (2.0, 0.0), (2.0, -0.3), (2.3, -0.3), (2.3, 0.0)]
    done = compensate(
        lines(*((x + 4 * row, y) for row in range(150) for x, y in notch)), Side.LEFT, 0.25, 1, closed=False
    )
    assert done.bridged.sum() == 150
    assert {(finding.code, finding.severity) for finding in done.findings} == {("CORNER_MISSED", Severity.WARNING)}
    assert [finding.segment for finding in done.findings[:3]] == [3.5, 8.5, 13.5]
    assert len(done.findings) == MAX_NAMED_PLACES + 1
    assert "150" in done.findings[-1].text


def test_zero_lengths_beyond_a_hundred_are_counted():
    contour = lines((0, 0), *[(1, 0)] * 150, (2, 0))
    findings = compensate(contour, Side.LEFT, 0.25, 1, closed=False).findings
    assert len(findings) == MAX_NAMED_PLACES + 1
    assert "149" in findings[-1].text


@pytest.mark.parametrize(
    ("numbers", "text"),
    [([4], "segment 4"), ([2, 3], "segments 2-3"), ([1, 2, 3, 7, 9, 10], "segments 1-3, 7, 9-10")],
)
def test_segment_numbers_are_listed_as_ranges(numbers, text):
    assert segment_list(np.array(numbers, np.float64)) == text


@pytest.mark.parametrize("radius", [1e-6, 0.3, 50.0, 1e6])
def test_odd_contours_never_fail(radius):
    odd: list[list[Point]] = [
        [(0, 0), (1, 0), (1, 0), (0, 0), (1, 0)],
        [(0, 0), (1, 0), (0, 0), (1, 0), (0, 0)],
        [(1e7, 1e7), (1e7, 1e7 - 1), (1e7 - 1, 1e7), (1e7, 1e7)],
        [(0, 0), (1e7, 0), (1e7, 1e-6), (0, 1e-6)],
        [(0, 0), (1, 1), (1, 0), (0, 1), (0, 0)],
    ]
    for points in odd:
        for side in Side:
            for done in compensate_all(lines(*points), side, radius, range(1, 21), closed=points[0] == points[-1]):
                assert np.isfinite(done.with_leads.points).all()
                assert len(done.path) or any(one.severity is Severity.ERROR for one in done.findings)
                assert all(piece.length > 0 for piece in done.path)
                assert all(one.start == two.end for two, one in pairwise(done.path))


@pytest.mark.parametrize(
    ("points", "lookahead", "at"),
    [
        ([(0.25, 0.0), (2.0, 0.0), (2.0, 1.5), (0.0, 1.5), (0.0, 0.0)], 4, (0.25, 0.25)),
        ([(0.25 * 3.0**0.5, 0.0), *TRIANGLE], 2, (0.25 * 3.0**0.5, 0.25)),
    ],
)
def test_a_path_that_comes_back_to_its_start_says_where_to_start(points, lookahead, at):
    """START is as far from the corner as the center from both walls: one radius at a square corner."""
    lost = compensate(lines(*points, points[0]), Side.LEFT, 0.25, lookahead, closed=True)
    assert not len(lost.path)
    (finding,) = [each for each in lost.findings if each.code == NO_PATH]
    assert (finding.severity, finding.segment, finding.field) == (Severity.ERROR, 0.0, "x_start")
    assert finding.at == pytest.approx(at)
    assert finding.text.endswith("Start in the middle of a side.")
    beside = [(points[0][0] + 0.01, 0.0), *points[1:]]
    assert len(compensate(lines(*beside, beside[0]), Side.LEFT, 0.25, lookahead, closed=True).path)


def test_a_tool_that_does_not_fit_is_said_to_be_too_large():
    pocket = lines((0.25, 0), (0.5, 0), (0.5, 0.5), (0, 0.5), (0, 0), (0.25, 0))
    lost = compensate(pocket, Side.LEFT, 0.25, 4, closed=True)
    (finding,) = [each for each in lost.findings if each.code == NO_PATH]
    assert finding.text == "Nothing is left of the path: the tool does not fit. Use a smaller one."
