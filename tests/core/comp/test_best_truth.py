"""The best path is the true boundary: by brute force on any contour, and against regions on simple ones."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, sin, tan, tau

import numpy as np
import shapely
import shapely.ops
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.comp.best_path.best_path import BestPath
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from tests.core.comp.best_truth import CHORD, area, assert_true, chords, reached
from tests.core.comp.contours import loose, mixed, polygons, shut

sides = st.sampled_from(Side)
radii = st.sampled_from([0.05, 0.1, 0.25, 0.5, 1.0, 2.0]) | st.floats(0.05, 1.5)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed | polygons | loose, sides, radii)
def test_of_an_open_contour_every_place_and_no_other_is_on_the_path(contour, side, radius):
    assert_true(contour, side, radius, closed=False)


@settings(max_examples=150, deadline=None, derandomize=True)
@given((mixed | polygons | loose).map(shut), sides, radii)
def test_of_a_closed_contour_every_place_and_no_other_is_on_the_path(contour, side, radius):
    assert_true(contour, side, radius, closed=True)


def bulged(start: Point, end: Point, bulge: float) -> Piece:
    """The segment between two points that bulges by `bulge` times half its chord, to its right if positive."""
    if abs(bulge) < 0.01:
        return Line(start, end)
    sweep = 4.0 * np.arctan(bulge)
    middle = (complex(*start) + complex(*end)) / 2.0
    center = middle + 0.5j * (complex(*end) - complex(*start)) / tan(sweep / 2.0)
    return Arc(start, end, (center.real, center.imag), Turn.CCW if bulge > 0.0 else Turn.CW)


@st.composite
def stars(draw: st.DrawFn) -> Path:
    """Closed contours around the origin, lines and arcs bulging in and out, sharp and blunt; most are simple."""
    count = draw(st.integers(3, 10))
    reach = draw(st.lists(st.floats(1.0, 5.0), min_size=count, max_size=count))
    lean = draw(st.lists(st.floats(0.0, 0.9), min_size=count, max_size=count))
    bulges = draw(st.lists(st.just(0.0) | st.floats(-0.9, 0.9), min_size=count, max_size=count))
    angles = [(row + part) * tau / count for row, part in enumerate(lean)]
    points = [(size * cos(angle), size * sin(angle)) for size, angle in zip(reach, angles, strict=True)]
    ends = pairwise([*points, points[0]])
    return Path.from_pieces([bulged(a, b, bulge) for (a, b), bulge in zip(ends, bulges, strict=True)])


def simple(contour: Path) -> bool:
    """Does the contour keep clear of itself, by far more than the reference's chords leave it?"""
    ring = shapely.LinearRing(chords(contour, CHORD))
    if not ring.is_valid:
        return False
    parts = [shapely.LineString(chords(contour.part(row, row + 1), CHORD)) for row in range(len(contour))]
    inner = [shapely.ops.substring(part, 1e-3, part.length - 1e-3) for part in parts]
    return all(shapely.distance(a, b) > 1e-4 for row, a in enumerate(inner) for b in inner[:row])


def around(best: BestPath) -> float:
    """The area all loops go round, of either sense."""
    return abs(sum(area(loop) for loop in best.loops))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(stars(), sides, st.sampled_from([0.05, 0.25, 0.5, 1.0, 2.0, 6.0]))
def test_the_loops_bound_the_region_that_widened_chords_leave(contour, side, radius):
    """The reference lies within a chord's error of the arcs and a facet's of the cutter, so its area within their sum.

    That error times the boundary's length is the area's; loops are as near to it, but where it is as thin as that.
    """
    assume(simple(contour))
    best = assert_true(contour, side, radius, closed=True)
    assert all(best.closed)
    region = reached(contour, side, radius)
    error = CHORD + 1.4e-4 * radius
    assert abs(around(best) - region.area) < 1.5 * error * region.boundary.length + pi * error**2
    if best.loops:
        loops = shapely.MultiLineString([chords(loop, 1e-6) for loop in best.loops])
        missing = region.boundary.difference(loops.buffer(20.0 * error))
        assert missing.length < 1e-3


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.integers(0, 2**32 - 1), sides, st.sampled_from([0.25, 0.5, 0.75, 1.0]))
def test_on_a_grid_where_walls_lie_whole_cutters_apart(seed, side, radius):
    """Slots exactly as wide as the cutter, pinches, three offsets through one point."""
    rng = np.random.default_rng(seed)
    cells = {(0, 0)}
    while len(cells) < 12:
        x, y = sorted(cells)[rng.integers(len(cells))]
        dx, dy = ((1, 0), (-1, 0), (0, 1), (0, -1))[rng.integers(4)]
        cells.add((x + dx, y + dy))
    shape = shapely.union_all([shapely.box(x, y, x + 1, y + 1) for x, y in sorted(cells)])
    ring = np.array(shape.exterior.coords)
    assume(len(np.unique(ring, axis=0)) == len(ring) - 1)
    assert_true(Path.of(ring, ring[:-1], np.zeros(len(ring) - 1, np.int8)), side, radius, closed=True)


def wavy(count: int, depth: float) -> Path:
    """A closed curve of many tiny segments, with seven bays."""
    angle = np.arange(count + 1) * tau / count
    reach = 50.0 * (1.0 + depth * np.cos(7.0 * angle))
    points = np.stack((reach * np.cos(angle), reach * np.sin(angle)), axis=1)
    points[-1] = points[0]
    return Path.of(points, points[:-1], np.zeros(count, np.int8))


def test_curves_of_tiny_segments_whose_bays_are_tighter_than_the_cutter():
    for side in Side:
        for radius in (1.0, 12.0):
            best = assert_true(wavy(200, 0.3), side, radius, closed=True)
            assert best.closed == (True,)


def test_what_is_cut_off_for_certain_ends_at_no_place_where_the_path_turns():
    corners = [(0.0, 0.0), (0.1, 0.0), (0.2, 0.0), (0.4, 0.0), (0.4, 0.05), (0.4, 0.15000000000000002), (0.0, 0.0)]
    best = assert_true(Path.from_pieces([Line(*ends) for ends in pairwise(corners)]), Side.LEFT, 0.05, closed=True)
    turn = best.loops[0].points[1]
    assert np.allclose(turn, (0.35, 0.05), rtol=0.0, atol=1e-9)
