"""Laws that hold on every control: mirrored, shifted, scaled and turned programs give mirrored, shifted ... moves."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest

from core.controls.compensation.element_queue import NO_FIT
from core.controls.control_run import ControlRun
from core.controls.judging.judged_runs import judge_run
from core.controls.moves import Moves, Plane
from tests.core.controls.hand import run_of
from tests.core.controls.programs import RADIUS, program, turned_to_zx

CONTROLS = [
    "rosettacnc:nist",
    "rosettacnc:easy",
    "rosettacnc:normal",
    "nine-series:a",
    "nine-series:b",
    "nine-series:b-g39.1",
    "linuxcnc",
]
SEEDS = range(60)


@cache
def text(seed: int) -> str:
    """A random program that every control can read: no G41.1."""
    return re.sub(r"(G4[12])\.1 D-?[0-9.]+", r"\1 D1", program(seed)).replace("M2", "M30")


@cache
def run(source: str, control: str, diameter: float = 2 * RADIUS) -> ControlRun:
    return run_of(source, control, t1=diameter)


def mirrored(source: str) -> str:
    """The program with Y the other way round."""
    swapped = {"G2": "G3", "G3": "G2", "G41": "G42", "G42": "G41"}
    source = re.sub(r"\b(?:G2|G3|G41|G42)\b", lambda found: swapped[found[0]], source)
    return re.sub(r"([YJ])(-?)(\d)", lambda found: found[1] + ("" if found[2] else "-") + found[3], source)


def agree(one: Moves, other: Moves, *, turns: int = 1) -> bool:
    """Whether two lists of moves are the same but for rounding, arcs turned alike or (-1) the other way."""
    if len(one) != len(other):
        return False
    near = np.allclose(one.points, other.points, atol=1e-5) and np.allclose(one.centers, other.centers, atol=1e-5)
    kinds = bool(np.all(one.turns == turns * other.turns) and np.all(one.rapid == other.rapid))
    return near and kinds and bool(np.all(one.lines == other.lines))


def changed(moves: Moves, scale: tuple[float, float, float], shift: tuple[float, float, float] = (0, 0, 0)) -> Moves:
    """Moves with every axis scaled and shifted; the start point stays."""
    points, centers = moves.points * scale + shift, moves.centers * scale + shift
    points[0], centers[0] = moves.points[0], moves.centers[0]
    return Moves(points, centers, moves.turns.copy(), moves.planes.copy(), moves.rapid, moves.feeds, moves.lines)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_mirrored_program_gives_mirrored_moves(control: str) -> None:
    for seed in SEEDS:
        there, back = run(text(seed), control), run(mirrored(text(seed)), control)
        assert there.stopped_at == back.stopped_at, seed
        assert agree(changed(there.moves, (1, -1, 1)), back.moves, turns=-1), seed


@pytest.mark.parametrize("control", CONTROLS)
def test_a_shifted_origin_shifts_the_moves(control: str) -> None:
    for seed in SEEDS:
        here, there = run(text(seed), control), run(f"G21\n{text(seed)}", control)
        moved = run(f"G21 G52 X700 Y-300\n{text(seed)}", control)
        assert here.moves.points.tolist() == there.moves.points.tolist()
        assert agree(changed(there.moves, (1, 1, 1), (700, -300, 0)), moved.moves), seed


def by_its_unit(done: ControlRun) -> bool:
    """Whether LinuxCNC's rule stops the run that lets an arc grow further in millimeters than in inches."""
    return done.findings[-1].text == NO_FIT


@pytest.mark.parametrize("control", CONTROLS)
def test_the_same_program_in_inches_gives_the_same_moves_larger(control: str) -> None:
    for seed in SEEDS:
        metric, inch = run(text(seed), control), run(text(seed).replace("G21", "G20"), control)
        assert metric.stopped_at == inch.stopped_at or by_its_unit(inch), seed
        assert inch.stopped_at or agree(changed(metric.moves, (25.4, 25.4, 25.4)), inch.moves), seed


@pytest.mark.parametrize("control", CONTROLS)
def test_another_plane_gives_the_same_moves_in_it(control: str) -> None:
    for seed in SEEDS:
        flat, turned = run(text(seed), control), run(turned_to_zx(text(seed)), control)
        assert flat.stopped_at == turned.stopped_at, seed
        axes = list(Plane.ZX.axes)
        assert np.allclose(flat.moves.points, turned.moves.points[:, axes], atol=1e-6), seed
        assert flat.moves.turns.tolist() == turned.moves.turns.tolist()


@pytest.mark.parametrize("control", CONTROLS)
def test_radius_0_runs_as_programmed(control: str) -> None:
    for seed in SEEDS:
        done = run(text(seed), control, diameter=0)
        plain = run(re.sub(r"G4[12] D1\n", "", text(seed)), control)
        if done.stopped_at is None and plain.stopped_at is None:
            ours = {tuple(point) for point in np.round(done.moves.points, 4).tolist()}
            assert {tuple(point) for point in np.round(plain.moves.points, 4).tolist()} <= ours, seed


@pytest.mark.parametrize("control", ["rosettacnc:normal", "linuxcnc"])
def test_what_runs_with_look_ahead_touches_the_contour_or_is_reported(control: str) -> None:
    """The judge, which knows no control, finds every center path of whole length at the radius somewhere."""
    found = 0
    for seed in SEEDS:
        done = run(text(seed), control)
        for result in judge_run(done):
            if done.stopped_at is None and len(result.surface) and result.verdict.judged:
                assert result.verdict.clearance <= RADIUS * (1 + 1e-9), seed
                found += 1
    assert found > 5
