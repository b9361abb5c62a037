"""Farthest: where along stretches of one path the distance to another path is largest.

The distance to a path is the least of the distances to its pieces, so along a span it is bounded from above by
the largest distance to any one of them, which has a formula, and from below by its value anywhere.  A span
whose bound exceeds the best value found on its stretch is divided where its two ends' nearest pieces are
equally far, or where the one that is nearest to both is farthest, until both agree within `FINE`: if no other piece is
nearer there, that is at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Final

import numpy as np

from core.geometry.distance import between, distance, farthest_places
from core.geometry.path import Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, place
from core.tolerance import GOUGE
from core.verify.reach import Stretches, changes, nearest

FINE: Final = 1e-8
"""Millimeters between the bounds of a largest distance at which it counts as known."""

ROUNDS: Final = 100
"""Divisions after which doubles cannot part a span of any size further."""


SECTIONS: Final = np.linspace(0.0, 1.0, 17)[:, None]
"""(17, 1) shares of a span at which both nearest pieces are compared."""

NARROWINGS: Final = 3
"""Times that a span is narrowed to the section in which the other piece becomes the nearer one."""

LEAST_SHARE: Final = 1e-3
"""Share of a span nearer than which to its ends it is not divided."""


@dataclass(frozen=True, eq=False, slots=True)
class Farthest:
    """(k,) for each stretch the place, in length traveled, that is farthest from the other path, how far it is, and
    the first of the other path's pieces that are nearest to it."""

    place: Floats
    apart: Floats
    near: Rows


@dataclass(frozen=True, eq=False, slots=True)
class _Spans:
    """m parts of single pieces, `index`, each of stretch `owner`: places, distances and nearest pieces at both ends
    (2, m)."""

    owner: Rows
    index: Rows
    s: Floats
    apart: Floats
    near: Rows

    def take(self, rows: Rows) -> _Spans:
        s, apart, near = self.s.take(rows, axis=1), self.apart.take(rows, axis=1), self.near.take(rows, axis=1)
        return _Spans(self.owner[rows], self.index[rows], s, apart, near)


@dataclass(frozen=True, eq=False, slots=True)
class _Search:
    """The path that is walked, its stations, the other path and its boxes; `give` is for rounding and uneven arcs.

    Of pieces that are equally near, within `tie`, the first one is told.
    """

    walked: PieceArrays
    stations: Floats
    other: PieceArrays
    bounds: Floats
    give: float
    tie: float

    def look(self, s: Floats, known: Floats) -> tuple[Floats, Rows]:
        """Distance of each place from the other path, no larger than `known`, and the first piece it is nearest to."""
        found = nearest(self.points(s), self.other, self.bounds, tie=self.tie, known=known + self.give)
        first = found.k.searchsorted(np.arange(len(s)))
        return np.minimum.reduceat(found.apart, first), found.j[first]

    def look_or_measure(self, s: Floats, near: Rows, known: Floats) -> tuple[Floats, Rows]:
        """The same, where `near` is -1; elsewhere the nearest piece is `near`."""
        new, old = (near < 0).nonzero()[0], (near >= 0).nonzero()[0]
        if not len(old):
            return self.look(s, known)
        apart, near = np.empty(len(s)), near.copy()
        apart[old] = distance(self.other.take(near[old]), self.points(s[old]))
        if len(new):
            apart[new], near[new] = self.look(s[new], known[new])
        return apart, near

    def fractions(self, spans: _Spans) -> Floats:
        """(2, m) fractions of the spans' ends on their pieces."""
        length = self.walked.length[spans.index]
        return (spans.s - self.stations[spans.index]) / np.where(length == 0.0, 1.0, length)

    def points(self, s: Floats) -> Points:
        """Points at places along the walked path."""
        index, t = place(self.walked, self.stations, s)
        return at(self.walked.take(index), t)


def farthest(
    walked: PieceArrays,
    stretches: Stretches,
    other: PieceArrays,
    around: Floats,
    *,
    near: Rows | None = None,
    ends: float = inf,
    most: float = inf,
    tie: float = 0.0,
) -> Farthest:
    """The largest distance from `other`, within FINE, on each stretch of `walked`; `other` has at least one piece.

    `around` are the boxes of `other`.
    `near` (2, k) are the pieces of `other` nearest to the stretches' ends, -1 where unknown; where they are known the
    distance is at most `ends`.  No distance is larger than `most`: a place as far as that is the farthest.  Of pieces
    that are equally near, within `tie`, the first one is told.
    """
    near = np.full((2, len(stretches)), -1) if near is None else near
    search = _Search(walked, walked.stations, other, around, GOUGE + 2.0 * float(walked.slack.max(initial=0.0)), tie)
    spans, best = _begin(search, stretches, near, ends)
    for turn in range(ROUNDS):
        rows = (best.apart[spans.owner] < most - FINE).nonzero()[0]
        if not len(rows):
            break
        if len(rows) < len(spans.index):
            spans = spans.take(rows)
        bounds, peaks = _bounds(search, spans)
        rows = (bounds > best.apart[spans.owner] + FINE).nonzero()[0]
        if not len(rows):
            break
        spans = spans.take(rows)
        share = _shares(search, spans, peaks[rows]) if turn % 3 < 2 else np.full(len(rows), 0.5)
        spans, best = _divide(search, spans, share, best)
    return best


def _begin(search: _Search, stretches: Stretches, near: Rows, ends: float) -> tuple[_Spans, Farthest]:
    """Stretches parted at the joints within them, and the best of all their ends and joints."""
    joints = search.stations[1:-1]
    owner = stretches.index(joints)
    inside = (owner >= 0) & (joints < stretches.last[owner])
    each = np.arange(len(stretches))
    owners = np.concatenate((each, each, owner[inside]))
    s = np.concatenate((stretches.first, stretches.last, joints[inside]))
    order = np.lexsort((s, owners))
    known = np.concatenate((near[0], near[1], np.full(len(s) - 2 * len(each), -1)))[order]
    owners, s = owners[order], s[order]
    most = ends + _from_ends(stretches, near, owners, s)
    apart, near = search.look_or_measure(s, known, most)
    pairs = ((owners[1:] == owners[:-1]) & (s[1:] > s[:-1])).nonzero()[0]
    both = np.array((pairs, pairs + 1))
    none = Farthest(np.zeros(len(each)), np.full(len(each), -np.inf), np.full(len(each), -1))
    index = joints.searchsorted((s[pairs] + s[pairs + 1]) / 2.0, side="right")
    return _Spans(owners[pairs], index, s[both], apart[both], near[both]), _better(none, owners, s, apart, near)


def _from_ends(stretches: Stretches, near: Rows, owner: Rows, s: Floats) -> Floats:
    """Length along the stretch to the nearer of those of its ends where the nearest piece is known."""
    first = np.where(near[0] >= 0, stretches.first, -np.inf)
    last = np.where(near[1] >= 0, stretches.last, np.inf)
    nearer: Floats = np.minimum(s - first[owner], last[owner] - s)
    return nearer


def _better(best: Farthest, owner: Rows, s: Floats, apart: Floats, near: Rows) -> Farthest:
    """`best` with the places `s` of stretches `owner` where these are farther."""
    where, size, by = best.place.copy(), best.apart.copy(), best.near.copy()
    # of each stretch the largest comes first
    order = np.lexsort((apart, owner))[::-1]
    first = order[changes(owner[order])]
    first = first[apart[first] > size[owner[first]]]
    chosen = owner[first]
    where[chosen], size[chosen], by[chosen] = s[first], apart[first], near[first]
    return Farthest(where, size, by)


def _bounds(search: _Search, spans: _Spans) -> tuple[Floats, Floats]:
    """What the distance cannot exceed on each span, and the share of it where the piece nearest to its beginning may be
    farthest, any where that is at an end."""
    t, count = search.fractions(spans), len(spans.index)
    twice = np.concatenate((spans.index, spans.index))
    piece, near = search.walked.take(twice), search.other.take(spans.near.ravel())
    across = distance(near, at(piece, t[::-1].ravel()))
    highest, peaks = _within_span(piece, near, np.concatenate((t, t), axis=1))
    np.maximum(highest, across, out=highest)
    np.maximum(highest, spans.apart.ravel(), out=highest)
    return np.minimum(highest[:count], highest[count:]), (peaks[:count] - t[0]) / (t[1] - t[0])


def _shares(search: _Search, spans: _Spans, peaks: Floats) -> Floats:
    """Where to divide each span, kept off both ends: at its peak if one piece is nearest to both."""
    share, several = peaks, (spans.near[0] != spans.near[1]).nonzero()[0]
    if len(several):
        share[several] = _equally_far(search, spans.take(several))
    share[np.isnan(share)] = 0.5
    return np.minimum(np.maximum(share, LEAST_SHARE), 1.0 - LEAST_SHARE)


def _equally_far(search: _Search, spans: _Spans) -> Floats:
    """The share of each span at which the nearest pieces of its two ends are equally far."""
    piece, (one, other) = search.walked.take(spans.index), (search.other.take(near) for near in spans.near)
    first, last = search.fractions(spans)
    low, high, each = first, last, np.arange(len(first))
    for _ in range(NARROWINGS):
        places = low + SECTIONS * (high - low)
        points = at(piece, places)
        nearer = distance(other, points) - distance(one, points)
        behind = np.maximum(np.argmax(nearer < 0.0, axis=0), 1)
        (low, high), (before, after) = ((of[behind - 1, each], of[behind, each]) for of in (places, nearer))
    met = low + (high - low) * np.where(before > after, before / (before - after), 0.5)
    share: Floats = (met - first) / (last - first)
    return share


def _within_span(piece: PieceArrays, near: PieceArrays, t: Floats) -> tuple[Floats, Floats]:
    """Largest distance to one nearest piece at the places inside the span `t` (2, m) where it can be largest, and the
    place, if there is one."""
    places = farthest_places(piece, near)
    inside = (places > t[0]) & (places < t[1])
    if not inside.any():
        return np.zeros(len(piece)), t[0]
    apart = np.where(inside, between(piece, near, places), 0.0)
    best, each = apart.argmax(axis=0), np.arange(len(piece))
    return apart[best, each], places[best, each]


def _divide(search: _Search, spans: _Spans, share: Floats, best: Farthest) -> tuple[_Spans, Farthest]:
    """Every span in two at `share` of its length, and the best of the places between."""
    s = spans.s[0] + share * (spans.s[1] - spans.s[0])
    apart, near = search.look(s, (spans.apart + np.abs(s - spans.s)).min(axis=0))
    halves = [
        np.array((np.concatenate((kept[0], new)), np.concatenate((new, kept[1]))))
        for kept, new in ((spans.s, s), (spans.apart, apart), (spans.near, near))
    ]
    best = _better(best, spans.owner, s, apart, near)
    owner, index = np.concatenate((spans.owner, spans.owner)), np.concatenate((spans.index, spans.index))
    return _Spans(owner, index, *halves), best
