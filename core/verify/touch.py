"""Touch: how near the pieces of each pair come to each other, and where the one is within the radius of the other.

Nearly all pairs of a path and its surface either touch at the radius exactly, all along or in one point, or not at
all; both are seen from their ends.  The few others are told, and are left to `reach`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import tau
from typing import Final

import numpy as np

from core.geometry.distance import foot
from core.geometry.measured import Flags, Floats, Measured, Points, Rows, at
from core.tolerance import ON_PATH, STOCK
from core.verify.columns import Columns, arc_to_arc, columns, line_to_arc, middle, to_arc, to_line

BLOCK: Final = 8_000
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


def touches(centre: Measured, i: Rows, surface: Measured, j: Rows, radius: float, grant: Floats) -> Touches:
    """The pairs of pieces `i` of the centre path and `j` of the surface, measured, and their touch.

    What is within the radius and `grant` (m,) touches; a pair nearer than the radius less its grant is unsure.
    """
    limit = radius + grant
    one, other = columns(centre), columns(surface)
    found = _blank(len(i))
    bent_one, bent_other = centre.arcs, surface.arcs
    for rows, arcs in _blocks(bent_one, i, bent_other, j):
        a, b = one.take(i[rows], arcs=arcs[0]), other.take(j[rows], arcs=arcs[1])
        spots = _ends(a, b, arcs)
        found.middle[rows], _ = _apart(*middle(a, arc=arcs[0]), b, arc=arcs[1])
        farthest = np.maximum(np.maximum(*spots.mine), found.middle[rows])
        found.along[rows] = farthest <= limit[rows] + STOCK
        found.apart[rows], within = _measure(a, b, arcs, spots, limit[rows])
        if arcs[1]:
            _on_arcs(found, rows, centre, i[rows], surface, j[rows], within)
        else:
            found.first[rows], found.last[rows] = _hull(spots, within)
        if any(arcs):
            found.unsure[rows] = _unsure(found, rows, centre, i[rows], surface, j[rows])
    found.unsure[found.apart < radius - grant] = True
    return found


def _blank(count: int) -> Touches:
    none = np.full(count, NONE)
    return Touches(np.empty(count), none, -none, np.zeros(count, np.bool_), np.empty(count), np.empty(count, np.bool_))


def _blocks(one: Flags, i: Rows, other: Flags, j: Rows) -> Iterator[tuple[Rows, tuple[bool, bool]]]:
    """Indices of pairs, parted by which of the two pieces are arcs, at most BLOCK at a time."""
    kinds = 2 * one.view(np.int8)[i] + other.view(np.int8)[j]
    for kind in range(4):
        rows = (kinds == kind).nonzero()[0]
        for start in range(0, len(rows), BLOCK):
            yield rows[start : start + BLOCK], (kind > 1, kind % 2 > 0)


@dataclass(frozen=True, eq=False, slots=True)
class _Ends:
    """Distances of the centre pieces' ends from the surface pieces and the other way round, start and end of each.

    `places` are the fractions of a surface line that is nearest to the centre piece's ends.
    """

    mine: tuple[Floats, Floats]
    theirs: tuple[Floats, Floats]
    places: tuple[Floats, Floats] | None


def _ends(a: Columns, b: Columns, arcs: tuple[bool, bool]) -> _Ends:
    mine = [_apart(x, y, b, arc=arcs[1]) for x, y in ((a.x, a.y), (a.x + a.along, a.y + a.up))]
    theirs = [_apart(x, y, a, arc=arcs[0])[0] for x, y in ((b.x, b.y), (b.x + b.along, b.y + b.up))]
    places = None if arcs[1] else (mine[0][1], mine[1][1])
    return _Ends((mine[0][0], mine[1][0]), (theirs[0], theirs[1]), places)


def _apart(x: Floats, y: Floats, piece: Columns, *, arc: bool) -> tuple[Floats, Floats]:
    if arc:
        return to_arc(x, y, piece), x
    square, t = to_line(x, y, piece)
    return np.sqrt(square, out=square), t


def _measure(
    a: Columns, b: Columns, arcs: tuple[bool, bool], ends: _Ends, limit: Floats
) -> tuple[Floats, tuple[Flags, ...]]:
    """Least distances, and which of the four ends are within the limit of the other piece."""
    apart = np.minimum(np.minimum(*ends.mine), np.minimum(*ends.theirs))
    if arcs == (True, True):
        np.minimum(apart, arc_to_arc(a, b), out=apart)
    elif any(arcs):
        line, arc = (b, a) if arcs[0] else (a, b)
        np.minimum(apart, line_to_arc(line, arc)[0], out=apart)
    else:
        apart[_lines_cross(a, b)] = 0.0
    return apart, tuple(end <= limit for end in (*ends.mine, *ends.theirs))


def _lines_cross(a: Columns, b: Columns) -> Flags:
    x, y = b.x - a.x, b.y - a.y
    turn = a.along * b.up - a.up * b.along
    start, end = a.along * y - a.up * x, b.along * y - b.up * x
    across: Flags = (start * (start + turn) < 0.0) & (end * (end + turn) < 0.0)
    return across


def _hull(ends: _Ends, within: tuple[Flags, ...]) -> tuple[Floats, Floats]:
    """First and last fraction of a surface line that is one of the ends within the limit.

    The distance from a line is convex along another: what lies between is within too.
    """
    assert ends.places is not None
    first, last = np.where(within[3], 1.0, NONE), np.where(within[2], 0.0, -NONE)
    first[within[2]], last[within[3]] = 0.0, 1.0
    for near, t in zip(within[:2], ends.places, strict=True):
        np.minimum(first, np.where(near, t, NONE), out=first)
        np.maximum(last, np.where(near, t, -NONE), out=last)
    return first, last


def _on_arcs(
    found: Touches,
    rows: Rows,
    centre: Measured,
    i: Rows,
    surface: Measured,
    j: Rows,
    within: tuple[Flags, ...],
) -> None:
    """The same for surface arcs: the feet of the centre pieces' ends that are not beside an end of the arc."""
    first, last = np.where(within[3], 1.0, NONE), np.where(within[2], 0.0, -NONE)
    first[within[2]], last[within[3]] = 0.0, 1.0
    for end, near in enumerate(within[:2]):
        need = (near & ((first > 0.0) | (last < 1.0))).nonzero()[0]
        if not len(need):
            continue
        arc = surface.take(j[need])
        piece = centre.take(i[need])
        t = foot(arc, at(piece, np.full(len(need), float(end))))
        first[need], last[need] = np.minimum(first[need], t), np.maximum(last[need], t)
    found.first[rows], found.last[rows] = first, last


def _unsure(found: Touches, rows: Rows, centre: Measured, i: Rows, surface: Measured, j: Rows) -> Flags:
    """Touches with arcs that are more than a point, unless both arcs are about one centre and overlap but once."""
    width = (found.last[rows] - found.first[rows]) * surface.length[j]
    unsure = width > POINT
    wide = unsure.nonzero()[0]
    if len(wide):
        one, other = centre.take(i[wide]), surface.take(j[wide])
        about = one.arcs & other.arcs & (np.abs(one.centre - other.centre) <= ON_PATH)
        turned = np.abs(np.angle(_middle(one) * np.conj(_middle(other))))
        once = (one.angle + other.angle) / 2.0 + turned < tau - POINT
        unsure[wide[about & once]] = False
    return unsure


def _middle(arc: Measured) -> Points:
    """Directions of the arcs' middles from their centres, of any length."""
    middle: Points = arc.arm * np.exp(0.5j * arc.turn * arc.angle)
    return middle
