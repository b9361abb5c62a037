"""Slices: the side pieces cut at every event, and which of them the cutter can run along.

Whether the cutter is clear of the part changes only at events.  So slices joined without an event between them, a RUN,
share their fate; a run with a slice that turns the wrong way at a crossing is not clear, and of every other one place
is measured.  Nodes are the points where slices begin and end; points within JOINED on a piece are one node.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.comp.best_clear import clear
from core.comp.best_events import Events, places
from core.comp.best_raw import Raw
from core.geometry.intersect import Indices, Masks, Planes
from core.geometry.path import Floats, Path
from core.tolerance import JOINED


@dataclass(frozen=True, eq=False, slots=True)
class Slices:
    """s slices in order of travel: `piece` (s,), from `begin` to `end` (s,) mm along it, between nodes `first` and `last`.

    `dead` (s,) marks slices that turn the wrong way at one of their ends.  `points` are the nodes' places; `met` and
    `outer` mark the nodes where pieces meet otherwise than at a joint, and those where the outline takes part.
    """

    piece: Indices
    begin: Floats
    end: Floats
    first: Indices
    last: Indices
    dead: Masks
    points: Planes
    met: Masks
    outer: Masks

    def __len__(self) -> int:
        return len(self.piece)

    def take(self, rows: Indices) -> Slices:
        """Some slices, with all nodes."""
        cut = (column[rows] for column in (self.piece, self.begin, self.end, self.first, self.last, self.dead))
        return Slices(*cut, self.points, self.met, self.outer)


def sliced(raw: Raw, found: Events) -> Slices:
    """The side pieces cut at all events."""
    count = len(raw)
    piece, along, node, turn = _stations(raw, found)
    pieces = np.flatnonzero(raw.side)
    cuts = np.bincount(piece, minlength=count)[pieces] + 1
    slot = np.zeros(count, np.intp)
    slot[pieces] = np.cumsum(cuts) - cuts
    at = slot[piece] + np.arange(len(piece)) - np.searchsorted(piece, piece)
    total = int(cuts.sum())
    begin, end = np.zeros(total), np.repeat(raw.lengths[pieces], cuts)
    first, last = np.repeat(pieces, cuts), np.repeat(_end_nodes(raw)[pieces], cuts)
    begin[at + 1], end[at], first[at + 1], last[at] = along, along, node, node
    dead = np.zeros(total, np.bool_)
    dead[at[turn < 0.0]] = True
    dead[at[turn > 0.0] + 1] = True
    cut = Slices(np.repeat(pieces, cuts), begin, end, first, last, dead, *_nodes(raw, found))
    return _welded(cut)


def _stations(raw: Raw, found: Events) -> tuple[Indices, Floats, Indices, Floats]:
    """Every event on every side piece it lies on, as travelled: piece, distance along it, node, and which way to turn.

    Turning is positive where the piece ends its clear stretch at the event, negative where it begins it.
    """
    piece = np.concatenate((found.one, found.other))
    along = np.concatenate((found.along_one, found.along_other))
    node = np.tile(2 * len(raw) + np.arange(len(found.one)), 2)
    turn = np.concatenate((found.turn, -found.turn))
    order = np.lexsort((along, piece))
    order = order[raw.side[piece[order]]]
    piece = piece[order]
    return piece, np.clip(along[order], 0.0, raw.lengths[piece]), node[order], turn[order]


def _end_nodes(raw: Raw) -> Indices:
    """The node of each piece's end: the start of the piece that follows, or one of its own."""
    own = np.arange(len(raw)) + len(raw)
    return np.where(raw.following >= 0, raw.following, own)


def _nodes(raw: Raw, found: Events) -> tuple[Planes, Masks, Masks]:
    """All nodes before welding: the starts and the ends of the pieces, then the events."""
    count, most = len(raw), len(found.one)
    points = np.concatenate((raw.start, raw.end, found.points))
    met = np.arange(2 * count + most) >= 2 * count
    outer = np.zeros(len(met), np.bool_)
    outer[_end_nodes(raw)[~raw.side]] = True
    outer[np.flatnonzero(~raw.side)] = True
    outer[2 * count :] = ~(raw.side[found.one] & raw.side[found.other])
    return points, met, outer


def _welded(cut: Slices) -> Slices:
    """Slices no longer than JOINED dropped, their two nodes made one."""
    short = cut.end - cut.begin <= JOINED
    if not short.any():
        return cut
    same = _merged(len(cut.points), cut.first[short], cut.last[short])
    met, outer = cut.met.copy(), cut.outer.copy()
    met[same[cut.met]] = True
    outer[same[cut.outer]] = True
    keep = ~short
    return Slices(
        cut.piece[keep],
        cut.begin[keep],
        cut.end[keep],
        same[cut.first[keep]],
        same[cut.last[keep]],
        cut.dead[keep],
        cut.points,
        met,
        outer,
    )


def _merged(count: int, one: Indices, other: Indices) -> Indices:
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


def clear_slices(raw: Raw, cut: Slices, surface: Path, radius: float) -> Slices:
    """The slices along which the cutter is nowhere nearer to the surface than the radius."""
    if not len(cut):
        return cut
    joint = np.empty(len(cut), np.bool_)
    joint[0] = False
    joint[1:] = (cut.last[:-1] == cut.first[1:]) & ~cut.met[cut.first[1:]]
    runs = np.flatnonzero(~joint)
    run = np.cumsum(~joint) - 1
    alive = ~np.logical_or.reduceat(cut.dead, runs)
    sample = _longest(cut.end - cut.begin, runs, run)[alive]
    middle = places(raw, cut.piece[sample], (cut.begin[sample] + cut.end[sample]) / 2.0)
    alive[alive] = clear(surface, middle, radius)
    return cut.take(np.flatnonzero(alive[run]))


def _longest(lengths: Floats, runs: Indices, run: Indices) -> Indices:
    """The first of the longest slices of each run."""
    rows = np.flatnonzero(lengths == np.maximum.reduceat(lengths, runs)[run])
    return rows[np.searchsorted(run[rows], np.arange(len(runs)))]
