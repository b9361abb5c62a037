"""Arcs whose two radii differ by as much as is allowed, and which end hardly away from where they start."""

from __future__ import annotations

from math import tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.best_path.best_path import best_path
from core.comp.compensate import compensate
from core.geometry.path import Path, Points, as_complex, coordinates
from core.geometry.piece import Side
from core.tolerance import ARC_RADII, JOINED

ROUND = 10.0
CUTTER = 0.5
FROM, BACK = 6.0j, 4.0 + 5.0j
"""Where the line before the arc begins, and where the line after it ends."""

logs = st.floats(-6.0, -1.0).map(lambda power: 10.0**power)
apart = st.floats(-7.0, np.log10(ARC_RADII) - 1e-9).map(lambda power: 10.0**power)
signs = st.sampled_from((-1, 1))


def arc_between_lines(along: float, off: float, turn: int) -> Path:
    """A line to (0, 0), an arc about (0, -10) to a point `along` its circle and `off` outside it, and a line away."""
    end = (ROUND + off) * 1j * np.exp(1j * turn * along / ROUND) - 1j * ROUND
    points = np.array([FROM, 0.0, end, BACK])
    centers = np.array([FROM, -1j * ROUND, end])
    return Path.of(coordinates(points), coordinates(centers), np.array([0, turn, 0]))


def along_path(path: Path) -> Points:
    """Points all along a path."""
    parts = np.linspace(0.0, 1.0, 257)
    start, end = as_complex(path.starts)[:, None], as_complex(path.ends)[:, None]
    center, sweep = as_complex(path.centers)[:, None], path.sweeps[:, None]
    line = start + (end - start) * parts
    arc = center + (start - center) * np.exp(1j * sweep * parts)
    every: Points = np.where(path.turns[:, None] == 0, line, arc).ravel()
    return every


def from_line(points: Points, start: complex, end: complex) -> float:
    along = end - start
    part = np.clip(((points - start) * np.conj(along)).real / abs(along) ** 2, 0.0, 1.0)
    return float(np.abs(points - start - part * along).min())


def from_surface(points: Points, contour: Path, off: float, *, full: bool) -> float:
    """The least distance of points from the contour, as far as its two radii and a short arc's height leave it open."""
    start, end = (complex(*row) for row in contour.points[1:3])
    least = min(from_line(points, FROM, start), from_line(points, end, BACK))
    if full:
        # where the arc does not run, its ends are the nearest
        ahead = np.mod(-int(contour.turns[1]) * np.angle((points + 1j * ROUND) / 1j), tau)
        gap = -int(contour.turns[1]) * float(np.angle((end + 1j * ROUND) / 1j))
        there = points[ahead >= gap]
        return min(least, float(np.abs(np.abs(there + 1j * ROUND) - ROUND).min()) + off)
    return min(least, from_line(points, start, end) + abs(end - start) ** 2 / (8.0 * ROUND))


@settings(max_examples=150, deadline=None, derandomize=True)
@given(logs, apart, signs, signs, signs, st.sampled_from(Side))
def test_the_best_path_of_a_nearly_full_or_empty_arc_stays_away_from_it(along, off, out, way, turn, side):
    contour = arc_between_lines(way * along, out * off, turn)
    best = best_path(contour, side, CUTTER, closed=False)
    assert best.loops
    points = np.concatenate([along_path(loop) for loop in best.loops])
    assert from_surface(points, contour, off, full=way < 0) > CUTTER - off - 1e-6
    for loop in best.loops:
        assert not np.isnan(loop.points).any()


@settings(max_examples=80, deadline=None, derandomize=True)
@given(logs, apart, signs, signs, st.sampled_from(Side))
def test_the_best_path_of_a_nearly_full_arc_goes_round_it(along, off, out, turn, side):
    contour = arc_between_lines(-along, out * off, turn)
    best = best_path(contour, side, CUTTER, closed=False)
    points = np.concatenate([along_path(loop) for loop in best.loops]) + 1j * ROUND
    beside = ROUND + side.sign * -turn * CUTTER
    there = points[np.abs(np.abs(points) - beside) <= off + 1e-6]
    # the two lines take little more than a radian of what is outside
    assert np.sort(np.abs(np.angle(there * 1j)))[-1] > tau / 2 - 0.2
    assert {round(angle) for angle in np.angle(there * 1j).tolist()} >= {-2, -1, 0, 1, 2}


@pytest.mark.parametrize("off", [1e-6, 0.001, -0.001, ARC_RADII * 0.999])
@pytest.mark.parametrize("along", [0.0, 2e-8, -2e-8])
@pytest.mark.parametrize("turn", [-1, 1])
def test_an_arc_that_is_a_full_turn_or_none_is_refused(off, along, turn):
    """Its ends are on one ray from its center, and not one point: it may be empty or a full circle."""
    contour = arc_between_lines(along, off, turn)
    assert abs(along) < JOINED
    best, control = (
        best_path(contour, Side.LEFT, CUTTER, closed=False),
        compensate(contour, Side.LEFT, CUTTER, 3, closed=False),
    )
    assert not best.loops
    assert not len(control.path)
    for found in (best.findings, control.findings):
        assert [(one.code, one.segment) for one in found] == [("ARC_ENDS", 2)]


@settings(max_examples=80, deadline=None, derandomize=True)
@given(logs, apart, signs, signs, signs, st.sampled_from(Side))
def test_the_control_s_path_stays_beside_an_arc_of_uneven_radii(along, off, out, way, turn, side):
    contour = arc_between_lines(way * along, out * off, turn)
    raw = compensate(contour, side, CUTTER, 1, closed=False).raw
    row = raw.numbers.tolist().index(2)
    arms = np.abs(as_complex(raw.points[row : row + 2]) + 1j * ROUND)
    assert (np.abs(np.abs(arms - ROUND) - CUTTER) <= off + 1e-9).all()
    assert abs(abs(raw.sweeps[row]) - abs(contour.sweeps[1])) < 1e-9
