"""Laps repeated within one compensation are judged once, without losing a gouge."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.controls.control_run import ControlRun
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import deepest_gouge, judge_run
from core.controls.judging.repeated_passes import without_repeats
from core.geometry.path import Path
from core.geometry.piece import Arc, Side, Turn
from core.geometry.piece_arrays import at, piece_arrays
from core.tolerance import GOUGE, ON_PATH
from core.verify.gouge import gouging
from core.verify.judge import judge
from core.verify.pairs import pairs_of, rounding_of
from core.verify.verdict import Verdict
from tests.core.controls.hand import run_of

RING = """G21 G17 G90 F100
T1 M6
G0 X-30 Y-30 Z5
G41 D1 G1 X0 Y-10
{calls}
G1 Y0
G40 X-40 Y20
M2
O7
{lap}
M99
"""
LAP = "G1 Y0\nY30\nX40\nY0\nG2 X20 Y0 I-10 J0\nG1 X0"
SHARES = 7
"""The number of places checked on each piece of a center path."""

STEPS = ((0.0, 30.0), (40.1, 0.0), (0.0, -30.0), (-40.1, 0.0))


def _ring(calls: str, lap: str = LAP, control: str = "linuxcnc") -> ControlRun:
    return run_of(RING.format(calls=calls, lap=lap), control, t1=6)


def _chain(corners: Sequence[tuple[float, float]], turns: Sequence[int] | None = None) -> Path:
    """Pieces from corner to corner; arcs are half circles, or full circles about a center 2 to the right."""
    points = np.array(corners, np.float64)
    way = np.zeros(len(points) - 1, np.int8) if turns is None else np.array(turns, np.int8)
    centers = np.where(way[:, None] == 0, points[:-1], (points[:-1] + points[1:]) / 2.0)
    full = (way != 0) & (points[:-1] == points[1:]).all(axis=1)
    centers[full] += (2.0, 0.0)
    return Path.of(points, centers, way)


@pytest.mark.parametrize("control", ["linuxcnc", "rosettacnc:normal"])
def test_forty_passes_are_judged_as_one_with_the_same_findings(control: str) -> None:
    (single,), (forty,) = judge_run(_ring("M98 P7", control=control)), judge_run(_ring("M98 P7 L40", control=control))
    assert len(forty.surface) == len(single.surface) == 5
    # the first lap comes from the lead, so a second one differs from it
    assert len(forty.center) <= 2 * len(single.center)
    assert judged_findings((forty,)) == judged_findings((single,))
    assert {finding.code for finding in judged_findings((single,))} == {"GOUGE", "LEADS", "UNCUT"}


def test_the_number_of_passes_does_not_change_the_judged_pieces() -> None:
    for control in ("linuxcnc", "nine-series:a", "nine-series:b"):
        few, many = ((judge_run(_ring(f"M98 P7 L{laps}", control=control))) for laps in (3, 200))
        assert [len(result.center) for result in few] == [len(result.center) for result in many]
        assert judged_findings(few) == judged_findings(many)


def test_written_out_depths_are_judged_with_the_lines_of_the_first() -> None:
    laps = "\n".join(f"G1 Z{-depth}\n{LAP}" for depth in range(1, 10))
    (result,) = judge_run(_ring(laps))
    assert result.surface.numbers.tolist() == [7.0, 8.0, 9.0, 10.0, 11.0]
    assert len(result.lines) == 45
    assert {finding.line for finding in judged_findings((result,)) if finding.code == "UNCUT"} == {10}


def test_a_gouge_in_the_seventh_pass_only_is_reported() -> None:
    """The notch goes through the wall of all other laps; its own sides end the depth at the cutter's radius."""
    lap = "G1 X0 Y30\nX40\nY0\nX0"
    notched = lap.replace("X40", "X20\nY22\nX22\nY30\nX40")
    laps = [lap] * 6 + [notched] + [lap] * 3
    even, cut = (
        judge_run(_ring("G1 Y0\n" + "\n".join(all_of), control="nine-series:b")) for all_of in ([lap] * 10, laps)
    )
    seventh = range(6 + 6 * 4, 6 + 6 * 4 + 8)
    assert deepest_gouge(even)[0] < 0.1
    assert deepest_gouge(cut) == (3.0, seventh[2])
    assert {gouge.surface_number for gouge in cut[0].verdict.gouges if gouge.depth == 3.0} == {7.0}


def test_a_pass_that_differs_in_one_piece_is_kept() -> None:
    lap = [(0.0, 30.0), (40.0, 30.0), (40.0, 0.0), (0.0, 0.0)]
    other = [*lap[:1], (40.0, 29.0), *lap[2:]]
    reduced = without_repeats(_chain([(-5.0, 0.0), (0.0, 0.0), *lap * 6, *other, *lap * 5, (-5.0, 0.0)]))
    assert [40.0, 29.0] in reduced.points.tolist()
    assert reduced.numbers[:5].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert reduced.points[[0, -1]].tolist() == [[-5.0, 0.0], [-5.0, 0.0]]
    # the first lap and the seventh; the eighth is removed from the last difference of the seventh on
    assert len(reduced) <= 2 + 4 + 4 + 4


def test_a_circle_cut_twice_becomes_one() -> None:
    twice = Path.from_pieces([Arc((5.0, 0.0), (5.0, 0.0), (0.0, 0.0), Turn.CCW)] * 2)
    assert len(without_repeats(twice)) == 1


def test_moves_back_and_forth_or_onward_are_not_repeated_passes() -> None:
    back = _chain([(0.0, 0.0), (9.0, 0.0), (0.0, 0.0)])
    assert without_repeats(back) is back
    stairs = _chain([(float(step // 2), float((step + 1) // 2)) for step in range(40)])
    assert without_repeats(stairs) is stairs
    # only one of the two pieces is repeated two pieces later: no whole lap
    again = _chain([(0.0, 0.0), (9.0, 0.0), (0.0, 0.0), (9.0, 0.0), (9.0, 5.0)])
    assert without_repeats(again) is again
    whole = without_repeats(_chain([(0.0, 0.0), (9.0, 0.0), (0.0, 0.0), (9.0, 0.0), (0.0, 0.0), (0.0, 5.0)]))
    assert whole.points.tolist() == [[0.0, 0.0], [9.0, 0.0], [0.0, 0.0], [0.0, 5.0]]


def test_arcs_with_another_direction_or_center_are_different_pieces() -> None:
    both_ways = _chain([(0.0, 0.0)] * 3, [1, -1])
    assert without_repeats(both_ways) is both_ways
    circles = _chain([(0.0, 0.0)] * 5, [1] * 4)
    assert without_repeats(circles).numbers.tolist() == [1.0]
    centers = circles.centers + np.arange(4.0)[:, None] * (1.0, 0.0)
    shifted = Path.of(circles.points, centers, circles.turns)
    assert without_repeats(shifted) is shifted


def test_passes_within_passes_are_reduced() -> None:
    inner, outer = [(1.0, 0.0), (1.0, 1.0), (0.0, 0.0)], [(0.0, 9.0), (0.0, 0.0)]
    reduced = without_repeats(_chain([(0.0, 0.0), *(inner * 5 + outer) * 6]))
    assert reduced.numbers.tolist() == [1.0, 2.0, 3.0, 16.0, 17.0]


def test_passes_that_differ_by_rounding_are_repeated_passes() -> None:
    steps = [(0.1, 0.2), *((x / 3.0, y / 7.0) for x, y in STEPS * 50)]
    points = np.vstack((np.cumsum(steps, axis=0), [(-5.0, 0.0)]))
    assert len(np.unique(points[:-1], axis=0)) > 4
    reduced = without_repeats(_chain([tuple(point) for point in points.tolist()]))
    assert reduced.numbers.tolist() == [1.0, 2.0, 3.0, 4.0, 201.0]
    assert np.array_equal(reduced.points[:5], points[:5])
    # the center of a line is its start
    assert np.array_equal(reduced.centers, reduced.points[:-1])


def test_a_full_circle_stays_full_when_rounding_moves_its_start() -> None:
    """If one of its two equal points moved by the last digit, the circle would become empty or nearly full."""
    lap = [(0.0, 30.0), (40.0, 30.0), (0.0, 0.0)]
    near = [(0.0, 30.0), (40.0, 30.0), (ON_PATH / 10.0, 0.0)]
    corners = [(0.0, 0.0), *lap, *near, near[-1], (9.0, 9.0)]
    path = _chain(corners, [0] * 6 + [1] + [0])
    reduced = without_repeats(path)
    assert np.abs(reduced.sweeps).max() == np.abs(path.sweeps).max() == 2.0 * np.pi


def test_an_arc_without_length_does_not_become_a_full_circle() -> None:
    points = [(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (ON_PATH / 10.0, 0.0), (ON_PATH / 10.0, 0.0)]
    centers = np.full((4, 2), (2.0, 0.0))
    path = Path.of(np.array(points), centers, np.full(4, -1, np.int8))
    assert np.abs(without_repeats(path).sweeps).min() < 1e-6


def test_paths_with_invalid_numbers_are_not_changed() -> None:
    for bad in (np.nan, np.inf, 1e300):
        path = _chain([(0.0, 0.0), (bad, 0.0), (0.0, 0.0), (bad, 0.0), (0.0, 0.0)])
        assert without_repeats(path) is path


corner = st.tuples(st.integers(0, 4), st.integers(0, 4)).map(lambda at: (4.0 * at[0], 4.0 * at[1]))
pieces = st.lists(st.tuples(corner, st.sampled_from((0, 0, 0, 1, -1))), min_size=1, max_size=4)
block = st.tuples(pieces, st.integers(1, 5))


@st.composite
def lapped(draw: st.DrawFn) -> Path:
    """Blocks of moves, some repeated: each is closed after its first move, since it ends where that move began.

    A move may run differently from the same move in other laps.
    """
    blocks = draw(st.lists(block, min_size=1, max_size=4))
    way = [piece for moves, times in blocks for piece in moves * times]
    for row in draw(st.lists(st.integers(0, len(way) - 1), max_size=2)):
        way[row] = (way[row][0], draw(st.sampled_from((0, 1, -1))))
    return _chain([draw(corner), *(at for at, _ in way)], [turn for _, turn in way])


def _values(verdict: Verdict) -> tuple[object, ...]:
    """The values that do not depend on repetition: overlapping laps cross, which leaves sides unknown."""
    uncut = {(*np.round(stretch.thickest, 6), round(stretch.thickness, 6)) for stretch in verdict.uncut}
    thickest = max((stretch[2] for stretch in uncut), default=0.0)
    return verdict.judged, round(verdict.clearance, 9), thickest


def _gouging(surface: Path, radius: float, center: Path) -> set[tuple[float, float]]:
    """The places of the center path within gouges: the verdict joins a gouge over several laps into one."""
    with np.errstate(all="ignore"):
        walls, moves = piece_arrays(surface), piece_arrays(center)
        pairs = pairs_of(moves, walls, rounding_of(walls))
        stretches = gouging(pairs, radius - GOUGE).intervals
    piece, t = np.divmod(np.arange(SHARES * len(moves)), SHARES)
    s = pairs.stations[piece] + (t + 0.5) / SHARES * moves.length[piece]
    inside = (s[:, None] > stretches.first + 1e-5) & (s[:, None] < stretches.last - 1e-5)
    points = at(moves.take(piece), (t + 0.5) / SHARES)[inside.any(axis=1)]
    return set(zip((points.real.round(6) + 0.0).tolist(), (points.imag.round(6) + 0.0).tolist(), strict=True))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(lapped(), lapped(), st.sampled_from((Side.LEFT, Side.RIGHT)), st.sampled_from((1.0, 2.0, 3.0)))
def test_the_verdict_equals_that_on_all_passes(surface: Path, shape: Path, side: Side, radius: float) -> None:
    moved = shape.points * 1.1 - 3.0
    center = Path.of(moved, shape.centers * 1.1 - 3.0, shape.turns)
    whole = judge(surface, side, radius, center)
    once = judge(without_repeats(surface), side, radius, without_repeats(center))
    assert _values(once) == _values(whole)
    assert _gouging(without_repeats(surface), radius, without_repeats(center)) == _gouging(surface, radius, center)
    assert once.depth >= whole.depth - 1e-9
    assert once.depth <= whole.depth + 1e-9 or once.crosses_itself < whole.crosses_itself
    # on a surface that crosses itself, laps decide how much of it is an over-run, which has no side
    assert once.wrong_side or once.crosses_itself or not whole.wrong_side
    kept = {tuple(point) for point in without_repeats(surface).points.tolist()}
    assert kept == {tuple(point) for point in surface.points.tolist()}
