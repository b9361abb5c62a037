"""Contours that start or end past their corner: what lies beyond the corner is lead-in or lead-out, not contour."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt

import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.verify.judge import judge
from tests.core.verify.shapes import lines, mirrored

R = 0.25
SQUARE = ((1.5, 0.0), (1.5, -1.5), (0.0, -1.5))
CROSSING_AT_A_JOINT = {
    "first": lines((-1, 0), (0, 0), *SQUARE, (0, 0.1)),
    "last": lines((-0.1, 0), *SQUARE, (0, 0), (0, 1)),
    "both": lines((-1, 0.5), (0, 0), *SQUARE, (0, 0), (-0.5, 1)),
    "no run-out": lines((-1, 0), (0, 0), *SQUARE, (0, 0)),
    "no run-in": lines((0, 0), *SQUARE, (0, 0), (0, 1)),
}
OVER_RUNS = {
    "starts at the corner": lines((0, 0), *SQUARE, (0, 0.1)),
    "ends at the corner": lines((-0.1, 0), *SQUARE, (0, 0)),
    **CROSSING_AT_A_JOINT,
}
Motion = Callable[[Path], Path]
MOTIONS: dict[str, tuple[Motion, Side]] = {
    "as drawn": (lambda path: path, Side.LEFT),
    "mirrored": (mirrored, Side.RIGHT),
    "reversed": (Path.reversed, Side.RIGHT),
    "mirrored and reversed": (lambda path: mirrored(path).reversed(), Side.LEFT),
}


def around(radius: float) -> Path:
    """The path outside the square, from and to its corner at the origin, with leads past the corner."""
    return Path.from_pieces(
        [
            Line((-1, radius), (1.5, radius)),
            Arc((1.5, radius), (1.5 + radius, 0), (1.5, 0), Turn.CW),
            Line((1.5 + radius, 0), (1.5 + radius, -1.5)),
            Arc((1.5 + radius, -1.5), (1.5, -1.5 - radius), (1.5, -1.5), Turn.CW),
            Line((1.5, -1.5 - radius), (0, -1.5 - radius)),
            Arc((0, -1.5 - radius), (-radius, -1.5), (0, -1.5), Turn.CW),
            Line((-radius, -1.5), (-radius, 1)),
        ]
    )


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("contour", OVER_RUNS)
def test_what_lies_beyond_the_corner_is_a_lead(contour: str, motion: str) -> None:
    move, side = MOTIONS[motion]
    verdict = judge(move(OVER_RUNS[contour]), side, R, move(around(R)))
    assert verdict.over_run_at == pytest.approx((0.0, 0.0), abs=1e-9)
    assert not verdict.crosses_itself
    assert verdict.surface_length == pytest.approx(6.0)
    assert verdict.clean
    assert verdict.uncut == ()


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("contour", OVER_RUNS)
def test_a_lead_that_nicks_the_corner_gouges_by_its_depth_there(contour: str, motion: str) -> None:
    """The line from (-1, 0) to (0, R) passes the corner at less than the radius."""
    move, side = MOTIONS[motion]
    nick = lines((-1, 0), (0, R), (1, R))
    verdict = judge(move(OVER_RUNS[contour]), side, R, move(nick))
    assert verdict.depth == pytest.approx(R - R / sqrt(1 + R * R))
    assert judge(move(OVER_RUNS[contour]), side, R, move(around(R - 0.01))).depth == pytest.approx(0.01)


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("contour", OVER_RUNS)
def test_with_the_tool_inside_the_ends_are_walls(contour: str, motion: str) -> None:
    move, side = MOTIONS[motion]
    inside = Side.LEFT if side is Side.RIGHT else Side.RIGHT
    verdict = judge(move(OVER_RUNS[contour]), inside, R, move(lines((0.5, -0.5), (1, -0.5))))
    assert verdict.over_run_at is None
    assert verdict.crosses_itself


@pytest.mark.parametrize(
    "contour",
    [
        lines((-1, 0), (0, 0), *SQUARE, (0, 0.1), (-1, 0.1)),
        lines((-1, 0.1), (-1, 0), (0, 0), *SQUARE, (0, 0.1)),
        lines((-1, 0), (-0.6, 0), (0, 0), *SQUARE, (-0.3, -1.5), (-0.3, 1)),
        lines((-8, 0), (0, 0), *SQUARE, (0, 0.1)),
    ],
)
def test_a_crossing_of_other_elements_and_a_run_as_long_as_the_loop_are_no_over_runs(contour: Path) -> None:
    verdict = judge(contour, Side.LEFT, R, lines((9, 9), (8, 9)))
    assert verdict.over_run_at is None
    assert verdict.crosses_itself


def test_a_contour_whose_ends_meet_has_no_over_run() -> None:
    for end in ((0.0, 0.0), (0.0, 0.002), (0.0, -0.002)):
        verdict = judge(lines((0, 0), *SQUARE, end), Side.LEFT, R, around(R))
        assert verdict.over_run_at is None
        assert not verdict.crosses_itself


LEAF_CENTER = (0.75, 2.25)
LEAF_FOOT = (0.0, 2.25 - sqrt(3.25**2 + 0.25**2 - 0.75**2))
LEAF_BACK = (Line((4, 2), (0, 2)), Line((0, 2), (0, -2.5)))


def arc(start: tuple[float, float], end: tuple[float, float]) -> Arc:
    """An arc of the leaf's lower edge."""
    return Arc(start, end, LEAF_CENTER, Turn.CCW)


LEAVES: dict[str, list[Piece]] = {
    "crosses": [arc((-1, -0.5), (4, 2)), *LEAF_BACK],
    "starts at the corner": [arc(LEAF_FOOT, (4, 2)), *LEAF_BACK],
    "ends at the corner": [arc((-1, -0.5), (4, 2)), LEAF_BACK[0], Line((0, 2), LEAF_FOOT)],
    "arc that leads in": [arc((-1, -0.5), LEAF_FOOT), arc(LEAF_FOOT, (4, 2)), *LEAF_BACK],
    "arc that leads out": [
        arc(LEAF_FOOT, (4, 2)),
        LEAF_BACK[0],
        Line((0, 2), LEAF_FOOT),
        Arc(LEAF_FOOT, (-1, LEAF_FOOT[1] - 1), (-1, LEAF_FOOT[1]), Turn.CW),
    ],
}


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("name", LEAVES)
def test_an_over_run_of_arcs_is_a_lead(name: str, motion: str) -> None:
    move, side = MOTIONS[motion]
    other = Side.LEFT if side is Side.RIGHT else Side.RIGHT
    leaf = Path.from_pieces([arc(LEAF_FOOT, (4, 2)), LEAF_BACK[0], Line((0, 2), LEAF_FOOT)])
    verdict = judge(move(Path.from_pieces(LEAVES[name])), other, R, lines((9, 9), (8, 9)))
    assert verdict.over_run_at == pytest.approx(LEAF_FOOT, abs=1e-9)
    assert verdict.surface_length == pytest.approx(float(leaf.lengths.sum()))


def test_straight_leads_of_a_full_circle_are_leads() -> None:
    circle = Arc((2, 0), (2, 0), (0, 0), Turn.CW)
    contour = Path.from_pieces([Line((4, -1), (2, 0)), circle, Line((2, 0), (4, 1))])
    verdict = judge(contour, Side.LEFT, R, Path.from_pieces([Arc((2 + R, 0), (2 + R, 0), (0, 0), Turn.CW)]))
    assert verdict.over_run_at == pytest.approx((2.0, 0.0))
    assert verdict.clean
    assert verdict.uncut == ()
