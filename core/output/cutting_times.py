"""Calculates how long a block cuts and moves at rapid, from the moves that are posted.

A feed move takes its length divided by its programmed feed, a rapid its length divided by the rapid rate.
Acceleration, tool changes and overrides are not counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, isfinite

from core.controls.write.contour_pass import CenterMove
from core.geometry.piece import Arc, Line, Turn
from core.output.passes import Job, at_one_safe_z, passes


@dataclass(frozen=True, slots=True)
class Times:
    """Minutes of cutting and of rapid moves; infinite if a feed is too slow for a number."""

    cut: float = 0.0
    rapid: float = 0.0

    @property
    def total(self) -> float:
        """Minutes of both together."""
        return self.cut + self.rapid


def block_times(job: Job, rapid_rate: float) -> Times:
    """Return the times of a job that can be posted; `rapid_rate` in millimeters per minute."""
    return _times(_motions(job), rapid_rate)


def program_times(jobs: Sequence[Job], rapid_rate: float) -> Times:
    """Return the times of jobs posted together: of each block, and of the rapids between blocks at SAFE Z."""
    return _times([motion for job in at_one_safe_z(jobs) for motion in _motions(job)], rapid_rate)


def _motions(job: Job) -> list[CenterMove]:
    """Return the motions of a job, from SAFE Z down to its first plunge point and back up from its last point."""
    motions = [motion for a_pass in passes(job) for motion in a_pass.motions]
    ends = [CenterMove(end.x, end.y, job.safe_z) for end in (*motions[:1], *motions[-1:])]
    return [*ends[:1], *motions, *ends[1:]]


def _times(motions: Sequence[CenterMove], rapid_rate: float) -> Times:
    moves = list(pairwise(motions))
    rapid = sum(_travel(*move) for move in moves if move[1].feed is None)
    cut = sum(_travel(*move) / move[1].feed for move in moves if move[1].feed)
    return Times(cut, rapid / rapid_rate if rapid_rate > 0.0 else 0.0)


def _travel(before: CenterMove, motion: CenterMove) -> float:
    """Return the length of a move in millimeters."""
    ends = (before.x, before.y), (motion.x, motion.y)
    piece = Arc(*ends, motion.center, Turn(motion.turn)) if motion.turn else Line(*ends)
    return hypot(piece.length, motion.z - before.z)


def times_text(times: Times) -> str:
    """Return cut, rapid and total in words, such as `cut 2:05, rapid 0:12, total 2:17 (min:s)`."""
    cut, total = (round(60.0 * value, 0) / 60.0 for value in (times.cut, times.total))
    # not rounded on its own, so that cut and rapid add up to the total
    rapid = total - cut
    return f"cut {minutes_text(cut)}, rapid {minutes_text(rapid)}, total {minutes_text(total)}"


def minutes_text(minutes: float) -> str:
    """Return minutes as `2:05` (minutes and seconds), from an hour on as `1:02:05`."""
    if not isfinite(minutes):
        return "-"
    seconds = round(60.0 * minutes)
    hours, rest = divmod(seconds, 3600)
    return f"{hours}:{rest // 60:02}:{rest % 60:02}" if hours else f"{rest // 60}:{rest % 60:02}"
