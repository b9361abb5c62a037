"""Steps in Z: where the posted path goes straight up or down between two of its moves.

A segment that climbs or falls and of which a blend arc, an inside corner or the look-ahead takes the end leaves its
neighbors at different heights; so does a Z END on a segment without length.  The tool then plunges with its whole
width, which an end mill that does not cut at its center cannot.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from core.finding import Finding, Severity
from core.output.heights import heights, level_floor
from core.output.job import Job
from core.tolerance import CLOSED


class _Step(NamedTuple):
    """How far a step goes, up if positive, the number of the segment behind it, and where."""

    rise: float
    number: float
    at: tuple[float, float]


def step_findings(job: Job) -> tuple[Finding, ...]:
    """The deepest and the highest step of a job's finish paths, each a warning that tells how many there are."""
    if level_floor(job):
        return ()
    steps = _steps(job)
    falls = sorted(step for step in steps if step.rise < 0.0)
    rises = sorted((step for step in steps if step.rise > 0.0), reverse=True)
    return (*_told(falls, "down"), *_told(rises, "up"))


def _steps(job: Job) -> list[_Step]:
    found = []
    for run in job.finish:
        first, count = len(run.lead_in), len(run.path)
        ends = heights(job, run)[first : first + count]
        rise = ends[1:, 0] - ends[:-1, 1]
        for row in np.flatnonzero(np.abs(rise) > CLOSED).tolist():
            x, y = run.path.points[row + 1].tolist()
            found.append(_Step(float(rise[row]), float(run.path.numbers[row + 1]), (x, y)))
    return found


def _told(steps: list[_Step], way: str) -> tuple[Finding, ...]:
    if not steps:
        return ()
    rise, number, at = steps[0]
    more = f" There are {len(steps)} such places." if len(steps) > 1 else ""
    text = f"The tool goes straight {way} {{value}} at X {{x}} Y {{y}}: the slope of a Z END is cut off there.{more}"
    return (Finding("Z_STEP", Severity.WARNING, text, number, "z_end", at, abs(rise)),)
