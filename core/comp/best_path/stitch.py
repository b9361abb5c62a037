"""Stitch: clear slices joined to loops, at their nodes and in the contour's order.

At a node where several slices begin and end, a slice goes on along its own piece or over the joint to the next one;
otherwise it turns as far to the cutter's side as it can, which keeps loops apart that only touch.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.comp.best_path.meetings import directions
from core.comp.best_path.raw_offset import Raw
from core.comp.best_path.slices import Slices, middles
from core.geometry.path import Flags, Rows, next_in_ring
from core.tolerance import GOUGE, WHISKER

_ROUNDS = 32
"""How often slices are taken away that lead nowhere; near-tangent joints leave one or two in a row."""


@dataclass(frozen=True, eq=False, slots=True)
class Stitched:
    """Slices `cut`, for each the one that follows it or -1, and which are `loose`: an end leads nowhere."""

    cut: Slices
    following: Rows
    loose: Flags


def stitch(raw: Raw, cut: Slices, sign: int) -> Stitched:
    """Each clear slice with the one that follows it."""
    cut = _without_whiskers(_without_doubles(raw, cut))
    following = _straight_on(cut)
    if len(cut):
        _across(raw, cut, following, sign)
    ends = following < 0
    begins = np.ones(len(cut), np.bool_)
    begins[following[~ends]] = False
    loose = (ends & ~cut.outer[cut.last]) | (begins & ~cut.outer[cut.first])
    return Stitched(cut, following, loose)


def _without_doubles(raw: Raw, cut: Slices) -> Slices:
    """Of slices that run along each other the same way, the earliest: contours that touch themselves have them."""
    crowded = (np.bincount(cut.first, minlength=1)[cut.first] > 1).nonzero()[0]
    order = crowded[np.lexsort((cut.last[crowded], cut.first[crowded]))]
    one, two = order[:-1], order[1:]
    same = (cut.first[one] == cut.first[two]) & (cut.last[one] == cut.last[two])
    same &= np.abs(middles(raw, cut, one)[0] - middles(raw, cut, two)[0]) <= GOUGE
    if not same.any():
        return cut
    keep = np.ones(len(cut), np.bool_)
    keep[two[same]] = False
    return cut.take(keep.nonzero()[0])


def _without_whiskers(cut: Slices) -> Slices:
    """Slices taken away that lead nowhere and are so short that they are rounding at a near-tangent joint."""
    size = len(cut.points)
    for _ in range(_ROUNDS):
        begins, ends = np.zeros(size, np.bool_), np.zeros(size, np.bool_)
        begins[cut.first], ends[cut.last] = True, True
        nowhere = ~(begins[cut.last] | cut.outer[cut.last]) | ~(ends[cut.first] | cut.outer[cut.first])
        nowhere &= cut.size < WHISKER
        if not nowhere.any():
            break
        cut = cut.take((~nowhere).nonzero()[0])
    return cut


def _straight_on(cut: Slices) -> Rows:
    """For each slice the next one, where that is on the same piece or joined to it and begins where the slice ends."""
    following = next_in_ring(np.arange(len(cut)))
    following[cut.last != cut.first[following]] = -1
    return following


def _across(raw: Raw, cut: Slices, following: Rows, sign: int) -> None:
    """Fill in what follows the slices that end at a node where another piece takes over."""
    taken = np.zeros(len(cut), np.bool_)
    taken[following[following >= 0]] = True
    ends, begins = (following < 0).nonzero()[0], (~taken).nonzero()[0]
    begins = begins[np.argsort(cut.first[begins], kind="stable")]
    low = np.searchsorted(cut.first[begins], cut.last[ends], side="left")
    high = np.searchsorted(cut.first[begins], cut.last[ends], side="right")
    rivals = np.bincount(cut.last[ends], minlength=len(cut.points))[cut.last[ends]]
    simple = (high - low == 1) & (rivals == 1)
    following[ends[simple]] = begins[low[simple]]
    several = ((high > low) & ~simple).nonzero()[0]
    if len(several):
        _by_turn(raw, cut, following, sign, ends[several], [begins[low[k] : high[k]] for k in several.tolist()])


def _by_turn(raw: Raw, cut: Slices, following: Rows, sign: int, ends: Rows, begins: list[Rows]) -> None:
    """At crowded nodes, the slice that turns most to the cutter's side first."""
    pairs = np.array([(end, begin) for end, some in zip(ends.tolist(), begins, strict=True) for begin in some.tolist()])
    nodes = cut.points[cut.last[pairs[:, 0]]]
    before = directions(raw, cut.until[pairs[:, 0]], nodes)
    behind = directions(raw, cut.piece[pairs[:, 1]], nodes)
    turns = sign * np.angle(before.conj() * behind)
    free, taken = set(pairs[:, 0].tolist()), set(pairs[:, 1].tolist())
    for row in np.argsort(-turns, kind="stable").tolist():
        end, begin = pairs[row].tolist()
        if end in free and begin in taken:
            following[end] = begin
            free.remove(end)
            taken.remove(begin)


def chains(made: Stitched) -> list[tuple[Rows, bool]]:
    """The slices in loops and open chains, each from the contour's earliest slice of it on, and whether it is closed.

    Slices that follow each other in number are walked as one run; only runs are looked at singly.
    """
    following = made.following
    count = len(following)
    if not count:
        return []
    rows = np.arange(count)
    breaks = (following[:-1] != rows[1:]).nonzero()[0]
    heads = np.concatenate(([0], breaks + 1))
    tails = np.concatenate((breaks, [count - 1]))
    entry = np.searchsorted(heads, following[tails], side="right") - 1
    return _walk(following, heads, tails, entry)


def _walk(following: Rows, heads: Rows, tails: Rows, entry: Rows) -> list[tuple[Rows, bool]]:
    """Runs heads[k] ... tails[k], run entry[k] behind run k, put together; open chains from their beginning."""
    next_in_ring = np.where(following[tails] < 0, -1, entry).tolist()
    reached = set(next_in_ring)
    unwalked = dict.fromkeys(range(len(next_in_ring)))
    found = []
    for first in [k for k in unwalked if k not in reached] + list(unwalked):
        walk, run = [], first
        while run in unwalked:
            del unwalked[run]
            walk.append(np.arange(heads[run], tails[run] + 1))
            run = next_in_ring[run]
        if walk:
            found.append((np.concatenate(walk), run == first))
    return sorted(found, key=lambda chain: int(chain[0][0]))
