"""Search: for every piece of one path the pieces of another that are nearest to it somewhere, by branch and bound.

Both paths are held as runs of chords (`core.geometry.nearby`).  A pair of runs is dropped when it is farther apart than
every place of the one run is from some other run; what is left does not grow with the density of either path.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from core.geometry.nearby import FAN, Chords, Runs, runs_of
from core.geometry.path import Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at

LONG: Final = 8.0
"""Median lengths of the pieces from which on a piece is parted: what is long has no piece that is nearest to all of
it."""

BATCH_PAIRS: Final = 32_768
"""Pairs of runs that are opened at a time: they bound the memory in use."""


def nearest_pairs(pieces: PieceArrays, others: PieceArrays, tie: float) -> tuple[Rows, Rows]:
    """Pairs (i, j), by rising i, then j, among which is each of `others` that is nearest to any place of each piece.

    So are those that are farther by no more than `tie`.
    """
    if not (len(pieces) and len(others)):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    both = len(pieces) + len(others)
    typical = LONG * min(float(np.median(path.length)) for path in (pieces, others))
    one, rows = _parted(pieces, typical, both)
    other, columns = _parted(others, typical, both)
    found = [rows[i] * len(others) + columns[j] for i, j in _searched(one, other, tie)]
    pairs = np.concatenate(found)
    # np.unique takes ten times as long
    pairs.sort()
    first = np.ones(len(pairs), np.bool_)
    np.not_equal(pairs[1:], pairs[:-1], out=first[1:])
    return np.divmod(pairs[first], len(others))


def _parted(pieces: PieceArrays, typical: float, most: int) -> tuple[Chords, Rows]:
    """Chords of the pieces, those longer than `typical` in parts, but not of more than `most` parts in all; and the
    pieces that they are of."""
    length = max(typical, float(pieces.length.sum()) / most)
    counts = np.ones(len(pieces), np.intp)
    long = (pieces.length > length).nonzero()[0]
    counts[long] = np.ceil(pieces.length[long] / length) if length > 0.0 else 1
    rows = np.repeat(np.arange(len(pieces)), counts)
    part = np.arange(len(rows)) - (counts.cumsum() - counts)[rows]
    start, end = pieces.start.take(rows), pieces.end.take(rows)
    inner = (counts[rows] > 1).nonzero()[0]
    if len(inner):
        parted, count = pieces.take(rows[inner]), counts[rows[inner]]
        start[inner], end[inner] = at(parted, part[inner] / count), at(parted, (part[inner] + 1) / count)
    bow = pieces.radius[rows] * (1.0 - np.cos(pieces.angle[rows] / counts[rows] / 2.0))
    return Chords(start, end, bow), rows


def _searched(one: Chords, other: Chords, tie: float) -> Iterator[tuple[Rows, Rows]]:
    """The pairs of chords of which one may hold what is nearest to a place of the other's curve, in batches.

    `within` are for each run lengths within which all of its places have something of the other path.
    """
    first, second = runs_of(one), runs_of(other)
    jumps = _jumps(second)
    within = [np.full(len(level), np.inf) for level in first]
    high, low = len(first) - 1, len(second) - 1
    i, j = np.divmod(np.arange(len(first[high]) * len(second[low])), len(second[low]))
    stack = [(high, low, i, j)]
    while stack:
        high, low, i, j = stack.pop()
        if len(i) > BATCH_PAIRS and i[0] != i[-1]:
            half = max(int(i.searchsorted(i[len(i) // 2])), int(i.searchsorted(i[0], side="right")))
            stack += [(high, low, i[half:], j[half:]), (high, low, i[:half], j[:half])]
            continue
        i, j = _contenders(first[high], i, second[low], j, jumps[low], within[high], tie)
        if not high and not low:
            yield i, j
        elif high >= low:
            members, j = _opened(i, j, len(first[high - 1]))
            within[high - 1][members] = np.minimum(within[high - 1][members], within[high][members // FAN])
            order = np.argsort(members, kind="stable")
            stack.append((high - 1, low, members[order], j[order]))
        else:
            j, i = _opened(j, i, len(second[low - 1]))
            stack.append((high, low - 1, i, j))


def _jumps(runs: Runs) -> list[Floats]:
    """For each run of each level the largest gap between chords in it: no place of it is so near to its chord."""
    chords = runs[0]
    gap = np.zeros(len(chords))
    gap[:-1] = np.abs(chords.start[1:] - chords.end[:-1])
    levels = [np.zeros(len(chords))]
    for level in runs[1:]:
        size = FAN ** len(levels)
        inner = gap.copy()
        # the gap behind the last member belongs to no run
        inner[size - 1 :: size] = 0.0
        levels.append(np.maximum.reduceat(inner, np.arange(0, len(chords), size))[: len(level)])
    return levels


def _opened(runs: Rows, partners: Rows, count: int) -> tuple[Rows, Rows]:
    """The members of these runs, of which there are `count` in all, and the partner of each."""
    members = (runs[:, None] * FAN + np.arange(FAN)).ravel()
    partners = partners.repeat(FAN)
    if len(members) and members.max() >= count:
        real = members < count
        return members[real], partners[real]
    return members, partners


def _contenders(
    one: Chords, i: Rows, other: Chords, j: Rows, jump: Floats, within: Floats, tie: float
) -> tuple[Rows, Rows]:
    """Pairs, by rising i, that come as near as some run does to all of the other; updates `within`.

    Seen along the line through both middles, chords take up room by how far they reach along it.
    """
    half, reach = (one.end - one.start) / 2.0, (other.end - other.start) / 2.0
    between = (other.start + reach).take(j) - (one.start + half).take(i)
    apart = np.abs(between)
    toward = np.conj(between)
    taken = np.abs((half.take(i) * toward).real) + np.abs((reach.take(j) * toward).real)
    least = apart - taken / np.where(apart == 0.0, 1.0, apart) - one.slack.take(i) - other.slack.take(j)
    keep = ~(least > within.take(i) + tie)
    i, j, apart, least = i[keep], j[keep], apart[keep], least[keep]
    if not len(i):
        return i, j
    starts = np.flatnonzero(np.concatenate(([True], i[1:] != i[:-1])))
    closest = np.minimum.reduceat(apart, starts).repeat(np.diff(starts, append=len(i)))
    best = (apart == closest).nonzero()[0]
    a, b = i[best], j[best]
    ends = np.maximum(_off(other, b, one.start.take(a)), _off(other, b, one.end.take(a)))
    np.minimum.at(within, a, ends + one.slack.take(a) + other.slack.take(b) + jump.take(b))
    keep = ~(least > within.take(i) + tie)
    return i[keep], j[keep]


def _off(chords: Chords, rows: Rows, points: Points) -> Floats:
    """Distance of each point from its chord."""
    start = chords.start.take(rows)
    chord, away = chords.end.take(rows) - start, points - start
    square = (chord * chord.conj()).real
    share = (away * chord.conj()).real / np.where(square == 0.0, 1.0, square)
    off: Floats = np.abs(away - np.minimum(np.maximum(share, 0.0), 1.0) * chord)
    return off
