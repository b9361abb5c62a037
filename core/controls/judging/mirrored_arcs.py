"""Mirrored arcs make corners with both neighbors where another arc of the same ends and radius would be tangent.

That is what a wrong sign of R, G2 instead of G3, or a center on the wrong side of the chord makes of a rounded corner.
The path follows such an arc without a gouge, so that nothing else tells of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians
from typing import Final

import numpy as np

from core.geometry.path import Flags, Floats, Path, Pieces, Points, next_in_ring, pieces_of, swept, tangents

TANGENT: Final = radians(1.0)
"""Radians; an arc is tangent to its neighbor up to this angle: drawings and CAM systems round centers."""

CORNER: Final = radians(5.0)
"""Radians; from this angle on an arc makes a corner with its neighbor."""

MIN_PIECES: Final = 3
"""Pieces of the shortest contour in which an arc has two neighbors."""


@dataclass(frozen=True, slots=True)
class MirroredArc:
    """An arc that makes corners with both neighbors: its line's number and the middle between its ends.

    `long` and `counterclockwise` describe the arc that would be tangent to both.
    """

    number: float
    at: tuple[float, float]
    long: bool
    counterclockwise: bool


def mirrored_arcs(contour: Path) -> tuple[tuple[MirroredArc, ...], int]:
    """Return the mirrored arcs of a contour, and how many of its arcs are tangent to both neighbors."""
    rows = contour.turns.nonzero()[0]
    if len(contour) < MIN_PIECES or not len(rows):
        return (), 0
    pieces, first, last = pieces_of(contour), *tangents(contour)
    before, after = np.roll(last, 1), next_in_ring(first)
    closed = bool((contour.points[0] == contour.points[-1]).all())
    if not closed:
        rows = rows[(rows > 0) & (rows < len(contour) - 1)]
    rows = rows[pieces.start[rows] != pieces.end[rows]]
    arcs, before, after = pieces.take(rows), before[rows], after[rows]
    tangent = _fits(arcs, before, after, TANGENT)
    corners = (_bend(before, first[rows]) > CORNER) & (_bend(last[rows], after) > CORNER)
    other_side = arcs.start + arcs.end - arcs.center
    mirrored = dict[int, MirroredArc]()
    for center, turn in ((arcs.center, -arcs.turn), (other_side, arcs.turn), (other_side, -arcs.turn)):
        other = Pieces(arcs.start, arcs.end, center, turn)
        long = swept(other) > pi
        for index in np.flatnonzero(corners & _fits(other, before, after, TANGENT)).tolist():
            middle = complex(arcs.start[index] + arcs.end[index]) / 2.0
            number, ccw = float(contour.numbers[rows[index]]), bool(turn[index] > 0)
            mirrored[index] = MirroredArc(number, (middle.real, middle.imag), bool(long[index]), ccw)
    return tuple(mirrored[index] for index in sorted(mirrored)), int(np.count_nonzero(tangent))


def _fits(arcs: Pieces, before: Points, after: Points, angle: float) -> Flags:
    """Return (k,) flags of arcs that bend from and into their neighbors' directions by no more than an angle."""
    across = 1j * arcs.turn
    first, last = across * (arcs.start - arcs.center), across * (arcs.end - arcs.center)
    fits: Flags = (_bend(before, first) <= angle) & (_bend(last, after) <= angle)
    return fits


def _bend(first: Points, second: Points) -> Floats:
    """Return the (k,) angles between directions, radians from 0 to pi."""
    bend: Floats = np.abs(np.angle(second * first.conj()))
    return bend
