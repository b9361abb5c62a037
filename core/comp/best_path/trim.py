"""Trim: what of the raw pieces is certainly in a wall is cut off before anything else is looked at.

Two cuts cost little and leave few pieces that cross: at inside corners of two lines both end where they meet, for
beyond that each is nearer to the other's segment than the radius; and what the cutter, standing there, would have of
a joint of the surface inside its circle goes, with joints 1, 2, 4, 8 ... segments ahead and behind.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.comp.best_path.meetings import places
from core.comp.best_path.raw_offset import Raw, Untrimmed
from core.geometry.path import Flags, Floats, Points, Rows
from core.tolerance import CROWDED, JOINED

PROBES: Final = 4096
"""So many pieces, spread evenly, are tried first: what cuts none of them is not tried on the others."""

FEW: Final = 1000
"""So few pieces are held against all joints at once: that costs little memory, and a tenth of the calls."""

_SPREAD: Final = 0.6180339887498949
"""Multiples of the golden section, less their whole numbers, are spread evenly and follow no pattern of a contour."""

_INSIDE: Final = 1e-6
"""By this share of the radius, and by CROWDED, must a joint be nearer than it to be certainly inside.

What is cut off ends so far from every place where the path may turn that it is never taken for such a place.
"""


@dataclass(frozen=True, eq=False, slots=True)
class _Left:
    """What is left of the m pieces, `low` to `high` (m,) mm along them; nothing where high is not above low."""

    low: Floats
    high: Floats


def trimmed(chain: Untrimmed, sign: int, radius: float) -> Raw:
    """The raw chain without what is certainly nearer to the surface than `radius`; `sign` +1 is LEFT."""
    raw = chain.raw
    left = _Left(np.zeros(len(raw)), raw.lengths.copy())
    corners, meets = _mitred(chain, left, sign, radius)
    before = _Left(left.low.copy(), left.high.copy())
    _narrowed(chain, left, radius)
    cut_low, cut_high = left.low > before.low, left.high < before.high
    if not len(corners) and not cut_low.any() and not cut_high.any():
        return raw
    return _rebuilt(chain, left, (corners, meets), cut_low, cut_high)


def _mitred(chain: Untrimmed, left: _Left, sign: int, radius: float) -> tuple[Rows, Points]:
    """Inside corners of two lines that meet: the first line's row and the point; `left` is cut there.

    Where three offset lines meet in one place, or nearly, all is left to the general rule.
    """
    raw, order = chain.raw, chain.order
    rows = (chain.inside & (raw.turns == 0)).nonzero()[0]
    rows = rows[raw.turns[order[rows]] == 0]
    behind = order[rows]
    one = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    two = (raw.end[behind] - raw.start[behind]) / raw.lengths[behind]
    bend = one.conj() * two
    short = radius * sign * bend.imag
    room = (1.0 + bend.real) * np.minimum(raw.lengths[rows], raw.lengths[behind])
    fits = (short > 0.0) & (short <= room)
    rows, behind, one = rows[fits], behind[fits], one[fits]
    short = short[fits] / (1.0 + bend.real[fits])
    left.high[rows] -= short
    left.low[behind] = short
    crowded = np.abs(left.high - left.low) <= CROWDED
    lost = crowded[rows] | crowded[behind]
    if lost.any():
        left.high[rows[lost]], left.low[behind[lost]] = raw.lengths[rows[lost]], 0.0
        rows, one, short = rows[~lost], one[~lost], short[~lost]
    return rows, raw.end[rows] - short * one


def _narrowed(chain: Untrimmed, left: _Left, radius: float) -> None:
    """Cut from `left` what the joints of the surface ahead and behind have inside their circles."""
    limit = radius - max(_INSIDE * radius, 2.0 * CROWDED)
    if limit <= 0.0:
        return
    if len(chain.raw) <= FEW:
        _narrowed_at_once(chain, left, radius, limit)
    else:
        _narrowed_by_steps(chain, left, radius, limit)


def _narrowed_at_once(chain: Untrimmed, left: _Left, radius: float, limit: float) -> None:
    """All joints that `_narrowed_by_steps` tries, in its order: the stretches to cut depend on no cut before them."""
    raw, rows = chain.raw, np.arange(len(chain.raw))
    steps = [1 << power for power in range(max(len(chain.joints) - 1, 0).bit_length())]
    if not steps or not len(raw):
        return
    spots = np.stack([_joints(chain, rows, step, ahead=ahead) for step in steps for ahead in (True, False)])
    apart = np.abs(spots - raw.start)
    far = apart.min(axis=1).reshape(-1, 2).min(axis=1) >= 2.0 * radius
    tried = 2 * (int(far.argmax()) + 1) if far.any() else len(spots)
    near = apart[:tried] < limit + raw.lengths
    begin, end = np.full((2, tried, len(raw)), np.nan)
    arcs = raw.turns != 0
    with np.errstate(divide="ignore", invalid="ignore"):
        for some, within in (((~arcs).nonzero()[0], _within_lines), (arcs.nonzero()[0], _within_arcs)):
            begin[:, some], end[:, some] = within(raw, some, spots[:tried, some], limit)
    begin[~near] = np.nan
    low, high = left.low, left.high
    for row in np.flatnonzero(near.any(axis=1)).tolist():
        first, last, alive = begin[row], end[row], low < high
        at_low, at_high = alive & (first <= low) & (last > low), alive & (last >= high) & (first < high)
        low[at_low] = last[at_low]
        high[at_high] = first[at_high]


def _narrowed_by_steps(chain: Untrimmed, left: _Left, radius: float, limit: float) -> None:
    """Joints ever farther off, until none is near; first of some pieces, then of all where that cuts anything."""
    raw, joints = chain.raw, chain.joints
    count, step = len(raw), 1
    probes = np.arange(count)
    if count > PROBES:
        probes = np.unique((np.arange(PROBES) * _SPREAD % 1.0 * count).astype(np.intp))
    close = True
    while close and step < len(joints):
        close = False
        for ahead in (True, False):
            spots = _joints(chain, probes, step, ahead=ahead)
            close |= bool((np.abs(spots - raw.start[probes]) < 2.0 * radius).any())
            if _cut(raw, left, probes, spots, limit) and len(probes) < count:
                every = np.arange(count)
                _cut(raw, left, every, _joints(chain, every, step, ahead=ahead), limit)
        step *= 2


def _joints(chain: Untrimmed, rows: Rows, step: int, *, ahead: bool) -> Points:
    """The joint `step` segments ahead of pieces, or behind them, their own ends not counted."""
    segment = chain.raw.segment[rows]
    own = segment + 1 + step if ahead else segment + chain.corner[rows] - step
    return chain.joints[np.minimum(np.maximum(own, 0), len(chain.joints) - 1)]


def _cut(raw: Raw, left: _Left, rows: Rows, spots: Points, limit: float) -> bool:
    """Cut from pieces `rows` what at either end of them is within `limit` of their spots; was there anything?"""
    near = np.abs(spots - raw.start[rows]) < limit + raw.lengths[rows]
    near &= left.low[rows] < left.high[rows]
    rows, spots = rows[near], spots[near]
    arcs = raw.turns[rows] != 0
    any_cut = False
    for some, within in ((~arcs, _within_lines), (arcs, _within_arcs)):
        part = rows[some]
        if not len(part):
            continue
        begin, end = within(raw, part, spots[some], limit)
        low, high = left.low[part], left.high[part]
        at_low, at_high = (begin <= low) & (end > low), (end >= high) & (begin < high)
        left.low[part[at_low]] = end[at_low]
        left.high[part[at_high]] = begin[at_high]
        any_cut |= bool(at_low.any() or at_high.any())
    return any_cut


def _within_lines(raw: Raw, rows: Rows, spots: Points, limit: float) -> tuple[Floats, Floats]:
    """From where to where along lines points are within `limit` of spots; NaN where none is."""
    unit = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    foot = unit.conj() * (spots - raw.start[rows])
    square = limit * limit - foot.imag * foot.imag
    half = np.sqrt(np.where(square > 0.0, square, np.nan))
    return foot.real - half, foot.real + half


def _within_arcs(raw: Raw, rows: Rows, spots: Points, limit: float) -> tuple[Floats, Floats]:
    """The same of arcs, of two stretches the one nearer to an arc's middle; NaN for an arc's own center."""
    arm, towards = raw.start[rows] - raw.center[rows], spots - raw.center[rows]
    radius, apart = np.abs(arm), np.abs(towards)
    off_center, off = apart > JOINED, apart - radius
    # the sine of half the angle: of a large arc its cosine differs from 1 by less than rounding
    square = (limit - off) * (limit + off) / (4.0 * radius * np.where(off_center, apart, 1.0))
    half = 2.0 * np.arcsin(np.sqrt(np.where(off_center & (square > 0.0), np.minimum(square, 1.0), np.nan)))
    middle = raw.lengths[rows] / radius / 2.0
    angle = np.angle(arm.conj() * towards) * raw.turns[rows] - middle
    angle = angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi)) + middle
    return (angle - half) * radius, (angle + half) * radius


def _rebuilt(chain: Untrimmed, left: _Left, corners: tuple[Rows, Points], cut_low: Flags, cut_high: Flags) -> Raw:
    """The raw chain of what is left: pieces shortened, dead ones gone, and what was joined to those blunt."""
    raw, (rows, meets) = chain.raw, corners
    following, smooth = raw.following.copy(), raw.smooth.copy()
    following[rows], smooth[rows] = chain.order[rows], True
    gone = left.high - left.low <= np.where(cut_low | cut_high, JOINED, -CROWDED)
    start, end = raw.start.copy(), raw.end.copy()
    start[chain.order[rows]], end[rows] = meets, meets
    start[cut_low] = places(raw, cut_low.nonzero()[0], left.low[cut_low])
    end[cut_high] = places(raw, cut_high.nonzero()[0], left.high[cut_high])
    joined = (following >= 0).nonzero()[0]
    behind = following[joined]
    apart = gone[joined] | cut_high[joined] | gone[behind] | cut_low[behind]
    blunt_start, blunt_end = cut_low, cut_high
    blunt_end[joined[apart]], blunt_start[behind[apart]] = True, True
    following[joined[apart]], smooth[joined[apart]] = -1, False
    raw = replace(
        raw,
        start=start,
        end=end,
        lengths=left.high - left.low,
        following=following,
        smooth=smooth,
        blunt_start=blunt_start,
        blunt_end=blunt_end,
    )
    return _kept(raw, ~gone) if gone.any() else raw


def _kept(raw: Raw, keep: Flags) -> Raw:
    """Some pieces of the chain; those that followed a piece that is gone follow none."""
    place = np.where(keep, np.cumsum(keep) - 1, -1)
    following = raw.following[keep]
    return Raw(
        raw.start[keep],
        raw.end[keep],
        raw.center[keep],
        raw.turns[keep],
        raw.numbers[keep],
        raw.lengths[keep],
        np.where(following >= 0, place[following], -1),
        raw.smooth[keep],
        raw.side[keep],
        raw.segment[keep],
        raw.blunt_start[keep],
        raw.blunt_end[keep],
    )
