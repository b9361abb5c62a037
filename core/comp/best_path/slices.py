"""Slices: the side pieces cut at every event, and which of them the cutter can run along.

Whether the cutter is clear of the part changes only at events, and at a crossing the slice before it and the one behind
it that turns to the cutter's side are clear or not together.  So a slice runs from one event to the next, over as many
pieces as are joined smoothly.  Nodes are the points where slices begin and end; points within JOINED of each other on
a piece are one node.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from core.comp.best_path.meetings import Events, places
from core.comp.best_path.raw_offset import Raw
from core.geometry.path import Flags, Floats, Points, Rows, next_in_ring
from core.tolerance import CROWDED, JOINED


@dataclass(frozen=True, eq=False, slots=True)
class Slices:
    """s slices in order of travel: from `begin` mm along `piece` to `end` mm along `until` (s,), `size` mm long.

    They run from node `first` to node `last` (s,).  `dead` (s,) marks slices that turn the wrong way at one of their
    ends or are blunt there; `turning` (s,) is the slice that a slice at its end turns to at a crossing, -1 if none.
    `points` are the nodes' places; `outer` marks the nodes where the outline takes part.
    """

    piece: Rows
    until: Rows
    begin: Floats
    end: Floats
    size: Floats
    first: Rows
    last: Rows
    dead: Flags
    turning: Rows
    points: Points
    outer: Flags

    def __len__(self) -> int:
        return len(self.piece)

    def take(self, rows: Rows) -> Slices:
        """Some slices, with all nodes."""
        place = np.full(len(self) + 1, -1)
        place[rows] = np.arange(len(rows))
        names = ("piece", "until", "begin", "end", "size", "first", "last", "dead")
        some = {name: getattr(self, name)[rows] for name in names}
        return Slices(**some, turning=place[self.turning[rows]], points=self.points, outer=self.outer)


class _Strands(NamedTuple):
    """Side pieces joined smoothly one behind the other: the first and the last of each, and their nodes.

    A strand that another one follows ends at that one's first node.  `nodes` is how many nodes the strands have.
    """

    heads: Rows
    tails: Rows
    ends: Rows
    nodes: int


class _Stations(NamedTuple):
    """Every event on both its pieces, by piece and as traveled: piece, distance along it, event, node, and turn.

    `turn` is positive where the piece ends its clear stretch at the event, negative where it begins it.
    """

    piece: Rows
    along: Floats
    event: Rows
    node: Rows
    turn: Floats

    def of(self, pieces: Flags) -> _Stations:
        """Those on some pieces."""
        rows = pieces[self.piece].nonzero()[0]
        return _Stations(self.piece[rows], self.along[rows], self.event[rows], self.node[rows], self.turn[rows])

    def twins(self) -> tuple[Rows, Rows]:
        """The nodes of stations that follow each other on one piece within JOINED."""
        same = (self.piece[1:] == self.piece[:-1]) & (self.along[1:] - self.along[:-1] <= JOINED)
        return self.node[:-1][same], self.node[1:][same]


def sliced(raw: Raw, found: Events) -> Slices:
    """The side pieces cut at all events."""
    strands = _strands(raw)
    stations = _stations(raw, found, strands.nodes)
    one, other = stations.of(~raw.side).twins()
    stations = stations.of(raw.side)
    head = np.arange(len(strands.heads)) + np.searchsorted(stations.piece, strands.heads)
    at = np.arange(len(stations.piece)) + np.searchsorted(strands.heads, stations.piece, side="right")
    count = len(head) + len(at)
    piece, begin, first = np.empty(count, np.intp), np.zeros(count), np.empty(count, np.intp)
    piece[head], first[head] = strands.heads, np.arange(len(head))
    piece[at], begin[at], first[at] = stations.piece, stations.along, stations.node
    tail = np.append(head[1:], count)[: len(head)] - 1
    until, end, last = next_in_ring(piece), next_in_ring(begin), next_in_ring(first)
    until[tail], end[tail], last[tail] = strands.tails, raw.lengths[strands.tails], strands.ends
    dead, turning = _turns(stations, at - 1, _alone(raw, stations), count)
    del stations, at
    dead[head] |= raw.blunt_start[strands.heads]
    dead[tail] |= raw.blunt_end[strands.tails]
    size = _sizes(raw, piece, begin, until, end)
    points, outer = _nodes(raw, found, strands)
    cut = Slices(piece, until, begin, end, size, first, last, dead, turning, points, outer)
    whole = (raw.start[strands.heads] == raw.end[strands.tails]).nonzero()[0]
    return _welded(cut, np.concatenate((one, whole)), np.concatenate((other, strands.ends[whole])))


def _strands(raw: Raw) -> _Strands:
    """The strands of a raw chain; full circles are strands of their own."""
    pieces = raw.side.nonzero()[0]
    next_in_ring = raw.smooth & (raw.following == np.arange(1, len(raw) + 1)) & (raw.start != raw.end)
    next_in_ring[:-1] &= raw.start[1:] != raw.end[1:]
    begins = np.ones(len(pieces), np.bool_)
    begins[1:] = ~next_in_ring[pieces[:-1]]
    heads = pieces[begins]
    tails = pieces[np.append(begins[1:], True)[: len(pieces)]]
    count = len(heads)
    behind = raw.following[tails]
    joined = (behind >= 0) & raw.side[behind]
    ends = np.where(joined, np.searchsorted(heads, behind), np.arange(count) + count)
    return _Strands(heads, tails, ends, 2 * count)


def _stations(raw: Raw, found: Events, nodes: int) -> _Stations:
    piece = np.concatenate((found.one, found.other))
    along = np.concatenate((found.along_one, found.along_other))
    event = np.tile(np.arange(len(found.one)), 2)
    turn = np.concatenate((found.turn, -found.turn))
    order = _sorted(piece, along)
    piece, event = piece[order], event[order]
    return _Stations(
        piece, np.minimum(np.maximum(along[order], 0.0), raw.lengths[piece]), event, nodes + event, turn[order]
    )


def _sorted(piece: Rows, along: Floats) -> Rows:
    """The order by piece and then along it: ranks along everything are whole numbers, and sort faster together."""
    rank = np.empty(len(along), np.int64)
    rank[np.argsort(along)] = np.arange(len(along))
    return np.argsort(piece * len(along) + rank)


def _sizes(raw: Raw, piece: Rows, begin: Floats, until: Rows, end: Floats) -> Floats:
    """(s,) lengths of slices, by differences on one piece where they can be."""
    traveled = np.cumsum(raw.lengths) - raw.lengths
    size: Floats = np.where(piece == until, end - begin, (traveled[until] + end) - (traveled[piece] + begin))
    return size


def _alone(raw: Raw, stations: _Stations) -> Flags:
    """The stations with no other, and no joint beyond which another may be, within CROWDED on their piece."""
    piece, along = stations.piece, stations.along
    joined = np.zeros(len(raw), np.bool_)
    joined[raw.following[raw.following >= 0]] = True
    crowded = joined[piece] & (along < CROWDED)
    crowded |= (raw.following[piece] >= 0) & (raw.lengths[piece] - along < CROWDED)
    close = ((piece[1:] == piece[:-1]) & (along[1:] - along[:-1] < CROWDED)).nonzero()[0]
    crowded[close] = True
    crowded[close + 1] = True
    return ~crowded


def _turns(stations: _Stations, at: Rows, alone: Flags, count: int) -> tuple[Flags, Rows]:
    """Which of `count` slices turn the wrong way, and where the others turn to; slice at[k] ends at station k."""
    dead, turning = np.zeros(count, np.bool_), np.full(count, -1)
    ending, beginning = stations.turn > 0.0, stations.turn < 0.0
    dead[at[ending] + 1] = True
    dead[at[beginning]] = True
    ending, beginning = ending & alone, beginning & alone
    next_in_ring = np.full(int(stations.event.max(initial=-1)) + 1, -1)
    next_in_ring[stations.event[beginning]] = at[beginning] + 1
    turning[at[ending]] = next_in_ring[stations.event[ending]]
    return dead, turning


def _nodes(raw: Raw, found: Events, strands: _Strands) -> tuple[Points, Flags]:
    """All nodes before welding: the strands' starts and ends, then the events; and where the outline takes part."""
    count = len(strands.heads)
    points = np.concatenate((raw.start[strands.heads], raw.end[strands.tails], found.points))
    outer = np.zeros(len(points), np.bool_)
    behind = raw.following[strands.tails]
    outer[count : 2 * count] = (behind >= 0) & ~raw.side[behind]
    before = np.zeros(len(raw), np.bool_)
    before[raw.following[~raw.side & (raw.following >= 0)]] = True
    outer[:count] = before[strands.heads]
    outer[2 * count :] = ~(raw.side[found.one] & raw.side[found.other])
    return points, outer


def _welded(cut: Slices, one: Rows, other: Rows) -> Slices:
    """Slices no longer than JOINED dropped, their two nodes made one; so are nodes `one` and `other`."""
    short = cut.size <= JOINED
    if not short.any() and not len(one):
        return cut
    one, other = np.concatenate((one, cut.first[short])), np.concatenate((other, cut.last[short]))
    same = merged(len(cut.points), one, other)
    outer = cut.outer.copy()
    outer[same[cut.outer]] = True
    joined = replace(cut, first=same[cut.first], last=same[cut.last], outer=outer)
    return joined.take((~short).nonzero()[0])


def merged(count: int, one: Rows, other: Rows) -> Rows:
    """(count,) the least number among all numbers that pairs one, other (p,) connect with each."""
    same = np.arange(count)
    while True:
        least = np.minimum(same[one], same[other])
        before = same.copy()
        np.minimum.at(same, one, least)
        np.minimum.at(same, other, least)
        np.minimum.at(same, before[one], least)
        np.minimum.at(same, before[other], least)
        same = same[same]
        if np.array_equal(same, before):
            return same


def middles(raw: Raw, cut: Slices, rows: Rows) -> tuple[Points, Rows]:
    """The points half way along slices, and the pieces they lie on."""
    piece, along = cut.piece[rows], (cut.begin[rows] + cut.end[rows]) / 2.0
    several = (piece != cut.until[rows]).nonzero()[0]
    if len(several):
        some = rows[several]
        traveled = np.cumsum(raw.lengths)
        half = traveled[piece[several]] - raw.lengths[piece[several]] + cut.begin[some] + cut.size[some] / 2.0
        inner = np.clip(np.searchsorted(traveled, half), piece[several], cut.until[some])
        piece[several] = inner
        along[several] = np.clip(half - traveled[inner] + raw.lengths[inner], 0.0, raw.lengths[inner])
    return places(raw, piece, along), piece
