"""This module finds where lines and arcs meet, for arrays of pairs, and tells tangent and overlapping pairs apart.

Inside this module points are complex numbers: conj(u) v has the dot product as real and the cross product as imaginary
part.
"""

from __future__ import annotations

from enum import IntEnum
from math import tau
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Flags, Floats, Path, Pieces, Points, Rows, pieces_of, swept
from core.tolerance import JOINED, ON_PATH

_SECTOR_SLACK: Final = 1e-6
"""Share of the radius by which the sector test is too generous; the exact test follows it."""
_ANGLE_ROUNDING: Final = 1e-14
"""Largest rounding error of a calculated angle, radians: a few units in the last place of a full turn."""


class MeetingKind(IntEnum):
    """How two pieces meet."""

    APART = 0
    TOUCH = 1
    """They are tangent, or lie end to end in one line."""
    CROSS = 2
    """One passes through the other or ends on it, in one or two points."""
    OVERLAP = 3
    """They run along each other."""


class Meetings(NamedTuple):
    """How k pairs of pieces a, b meet, and the p points where they do.

    Points come in the order of pairs and, within a pair, as traveled on a.  A TOUCH that is nearly a CROSS may have two
    points, an OVERLAP has none.  Millimeters, measured along the pieces.
    """

    kinds: NDArray[np.int8]
    """(k,) a `MeetingKind` for each pair."""
    pair: Rows
    """(p,) the row of each point's pair."""
    along_a: Floats
    """(p,) distance of the point from the start of a."""
    along_b: Floats
    to_end_a: Floats
    """(p,) distance of the point from the end of a."""
    to_end_b: Floats
    points: Points
    """(p,)"""


def meet(first: Path, a: Rows, second: Path, b: Rows) -> Meetings:
    """Find how pieces a (k,) of `first` meet pieces b (k,) of `second`, pair by pair, by the rules of `meet_pieces`."""
    return meet_pieces(pieces_of(first), a, pieces_of(second), b)


def meet_pieces(first: Pieces, a: Rows, second: Pieces, b: Rows) -> Meetings:
    """Find how pieces a (k,) of `first` meet pieces b (k,) of `second`, pair by pair.

    A point counts if it lies on both pieces within ON_PATH.  Lines are parallel if they diverge by no more
    than ON_PATH over the longer of them; arcs are concentric if their centers are within ON_PATH; circles
    and lines within ON_PATH of tangency touch.
    """
    kinds = np.zeros(len(a), np.int8)
    arc_a, arc_b = first.turn[a].astype(np.bool_), second.turn[b].astype(np.bool_)
    line_a, line_b = ~arc_a, ~arc_b
    solvers = (
        (line_a & line_b, _lines),
        (arc_a & line_b, _arc_line),
        (line_a & arc_b, _line_arc),
        (arc_a & arc_b, _arcs),
    )
    parts = []
    for chosen, solve in solvers:
        rows = chosen.nonzero()[0]
        if len(rows):
            met = solve(first.take(a[rows]), second.take(b[rows]))
            kinds[rows] = met.kinds
            parts.append(met._replace(pair=rows[met.pair]))
    return _joined(kinds, parts)


def _joined(kinds: NDArray[np.int8], parts: list[Meetings]) -> Meetings:
    """Return the points of all parts in the order of their pairs, which have these kinds."""
    if len(parts) == 1:
        return parts[0]._replace(kinds=kinds)
    if not parts:
        none = np.empty(0)
        return Meetings(kinds, np.empty(0, np.intp), none, none, none, none, np.empty(0, np.complex128))
    _, pair, *columns = (np.concatenate(column) for column in zip(*parts, strict=True))
    order = np.argsort(pair, kind="stable")
    return Meetings(kinds, pair[order], *(column[order] for column in columns))


def _lines(a: Pieces, b: Pieces) -> Meetings:
    """Meet lines with lines: solve a.start + s (a.end - a.start) = b.start + t (b.end - b.start) by cross products."""
    span_a, span_b, between = a.end - a.start, b.end - b.start, b.start - a.start
    length_a, length_b = np.abs(span_a), np.abs(span_b)
    cross = (span_a.conj() * span_b).imag
    parallel = np.abs(cross) <= ON_PATH * np.minimum(length_a, length_b)
    divisor = np.where(parallel, 1.0, cross)
    part = (between.conj() * span_b).imag / divisor
    along_a, along_b = part * length_a, (between.conj() * span_a).imag / divisor * length_b
    on = (_within(along_a, length_a) & _within(along_b, length_b) & ~parallel).nonzero()[0]
    to_ends = (length_a - along_a)[on], (length_b - along_b)[on]
    kinds = np.zeros(len(cross), np.int8)
    kinds[on] = MeetingKind.CROSS.value
    met = Meetings(kinds, on, along_a[on], along_b[on], *to_ends, (a.start + part * span_a)[on])
    rows = (parallel & (length_a > 0.0) & (length_b > 0.0)).nonzero()[0]
    if not len(rows):
        return met
    touches = _parallel(a.take(rows), b.take(rows))
    kinds[rows] = touches.kinds
    return _joined(kinds, [met, touches._replace(pair=rows[touches.pair])])


def _parallel(a: Pieces, b: Pieces) -> Meetings:
    """Meet parallel lines: those in one line overlap, or touch end to end."""
    span, other = a.end - a.start, b.end - b.start
    length = np.abs(span)
    unit = span / length
    first, last = unit.conj() * (b.start - a.start), unit.conj() * (b.end - a.start)
    low = np.maximum(np.minimum(first.real, last.real), 0.0)
    common = np.minimum(np.maximum(first.real, last.real), length) - low
    in_line = np.minimum(np.abs(first.imag), np.abs(last.imag)) <= ON_PATH
    touch = (in_line & (np.abs(common) <= ON_PATH)).nonzero()[0]
    kinds = np.where(in_line & (common > ON_PATH), MeetingKind.OVERLAP.value, MeetingKind.APART.value).astype(np.int8)
    kinds[touch] = MeetingKind.TOUCH.value
    along_a, along_b = low[touch], np.abs(low - first.real)[touch]
    to_ends = length[touch] - along_a, np.abs(other[touch]) - along_b
    return Meetings(kinds, touch, along_a, along_b, *to_ends, (a.start + low * unit)[touch])


def _line_arc(line: Pieces, arc: Pieces) -> Meetings:
    """Meet lines with arcs: half the chord on either side of the foot of the arc's center."""
    span, radius = line.end - line.start, np.abs(arc.start - arc.center)
    length = np.abs(span)
    unit = span / np.where(length == 0.0, 1.0, length)
    foot = unit.conj() * (arc.center - line.start)
    height = np.abs(foot.imag)
    overlap = radius - height
    pair, half = _half_chords(np.sqrt(np.maximum(overlap * (radius + height), 0.0)), overlap)
    along = foot.real[pair] + half
    on = _within(along, length[pair]).nonzero()[0]
    pair, along = pair[on], along[on]
    points = line.start[pair] + along * unit[pair]
    near = _in_sector(points, arc.take(pair)).nonzero()[0]
    pair, along, points = pair[near], along[near], points[near]
    from_start, to_end = _along_arc(points, arc.take(pair), radius[pair])
    return _on_both(overlap, pair, along, from_start, length[pair] - along, to_end, points)


def _arc_line(arc: Pieces, line: Pieces) -> Meetings:
    kinds, pair, along_line, along_arc, to_line_end, to_arc_end, points = _line_arc(line, arc)
    return _as_traveled(Meetings(kinds, pair, along_arc, along_line, to_arc_end, to_line_end, points))


def _arcs(a: Pieces, b: Pieces) -> Meetings:
    """Meet arcs with arcs: half the common chord by Heron's formula, which stays accurate near tangency."""
    between, big, small = b.center - a.center, np.abs(a.start - a.center), np.abs(b.start - b.center)
    distance, total, difference = np.abs(between), big + small, big - small
    concentric = distance <= ON_PATH
    divisor = np.where(concentric, 1.0, distance)
    area = (total + distance) * (total - distance) * (distance + difference) * (distance - difference)
    overlap = np.where(concentric, -np.inf, np.minimum(total - distance, distance - np.abs(difference)))
    pair, half = _half_chords(np.sqrt(np.maximum(area, 0.0)) / (2.0 * divisor), overlap)
    foot = (distance + difference * total / divisor) / 2.0
    points = a.center[pair] + (between / divisor)[pair] * (foot[pair] + 1j * half)
    near = _in_sector(points, a.take(pair)).nonzero()[0]
    near = near[_in_sector(points[near], b.take(pair[near]))]
    pair, points = pair[near], points[near]
    along_a, to_end_a = _along_arc(points, a.take(pair), big[pair])
    along_b, to_end_b = _along_arc(points, b.take(pair), small[pair])
    met = _as_traveled(_on_both(overlap, pair, along_a, along_b, to_end_a, to_end_b, points))
    rows = (concentric & (np.abs(difference) <= ON_PATH)).nonzero()[0]
    if len(rows):
        met.kinds[rows[_overlap(a.take(rows), b.take(rows))]] = MeetingKind.OVERLAP.value
    return met


def _in_sector(point: Points, arc: Pieces) -> Flags:
    """True for points that may lie on their arc: between the rays to its ends by cross products, with some slack.

    For an arc of half a turn or more, or with ends that are nearly one point, it is enough to be past either ray.
    """
    first, last, radial = arc.start - arc.center, arc.end - arc.center, point - arc.center
    slack = _SECTOR_SLACK * np.maximum(np.abs(first), 1.0)
    after_first = (first.conj() * radial).imag * arc.turn >= -slack
    before_last = (radial.conj() * last).imag * arc.turn >= -slack
    minor = (first.conj() * last).imag * arc.turn > slack
    return np.where(minor, after_first & before_last, after_first | before_last)


def _half_chords(half: Floats, overlap: Floats) -> tuple[Rows, Floats]:
    """Return the pairs with a common chord, each twice in a row, and the signed halves of it, the negative one first.

    Halves no longer than JOINED make one point, the foot between them: that pair comes once, with 0.  `overlap` is how
    far the pair overlaps beyond tangency; below -ON_PATH there is no chord.
    """
    rows = (overlap >= -ON_PATH).nonzero()[0]
    pair = np.repeat(rows, np.where(half[rows] > JOINED, 2, 1))
    signed = np.where(half[pair] > JOINED, half[pair], 0.0)
    signed[:-1] *= np.where(pair[1:] == pair[:-1], -1.0, 1.0)
    return pair, signed


def _overlap(a: Pieces, b: Pieces) -> Flags:
    """True if arcs of one circle share more than their ends."""
    return _inside(a, _middle(b)) | _inside(b, _middle(a)) | _inside(a, b.start) | _inside(a, b.end)


def _middle(arc: Pieces) -> Points:
    """Return the point halfway along each arc."""
    middle: Points = arc.center + (arc.start - arc.center) * np.exp(1j * swept(arc) / 2.0 * arc.turn)
    return middle


def _inside(arc: Pieces, point: Points) -> Flags:
    """True if a point of the arc's circle is on the arc, off its ends.  The angle's rounding scales with the radius."""
    radius = np.abs(arc.start - arc.center)
    from_start, to_end = _along_arc(point, arc, radius)
    slack = np.maximum(ON_PATH, _ANGLE_ROUNDING * radius)
    return (from_start > slack) & (to_end > slack)


def _turned(arc: Pieces, point: Points) -> Floats:
    """Return the angle from the arc's start to a point, in the arc's direction, 0 ... a full turn."""
    across = (arc.start - arc.center).conj() * (point - arc.center)
    angle = np.arctan2(across.imag, across.real) * arc.turn
    return np.where(angle < 0.0, angle + tau, angle)


def _along_arc(point: Points, arc: Pieces, radius: Floats) -> tuple[Floats, Floats]:
    """Return the distance on each arc from its start to a point of its circle, and from there to its end.

    A point off the arc counts from the nearer end: the first distance is negative before the start, the second one
    past the end.
    """
    from_start, length, full_turn = _turned(arc, point) * radius, swept(arc) * radius, tau * radius
    from_start = np.where(
        (from_start > length) & (full_turn - from_start < from_start - length), from_start - full_turn, from_start
    )
    return from_start, length - from_start


def _within(along: Floats, length: Floats) -> Flags:
    return (along >= -ON_PATH) & (along <= length + ON_PATH)


def _on_both(overlap: Floats, pair: Rows, *columns: NDArray[Any]) -> Meetings:
    """Return the points on both pieces; pairs that `overlap` (k,) by no more than ON_PATH touch, others cross."""
    along_a, along_b, to_end_a, to_end_b, _ = columns
    on = np.minimum(np.minimum(along_a, along_b), np.minimum(to_end_a, to_end_b)) >= -ON_PATH
    kinds, pair = np.zeros(len(overlap), np.int8), pair[on]
    kinds[pair] = np.where(np.abs(overlap[pair]) <= ON_PATH, MeetingKind.TOUCH.value, MeetingKind.CROSS.value)
    return Meetings(kinds, pair, *(column[on] for column in columns))


def _as_traveled(met: Meetings) -> Meetings:
    """Put the two points of a pair in the order in which a is traveled."""
    pair, along = met.pair, met.along_a
    swap = ((pair[1:] == pair[:-1]) & (along[1:] < along[:-1])).nonzero()[0]
    for column in met[2:]:
        column[swap], column[swap + 1] = column[swap + 1], column[swap]
    return met
