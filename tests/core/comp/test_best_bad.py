"""The best path of contours that cross themselves, do not close, or are none."""

from __future__ import annotations

from math import hypot, nan, pi

import numpy as np
import pytest

from core.comp.best_path.best_path import best_path
from core.comp.best_path.prepared_contour import Walls
from core.comp.best_path.raw_offset import raw_offset
from core.comp.best_path.slices import Slices
from core.comp.best_path.stitch import stitch
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests.core.comp.best_truth import CLOSE, assert_true, only
from tests.core.comp.contours import lines


def test_over_run_lead_ins_are_walls_on_both_sides_and_reported():
    overrun = lines((-1, 0), (2, 0), (2, 2), (0, 2), (0, -1))
    best = assert_true(overrun, Side.RIGHT, 0.25, closed=False)
    first, second = best.loops
    assert first.points == pytest.approx(np.array([(-1, -0.25), (-0.25, -0.25), (-0.25, -1)]), abs=CLOSE)
    assert second.points[[0, -1]] == pytest.approx(np.array([(0.25, -0.25), (-0.25, 0.25)]), abs=CLOSE)
    assert [finding.code for finding in best.findings] == ["CROSSES_ITSELF"]


def test_segments_that_cross_beside_one_between_them_are_named():
    hook = lines((0, 0), (10, 0), (10, 5), (5, -5))
    (crossing,) = best_path(hook, Side.LEFT, 0.25, closed=False).findings
    assert crossing.text.startswith("Segments 1 and 3 cross")


def test_of_several_crossings_the_one_with_the_fewest_segments_between_is_named():
    loops = lines((0, 0), (10, 0), (10, 10), (5, 10), (5, -5), (20, -5), (30, -5), (30, 5), (25, -10))
    (crossing,) = best_path(loops, Side.LEFT, 0.25, closed=False).findings
    assert crossing.text.startswith("Segments 6 and 8 cross")


def test_closing_gap_is_bridged():
    gap = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0.002))
    assert len(only(gap, Side.LEFT, 0.25)) == 4
    around = best_path(gap, Side.RIGHT, 0.25, closed=True)
    assert around.closed == (True,)
    assert around.loops[0].lengths.sum() == pytest.approx(8 + pi / 2, abs=CLOSE)


def test_an_arc_of_uneven_radii_is_followed_on_its_mean():
    uneven = Arc((4.0, 0.0), (4.001, 2.0), (4.0, 1.0), Turn.CCW)
    straight = (Line((0.0, 0.0), (4.0, 0.0)), Line((4.001, 2.0), (0.0, 2.0)), Line((0.0, 2.0), (0.0, 0.0)))
    best = best_path(Path.from_pieces([straight[0], uneven, *straight[1:]]), Side.LEFT, 0.3, closed=True)
    assert (len(best.loops), best.findings) == (1, ())
    arc = best.loops[0].numbers.tolist().index(2)
    ends = best.loops[0].points[arc : arc + 2] - best.loops[0].centers[arc]
    assert hypot(*ends[0]) == pytest.approx(hypot(*ends[1]), abs=1e-9)


def test_zero_length_segments_are_skipped_and_reported():
    doubled = lines((0, 0), (0, 0), (2, 0), (2, 2), (2, 2), (0, 2), (0, 0))
    best = best_path(doubled, Side.LEFT, 0.25, closed=True)
    assert [(finding.code, finding.segment) for finding in best.findings] == [("ZERO_LENGTH", 1), ("ZERO_LENGTH", 4)]
    assert best.loops[0].numbers.tolist() == [2, 3, 5, 6]


SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
BAD = {
    "NaN": (lines((0, 0), (nan, 1)), 0.25, "NOT_FINITE"),
    "infinite": (lines((0, 0), (float("inf"), 1)), 0.25, "NOT_FINITE"),
    "huge": (lines((0, 0), (1e300, 1)), 0.25, "NOT_FINITE"),
    "empty": (EMPTY, 0.25, "EMPTY_CONTOUR"),
    "a point": (lines((1, 1), (1, 1)), 0.25, "EMPTY_CONTOUR"),
    "arc of two radii": (
        Path.from_pieces([Arc((1.0, 0.0), (0.0, 1.1), (0.0, 0.0), Turn.CCW)]),
        0.25,
        "ARC_RADII",
    ),
    "no radius": (SQUARE, 0.0, "RADIUS"),
    "negative radius": (SQUARE, -1.0, "RADIUS"),
    "radius NaN": (SQUARE, nan, "RADIUS"),
    "radius larger than everything": (SQUARE, 1e6, "NO_PATH"),
}


@pytest.mark.parametrize("name", BAD)
@pytest.mark.parametrize("closed", [True, False])
def test_bad_input_gives_a_finding_and_no_loops(name, closed):
    contour, radius, code = BAD[name]
    best = best_path(contour, Side.LEFT, radius, closed=closed)
    assert not best.loops
    assert not best.closed
    assert code in [finding.code for finding in best.findings]


def test_a_scribble_that_overlaps_itself_everywhere_is_reported_and_its_path_is_right():
    points = np.random.default_rng(1).uniform(0, 100, (60, 2))
    scribble = Path.of(points, points[:-1], np.zeros(59, np.int8))
    best = assert_true(scribble, Side.LEFT, 0.2, closed=False)
    assert best.findings[0].code == "CROSSES_ITSELF"
    assert len(best.loops) > 100


def test_a_scribble_no_part_can_be_is_refused_and_not_worked_on_without_end():
    points = np.random.default_rng(1).uniform(0, 100, (20_000, 2))
    best = best_path(Path.of(points, points[:-1], np.zeros(19_999, np.int8)), Side.LEFT, 1.0, closed=False)
    assert best.loops == ()
    assert [finding.code for finding in best.findings] == ["CROSSES_ITSELF", "TANGLED"]


@pytest.mark.parametrize("count", [1, 31, 32, 33, 80])
def test_any_number_of_tiny_slices_in_a_row_that_lead_nowhere_is_taken_away(count):
    """A slice of 10 mm goes on over slices shorter than a thousandth each, the last of which ends nowhere."""
    surface = lines((0, 0), (20, 0))
    raw = raw_offset(surface, Side.LEFT, 5.0, closed=False, crossing=False).raw
    row, size = np.arange(count + 1), np.append(10.0, np.full(count, 0.0009))
    ends = np.cumsum(size)
    piece, never = np.zeros(count + 1, np.intp), np.zeros(count + 1, np.bool_)
    points, outer = np.append(0.0, ends) + 5.0j, np.zeros(count + 2, np.bool_)
    cut = Slices(piece, piece, ends - size, ends, size, row, row + 1, never, points, outer)
    made = stitch(raw, cut, 1, Walls.of(surface), 5.0)
    assert made.slices.size.tolist() == [10.0]
    assert (made.following.tolist(), made.loose_end.tolist(), made.loose_begin.tolist()) == ([-1], [True], [True])
