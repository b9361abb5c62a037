"""Absurd contours through engine, judge and best path: no exception, no endless run, no false clean verdict."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.advice.lookahead_table import CuttingSetup, judge_lookaheads
from core.advice.remedies import advice_for
from core.comp.best_path.best_path import best_path
from core.comp.compensate import compensate, compensate_all
from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.comp.contours import lines, mixed
from tests.core.verify.oracle import least
from tests.properties import exercised, must_exercise

NEAR = 1e-5
STEP = 0.02

ODD = [nan, inf, -inf, 1e300, -1e300, 1e16, 1e7, -1e7, 1.0000001e7, 5e-324, 1e-300, 1e-12, 1e-8, 1e-7, 0.00254]
PLAIN = [0.0, -0.0, 1.0, -1.0, 2.0, 0.5, 0.25, 1.0 + 1e-9, 1.0 - 1e-7]

anything = st.sampled_from(ODD) | st.sampled_from(PLAIN) | st.floats(allow_nan=True)
mostly_plain = st.sampled_from(PLAIN) | st.sampled_from(PLAIN) | st.sampled_from(PLAIN) | st.sampled_from(ODD)
radii = st.sampled_from([0.0, -1.0, nan, inf, 1e-300, 1e-9, 1e-7, 0.25, 0.5, 1.0, 1e3, 1e7, 1e300])


@st.composite
def arrays(draw: st.DrawFn, numbers: st.SearchStrategy[float]) -> Path:
    """Arbitrary arrays, including arcs whose centers do not match their ends."""
    count = draw(st.integers(0, 7))
    points = [[draw(numbers), draw(numbers)] for _ in range(count + 1)]
    centers = [[draw(numbers), draw(numbers)] for _ in range(count)]
    turns = [draw(st.sampled_from((-1, 0, 0, 1))) for _ in range(count)]
    return Path.of(np.array(points), np.array(centers), np.array(turns, np.int8))


def _everything(contour: Path, side: Side, radius: float, *, closed: bool) -> None:
    """Nothing raises, an unjudged path is not clean, and a missing path is an error."""
    for result in compensate_all(contour, side, radius, (1, 3, 8, 20), closed=closed, blend=0.1, overlap=0.1):
        assert np.isfinite(result.with_leads.points).all()
        assert len(result.path) or any(finding.severity is Severity.ERROR for finding in result.findings)
        verdict = judge(contour, side, radius, result.with_leads)
        assert not (verdict.clean and not verdict.judged)
    best = best_path(contour, side, radius, closed=closed)
    assert best.loops or any(finding.severity is Severity.ERROR for finding in best.findings)
    for loop in best.loops:
        assert np.isfinite(loop.points).all()
    if not (np.isfinite(contour.points).all() and np.isfinite(radius)):
        assert not judge(contour, side, radius, contour).clean
        assert not best.loops


@settings(max_examples=80, derandomize=True)
@given(arrays(anything), st.sampled_from(Side), radii, st.booleans())
def test_arbitrary_numbers_never_fail(contour, side, radius, closed):
    _everything(contour, side, radius, closed=closed)


@settings(max_examples=100, derandomize=True)
@given(arrays(mostly_plain), st.sampled_from(Side), radii, st.booleans())
def test_odd_numbers_among_plain_ones_never_fail(contour, side, radius, closed):
    _everything(contour, side, radius, closed=closed)


@st.composite
def spoiled(draw: st.DrawFn) -> Path:
    """A drawn contour with at most one odd number."""
    contour = draw(mixed)
    points = contour.points.copy()
    if draw(st.booleans()):
        points[draw(st.integers(0, len(points) - 1)), draw(st.integers(0, 1))] = draw(st.sampled_from(ODD))
    return Path.of(points, contour.centers, contour.turns)


@must_exercise(0.12)
@settings(max_examples=30)
@given(spoiled(), st.sampled_from(Side), st.sampled_from([0.02, 0.05, 0.1, 0.25, 0.0, nan]), st.booleans())
def test_tables_and_advice_of_odd_contours_never_fail(contour, side, radius, closed):
    trial = CuttingSetup(contour, side, radius, closed, 0.1, 0.1)
    table = judge_lookaheads(trial)
    advice_for(trial, 3, table)
    if table.recommended is not None:
        exercised()
        assert len(table.row(table.recommended).compensated.path)


grid = st.tuples(st.integers(0, 3).map(float), st.integers(0, 3).map(float))


def _arc(start: Point, end: Point, turn: Turn) -> Piece:
    """The half circle over a chord, or a full circle beside a point."""
    if start == end:
        return Arc(start, start, (start[0] + 1.0, start[1]), turn)
    return Arc(start, end, ((start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0), turn)


@st.composite
def scribbles(draw: st.DrawFn) -> Path:
    """Lines and arcs on a grid with overlaps, touches, repeats, zero lengths, full circles and crossings."""
    points = draw(st.lists(grid, min_size=2, max_size=8))
    pieces: list[Piece] = []
    for start, end in pairwise(points):
        turn = draw(st.sampled_from(Turn))
        pieces.append(Line(start, end) if turn is Turn.NONE else _arc(start, end, turn))
    if draw(st.booleans()):
        pieces += [pieces[-1]] if pieces[-1].start == pieces[-1].end else [Line(pieces[-1].end, pieces[-1].start)]
    return Path.from_pieces(pieces)


def _without_over_run(contour: Path, at: Point) -> Path:
    """The contour between a point of its first piece and the same point of its last piece."""
    pieces = [piece for piece in contour if piece.length > 0.0]
    first, last = replace(pieces[0], start=at), replace(pieces[-1], end=at)
    return Path.from_pieces([first, *pieces[1:-1], last])


def _truly_clean(verdict: Verdict, path: Path, contour: Path, radius: float) -> None:
    if verdict.clean and len(path):
        surface = contour if verdict.over_run_at is None else _without_over_run(contour, verdict.over_run_at)
        assert least(path, surface, STEP) >= radius - NEAR


@settings(max_examples=60, derandomize=True)
@given(scribbles(), st.sampled_from(Side), st.sampled_from([0.05, 0.25, 0.5, 0.7, 1.0, 3.0]), st.booleans())
def test_no_scribble_is_falsely_clean(contour, side, radius, closed):
    closed = closed and contour.points[0].tolist() == contour.points[-1].tolist()
    for result in compensate_all(contour, side, radius, (1, 4, 20), closed=closed):
        _truly_clean(judge(contour, side, radius, result.path), result.path, contour, radius)
    for loop in best_path(contour, side, radius, closed=closed).loops:
        assert least(loop, contour, STEP) >= radius - NEAR


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize("radius", [1e-6, 0.25, 1.0, 1e6])
@pytest.mark.parametrize(
    "points",
    [
        [(0.0, 0.0)] * 5,
        [(0.0, 0.0), (4.0, 0.0), (4.0, 0.0), (0.0, 0.0), (4.0, 0.0)],
        [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)] * 3,
        [(0.0, 0.0), (1e7, 1e7), (1e7, 0.0), (0.0, 1e7), (0.0, 0.0)],
        [(1e7, 1e7), (1e7 - 1e-6, 1e7), (1e7, 1e7 - 1e-6), (1e7, 1e7)],
    ],
)
def test_contours_that_overlap_themselves_never_fail(points, radius, side):
    _everything(lines(*points), side, radius, closed=points[0] == points[-1])


def test_a_scribble_with_a_thousand_crossings_is_never_clean():
    random = np.random.default_rng(5)
    contour = lines(*((float(x), float(y)) for x, y in random.uniform(0, 10, (200, 2))))
    for result in compensate_all(contour, Side.LEFT, 0.5, (1, 20, 200), closed=False):
        assert not judge(contour, Side.LEFT, 0.5, result.path).clean
    for loop in best_path(contour, Side.LEFT, 0.01, closed=False).loops:
        assert loop.lengths.sum() > 0


def test_every_bad_segment_is_named():
    good = lines((0, 0), (2, 0), (2, 2), (0, 2))
    for row in range(1, 4):
        points = good.points.copy()
        points[row] = (nan, 0.0)
        (finding,) = compensate(
            Path.of(points, points[:-1], np.zeros(3, np.int8)), Side.LEFT, 0.25, 2, closed=False
        ).findings
        assert (finding.code, finding.segment) == ("NOT_FINITE", row)
