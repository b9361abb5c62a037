"""Trim: what of the raw offset is certainly inside a wall is cut off before anything else is looked at.

Two cuts cost little and leave few pieces that cross: at inside corners of two lines both end where they meet, for
beyond that each is nearer to the other's segment than the radius; and what the cutter, standing there, would have of
a vertex of the surface inside its circle goes, with the vertices 1, 2, 4, 8 ... segments ahead and behind.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.comp.best_path.raw_offset import RawOffset, Untrimmed
from core.geometry.path import Flags, Floats, Points, Rows
from core.tolerance import CROWDED, JOINED

_INSIDE: Final = 1e-6
"""By this share of the radius, and by CROWDED, must a vertex be nearer than it to be certainly inside.

What is cut off ends so far from every place where the path may turn that it is never taken for such a place.
"""


@dataclass(frozen=True, eq=False, slots=True)
class _Left:
    """What is left of the m pieces, `low` to `high` (m,) mm along them; nothing where high is not above low."""

    low: Floats
    high: Floats


def trimmed(chain: Untrimmed, sign: int, radius: float) -> RawOffset:
    """The raw offset without what is certainly nearer to the surface than `radius`; `sign` +1 is LEFT."""
    raw = chain.raw
    left = _Left(np.zeros(len(raw)), raw.lengths.copy())
    corners, meets = _mitered(chain, left, sign, radius)
    before = _Left(left.low.copy(), left.high.copy())
    _cut_inside(chain, left, radius)
    cut_low, cut_high = left.low > before.low, left.high < before.high
    if not len(corners) and not cut_low.any() and not cut_high.any():
        return raw
    return _rebuilt(chain, left, (corners, meets), cut_low, cut_high)


def _mitered(chain: Untrimmed, left: _Left, sign: int, radius: float) -> tuple[Rows, Points]:
    """Inside corners of two lines that meet: the first line's row and the point; `left` is cut there.

    Where three offset lines meet in one place, or nearly, all is left to the general rule.
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
    left.high[rows] -= short
    left.low[after] = short
    crowded = np.abs(left.high - left.low) <= CROWDED
    lost = crowded[rows] | crowded[after]
    if lost.any():
        left.high[rows[lost]], left.low[after[lost]] = raw.lengths[rows[lost]], 0.0
        rows, unit, short = rows[~lost], unit[~lost], short[~lost]
    return rows, raw.end[rows] - short * unit


def _cut_inside(chain: Untrimmed, left: _Left, radius: float) -> None:
    """Cut from `left` what vertices ahead and behind, ever farther off until none is near, have in their circles."""
    limit = radius - max(_INSIDE * radius, 2.0 * CROWDED)
    step, near = 1, limit > 0.0
    while near and step < len(chain.vertices):
        near = False
        segment = chain.raw.segment
        for rows in (segment + 1 + step, segment + chain.corner - step):
            known = np.minimum(np.maximum(rows, 0), len(chain.vertices) - 1)
            spots = chain.vertices[known]
            near |= bool(((np.abs(spots - chain.raw.start) < 2.0 * radius) & (known == rows)).any())
            _cut(chain.raw, left, spots, limit)
        step *= 2


def _cut(raw: RawOffset, left: _Left, spots: Points, limit: float) -> None:
    """Cut from all pieces what at either end of them is within `limit` of their spots."""
    near = (np.abs(spots - raw.start) < limit + raw.lengths) & (left.low < left.high)
    for kind, within in ((raw.turns == 0, _within_lines), (raw.turns != 0, _within_arcs)):
        rows = (near & kind).nonzero()[0]
        if not len(rows):
            continue
        begin, end = within(raw, rows, spots[rows], limit)
        low, high = left.low[rows], left.high[rows]
        at_low, at_high = (begin <= low) & (end > low), (end >= high) & (begin < high)
        left.low[rows[at_low]] = end[at_low]
        left.high[rows[at_high]] = begin[at_high]


def _within_lines(raw: RawOffset, rows: Rows, spots: Points, limit: float) -> tuple[Floats, Floats]:
    """From where to where along lines points are within `limit` of spots; NaN where none is."""
    unit = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    foot = unit.conj() * (spots - raw.start[rows])
    square = limit * limit - foot.imag * foot.imag
    half = np.sqrt(np.where(square > 0.0, square, np.nan))
    return foot.real - half, foot.real + half


def _within_arcs(raw: RawOffset, rows: Rows, spots: Points, limit: float) -> tuple[Floats, Floats]:
    """The same of arcs, of two stretches the one nearer to an arc's middle; NaN for an arc's own center."""
    arm, spokes = raw.start[rows] - raw.center[rows], spots - raw.center[rows]
    radius, apart = np.abs(arm), np.abs(spokes)
    off_center, off = apart > JOINED, apart - radius
    # the sine of half the angle: of a large arc its cosine differs from 1 by less than rounding
    square = (limit - off) * (limit + off) / (4.0 * radius * np.where(off_center, apart, 1.0))
    half = 2.0 * np.arcsin(np.sqrt(np.where(off_center & (square > 0.0), np.minimum(square, 1.0), np.nan)))
    middle = raw.lengths[rows] / radius / 2.0
    angle = np.angle(arm.conj() * spokes) * raw.turns[rows] - middle
    angle = angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi)) + middle
    return (angle - half) * radius, (angle + half) * radius


def _rebuilt(chain: Untrimmed, left: _Left, corners: tuple[Rows, Points], cut_low: Flags, cut_high: Flags) -> RawOffset:
    """The raw offset of what is left: pieces shortened, dead ones gone, and what was joined to those blunt."""
    raw, (rows, meets) = chain.raw, corners
    following, smooth = raw.following.copy(), raw.smooth.copy()
    following[rows], smooth[rows] = chain.order[rows], True
    gone = left.high - left.low <= np.where(cut_low | cut_high, JOINED, -CROWDED)
    start, end = raw.start.copy(), raw.end.copy()
    start[chain.order[rows]], end[rows] = meets, meets
    start[cut_low] = raw.at(cut_low.nonzero()[0], left.low[cut_low])
    end[cut_high] = raw.at(cut_high.nonzero()[0], left.high[cut_high])
    joined = (following >= 0).nonzero()[0]
    after = following[joined]
    apart = gone[joined] | cut_high[joined] | gone[after] | cut_low[after]
    blunt_start, blunt_end = cut_low, cut_high
    blunt_end[joined[apart]], blunt_start[after[apart]] = True, True
    following[joined[apart]], smooth[joined[apart]] = -1, False
    size = left.high - left.low
    raw = replace(raw, start=start, end=end, lengths=size, following=following, smooth=smooth)
    raw = replace(raw, blunt_start=blunt_start, blunt_end=blunt_end)
    return raw.kept(~gone) if gone.any() else raw
