"""Turns one MILL CONTOUR block, as a job, into the motions that cut it, in millimeters, mm per minute and radians.

Terms: a *run* is one center path with its blend moves, cut in one go at one depth; the *plunge point* is where it
begins; a segment's *floor* is the height that its Z START and Z END give it.

Roughing comes first, with TOOL: at each depth all its runs from outside in, then one peck deeper, so that no run
is ever deeper than one peck in stock that another run should have taken.  Without a finish tool, the run at full size
is the last at each depth.  FINISH TOOL follows in one pass at full depth.  It pecks only where it may meet solid
material: if it is smaller than TOOL, since corners are then still solid; if it is wider than the roughed strip; or if
it cuts a segment that no roughing run has cut.

PECK, for every run: feed down to the depth, mill the contour, rapid up to the retract clearance over Z START, rapid
back to the plunge point, rapid down to the last depth there plus the peck clearance, feed one peck deeper.

A segment's floor rises evenly along the programmed line or arc.  A piece of a run takes its heights from the points of
its segment that lie square to it, so a piece shortened at an inside corner begins and ends at the height that the
drawing gives there; where two such heights differ, the tool moves straight up or down between them.  A corner arc
keeps the height of its corner.

Times are those of the moves that are posted: a feed move takes its length divided by its programmed feed, a rapid its
length divided by the rapid rate.  Acceleration, tool changes and overrides are not counted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import ceil, hypot, isfinite, tau
from typing import Final

import numpy as np

from core.advice.path_findings import ZStep
from core.comp.compensated import CenterPath
from core.controls.write.contour_pass import CenterMove
from core.finding import Finding, Severity
from core.geometry.path import Floats, Path, Pieces, pieces_of, point_of_row, swept
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.program.model import Coolant
from core.tolerance import CLOSED, JOINED, LAST_PASS

MAX_WRAP_ANGLE: Final = 1e-6
"""Angle by which rounding may put an arc's first point before its segment's first point, in radians."""


@dataclass(frozen=True, slots=True)
class Cutter:
    """A tool in the tool table: `diameter` in millimeters."""

    number: int
    diameter: float
    type: str = ""


@dataclass(frozen=True, slots=True)
class Floor:
    """A segment's number, from 1, its heights at both ends in mm, and its feed in mm per minute, None if not known."""

    number: int
    z_start: float
    z_end: float
    feed: float | None


@dataclass(frozen=True, eq=False, slots=True)
class Job:
    """One block, ready for passes; millimeters, and millimeters per minute."""

    block: int
    comp: str
    cutter: Cutter | None
    """The TOOL; None if the block names none or the table has none, and then a finding says so."""
    finisher: Cutter | None
    """The FINISH TOOL; None for the same reasons."""
    surface: Path
    """The programmed contour."""
    floors: tuple[Floor, ...]
    """By the piece numbers of `surface` and of every run: k, and k + 1/2 for the corner arc after k."""
    finish: tuple[CenterPath, ...]
    """The runs at full size: one, or one for each loop of the best path.  Without a finish tool `cutter` cuts them."""
    rough: tuple[CenterPath, ...]
    """The runs before, outermost first: PROFILE's passes and, with a finish tool, the run that leaves FINISH XY."""
    z_start: float
    z_bottom: float
    peck_depth: float
    """0 for full depth in one pass."""
    finish_z: float
    """The stock that roughing leaves on the floor if a finish tool follows."""
    retract_clearance: float
    peck_clearance: float
    plunge_feed: float
    speed: float
    safe_z: float
    finish_tool: int = 0
    work_offset: int = 54
    coolant: Coolant = Coolant.OFF
    lookahead: str = ""
    """Text such as "CAL 8", empty for ON."""
    rapid_rate: float = 5080.0
    rapid_assumed: bool = True
    """Nobody has typed the rapid rate."""
    findings: tuple[Finding, ...] = ()
    """All of the block's; any error among them blocks posting."""
    notes: tuple[str, ...] = ()
    """Further sentences for the posted header."""

    @property
    def distinct_floors(self) -> frozenset[tuple[float, float, float | None]]:
        """The floors' start height, end height and feed, each triple once."""
        return frozenset((floor.z_start, floor.z_end, floor.feed) for floor in self.floors)

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that block posting."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)


@dataclass(frozen=True, eq=False, slots=True)
class Pass:
    """One run at one depth, from above its plunge point to above its end.

    `side` of `sides` counts widths from outside in, each of which may be several runs; `number` of `count` counts
    depths, this one at `level`.  `stock` is what the run leaves on the side; `finishing`: the finish tool cuts it.  The
    first motion is a rapid in XY at a height that clears everything.
    """

    block: int
    cutter: Cutter
    speed: float
    level: float
    side: int
    sides: int
    number: int
    count: int
    stock: float
    finishing: bool
    motions: tuple[CenterMove, ...]


def level_floor(job: Job) -> bool:
    """True if no segment rises above Z BOTTOM."""
    return all(max(low, high) <= job.z_bottom + JOINED for low, high, _ in job.distinct_floors)


def heights(job: Job, run: CenterPath) -> Floats:
    """Return the (n, 2) heights of the floor under both ends of each piece of `run.with_leads`.

    The blend-in has the height of the path's first point, the blend-out that of its last; an overlap past the start is
    lifted where the segment below it is higher.
    """
    if level_floor(job):
        return np.full((len(run.with_leads), 2), job.z_bottom)
    path = _floor_heights(job, run.path)
    lead_in = np.full((len(run.lead_in), 2), path[0, 0])
    lead_out = np.maximum(_floor_heights(job, run.lead_out), path[-1, 1])
    return np.concatenate((lead_in, path, lead_out))


def z_steps(job: Job) -> list[ZStep]:
    """Return the steps of the finish paths: where they go straight up or down between two of their pieces.

    If a blend arc, an inside corner or the look-ahead removes the end of a segment that climbs or falls, its neighbors
    are at different heights; so they are after a Z END on a segment without length.
    """
    if level_floor(job):
        return []
    steps = []
    for run in job.finish:
        first, count = len(run.lead_in), len(run.path)
        ends = heights(job, run)[first : first + count]
        rise = ends[1:, 0] - ends[:-1, 1]
        for row in np.flatnonzero(np.abs(rise) > CLOSED).tolist():
            at = point_of_row(run.path.points[row + 1])
            steps.append(ZStep(float(rise[row]), float(run.path.numbers[row + 1]), at))
    return steps


def _floor_heights(job: Job, path: Path) -> Floats:
    """Return the (n, 2) heights at both ends of each piece; a corner has that at the end of the segment before it."""
    floors = {floor.number: (floor.z_start, floor.z_end) for floor in job.floors}
    row_of = {int(number): row for row, number in enumerate(job.surface.numbers.tolist())}
    numbers = path.numbers.astype(np.intp)
    ends = np.array([floors[number] for number in numbers.tolist()]).reshape(-1, 2)
    segments = np.array([row_of.get(number, -1) for number in numbers.tolist()], np.intp)
    rows = ((path.numbers == numbers) & (segments >= 0)).nonzero()[0]
    shares = _shares(pieces_of(path).take(rows), pieces_of(job.surface).take(segments[rows]))
    low, high = ends[rows, :1], ends[rows, 1:]
    heights = np.repeat(ends[:, 1:], 2, axis=1)
    heights[rows] = low + shares.T * (high - low)
    return heights


def _shares(pieces: Pieces, segments: Pieces) -> Floats:
    """Return (2, n) how far along its segment each piece begins and ends, 0 to 1."""
    chord = segments.end - segments.start
    square = np.maximum(np.abs(chord) ** 2, np.finfo(float).tiny)
    points = np.array((pieces.start, pieces.end))
    on_line = np.clip(((points - segments.start) * chord.conj()).real / square, 0.0, 1.0)
    turned = (pieces.start - segments.center) * (segments.start - segments.center).conj()
    start_angle, full_angle = np.mod(np.angle(turned) * segments.turn, tau), swept(segments)
    start_angle[start_angle > tau - MAX_WRAP_ANGLE] = 0.0
    on_arc = np.array((start_angle, start_angle + swept(pieces))) / np.where(full_angle == 0.0, 1.0, full_angle)
    return np.where(segments.turn == 0, on_line, np.minimum(on_arc, 1.0))


def peck_levels(z_start: float, bottom: float, peck: float) -> tuple[float, ...]:
    """Return the depths from the first peck to `bottom`, which is always the last; `peck` 0 goes there at once (mm).

    Each is counted from Z START, so that rounding does not add up; a rest too thin for a machine to show is part of the
    last pass.
    """
    depth = z_start - bottom
    count = max(ceil((depth - LAST_PASS) / peck), 1) if peck > 0.0 else 1
    return (*(z_start - number * peck for number in range(1, count)), bottom)


def passes(job: Job) -> tuple[Pass, ...]:
    """Return all passes of a block, in order.  The job must have no posting errors."""
    assert job.cutter is not None
    stock = job.finish_z if job.finisher is not None else 0.0
    levels = peck_levels(job.z_start, job.z_bottom + stock, job.peck_depth)
    made = [*_passes_of_tool(job, job.cutter, rough_runs(job), levels, stock)]
    if job.finisher is not None:
        strip = job.cutter.diameter + (job.rough[0].offset if job.rough else 0.0)
        roughed = job.cutter.diameter <= job.finisher.diameter <= strip and not meets_solid(job)
        levels = peck_levels(job.z_start, job.z_bottom, 0.0 if roughed else job.peck_depth)
        made += _passes_of_tool(job, job.finisher, job.finish, levels, 0.0, finishing=True)
    return tuple(made)


def rough_runs(job: Job) -> tuple[CenterPath, ...]:
    """Return the runs that TOOL cuts: its own, and those at full size if no finish tool cuts them.

    With CUTTER COMP. ON there is no stock on the side, and both tools run the contour itself.
    """
    if job.finisher is None:
        return job.rough + job.finish
    return job.rough or (job.finish if job.comp == "ON" else ())


def clear_height(job: Job) -> float:
    """Return the height of the retract clearance over Z START."""
    return job.z_start + job.retract_clearance


def at_one_safe_z(jobs: Sequence[Job]) -> list[Job]:
    """Return the jobs with the SAFE Z that they are posted with: the highest, or what clears all blocks."""
    safe = max((height for job in jobs for height in (job.safe_z, clear_height(job))), default=0.0)
    return [replace(job, safe_z=safe) for job in jobs]


def meets_solid(job: Job) -> frozenset[int]:
    """Return the segments that the finish tool cuts in solid material: no roughing run has cut them."""
    return frozenset() if job.finisher is None else _segments(job.finish) - _segments(job.rough[-1:])


def _segments(runs: Sequence[CenterPath]) -> frozenset[int]:
    return frozenset(int(number) for run in runs for number in run.path.numbers.tolist() if number == int(number))


def _passes_of_tool(
    job: Job,
    cutter: Cutter,
    its_runs: Sequence[CenterPath],
    levels: Sequence[float],
    floor_stock: float,
    *,
    finishing: bool = False,
) -> Iterator[Pass]:
    """Yield a tool's passes: its runs at each depth of `levels`; they leave `floor_stock` (mm) on the floor."""
    runs = tuple(run for run in its_runs if len(run.with_leads))
    floors = [heights(job, run) + floor_stock for run in runs]
    widths = list(dict.fromkeys(run.offset for run in runs))
    last = len(levels) * len(runs) - 1
    safe = max(job.safe_z, clear_height(job))
    for number, level in enumerate(levels):
        for index, (run, floor) in enumerate(zip(runs, floors, strict=True)):
            done = number * len(runs) + index
            before = max(levels[number - 1], float(floor[0, 0])) if number else None
            motions = (
                *_plunge_moves(
                    job, run, max(level, float(floor[0, 0])), before, safe if done == 0 else clear_height(job)
                ),
                *_contour_moves(job, run, floor, level),
            )
            up = CenterMove(motions[-1].x, motions[-1].y, safe if done == last else clear_height(job))
            yield Pass(
                block=job.block,
                cutter=cutter,
                speed=job.speed,
                level=level,
                side=widths.index(run.offset) + 1,
                sides=len(widths),
                number=number + 1,
                count=len(levels),
                stock=run.offset,
                finishing=finishing,
                motions=(*motions, up),
            )


def _plunge_moves(job: Job, run: CenterPath, depth: float, before: float | None, height: float) -> Iterator[CenterMove]:
    """Yield rapids to the plunge point and the clearance, then a feed to `depth`; `before` is the last depth there."""
    assert run.plunge_point is not None
    x, y = run.plunge_point
    near = clear_height(job) if before is None else min(before + job.peck_clearance, clear_height(job))
    yield CenterMove(x, y, height)
    if near < height:
        yield CenterMove(x, y, near)
    yield CenterMove(x, y, depth, job.plunge_feed)


def _contour_moves(job: Job, run: CenterPath, floors: Floats, level: float) -> Iterator[CenterMove]:
    """Yield the run at `level`, lifted where the floor is higher."""
    path = run.with_leads
    feeds = _feeds(job, run)
    z = max(level, float(floors[0, 0]))
    for piece, feed, (low, high) in zip(path, feeds, floors.tolist(), strict=True):
        if abs(max(low, level) - z) > JOINED:
            yield CenterMove(*piece.start, max(low, level), job.plunge_feed if max(low, level) < z else feed)
        yield from _piece_at_level(piece, feed, (low, high), level)
        z = max(high, level)


def _feeds(job: Job, run: CenterPath) -> list[float]:
    """Return each piece's feed: its segment's; a blend move has that of the path's end which it leads to or from."""
    by_number = {floor.number: floor.feed or 0.0 for floor in job.floors}
    path = [by_number[int(number)] for number in run.path.numbers.tolist()]
    return [path[0]] * len(run.lead_in) + path + [path[-1]] * len(run.lead_out)


def _piece_at_level(piece: Piece, feed: float, floor: tuple[float, float], level: float) -> Iterator[CenterMove]:
    """Yield one piece over a floor from `floor[0]` to `floor[1]`, never below `level`; split where they meet."""
    low, high = floor
    if (low - level) * (high - level) < 0.0:
        part = (level - low) / (high - low)
        yield _motion(piece, feed, piece.point_at(part), level)
    yield _motion(piece, feed, piece.end, max(high, level))


def _motion(piece: Piece, feed: float, end: Point, z: float) -> CenterMove:
    return CenterMove(*end, z, feed) if isinstance(piece, Line) else CenterMove(*end, z, feed, piece.turn, piece.center)


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
    hours, in_hour = divmod(seconds, 3600)
    return f"{hours}:{in_hour // 60:02}:{in_hour % 60:02}" if hours else f"{in_hour // 60}:{in_hour % 60:02}"
