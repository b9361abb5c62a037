"""Surface: a contour prepared for judging any number of paths along it, without the over-runs at its ends."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from itertools import pairwise
from typing import Final

import numpy as np

from core.geometry.distance import distance
from core.geometry.path import Floats, Path
from core.geometry.piece import Point, Side
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import CLOSED, JOINED
from core.verify.pairs import nearest, pairs_of, rounding_of
from core.verify.self_crossings import NO_CROSSINGS, SelfCrossings, at_joints, self_crossings
from core.verify.verdict import OverRun
from core.verify.wrong_side import on_part_side, with_sides

LONG_LEAD: Final = 0.25
"""A lead that takes a larger share of its segment may be a wall, with START or the last end mistyped."""

MAX_LEAD_SHARE: Final = 0.5
"""The same limit if the contour's other end over-runs too; also the limit of a lead's share of the closed contour."""

MAX_TANGENT_ANGLE: Final = 0.02
"""Largest angle in radians between an arc and its neighboring wall for the arc to count as tangent to that wall."""

IN_LINE: Final = 1e-3
"""Largest angle in radians between lines that count as one straight line with rounded points."""


class Leads(Enum):
    """Which parts of a contour's ends may be leads, not walls, if the ends run past each other.

    NONE: none.  SEGMENTS: the first and the last segment beyond their crossing.  MOVES: one more move at each end.
    """

    NONE = auto()
    SEGMENTS = auto()
    MOVES = auto()


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """The walls of a contour, the `side` of them on which the cutter runs, and their self-crossings.

    If the contour's ends are an `over_run`, the walls are closed and do not include them.
    """

    path: Path
    side: Side
    walls: PieceArrays
    closed: bool
    crossings: SelfCrossings
    over_run: OverRun | None = None

    @staticmethod
    def prepare(path: Path, side: Side, *, leads: Leads = Leads.SEGMENTS) -> Surface:
        """Prepare the surface of a contour that can be judged."""
        with np.errstate(all="ignore"):
            as_typed = Surface._of(path, side)
            if leads is Leads.NONE:
                return as_typed
            if (trimmed := _without_over_run(as_typed, may_be_leads=leads)) is not None:
                return trimmed
            if (shorter_path := _without_overlap(as_typed)) is None:
                return as_typed
            shorter = Surface._of(shorter_path, side)
            if (trimmed := _without_over_run(shorter, may_be_leads=leads)) is not None:
                return trimmed
            return shorter if shorter.closed and not len(shorter.crossings) else as_typed

    @staticmethod
    def _of(path: Path, side: Side) -> Surface:
        walls = piece_arrays(path)
        closed = bool(abs(walls.end[-1] - walls.start[0]) <= CLOSED)
        return Surface(path, side, walls, closed, self_crossings(walls, closed=closed))


def _without_overlap(surface: Surface) -> Path | None:
    """Return the path without the overlap of its last element along its first one; None if there is no overlap.

    Many contours are closed this way: the cutter leaves a little past the place where it began.
    """
    walls, path = surface.walls, surface.path
    if len(walls) < 3 or not (_same_line(walls) or _same_circle(walls)):
        return None
    first, last = walls.take(np.array([0])), walls.take(np.array([len(walls) - 1]))
    if distance(first, last.end).item() > JOINED or abs(last.end - first.start).item() <= JOINED:
        return None
    row = int(walls.rows[-1])
    if distance(first, last.start).item() <= JOINED:
        return _ended_at(path, row - 1, path.points[row])
    return _ended_at(path, row, path.points[0]) if distance(last, first.start).item() <= JOINED else None


def _same_line(walls: PieceArrays) -> bool:
    straight = not walls.arcs[0] and not walls.arcs[-1]
    return bool(straight and abs(walls.unit[0] - walls.unit[-1]) <= IN_LINE)


def _same_circle(walls: PieceArrays) -> bool:
    (center, radius), (other, large) = ((walls.center[end], walls.radius[end]) for end in (0, -1))
    arcs = walls.arcs[0] and walls.turn[0] == walls.turn[-1]
    return bool(arcs and max(abs(center - other), abs(radius - large)) <= JOINED)


def _without_over_run(surface: Surface, *, may_be_leads: Leads) -> Surface | None:
    """Return the closed surface that begins and ends at the crossing of its first and its last element.

    One of them may begin, end or join the next element at the crossing, as long as either runs past it.  Return None if
    anything else crosses, or if a run past the crossing is not clear of the closed surface or is at least as long.
    """
    walls, stations = surface.walls, surface.walls.stations
    crossing = _crossing_of_ends(surface, leads=may_be_leads)
    if crossing is None:
        return None
    at, first, last = crossing
    lead_in, lead_out = first, float(stations[-1]) - last
    if max(lead_in, lead_out) <= JOINED or max(lead_in, lead_out) >= last - first:
        return None
    begin = int(np.count_nonzero(stations[1:-1] <= first + JOINED))
    end = int(np.count_nonzero(stations[:-1] < last - JOINED)) - 1
    trimmed_walls = piece_arrays(_between(surface.path, int(walls.rows[begin]), int(walls.rows[end]), at))
    runs = [_run_in(surface, first, at)] if lead_in > JOINED else []
    runs += [_run_out(surface, last, at)] if lead_out > JOINED else []
    if not all(_is_clear(run, trimmed_walls, surface.side) for run in runs):
        return None
    # of both ends: the lead, its element from there on, the rows outward, and what of the first of these is beyond
    leads, elements = (lead_in, lead_out), (float(stations[begin + 1]), float(stations[-1] - stations[end]))
    outward = range(begin, -1, -1), range(end, len(walls))
    beyond = first - float(stations[begin]), float(stations[end + 1]) - last
    # a lead that is a move of its own is programmed on purpose
    is_move = (
        begin > 0 and bool(walls.arcs[0] or beyond[0] <= JOINED),
        end < len(walls) - 1 and bool(walls.arcs[-1] or beyond[1] <= JOINED),
    )
    side = 0 if lead_in > JOINED else 1
    doubtful = len(runs) == 1 and not is_move[side] and leads[side] / elements[side] > LONG_LEAD
    max_shares = (LONG_LEAD if move else MAX_LEAD_SHARE for move in reversed(is_move))
    maybe_walls = any(map(_may_be_walls, (walls, walls), outward, beyond, max_shares))
    named_leads = set[int]()
    if maybe_walls or max(leads) > MAX_LEAD_SHARE * (last - first):
        for lead, rows, past in zip(leads, outward, beyond, strict=True):
            if lead > JOINED:
                named_leads |= set(rows if past > JOINED else rows[1:])
    first_number, last_number = surface.path.numbers[walls.rows[[begin, end]]].tolist()
    lead_numbers = tuple(surface.path.numbers[walls.rows[sorted(named_leads)]].tolist())
    over_run = OverRun(at, lead_in, lead_out, first_number, last_number, doubtful, lead_numbers)
    return Surface(surface.path, surface.side, trimmed_walls, True, NO_CROSSINGS, over_run)


def _crossing_of_ends(surface: Surface, *, leads: Leads) -> tuple[Point, float, float] | None:
    """Return the point where the first and the last element cross, and the length traveled to it on each, or None.

    No other place may cross.  Collinear lines are one element.  With MOVES the next elements may cross too, but not an
    arc at an end that is tangent to its neighbor: it is a lead, and it really cuts a wall that it crosses.
    """
    walls, crossings = surface.walls, surface.crossings
    if surface.closed:
        # ends that count as one point within CLOSED may still run past each other
        ends_differ = abs(walls.end[-1] - walls.start[0]) > JOINED
        crossings = self_crossings(walls, closed=False) if ends_differ else NO_CROSSINGS
    stations, points = crossings.places, crossings.points
    if not len(points) or len(walls) < 3:
        return None
    begin, end = _in_line(walls, range(len(walls))), _in_line(walls, range(len(walls) - 1, -1, -1))
    if leads is Leads.MOVES:
        begin = _in_line(walls, range(min(begin + 1, len(walls) - 1), len(walls)))
        end = _in_line(walls, range(max(end - 1, 0), -1, -1))
    at_ends = stations[:, 0] <= walls.stations[begin + 1] + JOINED
    at_ends &= stations[:, 1] >= walls.stations[end] - JOINED
    if leads is Leads.MOVES:
        at_ends &= stations[:, 0] >= walls.stations[int(_is_tangent_arc(walls, 0, 1))] - JOINED
        at_ends &= stations[:, 1] <= walls.stations[len(walls) - int(_is_tangent_arc(walls, -1, -2))] + JOINED
    if not at_ends.all() or np.abs(points - points[0]).max() > 2.0 * JOINED:
        return None
    return (points[0].real.item(), points[0].imag.item()), float(stations[:, 0].min()), float(stations[:, 1].max())


def _is_tangent_arc(walls: PieceArrays, end: int, neighbor: int) -> bool:
    """True if the piece at an end is an arc that is tangent to its neighbor."""
    if not walls.arcs[end]:
        return False
    before, after = sorted((end % len(walls), neighbor % len(walls)))
    leaving, coming = at_joints(walls, np.array([before]), np.array([after]))[:, 0]
    return bool(abs(np.angle(coming * np.conj(leaving))) <= MAX_TANGENT_ANGLE)


def _in_line(walls: PieceArrays, rows: range) -> int:
    """Return the last of these rows that continues the first one in a straight line, else the first."""
    for near, far in pairwise(rows):
        if walls.arcs[near] or walls.arcs[far] or abs(walls.unit[near] - walls.unit[far]) > IN_LINE:
            return near
    return rows[-1]


def _may_be_walls(walls: PieceArrays, outward: range, beyond: float, max_share: float) -> bool:
    """True if some of the rows from the crossing `outward`, which are taken for leads, may be walls.

    These are lines that bend off the first of these rows, and the rows of its own element if more than `max_share` of
    that lies beyond the crossing, `beyond` (mm) of the first row.  If the crossing is a joint, the moves past it are
    leads on purpose.
    """
    if beyond <= JOINED:
        return False
    inward = range(outward[0], len(walls)) if outward.step < 0 else range(outward[0], -1, -1)
    far, near = _in_line(walls, outward), _in_line(walls, inward)
    if any(not walls.arcs[row] and abs(row - outward[0]) > abs(far - outward[0]) for row in outward):
        return True
    element = float(walls.length[min(far, near) : max(far, near) + 1].sum())
    in_line = range(outward[0], far + outward.step, outward.step)
    beyond += float(walls.length[list(in_line[1:])].sum())
    return beyond > max_share * element


def _between(path: Path, begin: int, end: int, at: Point) -> Path:
    """Return the path from row `begin` to row `end`, started and ended at point `at`; other pieces get no length."""
    ended = _ended_at(path, end, np.array(at))
    points, turns = ended.points.copy(), ended.turns.copy()
    points[: begin + 1] = at
    turns[:begin] = 0
    return Path.of(points, path.centers, turns, path.numbers)


def _ended_at(path: Path, row: int, at: Floats) -> Path:
    """Return the path with piece `row` ended at a point; the pieces after it get no length."""
    points, turns = path.points.copy(), path.turns.copy()
    points[row + 1 :] = at
    turns[row + 1 :] = 0
    return Path.of(points, path.centers, turns, path.numbers)


def _run_in(surface: Surface, first: float, at: Point) -> Path:
    """Return the path from the point `at`, at the length `first` traveled, back to the surface's beginning."""
    walls = surface.walls
    row = int(walls.rows[np.count_nonzero(walls.stations[:-1] < first - JOINED) - 1])
    part = surface.path.part(int(walls.rows[0]), row + 1).reversed()
    return _begun_at(part, at)


def _run_out(surface: Surface, last: float, at: Point) -> Path:
    """Return the path from the point `at`, at the length `last` traveled, to the surface's end."""
    walls = surface.walls
    row = int(walls.rows[np.count_nonzero(walls.stations[1:-1] <= last + JOINED)])
    return _begun_at(surface.path.part(row, int(walls.rows[-1]) + 1), at)


def _begun_at(path: Path, at: Point) -> Path:
    points = path.points.copy()
    points[0] = at
    return Path.of(points, path.centers, path.turns)


def _is_clear(run: Path, walls: PieceArrays, side: Side) -> bool:
    """True if a run, which meets the closed walls only where it begins, ends off them on the cutter's side.

    A run that ends on the walls, such as part of a full circle, belongs to them.
    """
    pieces = piece_arrays(run)
    pairs = pairs_of(pieces, walls, rounding_of(walls))
    far = pieces.end[-1:]
    near = nearest(pairs, np.array([len(pieces) - 1]), far)
    on_part = on_part_side(walls, far, near, with_sides(side, walls, NO_CROSSINGS, closed=True))
    return bool(near.distance.min() > JOINED) and not on_part.any()
