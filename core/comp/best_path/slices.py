"""Slices: the side pieces of the raw offset cut at every self-intersection.

A slice runs from one meeting to the next, across smooth joints.  One that turns the wrong way at a crossing is dead
(BEST_PATH.md, "Crossings").  Nodes are the points where slices begin and end; points within JOINED of each other on a
piece are one node.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain
from typing import Final, NamedTuple

import numpy as np

from core.comp.best_path.prepared_contour import NOT_WHOLE_TURN
from core.comp.best_path.raw_offset import RawOffset
from core.geometry.intersect import MeetingKind, Meetings, meet_pieces
from core.geometry.nearby import near_pairs, near_pairs_within
from core.geometry.path import Flags, Floats, Points, Rows, boxes, next_in_ring
from core.tolerance import JOINED, ON_PATH

MAX_PAIRS: Final = 8_000_000
"""More pairs of near pieces than any real part has: such a scribble is refused."""

MAX_INTERSECTIONS: Final = 2_000_000
"""More meetings than any real part has: such a scribble is refused too."""

_ALMOST_FULL_TURN: Final = 6.28
"""Radians, a little less than a full turn."""


class Intersections(NamedTuple):
    """e meetings of raw pieces `a` and `b` (e,) at `points` (e,), `along_a` and `along_b` mm along them.

    `turn` (e,) is positive if they cross away from their ends and going from a to b turns to the cutter's side,
    negative if going from b to a does, 0 if they touch, overlap, or meet at an end.
    """

    a: Rows
    b: Rows
    along_a: Floats
    along_b: Floats
    points: Points
    turn: Floats


def _self_intersections(raw: RawOffset, sign: int) -> Intersections | None:
    """Return all meetings of side pieces with raw pieces away from joints; None if too many for a real part."""
    parts, pairs, count = [], 0, 0
    for i, j in _pairs(raw):
        pairs += len(i)
        if pairs > MAX_PAIRS or count > MAX_INTERSECTIONS:
            return None
        met = meet_pieces(raw.pieces, i, raw.pieces, j)
        count += len(met.pair)
        parts.append(_intersections(raw, i, j, met, sign))
        overlap = (met.kinds == MeetingKind.OVERLAP).nonzero()[0]
        if len(overlap):
            parts.append(_overlaps(raw, i[overlap], j[overlap]))
    return _concatenated(parts)


def _pairs(raw: RawOffset) -> Iterator[tuple[Rows, Rows]]:
    """Yield pairs of near side pieces, and of near side and outline pieces, that may meet away from their joint.

    Smoothly joined pieces meet only at their joint, unless together they turn once around in one direction.
    """
    box, side, outline = boxes(raw.pieces), raw.side.nonzero()[0], (~raw.side).nonzero()[0]
    only_at_joint = _meet_next_only_at_joint(raw)
    of_sides = ((side[i], side[j]) for i, j in near_pairs_within(box[:, side], 4.0 * ON_PATH))
    with_outline = ((side[i], outline[j]) for i, j in near_pairs(box[:, side], box[:, outline], 4.0 * ON_PATH))
    for i, j in chain(of_sides, with_outline):
        keep = ~((only_at_joint[i] & (raw.following[i] == j)) | (only_at_joint[j] & (raw.following[j] == i)))
        yield i[keep], j[keep]


def _meet_next_only_at_joint(raw: RawOffset) -> Flags:
    """Return (m,) True for pieces that meet the following one only at their joint."""
    arm = np.abs(raw.start - raw.center)
    swept = np.where(raw.turns == 0, 0.0, raw.lengths / np.where(raw.turns == 0, 1.0, arm))
    after = raw.following
    only_at_joint = swept + swept[after] < _ALMOST_FULL_TURN
    only_at_joint |= (raw.turns * raw.turns[after] <= 0) & (np.maximum(swept, swept[after]) < NOT_WHOLE_TURN)
    only_at_joint &= raw.smooth
    return only_at_joint


def _concatenated(parts: list[Intersections]) -> Intersections:
    none = np.empty(0, np.intp)
    empty = Intersections(none, none, np.empty(0), np.empty(0), np.empty(0, np.complex128), np.empty(0))
    return Intersections._make(map(np.concatenate, zip(empty, *parts, strict=True)))


def _intersections(raw: RawOffset, i: Rows, j: Rows, met: Meetings, sign: int) -> Intersections:
    a, b, points = i[met.pair], j[met.pair], met.points
    bend = raw.directions(a, points).conj() * raw.directions(b, points)
    ends = np.minimum(np.minimum(met.along_a, met.to_end_a), np.minimum(met.along_b, met.to_end_b))
    proper = (met.kinds[met.pair] == MeetingKind.CROSS) & (ends > JOINED)
    return Intersections(a, b, met.along_a, met.along_b, points, np.where(proper, sign * bend.imag, 0.0))


def _overlaps(raw: RawOffset, i: Rows, j: Rows) -> Intersections:
    """Return, for pieces that run along each other, each end that lies on the other piece."""
    parts = []
    for a, b in ((i, j), (j, i)):
        for ends, along in ((raw.start[b], np.zeros(len(b))), (raw.end[b], raw.lengths[b])):
            along_other = raw.along(a, ends)
            inside = ((along_other >= -JOINED) & (along_other <= raw.lengths[a] + JOINED)).nonzero()[0]
            parts.append(
                Intersections(
                    a[inside], b[inside], along_other[inside], along[inside], ends[inside], np.zeros(len(inside))
                )
            )
    return _concatenated(parts)


@dataclass(frozen=True, eq=False, slots=True)
class Slices:
    """s slices in order of travel: from `begin` mm along `piece` to `end` mm along `end_piece` (s,), `size` mm long.

    They run from node `first` to node `last` (s,).  `dead` (s,) marks slices that turn the wrong way or are blunt at
    one end.  `points` are the nodes' positions; `outer` marks the nodes at which an outline piece is involved.
    """

    piece: Rows
    end_piece: Rows
    begin: Floats
    end: Floats
    size: Floats
    first: Rows
    last: Rows
    dead: Flags
    points: Points
    outer: Flags

    def __len__(self) -> int:
        return len(self.piece)

    def take(self, rows: Rows) -> Slices:
        """Return the slices of these rows, with all nodes."""
        names = ("piece", "end_piece", "begin", "end", "size", "first", "last", "dead")
        columns = {name: getattr(self, name)[rows] for name in names}
        return Slices(**columns, points=self.points, outer=self.outer)

    def middles(self, raw: RawOffset, rows: Rows) -> tuple[Points, Rows]:
        """Return the points halfway along slices, and the pieces that these lie on."""
        piece, along = self.piece[rows], (self.begin[rows] + self.end[rows]) / 2.0
        several = (piece != self.end_piece[rows]).nonzero()[0]
        if len(several):
            part = rows[several]
            traveled = np.cumsum(raw.lengths)
            half = traveled[piece[several]] - raw.lengths[piece[several]] + self.begin[part] + self.size[part] / 2.0
            inner = np.clip(np.searchsorted(traveled, half), piece[several], self.end_piece[part])
            piece[several] = inner
            along[several] = np.clip(half - traveled[inner] + raw.lengths[inner], 0.0, raw.lengths[inner])
        return raw.at(piece, along), piece


class _Stations(NamedTuple):
    """Every intersection on both of its pieces, by piece and as traveled: piece, distance along it, node, turn.

    `turn` is positive if the piece ends its clear stretch there, negative if it begins one.
    """

    piece: Rows
    along: Floats
    node: Rows
    turn: Floats

    def of(self, pieces: Flags) -> _Stations:
        """Return the stations on the marked pieces."""
        rows = pieces[self.piece].nonzero()[0]
        return _Stations._make(column[rows] for column in self)

    def twins(self) -> tuple[Rows, Rows]:
        """Return the node pairs of consecutive stations on one piece within JOINED of each other."""
        same = (self.piece[1:] == self.piece[:-1]) & (self.along[1:] - self.along[:-1] <= JOINED)
        return self.node[:-1][same], self.node[1:][same]


def sliced(raw: RawOffset, sign: int) -> Slices | None:
    """Cut the side pieces at all self-intersections; return None if there are too many for a real part."""
    meetings = _self_intersections(raw, sign)
    if meetings is None:
        return None
    heads, tails, ends = _strands(raw)
    points, outer = _nodes(raw, meetings, heads, tails)
    stations = _stations(raw, meetings, 2 * len(heads))
    del meetings
    first_twin, second_twin = stations.of(~raw.side).twins()
    stations = stations.of(raw.side)
    head = np.arange(len(heads)) + np.searchsorted(stations.piece, heads)
    at = np.arange(len(stations.piece)) + np.searchsorted(heads, stations.piece, side="right")
    count = len(head) + len(at)
    piece, begin, first = np.empty(count, np.intp), np.zeros(count), np.empty(count, np.intp)
    piece[head], first[head] = heads, np.arange(len(head))
    piece[at], begin[at], first[at] = stations.piece, stations.along, stations.node
    tail = np.append(head[1:], count)[: len(head)] - 1
    end_piece, end, last = next_in_ring(piece), next_in_ring(begin), next_in_ring(first)
    end_piece[tail], end[tail], last[tail] = tails, raw.lengths[tails], ends
    dead = np.zeros(count, np.bool_)
    dead[at[stations.turn > 0.0]] = True
    dead[at[stations.turn < 0.0] - 1] = True
    dead[head] |= raw.blunt_start[heads]
    dead[tail] |= raw.blunt_end[tails]
    traveled = np.cumsum(raw.lengths) - raw.lengths
    # as a difference along the piece if a slice lies on a single one
    size = np.where(piece == end_piece, end - begin, (traveled[end_piece] + end) - (traveled[piece] + begin))
    cut = Slices(piece, end_piece, begin, end, size, first, last, dead, points, outer)
    rings = (raw.start[heads] == raw.end[tails]).nonzero()[0]
    return _welded(cut, np.concatenate((first_twin, rings)), np.concatenate((second_twin, ends[rings])))


def _strands(raw: RawOffset) -> tuple[Rows, Rows, Rows]:
    """Return the first pieces, the last pieces and the end nodes of strands, runs of smoothly joined side pieces.

    A full circle is a strand of its own.  A strand that another one follows ends at that one's first node; each has two
    nodes of its own.
    """
    pieces = raw.side.nonzero()[0]
    goes_on = raw.smooth & (raw.following == np.arange(1, len(raw) + 1)) & (raw.start != raw.end)
    goes_on[:-1] &= raw.start[1:] != raw.end[1:]
    begins = np.ones(len(pieces), np.bool_)
    begins[1:] = ~goes_on[pieces[:-1]]
    heads = pieces[begins]
    tails = pieces[np.append(begins[1:], True)[: len(pieces)]]
    count = len(heads)
    after = raw.following[tails]
    joined = (after >= 0) & raw.side[after]
    ends = np.where(joined, np.searchsorted(heads, after), np.arange(count) + count)
    return heads, tails, ends


def _stations(raw: RawOffset, met: Intersections, nodes: int) -> _Stations:
    piece, along = np.concatenate((met.a, met.b)), np.concatenate((met.along_a, met.along_b))
    node, turn = np.tile(nodes + np.arange(len(met.a)), 2), np.concatenate((met.turn, -met.turn))
    order = np.lexsort((along, piece))
    piece = piece[order]
    along = np.minimum(np.maximum(along[order], 0.0), raw.lengths[piece])
    return _Stations(piece, along, node[order], turn[order])


def _nodes(raw: RawOffset, met: Intersections, heads: Rows, tails: Rows) -> tuple[Points, Flags]:
    """Return all nodes before welding: the strands' starts and ends, then the meetings; and those on the outline."""
    count = len(heads)
    points = np.concatenate((raw.start[heads], raw.end[tails], met.points))
    outer = np.zeros(len(points), np.bool_)
    after = raw.following[tails]
    outer[count : 2 * count] = (after >= 0) & ~raw.side[after]
    before = np.zeros(len(raw), np.bool_)
    before[raw.following[~raw.side & (raw.following >= 0)]] = True
    outer[:count] = before[heads]
    outer[2 * count :] = ~(raw.side[met.a] & raw.side[met.b])
    return points, outer


def _welded(cut: Slices, node: Rows, other: Rows) -> Slices:
    """Drop slices no longer than JOINED and merge their two nodes; also merge nodes `node` with nodes `other`."""
    short = cut.size <= JOINED
    if not short.any() and not len(node):
        return cut
    node, other = np.concatenate((node, cut.first[short])), np.concatenate((other, cut.last[short]))
    same = least_of_connected(len(cut.points), node, other)
    outer = cut.outer.copy()
    outer[same[cut.outer]] = True
    joined = replace(cut, first=same[cut.first], last=same[cut.last], outer=outer)
    return joined.take((~short).nonzero()[0])


def least_of_connected(count: int, first: Rows, second: Rows) -> Rows:
    """Return, for each number below `count`, the least number that the pairs first, second (p,) connect it to."""
    same = np.arange(count)
    while True:
        least = np.minimum(same[first], same[second])
        before = same.copy()
        np.minimum.at(same, first, least)
        np.minimum.at(same, second, least)
        np.minimum.at(same, before[first], least)
        np.minimum.at(same, before[second], least)
        same = same[same]
        if np.array_equal(same, before):
            return same
