"""Beside: pieces of a center path that run exactly a radius beside a wall of their own, as nearly all of them do.

Words: a wall is a piece of the surface; its own piece runs beside it, a radius away on the cutter's side, the same way,
and nowhere beyond its ends.  A corner is an arc of the radius about the joint of two straight walls, from the
one's own piece to the other's.  A joint is proved where neither own piece at it is nearer to the other's wall than the
radius.  The path's numbers only say where to look; what is not proved here has to be measured.

What is granted for rounding adds up to a few times `grant` in the proof of a joint, and to half of GOUGE in that of a
run: where nothing is nearer than the radius, it may be so much nearer, and a gouge is not hidden by it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final, NamedTuple

import numpy as np

from core.geometry.aligned import Runs
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays
from core.tolerance import GOUGE

HALF: Final = pi * (1.0 + 1e-12)
"""Radians up to which an arc stays on one side of the normal at its end."""

END: Final = 2.0
"""What a joint that ends a run adds to its sum, of which a run has no more than 1."""

STEP: Final = 0.025
"""What every joint adds to the sum of a run, at the least: no run has more than forty."""

GIVES: Final = 4.0 / GOUGE
"""What every joint adds for each millimeter granted: it gives way by two grants, a run by half of GOUGE."""

BACK: Final = -0.999999
"""Cosine of the angle by which a wall turns back on the one before it."""

LEAST: Final = 1e-3
"""Millimeters of radius below which nothing is proved: what is granted must be next to nothing of it."""


@dataclass(frozen=True, eq=False, slots=True)
class Beside:
    """(n,) for each wall its own piece `piece`, and the corner behind that, `corner`; -1 where there is none.

    An own piece reaches its wall from `first` to `last`, fractions, equal without one, and is `apart` from it.
    `proved` (n - 1,) are the joints of each wall and the next, `runs` those in which nothing is nearer than the radius.
    """

    piece: Rows
    corner: Rows
    first: Floats
    last: Floats
    apart: Floats
    proved: Flags
    runs: Runs | None

    def settled(self, count: int) -> Flags:
        """(count,) pieces of the path that are own pieces or corners."""
        settled = np.zeros(count + 1, np.bool_)
        settled[self.piece], settled[self.corner] = True, True
        return settled[:-1]


_NO_ROWS, _NOTHING = np.zeros(0, np.intp), np.zeros(0)
NOBODY: Final = Beside(_NO_ROWS, _NO_ROWS, _NOTHING, _NOTHING, _NOTHING, np.zeros(0, np.bool_), None)
"""No own pieces, of no walls: everything has to be measured."""


class _Given(NamedTuple):
    center: PieceArrays
    surface: PieceArrays
    sign: int
    radius: float
    grant: float


class _Runs(NamedTuple):
    """Pieces (m,) beside walls: which are their own, the lengths along the wall at both ends, and how near they are."""

    own: Flags
    begin: Floats
    end: Floats
    apart: Floats


def beside(center: PieceArrays, likely: Rows, surface: PieceArrays, sign: int, radius: float, grant: float) -> Beside:
    """The own pieces of all walls; `likely` (m,) is the wall each piece may run beside, -1 where it is none.

    The cutter is on the left where `sign` is 1, on the right where it is -1.  What is off by no more than `grant`
    counts as exact.
    """
    given, count = _Given(center, surface, sign, radius, grant), len(surface)
    piece = np.full(count, -1)
    rows = (likely >= 0).nonzero()[0] if radius >= LEAST else np.zeros(0, np.intp)
    piece[likely[rows]] = rows
    own, begin, end, apart = np.zeros(count, np.bool_), np.zeros(count), np.zeros(count), np.full(count, np.inf)
    chosen = (piece >= 0).nonzero()[0]
    bent = 2 * (surface.turn[chosen] != 0.0) + (center.turn[piece[chosen]] != 0.0)
    for kind, runs in ((0, _lines), (3, _arcs)):
        j = chosen if (bent == kind).all() else chosen[bent == kind]
        if len(j):
            own[j], begin[j], end[j], apart[j] = runs(given, piece[j], j)
    piece[~own], apart[~own], begin[~own], end[~own] = -1, np.inf, 0.0, 0.0
    from_start, to_end = begin <= grant, own & (end >= surface.length - grant)
    proved, linked, corner = _joints(given, piece, from_start, to_end)
    first, last = np.where(from_start, 0.0, begin / surface.length), np.where(to_end, 1.0, end / surface.length)
    return Beside(piece, corner, first, last, apart, proved, _runs(given, corner, proved, linked))


def _lines(given: _Given, i: Rows, j: Rows) -> _Runs:
    center, surface, sign, radius, grant = given
    length = surface.length[j]
    back = np.conj(surface.vector[j] / length)
    start = (center.start[i] - surface.start[j]) * back
    end = start + center.vector[i] * back
    one, other = sign * start.imag, sign * end.imag
    apart = np.minimum(one, other)
    own = (apart >= radius - grant) & (np.maximum(one, other) <= radius + grant)
    own &= (start.real >= -grant) & (end.real <= length + grant) & (end.real >= start.real)
    return _Runs(own, start.real, end.real, apart)


def _arcs(given: _Given, i: Rows, j: Rows) -> _Runs:
    """Arcs about one center, the same way round, neither of more than half a turn, nor of uneven radii."""
    center, surface, sign, radius, grant = given
    turn, theirs, mine = surface.turn[j], surface.radius[j], center.radius[i]
    off = np.abs(center.start[i] - center.arm[i] - (surface.start[j] - surface.arm[j]))
    own = (np.abs(theirs - mine - turn * sign * radius) + off <= grant) & (center.turn[i] == turn)
    own &= (theirs - turn * sign * radius > grant) & (surface.angle[j] <= HALF)
    own &= (surface.slack[j] == 0.0) & (center.slack[i] == 0.0)
    seen = center.arm[i] * np.conj(surface.arm[j])
    begin = theirs * np.arctan2(seen.imag * turn, seen.real)
    end = begin + theirs * center.angle[i]
    own &= (begin >= -grant) & (end <= surface.length[j] + grant)
    return _Runs(own, begin, end, np.abs(theirs - mine) - off)


def _joints(given: _Given, piece: Rows, from_start: Flags, to_end: Flags) -> tuple[Flags, Flags, Rows]:
    """(n - 1,) joints that are proved, and at which own pieces meet; and (n,) corners.

    `from_start` and `to_end` (n,) are own pieces that begin at the wall's start, and that end at its end.
    """
    center, surface, grant = given.center, given.surface, given.grant
    proved, corner = np.zeros(max(len(surface) - 1, 0), np.bool_), np.full(len(surface), -1)
    j = ((piece[:-1] >= 0) & (piece[1:] >= 0)).nonzero()[0]
    meeting = np.zeros(len(proved), np.bool_)
    if not len(j):
        return proved, meeting, corner
    met = _meeting(surface, j, j + 1, grant)
    i, k = piece[j], piece[j + 1]
    linked = (k == i + 1) & _meeting(center, i, k, grant)
    whole = to_end[j] & from_start[j + 1] & met
    straight = (surface.turn[j] == 0.0) & (surface.turn[j + 1] == 0.0)
    sharp, smooth = (straight & met).nonzero()[0], (~straight & linked & whole).nonzero()[0]
    proved[j[sharp]] = _apart(given, j[sharp], i[sharp], k[sharp], linked[sharp])
    proved[j[smooth]] = _tangent(given, j[smooth], i[smooth], k[smooth])
    about = (straight & whole & (k == i + 2)).nonzero()[0]
    about = about[_about(given, j[about], i[about] + 1) & proved[j[about]]]
    corner[j[about]] = i[about] + 1
    meeting[j] = linked
    return proved, meeting, corner


def _meeting(pieces: PieceArrays, rows: Rows, following: Rows, grant: float) -> Flags:
    """Which of these pieces end where the following ones begin; one path's last and the next one's first may not."""
    meeting: Flags = np.abs(pieces.start[rows] + pieces.vector[rows] - pieces.start[following]) <= grant
    return meeting


def _apart(given: _Given, j: Rows, i: Rows, k: Rows, linked: Flags) -> Flags:
    """Straight walls j and the next: neither of their own pieces i and k is nearer to the other wall than the radius.

    Either the wall lies below the line of the piece's own wall, a radius above which the piece runs; or the pieces
    meet, a radius above both walls, and the piece comes down to there from above the other wall's line.  Walls that
    turn back on each other are measured: a piece may be as near to the other side of the one as to the other.
    """
    center, surface, sign, _, grant = given
    wall, following, one, other = surface.vector[j], surface.vector[j + 1], center.vector[i], center.vector[k]
    unit, next_unit = wall / surface.length[j], following / surface.length[j + 1]
    rise = sign * (np.conj(unit) * following).imag
    fall = sign * (np.conj(wall) * next_unit).imag
    down = sign * (np.conj(one) * next_unit).imag
    up = sign * (np.conj(unit) * other).imag
    proved: Flags = ((rise <= grant) | (linked & (down >= -grant))) & ((fall <= grant) | (linked & (up >= -grant)))
    proved &= (np.conj(unit) * next_unit).real > BACK
    return proved


def _tangent(given: _Given, j: Rows, i: Rows, k: Rows) -> Flags:
    """Walls j and the next that leave their joint Q one way, with own pieces i and k that meet over it in P.

    The normal through P and Q parts what is before the joint from what is behind it, since no arc turns by more than
    half a turn, and holds the centers of all arcs.  Seen from the center of an arc that begins in Q, a point before
    the joint is nearer in angle to Q than to any other point of the arc, or else to the arc's end; so it is no
    nearer to the arc than to Q, or than to that end.  To a line it is nearest in Q.  An own piece is no nearer to
    Q than P is.  What is left to ask is how near the ends of arcs come to the circle or line of the piece across.
    The joint is smooth within a few grants over the radius, by which an arc may be turned about Q.
    """
    surface, center, radius = given.surface, given.center, given.radius
    start, end = surface.start[j], surface.start[j + 1] + surface.vector[j + 1]
    proved = np.ones(len(j), np.bool_)
    for wall, point, piece in ((j, start, k), (j + 1, end, i)):
        give = 1e-3 * radius + 40.0 * given.grant / radius * surface.radius[wall]
        proved &= (surface.turn[wall] == 0.0) | (_from_whole(center, piece, point) >= radius + give)
    return proved


def _from_whole(pieces: PieceArrays, rows: Rows, points: Points) -> Floats:
    """Distance of each point from its piece's whole circle or endless line."""
    start, arm, vector = pieces.start[rows], pieces.arm[rows], pieces.vector[rows]
    round_ = np.abs(np.abs(points - start + arm) - pieces.radius[rows])
    along = np.abs(((points - start) * np.conj(vector)).imag) / np.where(vector == 0.0, 1.0, np.abs(vector))
    apart: Floats = np.where(pieces.turn[rows] == 0.0, along, round_)
    return apart


def _about(given: _Given, j: Rows, rows: Rows) -> Flags:
    """Which of these pieces are corners about the end of the straight wall j.

    All of a corner is ahead of the one wall and behind the other, so that both are nearest to it in their joint: it
    begins over the joint where the one's own piece ends, and ends there where the other's begins.
    """
    center, surface, sign, radius, grant = given
    off = np.abs(center.start[rows] - center.arm[rows] - surface.start[j] - surface.vector[j])
    off += np.abs(center.radius[rows] - radius)
    about: Flags = (off <= grant) & (center.turn[rows] == -sign) & (center.angle[rows] <= HALF)
    about &= (center.slack[rows] == 0.0) & _meeting(center, rows - 1, rows, grant)
    about &= _meeting(center, rows, rows + 1, grant)
    return about


def _runs(given: _Given, corner: Rows, proved: Flags, linked: Flags) -> Runs | None:
    """Runs of straight walls that turn one way at every joint, and by half a turn in all at the most.

    Where they turn away from the cutter, every wall lies below the line of every other, and below a line through a
    joint between the directions of its two walls; an own piece runs a radius above its wall's line, and so does
    every place of a corner.  Where they turn towards the cutter and the own pieces meet at every joint, the path, seen
    from the line of any of the walls, comes down to that wall's own piece, a radius above it, and goes up from there:
    each own piece runs on along its wall, which rises from that line, and gives way by a grant at the most, as the
    joint between them does.

    The sums are those of the joints' sines, for each way, which are no less than the angles by pi / 2 up to a right
    one; and of STEP or GIVES each, for what is granted.  Any other joint ends a run; a corner belongs to the joint
    behind it.
    """
    surface = given.surface
    straight = surface.turn == 0.0
    plain = proved & straight[:-1] & straight[1:]
    unit = surface.vector / surface.length
    bend = np.conj(unit[:-1]) * unit[1:]
    plain &= bend.real > 0.0
    if 2 * np.count_nonzero(plain) < len(plain):
        return None
    rise = given.sign * bend.imag
    step = max(STEP, GIVES * given.grant)
    sines = np.where((plain & (rise <= 0.0), plain & linked & (rise >= 0.0)), np.abs(rise) + step, END)
    sums = np.zeros((2, len(surface) + 1))
    np.cumsum(sines, axis=1, out=sums[:, 1:-1])
    sums[:, -1] = sums[:, -2] + END
    begin, behind = sums[:, :-1], sums[:, 1:]
    return Runs(begin, np.where(corner >= 0, behind, begin), begin, begin)
