"""Which boxes of two rows that run along each other are near, when nearly all near ones stand side by side.

Box k of the one row belongs to box k of the other, as a wall and the move beside it do.  Boxes with nearly the same
index are compared by shifting one row along the other, groups of them likewise; only groups that are near and not side
by side are opened.  Boxes are (4, n) arrays: least x, least y, largest x, largest y; one of infinite, turned
bounds is nowhere.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.geometry.boxes import FAN, children, grouped, meeting, near_pairs, reaching
from core.geometry.measured import Floats, Rows

SHIFTS: Final = 2 * FAN
"""From so many indices apart on, the groups of two boxes are no neighbours."""


FEW: Final = 100
"""Boxes of which comparing every pair costs less than shifting."""


def aligned_pairs(first: Floats, second: Floats, reach: float, apart: int, *, both: bool = True) -> tuple[Rows, Rows]:
    """Indices (i, j), in no order, of all boxes no farther apart than `reach` with |i - j| >= `apart`, 1 or 2.

    Both rows have the same length.  Only pairs i < j are wanted unless `both`.
    """
    if first.shape[1] <= FEW:
        i, j = near_pairs(first, second, reach)
        keep = np.flatnonzero((np.abs(i - j) if both else j - i) >= apart)
        return i[keep], j[keep]
    grown = first.copy()
    grown[:2] -= reach
    grown[2:] += reach
    levels = [(grown, second)]
    while levels[-1][0].shape[1] > SHIFTS:
        one, other = levels[-1]
        levels.append((grouped(one), grouped(other)))
    none = np.zeros(0, np.intp)
    i, j = none, none
    for depth in range(len(levels) - 1, -1, -1):
        one, other = levels[depth]
        i, j = _opened(i, j, one, other)
        beside = _shifted(one, other, 2 if depth else apart, both=both)
        i, j = np.concatenate((beside[0], i)), np.concatenate((beside[1], j))
    keep = np.flatnonzero(reaching(first.take(i, axis=1), second.take(j, axis=1), reach))
    return i[keep], j[keep]


def _opened(i: Rows, j: Rows, one: Floats, other: Floats) -> tuple[Rows, Rows]:
    """The members of paired groups that meet, but those nearly side by side."""
    if not len(i):
        return i, j
    i, j = children(i, j, one.shape[1], other.shape[1])
    far = np.flatnonzero(np.abs(i - j) >= SHIFTS)
    i, j = i[far], j[far]
    met = np.flatnonzero(meeting(one.take(i, axis=1), other.take(j, axis=1)))
    return i[met], j[met]


def _shifted(one: Floats, other: Floats, apart: int, *, both: bool) -> tuple[Rows, Rows]:
    """Boxes that meet, from `apart` to less than SHIFTS indices from each other."""
    found_i, found_j = [np.zeros(0, np.intp)], [np.zeros(0, np.intp)]
    for step in range(apart, min(SHIFTS, one.shape[1])):
        low = np.flatnonzero(meeting(one[:, :-step], other[:, step:]))
        found_i.append(low)
        found_j.append(low + step)
        if both:
            low = np.flatnonzero(meeting(one[:, step:], other[:, :-step]))
            found_i.append(low + step)
            found_j.append(low)
    return np.concatenate(found_i), np.concatenate(found_j)
