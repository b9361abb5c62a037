"""Calculates how long a block cuts and moves at rapid, from the moves that are posted.

A feed move takes its length divided by its programmed feed, a rapid its length divided by the rapid rate.
Acceleration, tool changes and overrides are not counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist, hypot, isfinite

from core.geometry.piece import Arc, Line, Turn
from core.output.passes import Job, Motion, at_one_safe_z, passes


@dataclass(frozen=True, slots=True)
class Times:
    """Minutes of cutting and of rapid moves; infinite if a feed is too slow for a number."""

    cut: float = 0.0
    rapid: float = 0.0

    @property
    def total(self) -> float:
        """Minutes of both together."""
        return self.cut + self.rapid

    def __add__(self, other: Times) -> Times:
        return Times(self.cut + other.cut, self.rapid + other.rapid)


def block_times(job: Job, rapid_rate: float) -> Times:
    """Return the times of a job that can be posted; `rapid_rate` in millimeters per minute."""
    runs = [a_pass.motions for a_pass in passes(job)]
    if not runs:
        return Times()
    high = Motion(runs[0][0].x, runs[0][0].y, job.safe_z), Motion(runs[-1][-1].x, runs[-1][-1].y, job.safe_z)
    between = [(before[-1], after[0]) for before, after in pairwise(runs)]
    joints = [(high[0], runs[0][0]), *between, (runs[-1][-1], high[1])]
    moves = [pair for run in runs for pair in pairwise(run)]
    rapid = [_travel(before, Motion(after.x, after.y, after.z)) for before, after in joints]
    rapid += [_travel(before, after) for before, after in moves if after.feed is None]
    cut = (_travel(before, after) / after.feed for before, after in moves if after.feed)
    return Times(sum(cut), sum(rapid) / rapid_rate if rapid_rate > 0.0 else 0.0)


def program_times(jobs: Sequence[Job], rapid_rate: float) -> Times:
    """Return the times of jobs posted together: of each block, and of the rapids between blocks at SAFE Z."""
    level = at_one_safe_z(jobs)
    runs = [[motion for a_pass in passes(job) for motion in a_pass.motions] for job in level]
    across = (dist((left[-1].x, left[-1].y), (met[0].x, met[0].y)) for left, met in pairwise(filter(None, runs)))
    rapid = sum(across) / rapid_rate if rapid_rate > 0.0 else 0.0
    return sum((block_times(job, rapid_rate) for job in level), Times(rapid=rapid))


def _travel(before: Motion, motion: Motion) -> float:
    """Return the length of a move in millimeters."""
    ends = (before.x, before.y), (motion.x, motion.y)
    straight = motion.turn is Turn.NONE
    piece = Line(*ends) if straight else Arc(*ends, motion.center, motion.turn)
    return hypot(piece.length, motion.z - before.z)


def times_text(times: Times) -> str:
    """Return cut, rapid and total in words, such as `cut 2:05, rapid 0:12, total 2:17 (min:s)`."""
    parts = ((name, getattr(times, name)) for name in ("cut", "rapid", "total"))
    return ", ".join(f"{name} {minutes_text(value)}" for name, value in parts)


def minutes_text(minutes: float) -> str:
    """Return minutes as `2:05` (minutes and seconds), from an hour on as `1:02:05`."""
    if not isfinite(minutes):
        return "-"
    seconds = round(60.0 * minutes)
    hours, rest = divmod(seconds, 3600)
    return f"{hours}:{rest // 60:02}:{rest % 60:02}" if hours else f"{rest // 60}:{rest % 60:02}"
