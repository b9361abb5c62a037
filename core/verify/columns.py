"""Columns: pieces as plain columns of numbers, and the least distance of many pairs of them without trigonometry.

A line needs its start and vector; an arc also its centre, its radius, the direction of its middle and which way and how
far it turns: a direction lies within the arc when it is not on the wrong side of its ends'.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from core.geometry.measured import Flags, Floats, Measured, Rows

SHORT: Final = 1e-3
"""Chords shorter than this part of the radius do not say where an arc's middle is to the last digit."""


@dataclass(frozen=True, eq=False, slots=True)
class Columns:
    """n pieces: start, vector and squared length of the chord; of arcs the centre, the radius, the middle's direction,
    the turn, and whether they are more than half a circle."""

    x: Floats
    y: Floats
    along: Floats
    up: Floats
    square: Floats
    centre_x: Floats
    centre_y: Floats
    radius: Floats
    middle_x: Floats
    middle_y: Floats
    turn: Floats
    large: Flags

    def take(self, rows: Rows, *, arcs: bool) -> Columns:
        """The pieces of these indices; where no `arcs` are asked for, those columns are left as they are."""
        straight = [column.take(rows) for column in (self.x, self.y, self.along, self.up, self.square)]
        bent = [self.centre_x, self.centre_y, self.radius, self.middle_x, self.middle_y, self.turn]
        if arcs:
            bent = [column.take(rows) for column in bent]
        x, y, along, up, square, centre_x, centre_y, radius, middle_x, middle_y, turn = straight + bent
        large = self.large.take(rows) if arcs else self.large
        return Columns(x, y, along, up, square, centre_x, centre_y, radius, middle_x, middle_y, turn, large)


def columns(pieces: Measured) -> Columns:
    """The columns of these pieces; a line's arc columns mean nothing."""
    x, y = pieces.start.real.copy(), pieces.start.imag.copy()
    along, up = pieces.vector.real.copy(), pieces.vector.imag.copy()
    square = along * along + up * up
    square[square == 0.0] = 1.0
    if not pieces.turn.any():
        none = np.zeros(0)
        return Columns(x, y, along, up, square, none, none, none, none, none, none, np.zeros(0, np.bool_))
    size = np.sqrt(square)
    size[size == 0.0] = 1.0
    middle_x, middle_y = pieces.turn * up / size, -pieces.turn * along / size
    short = ((size < SHORT * pieces.radius) & (pieces.turn != 0.0)).nonzero()[0]
    if len(short):
        arc = pieces.take(short)
        middle = arc.arm / np.where(arc.radius == 0.0, 1.0, arc.radius) * np.exp(0.5j * arc.turn * arc.angle)
        middle_x[short], middle_y[short] = middle.real, middle.imag
    large = pieces.angle > pi
    centre_x, centre_y = x - pieces.arm.real, y - pieces.arm.imag
    radius, turn = pieces.radius, pieces.turn
    return Columns(x, y, along, up, square, centre_x, centre_y, radius, middle_x, middle_y, turn, large)


def middle(pieces: Columns, *, arc: bool) -> tuple[Floats, Floats]:
    """The middles of pieces that are all arcs or all lines."""
    if arc:
        x = pieces.centre_x + pieces.radius * pieces.middle_x
        return x, pieces.centre_y + pieces.radius * pieces.middle_y
    return pieces.x + 0.5 * pieces.along, pieces.y + 0.5 * pieces.up


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
    """Which directions from the centres lie within the arcs.

    An arc of no more than half a circle is behind its first end's direction and before its last one's, both times by
    the sign of a cross product, which keeps its digits in arcs however flat; a larger one leaves out what is neither.
    Without an angle to speak of an arc has no such sides, and its opposite is kept off.
    """
    first_x, first_y = arc.x - arc.centre_x, arc.y - arc.centre_y
    behind = (first_x * y - first_y * x) * arc.turn >= 0.0
    first_x += arc.along
    first_y += arc.up
    before = (first_y * x - first_x * y) * arc.turn >= 0.0
    ahead = x * arc.middle_x + y * arc.middle_y >= -0.5 * (np.abs(x) + np.abs(y))
    within: Flags = (arc.large & (behind | before)) | (behind & before & ahead)
    return within


def to_arc(x: Floats, y: Floats, arc: Columns) -> Floats:
    """Distances of points from their arcs."""
    off_x, off_y = x - arc.centre_x, y - arc.centre_y
    size, within = np.sqrt(off_x * off_x + off_y * off_y), inside(off_x, off_y, arc)
    x, y = x - arc.x, y - arc.y
    first = x * x + y * y
    x -= arc.along
    y -= arc.up
    ends = np.sqrt(np.minimum(first, x * x + y * y))
    apart: Floats = np.where(within, np.abs(size - arc.radius), ends)
    return apart


def line_to_arc(line: Columns, arc: Columns) -> tuple[Floats, Floats]:
    """Distances of pairs where the line passes the arc between all ends, 0 where they cross, and the line's fractions.

    Infinite where the foot of the centre is on neither.
    """
    x, y = arc.centre_x - line.x, arc.centre_y - line.y
    t = (x * line.along + y * line.up) / line.square
    off_x, off_y = t * line.along - x, t * line.up - y
    within, height = inside(off_x, off_y, arc), np.sqrt(off_x * off_x + off_y * off_y)
    apart = np.where(within & (t >= 0.0) & (t <= 1.0), np.abs(height - arc.radius), np.inf)
    cut = (height < arc.radius).nonzero()[0]
    if len(cut):
        arc_, along, up = _cut(arc, cut), line.along[cut], line.up[cut]
        half = np.sqrt((arc_.radius - height[cut]) * (arc_.radius + height[cut]) / line.square[cut])
        for step in (-half, half):
            met = inside(off_x[cut] + step * along, off_y[cut] + step * up, arc_)
            met &= (t[cut] + step >= 0.0) & (t[cut] + step <= 1.0)
            apart[cut[met]] = 0.0
    return apart, t


def arc_to_arc(one: Columns, other: Columns) -> Floats:
    """Distances of pairs of arcs on the line through their centres, 0 where they cross, infinite where neither is."""
    x, y = other.centre_x - one.centre_x, other.centre_y - one.centre_y
    size = np.sqrt(x * x + y * y)
    ahead_one, behind_one = inside(x, y, one), inside(-x, -y, one)
    ahead_other, behind_other = inside(x, y, other), inside(-x, -y, other)
    apart = np.full(len(x), np.inf)
    for within, gap in (
        (ahead_one & behind_other, size - other.radius - one.radius),
        (ahead_one & ahead_other, size + other.radius - one.radius),
        (behind_one & behind_other, size - other.radius + one.radius),
    ):
        np.minimum(apart, np.where(within, np.abs(gap), np.inf), out=apart)
    cut = ((size > np.abs(one.radius - other.radius)) & (size < one.radius + other.radius)).nonzero()[0]
    if len(cut):
        apart[cut[_arcs_cross(_cut(one, cut), _cut(other, cut), x[cut], y[cut], size[cut])]] = 0.0
    return apart


def _arcs_cross(one: Columns, other: Columns, x: Floats, y: Floats, size: Floats) -> Flags:
    """Whether arcs of crossing circles cross; (x, y) leads from centre to centre, `size` long."""
    share = (size * size + (one.radius - other.radius) * (one.radius + other.radius)) / (2.0 * size * size)
    height = np.sqrt(np.maximum((one.radius / size) ** 2 - share * share, 0.0))
    crossed = np.zeros(len(x), np.bool_)
    for off in (height, -height):
        at_x, at_y = share * x - off * y, share * y + off * x
        crossed |= inside(at_x, at_y, one) & inside(at_x - x, at_y - y, other)
    return crossed


def _cut(pieces: Columns, rows: Rows) -> Columns:
    return pieces.take(rows, arcs=True)
