"""How high a run's pieces lie when segments climb or fall (Z END).

A segment's floor rises evenly with the part of the programmed line or arc that has been travelled.  A piece of a run
lies over the part of its segment that stands square to it, so a piece shortened at an inside corner begins and ends
at the height the drawing gives there; where two such heights differ, the tool moves straight up or down between them.
A corner arc keeps the height of its corner.
"""

from __future__ import annotations

from math import tau

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Floats, Path
from core.output.job import Floor, Job, Run
from core.tolerance import JOINED

WRAPPED = 1e-6
"""Radians by which rounding may put an arc's first point before its segment's first point."""


def level_floor(job: Job) -> bool:
    """No segment rises above Z BOTTOM."""
    return all(max(floor.z_start, floor.z_end) <= job.z_bottom + JOINED for floor in job.floors)


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


def _along(job: Job, path: Path) -> Floats:
    floors = {floor.number: floor for floor in job.floors}
    rows = {int(number): row for row, number in enumerate(job.surface.numbers.tolist())}
    found = [_ends(path, piece, floors, rows, job.surface) for piece in range(len(path))]
    return np.array(found).reshape(-1, 2)


def _ends(path: Path, piece: int, floors: dict[int, Floor], rows: dict[int, int], surface: Path) -> tuple[float, float]:
    number = float(path.numbers[piece])
    floor = floors.get(int(number))
    if floor is None:
        return -np.inf, -np.inf
    if number != int(number) or int(number) not in rows:
        return floor.z_end, floor.z_end
    first, last = _fractions(path, piece, surface, rows[int(number)])
    rise = floor.z_end - floor.z_start
    return floor.z_start + first * rise, floor.z_start + last * rise


def _fractions(path: Path, piece: int, surface: Path, row: int) -> tuple[float, float]:
    """Which part of the segment has been travelled at a piece's start and end, 0 to 1."""
    if surface.turns[row] == 0:
        run = surface.ends[row] - surface.starts[row]
        square = max(float(run @ run), np.finfo(float).tiny)
        first, last = ((point - surface.starts[row]) @ run / square for point in path.points[piece : piece + 2])
        return _held(float(first)), _held(float(last))
    sweep = abs(float(surface.part(row, row + 1).sweeps[0]))
    begun = _turned(surface, row, path.starts[piece])
    travelled = abs(float(path.part(piece, piece + 1).sweeps[0]))
    return _held(begun / sweep), _held((begun + travelled) / sweep)


def _turned(surface: Path, row: int, point: Floats) -> float:
    """Radians from the arc's start to the ray through `point`, in the arc's direction."""
    centre, start = surface.centres[row], surface.starts[row]
    angles: NDArray[np.float64] = np.arctan2(*(np.array((start, point)) - centre).T[::-1])
    turned = float((angles[1] - angles[0]) * surface.turns[row]) % tau
    return 0.0 if turned > tau - WRAPPED else turned


def _held(part: float) -> float:
    return min(max(part, 0.0), 1.0)
