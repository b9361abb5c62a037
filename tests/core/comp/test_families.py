"""Paths of whole families of contours, in inch and mm, near the origin and far from it."""

from __future__ import annotations

import numpy as np
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Side
from core.tolerance import JOINED
from tests.core.comp.best_truth import area, assert_true, chords, distance, sampled
from tests.core.comp.families import (
    backwards,
    convex,
    gears,
    notched,
    placed,
    rings,
    rounded,
    shifts,
    strips,
    units,
    waves,
)
from tests.core.comp.walked import walk

sides = st.sampled_from(Side)
radii = st.sampled_from([0.05, 0.25, 0.5, 1.0]) | st.floats(0.03, 3.0)

uneven = radii.map(lambda radius: 1.00137 * radius)
"""Radii at which no slot is as wide as the cutter: there the cutter goes in and out on one line that has no area."""

CHORD = 1e-5
"""Millimeters to a contour of some inches or millimeters: the chords of the reference leave its arcs by no more."""

QUADRANT = 128
"""Chords to a quarter of the reference's cutter: they leave it by 1.9e-5 of the radius."""


@settings(max_examples=30, deadline=None, derandomize=True)
@given(strips | rings, sides, radii, st.integers(1, 20), st.booleans())
def test_the_walk_is_that_of_the_slow_one(contour, side, radius, lookahead, closed):
    assume(contour.lengths.min() > 2.0 * JOINED)  # what has no length is left out first, which the slow walk does not
    closed = closed and contour.points[0].tolist() == contour.points[-1].tolist()
    done = compensate(contour, side, radius, lookahead, closed=closed)
    slow = walk(list(contour), side.sign, radius, lookahead, closed=closed)
    assert done.path.numbers.tolist() == [cut.label for cut in slow.path]
    starts = np.array([[cut.start.real, cut.start.imag] for cut in slow.path]).reshape(-1, 2)
    assert np.abs(done.path.starts - starts).max(initial=0.0) < JOINED


@settings(max_examples=30, deadline=None, derandomize=True)
@given(strips, sides, radii, units, shifts)
def test_the_best_path_of_open_families_is_the_true_boundary(contour, side, radius, unit, shift):
    assert_true(placed(contour, unit, shift), side, radius * unit, closed=False)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(rings, sides, radii, units, shifts)
def test_the_best_path_of_closed_families_is_the_true_boundary(contour, side, radius, unit, shift):
    assert_true(placed(contour, unit, shift), side, radius * unit, closed=True)


def _true_offset(contour: Path, radius: float) -> shapely.Polygon:
    """The region that the center may not enter outside a closed contour, by chords; checked to have no hole."""
    grown = shapely.Polygon(chords(contour, CHORD)).buffer(radius, quad_segs=QUADRANT)
    assume(isinstance(grown, shapely.Polygon) and not grown.interiors)
    return grown


@settings(max_examples=30, deadline=None, derandomize=True)
@given(gears() | convex() | rounded() | waves() | notched(), uneven, units, st.booleans())
def test_with_enough_look_ahead_the_path_outside_is_the_single_curve_that_shapely_has(contour, radius, unit, back):
    """Started in the middle of the outermost side, with a look-ahead over every gap but not over half the contour."""
    contour = placed(contour, unit, 0j)
    assume(shapely.LinearRing(chords(contour, CHORD)).is_simple)
    region = _true_offset(contour, radius * unit)
    image = contour.points[0] + radius * unit * np.array((1, -1)) * contour.start_directions[0][::-1]
    assume(distance(contour, image[None])[0] > radius * unit - JOINED)
    if back:
        contour = backwards(contour)
    side = Side.LEFT if back else Side.RIGHT
    control = compensate(contour, side, radius * unit, (len(contour) - 1) // 2, closed=True).path
    error = 2.0 * (CHORD + 2e-5 * radius * unit)
    # a path that gouges has not looked far enough ahead
    assume(not shapely.LineString(chords(control, CHORD)).intersects(region.buffer(-0.75 * error)))
    assert np.hypot(*(control.points[0] - control.points[-1])) < JOINED
    assert shapely.distance(region.boundary, shapely.points(sampled(control))).max() < error
    assert abs(abs(area(control)) - region.area) < error * region.length
