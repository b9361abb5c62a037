"""The sequence of passes that cuts one block.

Roughing comes first, with TOOL: at each depth all its runs from outside in, then one peck deeper, so that no run is
ever deeper than one peck beside stock another run should have taken.  Without a finish tool the run at full size is
the last at each depth.  FINISH TOOL follows in one pass at full depth; it pecks only where it is smaller than TOOL,
because it then cuts corners that are still solid.

PECK, for every run: feed down to the depth, mill the contour, rapid up to the retract clearance over Z START, rapid
back to the plunge point, rapid down to the last depth there plus the peck clearance, feed one peck deeper.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import atan2, ceil, cos, sin

from core.geometry.path import Floats
from core.geometry.piece import Line, Piece, Point
from core.output.heights import heights
from core.output.job import Cutter, Job, Run
from core.output.motion import Motion, Pass
from core.tolerance import JOINED, LAST_PASS


def levels(z_start: float, bottom: float, peck: float) -> tuple[float, ...]:
    """Depths from the first peck to `bottom`, which is always the last; `peck` 0 goes there at once (mm).

    Each is counted from Z START, so that rounding does not add up, and a rest thinner than a machine can show is
    part of the last pass.
    """
    depth = z_start - bottom
    count = max(ceil((depth - LAST_PASS) / peck), 1) if peck > 0.0 else 1
    return (*(z_start - number * peck for number in range(1, count)), bottom)


@dataclass(frozen=True, eq=False, slots=True)
class _Stage:
    """What one tool does: `runs` at each depth of `levels`, leaving `floor_stock` on the floor."""

    cutter: Cutter
    runs: tuple[Run, ...]
    levels: tuple[float, ...]
    floor_stock: float
    finishing: bool


def passes(job: Job) -> tuple[Pass, ...]:
    """All passes of a block, in order.  The job must be one that `objections` finds nothing against."""
    return tuple(one for stage in _stages(job) for one in _cut(job, stage))


def rough_runs(job: Job) -> tuple[Run, ...]:
    """What TOOL cuts: its own runs, and those at full size when no finish tool does.

    With CUTTER COMP. ON there is no stock on the side, and both tools run the contour itself.
    """
    if job.finisher is None:
        return job.rough + job.finish
    return job.rough or (job.finish if job.comp == "ON" else ())


def clear_height(job: Job) -> float:
    """The retract clearance's height over Z START."""
    return job.z_start + job.retract_clearance


def _stages(job: Job) -> Iterator[_Stage]:
    assert job.cutter is not None
    stock = job.finish_z if job.finisher is not None else 0.0
    rough_levels = levels(job.z_start, job.z_bottom + stock, job.peck_depth)
    yield _Stage(job.cutter, rough_runs(job), rough_levels, stock, finishing=False)
    if job.finisher is not None:
        pecks = job.peck_depth if job.finisher.diameter < job.cutter.diameter or meets_solid(job) else 0.0
        fine = levels(job.z_start, job.z_bottom, pecks)
        yield _Stage(job.finisher, job.finish, fine, 0.0, finishing=True)


def meets_solid(job: Job) -> frozenset[int]:
    """Segments that the finish tool cuts and no roughing run has been along: it finds solid material there."""
    if job.finisher is None:
        return frozenset()
    return _segments(job.finish) - _segments(job.rough[-1:])


def _segments(runs: Sequence[Run]) -> frozenset[int]:
    return frozenset(int(number) for run in runs for number in run.path.numbers.tolist() if number == int(number))


def _cut(job: Job, stage: _Stage) -> Iterator[Pass]:
    runs = tuple(run for run in stage.runs if len(run.whole))
    floors = [heights(job, run) + stage.floor_stock for run in runs]
    widths = list(dict.fromkeys(run.offset for run in runs))
    last = len(stage.levels) * len(runs) - 1
    safe = max(job.safe_z, clear_height(job))
    for number, level in enumerate(stage.levels):
        for index, (run, floor) in enumerate(zip(runs, floors, strict=True)):
            done = number * len(runs) + index
            before = max(stage.levels[number - 1], float(floor[0, 0])) if number else None
            motions = (
                *_down(job, run, max(level, float(floor[0, 0])), before, safe if done == 0 else clear_height(job)),
                *_milled(job, run, floor, level),
            )
            up = _over(motions[-1], safe if done == last else clear_height(job))
            yield Pass(
                block=job.block,
                cutter=stage.cutter,
                speed=job.speed,
                level=level,
                side=widths.index(run.offset) + 1,
                sides=len(widths),
                number=number + 1,
                count=len(stage.levels),
                stock=run.offset,
                finishing=stage.finishing,
                motions=(*motions, up),
            )


def _down(job: Job, run: Run, depth: float, before: float | None, height: float) -> Iterator[Motion]:
    """Rapid over the plunge point at `height`, down to the clearance, feed to `depth`; `before` was reached there."""
    assert run.plunge_point is not None
    x, y = run.plunge_point
    near = clear_height(job) if before is None else min(before + job.peck_clearance, clear_height(job))
    yield Motion(x, y, height)
    if near < height:
        yield Motion(x, y, near)
    yield Motion(x, y, depth, job.plunge_feed)


def _over(motion: Motion, height: float) -> Motion:
    return Motion(motion.x, motion.y, height)


def _milled(job: Job, run: Run, floors: Floats, level: float) -> Iterator[Motion]:
    """The run at `level`, held up where the floor is higher."""
    whole = run.whole
    feeds = _feeds(job, run)
    z = max(level, float(floors[0, 0]))
    for piece, feed, (low, high) in zip(whole, feeds, floors.tolist(), strict=True):
        if abs(max(low, level) - z) > JOINED:
            yield Motion(*piece.start, max(low, level), job.plunge_feed if max(low, level) < z else feed)
        yield from _leveled(piece, feed, (low, high), level)
        z = max(high, level)


def _feeds(job: Job, run: Run) -> list[float]:
    """Feed of each piece: its segment's; the blend moves take that of the path's end they stand at."""
    by_number = {floor.number: floor.feed or 0.0 for floor in job.floors}
    path = [by_number[int(number)] for number in run.path.numbers.tolist()]
    return [path[0]] * len(run.lead_in) + path + [path[-1]] * len(run.lead_out)


def _leveled(piece: Piece, feed: float, floor: tuple[float, float], level: float) -> Iterator[Motion]:
    """One piece over a floor from `floor[0]` to `floor[1]`, never below `level`: in two where the floor meets it."""
    low, high = floor
    if (low - level) * (high - level) < 0.0:
        part = (level - low) / (high - low)
        yield _motion(piece, feed, _point(piece, part), level)
    yield _motion(piece, feed, piece.end, max(high, level))


def _motion(piece: Piece, feed: float, end: Point, z: float) -> Motion:
    if isinstance(piece, Line):
        return Motion(*end, z, feed)
    return Motion(*end, z, feed, piece.turn, piece.center)


def _point(piece: Piece, part: float) -> Point:
    """The point of a piece after a part of its length, 0 to 1."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    if isinstance(piece, Line):
        return x0 + part * (x1 - x0), y0 + part * (y1 - y0)
    (cx, cy), radius = piece.center, piece.radius
    angle = atan2(y0 - cy, x0 - cx) + part * piece.sweep
    return cx + radius * cos(angle), cy + radius * sin(angle)
