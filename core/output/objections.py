"""Finds what forbids posting, and which of it the operator may override."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import isfinite
from typing import Final, NamedTuple

import numpy as np

from core.finding import Finding, Severity
from core.output.grid import Grid, feed_text
from core.output.passes import Job, rough_runs
from core.tolerance import JOINED, LARGEST_COORDINATE

OVERRIDE_PHRASE: Final = "POST WITH GOUGE"
"""What an operator must type to post a path that gouges."""

OVERRIDABLE_CODES: Final = frozenset({"GOUGE", "BLEND_GOUGES", "ROUGH_GOUGES", "WRONG_SIDE"})
"""Findings on a path that is whole and known; what is unread, missing or undetermined cannot be overridden."""

MAX_LISTED: Final = 6
"""Most segments named in one sentence."""

MAX_PECKS: Final = 2000
"""More depths than this are a typing mistake in PECK DEPTH."""


def posting_errors(jobs: Sequence[Job], grid: Grid, *, override: str | None) -> tuple[Finding, ...]:
    """Return the errors that forbid posting, each once, without those that the operator overrode."""
    errors = [] if jobs else [Finding("NO_BLOCK", Severity.ERROR, "There is no block to post.")]
    for job in jobs:
        errors += [replace(finding, block=job.block) for finding in (*job.errors, *job_errors(job, grid))]
    if len({job.work_offset for job in jobs}) > 1:
        errors.append(Finding("WORK_OFFSET", Severity.ERROR, "The blocks name different work offsets."))
    if override == OVERRIDE_PHRASE:
        errors = [finding for finding in errors if finding.code not in OVERRIDABLE_CODES]
    return tuple(dict.fromkeys(errors))


def job_errors(job: Job, grid: Grid) -> Iterator[Finding]:
    """Yield what is wrong with a job that its errors do not name: a field without an error, a path without a cause."""
    errors = job.errors
    fields = {finding.field for finding in errors}
    explained = any(finding.code not in OVERRIDABLE_CODES for finding in errors)
    for check in (*_tools(job), *_depths(job), *_numbers(job), *_paths(job, grid)):
        if not check.failed:
            continue
        objection = Finding(check.code, Severity.ERROR, check.text, field=check.field)
        field_named = check.field is not None and check.field in fields
        if not (objection in errors or field_named or (check.code == "NO_PATH" and explained)):
            yield objection


def overridable_errors(jobs: Iterable[Job]) -> tuple[Finding, ...]:
    """Return the errors of the jobs that `OVERRIDE_PHRASE` may waive."""
    return tuple(finding for job in jobs for finding in job.errors if finding.code in OVERRIDABLE_CODES)


class _Check(NamedTuple):
    """One condition of posting: whether it `failed`, and the code, sentence and field of the error if it did."""

    failed: bool
    code: str
    text: str
    field: str | None


def _tools(job: Job) -> Iterator[_Check]:
    missing = "is not in the tool table. Enter it in TOOL SETUP."
    yield _Check(job.cutter is None, "TOOL_MISSING", f"TOOL {missing}", "tool")
    yield _Check(
        bool(job.finish_tool) and job.finisher is None, "TOOL_MISSING", f"FINISH TOOL {missing}", "finish_tool"
    )
    for cutter in (job.cutter, job.finisher):
        if cutter is not None:
            bad = not (isfinite(cutter.diameter) and cutter.diameter > 0.0)
            yield _Check(bad, "TOOL_DIAMETER", f"The diameter of tool {cutter.number} must be above 0.", "tool")
            yield _Check(not 1 <= cutter.number <= 99999, "TOOL_NUMBER", "Tool numbers go from 1 to 99999.", "tool")


def _depths(job: Job) -> Iterator[_Check]:
    stock = job.finish_z if job.finish_tool else 0.0
    depth = job.z_start - job.z_bottom
    levels = [height for low, high, _ in job.distinct_floors for height in (low, high)]
    high, low = max(levels, default=job.z_start), min(levels, default=job.z_bottom)
    yield _Check(depth < 0.0, "DEPTH", "Z BOTTOM is above Z START.", "z_bottom")
    yield _Check(low < job.z_bottom - JOINED, "Z_END", "A Z END is below Z BOTTOM. No pass goes that deep.", "z_end")
    above = depth >= 0.0 and high > job.z_start + JOINED
    yield _Check(above, "Z_END", "A Z END is above Z START. Rapids would hit it.", "z_end")
    yield _Check(stock >= depth > 0.0, "FINISH_Z", "FINISH Z leaves nothing for the roughing tool to cut.", "finish_z")
    yield _Check(job.retract_clearance <= 0.0, "CLEARANCE", "RETRACT CLEARANCE must be above 0.", "retract_clearance")
    yield _Check(job.peck_clearance < 0.0, "CLEARANCE", "PECK CLEARANCE must not be below 0.", "peck_clearance")
    yield _Check(job.peck_depth < 0.0, "PECK_DEPTH", "PECK DEPTH must not be below 0.", "peck_depth")
    too_many = job.peck_depth > 0.0 and depth > MAX_PECKS * job.peck_depth
    yield _Check(too_many, "PECK_DEPTH", f"PECK DEPTH makes more than {MAX_PECKS} passes.", "peck_depth")


def _numbers(job: Job) -> Iterator[_Check]:
    numbers = (
        job.z_start,
        job.z_bottom,
        job.peck_depth,
        job.finish_z,
        job.retract_clearance,
        job.peck_clearance,
        job.plunge_feed,
        job.speed,
        job.safe_z,
        *(value or 0.0 for floor in job.distinct_floors for value in floor),
    )
    usable = all(isfinite(value) and abs(value) <= LARGEST_COORDINATE for value in numbers)
    yield _Check(not usable, "NUMBER", "A depth, feed or speed is not a usable number.", None)
    yield _Check(not 54 <= job.work_offset <= 59, "WORK_OFFSET", "WORK OFFSET goes from 54 to 59.", "work_offset")
    yield _Check(job.speed <= 0.0, "SPEED", "SPEED must be above 0.", "speed")


def _paths(job: Job, grid: Grid) -> Iterator[_Check]:
    nothing = not any(len(run.path) for run in job.finish)
    yield _Check(nothing, "NO_PATH", "No path to post: the cutter does not fit, or the contour is incomplete.", None)
    unroughed = job.finisher is not None and not any(len(run.path) for run in rough_runs(job))
    text = "The roughing tool has no path, so the finish tool would cut solid."
    yield _Check(unroughed, "NO_ROUGH_PATH", text, "finish_tool")
    parts = (part for run in (*job.finish, *job.rough) for part in (run.lead_in, run.path, run.lead_out))
    unreachable = not all(part.reachable for part in parts)
    yield _Check(unreachable, "COORDINATE", "A point of the path is beyond any machine's travel.", None)
    no_plunge_feed = _no_feed(job.plunge_feed, grid)
    yield _Check(no_plunge_feed, "PLUNGE_FEED", "PLUNGE FEED must be above 0.", "plunge_feed")
    without_feed = sorted(_unfed(job, grid))
    listed = ", ".join(map(str, without_feed[:MAX_LISTED])) + (" ..." if len(without_feed) > MAX_LISTED else "")
    text = f"There is no FEED above 0 on {'segment' if len(without_feed) == 1 else 'segments'} {listed}."
    # a blank FEED is PLUNGE FEED, so the missing one is named first
    yield _Check(bool(without_feed) and not no_plunge_feed, "FEED", text, "feed")


def _no_feed(feed: float, grid: Grid) -> bool:
    return not isfinite(feed) or feed <= 0.0 or float(feed_text(feed, grid)) == 0.0


def _unfed(job: Job, grid: Grid) -> set[int]:
    """Return the segments that some run cuts without a feed."""
    fed = {floor.number for floor in job.floors if floor.feed is not None and not _no_feed(floor.feed, grid)}
    used = {int(number) for run in (*job.finish, *job.rough) for number in np.unique(run.path.numbers).tolist()}
    return used - fed
