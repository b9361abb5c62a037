"""Events: the points where raw pieces meet, and which way round each meeting may be passed.

Where two raw pieces properly cross, the cutter may only come along the one and leave along the other so that it turns
towards its free side; the two other stretches lie, next to the point, nearer to a wall than the radius.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import tau
from typing import Final

import numpy as np

from core.comp.best_path.raw_offset import Raw
from core.comp.best_path.tree import near, near_selves, piece_boxes, tree
from core.geometry.intersect import Meeting, Meetings, meet_pieces
from core.geometry.path import Flags, Floats, Points, Rows, as_complex
from core.tolerance import JOINED, ON_PATH

MOST_PAIRS: Final = 8_000_000
"""More pairs of pieces near one another than any part has: such a scribble is refused."""

MOST_EVENTS: Final = 2_000_000
"""More meetings than any part has, likewise."""

_ONCE_AROUND: Final = 6.28
"""Radians, a little less than a full turn."""

_NOT_WHOLE: Final = 6.0
"""Radians; an arc that turns through less ends well away from its start."""


@dataclass(frozen=True, eq=False, slots=True)
class Events:
    """e meetings of pieces `one` and `other` (e,) at `points` (e,), `along_one` and `along_other` mm along them.

    `turn` (e,) is positive where they cross off their ends and the way from one to the other turns to the cutter's
    side, negative where the way from other to one does, 0 where they touch, overlap, or meet at an end.
    """

    one: Rows
    other: Rows
    along_one: Floats
    along_other: Floats
    points: Points
    turn: Floats


def events(raw: Raw, sign: int) -> Events | None:
    """All meetings of side pieces with raw pieces but at their joints; None if there are too many to be a part's."""
    found, pairs, count = [], 0, 0
    for i, j in _pairs(raw):
        if not len(i):
            continue
        pairs += len(i)
        if pairs > MOST_PAIRS or count > MOST_EVENTS:
            return None
        met = meet_pieces(raw.pieces, i, raw.pieces, j)
        count += len(met.pair)
        found.append(_events(raw, i, j, met, sign))
        over = (met.kinds == Meeting.OVERLAP).nonzero()[0]
        if len(over):
            found.append(_overlaps(raw, i[over], j[over]))
    return _all(found)


def _pairs(raw: Raw) -> Iterator[tuple[Rows, Rows]]:
    """Pairs of side pieces, and of side and outline pieces, that lie near each other and may meet off their joint.

    Pieces joined smoothly meet only at their joint, unless together they go once around one way.
    """
    boxes = piece_boxes(*raw.pieces, 2.0 * ON_PATH)
    own, rest = raw.side.nonzero()[0], (~raw.side).nonzero()[0]
    mine, first = tree(boxes[:, own]), int(own[0]) if len(own) else 0
    parted = _parted(raw)
    for i, j in near_selves(mine, (parted & (raw.following == np.arange(1, len(raw) + 1)))[own]):
        i, j = i + first, j + first
        keep = ~(parted[j] & (raw.following[j] == i))
        yield i[keep], j[keep]
    for i, j in near(mine, tree(boxes[:, rest]), 0.0):
        i, j = i + first, rest[j]
        keep = ~((parted[i] & (raw.following[i] == j)) | (parted[j] & (raw.following[j] == i)))
        yield i[keep], j[keep]


def _parted(raw: Raw) -> Flags:
    """(m,) which pieces meet the one that follows nowhere but at their joint."""
    arm = np.abs(raw.start - raw.center)
    swept = np.where(raw.turns == 0, 0.0, raw.lengths / np.where(raw.turns == 0, 1.0, arm))
    behind = raw.following
    parted = swept + swept[behind] < _ONCE_AROUND
    parted |= (raw.turns * raw.turns[behind] <= 0) & (np.maximum(swept, swept[behind]) < _NOT_WHOLE)
    parted &= raw.smooth
    return parted


def _all(found: list[Events]) -> Events:
    none = np.empty(0, np.intp)
    found = found or [Events(none, none, np.empty(0), np.empty(0), np.empty(0, np.complex128), np.empty(0))]
    names = ("one", "other", "along_one", "along_other", "points", "turn")
    return Events(*(np.concatenate([getattr(some, name) for some in found]) for name in names))


def _events(raw: Raw, i: Rows, j: Rows, met: Meetings, sign: int) -> Events:
    one, other, points = i[met.pair], j[met.pair], as_complex(met.points)
    bend = directions(raw, one, points).conj() * directions(raw, other, points)
    ends = np.minimum(np.minimum(met.along_a, met.rest_a), np.minimum(met.along_b, met.rest_b))
    proper = (met.kinds[met.pair] == Meeting.CROSS) & (ends > JOINED)
    return Events(one, other, met.along_a, met.along_b, points, np.where(proper, sign * bend.imag, 0.0))


def directions(raw: Raw, rows: Rows, points: Points) -> Points:
    """(k,) directions of travel of pieces at points on them, not of unit length."""
    along: Points = np.where(
        raw.turns[rows] == 0, raw.end[rows] - raw.start[rows], 1j * raw.turns[rows] * (points - raw.center[rows])
    )
    return along


def _overlaps(raw: Raw, i: Rows, j: Rows) -> Events:
    """Of pieces that run along each other, each end that lies on the other piece."""
    found = []
    for one, other in ((i, j), (j, i)):
        for ends, along in ((raw.start[other], np.zeros(len(other))), (raw.end[other], raw.lengths[other])):
            at = along_of(raw, one, ends)
            on = ((at >= -JOINED) & (at <= raw.lengths[one] + JOINED)).nonzero()[0]
            found.append(Events(one[on], other[on], at[on], along[on], ends[on], np.zeros(len(on))))
    return _all(found)


def along_of(raw: Raw, rows: Rows, points: Points) -> Floats:
    """(k,) distances from the pieces' starts of the places abreast of points."""
    start, center, turns = raw.start[rows], raw.center[rows], raw.turns[rows]
    straight = turns == 0
    span = raw.end[rows] - start
    line = (span.conj() * (points - start)).real / np.where(straight, np.abs(span), 1.0)
    arm = start - center
    angle = np.mod(np.angle(arm.conj() * (points - center)) * turns, tau)
    angle = np.where((tau - angle) * np.abs(arm) <= JOINED, angle - tau, angle)
    along: Floats = np.where(straight, line, angle * np.abs(arm))
    return along


def places(raw: Raw, rows: Rows, along: Floats) -> Points:
    """(k,) points at distances from the pieces' starts."""
    start, turns = raw.start[rows], raw.turns[rows]
    arm = np.where(turns == 0, raw.start[rows] - raw.end[rows], start - raw.center[rows])
    size = np.abs(arm)
    straight = start - arm * (along / size)
    curved = start - arm + arm * np.exp(1j * turns * (along / size))
    points: Points = np.where(turns == 0, straight, curved)
    return points
