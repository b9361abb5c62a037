"""Raw offset: the offset curve of a whole contour before trimming, joined across the start, and what cuts it.

Words: the SIDE pieces are the offset segments and corner arcs on the cutter's side; for a closed contour they are
joined across its start.  The OUTLINE pieces are the rest of the outline of all points nearer than the radius: the
other side, and the half circles about an open contour's two ends.  They only cut.

`trimmed` cuts off what is certainly inside a wall, so that few pieces cross.  At an inside corner of two lines both end
where they meet.  Parts from which the cutter would cover a vertex of the surface are dropped, for the vertices 1, 2, 4,
8 ... segments ahead and back.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from math import tau
from typing import Final

import numpy as np

from core.comp.best_path.prepared_contour import winds
from core.comp.offset import RawChain, RawPart, offset
from core.geometry.path import Flags, Floats, Path, Pieces, Points, Rows, Turns, as_complex, joined, lengths
from core.geometry.piece import Side
from core.tolerance import CROWDED, JOINED, ON_PATH


@dataclass(frozen=True, eq=False, slots=True)
class RawOffset:
    """m raw pieces in order of travel; the side pieces come in consecutive rows.

    `start`, `end`, `center` (m,) complex; `turns` (m,); `numbers` (m,) programmed; `lengths` (m,) mm.  `following`
    (m,) is the piece whose start is this one's end, -1 if there is none; `smooth` (m,) marks pieces joined to it with
    nothing vanished between; `gaps` (m,) is the gap to it before the two were joined, mostly 0.  `side`
    (m,) marks the side pieces, which belong to the surface's `segment` (m,), from 0, or to the corner after it.
    `blunt_start`, `blunt_end` (m,) mark pieces cut off inside a wall at that end.
    """

    start: Points
    end: Points
    center: Points
    turns: Turns
    numbers: Floats
    lengths: Floats
    following: Rows
    smooth: Flags
    gaps: Floats
    side: Flags
    segment: Rows
    blunt_start: Flags
    blunt_end: Flags

    def __len__(self) -> int:
        return len(self.turns)

    @property
    def pieces(self) -> Pieces:
        """All pieces, without a copy."""
        return Pieces(self.start, self.end, self.center, self.turns)

    def take(self, marked: Flags) -> RawOffset:
        """Return the pieces that are `marked` (m,); pieces whose following piece is dropped have none."""
        columns = {field.name: getattr(self, field.name)[marked] for field in fields(self)}
        return RawOffset(**{**columns, "following": renumbered(columns["following"], marked)})

    def directions(self, rows: Rows, points: Points) -> Points:
        """Return the (k,) directions of travel of pieces at points on them, not of unit length."""
        turns, span = self.turns[rows], self.end[rows] - self.start[rows]
        return np.where(turns == 0, span, 1j * turns * (points - self.center[rows]))

    def along(self, rows: Rows, points: Points) -> Floats:
        """Return the (k,) distances along the pieces, from their starts, to the positions abreast of points."""
        start, center, turns = self.start[rows], self.center[rows], self.turns[rows]
        straight = turns == 0
        span = self.end[rows] - start
        line = (span.conj() * (points - start)).real / np.where(straight, np.abs(span), 1.0)
        arm = start - center
        angle = np.mod(np.angle(arm.conj() * (points - center)) * turns, tau)
        angle = np.where((tau - angle) * np.abs(arm) <= JOINED, angle - tau, angle)
        return np.where(straight, line, angle * np.abs(arm))

    def at(self, rows: Rows, along: Floats) -> Points:
        """Return the (k,) points at distances from the pieces' starts."""
        start, turns = self.start[rows], self.turns[rows]
        arm = np.where(turns == 0, start - self.end[rows], start - self.center[rows])
        size = np.abs(arm)
        straight = start - arm * (along / size)
        curved = start - arm + arm * np.exp(1j * turns * (along / size))
        return np.where(turns == 0, straight, curved)


@dataclass(frozen=True, eq=False, slots=True)
class Untrimmed:
    """The raw offset before its inside corners are cut; segment k of the surface has the `vertices` k and k + 1.

    `successor` (m,) is the next piece in the ring, -1 at an open end; `inside` (m,) marks an inside corner between
    the two, `corner` (m,) marks corner arcs.
    """

    raw: RawOffset
    successor: Rows
    inside: Flags
    corner: Flags
    vertices: Points


def renumbered(rows: Rows, keep: Flags) -> Rows:
    """Return the new indices of `rows` among the kept rows; -1 stays -1, and a dropped row becomes -1."""
    new_index = np.append(np.where(keep, np.cumsum(keep) - 1, -1), -1)
    return new_index[rows]


def raw_offset(surface: Path, side: Side, radius: float, *, closed: bool, crossing: bool) -> Untrimmed:
    """Return the raw offset of a surface; for a closed one that crosses itself, with the outline of its other side.

    An open contour that winds or crosses itself is traveled there and back like a closed one without width: the way
    back is its other side.  For any other open contour only the half circles about its ends can cut.
    """
    if closed:
        return _around_closed(surface, side, radius, crossing=crossing)
    if crossing or winds(surface, radius):
        chain = _ring(joined((surface, surface.reversed())), side, radius)
        vertices = as_complex(joined((surface, surface.reversed())).points)
        return _raw(chain, radius, 2 * len(surface) - 1, vertices, rings=(len(chain),))
    whole = joined((surface.part(0, 1).reversed(), surface, surface.part(len(surface) - 1, len(surface)).reversed()))
    chain = _without_cusps(offset(whole, side, radius), whole, side)
    chain = RawChain(chain.raw, chain.parts, chain.half_steps - 2)
    return _raw(chain, radius, 2 * len(surface) - 1, as_complex(surface.points), rings=())


def _around_closed(surface: Path, side: Side, radius: float, *, crossing: bool) -> Untrimmed:
    chain = _ring(surface, side, radius)
    vertices = as_complex(surface.points)
    if not crossing:
        return _raw(chain, radius, 2 * len(surface), vertices, rings=(len(chain),))
    back = _ring(surface.reversed(), side, radius)
    chain, ring = _both_sides(chain, back, 2 * len(vertices)), len(chain)
    vertices = np.concatenate((vertices, vertices[::-1]))
    return _raw(chain, radius, 2 * len(surface), vertices, rings=(ring, len(chain)))


def _ring(surface: Path, side: Side, radius: float) -> RawChain:
    """Return the offset of a closed surface with the joint at its start, found by repeating the first segment."""
    chain = offset(joined((surface, surface.part(0, 1))), side, radius)
    last = int(np.searchsorted(chain.half_steps, 2 * len(surface)))
    chain = RawChain(chain.raw.part(0, last), chain.parts[:last], chain.half_steps[:last])
    return _without_cusps(chain, surface, side)


def _without_cusps(chain: RawChain, surface: Path, side: Side) -> RawChain:
    """Replace half circles about reversals whose inside faces the cutter, since they lie inside the wall, by bridges.

    The inside shows in how far the way back lies to the left of the way there, a little before the tip, by the angle
    between them and by their curvatures.  If they lie on each other, both sides are outside.
    """
    points, centers = as_complex(chain.raw.points), as_complex(chain.raw.centers)
    corners = (chain.parts == RawPart.CORNER.value).nonzero()[0]
    across = points[corners] + points[corners + 1] - 2.0 * centers[corners]
    corners = corners[np.abs(across) <= JOINED]
    if not len(corners):
        return chain
    incoming = chain.half_steps[corners].astype(np.intp) // 2
    outgoing = (incoming + 1) % len(surface)
    first, last = points[corners] - centers[corners], points[corners + 1] - centers[corners]
    bend = first.conj() * last
    sizes, curvature = surface.lengths, surface.turns / np.where(surface.turns == 0, 1.0, surface.radii)
    distance_before_tip = np.minimum(sizes[incoming], sizes[outgoing]) / 4.0
    left_of_incoming = (
        bend.imag / np.abs(bend) * distance_before_tip
        - (curvature[incoming] + curvature[outgoing]) * distance_before_tip**2 / 2.0
    )
    parts = chain.parts.copy()
    parts[corners[side.sign * left_of_incoming > JOINED]] = RawPart.BRIDGE.value
    return RawChain(chain.raw, parts, chain.half_steps)


def _both_sides(first_side: RawChain, second_side: RawChain, shift: int) -> RawChain:
    """Join two chains with a bridge between them; the second one's half steps begin at `shift`."""
    ends = np.array((first_side.raw.points[-1], second_side.raw.points[0]))
    bridge = Path.of(ends, np.zeros((1, 2)), np.zeros(1, np.int8), np.zeros(1))
    kinds = np.full(1, RawPart.BRIDGE.value, np.uint8)
    half_steps = (first_side.half_steps, first_side.half_steps[-1:] + 1, second_side.half_steps + shift)
    return RawChain(
        joined((first_side.raw, bridge, second_side.raw)),
        np.concatenate((first_side.parts, kinds, second_side.parts)),
        np.concatenate(half_steps),
    )


def _raw(chain: RawChain, radius: float, sides: int, vertices: Points, *, rings: tuple[int, ...]) -> Untrimmed:
    """Return the segments and corner arcs of a chain, joined across provisional bridges of no length.

    Side pieces have half steps 0 ... `sides` - 1.  A ring ends before each of the rows `rings`, and its last piece is
    joined to its first; if more rows follow, the row at its end belongs to neither ring.
    """
    path = chain.raw
    rows = (chain.parts <= RawPart.CORNER.value).nonzero()[0]
    points = as_complex(path.points)
    start, end, turns = points[rows], points[rows + 1], path.turns[rows]
    center = as_complex(path.centers)[rows]
    onward, successor = _onward(rows, len(chain), rings)
    gapless = (successor >= 0) & (np.abs(start[successor] - end) <= JOINED)
    bridged = (successor >= 0) & ~gapless & (chain.parts[onward[rows]] == RawPart.BRIDGE.value)
    raw = RawOffset(
        start,
        end,
        center,
        turns,
        path.numbers[rows],
        lengths(Pieces(start, end, center, turns)),
        np.where(gapless, successor, -1),
        gapless & (rows[successor] == onward[rows]),
        np.zeros(len(rows)),
        (chain.half_steps[rows] >= 0) & (chain.half_steps[rows] < sides),
        chain.half_steps[rows].astype(np.intp) // 2,
        np.zeros(len(rows), np.bool_),
        np.zeros(len(rows), np.bool_),
    )
    inside = bridged & (rows[successor] == onward[onward[rows]])
    return _smoothed(Untrimmed(raw, successor, inside, chain.parts[rows] == RawPart.CORNER.value, vertices), radius)


def _onward(rows: Rows, count: int, rings: tuple[int, ...]) -> tuple[Rows, Rows]:
    """Return the row after each of `count` rows, around each ring; and for each of `rows` the next of them, or -1."""
    onward = np.minimum(np.arange(1, count + 1), count - 1)
    successor = np.arange(1, len(rows) + 1)
    successor[-1:] = -1
    first = 0
    for last in rings:
        onward[last - 1] = first
        low, high = np.searchsorted(rows, (first, last)).tolist()
        successor[low:high][-1:] = low
        first = last + 1
    return onward, successor


def _smoothed(chain: Untrimmed, radius: float) -> Untrimmed:
    """Join neighbors that miss tangency by the rounding of typed numbers, halfway between their ends.

    They cross there at so small an angle that no formula finds the point.  The middle of the gap is off either
    offset by the gap squared over eight radii: no more than ON_PATH (BEST_PATH.md, "Near-tangent joints").
    """
    before, corner_arcs, after = _near_tangent(chain)
    raw = chain.raw
    gaps = np.abs(raw.start[after] - raw.end[before])
    radii = np.where(raw.turns == 0, radius, np.minimum(np.abs(raw.start - raw.center), radius))
    long_enough = (raw.lengths > 4.0 * CROWDED) & ~chain.corner & (raw.start != raw.end)
    joinable = (
        long_enough[before] & long_enough[after] & (gaps**2 <= 8.0 * ON_PATH * np.minimum(radii[before], radii[after]))
    )
    before, corner_arcs, after, gaps = before[joinable], corner_arcs[joinable], after[joinable], gaps[joinable]
    if not len(before):
        return chain
    start, end, size = raw.start.copy(), raw.end.copy(), raw.lengths.copy()
    start[after] = end[before] = (raw.end[before] + raw.start[after]) / 2.0
    moved = np.concatenate((before, after))
    size[moved] = lengths(Pieces(start, end, raw.center, raw.turns).take(moved))
    gap_of_piece, following, smooth = raw.gaps.copy(), raw.following.copy(), raw.smooth.copy()
    gap_of_piece[before], following[before], smooth[before] = gaps, after, True
    successor, inside = chain.successor.copy(), chain.inside.copy()
    successor[before], inside[before] = after, False
    keep = np.ones(len(raw), np.bool_)
    keep[corner_arcs[corner_arcs >= 0]] = False
    raw = replace(raw, start=start, end=end, lengths=size, following=following, smooth=smooth, gaps=gap_of_piece)
    return Untrimmed(
        raw.take(keep), renumbered(successor[keep], keep), inside[keep], chain.corner[keep], chain.vertices
    )


def _near_tangent(chain: Untrimmed) -> tuple[Rows, Rows, Rows]:
    """Return pieces that end within CROWDED of the next one, the tiny corner arc between or -1, and the next ones."""
    raw, successor = chain.raw, chain.successor
    inside = (chain.inside & (np.abs(raw.start[successor] - raw.end) <= CROWDED)).nonzero()[0]
    corners = (chain.corner & raw.smooth & (raw.lengths <= CROWDED)).nonzero()[0]
    previous = np.full(len(raw), -1)
    previous[successor[successor >= 0]] = (successor >= 0).nonzero()[0]
    corners = corners[(previous[corners] >= 0) & raw.smooth[previous[corners]]]
    before = np.concatenate((previous[corners], inside))
    between = np.concatenate((corners, np.full(len(inside), -1)))
    after = np.concatenate((successor[corners], successor[inside]))
    different = before != after
    return before[different], between[different], after[different]


_CERTAINLY_INSIDE_SHARE: Final = 1e-6
"""A vertex is certainly inside if it is nearer than the radius by more than this share of it, and than 2 CROWDED.

The cuts thus end well away from every place where the path may turn, and are never mistaken for one.
"""


def trimmed(chain: Untrimmed, sign: int, radius: float) -> RawOffset:
    """Return the raw offset without the parts certainly nearer to the surface than `radius`; `sign` +1 is LEFT."""
    raw = chain.raw
    # the rest of each piece: nothing if `high` is not above `low` (m,), in mm along it
    low, high = np.zeros(len(raw)), raw.lengths.copy()
    corners, meets = _mitered(chain, low, high, sign, radius)
    mitered_low, mitered_high = low.copy(), high.copy()
    _cut_inside(chain, low, high, radius)
    cut_low, cut_high = low > mitered_low, high < mitered_high
    if not len(corners) and not cut_low.any() and not cut_high.any():
        return raw
    return _rebuilt(chain, low, high, (corners, meets), cut_low, cut_high)


def _mitered(chain: Untrimmed, low: Floats, high: Floats, sign: int, radius: float) -> tuple[Rows, Points]:
    """Cut pieces off at inside corners of two lines that meet; return the rows of the first lines and the points.

    If three offset lines meet in nearly one place, the corner is left to the general rule.
    """
    raw, successor = chain.raw, chain.successor
    rows = (chain.inside & (raw.turns == 0)).nonzero()[0]
    rows = rows[raw.turns[successor[rows]] == 0]
    after = successor[rows]
    unit = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    bend = unit.conj() * (raw.end[after] - raw.start[after]) / raw.lengths[after]
    cut_length = radius * sign * bend.imag
    available = (1.0 + bend.real) * np.minimum(raw.lengths[rows], raw.lengths[after])
    within = (cut_length > 0.0) & (cut_length <= available)
    rows, after, unit = rows[within], after[within], unit[within]
    cut_length = cut_length[within] / (1.0 + bend.real[within])
    high[rows] -= cut_length
    low[after] = cut_length
    crowded = np.abs(high - low) <= CROWDED
    ambiguous = crowded[rows] | crowded[after]
    if ambiguous.any():
        high[rows[ambiguous]], low[after[ambiguous]] = raw.lengths[rows[ambiguous]], 0.0
        rows, unit, cut_length = rows[~ambiguous], unit[~ambiguous], cut_length[~ambiguous]
    return rows, raw.end[rows] - cut_length * unit


def _cut_inside(chain: Untrimmed, low: Floats, high: Floats, radius: float) -> None:
    """Cut off what lies in circles about vertices ahead and back, at growing distance until none is near."""
    limit = radius - max(_CERTAINLY_INSIDE_SHARE * radius, 2.0 * CROWDED)
    step, near = 1, limit > 0.0
    while near and step < len(chain.vertices):
        near = False
        segment = chain.raw.segment
        for rows in (segment + 1 + step, segment + chain.corner - step):
            vertices = np.minimum(np.maximum(rows, 0), len(chain.vertices) - 1)
            places = chain.vertices[vertices]
            near |= bool(((np.abs(places - chain.raw.start) < 2.0 * radius) & (vertices == rows)).any())
            _cut(chain.raw, low, high, places, limit)
        step *= 2


def _cut(raw: RawOffset, low: Floats, high: Floats, places: Points, limit: float) -> None:
    """Cut off both ends of all pieces where they are within `limit` of their spots."""
    near = (np.abs(places - raw.start) < limit + raw.lengths) & (low < high)
    for of_kind, within in ((raw.turns == 0, _within_lines), (raw.turns != 0, _within_arcs)):
        rows = (near & of_kind).nonzero()[0]
        if not len(rows):
            continue
        begin, end = within(raw, rows, places[rows], limit)
        first, last = low[rows], high[rows]
        at_low, at_high = (begin <= first) & (end > first), (end >= last) & (begin < last)
        low[rows[at_low]] = end[at_low]
        high[rows[at_high]] = begin[at_high]


def _within_lines(raw: RawOffset, rows: Rows, places: Points, limit: float) -> tuple[Floats, Floats]:
    """Return the interval along lines in which points are within `limit` of spots; NaN if there is none."""
    unit = (raw.end[rows] - raw.start[rows]) / raw.lengths[rows]
    foot = unit.conj() * (places - raw.start[rows])
    square = limit * limit - foot.imag * foot.imag
    half = np.sqrt(np.where(square > 0.0, square, np.nan))
    return foot.real - half, foot.real + half


def _within_arcs(raw: RawOffset, rows: Rows, places: Points, limit: float) -> tuple[Floats, Floats]:
    """Return the same for arcs, modulo full turns the one nearest to the arc's middle; NaN for an arc's own center."""
    arm, spokes = raw.start[rows] - raw.center[rows], places - raw.center[rows]
    radius, distance = np.abs(arm), np.abs(spokes)
    off_center, beyond = distance > JOINED, distance - radius
    # use the sine of half the angle: the cosine for a large arc differs from 1 by less than rounding
    square = (limit - beyond) * (limit + beyond) / (4.0 * radius * np.where(off_center, distance, 1.0))
    half = 2.0 * np.arcsin(np.sqrt(np.where(off_center & (square > 0.0), np.minimum(square, 1.0), np.nan)))
    middle = raw.lengths[rows] / radius / 2.0
    angle = np.angle(arm.conj() * spokes) * raw.turns[rows] - middle
    angle = angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi)) + middle
    return (angle - half) * radius, (angle + half) * radius


def _rebuilt(
    chain: Untrimmed, low: Floats, high: Floats, corners: tuple[Rows, Points], cut_low: Flags, cut_high: Flags
) -> RawOffset:
    """Shorten the raw pieces, drop those of which nothing remains, and mark their neighbors' ends as blunt."""
    raw, (rows, meets) = chain.raw, corners
    following, smooth = raw.following.copy(), raw.smooth.copy()
    following[rows], smooth[rows] = chain.successor[rows], True
    vanished = high - low <= np.where(cut_low | cut_high, JOINED, -CROWDED)
    start, end = raw.start.copy(), raw.end.copy()
    start[chain.successor[rows]], end[rows] = meets, meets
    start[cut_low] = raw.at(cut_low.nonzero()[0], low[cut_low])
    end[cut_high] = raw.at(cut_high.nonzero()[0], high[cut_high])
    joined = (following >= 0).nonzero()[0]
    after = following[joined]
    separated = vanished[joined] | cut_high[joined] | vanished[after] | cut_low[after]
    blunt_start, blunt_end = cut_low, cut_high
    blunt_end[joined[separated]], blunt_start[after[separated]] = True, True
    following[joined[separated]], smooth[joined[separated]] = -1, False
    raw = replace(raw, start=start, end=end, lengths=high - low, following=following, smooth=smooth)
    return replace(raw, blunt_start=blunt_start, blunt_end=blunt_end).take(~vanished)
