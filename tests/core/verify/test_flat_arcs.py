"""Distances to arcs of any radius are exact, even at the end of a short arc with a radius of kilometers."""

from __future__ import annotations

from math import cos, hypot, pi, sin, sqrt

import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.verify.judge import judge
from tests.core.verify.shapes import moved


@pytest.mark.parametrize("radius", [1e3, 1e6, 9e6])
@pytest.mark.parametrize("half", [0.005, 0.5, 20.0])
@pytest.mark.parametrize("short", [3e-5, 1e-4, 3e-4, -1e-4])
def test_the_depth_beside_the_end_of_a_flat_arc_is_exact(radius: float, half: float, short: float) -> None:
    """A needle ends `short` of the end of the arc and a micron above it."""
    drop = half * half / (radius + sqrt(radius * radius - half * half))
    surface = Path.from_pieces([Arc((-half, -drop), (half, -drop), (0.0, -radius), Turn.CW)])
    x = half - short
    foot = (x, -x * x / (radius + sqrt(radius * radius - x * x)))
    height = 1e-3
    needle = (foot[0] + height * x / radius, foot[1] + height * sqrt(1.0 - (x / radius) ** 2))
    path = Path.from_pieces([Line((needle[0], needle[1] + 1.0), needle)])
    apart = height if short > 0.0 else hypot(needle[0] - half, needle[1] + drop)
    for side, around in ((Side.LEFT, 0.0), (Side.LEFT, pi / 3.0)):
        turned = [moved(piece, around, (0.0, 0.0)) for piece in (surface, path)]
        verdict = judge(turned[0], side, 2e-3, turned[1])
        # doubles limit the last digit of the coordinates of the center
        assert verdict.clearance == pytest.approx(apart, abs=1e-8)
        assert verdict.depth == pytest.approx(2e-3 - apart, abs=1e-8)


@pytest.mark.parametrize("sweep", [1e-12, 1e-9, 1e-3])
def test_a_short_arc_is_not_near_the_other_side_of_its_circle(sweep: float) -> None:
    radius = 2.0 if sweep > 1e-9 else 1e6
    surface = Path.from_pieces([Arc((radius, 0.0), (radius, radius * sweep), (0.0, 0.0), Turn.CCW)])
    path = Path.from_pieces([Line((-0.9 * radius, 0.0), (-0.9 * radius, -1.0))])
    assert judge(surface, Side.LEFT, 0.5, path).clearance == pytest.approx(1.9 * radius, rel=1e-5)


@pytest.mark.parametrize("turn", [Turn.CCW, Turn.CW])
@pytest.mark.parametrize("start", [0.0, 1.0, -pi / 2.0])
def test_a_full_circle_follows_the_wall_around_it(turn: Turn, start: float) -> None:
    """The middle of the circle is opposite its start, not at its center, where nothing touches."""
    ring, path = (
        Path.from_pieces([Arc(point, point, (0.0, 0.0), turn)])
        for point in ((cos(start), sin(start)), (0.75 * cos(start), 0.75 * sin(start)))
    )
    verdict = judge(ring, Side.LEFT if turn is Turn.CCW else Side.RIGHT, 0.25, path)
    assert (verdict.clean, verdict.may_cut_air, verdict.backwards, tuple(verdict.uncut)) == (True, (), (), ())


@pytest.mark.parametrize("first", [Turn.CCW, Turn.CW])
@pytest.mark.parametrize("last", [Turn.CCW, Turn.CW])
def test_concentric_arcs_are_near_only_side_by_side(first: Turn, last: Turn) -> None:
    outer = _arc(12.0, pi, 1.5 * pi, last)
    for begin, apart in ((0.0, hypot(10.0, 12.0)), (0.9 * pi, 2.0), (1.1 * pi, 2.0)):
        surface = _arc(10.0, begin, begin + 0.5 * pi, first)
        assert judge(surface, Side.LEFT, 2.5, outer).clearance == pytest.approx(apart, abs=1e-9)


def _arc(radius: float, begin: float, end: float, turn: Turn) -> Path:
    start, last = ((radius * cos(angle), radius * sin(angle)) for angle in (begin, end)[:: int(turn)])
    return Path.from_pieces([Arc(start, last, (0.0, 0.0), turn)])
