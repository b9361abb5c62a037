"""Stitch: join clear slices to loops, at their nodes and in the contour's order.

At a node where several slices begin and end, a slice continues along its own piece or across the joint to the next
one; otherwise it turns as far to the cutter's side as it can, which keeps loops apart that only touch.  If rounding
has separated an end from its continuation, a straight line bridges the gap: between two clear places no farther apart
than `bridge_limit` the line is clear too (BEST_PATH.md, "Bridges").
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from core.comp.best_path.prepared_contour import Walls
from core.comp.best_path.raw_offset import RawOffset
from core.comp.best_path.slices import Slices
from core.geometry.nearby import near_pairs, point_boxes, sorted_pairs
from core.geometry.path import Flags, Floats, Path, Pieces, Rows, coordinates, lengths, next_in_ring
from core.tolerance import CLEAR, CROWDED, GOUGE, JOINED, WHISKER

_CUT_BACKS = 4
"""How often the ends of a bridge may move apart, each time by its length."""


@dataclass(frozen=True, eq=False, slots=True)
class StitchedSlices:
    """The `slices`, for each the slice `following` it or -1, and flags for loose ends and loose beginnings.

    `gaps` (s,) is the length of the bridge after each slice, 0 without one.
    """

    slices: Slices
    following: Rows
    loose_end: Flags
    loose_begin: Flags

    @property
    def gaps(self) -> Floats:
        """(s,) distance from each slice's end to the start of the following one, 0 if there is none."""
        gaps = np.abs(self.slices.points[self.slices.last] - self.slices.points[self.slices.first[self.following]])
        return np.where(self.following >= 0, gaps, 0.0)


def bridge_limit(radius: float) -> float:
    """Return the longest line between two clear places that enters the clearance to a wall by no more than CLEAR."""
    return min(WHISKER, sqrt(8.0 * radius * CLEAR))


def stitch(raw: RawOffset, slices: Slices, sign: int, walls: Walls, radius: float) -> StitchedSlices:
    """Link each clear slice to the one that follows it, and drop the slices that lead nowhere."""
    slices = _without_dead_ends(_without_doubles(raw, slices))
    while True:
        # straight on: the next slice, if it begins at the node where this one ends
        following = next_in_ring(np.arange(len(slices)))
        following[slices.last != slices.first[following]] = -1
        _turn_at_nodes(raw, slices, following, sign)
        _bridge(slices, following, bridge_limit(radius))
        end, begin = following < 0, _without_predecessor(following)
        end &= ~slices.outer[slices.last]
        begin &= ~slices.outer[slices.first]
        whisker = (end | begin) & (slices.size < WHISKER)
        if not whisker.any():
            return StitchedSlices(_without_overlaps(raw, slices, following, walls, radius), following, end, begin)
        slices = slices.take((~whisker).nonzero()[0])


def _without_predecessor(following: Rows) -> Flags:
    free = np.ones(len(following), np.bool_)
    free[following[following >= 0]] = False
    return free


def _without_doubles(raw: RawOffset, slices: Slices) -> Slices:
    """Keep only the earliest of slices that run along each other the same way, as contours that touch themselves do."""
    crowded = (np.bincount(slices.first, minlength=1)[slices.first] > 1).nonzero()[0]
    order = crowded[np.lexsort((slices.last[crowded], slices.first[crowded]))]
    early, late = order[:-1], order[1:]
    same = (slices.first[early] == slices.first[late]) & (slices.last[early] == slices.last[late])
    same &= np.abs(slices.middles(raw, early)[0] - slices.middles(raw, late)[0]) <= GOUGE
    keep = np.ones(len(slices), np.bool_)
    keep[late[same]] = False
    return slices.take(keep.nonzero()[0])


def _without_dead_ends(slices: Slices) -> Slices:
    """Drop slices that lead nowhere, are shorter than WHISKER, and branch off where another slice goes on."""
    size = len(slices.points)
    while True:
        begins, ends = np.bincount(slices.first, minlength=size), np.bincount(slices.last, minlength=size)
        ahead = (begins[slices.last] == 0) & ~slices.outer[slices.last] & (begins[slices.first] > 1)
        back = (ends[slices.first] == 0) & ~slices.outer[slices.first] & (ends[slices.last] > 1)
        dead = (ahead | back) & (slices.size < WHISKER)
        if not dead.any():
            return slices
        slices = slices.take((~dead).nonzero()[0])


def _turn_at_nodes(raw: RawOffset, slices: Slices, following: Rows, sign: int) -> None:
    """Fill in `following` for the slices that end at a node where another piece takes over."""
    ends, begins = (following < 0).nonzero()[0], _without_predecessor(following).nonzero()[0]
    begins = begins[np.argsort(slices.first[begins], kind="stable")]
    low = np.searchsorted(slices.first[begins], slices.last[ends], side="left")
    counts = np.searchsorted(slices.first[begins], slices.last[ends], side="right") - low
    end = np.repeat(ends, counts)
    begin = begins[np.repeat(low - np.cumsum(counts) + counts, counts) + np.arange(counts.sum())]
    # the pair that turns most to the cutter's side goes first
    nodes = slices.points[slices.last[end]]
    turned = raw.directions(slices.end_piece[end], nodes).conj() * raw.directions(slices.piece[begin], nodes)
    _pair_up(following, end, begin, -sign * np.angle(turned))


def _bridge(slices: Slices, following: Rows, limit: float) -> None:
    """Fill in `following` for the slices that end a little off their continuation, the nearest pairs first."""
    ends = ((following < 0) & ~slices.outer[slices.last]).nonzero()[0]
    begins = (_without_predecessor(following) & ~slices.outer[slices.first]).nonzero()[0]
    end, begin = slices.points[slices.last[ends]], slices.points[slices.first[begins]]
    i, j = sorted_pairs(near_pairs(point_boxes(end), point_boxes(begin), limit))
    _pair_up(following, ends[i], begins[j], np.abs(end[i] - begin[j]))


def _without_overlaps(raw: RawOffset, slices: Slices, following: Rows, walls: Walls, radius: float) -> Slices:
    """Cut slices that a bridge joins off abreast of each other, if they run past each other.

    An end that is still inside a wall moves back until it is clear.
    """
    rows = (following >= 0).nonzero()[0]
    rows = rows[np.abs(slices.points[slices.last[rows]] - slices.points[slices.first[following[rows]]]) > JOINED]
    if not len(rows):
        return slices
    after = following[rows]
    begin, end, first, last = slices.begin.copy(), slices.end.copy(), slices.first.copy(), slices.last.copy()
    piece, end_piece, nodes = slices.piece[after], slices.end_piece[rows], len(slices.points) + np.arange(len(rows))
    max_overlap = np.minimum(bridge_limit(radius), slices.size / 2.0)
    low = np.where(slices.piece[rows] == end_piece, begin[rows], 0.0)
    high = np.where(slices.end_piece[after] == piece, end[after], raw.lengths[piece])
    overlap = raw.along(piece, slices.points[last[rows]]) - begin[after]
    overlap[(overlap < 0.0) | (overlap > max_overlap[after])] = 0.0
    begin[after] += overlap
    unmoved = begin[after] == slices.begin[after]
    starts = np.where(unmoved, slices.points[first[after]], raw.at(piece, begin[after]))
    overlap = end[rows] - raw.along(end_piece, starts)
    overlap[(overlap < 0.0) | (overlap > max_overlap[rows])] = 0.0
    end[rows] -= overlap
    ends = np.where(overlap > 0.0, raw.at(end_piece, end[rows]), slices.points[last[rows]])
    for _ in range(_CUT_BACKS):
        tested, segments = np.append(ends, starts), raw.segment[np.append(end_piece, piece)]
        blocked, gaps = ~walls.clear(tested, segments, radius), np.abs(ends - starts)
        if not blocked.any():
            break
        end[rows] -= np.where(blocked[: len(rows)], np.minimum(gaps, (end[rows] - low) / 2.0), 0.0)
        begin[after] += np.where(blocked[len(rows) :], np.minimum(gaps, (high - begin[after]) / 2.0), 0.0)
        ends = np.where(blocked[: len(rows)], raw.at(end_piece, end[rows]), ends)
        starts = np.where(blocked[len(rows) :], raw.at(piece, begin[after]), starts)
    last[rows], first[after] = nodes, nodes + len(rows)
    points, outer = (
        np.concatenate((slices.points, ends, starts)),
        np.append(slices.outer, np.zeros(2 * len(rows), np.bool_)),
    )
    return replace(slices, begin=begin, end=end, first=first, last=last, points=points, outer=outer)


def _pair_up(following: Rows, ends: Rows, begins: Rows, rank: Floats) -> None:
    """Let the slices `ends`, which have none yet, be followed by `begins` (p,); pairs with the least rank go first."""
    used = set[int]()
    for row in np.argsort(rank, kind="stable").tolist():
        end, begin = int(ends[row]), int(begins[row])
        if following[end] < 0 and begin not in used:
            following[end] = begin
            used.add(begin)


def chains(stitched: StitchedSlices) -> list[tuple[Rows, bool]]:
    """Return the loops and open chains of slices, and whether each is closed; a loop begins at its earliest slice."""
    following = stitched.following.tolist()
    entered, unwalked = set(following), dict.fromkeys(range(len(following)))
    walked = []
    for first in [row for row in unwalked if row not in entered] + list(unwalked):
        rows, row = list[int](), first
        while row in unwalked:
            del unwalked[row]
            rows.append(row)
            row = following[row]
        if rows:
            walked.append((np.array(rows), row == first))
    return sorted(walked, key=lambda chain: int(chain[0][0]))


def path_of_slices(raw: RawOffset, stitched: StitchedSlices, rows: Rows, origin: Floats) -> Path:
    """Return the path along slices `rows` in this order, moved by `origin`; slices of one piece become one piece again.

    An arc shorter than CROWDED whose ends rounding has turned past each other becomes a straight line, like a bridge.
    """
    slices = stitched.slices
    first, end_piece, bridged = slices.piece[rows], slices.end_piece[rows], stitched.gaps[rows] > JOINED
    counts = end_piece - first + 1
    begins = np.cumsum(counts) - counts
    piece = np.arange(int(counts.sum())) + np.repeat(first - begins, counts)
    start, low, high = raw.start[piece], np.zeros(len(piece)), raw.lengths[piece]
    start[begins], low[begins], high[begins + counts - 1] = (
        slices.points[slices.first[rows]],
        slices.begin[rows],
        slices.end[rows],
    )
    fresh = np.ones(len(piece), np.bool_)
    fresh[begins[1:]] = (first[1:] != end_piece[:-1]) | (slices.first[rows[1:]] != slices.last[rows[:-1]])
    heads = fresh.nonzero()[0]
    size = np.add.reduceat(high - low, heads)
    piece, start = piece[heads], start[heads]
    turns, centers, numbers = raw.turns[piece].copy(), raw.center[piece], raw.numbers[piece]
    if bridged.any():
        at = np.searchsorted(heads, (begins + counts)[bridged])
        start = np.insert(start, at, slices.points[slices.last[rows[bridged]]])
        turns, centers = np.insert(turns, at, 0), np.insert(centers, at, 0.0)
        numbers, size = np.insert(numbers, at, numbers[at - 1]), np.insert(size, at, 0.0)
    next_slice = stitched.following[rows[-1]]
    points = np.append(start, slices.points[slices.first[next_slice] if next_slice >= 0 else slices.last[rows[-1]]])
    tiny = ((turns != 0) & (size <= CROWDED)).nonzero()[0]
    swept = lengths(Pieces(points[:-1], points[1:], centers, turns).take(tiny))
    turns[tiny[np.abs(swept - size[tiny]) > CROWDED / 2.0]] = 0
    return Path.of(coordinates(points) + origin, coordinates(centers) + origin, turns, numbers)
