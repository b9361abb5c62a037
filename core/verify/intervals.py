"""Intervals: parts of a path, each from one length traveled to another, such as those nearer than a limit to a path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.geometry.distance import band_fractions, between
from core.geometry.path import Flags, Floats, Rows
from core.geometry.piece_arrays import blocks
from core.tolerance import ON_PATH
from core.verify.pairs import Pairs, measured


@dataclass(frozen=True, eq=False, slots=True)
class Intervals:
    """k disjoint intervals of a path in order: the lengths traveled (k,) at their starts `first` and ends `last`."""

    first: Floats
    last: Floats

    def __len__(self) -> int:
        return len(self.first)

    @property
    def middle(self) -> Floats:
        """(k,) lengths traveled at the middle of each."""
        return (self.first + self.last) / 2.0

    def index(self, s: Floats) -> Rows:
        """Return the index of the interval that each place `s` is in or follows; -1 before the first."""
        return self.first.searchsorted(s, side="right") - 1

    def holds(self, s: Floats) -> Flags:
        """True for places strictly inside an interval."""
        owner = self.index(s)
        inside = owner >= 0
        inside[inside] = (s[inside] > self.first[owner[inside]]) & (s[inside] < self.last[owner[inside]])
        return inside

    def keep(self, chosen: Flags | Rows | slice) -> Intervals:
        """Return the intervals for which `chosen` (k,) is True, or those of these indices."""
        return Intervals(self.first[chosen], self.last[chosen])

    def cut(self, cuts: Floats) -> Intervals:
        """Split the intervals at these places."""
        s = np.sort(np.concatenate((self.first, self.last, cuts[self.holds(cuts)])))
        parts = Intervals(s[:-1], s[1:])
        return parts.keep((parts.last > parts.first + ON_PATH) & self.holds(parts.middle))


NO_INTERVALS = Intervals(np.zeros(0), np.zeros(0))
"""No part of a path."""


@dataclass(frozen=True, eq=False, slots=True)
class Parts:
    """m parts of pieces: lengths traveled at both ends and at a place between, the distance there, the pair's row."""

    first: Floats
    last: Floats
    middle: Floats
    apart: Floats
    pair: Rows


def within(pairs: Pairs, rows: Rows, limit: Floats) -> Parts:
    """Return all parts of these pairs' pieces that are nearer to the others than `limit` (m,), one limit for each pair.

    The pieces are split wherever the distance can pass the limit, and the middle of each part decides.
    """
    batches = [
        _within(pairs, rows[block], limit[block])
        for block in blocks(pairs.pieces.arcs[pairs.i[rows]], pairs.others.arcs[pairs.j[rows]])
    ]
    return joined(batches)


def _within(pairs: Pairs, rows: Rows, limit: Floats) -> Parts:
    pieces, others = pairs.pieces.take(pairs.i[rows]), pairs.others.take(pairs.j[rows])
    fractions = band_fractions(pieces, others, limit)
    middles = (fractions[1:] + fractions[:-1]) / 2.0
    apart = measured(between(pieces, others, middles))
    part, pair = ((apart < limit) & (fractions[1:] > fractions[:-1])).nonzero()
    start, length = pairs.stations[pairs.i[rows[pair]]], pieces.length[pair]
    first, last, middle = fractions[part, pair], fractions[part + 1, pair], middles[part, pair]
    return Parts(start + first * length, start + last * length, start + middle * length, apart[part, pair], rows[pair])


def joined(batches: Sequence[Parts]) -> Parts:
    """Concatenate these parts."""
    columns = [[part.first, part.last, part.middle, part.apart] for part in batches]
    first, last, middle, apart = np.concatenate(columns, axis=1) if batches else np.zeros((4, 0))
    return Parts(first, last, middle, apart, np.concatenate((np.zeros(0, np.intp), *(part.pair for part in batches))))


def merged(first: Floats, last: Floats) -> Intervals:
    """Merge overlapping and touching parts into intervals."""
    order = first.argsort(kind="stable")
    first, furthest = first[order], np.maximum.accumulate(last[order])
    begins = np.ones(len(first), np.bool_)
    begins[1:] = first[1:] > furthest[:-1] + ON_PATH
    starts = begins.nonzero()[0]
    ends = np.append(starts[1:], len(first)) - 1
    return Intervals(first[starts], furthest[ends[: len(starts)]])
