"""Thin: stretches that are not reached but are proved to be thinner than what is worth a word.

Curves drawn by many small lines leave one at every inside corner; their thickness need not be worked out.
"""

from __future__ import annotations

import numpy as np

from core.geometry.measured import Flags, Rows, place
from core.tolerance import ON_PATH, STOCK
from core.verify.pairs import Pairs
from core.verify.reach import Stretches


def thin(pairs: Pairs, gaps: Stretches, near: Rows, radius: float) -> Flags:
    """(k,) stretches of surface that lie on lines alone and are nowhere thicker than STOCK.

    No place of a line is farther from a point than the line's ends are.  The point is that end of the centre piece
    reaching the stretch's beginning, `near` (2, k), which is nearer to it.  Stretches at the contour's two ends are
    left alone, for they may be one.
    """
    if not len(pairs.centre) or not len(gaps):
        return np.zeros(len(gaps), np.bool_)
    first, begin = place(pairs.surface, pairs.surface_stations, gaps.first + ON_PATH)
    last, end = place(pairs.surface, pairs.surface_stations, gaps.last - ON_PATH)
    bends = np.concatenate(([0], np.cumsum(pairs.surface.arcs)))
    straight = bends[last + 1] == bends[first]
    one = pairs.surface.start[first] + begin * pairs.surface.vector[first]
    other = pairs.surface.start[last] + end * pairs.surface.vector[last]
    ends = np.stack((pairs.centre.start[near[0]], pairs.centre.end[near[0]]))
    corner = np.where(np.abs(ends[0] - one) < np.abs(ends[1] - one), ends[0], ends[1])
    apart = np.maximum(np.abs(one - corner), np.abs(other - corner))
    joints = pairs.surface_stations[1:-1]
    owner = gaps.index(joints)
    inside = np.flatnonzero((owner >= 0) & (joints < gaps.last[owner]))
    np.maximum.at(apart, owner[inside], np.abs(pairs.surface.start[inside + 1] - corner[owner[inside]]))
    within = (gaps.first > 0.0) & (gaps.last < pairs.surface_stations[-1])
    proved: Flags = within & straight & (near[0] >= 0) & (apart <= radius + STOCK - ON_PATH)
    return proved
