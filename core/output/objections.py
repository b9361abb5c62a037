"""Objections: the findings that forbid posting, and which of them an operator may override in so many words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import isfinite
from typing import Final

import numpy as np

from core.finding import Finding, Severity
from core.output.grid import Grid, feed_text
from core.output.passes import Job, Run, rough_runs
from core.tolerance import JOINED, LARGEST

OVERRIDE: Final = "POST WITH GOUGE"
"""What an operator must say, word for word, to have a path posted that the verdict is against."""

OVERRIDABLE: Final = frozenset({"GOUGE", "BLEND_GOUGES", "ROUGH_GOUGES", "WRONG_SIDE"})
"""Findings on a path that is whole and known; whatever is unread, missing or undetermined can not be overridden."""

MAX_LISTED: Final = 6
"""Segments named in one sentence."""

MAX_PECKS: Final = 2000
"""More depths than this are a slip of the finger in PECK DEPTH."""


def posting_errors(jobs: Sequence[Job], grid: Grid, *, override: str | None) -> tuple[Finding, ...]:
    """The errors that stand against posting, each named once; those the operator overrode are left out."""
    errors: list[Finding] = []
    for job in jobs:
        errors += (*job.errors, *job_errors(job, grid))
    if len({job.work_offset for job in jobs}) > 1:
        errors.append(Finding("WORK_OFFSET", Severity.ERROR, "The blocks name different work offsets."))
    if override == OVERRIDE:
        errors = [finding for finding in errors if finding.code not in OVERRIDABLE]
    return tuple(dict.fromkeys(errors))


def job_errors(job: Job, grid: Grid) -> Iterator[Finding]:
    """What is wrong with a job and none of its errors tells: about a field that has none, and a path that is due."""
    errors = job.errors
    named = {finding.field for finding in errors}
    for objection in _objections(job, grid):
        due = objection.code == "NO_PATH" and any(finding.code not in OVERRIDABLE for finding in errors)
        if not due and (objection.field is None or objection.field not in named) and objection not in errors:
            yield objection


def overridden_errors(jobs: Iterable[Job]) -> tuple[Finding, ...]:
    """The errors that stand and may be overridden."""
    return tuple(finding for job in jobs for finding in job.errors if finding.code in OVERRIDABLE)


def _objections(job: Job, grid: Grid) -> Iterator[Finding]:
    """What is wrong with the job itself, whoever made it."""
    for wrong, code, text, name in (*_tools(job), *_depths(job), *_numbers(job), *_paths(job, grid)):
        if wrong:
            yield Finding(code, Severity.ERROR, f"Block {job.block}: {text}", field=name)


_Check = tuple[bool, str, str, str | None]


def _tools(job: Job) -> Iterator[_Check]:
    missing = "is not in the tool table.  Enter it in TOOL SETUP."
    yield job.cutter is None, "TOOL_MISSING", f"TOOL {missing}", "tool"
    yield bool(job.finish_tool) and job.finisher is None, "TOOL_MISSING", f"FINISH TOOL {missing}", "finish_tool"
    for cutter in (job.cutter, job.finisher):
        if cutter is not None:
            bad = not (isfinite(cutter.diameter) and cutter.diameter > 0.0)
            yield bad, "TOOL_DIAMETER", f"The diameter of tool {cutter.number} must be above 0.", "tool"
            yield not 1 <= cutter.number <= 99999, "TOOL_NUMBER", "Tool numbers go from 1 to 99999.", "tool"


def _depths(job: Job) -> Iterator[_Check]:
    stock = job.finish_z if job.finish_tool else 0.0
    deep = job.z_start - job.z_bottom
    levels = [height for low, high, _ in job.levels for height in (low, high)]
    high, low = max(levels, default=job.z_start), min(levels, default=job.z_bottom)
    yield deep < 0.0, "DEPTH", "Z BOTTOM lies above Z START.", "z_bottom"
    yield low < job.z_bottom - JOINED, "Z_END", "A Z END lies below Z BOTTOM.  No pass goes so deep.", "z_end"
    above = deep >= 0.0 and high > job.z_start + JOINED
    yield above, "Z_END", "A Z END lies above Z START.  Rapid moves would run into it.", "z_end"
    yield stock >= deep > 0.0, "FINISH_Z", "FINISH Z leaves nothing for the roughing tool to cut.", "finish_z"
    yield job.retract_clearance <= 0.0, "CLEARANCE", "RETRACT CLEARANCE must be above 0.", "retract_clearance"
    yield job.peck_clearance < 0.0, "CLEARANCE", "PECK CLEARANCE must not be below 0.", "peck_clearance"
    yield job.peck_depth < 0.0, "PECK_DEPTH", "PECK DEPTH must not be below 0.", "peck_depth"
    too_many = job.peck_depth > 0.0 and deep > MAX_PECKS * job.peck_depth
    yield too_many, "PECK_DEPTH", f"PECK DEPTH makes more than {MAX_PECKS} passes.", "peck_depth"


def _numbers(job: Job) -> Iterator[_Check]:
    given = (
        job.z_start,
        job.z_bottom,
        job.peck_depth,
        job.finish_z,
        job.retract_clearance,
        job.peck_clearance,
        job.plunge_feed,
        job.speed,
        job.safe_z,
        *(value or 0.0 for level in job.levels for value in level),
    )
    sane = all(isfinite(value) and abs(value) <= LARGEST for value in given)
    yield not sane, "NUMBER", "A depth, feed or speed is no number a machine could have.", None
    yield not 54 <= job.work_offset <= 59, "WORK_OFFSET", "WORK OFFSET goes from 54 to 59.", "work_offset"
    yield job.speed <= 0.0, "SPEED", "SPEED must be above 0.", "speed"


def _paths(job: Job, grid: Grid) -> Iterator[_Check]:
    nothing = not any(len(run.path) for run in job.finish)
    yield nothing, "NO_PATH", "There is no path to post: the cutter fits nowhere, or the contour is not known.", None
    unroughed = job.finisher is not None and not any(len(run.path) for run in rough_runs(job))
    yield (
        unroughed,
        "NO_ROUGH_PATH",
        "The roughing tool has no path, so the finish tool would cut solid.",
        "finish_tool",
    )
    wild = not all(_reachable(run) for run in (*job.finish, *job.rough))
    yield wild, "COORDINATE", "A point of the path is none a machine could reach.", None
    yield _stands_still(job.plunge_feed, grid), "PLUNGE_FEED", "PLUNGE FEED must be above 0.", "plunge_feed"
    unfed = sorted(_unfed(job, grid))
    listed = ", ".join(map(str, unfed[:MAX_LISTED])) + (" ..." if len(unfed) > MAX_LISTED else "")
    yield (
        bool(unfed),
        "FEED",
        f"There is no FEED above 0 on {'segment' if len(unfed) == 1 else 'segments'} {listed}.",
        "feed",
    )


def _reachable(run: Run) -> bool:
    parts = [part for part in (run.lead_in, run.path, run.lead_out) if len(part)]
    if not parts:
        return True
    places = np.concatenate([array for part in parts for array in (part.points, part.centers)])
    # a comparison with what is no number is false
    return bool(places.min() >= -LARGEST and places.max() <= LARGEST)


def _stands_still(feed: float, grid: Grid) -> bool:
    return not isfinite(feed) or feed <= 0.0 or float(feed_text(feed, grid)) == 0.0


def _unfed(job: Job, grid: Grid) -> set[int]:
    """Segments that some run cuts without a feed."""
    moving = {
        feed for feed in {feed for _, _, feed in job.levels} if feed is not None and not _stands_still(feed, grid)
    }
    fed = {floor.number for floor in job.floors if floor.feed in moving}
    numbers = [run.path.numbers for run in (*job.finish, *job.rough)]
    used = set(np.floor(np.concatenate(numbers)).astype(int).tolist()) if numbers else set()
    return used - fed
