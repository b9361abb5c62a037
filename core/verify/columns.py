"""Columns: pieces as plain columns of numbers, and the least distance of many pairs of them without trigonometry.

A line needs its start and vector; an arc also its center, its radius, the direction of its middle and which way and how
far it turns: a direction lies within the arc when it is not on the wrong side of its ends'.
"""

from __future__ import annotations

from math import pi
from typing import Final, NamedTuple

import numpy as np

from core.geometry.path import Flags, Floats
from core.geometry.piece_arrays import PieceArrays

SHORT: Final = 1e-3
"""Chords shorter than this part of the radius do not say where an arc's middle is to the last digit."""


THIN: Final = 1e-6
"""Radians below which an arc's ends might be told apart by rounding alone."""

STRAIGHT: Final = 5
"""Columns of a line; an arc has all of them."""

CENTER: Final = slice(5, 7)
"""Columns of an arc's center."""

_NONE: Final = np.zeros(0)


class Columns(NamedTuple):
    """n pieces: start, vector and squared length of the chord.

    Of arcs also the center, the radius, where both ends lie as seen from the center, negative in a clockwise arc, the
    middle's direction, and `size`: 1 where they are more than half a circle, -1 where they are THIN, else 0.
    """

    x: Floats
    y: Floats
    along: Floats
    up: Floats
    square: Floats
    center_x: Floats = _NONE
    center_y: Floats = _NONE
    radius: Floats = _NONE
    begin_x: Floats = _NONE
    begin_y: Floats = _NONE
    end_x: Floats = _NONE
    end_y: Floats = _NONE
    middle_x: Floats = _NONE
    middle_y: Floats = _NONE
    size: Floats = _NONE


def columns(pieces: PieceArrays) -> Floats:
    """(15, n) the columns of these pieces, in order; a line's arc columns mean nothing.  (5, n) without any arcs."""
    x, y, along, up = pieces.start.real, pieces.start.imag, pieces.vector.real, pieces.vector.imag
    square = along * along + up * up
    square[square == 0.0] = 1.0
    if not pieces.turn.any():
        return np.array((x, y, along, up, square))
    turn, center_x, center_y = pieces.turn, x - pieces.arm.real, y - pieces.arm.imag
    begin_x, begin_y = x - center_x, y - center_y
    ends = begin_x * turn, begin_y * turn, (begin_x + along) * turn, (begin_y + up) * turn
    sizes = np.where(pieces.angle > pi, 1.0, -1.0 * ((pieces.angle < THIN) & (turn != 0.0)))
    return np.array(
        (x, y, along, up, square, center_x, center_y, pieces.radius, *ends, *_middles(pieces, square), sizes)
    )


def _middles(pieces: PieceArrays, square: Floats) -> tuple[Floats, Floats]:
    """The directions of arcs' middles from their centers; `square` is the chords' squared length, or 1."""
    size = np.sqrt(square)
    x, y = pieces.turn * pieces.vector.imag / size, -pieces.turn * pieces.vector.real / size
    # a full circle has no chord at all
    short = (np.abs(pieces.vector) < SHORT * pieces.radius).nonzero()[0]
    if len(short):
        arc = pieces.take(short)
        middle = arc.arm / np.where(arc.radius == 0.0, 1.0, arc.radius) * np.exp(0.5j * arc.turn * arc.angle)
        x[short], y[short] = middle.real, middle.imag
    return x, y


def line_middle(line: Columns) -> tuple[Floats, Floats]:
    """x and y of the middles of lines."""
    return line.x + 0.5 * line.along, line.y + 0.5 * line.up


def arc_middle(arc: Columns) -> tuple[Floats, Floats]:
    """x and y of the middles of arcs."""
    return arc.center_x + arc.radius * arc.middle_x, arc.center_y + arc.radius * arc.middle_y


def to_line(x: Floats, y: Floats, line: Columns) -> tuple[Floats, Floats]:
    """Squared distances of points from their lines, and the fractions of the lines they are nearest to."""
    x, y = x - line.x, y - line.y
    t = x * line.along
    t += y * line.up
    t /= line.square
    np.maximum(t, 0.0, out=t)
    np.minimum(t, 1.0, out=t)
    x -= t * line.along
    y -= t * line.up
    x *= x
    y *= y
    x += y
    return x, t


def inside(x: Floats, y: Floats, arc: Columns) -> Flags:
    """Which directions from the centers lie within the arcs.

    An arc of no more than half a circle is behind its first end's direction and before its last one's, both times by
    the sign of a cross product, which keeps its digits in arcs however flat; a larger one leaves out what is neither.
    Without an angle to speak of an arc has no such sides, and its opposite is kept off.  From THIN on no direction in
    the opposite is on the right side of both ends, not even by rounding: it is farther than that from one of them.
    """
    behind = arc.begin_x * y - arc.begin_y * x >= 0.0
    before = arc.end_y * x - arc.end_x * y >= 0.0
    within: Flags = behind & before
    if np.count_nonzero(arc.size):
        ahead = x * arc.middle_x + y * arc.middle_y >= -0.5 * (np.abs(x) + np.abs(y))
        within &= ahead | (arc.size >= 0.0)
        within |= (behind | before) & (arc.size > 0.0)
    return within


def to_arc(x: Floats, y: Floats, arc: Columns) -> Floats:
    """Distances of points from their arcs."""
    off_x, off_y = x - arc.center_x, y - arc.center_y
    size, within = np.sqrt(off_x * off_x + off_y * off_y), inside(off_x, off_y, arc)
    x, y = x - arc.x, y - arc.y
    first = x * x + y * y
    x -= arc.along
    y -= arc.up
    ends = np.sqrt(np.minimum(first, x * x + y * y))
    apart: Floats = np.where(within, np.abs(size - arc.radius), ends)
    return apart


def lines_cross(lines: Floats, others: Floats) -> Floats:
    """0 for pairs of lines that cross between their ends, infinite for all others."""
    x, y = others[:2] - lines[:2]
    along, up, to_along, to_up = lines[2], lines[3], others[2], others[3]
    turn = along * to_up - up * to_along
    start, end = along * y - up * x, to_along * y - to_up * x
    return np.where((start * (start + turn) < 0.0) & (end * (end + turn) < 0.0), 0.0, np.inf)


def line_to_arc(lines: Floats, arcs: Floats) -> Floats:
    """Distances of pairs where the line passes the arc between all ends, 0 where they cross.

    Infinite where the foot of the center is on neither.
    """
    line, arc = Columns(*lines[:STRAIGHT]), Columns(*arcs)
    x, y = arc.center_x - line.x, arc.center_y - line.y
    t = (x * line.along + y * line.up) / line.square
    off_x, off_y = t * line.along - x, t * line.up - y
    height = np.sqrt(off_x * off_x + off_y * off_y)
    # a line that passes the circle meets it nowhere: what is not a number is neither on the line nor within the arc
    half = np.sqrt((arc.radius - height) * (arc.radius + height) / line.square)
    steps = np.array((np.zeros(len(t)), -half, half))
    met = inside(off_x + steps * line.along, off_y + steps * line.up, arc)
    steps += t
    met &= (steps >= 0.0) & (steps <= 1.0)
    apart = np.where(met[0], np.abs(height - arc.radius), np.inf)
    apart[met[1] | met[2]] = 0.0
    return apart


def arc_to_arc(pairs: Floats) -> Floats:
    """Distances of pairs of arcs (15, 2, m) on the line through their centers, 0 where they cross, infinite where
    neither is."""
    both = Columns(*pairs)
    (x, y), (one, other) = pairs[CENTER, 1] - pairs[CENTER, 0], both.radius
    size, between = np.sqrt(x * x + y * y), x + 1j * y
    both_radii, more = one + other, one - other
    # from both centers, ahead and behind along the line through them, and to both crossings of the circles
    share = (size * size + more * both_radii) / (2.0 * size * size)
    height = np.sqrt(np.maximum((one / size) ** 2 - share * share, 0.0))
    met, to = share + 1j * height, np.empty((4, 2, len(x)), np.complex128)
    to[0], to[1], to[2], to[3] = between, -between, between * met, between * np.conj(met)
    to[2:, 1] -= between
    (ahead, behind, first, second) = inside(to.real, to.imag, both)
    within = np.array((ahead[0] & behind[1], ahead[0] & ahead[1], behind[0] & behind[1]))
    gaps = np.array((size - other - one, size + other - one, size - other + one))
    # about one center an end of the one is as near as it gets, or both are nowhere side by side
    apart: Floats = np.where(within & (size > 0.0), np.abs(gaps), np.inf).min(axis=0)
    crossed = (first[0] & first[1]) | (second[0] & second[1])
    apart[crossed & (size > np.abs(more)) & (size < both_radii)] = 0.0
    return apart
