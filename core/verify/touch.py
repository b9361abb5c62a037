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
from numpy.typing import NDArray

from core.geometry.distance import foot
from core.geometry.measured import Flags, Floats, Measured, Rows
from core.tolerance import ON_PATH, STOCK
from core.verify.columns import STRAIGHT, Columns, arc_to_arc, line_to_arc, lines_cross, middle, taken, to_piece
from core.verify.course import Course

FEW: Final = 1_000
"""Pairs of which measuring all in one go, by the formulas of lines and of arcs, costs less than parting them."""

BLOCK: Final = 4_000
"""Pairs worked out at a time: few enough to stay in a processor's cache."""

POINT: Final = 1e-6
"""Millimetres of surface that count as one point."""

NONE: Final = 2.0
"""A fraction that lies on no piece."""


@dataclass(frozen=True, eq=False, slots=True)
class Touches:
    """(m,) least distance of each pair, and what of its surface piece is within the limit of its centre piece.

    `middle` is the distance of the centre piece's middle, `along` whether that and its ends are within STOCK.

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


class _Block(NamedTuple):
    """m pairs worked out at once: their pieces, their columns, and which of them are arcs."""

    i: Rows
    j: Rows
    one: Floats
    other: Floats
    bent_one: Flags
    bent_other: Flags


def touches(centre: Course, i: Rows, surface: Course, j: Rows, radius: float, grant: Floats) -> Touches:
    """The pairs of pieces `i` of the centre path and `j` of the surface, measured, and their touch.

    What is within the radius and `grant` (m,) touches; a pair nearer than the radius less its grant is unsure.
    """
    limit = radius + grant
    found = _blank(len(i))
    bent_one, bent_other = centre.pieces.arcs[i], surface.pieces.arcs[j]
    for rows in _blocks(bent_one, bent_other):
        bent = bent_one[rows], bent_other[rows]
        columns = taken(centre.columns, i[rows], bent[0]), taken(surface.columns, j[rows], bent[1])
        block = _Block(i[rows], j[rows], *columns, *bent)
        within, places = _measure(found, rows, block, limit[rows])
        found.first[rows], found.last[rows] = _hull(within, places, block, centre.pieces, surface.pieces)
        found.unsure[rows] = _unsure(found, rows, block, centre.pieces, surface.pieces)
    np.logical_or(found.unsure, found.apart < radius - grant, out=found.unsure)
    return found


def _blank(count: int) -> Touches:
    flags = np.zeros((2, count), np.bool_)
    apart, first, last, middle = np.empty((4, count))
    return Touches(apart, first, last, flags[0], middle, flags[1])


def _blocks(one: Flags, other: Flags) -> Iterator[Rows | slice]:
    """Indices of pairs, parted by which of the two pieces are arcs, at most BLOCK at a time; few pairs all at once."""
    if len(one) <= FEW:
        yield slice(None)
        return
    kinds = _kinds(one, other)
    for kind in range(4):
        rows = (kinds == kind).nonzero()[0]
        for start in range(0, len(rows), BLOCK):
            yield rows[start : start + BLOCK]


def _kinds(one: Flags, other: Flags) -> NDArray[np.int8]:
    """(m,) 0 for two lines, 1 for a line and an arc, 2 for an arc and a line, 3 for two arcs."""
    kinds: NDArray[np.int8] = 2 * one.view(np.int8) + other.view(np.int8)
    return kinds


def _measure(found: Touches, rows: Rows | slice, block: _Block, limit: Floats) -> tuple[Flags, Floats]:
    """Distances of the pairs; (4, m) whether the surface pieces' ends and the centre pieces' ends, start and end of
    each, are within the limit of the other piece; and (4, m) fractions of surface lines nearest to these."""
    a, b = Columns(*block.one), Columns(*block.other)
    middle_x, middle_y = middle(a, block.bent_one)
    x, y = np.array((a.x, a.x + a.along, middle_x)), np.array((a.y, a.y + a.up, middle_y))
    mine, nearest = to_piece(x, y, b, block.bent_other)
    x, y = np.array((b.x, b.x + b.along)), np.array((b.y, b.y + b.up))
    theirs, _ = to_piece(x, y, a, block.bent_one)
    ends, places = np.concatenate((theirs, mine[:2])), np.empty((4, len(limit)))
    places[0], places[1], places[2:] = 0.0, 1.0, nearest[:2]
    found.middle[rows] = mine[2]
    found.along[rows] = mine.max(axis=0) <= limit + STOCK
    found.apart[rows] = np.minimum(ends.min(axis=0), _between_ends(block))
    return ends <= limit, places


def _between_ends(block: _Block) -> Floats:
    """Least distances that lie between the ends of both pieces; infinite where there is none."""
    one, other = block.one, block.other
    kinds = _kinds(block.bent_one, block.bent_other)
    lines, first, second, arcs = ((kinds == kind).nonzero()[0] for kind in range(4))
    if len(lines) == len(kinds):
        return lines_cross(one, other)
    if len(first) == len(kinds):
        return line_to_arc(one, other)
    if len(second) == len(kinds):
        return line_to_arc(other, one)
    if len(arcs) == len(kinds):
        return arc_to_arc(one, other)
    apart = np.empty(len(kinds))
    if len(lines):
        apart[lines] = lines_cross(one[:STRAIGHT].take(lines, axis=1), other[:STRAIGHT].take(lines, axis=1))
    if len(arcs):
        apart[arcs] = arc_to_arc(one.take(arcs, axis=1), other.take(arcs, axis=1))
    mixed = [part for part in ((first, one, other), (second, other, one)) if len(part[0])]
    if mixed:
        straight = np.concatenate([line[:STRAIGHT].take(rows, axis=1) for rows, line, _ in mixed], axis=1)
        bent = np.concatenate([arc.take(rows, axis=1) for rows, _, arc in mixed], axis=1)
        apart[np.concatenate((first, second))] = line_to_arc(straight, bent)
    return apart


def _hull(within: Flags, places: Floats, block: _Block, centre: Measured, surface: Measured) -> tuple[Floats, Floats]:
    """First and last fraction of a surface piece that is one of the ends within the limit.

    The distance from a line is convex along another: what lies between is within too.  On arcs the feet are looked for
    of those ends only that are not beside an end of the arc.
    """
    if np.count_nonzero(block.bent_other):
        within[2:] &= ~(within[0] & within[1])
        end, row = (within[2:] & block.bent_other).nonzero()
        i, j = block.i[row], block.j[row]
        places[end + 2, row] = foot(surface.take(j), centre.start[i] + end * centre.vector[i])
    first: Floats = np.where(within, places, NONE).min(axis=0)
    last: Floats = np.where(within, places, -NONE).max(axis=0)
    return first, last


def _unsure(found: Touches, rows: Rows | slice, block: _Block, centre: Measured, surface: Measured) -> Flags:
    """Touches with arcs that are more than a point, unless both arcs are about one centre and overlap but once."""
    unsure = block.bent_one | block.bent_other
    if not np.count_nonzero(unsure):
        return unsure
    unsure &= (found.last[rows] - found.first[rows]) * surface.length[block.j] > POINT
    both = (unsure & block.bent_one & block.bent_other).nonzero()[0]
    if len(both):
        one, other = Columns(*block.one.take(both, axis=1)), Columns(*block.other.take(both, axis=1))
        off = np.hypot(one.centre_x - other.centre_x, one.centre_y - other.centre_y)
        cross = one.middle_x * other.middle_y - one.middle_y * other.middle_x
        dot = one.middle_x * other.middle_x + one.middle_y * other.middle_y
        angles = centre.angle[block.i[both]] + surface.angle[block.j[both]]
        once = angles / 2.0 + np.arctan2(np.abs(cross), dot) < tau - POINT
        unsure[both[(off <= ON_PATH) & once]] = False
    return unsure
