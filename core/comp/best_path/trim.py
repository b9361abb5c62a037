"""Trim: first cut off the parts of the raw offset that are certainly inside a wall.

Two cheap cuts leave few pieces that cross.  At an inside corner of two lines both end where they meet, since past that
point each is nearer to the other's segment than the radius.  And the parts from which the cutter would cover a vertex
of the surface are dropped, for the vertices 1, 2, 4, 8 ... segments ahead and back.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.comp.best_path.raw_offset import RawOffset, Untrimmed
from core.geometry.path import Flags, Floats, Points, Rows
from core.tolerance import CROWDED, JOINED

_INSIDE: Final = 1e-6
"""A vertex is certainly inside if it is nearer than the radius by more than this share of it, and than 2 CROWDED.

The cuts thus end well away from every place where the path may turn, and are never mistaken for one.
"""


@dataclass(frozen=True, eq=False, slots=True)
class _Remainder:
    """The rest of the m pieces, from `low` to `high` (m,) mm along them; nothing remains if high is not above low."""

    low: Floats
    high: Floats


def trimmed(chain: Untrimmed, sign: int, radius: float) -> RawOffset:
    """Return the raw offset without the parts certainly nearer to the surface than `radius`; `sign` +1 is LEFT."""
    raw = chain.raw
    rest = _Remainder(np.zeros(len(raw)), raw.lengths.copy())
    corners, meets = _mitered(chain, rest, sign, radius)
    before = _Remainder(rest.low.copy(), rest.high.copy())
    _cut_inside(chain, rest, radius)
    cut_low, cut_high = rest.low > before.low, rest.high < before.high
    if not len(corners) and not cut_low.any() and not cut_high.any():
        return raw
    return _rebuilt(chain, rest, (corners, meets), cut_low, cut_high)


def _mitered(chain: Untrimmed, rest: _Remainder, sign: int, radius: float) -> tuple[Rows, Points]:
    """Cut `rest` at inside corners of two lines that meet; return the rows of the first lines and the points.

    If three offset lines meet in nearly one place, the corner is left to the general rule.
    """
    raw, order = chain.raw, chain.order
    rows = (chain.inside & (raw.turns == 0)).nonzero()[0]
    rows = rows[raw.turns[order[rows]] == 0]
    after = order[rows]
    unit = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    bend = unit.conj() * (raw.end[after] - raw.start[after]) / raw.lengths[after]
    short = radius * sign * bend.imag
    room = (1.0 + bend.real) * np.minimum(raw.lengths[rows], raw.lengths[after])
    fits = (short > 0.0) & (short <= room)
    rows, after, unit = rows[fits], after[fits], unit[fits]
    short = short[fits] / (1.0 + bend.real[fits])
    rest.high[rows] -= short
    rest.low[after] = short
    crowded = np.abs(rest.high - rest.low) <= CROWDED
    lost = crowded[rows] | crowded[after]
    if lost.any():
        rest.high[rows[lost]], rest.low[after[lost]] = raw.lengths[rows[lost]], 0.0
        rows, unit, short = rows[~lost], unit[~lost], short[~lost]
    return rows, raw.end[rows] - short * unit


def _cut_inside(chain: Untrimmed, rest: _Remainder, radius: float) -> None:
    """Cut from `rest` what lies in circles about vertices ahead and back, at growing distance until none is near."""
    limit = radius - max(_INSIDE * radius, 2.0 * CROWDED)
    step, near = 1, limit > 0.0
    while near and step < len(chain.vertices):
        near = False
        segment = chain.raw.segment
        for rows in (segment + 1 + step, segment + chain.corner - step):
            known = np.minimum(np.maximum(rows, 0), len(chain.vertices) - 1)
            spots = chain.vertices[known]
            near |= bool(((np.abs(spots - chain.raw.start) < 2.0 * radius) & (known == rows)).any())
            _cut(chain.raw, rest, spots, limit)
        step *= 2


def _cut(raw: RawOffset, rest: _Remainder, spots: Points, limit: float) -> None:
    """Cut off both ends of all pieces where they are within `limit` of their spots."""
    near = (np.abs(spots - raw.start) < limit + raw.lengths) & (rest.low < rest.high)
    for kind, within in ((raw.turns == 0, _within_lines), (raw.turns != 0, _within_arcs)):
        rows = (near & kind).nonzero()[0]
        if not len(rows):
            continue
        begin, end = within(raw, rows, spots[rows], limit)
        low, high = rest.low[rows], rest.high[rows]
        at_low, at_high = (begin <= low) & (end > low), (end >= high) & (begin < high)
        rest.low[rows[at_low]] = end[at_low]
        rest.high[rows[at_high]] = begin[at_high]


def _within_lines(raw: RawOffset, rows: Rows, spots: Points, limit: float) -> tuple[Floats, Floats]:
    """Return the interval along lines in which points are within `limit` of spots; NaN if there is none."""
    unit = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    foot = unit.conj() * (spots - raw.start[rows])
    square = limit * limit - foot.imag * foot.imag
    half = np.sqrt(np.where(square > 0.0, square, np.nan))
    return foot.real - half, foot.real + half


def _within_arcs(raw: RawOffset, rows: Rows, spots: Points, limit: float) -> tuple[Floats, Floats]:
    """Return the same for arcs, modulo full turns the one nearest to the arc's middle; NaN for an arc's own center."""
    arm, spokes = raw.start[rows] - raw.center[rows], spots - raw.center[rows]
    radius, apart = np.abs(arm), np.abs(spokes)
    off_center, off = apart > JOINED, apart - radius
    # use the sine of half the angle: the cosine for a large arc differs from 1 by less than rounding
    square = (limit - off) * (limit + off) / (4.0 * radius * np.where(off_center, apart, 1.0))
    half = 2.0 * np.arcsin(np.sqrt(np.where(off_center & (square > 0.0), np.minimum(square, 1.0), np.nan)))
    middle = raw.lengths[rows] / radius / 2.0
    angle = np.angle(arm.conj() * spokes) * raw.turns[rows] - middle
    angle = angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi)) + middle
    return (angle - half) * radius, (angle + half) * radius


def _rebuilt(
    chain: Untrimmed, rest: _Remainder, corners: tuple[Rows, Points], cut_low: Flags, cut_high: Flags
) -> RawOffset:
    """Shorten the raw pieces, drop those of which nothing remains, and mark their neighbors' ends as blunt."""
    raw, (rows, meets) = chain.raw, corners
    following, smooth = raw.following.copy(), raw.smooth.copy()
    following[rows], smooth[rows] = chain.order[rows], True
    gone = rest.high - rest.low <= np.where(cut_low | cut_high, JOINED, -CROWDED)
    start, end = raw.start.copy(), raw.end.copy()
    start[chain.order[rows]], end[rows] = meets, meets
    start[cut_low] = raw.at(cut_low.nonzero()[0], rest.low[cut_low])
    end[cut_high] = raw.at(cut_high.nonzero()[0], rest.high[cut_high])
    joined = (following >= 0).nonzero()[0]
    after = following[joined]
    apart = gone[joined] | cut_high[joined] | gone[after] | cut_low[after]
    blunt_start, blunt_end = cut_low, cut_high
    blunt_end[joined[apart]], blunt_start[after[apart]] = True, True
    following[joined[apart]], smooth[joined[apart]] = -1, False
    size = rest.high - rest.low
    raw = replace(raw, start=start, end=end, lengths=size, following=following, smooth=smooth)
    raw = replace(raw, blunt_start=blunt_start, blunt_end=blunt_end)
    return raw.take(~gone) if gone.any() else raw
