"""What stays uncut of an arc about whose own center the path turns: all of it is equally far from there."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, inf, pi, sin

import numpy as np
import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Point, Side, Turn
from core.verify.judge import judge

R, CUTTER, SWEEP = 10.0, 3.0, 1.1 * pi


def at(radius: float, angle: float) -> Point:
    return radius * cos(angle), radius * sin(angle)


def sampled(start: float, corners: list[Point]) -> float:
    """The thickest that stays of the arc, at ten thousand of its points."""
    angles = start + np.linspace(0.0, SWEEP, 10_001)
    x, y, least = R * np.cos(angles), R * np.sin(angles), np.full(10_001, inf)
    for (x0, y0), (x1, y1) in pairwise(corners):
        along, up = x1 - x0, y1 - y0
        t = np.clip(((x - x0) * along + (y - y0) * up) / (along * along + up * up), 0.0, 1.0)
        least = np.minimum(least, np.hypot(x - x0 - t * along, y - y0 - t * up))
    return float(least.max()) - CUTTER


@pytest.mark.parametrize("reach", [0.0, R - CUTTER - 0.3])
@pytest.mark.parametrize("start", [0.05 * step for step in range(0, 126, 5)] + [3.2])
def test_the_thickest_place_on_an_arc_is_reported_if_its_center_is_a_corner_of_the_path(
    start: float, reach: float
) -> None:
    end, middle = start + SWEEP, start + SWEEP / 2.0
    arc = Path.from_pieces([Arc(at(R, start), at(R, end), (0.0, 0.0), Turn.CCW)])
    detour = [at(reach, middle), (0.0, 0.0)] if reach else []
    corners = [at(R - CUTTER, start), (0.0, 0.0), *detour, at(R - CUTTER, end)]
    path = Path.from_pieces([Line(first, last) for first, last in pairwise(corners)])
    uncut = judge(arc, Side.LEFT, CUTTER, path).uncut
    assert len(uncut)
    worst = max(uncut, key=lambda one: one.thickness)
    assert worst.thickness == pytest.approx(sampled(start, corners), abs=1e-5)
    assert hypot(*worst.thickest) == pytest.approx(R, abs=1e-9)
