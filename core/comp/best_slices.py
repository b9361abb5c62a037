"""Slices: the side pieces cut at every event, and which of them the cutter can run along.

Whether the cutter is clear of the part changes only at events, and at a crossing the slice before it and the one behind
it that turns to the cutter's side are clear or not together.  Nodes are the points where slices begin and end; points
within JOINED of each other on a piece are one node.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.comp.best_events import Events
from core.comp.best_raw import Raw
from core.geometry.intersect import Indices, Masks, Planes
from core.geometry.path import Floats
from core.tolerance import CROWDED, JOINED


@dataclass(frozen=True, eq=False, slots=True)
class Slices:
    """s slices in order of travel: of `piece` (s,), from `begin` to `end` mm along it, from node `first` to `last`.

    `dead` (s,) marks slices that turn the wrong way at one of their ends; `turning` (s,) is the slice on another piece
    that a slice at its end turns to at a crossing, -1 if none.  `points` are the nodes' places; `met` and `outer` mark
    the nodes where pieces meet otherwise than at a joint, and those where the outline takes part.
    """

    piece: Indices
    begin: Floats
    end: Floats
    first: Indices
    last: Indices
    dead: Masks
    turning: Indices
    points: Planes
    met: Masks
    outer: Masks

    def __len__(self) -> int:
        return len(self.piece)

    def take(self, rows: Indices) -> Slices:
        """Some slices, with all nodes."""
        place = np.full(len(self) + 1, -1)
        place[rows] = np.arange(len(rows))
        return Slices(
            self.piece[rows],
            self.begin[rows],
            self.end[rows],
            self.first[rows],
            self.last[rows],
            self.dead[rows],
            place[self.turning[rows]],
            self.points,
            self.met,
            self.outer,
        )


def sliced(raw: Raw, found: Events) -> Slices:
    """The side pieces cut at all events."""
    every = _stations(raw, found)
    stations = every.of(raw.side)
    pieces = np.flatnonzero(raw.side)
    cuts = np.bincount(stations.piece, minlength=len(raw))[pieces] + 1
    slot = np.zeros(len(raw), np.intp)
    slot[pieces] = np.cumsum(cuts) - cuts
    at = slot[stations.piece] + np.arange(len(stations.piece)) - np.searchsorted(stations.piece, stations.piece)
    begin, end = np.zeros(int(cuts.sum())), np.repeat(raw.lengths[pieces], cuts)
    first, last = np.repeat(pieces, cuts), np.repeat(_end_nodes(raw)[pieces], cuts)
    begin[at + 1], end[at], first[at + 1], last[at] = stations.along, stations.along, stations.node, stations.node
    dead, turning = _turns(stations, at, _alone(raw, stations), len(begin))
    cut = Slices(np.repeat(pieces, cuts), begin, end, first, last, dead, turning, *_nodes(raw, found))
    one, other = every.of(~raw.side).twins()
    whole = np.flatnonzero(raw.start == raw.end)
    return _welded(cut, np.concatenate((one, whole)), np.concatenate((other, _end_nodes(raw)[whole])))


class _Stations(NamedTuple):
    """Every event on both its pieces, by piece and as travelled: piece, distance along it, event, node, and turn.

    `turn` is positive where the piece ends its clear stretch at the event, negative where it begins it.
    """

    piece: Indices
    along: Floats
    event: Indices
    node: Indices
    turn: Floats

    def of(self, pieces: Masks) -> _Stations:
        """Those on some pieces."""
        rows = np.flatnonzero(pieces[self.piece])
        return _Stations(self.piece[rows], self.along[rows], self.event[rows], self.node[rows], self.turn[rows])

    def twins(self) -> tuple[Indices, Indices]:
        """The nodes of stations that follow each other on one piece within JOINED."""
        same = (self.piece[1:] == self.piece[:-1]) & (self.along[1:] - self.along[:-1] <= JOINED)
        return self.node[:-1][same], self.node[1:][same]


def _stations(raw: Raw, found: Events) -> _Stations:
    piece = np.concatenate((found.one, found.other))
    along = np.concatenate((found.along_one, found.along_other))
    event = np.tile(np.arange(len(found.one)), 2)
    turn = np.concatenate((found.turn, -found.turn))
    order = _sorted(piece, along)
    piece, event = piece[order], event[order]
    return _Stations(piece, np.clip(along[order], 0.0, raw.lengths[piece]), event, 2 * len(raw) + event, turn[order])


def _sorted(piece: Indices, along: Floats) -> Indices:
    """The order by piece and then along it: ranks along everything are whole numbers, and sort faster together."""
    rank = np.empty(len(along), np.int64)
    rank[np.argsort(along)] = np.arange(len(along))
    return np.argsort(piece * len(along) + rank)


def _alone(raw: Raw, stations: _Stations) -> Masks:
    """The stations with no other, and no joint beyond which another may be, within CROWDED on their piece."""
    piece, along = stations.piece, stations.along
    joined = np.zeros(len(raw), np.bool_)
    joined[raw.following[raw.following >= 0]] = True
    crowded = joined[piece] & (along < CROWDED)
    crowded |= (raw.following[piece] >= 0) & (raw.lengths[piece] - along < CROWDED)
    close = np.flatnonzero((piece[1:] == piece[:-1]) & (along[1:] - along[:-1] < CROWDED))
    crowded[close] = True
    crowded[close + 1] = True
    return ~crowded


def _turns(stations: _Stations, at: Indices, alone: Masks, count: int) -> tuple[Masks, Indices]:
    """Which of `count` slices turn the wrong way, and where the others turn to; slice at[k] ends at station k."""
    dead, turning = np.zeros(count, np.bool_), np.full(count, -1)
    ending, beginning = stations.turn > 0.0, stations.turn < 0.0
    dead[at[ending] + 1] = True
    dead[at[beginning]] = True
    ending, beginning = ending & alone, beginning & alone
    onward = np.full(int(stations.event.max(initial=-1)) + 1, -1)
    onward[stations.event[beginning]] = at[beginning] + 1
    turning[at[ending]] = onward[stations.event[ending]]
    return dead, turning


def _end_nodes(raw: Raw) -> Indices:
    """The node of each piece's end: the start of the piece that follows, or one of its own."""
    own = np.arange(len(raw)) + len(raw)
    return np.where(raw.following >= 0, raw.following, own)


def _nodes(raw: Raw, found: Events) -> tuple[Planes, Masks, Masks]:
    """All nodes before welding: the starts and the ends of the pieces, then the events."""
    count, most = len(raw), len(found.one)
    points = np.concatenate((raw.start, raw.end, found.points))
    met = np.arange(2 * count + most) >= 2 * count
    met[_end_nodes(raw)[~raw.smooth]] = True
    outer = np.zeros(len(met), np.bool_)
    outer[_end_nodes(raw)[~raw.side]] = True
    outer[np.flatnonzero(~raw.side)] = True
    outer[2 * count :] = ~(raw.side[found.one] & raw.side[found.other])
    return points, met, outer


def _welded(cut: Slices, one: Indices, other: Indices) -> Slices:
    """Slices no longer than JOINED dropped, their two nodes made one; so are nodes `one` and `other`."""
    short = cut.end - cut.begin <= JOINED
    if not short.any() and not len(one):
        return cut
    one, other = np.concatenate((one, cut.first[short])), np.concatenate((other, cut.last[short]))
    same = merged(len(cut.points), one, other)
    met, outer = cut.met.copy(), cut.outer.copy()
    met[same[cut.met]] = True
    outer[same[cut.outer]] = True
    joined = Slices(
        cut.piece, cut.begin, cut.end, same[cut.first], same[cut.last], cut.dead, cut.turning, cut.points, met, outer
    )
    return joined.take(np.flatnonzero(~short))


def merged(count: int, one: Indices, other: Indices) -> Indices:
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
