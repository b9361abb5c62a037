"""Where lines and arcs meet: many pairs of pieces at once, tangent and overlapping cases told apart.

Words: a pair meets CROSS where one piece passes through the other (one or two points), TOUCH where they
are tangent or only end on one another along one line, OVERLAP where they run along each other, APART else.
A point's `along` is its distance from the piece's start, measured on the piece.  Inside this module points
are complex numbers: conj(u) v has the dot product as real and the cross product as imaginary part.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from math import tau
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Floats, Path, Turns
from core.geometry.piece import SLIVER
from core.tolerance import ON_PATH

Indices = NDArray[np.intp]
Planes = NDArray[np.complex128]
Masks = NDArray[np.bool_]


class Meeting(IntEnum):
    """How two pieces meet."""

    APART = 0
    TOUCH = 1
    CROSS = 2
    OVERLAP = 3


@dataclass(frozen=True, eq=False, slots=True)
class Meetings:
    """How k pairs of pieces a, b meet, and the p points where they do.

    `kinds` (k,) holds a `Meeting` for each pair.  `pair` (p,) is the row of each point's pair, `along_a` and
    `along_b` (p,) its distance from the start of either piece, `rest_a` and `rest_b` (p,) that from their ends,
    `points` (p, 2) the point.  Points come in the order of pairs and, within a pair, as travelled on a; a
    touch within rounding of a crossing may have two.  Millimetres.  An OVERLAP has no points.
    """

    kinds: NDArray[np.int8]
    pair: Indices
    along_a: Floats
    along_b: Floats
    rest_a: Floats
    rest_b: Floats
    points: Floats


class _Pieces(NamedTuple):
    """k pieces of one kind: ends and centres as complex numbers."""

    start: Planes
    end: Planes
    centre: Planes
    turn: Turns


class _Found(NamedTuple):
    """Pairs of one combination of kinds: (k, c) points and their distances from the ends, `along_a` NaN where none."""

    kinds: NDArray[np.int8]
    along_a: Floats
    along_b: Floats
    rest_a: Floats
    rest_b: Floats
    points: Planes


class _Flat(NamedTuple):
    """Points of several pairs, one below the other: `Meetings` without its kinds."""

    pair: Indices
    along_a: Floats
    along_b: Floats
    rest_a: Floats
    rest_b: Floats
    points: Planes


_SIDES: Final = np.array([-1.0, 1.0])


def planes(pairs: Floats) -> Planes:
    """(n, 2) coordinates as (n,) complex numbers, without a copy where they lie together in memory."""
    flat: Planes = np.ascontiguousarray(pairs).view(np.complex128)[:, 0]
    return flat


def coordinates(points: Planes) -> Floats:
    """(n,) complex numbers as (n, 2) coordinates, without a copy where they lie together in memory."""
    return np.ascontiguousarray(points).view(np.float64).reshape(-1, 2)


def meet(one: Path, a: Indices, other: Path, b: Indices) -> Meetings:
    """How pieces a (k,) of `one` meet pieces b (k,) of `other`, pair by pair.

    A point counts when it lies on both pieces within ON_PATH.  Lines are parallel when they part by no more
    than ON_PATH over the longer of them; arcs are concentric when their centres are within ON_PATH; circles
    and lines within ON_PATH of tangency touch.
    """
    kinds = np.zeros(len(a), np.int8)
    combination = (one.turns[a] != 0) + 2 * (other.turns[b] != 0)
    parts = []
    for which, solve in enumerate((_lines, _arc_line, _line_arc, _arcs)):
        rows = np.flatnonzero(combination == which)
        if len(rows):
            found = solve(_gather(one, a[rows]), _gather(other, b[rows]))
            kinds[rows] = found.kinds
            parts.append(_flat(rows, found))
    return _merged(kinds, parts)


def _gather(path: Path, rows: Indices) -> _Pieces:
    points = planes(path.points)
    return _Pieces(points[rows], points[rows + 1], planes(path.centres)[rows], path.turns[rows])


def _flat(rows: Indices, found: _Found) -> _Flat:
    pair, column = np.nonzero(found.along_a == found.along_a)
    at = (pair, column)
    rests = found.rest_a[at], found.rest_b[at]
    return _Flat(rows[pair], found.along_a[at], found.along_b[at], *rests, found.points[at])


def _merged(kinds: NDArray[np.int8], parts: list[_Flat]) -> Meetings:
    if not parts:
        none = np.empty(0)
        return Meetings(kinds, np.empty(0, np.intp), none, none, none, none, np.empty((0, 2)))
    flat = parts[0]
    if len(parts) > 1:
        order = np.argsort(np.concatenate([part.pair for part in parts]), kind="stable")
        flat = _Flat._make(np.concatenate(column)[order] for column in zip(*parts, strict=True))
    return Meetings(kinds, *flat[:-1], coordinates(flat.points))


def _lines(a: _Pieces, b: _Pieces) -> _Found:
    """Line with line: a.start + s (a.end - a.start) = b.start + t (b.end - b.start) by cross products."""
    span_a, span_b, between = a.end - a.start, b.end - b.start, b.start - a.start
    length_a, length_b = np.abs(span_a), np.abs(span_b)
    cross = (span_a.conj() * span_b).imag
    parallel = np.abs(cross) <= ON_PATH * np.minimum(length_a, length_b)
    divisor = np.where(parallel, 1.0, cross)
    part_a = (between.conj() * span_b).imag / divisor
    along_a = part_a * length_a
    along_b = (between.conj() * span_a).imag / divisor * length_b
    on = _within(along_a, length_a) & _within(along_b, length_b) & ~parallel
    along_a = np.where(on, along_a, np.nan)
    found = _Found(
        np.where(on, Meeting.CROSS.value, Meeting.APART.value).astype(np.int8),
        along_a[:, None],
        along_b[:, None],
        (length_a - along_a)[:, None],
        (length_b - along_b)[:, None],
        (a.start + part_a * span_a)[:, None],
    )
    rows = np.flatnonzero(parallel & (length_a > 0.0) & (length_b > 0.0))
    if len(rows):
        _collinear(found, rows, a, b)
    return found


def _collinear(found: _Found, rows: Indices, a: _Pieces, b: _Pieces) -> None:
    """Mark what parallel lines do that lie in one line: overlap, or touch end to end."""
    start, span, length = a.start[rows], a.end[rows] - a.start[rows], np.abs(a.end[rows] - a.start[rows])
    unit = (span / length).conj()
    first, last = unit * (b.start[rows] - start), unit * (b.end[rows] - start)
    low = np.maximum(np.minimum(first.real, last.real), 0.0)
    common = np.minimum(np.maximum(first.real, last.real), length) - low
    in_line = np.minimum(np.abs(first.imag), np.abs(last.imag)) <= ON_PATH
    found.kinds[rows[in_line & (common > ON_PATH)]] = Meeting.OVERLAP
    touch = in_line & (np.abs(common) <= ON_PATH)
    at, low, first = rows[touch], low[touch], first[touch]
    found.kinds[at] = Meeting.TOUCH
    found.along_a[at, 0] = low
    found.along_b[at, 0] = np.abs(low - first.real)
    found.rest_a[at, 0] = length[touch] - low
    found.rest_b[at, 0] = np.abs(low - last.real[touch])
    found.points[at, 0] = start[touch] + low * unit[touch].conj()


def _line_arc(line: _Pieces, arc: _Pieces) -> _Found:
    """Line with arc: half the chord on either side of the foot of the arc's centre."""
    span, radius = line.end - line.start, np.abs(arc.start - arc.centre)
    length = np.abs(span)
    unit = span / np.where(length == 0.0, 1.0, length)
    foot = unit.conj() * (arc.centre - line.start)
    height = np.abs(foot.imag)
    inside = radius - height
    half = np.sqrt(np.maximum(inside * (radius + height), 0.0))
    along = foot.real[:, None] + half[:, None] * _SIDES
    points = line.start[:, None] + along * unit[:, None]
    run, swept = _along_arc(points, arc, radius)
    on = _within(along, length[:, None]) & _within(run, swept) & (inside >= -ON_PATH)[:, None]
    on[:, 1] &= half > 0.0
    kinds = _kinds(on, np.abs(inside) <= ON_PATH)
    return _Found(kinds, np.where(on, along, np.nan), run, length[:, None] - along, swept - run, points)


def _arc_line(arc: _Pieces, line: _Pieces) -> _Found:
    kinds, along, run, rest, left, points = _line_arc(line, arc)
    run = np.where(np.isnan(along), np.nan, run)
    return _as_travelled(_Found(kinds, run, along, left, rest, points))


def _arcs(a: _Pieces, b: _Pieces) -> _Found:
    """Arc with arc: half the common chord by Heron's formula, which keeps its digits near tangency."""
    between, big, small = b.centre - a.centre, np.abs(a.start - a.centre), np.abs(b.start - b.centre)
    apart, total, differ = np.abs(between), big + small, big - small
    concentric = apart <= ON_PATH
    divisor = np.where(concentric, 1.0, apart)
    area = (total + apart) * (total - apart) * (apart + differ) * (apart - differ)
    half = np.sqrt(np.maximum(area, 0.0)) / (2.0 * divisor)
    foot = (apart + differ * total / divisor) / 2.0
    points = a.centre[:, None] + (between / divisor)[:, None] * (foot[:, None] + 1j * half[:, None] * _SIDES)
    run_a, swept_a = _along_arc(points, a, big)
    run_b, swept_b = _along_arc(points, b, small)
    reach = np.where(concentric, -np.inf, np.minimum(total - apart, apart - np.abs(differ)))
    on = _within(run_a, swept_a) & _within(run_b, swept_b) & (reach >= -ON_PATH)[:, None]
    on[:, 1] &= half > 0.0
    kinds = _kinds(on, np.abs(reach) <= ON_PATH)
    rows = np.flatnonzero(concentric & (np.abs(differ) <= ON_PATH))
    if len(rows):
        kinds[rows] = _concentric(a, b, rows)
    run_a = np.where(on, run_a, np.nan)
    return _as_travelled(_Found(kinds, run_a, run_b, swept_a - run_a, swept_b - run_b, points))


def _concentric(a: _Pieces, b: _Pieces, rows: Indices) -> NDArray[np.int8]:
    """Do arcs of one circle share more than their ends: does either start, or a's middle, lie inside the other?"""
    a, b = (_Pieces._make(column[rows] for column in piece) for piece in (a, b))
    radius = np.abs(a.start - a.centre)
    inside = _inside(a, _middle(b)) | _inside(b, _middle(a)) | _inside(a, b.start) | _inside(a, b.end)
    return np.where(inside & (radius > 0.0), Meeting.OVERLAP.value, Meeting.APART.value).astype(np.int8)


def _middle(arc: _Pieces) -> Planes:
    """The point half way along each arc."""
    half = _sweep(arc) / 2.0 * arc.turn
    middle: Planes = arc.centre + (arc.start - arc.centre) * np.exp(1j * half)
    return middle


def _inside(arc: _Pieces, point: Planes) -> Masks:
    """Does a point of the arc's circle lie on the arc, off its ends?"""
    run, swept = _along_arc(point[:, None], arc, np.abs(arc.start - arc.centre))
    return ((run > ON_PATH) & (run < swept - ON_PATH))[:, 0]


def _sweep(arc: _Pieces) -> Floats:
    """Angle travelled, 0 ... a full turn: equal ends are the full circle, rounding past the start is nothing."""
    swept = np.mod(np.angle((arc.start - arc.centre).conj() * (arc.end - arc.centre)) * arc.turn, tau)
    swept[swept > tau - SLIVER] = 0.0
    swept[arc.start == arc.end] = tau
    return swept


def _along_arc(points: Planes, arc: _Pieces, radius: Floats) -> tuple[Floats, Floats]:
    """Distance on each arc from its start to points (k, c) of its circle, and the arc's length (k, 1).

    A point off the arc gets the nearer end's side: below 0 before the start, above the length behind the end.
    """
    radial = (arc.start - arc.centre).conj()[:, None] * (points - arc.centre[:, None])
    run = np.mod(np.angle(radial) * arc.turn[:, None], tau) * radius[:, None]
    swept, whole = (_sweep(arc) * radius)[:, None], (tau * radius)[:, None]
    beyond = run - swept
    return np.where((beyond > 0.0) & (whole - run < beyond), run - whole, run), swept


def _within(along: Floats, length: Floats) -> Masks:
    return (along >= -ON_PATH) & (along <= length + ON_PATH)


def _kinds(on: Masks, touching: Masks) -> NDArray[np.int8]:
    met = np.where(touching, Meeting.TOUCH.value, Meeting.CROSS.value)
    return np.where(on.any(axis=1), met, Meeting.APART.value).astype(np.int8)


def _as_travelled(found: _Found) -> _Found:
    """Put two points of a pair in the order in which a is travelled."""
    rows = np.flatnonzero(found.along_a[:, 0] > found.along_a[:, 1])
    for column in found[1:]:
        column[rows] = column[rows, ::-1]
    return found
