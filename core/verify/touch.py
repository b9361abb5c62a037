"""Touch: how near the pieces of each pair come to each other, and where the one is within the radius of the other.

Nearly all pairs of a path and its surface either touch at the radius exactly, all along or in one point, or not at
all; both are seen from their ends.  The few others are told, and are left to `reach`.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import tau
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.distance import foot
from core.geometry.measured import Flags, Floats, Measured, Rows
from core.records import dataclass
from core.tolerance import ON_PATH, STOCK
from core.verify.columns import CENTRE, STRAIGHT, Columns, arc_to_arc, line_to_arc, lines_cross, middle, taken, to_piece
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
    """m pairs worked out at once: their pieces, their columns, and which of them are arcs.

    Few pairs have the columns of both in one array `pair` (15 or 5, 2, m), and `bent` (2, m): the steps cost more than
    the pairs.
    """

    i: Rows
    j: Rows
    one: Floats
    other: Floats
    bent_one: Flags
    bent_other: Flags
    pair: Floats | None = None
    bent: Flags | None = None


def touches(centre: Course, i: Rows, surface: Course, j: Rows, radius: float, grant: Floats) -> Touches:
    """The pairs of pieces `i` of the centre path and `j` of the surface, measured, and their touch.

    What is within the radius and `grant` (m,) touches; a pair nearer than the radius less its grant is unsure.
    """
    limit = radius + grant
    found = _blank(len(i))
    for rows, block in _blocks(centre, i, surface, j):
        within, places = _measure(found, rows, block, limit[rows])
        found.first[rows], found.last[rows] = _hull(within, places, block, centre.pieces, surface.pieces)
        found.unsure[rows] = _unsure(found, rows, block, centre.pieces, surface.pieces)
    np.logical_or(found.unsure, found.apart < radius - grant, out=found.unsure)
    return found


def _blank(count: int) -> Touches:
    flags = np.zeros((2, count), np.bool_)
    apart, first, last, middle = np.empty((4, count))
    return Touches(apart, first, last, flags[0], middle, flags[1])


def _blocks(centre: Course, i: Rows, surface: Course, j: Rows) -> Iterator[tuple[Rows | slice, _Block]]:
    """Indices of pairs, parted by which of the two pieces are arcs, at most BLOCK at a time; few pairs all at once."""
    one, other = centre.pieces.arcs[i], surface.pieces.arcs[j]
    if len(i) <= FEW:
        yield slice(None), _few(centre.columns, i, surface.columns, j, np.array((one, other)))
        return
    kinds = _kinds(one, other)
    for kind in range(4):
        rows = (kinds == kind).nonzero()[0]
        for start in range(0, len(rows), BLOCK):
            some = rows[start : start + BLOCK]
            bent = one[some], other[some]
            columns = taken(centre.columns, i[some], bent[0]), taken(surface.columns, j[some], bent[1])
            yield some, _Block(i[some], j[some], *columns, *bent)


def _few(centre: Floats, i: Rows, surface: Floats, j: Rows, bent: Flags) -> _Block:
    """All pairs as one block; a line's arc columns mean nothing."""
    rows = len(Columns._fields) if np.count_nonzero(bent) else STRAIGHT
    pair = np.zeros((rows, 2, len(i)))
    pair[: len(centre), 0], pair[: len(surface), 1] = centre[:rows].take(i, axis=1), surface[:rows].take(j, axis=1)
    return _Block(i, j, pair[:, 0], pair[:, 1], bent[0], bent[1], pair, bent)


def _kinds(one: Flags, other: Flags) -> NDArray[np.int8]:
    """(m,) 0 for two lines, 1 for a line and an arc, 2 for an arc and a line, 3 for two arcs."""
    kinds: NDArray[np.int8] = 2 * one.view(np.int8) + other.view(np.int8)
    return kinds


def _measure(found: Touches, rows: Rows | slice, block: _Block, limit: Floats) -> tuple[Flags, Floats]:
    """Distances of the pairs; (4, m) whether the surface pieces' ends and the centre pieces' ends, start and end of
    each, are within the limit of the other piece; and (4, m) fractions of surface lines nearest to these."""
    mine, theirs, nearest = _to_ends(block)
    ends, places = np.concatenate((theirs, mine[:2])), np.empty((4, len(limit)))
    places[0], places[1], places[2:] = 0.0, 1.0, nearest
    found.middle[rows] = mine[2]
    found.along[rows] = mine.max(axis=0) <= limit + STOCK
    found.apart[rows] = np.minimum(ends.min(axis=0), _between_ends(block))
    return ends <= limit, places


def _to_ends(block: _Block) -> tuple[Floats, Floats, Floats]:
    """(3, m) distances of the centre pieces' starts, ends and middles from the surface pieces, (2, m) of the surface
    pieces' ends from the centre pieces, and (2, m) fractions of surface lines nearest to the centre pieces' ends."""
    if block.pair is not None and block.bent is not None:
        both = Columns(*block.pair)
        x, y = _spots(both, block.bent)
        # each piece is asked for the spots of the other one
        apart, nearest = to_piece(x[:, ::-1], y[:, ::-1], both, block.bent)
        return apart[:, 1], apart[:2, 0], nearest[:2, 1]
    a, b = Columns(*block.one), Columns(*block.other)
    mine, nearest = to_piece(*_spots(a, block.bent_one), b, block.bent_other)
    x, y = np.array((b.x, b.x + b.along)), np.array((b.y, b.y + b.up))
    theirs, _ = to_piece(x, y, a, block.bent_one)
    return mine, theirs, nearest[:2]


def _spots(pieces: Columns, bent: Flags) -> tuple[Floats, Floats]:
    """Starts, ends and middles."""
    x, y = middle(pieces, bent)
    return np.array((pieces.x, pieces.x + pieces.along, x)), np.array((pieces.y, pieces.y + pieces.up, y))


def _between_ends(block: _Block) -> Floats:
    """Least distances that lie between the ends of both pieces; infinite where there is none."""
    if block.pair is not None and block.bent is not None:
        return _between_few(block.pair, block.bent)
    bent_one, bent_other = block.bent_one[0], block.bent_other[0]
    if bent_one and bent_other:
        return arc_to_arc(np.stack((block.one, block.other), axis=1))
    if bent_one:
        return line_to_arc(block.other, block.one)
    return line_to_arc(block.one, block.other) if bent_other else lines_cross(block.one, block.other)


def _between_few(pair: Floats, bent: Flags) -> Floats:
    """The same of pairs of any kinds."""
    either = bent[0] | bent[1]
    lines, arcs = (~either).nonzero()[0], (bent[0] & bent[1]).nonzero()[0]
    if len(lines) == len(either):
        return lines_cross(pair[:, 0], pair[:, 1])
    apart = np.empty(len(either))
    if len(lines):
        apart[lines] = lines_cross(*pair[:STRAIGHT].take(lines, axis=2).swapaxes(0, 1))
    if len(arcs):
        apart[arcs] = arc_to_arc(pair.take(arcs, axis=2))
    if len(lines) + len(arcs) < len(either):
        mixed = (bent[0] != bent[1]).nonzero()[0]
        arc = bent[1, mixed].view(np.int8)
        apart[mixed] = line_to_arc(pair[:STRAIGHT, 1 - arc, mixed], pair[:, arc, mixed])
    return apart


def _hull(within: Flags, places: Floats, block: _Block, centre: Measured, surface: Measured) -> tuple[Floats, Floats]:
    """First and last fraction of a surface piece that is one of the ends within the limit.

    The distance from a line is convex along another: what lies between is within too.  On arcs the feet are looked for
    of those ends only that are not beside an end of the arc.
    """
    if np.count_nonzero(block.bent_other):
        within[2:] &= ~(within[0] & within[1])
        end, row = (within[2:] & block.bent_other).nonzero()
        if len(row):
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
        one, other = block.one[CENTRE].take(both, axis=1), block.other[CENTRE].take(both, axis=1)
        both = both[np.hypot(*(one - other)) <= ON_PATH]
        angles = centre.angle[block.i[both]] + surface.angle[block.j[both]]
        unsure[both] = _meet_twice(block, both, angles)
    return unsure


def _meet_twice(block: _Block, rows: Rows, angles: Floats) -> Flags:
    """Pairs of arcs about one centre, of so many radians together, that may overlap at both ends: the directions of
    their middles are no farther apart than half a turn."""
    twice = angles >= tau - 2.0 * POINT
    some = twice.nonzero()[0]
    if len(some):
        one, other = Columns(*block.one[:, rows[some]]), Columns(*block.other[:, rows[some]])
        cross = one.middle_x * other.middle_y - one.middle_y * other.middle_x
        dot = one.middle_x * other.middle_x + one.middle_y * other.middle_y
        twice[some] = angles[some] / 2.0 + np.arctan2(np.abs(cross), dot) >= tau - POINT
    return twice
