"""Stretches proved thin are those that would be left out for their thickness, and no others."""

from __future__ import annotations

from math import cos, hypot, sin, tan, tau

import numpy as np
import pytest

from core.comp.compensate import compensate
from core.geometry.measured import boxes, measured
from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Turn
from core.geometry.side import Side
from core.tolerance import GOUGE, STOCK
from core.verify import uncut as room
from core.verify.pairs import Pairs, pairs_of
from core.verify.thin import thin
from core.verify.uncut import reached, uncut
from tests.core.verify.shapes import lines

RADIUS = 0.25


@pytest.fixture(autouse=True)
def _formulas_without_an_answer_are_quiet():
    with np.errstate(all="ignore"):
        yield


def polygon(count: int, size: float = 10.0) -> Path:
    """A circle drawn by `count` lines, from the middle of one of them."""
    corners = [(size * cos(tau * row / count), size * sin(tau * row / count)) for row in range(count)]
    (x0, y0), (x1, y1) = corners[-1], corners[0]
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    return lines(middle, *corners, middle)


def pairs(surface: Path, centre: Path) -> Pairs:
    walls = measured(surface)
    return pairs_of(measured(centre), walls, walls.stations, boxes(walls), RADIUS + 10 * GOUGE)


def proved(surface: Path, centre: Path) -> tuple[int, int]:
    """How many stretches are not reached, and how many of these are proved thin."""
    found = pairs(surface, centre)
    gaps, near = reached(found, RADIUS).gaps(float(found.surface_stations[-1]))
    return len(gaps), int(thin(found, gaps, near, RADIUS).sum())


def inside(surface: Path) -> Path:
    return compensate(surface, Side.LEFT, RADIUS, 1, closed=True).path


def thickness(count: int) -> float:
    """What a cutter leaves in the corners of a polygon."""
    return RADIUS * (hypot(1.0, tan(tau / count / 2.0)) - 1.0)


def test_fine_lines_leave_stretches_that_are_proved_thin():
    assert thickness(4000) < STOCK < thickness(400)
    surface = polygon(4000)
    gaps, thin_ones = proved(surface, inside(surface))
    assert gaps >= 3990
    assert thin_ones == gaps


def test_corners_worth_a_word_are_not():
    surface = polygon(400)
    gaps, thin_ones = proved(surface, inside(surface))
    assert gaps == 400
    assert thin_ones == 0
    found = uncut(pairs(surface, inside(surface)), RADIUS, surface, closed=True)
    assert [one.thickness for one in found] == pytest.approx([thickness(400)] * 400, abs=1e-8)


def test_arcs_and_the_contour_s_ends_are_left_alone():
    bulge = Arc((1, 0), (2, 0), (1.5, 0), Turn.CW)
    surface = Path.from_pieces([Line((0, 0), (1, 0)), bulge, Line((2, 0), (3, 0))])
    centre = lines((0, RADIUS), (0.9, RADIUS))
    assert proved(surface, centre)[1] == 0
    assert proved(lines((0, 0), (3, 0)), lines((1, RADIUS), (2, RADIUS))) == (2, 0)
    assert proved(lines((0, 0), (3, 0)), EMPTY) == (1, 0)


@pytest.mark.parametrize("count", [50, 400, 900, 1100, 1500, 4000])
def test_nothing_else_is_left_out(count, monkeypatch):
    surface = polygon(count)
    centre = inside(surface)
    short = uncut(pairs(surface, centre), RADIUS, surface, closed=True)
    monkeypatch.setattr(room, "thin", lambda _pairs, gaps, _near, _radius: np.zeros(len(gaps), np.bool_))
    assert short == uncut(pairs(surface, centre), RADIUS, surface, closed=True)
    assert bool(short) is (thickness(count) > STOCK)
