"""Contours that cross or touch themselves, and contours that only seem to."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Point, Side, Turn
from core.geometry.piece_arrays import direction, piece_arrays
from core.verify.judge import judge
from core.verify.self_crossings import at_joints
from core.verify.verdict import Verdict
from tests.core.verify.shapes import circle, lines, moved, paths, square
from tests.properties import exercised, must_exercise

FAR = lines((1000, 1000), (1001, 1000))


def verdict(surface: Path) -> Verdict:
    return judge(surface, Side.LEFT, 0.1, FAR)


@pytest.mark.parametrize(
    ("surface", "at"),
    [
        (lines((0, 0), (4, 0), (4, 4), (2, 4), (2, -1)), (2, 0)),
        (lines((0, 0), (4, 0), (4, 4), (2, 4), (2, 0)), (2, 0)),
        (lines((0, 0), (4, 0), (4, 4), (0, 4), (1, 0), (-1, 2)), (1, 0)),
        (lines((0, 0), (4, 0), (1, 0)), (1, 0)),
        (Path.from_pieces([Line((0, 0), (4, 0)), Arc((4, 0), (2, 0), (3, 0), Turn.CCW)]), (2, 0)),
        (Path.from_pieces([Arc((2, 0), (-2, 0), (0, 0), Turn.CCW), Arc((-2, 0), (2, 0), (0, 0), Turn.CW)]), (0, 2)),
        (lines((0, 0), (4, 0), (0, 0)), (2, 0)),
        (lines((0, 4), (0, 0), (4, 4), (4, 0), (0, 4)), (2, 2)),
        (lines((0, 0), (4, 4), (4, 0), (0, 4), (0, 0)), (2, 2)),
    ],
)
def test_crossings_and_touches_are_found(surface: Path, at: Point) -> None:
    result = verdict(surface)
    assert result.crosses_itself
    assert result.crossing_at == pytest.approx(at, abs=1e-9)


@pytest.mark.parametrize(
    "surface",
    [
        square(),
        circle((3, 3), 2.0),
        lines((0, 0), (4, 0), (4, 4)),
        lines((0, 0), (4, 0), (0, 1e-5)),
        lines((0, 0), (1, 0), (1 + 1e-6, 0), (2, 0), (2, 1), (0, 1), (0, 0)),
        Path.from_pieces([Arc((2, 0), (-2, 0), (0, 0), Turn.CCW), Arc((-2, 0), (2, 0), (0, 0), Turn.CCW)]),
        Path.from_pieces([Line((0, 0), (4, 0)), Arc((4, 0), (4, 2), (4, 1), Turn.CCW), Line((4, 2), (0, 2))]),
        Path.from_pieces([Arc((2, 0), (0, 2), (0, 0), Turn.CCW), Arc((0, 2), (-2, 4), (0, 4), Turn.CW)]),
    ],
)
def test_joints_are_no_crossings(surface: Path) -> None:
    assert not verdict(surface).crosses_itself
    assert not verdict(surface.reversed()).crosses_itself


def test_a_curve_of_many_small_arcs_does_not_cross_itself() -> None:
    angle = np.linspace(0.0, 2 * pi, 500)
    radius = np.where(np.arange(500) % 2, 5.0, 5.001)
    points = [(r * cos(a), r * sin(a)) for r, a in zip(radius.tolist(), angle.tolist(), strict=True)]
    pieces = [Arc(a, b, _about(a, b), Turn.CCW) for a, b in pairwise(points)]
    assert not verdict(Path.from_pieces(pieces)).crosses_itself


def _about(a: Point, b: Point) -> Point:
    """A center two chord lengths to the left of the middle of the chord."""
    return (a[0] + b[0]) / 2 - 2 * (b[1] - a[1]), (a[1] + b[1]) / 2 + 2 * (b[0] - a[0])


@must_exercise(0.5)
@settings(max_examples=60)
@given(paths(most=4), st.floats(0.5, 3.0), st.floats(0.0, 2 * pi))
def test_a_straight_cut_across_a_contour_is_found(surface: Path, length: float, angle: float) -> None:
    """A contour that starts with a line and ends with a line through the middle of the first crosses itself there."""
    begun = surface.points[0] - length * np.array((cos(angle), sin(angle)))
    first = Line(tuple(begun.tolist()), tuple(surface.points[0].tolist()))
    middle, last = (surface.points[0] + begun) / 2.0, surface.points[-1]
    along, out = surface.points[0] - begun, middle - last
    if np.hypot(*out) < 1e-3 or abs(along[0] * out[1] - along[1] * out[0]) < 1e-3:
        return
    exercised()
    back = Line(tuple(last.tolist()), tuple((middle + 0.5 * out).tolist()))
    longer = Path.from_pieces([first, *surface, back])
    for crossed in (longer, moved(longer, 1.0, (100.0, 50.0))):
        result = verdict(crossed)
        assert result.crosses_itself or result.over_run_at is not None


@given(paths(), paths())
def test_directions_at_joints_are_those_of_the_pieces(first: Path, second: Path) -> None:
    pieces = piece_arrays(Path.from_pieces([*first, *second]))
    rows = np.arange(len(pieces))
    for row in rows.tolist():
        end, begin = at_joints(pieces, rows, np.roll(rows, row))
        assert end / np.abs(end) == pytest.approx(direction(pieces, np.ones(len(rows))), abs=1e-9)
        assert begin / np.abs(begin) == pytest.approx(
            direction(pieces, np.zeros(len(rows)))[np.roll(rows, row)], abs=1e-9
        )
