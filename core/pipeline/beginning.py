"""What makes a trial gouge beyond doubt, known before its path is judged, and mostly before there is a path at all.

The offset of a contour's first segment is trimmed at its end only, that of the last one at its start only, so that
every look-ahead's path begins and ends at the same points; and where no other wall is within the radius of them, with
the same blend moves, because an offset that crosses another there is the radius away from that one's wall too.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from typing import Final, NamedTuple

import numpy as np

from core.comp.blend import direction
from core.geometry.boxes import near_pairs
from core.geometry.distance import between, distance, nearest_places
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point
from core.geometry.piece_arrays import Flags, Floats, Measured, Points, boxes, measured
from core.pipeline.table import Trial
from core.tolerance import CLOSED, GOUGE, JOINED

FEWEST: Final = 3
"""Segments below which the first and the last one are neighbors on both sides."""

MARGIN: Final = 1e-5
"""Millimeters by which a thing must be wrong to be wrong beyond doubt, whatever rounding and slivers do to it."""

AT_ONCE: Final = 8192
"""So many distances of a path's corners from walls are measured at most, before it is judged."""


@dataclass(frozen=True, eq=False, slots=True)
class Walls:
    """A surface as trials at any radius need it; `slack` is what uneven radii of arcs leave open."""

    pieces: Measured
    bounds: Floats
    slack: float

    @staticmethod
    def of(surface: Path) -> Walls:
        """The walls of a surface."""
        with np.errstate(all="ignore"):
            pieces = measured(surface)
            return Walls(pieces, boxes(pieces), 2.0 * float(pieces.slack.max(initial=0.0)))

    def about(self, points: Points, reach: float) -> Walls:
        """The walls within `reach` of a point, and perhaps some more."""
        x, y, reach = points.real[:, None], points.imag[:, None], reach + MARGIN
        left, low, right, high = self.bounds
        near = (left <= x + reach) & (x - reach <= right) & (low <= y + reach) & (y - reach <= high)
        rows = near.any(axis=0).nonzero()[0]
        return Walls(self.pieces.take(rows), self.bounds[:, rows], self.slack)

    def limit(self, radius: float) -> float:
        """What is nearer to a wall than this gouges beyond doubt."""
        return radius - GOUGE - self.slack - MARGIN

    def nearer(self, pieces: Measured, limits: Floats, among: Flags | None = None) -> Flags:
        """(k,) whether each piece comes nearer than its limit to a wall; `among` (k, n) are the walls that count."""
        i, j = near_pairs(boxes(pieces), self.bounds, float(limits.max(initial=0.0)))
        if among is not None:
            held = among[i, j]
            i, j = i[held], j[held]
        some, others = pieces.take(i), self.pieces.take(j)
        near = (between(some, others, nearest_places(some, others)) < limits[i]).any(axis=0)
        return np.bincount(i[near], minlength=len(pieces)) > 0


def gouging(paths: Sequence[Path], radius: float, walls: Walls) -> list[bool]:
    """Which paths gouge beyond doubt; False says nothing.

    Corners are looked at, and pieces where there are several paths: to judge one costs little more than its pieces.
    """
    limit = walls.limit(radius)
    with np.errstate(all="ignore"):
        return [limit > 0.0 and _gouges(path, limit, walls, whole=len(paths) > 1) for path in paths]


def _gouges(path: Path, limit: float, walls: Walls, *, whole: bool) -> bool:
    step = 1 + len(path) * len(walls.pieces) // AT_ONCE
    corners = path.points[::step, 0] + 1j * path.points[::step, 1]
    if float(_apart(walls, corners).min(initial=np.inf)) < limit:
        return True
    pieces = measured(path) if whole else None
    return pieces is not None and bool(walls.nearer(pieces, np.full(len(pieces), limit)).any())


def _apart(walls: Walls, points: Points) -> Floats:
    """(k, n) how far points (k,) are from the walls."""
    return distance(walls.pieces, np.repeat(points[:, None], len(walls.pieces), axis=1))


class _End(NamedTuple):
    """Where a path begins or ends: the offset's point, its direction there, and how long the offset is."""

    at: complex
    along: complex
    length: float
    piece: Piece


class _Lead(NamedTuple):
    """A blend move of trial `k`, a quarter circle from the path; `before` is what of the path is in front of it.

    It is the same at every look-ahead where none of the walls `held` (n,) is within the radius of that part.
    """

    k: int
    at: complex
    center: complex
    turn: int
    before: Piece | None
    held: Flags


def gouge_at_once(trials: Sequence[Trial], walls: Walls, own: Sequence[tuple[int, int]]) -> list[bool]:
    """Whether paths gouge where they begin or end, or their blend moves do, at every look-ahead and beyond doubt.

    `own` are the rows of the walls that hold each trial's first and last segment; apart from where they start, all
    trials have the surface of the walls.  False says nothing.
    """
    found = [False] * len(trials)
    if np.count_nonzero(walls.pieces.length > MARGIN) < FEWEST:
        return found
    ends = {k: both for k, both in enumerate(map(_ends, trials)) if both is not None}
    with np.errstate(all="ignore"):
        points = np.array([end.at for both in ends.values() for end in both], np.complex128)
        walls = walls.about(points, max((2.0 * (one.radius + one.blend) + one.overlap for one in trials), default=0.0))
        apart = _apart(walls, points).reshape(len(ends), 2, len(walls.pieces))
        leads = []
        for (k, both), far in zip(ends.items(), apart, strict=True):
            found[k] = bool(far.min(initial=np.inf) < walls.limit(trials[k].radius))
            if not found[k] and trials[k].blend > 0.0:
                leads += _leads(k, trials[k], both, far, _held(walls, trials[k], own[k]))
        if leads:
            _look(found, leads, trials, walls)
    return found


def _look(found: list[bool], leads: list[_Lead], trials: Sequence[Trial], walls: Walls) -> None:
    """Mark the trials of which a lead gouges that is the same at every look-ahead."""
    radii = np.array([trials[lead.k].radius for lead in leads])
    cut = walls.nearer(_quarters(leads, trials), radii - (trials[0].radius - walls.limit(trials[0].radius)))
    cutting = [lead for lead, gouge in zip(leads, cut.tolist(), strict=True) if gouge]
    for lead in cutting:
        found[lead.k] |= lead.before is None
    for lead in cutting:
        if lead.before is not None and not found[lead.k]:
            part = measured(Path.from_pieces([lead.before]))
            free = np.array([trials[lead.k].radius + MARGIN])
            found[lead.k] = not walls.nearer(part, free, lead.held[None]).any()


def _quarters(leads: list[_Lead], trials: Sequence[Trial]) -> Measured:
    """The leads as pieces."""
    count = len(leads)
    at, center, turn = (np.array(column) for column in zip(*(lead[1:4] for lead in leads), strict=True))
    arm = at - center
    blend = np.array([trials[lead.k].blend for lead in leads])
    return Measured(
        np.arange(count),
        at,
        (1j * turn - 1.0) * arm,
        arm,
        turn.astype(np.float64),
        np.full(count, pi / 2.0),
        blend,
        blend * (pi / 2.0),
        np.zeros(count),
    )


def _held(walls: Walls, trial: Trial, own: tuple[int, int]) -> Flags:
    """(2, n) the walls by which the first and the last segment's offsets can be trimmed."""
    # the first and the last segment of a closed contour are never tested against each other
    others = walls.pieces.rows != np.array(own)[:, None]
    return np.repeat(others.all(axis=0)[None], 2, axis=0) if trial.closed else others


def _ends(trial: Trial) -> tuple[_End, _End] | None:
    surface = trial.surface
    first = _end(surface[0], surface.points[0].tolist(), trial)
    last = _end(surface[-1], surface.points[-1].tolist(), trial)
    return None if first is None or last is None else (first, last)


def _end(piece: Piece, at: list[float], trial: Trial) -> _End | None:
    """Where the path begins or ends beside the end `at` of a segment; None where its offset has hardly a length."""
    length, shift = piece.length, trial.side.sign * trial.radius
    if not length > MARGIN:
        return None
    if isinstance(piece, Arc):
        radius, other = (abs(complex(*end) - complex(*piece.center)) for end in (piece.start, piece.end))
        if not min(radius, other) - max(piece.turn * shift, 0.0) > MARGIN:
            return None
        length *= 1.0 - piece.turn * shift / radius
    along = direction(piece, (at[0], at[1]))
    return _End(complex(*at) + 1j * shift * along, along, length, piece) if length > MARGIN else None


def _leads(k: int, trial: Trial, ends: tuple[_End, _End], apart: Floats, held: Flags) -> list[_Lead]:
    """The blend moves at ends that no wall can trim but one that comes near the part `before` them."""
    (first, last), far = ends, trial.radius + MARGIN
    free = [bool((some[among] > far).all()) for some, among in zip(apart, held, strict=True)]
    found = [_lead(k, first.at, first.along, -1, trial, None, held[0])] if free[0] else []
    if not trial.closed or trial.overlap <= JOINED:
        return [*found, _lead(k, last.at, last.along, 1, trial, None, held[1])] if free[1] else found
    if abs(first.at - last.at) <= CLOSED and trial.overlap < first.length - MARGIN:
        again, along = _past(first, trial.overlap)
        found.append(_lead(k, complex(*again.end), along, 1, trial, again, held[0]))
    return found


def _past(first: _End, overlap: float) -> tuple[Piece, complex]:
    """The first `overlap` millimeters of the path, and its direction behind them."""
    start, piece = _point(first.at), first.piece
    if not isinstance(piece, Arc):
        return Line(start, _point(first.at + overlap * first.along)), first.along
    center = complex(*piece.center)
    turned = rect(1.0, piece.turn * overlap / abs(first.at - center))
    return Arc(start, _point(center + (first.at - center) * turned), piece.center, piece.turn), first.along * turned


def _lead(k: int, at: complex, along: complex, way: int, trial: Trial, before: Piece | None, held: Flags) -> _Lead:
    """The blend arc at an end of the path, from there whichever `way` it is traveled: 1 behind it, -1 before it."""
    sign = trial.side.sign
    return _Lead(k, at, at + trial.blend * sign * 1j * along, way * sign, before, held)


def _point(place: complex) -> Point:
    return place.real, place.imag
