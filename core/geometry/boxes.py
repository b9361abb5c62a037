"""Which bounding boxes are near each other: a tree over boxes in their order along a path.

Pieces that follow each other lie beside each other, so groups of consecutive boxes make a good tree without any
sorting.  Boxes are (4, n) arrays: least x, least y, largest x, largest y.

A bound that is no number parts nothing, and makes that of its group none: what is asked is whether boxes are apart.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.geometry.path import Flags, Floats, Points, Rows

FAN: Final = 4
"""Boxes in a group."""

RUN: Final = 8
"""Consecutive boxes that are compared with RUN others at once."""

FEW: Final = 8_192
"""Pairs all of which are compared."""

FEW_GROUPED: Final = 500
"""Boxes that are grouped group by group: of more of them a member of all groups at a time takes a seventh."""

AT_ONCE: Final = 65_536
"""Pairs that are compared without a tree: each box with groups of others, and the groups' members."""

RUNS_AT_ONCE: Final = 1_000
"""Pairs of runs whose members are compared at once: few enough to stay in a processor's cache."""


def near_pairs(first: Floats, second: Floats, reach: float) -> tuple[Rows, Rows]:
    """Indices (i, j), in rising order of i, of all boxes no farther apart than `reach`."""
    count = first.shape[1] * second.shape[1]
    if count <= AT_ONCE:
        others = grouped(second) if count > FEW else second
        near = _near(first[:, :, None], others[:, None, :], reach).ravel()
        i, j = np.divmod(near.nonzero()[0], others.shape[1])
        if count > FEW:
            i, j = _brood(i, j, second.shape[1])
        keep = reaching(first.take(i, axis=1), second.take(j, axis=1), reach).nonzero()[0]
        return i[keep], j[keep]
    one, two = _runs(first), _runs(second)
    return _members(first, second, *_near_groups(_bounds(one), _bounds(two), reach), reach)


def _near_groups(first: Floats, second: Floats, reach: float) -> tuple[Rows, Rows]:
    """Pairs of boxes no farther apart than `reach`, by trees over both, in no order."""
    one, two = _level_trees(first, second)
    i, j = np.nonzero(_near(one[0][:, :, None], two[0][:, None, :], reach))
    for low, high in zip(one[1:], two[1:], strict=True):
        i, j = children(i, j, low.shape[1], high.shape[1])
        keep = _near(low.take(i, axis=1), high.take(j, axis=1), reach)
        i, j = i[keep], j[keep]
    keep = reaching(first.take(i, axis=1), second.take(j, axis=1), reach)
    return i[keep], j[keep]


def _runs(boxes: Floats) -> Floats:
    """(4, RUN, m) boxes in runs of RUN, box k of run r at [:, k, r]; the last run is filled up with boxes nowhere."""
    count = boxes.shape[1]
    whole = np.empty((4, -(-count // RUN) * RUN))
    whole[:, :count] = boxes
    whole[:2, count:], whole[2:, count:] = np.inf, -np.inf
    return np.ascontiguousarray(whole.reshape(4, -1, RUN).transpose(0, 2, 1))


def _bounds(runs: Floats) -> Floats:
    """(4, m) the box around each run."""
    return np.vstack((runs[:2].min(axis=1), runs[2:].max(axis=1)))


def _members(first: Floats, second: Floats, one: Rows, two: Rows, reach: float) -> tuple[Rows, Rows]:
    """Pairs of boxes in paired runs no farther apart than `reach`, in rising order of i."""
    order = np.argsort(one, kind="stable")
    one, two = one[order], two[order]
    a, b = _runs(first), _runs(second)
    a[:2] -= reach
    a[2:] += reach
    found = [np.zeros((2, 0), np.intp)]
    for start in range(0, len(one), RUNS_AT_ONCE):
        left, right = one[start : start + RUNS_AT_ONCE], two[start : start + RUNS_AT_ONCE]
        low, high = a.take(left, axis=2)[:, :, None], b.take(right, axis=2)[:, None]
        apart = low[0] > high[2]
        apart |= high[0] > low[2]
        apart |= low[1] > high[3]
        apart |= high[1] > low[3]
        where = np.flatnonzero(~apart.reshape(RUN * RUN, -1).T)
        pair, member = where // (RUN * RUN), where & (RUN * RUN - 1)
        i, j = RUN * left[pair] + member // RUN, RUN * right[pair] + (member & (RUN - 1))
        # a box that is no number is near those nowhere too
        real = (i < first.shape[1]) & (j < second.shape[1])
        i, j = i[real], j[real]
        keep = reaching(first.take(i, axis=1), second.take(j, axis=1), reach)
        found.append(np.stack((i[keep], j[keep])))
    i, j = np.concatenate(found, axis=1)
    order = np.argsort(i, kind="stable")
    return i[order], j[order]


def closest_pairs(first: Floats, second: Floats) -> tuple[Rows, Rows]:
    """Indices (i, j) of the boxes that may hold the two points, one of each side, that are nearest to each other."""
    one, two = _level_trees(first, second)
    i, j = np.nonzero(np.ones((one[0].shape[1], two[0].shape[1]), np.bool_))
    i, j = _contenders(i, j, one[0], two[0])
    for low, high in zip(one[1:], two[1:], strict=True):
        i, j = _contenders(*children(i, j, low.shape[1], high.shape[1]), low, high)
    return i, j


def nearest_boxes(points: Points, boxes: Floats, within: Floats, slack: float) -> tuple[Rows, Rows]:
    """Indices (k, j) in rising order of k: for each point the boxes that may hold what is nearest.

    `within` (n,) are distances at which something is known to be, infinite where nothing is known.  What is farther
    than the nearest by no more than `slack` is wanted too.
    """
    spots = np.array((points.real, points.imag, points.real, points.imag))
    coarsest, *finer = _tree(boxes, max(1, AT_ONCE // (4 * max(1, len(points)))))
    every, level = spots[:, :, None], coarsest[:, None]
    near, far = _apart(every, level), _span(every, level)
    within = np.maximum(np.minimum(within, far.min(axis=1)), near.min(axis=1))
    k, j = (near <= within[:, None] + slack).nonzero()
    for level in finer:
        k, j = _brood(k, j, level.shape[1])
        near, far = _apart(spots[:, k], level.take(j, axis=1)), _span(spots[:, k], level.take(j, axis=1))
        starts = np.searchsorted(k, np.arange(len(points)))
        within = np.minimum(within, np.minimum.reduceat(far, starts))
        within = np.maximum(within, np.minimum.reduceat(near, starts))
        keep = near <= within[k] + slack
        k, j = k[keep], j[keep]
    return k, j


def _contenders(i: Rows, j: Rows, low: Floats, high: Floats) -> tuple[Rows, Rows]:
    a, b = low.take(i, axis=1), high.take(j, axis=1)
    keep = ~(_apart(a, b) > np.min(_span(a, b)))
    return i[keep], j[keep]


def _level_trees(first: Floats, second: Floats) -> tuple[list[Floats], list[Floats]]:
    """Both trees from the coarsest groups down, equally deep; few boxes are not grouped at all."""
    if first.shape[1] * second.shape[1] <= AT_ONCE:
        return [first], [second]
    one, two = _tree(first, 1), _tree(second, 1)
    deep = max(len(one), len(two))
    one, two = one[:1] * (deep - len(one)) + one, two[:1] * (deep - len(two)) + two
    several = next((k for k in range(deep) if one[k].shape[1] * two[k].shape[1] > AT_ONCE // 16), deep) - 1
    return one[several:], two[several:]


def _tree(boxes: Floats, most: int) -> list[Floats]:
    """Boxes, groups of boxes, groups of groups ... down to `most` of them, the coarsest first."""
    levels = [boxes]
    while levels[-1].shape[1] > most:
        levels.append(grouped(levels[-1]))
    return levels[::-1]


def grouped(boxes: Floats) -> Floats:
    """The boxes around every FAN of these."""
    if boxes.shape[1] <= FEW_GROUPED:
        starts = np.arange(0, boxes.shape[1], FAN)
        around = np.minimum.reduceat(boxes[:2], starts, axis=1), np.maximum.reduceat(boxes[2:], starts, axis=1)
        return np.concatenate(around)
    whole = boxes[:, ::FAN].copy()
    for first in range(1, FAN):
        members = boxes[:, first::FAN]
        # the last group may have no such member
        groups = whole[:, : members.shape[1]]
        np.minimum(groups[:2], members[:2], out=groups[:2])
        np.maximum(groups[2:], members[2:], out=groups[2:])
    return whole


def children(i: Rows, j: Rows, first: int, second: int) -> tuple[Rows, Rows]:
    """All pairs of members of paired groups; a level that only repeats its single group keeps it."""
    i, j = _brood(i, j, second)
    j, i = _brood(j, i, first)
    return i, j


def _brood(keep: Rows, grow: Rows, count: int) -> tuple[Rows, Rows]:
    """Each group in `grow` replaced by its members below `count`, its partner in `keep` repeated."""
    members = (grow[:, None] * FAN + np.arange(FAN)).ravel()
    partners = keep.repeat(FAN)
    real = members < count
    return partners[real], members[real]


def _near(a: Floats, b: Floats, reach: float) -> Flags:
    """Boxes no farther apart than `reach` in x and in y."""
    apart = a[:2] - reach > b[2:]
    apart |= b[:2] - reach > a[2:]
    near: Flags = ~(apart[0] | apart[1])
    return near


def _apart(a: Floats, b: Floats) -> Floats:
    """Distance between boxes, 0 where they meet."""
    return _size(_between(a, b))


def _between(a: Floats, b: Floats) -> Floats:
    """(2, ...) distances between boxes along x and y, 0 where they meet."""
    gaps = np.maximum(a[:2] - b[2:], b[:2] - a[2:])
    return np.maximum(gaps, 0.0, out=gaps)


def meeting(a: Floats, b: Floats) -> Flags:
    """Boxes that have a point in common."""
    apart = a[:2] > b[2:]
    apart |= b[:2] > a[2:]
    met: Flags = ~(apart[0] | apart[1])
    return met


def reaching(a: Floats, b: Floats, reach: float) -> Flags:
    """Boxes no farther apart than `reach`."""
    gaps = _between(a, b)
    gaps *= gaps
    near: Flags = ~(gaps[0] + gaps[1] > reach * reach)
    return near


def _span(a: Floats, b: Floats) -> Floats:
    """Greatest distance between a point of one box and a point of the other."""
    return _size(np.maximum(a[2:] - b[:2], b[2:] - a[:2]))


def _size(steps: Floats) -> Floats:
    """Lengths of steps (2, ...) along x and y, which are lost.

    No longer than what a machine could have they need none of the care of `np.hypot`, which takes much longer.
    """
    steps *= steps
    # in an array of its own: what it is made from is twice as large
    size: Floats = np.sqrt(steps[0] + steps[1])
    return size
