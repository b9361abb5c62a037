"""Touch: how near the pieces of each pair come to each other, and where the one is within the radius of the other.

Nearly all pairs of a path and its surface either touch at the radius exactly, all along or in one point, or not at
all; both are seen from their ends.  The few others are told, and are left to `reach`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import tau
from typing import Final, NamedTuple

import numpy as np

from core.geometry.distance import foot
from core.geometry.path import Flags, Floats, Rows
from core.geometry.piece_arrays import PieceArrays
from core.tolerance import ON_PATH, STOCK
from core.verify.columns import (
    CENTER,
    STRAIGHT,
    Columns,
    arc_middle,
    arc_to_arc,
    line_middle,
    line_to_arc,
    lines_cross,
    to_arc,
    to_line,
)
from core.verify.course import Course

BLOCK: Final = 4_000
"""Pairs worked out at a time: few enough to stay in a processor's cache."""

POINT: Final = 1e-6
"""Millimeters of surface that count as one point."""

NONE: Final = 2.0
"""A fraction that lies on no piece."""


@dataclass(frozen=True, eq=False, slots=True)
class Touches:
    """(m,) least distance of each pair, and what of its surface piece is within the limit of its center piece.

    `middle` is the distance of the center piece's middle, `along` whether that and its ends are within STOCK.

    The part from `first` to `last`, fractions, is within for sure, none where `first` > `last`; it is all there is
    unless the pair is `unsure`.
    """

    apart: Floats
    first: Floats
    last: Floats
    unsure: Flags
    middle: Floats
    along: Flags

    def take(self, rows: Rows) -> Touches:
        """The pairs of these indices."""
        columns = self.apart[rows], self.first[rows], self.last[rows], self.unsure[rows]
        return Touches(*columns, self.middle[rows], self.along[rows])


class _Group(NamedTuple):
    """The lines of a block's pairs, or the arcs: their columns (5 or 15, n), and x and y of their starts, ends and
    middles, `spots` (2, 3, n).

    First stand the `mixed` of the center path whose partners are of the other kind; then the `alike` whose partners are
    of this kind, then these partners, in the same order; and last the partners of the other kind's first ones.
    """

    columns: Floats
    spots: Floats
    mixed: int
    alike: int

    @property
    def parts(self) -> tuple[slice, slice, slice, slice]:
        """The four, in this order."""
        partners = self.mixed + self.alike
        last = partners + self.alike
        return slice(self.mixed), slice(self.mixed, partners), slice(partners, last), slice(last, None)


class _Block(NamedTuple):
    """m pairs worked out at once: first those of a line and an arc, then of two lines, an arc and a line, two arcs.

    `bent` (2, m) are the pieces, of the center path and of the surface, that are arcs.
    """

    i: Rows
    j: Rows
    bent: Flags
    lines: _Group
    arcs: _Group


def touches(center: Course, i: Rows, surface: Course, j: Rows, radius: float, grant: Floats) -> Touches:
    """The pairs of pieces `i` of the center path and `j` of the surface, measured, and their touch.

    What is within the radius and `grant` (m,) touches; a pair nearer than the radius less its grant is unsure.
    """
    limit = radius + grant
    found = _blank(len(i))
    for rows, block in _blocks(center, i, surface, j):
        within, places = _measure(found, rows, block, limit[rows])
        first, last = _hull(within, places, block, center.pieces, surface.pieces)
        found.first[rows], found.last[rows] = first, last
        found.unsure[rows] = _unsure(last - first, block, center.pieces, surface.pieces)
    np.logical_or(found.unsure, found.apart < radius - grant, out=found.unsure)
    return found


def _blank(count: int) -> Touches:
    flags = np.zeros((2, count), np.bool_)
    apart, first, last, middle = np.empty((4, count))
    return Touches(apart, first, last, flags[0], middle, flags[1])


def _blocks(center: Course, i: Rows, surface: Course, j: Rows) -> Iterator[tuple[Rows, _Block]]:
    """Indices of pairs, in the order of their kinds, at most BLOCK at a time: each formula is asked for its own pieces
    alone, and what it yields is put together from slices."""
    bent = np.array((center.pieces.arcs.take(i), surface.pieces.arcs.take(j)))
    other = bent[1].view(np.int8)
    kinds = np.where(bent[0], 2 + other, 1 - other)
    order = kinds.argsort(kind="stable")
    for start in range(0, len(i), BLOCK):
        rows = order[start : start + BLOCK]
        some_i, some_j = i.take(rows), j.take(rows)
        counts = np.bincount(kinds.take(rows), minlength=4).tolist()
        yield rows, _Block(some_i, some_j, bent.take(rows, axis=1), *_groups(center, some_i, surface, some_j, *counts))


def _groups(
    center: Course, i: Rows, surface: Course, j: Rows, line_arc: int, lines: int, arc_line: int, arcs: int
) -> tuple[_Group, _Group]:
    """The lines and the arcs of a block's pairs, of which there are so many of each kind."""
    bent, both = line_arc + lines, line_arc + lines + arc_line
    straight = _columns(center, i[:bent], surface, j[line_arc:both], STRAIGHT)
    curved = _columns(center, i[bent:], surface, np.concatenate((j[both:], j[:line_arc])), len(Columns._fields))
    line, arc = Columns(*straight), Columns(*curved)
    return (
        _Group(straight, _spots(line, *line_middle(line)), line_arc, lines),
        _Group(curved, _spots(arc, *arc_middle(arc)), arc_line, arcs),
    )


def _columns(center: Course, i: Rows, surface: Course, j: Rows, count: int) -> Floats:
    """So many columns of pieces `i` of the center path and then of `j` of the surface; without arcs a path has few."""
    found = np.empty((count, len(i) + len(j)))
    if len(i):
        found[:, : len(i)] = center.columns_at(i, count)
    if len(j):
        found[:, len(i) :] = surface.columns_at(j, count)
    return found


def _spots(pieces: Columns, x: Floats, y: Floats) -> Floats:
    """Starts, ends and the middles."""
    return np.array(((pieces.x, pieces.x + pieces.along, x), (pieces.y, pieces.y + pieces.up, y)))


def _measure(found: Touches, rows: Rows, block: _Block, limit: Floats) -> tuple[Flags, Floats]:
    """Distances of the pairs; (4, m) whether the surface pieces' ends and the center pieces' ends, start and end of
    each, are within the limit of the other piece; and (4, m) fractions of surface lines nearest to these."""
    mine, theirs, nearest = _to_ends(block)
    ends, places = np.concatenate((theirs[:2], mine[:2])), np.zeros((4, len(limit)))
    places[1] = 1.0
    places[2:, block.lines.mixed : block.lines.mixed + nearest.shape[1]] = nearest
    found.middle[rows] = mine[2]
    found.along[rows] = mine.max(axis=0) <= limit + STOCK
    found.apart[rows] = np.minimum(ends.min(axis=0), _between_ends(block))
    return ends <= limit, places


def _to_ends(block: _Block) -> tuple[Floats, Floats, Floats]:
    """(3, m) distances of the center pieces' starts, ends and middles from the surface pieces, and the same the other
    way round; and (2, k) fractions of the k surface lines nearest to the center pieces' starts and ends."""
    lines, arcs = block.lines, block.arcs
    square, t = to_line(*_partners(lines, arcs), Columns(*lines.columns))
    apart, own = np.sqrt(square, out=square), lines.mixed + lines.alike
    if not arcs.columns.size:
        return apart[:, own:], apart[:, :own], t[:2, own:]
    bent = to_arc(*_partners(arcs, lines), Columns(*arcs.columns))
    _, _, alike, mixed = arcs.parts
    mine = np.concatenate((bent[:, mixed], apart[:, own:], bent[:, alike]), axis=1)
    theirs = np.concatenate((apart[:, :own], bent[:, : arcs.mixed + arcs.alike]), axis=1)
    return mine, theirs, t[:2, own:]


def _partners(group: _Group, other: _Group) -> tuple[Floats, Floats]:
    """x and y (3, n) of the spots of each one's partner, some of which are of the `other` kind."""
    _, mine, theirs, _ = group.parts
    first, _, _, last = other.parts
    x, y = np.concatenate(
        (other.spots[..., last], group.spots[..., theirs], group.spots[..., mine], other.spots[..., first]), axis=2
    )
    return x, y


def _between_ends(block: _Block) -> Floats:
    """Least distances that lie between the ends of both pieces; infinite where there is none."""
    lines, arcs = block.lines, block.arcs
    straight = lines.mixed + lines.alike
    bent = len(block.i) - arcs.alike
    apart = np.empty(len(block.i))
    if lines.alike:
        _, one, other, _ = lines.parts
        apart[one] = lines_cross(lines.columns[:, one], lines.columns[:, other])
    if arcs.alike:
        pairs = arcs.columns[:, arcs.mixed : arcs.mixed + 2 * arcs.alike]
        apart[bent:] = arc_to_arc(pairs.reshape(len(pairs), 2, arcs.alike))
    if lines.mixed + arcs.mixed:
        line = np.concatenate([lines.columns[:, part] for part in lines.parts[::3]], axis=1)
        arc = np.concatenate([arcs.columns[:, part] for part in arcs.parts[::-3]], axis=1)
        passed = line_to_arc(line, arc)
        apart[: lines.mixed], apart[straight:bent] = passed[: lines.mixed], passed[lines.mixed :]
    return apart


def _hull(
    within: Flags, places: Floats, block: _Block, center: PieceArrays, surface: PieceArrays
) -> tuple[Floats, Floats]:
    """First and last fraction of a surface piece that is one of the ends within the limit.

    The distance from a line is convex along another: what lies between is within too.  On arcs the feet are looked for
    of those ends only that are not beside an end of the arc.
    """
    if block.bent[1].any():
        within[2:] &= ~(within[0] & within[1])
        end, row = (within[2:] & block.bent[1]).nonzero()
        if len(row):
            i, j = block.i[row], block.j[row]
            places[end + 2, row] = foot(surface.take(j), center.start.take(i) + end * center.vector.take(i))
    first: Floats = np.where(within, places, NONE).min(axis=0)
    last: Floats = np.where(within, places, -NONE).max(axis=0)
    return first, last


def _unsure(share: Floats, block: _Block, center: PieceArrays, surface: PieceArrays) -> Flags:
    """Touches with arcs that are more than a point, such a `share` of the surface piece, unless both arcs are about one
    center and overlap but once."""
    unsure: Flags = block.bent[0] | block.bent[1]
    if not unsure.any():
        return unsure
    unsure &= share * surface.length.take(block.j) > POINT
    _, mine, theirs, _ = block.arcs.parts
    one, other, begin = block.arcs.columns[:, mine], block.arcs.columns[:, theirs], len(unsure) - block.arcs.alike
    both = unsure[begin:].nonzero()[0]
    if len(both):
        both = both[np.hypot(*(one[CENTER].take(both, axis=1) - other[CENTER].take(both, axis=1))) <= ON_PATH]
        angles = center.angle[block.i[begin + both]] + surface.angle[block.j[begin + both]]
        unsure[begin + both] = _meet_twice(one.take(both, axis=1), other.take(both, axis=1), angles)
    return unsure


def _meet_twice(arcs: Floats, others: Floats, angles: Floats) -> Flags:
    """Pairs of arcs about one center, of so many radians together, that may overlap at both ends: the directions of
    their middles are no farther apart than half a turn."""
    twice: Flags = angles >= tau - 2.0 * POINT
    some = twice.nonzero()[0]
    if len(some):
        one, other = Columns(*arcs[:, some]), Columns(*others[:, some])
        cross = one.middle_x * other.middle_y - one.middle_y * other.middle_x
        dot = one.middle_x * other.middle_x + one.middle_y * other.middle_y
        twice[some] = angles[some] / 2.0 + np.arctan2(np.abs(cross), dot) >= tau - POINT
    return twice
