"""What a gap's bound proves agrees with the search for the farthest place; what is thinner than STOCK is left out."""

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
from core.verify.verdict import UncutStretches
from tests.core.verify import oracle
from tests.core.verify.corpus import Chain
from tests.core.verify.oracle import chords
from tests.core.verify.shapes import circle, lines, square
from tests.core.verify.test_brute import spiral, waves

RADIUS = 0.25


def polygon(count: int, size: float = 10.0) -> Path:
    """A circle drawn by `count` lines, from the middle of one of them."""
    corners = [(size * cos(tau * row / count), size * sin(tau * row / count)) for row in range(count)]
    (x0, y0), (x1, y1) = corners[-1], corners[0]
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    return lines(middle, *corners, middle)


def inside(surface: Path) -> Path:
    return compensate(surface, Side.LEFT, RADIUS, 1, closed=True).path


def uncut(surface: Path, center: Path, radius: float = RADIUS) -> UncutStretches:
    return judge(surface, Side.LEFT, radius, center).uncut


def thickness(count: int) -> float:
    """What a cutter leaves in the corners of a polygon."""
    return RADIUS * (hypot(1.0, tan(tau / count / 2.0)) - 1.0)


def test_what_curves_of_fine_lines_leave_is_not_worth_a_word() -> None:
    assert thickness(400) < STOCK < thickness(80)
    for count in (400, 4000):
        assert uncut(polygon(count), inside(polygon(count))) == ()


def test_corners_worth_a_word_are_told_to_the_last_digit() -> None:
    found = uncut(polygon(80), inside(polygon(80)))
    assert [one.thickness for one in found] == pytest.approx([thickness(80)] * 80, abs=1e-12)


def test_a_stretch_is_told_from_stock_on() -> None:
    wall = lines((0, 0), (10, 0))
    assert uncut(wall, lines((0, 1 + 0.9 * STOCK), (10, 1 + 0.9 * STOCK)), 1.0) == ()
    (told,) = uncut(wall, lines((0, 1 + 1.1 * STOCK), (10, 1 + 1.1 * STOCK)), 1.0)
    assert told.thickness == pytest.approx(1.1 * STOCK, abs=1e-9)


def test_a_thin_end_belongs_to_the_stretch_over_start() -> None:
    """A closed contour's first and last stretch are one: the thin half of it counts with the thick one."""
    surface = lines((0, 0), (4, 0), (4, 4), (0, 4), (0, 0))
    path = lines((1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0), (1.0, 1.0))
    shifted = lines((0, 0.02), (0, 0), (4, 0), (4, 4), (0, 4), (0, 0.02))
    one, other = (judge(contour, Side.LEFT, 1.0, path).uncut for contour in (surface, shifted))
    assert max(one.length) == pytest.approx(2.0)
    assert sorted(one.length) == pytest.approx(sorted(other.length))


def odd_outlines() -> list[tuple[Path, Path]]:
    """Surfaces and paths whose gaps are met on lines, on arcs, across many pieces, far from all of the path."""
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
    """What a circle reaches over a chord."""
    return radius**2 * asin(width / 2 / radius) - width / 2 * sqrt(radius**2 - width**2 / 4)


def test_the_area_in_inside_corners_over_start_too() -> None:
    corner = RADIUS**2 * (1 - pi / 4)
    path = lines((RADIUS, RADIUS), (1.75, RADIUS), (1.75, 1.75), (RADIUS, 1.75), (RADIUS, RADIUS))
    assert [one.area for one in uncut(square(), path)] == pytest.approx([corner] * 4, abs=1e-8)
    other = judge(square().reversed(), Side.RIGHT, RADIUS, path.reversed()).uncut
    assert [one.area for one in other] == pytest.approx([corner] * 4, abs=1e-8)


def test_the_area_of_a_notch_the_cutter_cannot_enter() -> None:
    notch = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    (told,) = uncut(notch, compensate(notch, Side.LEFT, RADIUS, 3, closed=False).path)
    assert told.area == pytest.approx(0.09 - cap(RADIUS, 0.3), abs=1e-8)


@pytest.mark.parametrize("angle", [1.5, 3.0, pi, 5.0, 5.6])
def test_the_area_of_a_round_bay_the_cutter_cannot_enter(angle: float) -> None:
    """An arc of radius 1, more than half round or less, below a wall."""
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


def test_no_area_is_told_where_it_has_no_bound() -> None:
    wall = lines((0, 0), (10, 0))
    assert [one.area for one in uncut(wall, lines((1, RADIUS), (4, RADIUS), (5, 2), (6, RADIUS), (9, RADIUS)))] == [
        None
    ] * 3


ROUNDED_GEAR = (1, 0, 0, 1, 0, -1, 1, 1, 1, 1, 1, 1, -1, 0, -1, 1, 0, 1, 0, 0, 1, -1, 1, 1)
"""Which sides of a gear with six teeth are bent out or in."""


def test_an_area_is_told_whichever_of_the_moves_that_end_a_gap_stands_for_it() -> None:
    """A move ends where the cutter touches a corner, another begins behind the arc about that corner."""
    spots = [
        (radius, tau * (k + share) / 6) for k in range(6) for radius, share in ((3, 0), (3, 0.4), (2, 0.5), (2, 0.9))
    ]
    points = [(radius * cos(angle), radius * sin(angle)) for radius, angle in spots]
    surface = Chain((*points, points[0]), tuple(bend / 10.0 for bend in ROUNDED_GEAR)).path()
    path = compensate(surface, Side.LEFT, 1.0, 11, closed=True).path
    areas = [one.area for one in uncut(surface, path, 1.0)]
    assert None not in areas
    assert areas[0] == pytest.approx(_area_left(surface, path, 1.0, (0.3, 2.9)), abs=1e-3)


def _area_left(surface: Path, path: Path, radius: float, near: tuple[float, float]) -> float:
    """Area inside a contour that no disc along the path covers, of the part that holds a point, by shapely."""
    left = Polygon(chords(surface)).difference(chords(path).buffer(radius, quad_segs=256))
    parts = getattr(left, "geoms", [left])
    return float(min(parts, key=lambda part: part.distance(Point(near))).area)


def test_nothing_is_told_thicker_than_it_is_where_rounded_coordinates_make_arcs_uneven() -> None:
    """The arc at the end of a gap reaches that end by what its two radii leave open; another move may be nearer."""
    told = 0
    for seed in range(30):
        random = Random(seed)
        for family in (waves, spiral):
            surface = family(random)
            path = compensate(surface, Side.LEFT, 1.5, 20, closed=False).path
            if not len(path):
                continue
            rounded = Path.of(np.round(path.points, 3), np.round(path.centers, 3), path.turns, path.numbers)
            for stretch in uncut(surface, rounded, 1.5):
                told += 1
                apart = oracle.apart(np.array([stretch.thickest]), rounded)[0]
                assert stretch.thickness == pytest.approx(apart - 1.5, abs=3e-3)
    assert told > 30
