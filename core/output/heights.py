"""How high a run's pieces lie when segments climb or fall (Z END).

A segment's floor rises evenly with the part of the programmed line or arc that has been traveled.  A piece of a run
lies over the part of its segment that stands square to it, so a piece shortened at an inside corner begins and ends
at the height the drawing gives there; where two such heights differ, the tool moves straight up or down between them.
A corner arc keeps the height of its corner.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import tau
from typing import Final

import numpy as np

from core.geometry.path import Floats, Path
from core.output.job import Floor, Job, Run
from core.tolerance import JOINED

WRAPPED: Final = 1e-6
"""Radians by which rounding may put an arc's first point before its segment's first point."""


def level_floor(job: Job) -> bool:
    """No segment rises above Z BOTTOM."""
    return all(max(low, high) <= job.z_bottom + JOINED for low, high, _ in job.levels)


def heights(job: Job, run: Run) -> Floats:
    """(n, 2) height of the floor under both ends of each piece of `run.whole`.

    The blend-in lies as high as the path's first point, the blend-out as its last; an overlap past the start is lifted
    where the segment below it is higher.
    """
    if level_floor(job):
        return np.full((len(run.whole), 2), job.z_bottom)
    path = _along(job, run.path)
    lead_in = np.full((len(run.lead_in), 2), path[0, 0])
    lead_out = np.maximum(_along(job, run.lead_out), path[-1, 1])
    return np.concatenate((lead_in, path, lead_out))


@dataclass(frozen=True, eq=False, slots=True)
class _Ground:
    """The programmed contour: its floors and the row of each segment by number, and the arcs' angles."""

    surface: Path
    floors: dict[int, Floor]
    rows: dict[int, int]
    sweeps: Floats


def _along(job: Job, path: Path) -> Floats:
    rows = {int(number): row for row, number in enumerate(job.surface.numbers.tolist())}
    ground = _Ground(job.surface, {floor.number: floor for floor in job.floors}, rows, np.abs(job.surface.sweeps))
    sweeps = np.abs(path.sweeps).tolist()
    found = [_ends(path, piece, sweep, ground) for piece, sweep in enumerate(sweeps)]
    return np.array(found).reshape(-1, 2)


def _ends(path: Path, piece: int, sweep: float, ground: _Ground) -> tuple[float, float]:
    """Heights at a piece's two ends; no height at all for a piece of no segment."""
    number = float(path.numbers[piece])
    floor, row = ground.floors.get(int(number)), ground.rows.get(int(number))
    if floor is None:
        return -np.inf, -np.inf
    if number != int(number) or row is None:
        return floor.z_end, floor.z_end
    first, last = _fractions(path.points[piece : piece + 2], sweep, ground, row)
    rise = floor.z_end - floor.z_start
    return floor.z_start + first * rise, floor.z_start + last * rise


def _fractions(ends: Floats, sweep: float, ground: _Ground, row: int) -> tuple[float, float]:
    """Which part of the segment has been traveled at a piece's two ends, 0 to 1; `sweep` is the piece's own angle."""
    surface = ground.surface
    if surface.turns[row] == 0:
        run = surface.ends[row] - surface.starts[row]
        square = max(float(run @ run), np.finfo(float).tiny)
        first, last = ((ends - surface.starts[row]) @ run / square).tolist()
        return _held(first), _held(last)
    whole, begun = float(ground.sweeps[row]), _turned(surface, row, ends[0])
    return _held(begun / whole), _held((begun + sweep) / whole)


def _turned(surface: Path, row: int, point: Floats) -> float:
    """Radians from the arc's start to the ray through `point`, in the arc's direction."""
    center, start = surface.centers[row], surface.starts[row]
    angles: Floats = np.arctan2(*(np.array((start, point)) - center).T[::-1])
    turned = float((angles[1] - angles[0]) * surface.turns[row]) % tau
    return 0.0 if turned > tau - WRAPPED else turned


def _held(part: float) -> float:
    return min(max(part, 0.0), 1.0)
