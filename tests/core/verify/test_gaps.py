"""The thickness and area of uncut gaps; gaps thinner than STOCK are left out."""

from __future__ import annotations

from math import asin, cos, hypot, pi, sin, sqrt, tan, tau
from random import Random

import numpy as np
import pytest
from shapely.geometry import Point, Polygon

from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.tolerance import STOCK
from core.verify.judge import judge
from core.verify.verdict import Uncut
from tests.core.verify import oracle
from tests.core.verify.corpus import Chain
from tests.core.verify.oracle import chords
from tests.core.verify.shapes import circle, lines, square
from tests.core.verify.test_brute import spiral, waves

RADIUS = 0.25


def polygon(count: int, size: float = 10.0) -> Path:
    """A circle of `count` lines that starts in the middle of one of them."""
    corners = [(size * cos(tau * row / count), size * sin(tau * row / count)) for row in range(count)]
    (x0, y0), (x1, y1) = corners[-1], corners[0]
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    return lines(middle, *corners, middle)


def inside(surface: Path) -> Path:
    return compensate(surface, Side.LEFT, RADIUS, 1, closed=True).path


def uncut(surface: Path, center: Path, radius: float = RADIUS) -> tuple[Uncut, ...]:
    return judge(surface, Side.LEFT, radius, center).uncut


def thickness(count: int) -> float:
    """The thickness that a cutter leaves in the corners of a polygon."""
    return RADIUS * (hypot(1.0, tan(tau / count / 2.0)) - 1.0)


def test_gaps_thinner_than_stock_on_finely_sampled_curves_are_ignored() -> None:
    assert thickness(400) < STOCK < thickness(80)
    for count in (400, 4000):
        assert uncut(polygon(count), inside(polygon(count))) == ()


def test_the_thickness_of_uncut_corners_is_exact() -> None:
    stretches = uncut(polygon(80), inside(polygon(80)))
    assert [stretch.thickness for stretch in stretches] == pytest.approx([thickness(80)] * 80, abs=1e-12)


def test_a_stretch_is_reported_if_it_is_thicker_than_stock() -> None:
    wall = lines((0, 0), (10, 0))
    assert uncut(wall, lines((0, 1 + 0.9 * STOCK), (10, 1 + 0.9 * STOCK)), 1.0) == ()
    (stretch,) = uncut(wall, lines((0, 1 + 1.1 * STOCK), (10, 1 + 1.1 * STOCK)), 1.0)
    assert stretch.thickness == pytest.approx(1.1 * STOCK, abs=1e-9)


def test_a_thin_end_belongs_to_the_stretch_across_start() -> None:
    """The first and last stretch of a closed contour are one, so the thin half counts with the thick one."""
    surface = lines((0, 0), (4, 0), (4, 4), (0, 4), (0, 0))
    path = lines((1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0), (1.0, 1.0))
    shifted = lines((0, 0.02), (0, 0), (4, 0), (4, 4), (0, 4), (0, 0.02))
    at_corner, on_wall = (judge(contour, Side.LEFT, 1.0, path).uncut for contour in (surface, shifted))
    assert max(stretch.length for stretch in at_corner) == pytest.approx(2.0)
    lengths = [sorted(stretch.length for stretch in stretches) for stretches in (at_corner, on_wall)]
    assert lengths[0] == pytest.approx(lengths[1])


def odd_outlines() -> list[tuple[Path, Path]]:
    """Surfaces and paths with gaps on lines, on arcs, across many pieces, and far from the path."""
    bulge = Arc((1, 0), (2, 0), (1.5, 0), Turn.CW)
    bay = Arc((1, 0), (2, 0), (1.5, 0), Turn.CCW)
    bowl = Path.from_pieces([Line((0, 0), (4, 0)), Arc((4, 0), (0, 0), (2, 0), Turn.CCW)])
    angles = np.linspace(0.0, pi, 40)
    comb = [(0.1 * k, 0.3 * (k % 2) - 0.2 * sin(t)) for k, t in enumerate(angles.tolist())]
    return [
        (Path.from_pieces([Line((0, 0), (1, 0)), bulge, Line((2, 0), (3, 0))]), lines((0, RADIUS), (0.9, RADIUS))),
        (
            Path.from_pieces([Line((0, 0), (1, 0)), bay, Line((2, 0), (3, 0))]),
            lines((0, RADIUS), (1.5, RADIUS), (3, RADIUS)),
        ),
        (bowl, circle((2.0, 0.9), 0.6)),
        (bowl, Path.from_pieces([Arc((2.3, 0.9), (1.7, 0.9), (2.0, 0.9), Turn.CCW)])),
        (lines(*comb), lines((0, 0.6), (2, 0.4), (4, 0.6))),
        (lines((0, 0), (10, 0)), lines((1, RADIUS), (2, RADIUS), (3, 5), (4, RADIUS))),
        (Chain(((0, 0), (3, 0), (3, 3)), (0.3, -0.2)).path(), lines((0, 1), (1, 1), (2, 2))),
    ]


def cap(radius: float, width: float) -> float:
    """The area of a circle beyond a chord."""
    return radius**2 * asin(width / 2 / radius) - width / 2 * sqrt(radius**2 - width**2 / 4)


def test_the_area_of_uncut_inside_corners_is_exact() -> None:
    corner = RADIUS**2 * (1 - pi / 4)
    path = lines((RADIUS, RADIUS), (1.75, RADIUS), (1.75, 1.75), (RADIUS, 1.75), (RADIUS, RADIUS))
    assert [stretch.area for stretch in uncut(square(), path)] == pytest.approx([corner] * 4, abs=1e-8)
    reversed_stretches = judge(square().reversed(), Side.RIGHT, RADIUS, path.reversed()).uncut
    assert [stretch.area for stretch in reversed_stretches] == pytest.approx([corner] * 4, abs=1e-8)


def test_the_area_of_a_notch_that_the_cutter_cannot_enter_is_exact() -> None:
    notch = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    (stretch,) = uncut(notch, compensate(notch, Side.LEFT, RADIUS, 3, closed=False).path)
    assert stretch.area == pytest.approx(0.09 - cap(RADIUS, 0.3), abs=1e-8)


@pytest.mark.parametrize("angle", [1.5, 3.0, pi, 5.0, 5.6])
def test_the_area_of_a_round_bay_that_the_cutter_cannot_enter_is_exact(angle: float) -> None:
    """An arc of radius 1 of less or more than half a turn below a wall."""
    width = 2.0 * sin(angle / 2.0)
    bay = Arc((0, 0), (width, 0), (width / 2, cos(angle / 2.0)), Turn.CCW)
    surface = Path.from_pieces([Line((-3, 0), (0, 0)), bay, Line((width, 0), (width + 3, 0))])
    radius = width / 2 + 0.5
    height = sqrt(radius**2 - width**2 / 4)
    start, end, middle = (0.0, radius), (width, radius), (width / 2, height)
    pieces = [Arc(start, middle, (0, 0), Turn.CW), Arc(middle, end, (width, 0), Turn.CW)]
    path = Path.from_pieces([Line((-3, radius), start), *pieces, Line(end, (width + 3, radius))])
    (stretch,) = uncut(surface, path, radius)
    assert stretch.area == pytest.approx((angle - sin(angle)) / 2.0 - cap(radius, width), abs=1e-8)


def test_an_unbounded_gap_has_no_area() -> None:
    wall = lines((0, 0), (10, 0))
    assert [
        stretch.area for stretch in uncut(wall, lines((1, RADIUS), (4, RADIUS), (5, 2), (6, RADIUS), (9, RADIUS)))
    ] == [None] * 3


ROUNDED_GEAR = (1, 0, 0, 1, 0, -1, 1, 1, 1, 1, 1, 1, -1, 0, -1, 1, 0, 1, 0, 0, 1, -1, 1, 1)
"""The sides of a gear with six teeth that bend out or in."""


def test_every_gap_of_a_rounded_gear_has_its_area() -> None:
    """One move ends where the cutter touches a corner; another begins after the arc about that corner."""
    spots = [
        (radius, tau * (k + share) / 6) for k in range(6) for radius, share in ((3, 0), (3, 0.4), (2, 0.5), (2, 0.9))
    ]
    points = [(radius * cos(angle), radius * sin(angle)) for radius, angle in spots]
    surface = Chain((*points, points[0]), tuple(bend / 10.0 for bend in ROUNDED_GEAR)).path()
    path = compensate(surface, Side.LEFT, 1.0, 11, closed=True).path
    areas = [stretch.area for stretch in uncut(surface, path, 1.0)]
    assert None not in areas
    assert areas[0] == pytest.approx(_area_left(surface, path, 1.0, (0.3, 2.9)), abs=1e-3)


def _area_left(surface: Path, path: Path, radius: float, near: tuple[float, float]) -> float:
    """The area, by shapely, of the uncovered part of a contour that is nearest to a point."""
    left = Polygon(chords(surface)).difference(chords(path).buffer(radius, quad_segs=256))
    parts = getattr(left, "geoms", [left])
    return float(min(parts, key=lambda part: part.distance(Point(near))).area)


def test_rounded_uneven_arcs_do_not_change_the_thickness_of_gaps() -> None:
    """An uneven arc may miss the end of its gap by the difference of its radii; another move may be nearer."""
    count = 0
    for seed in range(30):
        random = Random(seed)
        for family in (waves, spiral):
            surface = family(random)
            path = compensate(surface, Side.LEFT, 1.5, 20, closed=False).path
            if not len(path):
                continue
            rounded = Path.of(np.round(path.points, 3), np.round(path.centers, 3), path.turns, path.numbers)
            for stretch in uncut(surface, rounded, 1.5):
                count += 1
                apart = oracle.apart(np.array([stretch.thickest]), rounded)[0]
                assert stretch.thickness == pytest.approx(apart - 1.5, abs=3e-3)
    assert count > 30
