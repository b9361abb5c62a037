"""Drilling cycles and the feeds of G93 and G95 against LinuxCNC's interpreter and hand calculations."""

from __future__ import annotations

from pathlib import Path

import pytest

from core.controls.control_run import ControlRun
from core.finding import Severity
from core.units import Unit, from_mm
from tests.core.controls.compare_rs274 import outcome
from tests.core.controls.cycle_programs import drilled, timed
from tests.core.controls.hand import findings_of, run_of
from tests.rs274 import WITNESS

needs_witness = pytest.mark.skipif(WITNESS is None, reason="LinuxCNC's rs274 is not installed")


@needs_witness
@pytest.mark.parametrize("kind", [drilled, timed])
def test_random_programs_match_the_interpreter(kind, tmp_path: Path) -> None:
    results = []
    for seed in range(50):
        text = kind(seed)
        results.append((seed, *outcome(text, tmp_path, {1: 0.5}, Unit.MM if "G21" in text else Unit.IN)))
    assert not [result for result in results if not result[1].startswith(("same moves", "both refuse"))]
    assert sum(result[1] == "same moves" for result in results) >= 8


def heights(run: ControlRun) -> list[tuple[str, float]]:
    """Every move as rapid or feed with its Z end in program units."""
    return [
        ("rapid" if move.rapid else "feed", round(from_mm(move.point[2], run.unit), 6))
        for move in run.moves
        if move.line > 2
    ]


@pytest.mark.parametrize("control", ["rosettacnc", "nine-series"])
def test_a_hole_returns_to_the_initial_height(control: str) -> None:
    run = run_of("G21 F100\nG0 Z5\nG81 X1 Z-2 R1\n", control)
    assert heights(run) == [("rapid", 5), ("rapid", 1), ("feed", -2), ("rapid", 5)]


@pytest.mark.parametrize("control", ["rosettacnc", "nine-series"])
def test_g99_returns_to_r_and_pecks_retract(control: str) -> None:
    run = run_of("G21 F100\nG0 Z5\nG99 G83 X1 Z-2 R1 Q2\n", control)
    assert heights(run) == [
        ("rapid", 5),
        ("rapid", 1),
        ("feed", -1),
        ("rapid", 1),
        ("rapid", -0.746),
        ("feed", -2),
        ("rapid", 1),
    ]


def test_an_incremental_cycle_repeats_along_a_row() -> None:
    run = run_of("G21 F100\nG0 Z5\nG91 G81 X3 Z-2 R-4 L3\n", "nine-series")
    assert [(move.point[0], move.point[2]) for move in run.moves if not move.rapid] == [(3, -1), (6, -1), (9, -1)]


@pytest.mark.parametrize(
    ("control", "rule"), [("linuxcnc", "N-CYCLE"), ("rosettacnc:easy", "C8"), ("nine-series", "CYCLE")]
)
def test_a_cycle_under_compensation_is_refused(control: str, rule: str) -> None:
    run = run_of("G21 G17 G1 F100\nG41 D1\nG1 X10\nX20 Y-5\nG81 X30 Z-2 R1\n", control, t1=6)
    assert [finding.line for finding in findings_of(run, rule)] == [5]
    assert run.stopped_at == 5


def test_compensation_during_a_cycle_is_refused() -> None:
    run = run_of("G21 F100\nG81 X1 Z-1 R1\nG41 D1\nX30\nM2\n", "linuxcnc", t1=6)
    assert run.stopped_at == 4


def test_only_the_positions_of_threeblock_cycles_are_followed() -> None:
    run = run_of("G70F9.\nG0Z1.\nG81X2.Z-1.R.1\n", "threeblock")
    assert heights(run) == [("rapid", 1)]
    assert findings_of(run, "CYCLE")[0].severity is Severity.WARNING


def test_an_inverse_time_feed_uses_the_programmed_length() -> None:
    run = run_of("G21\nG93 G1 X3 Y4 F2\nG3 X3 Y4 I1 F1\nG94 G1 X0 F7\n", "nine-series")
    assert [move.feed for move in run.moves if move.line] == pytest.approx([10, 6.283185307, 7])


def test_an_inverse_time_feed_is_required_in_every_block() -> None:
    run = run_of("G21\nG93 G1 X3 F2\nX5\n", "nine-series")
    assert [finding.line for finding in findings_of(run, "FEED")] == [3]
    assert run.stopped_at == 3


def test_a_feed_per_revolution_uses_the_spindle_speed() -> None:
    run = run_of("G20 S500 M3\nG95 G1 X3 F.01\n", "rosettacnc")
    assert [from_mm(move.feed, Unit.IN) for move in run.moves if move.line] == pytest.approx([5])


@pytest.mark.parametrize("start", ["", "G96 S200"])
def test_a_feed_per_revolution_without_a_spindle_speed_is_unknown(start: str) -> None:
    run = run_of(f"G20 {start}\nG95 G1 X3 F.01\n", "nine-series")
    assert [move.feed for move in run.moves if move.line] == [0]
    assert [finding.line for finding in findings_of(run, "FEED")] == [2]


@pytest.mark.parametrize("line", ["G00 G17 G40 G49 G80 G90", "G80 G0 G90", "G0 G80 X0 Y0"])
@pytest.mark.parametrize("control", ["threeblock", "rosettacnc", "nine-series", "linuxcnc"])
def test_a_safety_line_with_g80_runs_on_every_iso_control(control: str, line: str) -> None:
    run = run_of(f"G20 F9.\n{line}\nX1.\nM2\n", control)
    assert run.stopped_at is None
    assert [move.rapid for move in run.moves][-1]


def test_g80_restores_the_motion_before_the_cycle_on_the_nine_series() -> None:
    run = run_of("G20 F9.\nG1 X1.\nG80 X2.\nG81 X3. Z-1. R.1\nG80\nX4.\nM2\n", "nine-series")
    assert [(move.line, move.rapid) for move in run.moves if move.line in (3, 6)] == [(3, False), (6, False)]


@pytest.mark.parametrize("line", ["G80 G81 X1. Z-1. R.1", "G0 G81 X1. Z-1. R.1", "G80 G80"])
def test_two_motion_codes_in_one_block_stop_the_nine_series(line: str) -> None:
    run = run_of(f"G20 F9.\n{line}\nM2\n", "nine-series")
    assert [finding.line for finding in findings_of(run, "GROUP")] == [2]
