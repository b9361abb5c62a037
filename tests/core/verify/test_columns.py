"""Distances to arcs are right however large they are: a tiny cutter at the end of a short arc of kilometres' radius."""

from __future__ import annotations

from math import hypot, pi, sqrt

import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Turn
from core.geometry.side import Side
from core.verify.judge import judge
from tests.core.verify.shapes import moved


@pytest.mark.parametrize("radius", [1e3, 1e6, 9e6])
@pytest.mark.parametrize("half", [0.005, 0.5, 20.0])
@pytest.mark.parametrize("short", [3e-5, 1e-4, 3e-4, -1e-4])
def test_the_depth_beside_the_end_of_a_flat_arc(radius: float, half: float, short: float) -> None:
    """A needle stands `short` of the arc's end and a micron above it."""
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
        told = judge(turned[0], side, 2e-3, turned[1])
        # the last digit of the centre's coordinates is what doubles allow
        assert told.clearance == pytest.approx(apart, abs=1e-8)
        assert told.depth == pytest.approx(2e-3 - apart, abs=1e-8)


@pytest.mark.parametrize("sweep", [1e-12, 1e-9, 1e-3])
def test_a_short_arc_is_not_met_on_the_other_side_of_its_circle(sweep: float) -> None:
    radius = 2.0 if sweep > 1e-9 else 1e6
    surface = Path.from_pieces([Arc((radius, 0.0), (radius, radius * sweep), (0.0, 0.0), Turn.CCW)])
    path = Path.from_pieces([Line((-0.9 * radius, 0.0), (-0.9 * radius, -1.0))])
    assert judge(surface, Side.LEFT, 0.5, path).clearance == pytest.approx(1.9 * radius, rel=1e-5)
