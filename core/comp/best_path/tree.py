"""Which boxes are near each other: a tree over boxes in their order along a path, for joins of any size in pieces.

Pieces that follow each other lie beside each other, so groups of consecutive boxes make a good tree without sorting.
A box is kept as (x0, y0, -x1, -y1) in single precision, rounded outwards, and once more as (x1, y1, -x0, -y0): sixteen
bytes each that are gathered as one number.  Two boxes meet where no part of the one's first form is above the other's
second.  Boxes of one tree that follow each other closely are held against each other row by row, without gathering.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Flags, Floats, Points, Rows, Turns

FAN: Final = 4
"""Boxes in a group."""

NEARBY: Final = FAN * FAN
"""Boxes of groups whose neighbors are held against each other without the tree."""

WINDOW: Final = 2 * NEARBY - 1
"""The farthest that boxes of one group or of two groups beside each other are apart in their order."""

STRETCH: Final = 8192
"""Boxes held at a time against those behind them."""

AT_ONCE: Final = 1 << 16
"""Pairs of boxes held against each other at once: few enough to stay in the processor's cache."""

_ROUNDED: Final = 2.0**-22
"""By this share of the largest coordinate boxes grow, four times what rounding to single precision can take off."""

_NOWHERE: Final = 1e18
"""Least coordinates of a box that is near nothing, and whose square a single float still holds."""

Packed = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, slots=True)
class Tree:
    """Boxes in groups of groups, from the coarsest to the `count` boxes themselves, in their two packed forms.

    `boxes` (4, count) are the boxes: least x, least y, largest x, largest y.
    """

    low: tuple[Packed, ...]
    high: tuple[Packed, ...]
    boxes: NDArray[np.float32]

    @property
    def count(self) -> int:
        """The number of boxes."""
        return int(self.boxes.shape[1])


def tree(boxes: Floats) -> Tree:
    """The tree over boxes (4, n): least x, least y, largest x, largest y."""
    single = boxes.astype(np.float32)
    slack = np.float32(np.abs(single).max(initial=0.0) * _ROUNDED)
    single[:2] -= slack
    single[2:] += slack
    low = np.empty((boxes.shape[1], 4), np.float32)
    low[:, 0], low[:, 1], low[:, 2], low[:, 3] = single[0], single[1], -single[2], -single[3]
    levels = [low]
    while len(levels[-1]) > FAN:
        levels.append(_grouped(levels[-1]))
    levels.reverse()
    return Tree(tuple(map(_packed, levels)), tuple(_packed(-level[:, (2, 3, 0, 1)]) for level in levels), single)


def _packed(rows: NDArray[np.float32]) -> Packed:
    packed: Packed = np.ascontiguousarray(rows).view(np.complex128)[:, 0]
    return packed


def _grouped(low: NDArray[np.float32]) -> NDArray[np.float32]:
    groups = -(-len(low) // FAN)
    padded = np.full((groups * FAN, 4), _NOWHERE, np.float32)
    padded[: len(low)] = low
    members = padded.reshape(groups, FAN, 4)
    grouped = members[:, 0].copy()
    for member in range(1, FAN):
        np.minimum(grouped, members[:, member], out=grouped)
    return grouped


def near(one: Tree, two: Tree, reach: float) -> Iterator[tuple[Rows, Rows]]:
    """All pairs (i, j) of boxes of both trees no farther apart than `reach`, in batches."""
    return _descend(one, two, reach, selves=False)


def near_selves(boxes: Tree, known: Flags | None = None) -> Iterator[tuple[Rows, Rows]]:
    """All pairs (i, j), i < j, of boxes of one tree that meet, in batches.

    `known` (n,) marks boxes i whose pair with i + 1 is not wanted.
    """
    for first in range(0, boxes.count, STRETCH):
        yield _following(boxes.boxes, first, min(first + STRETCH, boxes.count), known)
    if boxes.count > 2 * NEARBY:  # fewer are all in two groups beside each other
        yield from _descend(boxes, boxes, 0.0, selves=True)


def _following(boxes: NDArray[np.float32], first: int, last: int, known: Flags | None) -> tuple[Rows, Rows]:
    """The pairs of boxes first ... last - 1 with those up to WINDOW behind them."""
    count = last - first
    behind = np.full((4, count + WINDOW), _NOWHERE, np.float32)
    some = boxes[:, first : last + WINDOW]
    behind[:, : some.shape[1]] = some
    meeting = _shifted(behind[0], count) <= boxes[2, first:last]
    meeting &= _shifted(behind[1], count) <= boxes[3, first:last]
    meeting &= _shifted(behind[2], count) >= boxes[0, first:last]
    meeting &= _shifted(behind[3], count) >= boxes[1, first:last]
    if known is not None:
        meeting[0] &= ~known[first:last]
    apart, i = np.divmod(np.flatnonzero(meeting), count)
    i += first
    near = (apart < NEARBY) | ((i + apart + 1) // NEARBY - i // NEARBY <= 1)
    return i[near], (i + apart + 1)[near]


def _shifted(values: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """(WINDOW, count) view of values (count + WINDOW,): row k is shifted by k + 1."""
    return np.ndarray((WINDOW, count), np.float32, values, values.itemsize, (values.itemsize, values.itemsize))


def _descend(one: Tree, two: Tree, reach: float, *, selves: bool) -> Iterator[tuple[Rows, Rows]]:
    """Pairs of groups replaced by pairs of their members, nearest to the leaves first, so that little is held."""
    if not one.count or not two.count:
        return
    deep = max(len(one.low), len(two.low))
    first, second = _as_deep(one.low, deep), _as_deep(two.high, deep)
    depth = _beginning(first, second)
    i, j = np.divmod(np.arange(len(first[depth]) * len(second[depth])), len(second[depth]))
    stack = [(depth, i, j)]
    while stack:
        depth, i, j = stack.pop()
        last = depth == len(first) - 1
        keep = _meet(first[depth][i], second[depth][j], reach)
        if selves:
            keep &= i <= j
            keep &= _apart_enough(i, j, len(first) - 1 - depth)
        i, j = i[keep], j[keep]
        if last:
            yield i, j
            continue
        for begin in range(0, len(i), AT_ONCE // (FAN * FAN)):
            some = slice(begin, begin + AT_ONCE // (FAN * FAN))
            stack.append((depth + 1, *_members(i[some], j[some], first, second, depth)))


def _apart_enough(i: Rows, j: Rows, above: int) -> Flags:
    """Which groups, so many levels above the boxes, may hold boxes of NEARBY groups that are not beside each other."""
    apart: Flags = ((j + 1) * FAN**above - 1) // NEARBY - (i * FAN**above) // NEARBY > 1
    return apart


def _as_deep(levels: tuple[Packed, ...], deep: int) -> tuple[Packed, ...]:
    """The levels of a tree, its coarsest repeated until it is so deep."""
    return levels[:1] * (deep - len(levels)) + levels


def _beginning(first: tuple[Packed, ...], second: tuple[Packed, ...]) -> int:
    """The deepest level whose boxes may all be held against each other."""
    return max(depth for depth in range(len(first)) if depth == 0 or len(first[depth]) * len(second[depth]) <= 4096)


def _members(i: Rows, j: Rows, first: tuple[Packed, ...], second: tuple[Packed, ...], depth: int) -> tuple[Rows, Rows]:
    """All pairs of members of paired groups; a level that is repeated has itself as its only member."""
    if first[depth] is not first[depth + 1]:
        i, j = _brood(i, j, len(first[depth + 1]))
    if second[depth] is not second[depth + 1]:
        j, i = _brood(j, i, len(second[depth + 1]))
    return i, j


def _brood(grow: Rows, keep: Rows, count: int) -> tuple[Rows, Rows]:
    """Each group in `grow` replaced by its members below `count`, its partner in `keep` repeated."""
    members = (grow[:, None] * FAN + np.arange(FAN)).ravel()
    partners = np.repeat(keep, FAN)
    real = members < count
    return (members, partners) if real.all() else (members[real], partners[real])


def _meet(low: Packed, high: Packed, reach: float) -> Flags:
    """Which boxes are within reach of their partners; where there is a reach, by the distance between boxes."""
    one, two = low.view(np.float32).reshape(-1, 4), high.view(np.float32).reshape(-1, 4)
    if reach == 0.0:
        meeting: Flags = (one <= two).view(np.uint32)[:, 0] == 0x01010101
        return meeting
    gap = one - two
    apart = np.maximum(np.maximum(gap[:, :2], gap[:, 2:]), 0.0)
    squared = apart[:, 0] * apart[:, 0] + apart[:, 1] * apart[:, 1]
    near: Flags = squared <= np.float32(reach * reach * (1.0 + 1e-6))
    return near


def piece_boxes(start: Points, end: Points, center: Points, turns: Turns, grow: float) -> Floats:
    """(4, n) boxes around pieces, grown on all sides: of a line its ends, of an arc its ends and tangents' corner.

    Arcs of more than a quarter turn get the whole circle's box.
    """
    boxes = np.empty((4, len(start)))
    for axis, (one, two) in enumerate(((start.real, end.real), (start.imag, end.imag))):
        np.minimum(one, two, out=boxes[axis])
        np.maximum(one, two, out=boxes[axis + 2])
    arcs = turns.nonzero()[0]
    if len(arcs):
        _widen(boxes, arcs, start[arcs] - center[arcs], end[arcs] - center[arcs], center[arcs], turns[arcs])
    boxes[:2] -= grow
    boxes[2:] += grow
    return boxes


def _widen(boxes: Floats, arcs: Rows, first: Points, last: Points, center: Points, turns: Turns) -> None:
    """Make the boxes of arcs hold more than their ends."""
    bend = first.conj() * last
    quarter = (bend.imag * turns > 0.0) & (bend.real >= 0.0) & (first != last)
    square = first.real * first.real + first.imag * first.imag
    chord = (first + last) / 2.0
    height = np.where(quarter, chord.real * chord.real + chord.imag * chord.imag, 1.0)
    corner = center + chord * (square / height)
    for axis, far in enumerate((corner.real, corner.imag)):
        boxes[axis, arcs] = np.minimum(boxes[axis, arcs], far)
        boxes[axis + 2, arcs] = np.maximum(boxes[axis + 2, arcs], far)
    wide, radius = arcs[~quarter], np.sqrt(square[~quarter])
    for axis, middle in enumerate((center.real[~quarter], center.imag[~quarter])):
        boxes[axis, wide], boxes[axis + 2, wide] = middle - radius, middle + radius
