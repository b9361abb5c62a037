"""Makes the pieces of a chain meet exactly, without adding any piece.

If two pieces cross at an angle, the joint is where their carriers meet; if they run on nearly straight, it is the end
of the arc, or the midpoint between the two ends.  An arc keeps its center if it can, moves it by no more than
`ARC_RADII`, or else keeps its sweep angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import atan2, dist, radians
from typing import Final, NamedTuple

from core.geometry.carrier import carriers_meet
from core.geometry.construct import center_by_sweep, exact_arc
from core.geometry.piece import Arc, Line, Piece, Point
from core.importing.clean_up import is_circle
from core.tolerance import JOINED, ON_PATH

MIN_CROSSING_ANGLE: Final = radians(5.0)
"""Above this angle the corner of a drawing is where the two carriers meet."""


class Joined(NamedTuple):
    """The pieces of a chain, joined end to start, and the largest gap that was closed."""

    pieces: tuple[Piece, ...]
    gap: float


def joined_chain(pieces: Sequence[Piece], *, closed: bool, tolerance: float) -> Joined:
    """Return the pieces, given in order and direction of travel, joined end to start."""
    if len(pieces) == 1:
        piece = pieces[0]
        if closed and isinstance(piece, Arc) and not is_circle(piece):
            # its ends are one point: it is a full circle
            return Joined((replace(piece, end=piece.start),), dist(piece.start, piece.end))
        return Joined((piece,), 0.0)
    pairs = list(zip(pieces, (*pieces[1:], pieces[0]), strict=True))
    joints = [_joint(first, second, tolerance) for first, second in pairs]
    gaps = [dist(first.end, second.start) for first, second in pairs]
    if not closed:
        joints[-1], gaps[-1] = pieces[-1].end, 0.0
    starts = [joints[-1] if closed else pieces[0].start, *joints[:-1]]
    moved = [_between(piece, start, end) for piece, start, end in zip(pieces, starts, joints, strict=True)]
    kept = [piece for piece in moved if is_circle(piece) or dist(piece.start, piece.end) > 0.0]
    return Joined(tuple(kept), max(gaps))


def _joint(first: Piece, second: Piece, tolerance: float) -> Point:
    """Return the point where the end of one piece and the start of the next meet."""
    here, there = first.end, second.start
    gap = dist(here, there)
    if gap <= ON_PATH:
        return there if isinstance(second, Arc) and isinstance(first, Line) else here
    middle = ((here[0] + there[0]) / 2.0, (here[1] + there[1]) / 2.0)
    if gap > JOINED and _angle_between(first, second) > MIN_CROSSING_ANGLE:
        meetings = [
            point for point in carriers_meet(first, second) if max(dist(point, here), dist(point, there)) <= tolerance
        ]
        if meetings:
            return min(meetings, key=lambda point: dist(point, middle))
    if isinstance(first, Arc) is not isinstance(second, Arc):
        return here if isinstance(first, Arc) else there
    return middle


def _angle_between(first: Piece, second: Piece) -> float:
    """Return the angle between two carriers where the pieces meet, 0 to a right angle."""
    if min(first.length, second.length) <= 0.0:
        return 0.0
    (ux, uy), (vx, vy) = first.direction_at(first.end), second.direction_at(second.start)
    return atan2(abs(ux * vy - uy * vx), abs(ux * vx + uy * vy))


def _between(piece: Piece, start: Point, end: Point) -> Piece:
    """Return the piece with another start and another end, both near its own."""
    if isinstance(piece, Line):
        return Line(start, end)
    if is_circle(piece) or (start, end) == (piece.start, piece.end):
        return piece
    arc = exact_arc(start, end, piece.center, piece.turn)
    if arc.end == end and arc.start != arc.end:
        return arc
    center = center_by_sweep(start, end, abs(piece.sweep), piece.turn)
    return Line(start, end) if center is None else Arc(start, end, center, piece.turn)


def reversed_pieces(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """Return a joined chain traveled the other way."""
    return tuple(piece.reversed() for piece in reversed(pieces))
