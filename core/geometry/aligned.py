"""Which boxes of two rows that run along each other are near, when nearly all near ones stand side by side.

Box k of the one row belongs to box k of the other, as a wall and the move beside it do.  Boxes with nearly the same
index are compared by shifting one row along the other, groups of them likewise; only groups that are near and not side
by side are opened.  Boxes are (4, n) arrays: least x, least y, largest x, largest y; one of infinite, turned
bounds is nowhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.geometry.boxes import FAN, children, grouped, meeting, near_pairs, reaching
from core.geometry.path import Flags, Floats, Rows

SHIFTS: Final = 2 * FAN
"""From so many indices apart on, the groups of two boxes are no neighbors."""

FEW: Final = 200
"""Boxes of which comparing every pair costs less than shifting."""


@dataclass(frozen=True, eq=False, slots=True)
class Runs:
    """Runs of boxes of which nothing is wanted, told by two sums along both rows that grow from box to box.

    `begin` and `end` (2, n) are the sums where a box begins and where it ends, of the `first` row and the `second`.
    Boxes, one of each row, are in one run if either sum grows by no more than 1 from where the earlier begins to
    where the later ends.
    """

    first_begin: Floats
    first_end: Floats
    second_begin: Floats
    second_end: Floats

    def grouped(self) -> Runs:
        """The sums of groups of boxes: where the first member begins and the last one ends."""
        last = np.append(np.arange(FAN - 1, self.first_end.shape[1] - 1, FAN), self.first_end.shape[1] - 1)
        first_end, second_end = self.first_end[:, last], self.second_end[:, last]
        return Runs(self.first_begin[:, ::FAN].copy(), first_end, self.second_begin[:, ::FAN].copy(), second_end)

    def ahead(self, step: int) -> Flags:
        """(n - step,) whether box k of the first row and box k + step of the second are in one run."""
        return _in_one(self.first_begin[:, :-step], self.second_end[:, step:])

    def behind(self, step: int) -> Flags:
        """(n - step,) whether box k + step of the first row and box k of the second are in one run."""
        return _in_one(self.second_begin[:, :-step], self.first_end[:, step:])


def _in_one(begin: Floats, end: Floats) -> Flags:
    one: Flags = end[0] - begin[0] <= 1.0
    one |= end[1] - begin[1] <= 1.0
    return one


def aligned_pairs(
    first: Floats, second: Floats, reach: float, apart: int, *, both: bool = True, runs: Runs | None = None
) -> tuple[Rows, Rows]:
    """Indices (i, j), in no order, of all boxes no farther apart than `reach` with |i - j| >= `apart`, 1 or 2.

    Both rows have the same length.  Only pairs i < j are wanted unless `both`; some within `runs` are left out.
    """
    if first.shape[1] <= FEW:
        i, j = near_pairs(first, second, reach)
        keep = ((np.abs(i - j) if both else j - i) >= apart).nonzero()[0]
        return i[keep], j[keep]
    grown = first.copy()
    grown[:2] -= reach
    grown[2:] += reach
    levels = [(grown, second, runs)]
    while levels[-1][0].shape[1] > SHIFTS:
        one, other, proved = levels[-1]
        levels.append((grouped(one), grouped(other), proved.grouped() if proved else None))
    none = np.zeros(0, np.intp)
    i, j = none, none
    for depth in range(len(levels) - 1, -1, -1):
        one, other, proved = levels[depth]
        i, j = _opened(i, j, one, other)
        beside = _shifted(one, other, 2 if depth else apart, proved, both=both)
        i, j = np.concatenate((beside[0], i)), np.concatenate((beside[1], j))
    keep = (reaching(first.take(i, axis=1), second.take(j, axis=1), reach)).nonzero()[0]
    return i[keep], j[keep]


def _opened(i: Rows, j: Rows, one: Floats, other: Floats) -> tuple[Rows, Rows]:
    """The members of paired groups that meet, but those nearly side by side."""
    if not len(i):
        return i, j
    i, j = children(i, j, one.shape[1], other.shape[1])
    far = (np.abs(i - j) >= SHIFTS).nonzero()[0]
    i, j = i[far], j[far]
    met = (meeting(one.take(i, axis=1), other.take(j, axis=1))).nonzero()[0]
    return i[met], j[met]


def _shifted(one: Floats, other: Floats, apart: int, runs: Runs | None, *, both: bool) -> tuple[Rows, Rows]:
    """Boxes that meet and are in no run, from `apart` to less than SHIFTS indices from each other."""
    found_i, found_j = [np.zeros(0, np.intp)], [np.zeros(0, np.intp)]
    for step in range(apart, min(SHIFTS, one.shape[1])):
        low = _met(one[:, :-step], other[:, step:], runs.ahead(step) if runs else None)
        found_i.append(low)
        found_j.append(low + step)
        if both:
            low = _met(one[:, step:], other[:, :-step], runs.behind(step) if runs else None)
            found_i.append(low + step)
            found_j.append(low)
    return np.concatenate(found_i), np.concatenate(found_j)


def _met(one: Floats, other: Floats, proved: Flags | None) -> Rows:
    """Indices of boxes that meet and of which nothing is proved; few are looked at alone."""
    if proved is None:
        return meeting(one, other).nonzero()[0]
    rows = (~proved).nonzero()[0]
    if 4 * len(rows) > len(proved):
        return (meeting(one, other) & ~proved).nonzero()[0]
    return rows[meeting(one.take(rows, axis=1), other.take(rows, axis=1))]
