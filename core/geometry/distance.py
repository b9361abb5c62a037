"""This module calculates exact distances between lines and arcs, for arrays of points and of pairs of pieces.

Piece k of one `PieceArrays` is paired with piece k of another.  Every extreme of the distance along a piece lies at
one of a few fractions that have a formula: its ends, the feet of the other's ends and center, the crossings.  If a
formula has no solution, the piece's start takes its place.  This does no harm: a fraction is only a candidate, and
its distance is always measured.
"""

from __future__ import annotations

from math import tau

import numpy as np

from core.geometry.path import Floats, Points
from core.geometry.piece_arrays import PieceArrays, at, by_kind, traveled


def foot(pieces: PieceArrays, points: Points) -> Floats:
    """Return the (..., n) fractions at which each piece is nearest to its point of `points` (..., n)."""
    return by_kind(pieces.arcs, _line_foot, _arc_foot, pieces, points)


def distance(pieces: PieceArrays, points: Points) -> Floats:
    """Return the (..., n) least distances of each piece from its point of `points` (..., n), in millimeters."""
    return by_kind(pieces.arcs, _line_distance, _arc_distance, pieces, points)


def _line_foot(line: PieceArrays, points: Points) -> Floats:
    return _line_share(line, points - line.start)


def _line_distance(line: PieceArrays, points: Points) -> Floats:
    from_start = points - line.start
    return np.abs(from_start - _line_share(line, from_start) * line.vector)


def _line_share(line: PieceArrays, from_start: Points) -> Floats:
    """Return the fractions at which lines are nearest to points at `from_start` from their starts.

    A line so short that its squared length is 0 counts as a point.
    """
    square = line.length * line.length
    share = (from_start * np.conj(line.vector)).real / np.where(square == 0.0, 1.0, square)
    return np.minimum(np.maximum(share, 0.0), 1.0)


def _arc_foot(arc: PieceArrays, points: Points) -> Floats:
    turned = traveled(arc, points - arc.center)
    beyond = np.where(tau - turned < turned - arc.angle, 0.0, 1.0)
    return np.where(turned <= arc.angle, turned / np.where(arc.angle == 0.0, 1.0, arc.angle), beyond)


def _arc_distance(arc: PieceArrays, points: Points) -> Floats:
    radial = points - arc.center
    to_ends = np.minimum(np.abs(points - arc.start), np.abs(points - arc.end))
    return np.where(traveled(arc, radial) <= arc.angle, np.abs(np.abs(radial) - arc.radius), to_ends)


def fractions_on_line(pieces: PieceArrays, through: Points, unit: Points) -> Floats:
    """Return the (2, ..., n) fractions at which the pieces meet endless lines through points along `unit`; else nan."""
    return by_kind(pieces.arcs, _line_on_line, _arc_on_line, pieces, through, unit)


def fractions_on_circle(pieces: PieceArrays, center: Points, radius: Floats) -> Floats:
    """Return the (2, ..., n) fractions at which the pieces, lines extended, meet whole circles; nan for none."""
    return by_kind(pieces.arcs, _line_on_circle, _arc_on_circle, pieces, center, radius)


def _line_on_line(line: PieceArrays, through: Points, unit: Points) -> Floats:
    fraction = ((through - line.start) * np.conj(unit)).imag / (line.vector * np.conj(unit)).imag
    return np.array((fraction, fraction))


def _arc_on_line(arc: PieceArrays, through: Points, unit: Points) -> Floats:
    normal = 1j * unit
    height = ((through - arc.center) * np.conj(normal)).real
    return _fractions_beside_axis(arc, normal, (arc.radius - height) / (2.0 * arc.radius))


def _line_on_circle(line: PieceArrays, center: Points, radius: Floats) -> Floats:
    unit = line.unit
    center_from_start = (center - line.start) * np.conj(unit)
    half = np.sqrt((radius - center_from_start.imag) * (radius + center_from_start.imag))
    return np.array((center_from_start.real - half, center_from_start.real + half)) / line.length


def _arc_on_circle(arc: PieceArrays, center: Points, radius: Floats) -> Floats:
    to_center = center - arc.center
    size = np.abs(to_center)
    excess = size - arc.radius
    return _fractions_beside_axis(arc, to_center, (radius - excess) * (radius + excess) / (4.0 * arc.radius * size))


def _fractions_beside_axis(arc: PieceArrays, axis: Points, share: Floats) -> Floats:
    """Return the fractions at the two directions from the arc's center that are at an angle a to either side of `axis`,
    with `share` = sin(a / 2) squared: unlike cos(a), it stays accurate near a touch, where a is almost 0."""
    half = 2.0 * np.arcsin(np.sqrt(share))
    turned = axis * np.conj(arc.arm)
    middle = np.arctan2(turned.imag, turned.real) * arc.turn
    return np.mod(np.array((middle - half, middle + half)), tau) / arc.angle


def nearest_fractions(pieces: PieceArrays, other: PieceArrays) -> Floats:
    """Return (8, n) fractions of n pieces that include every local least distance from the n partners in `other`."""
    ends = np.repeat([[0.0], [1.0]], len(pieces), axis=1)
    crossings = by_kind(
        other.arcs,
        lambda: fractions_on_line(pieces, other.start, other.unit),
        lambda: fractions_on_circle(pieces, other.center, other.radius),
    )
    return _clamped(np.concatenate((ends, crossings, feet(pieces, other))))


def farthest_fractions(pieces: PieceArrays, other: PieceArrays) -> Floats:
    """Return (10, n) fractions that include every local greatest distance from the partner in `other`, except at ends.

    They are the feet, their antipodes, and the points equally far from an arc partner's two ends.
    """
    count, antipodes = len(pieces), np.array((pieces.center - other.start, pieces.center - other.end))
    even = by_kind(other.arcs, lambda: np.zeros((4, count)), lambda: _equidistant_fractions(pieces, other))
    opposite = by_kind(pieces.arcs, lambda: np.zeros((2, count)), lambda: _arc_fractions(pieces, antipodes))
    return _clamped(np.concatenate((feet(pieces, other), opposite, even)))


def band_fractions(pieces: PieceArrays, other: PieceArrays, reach: Floats) -> Floats:
    """Return (10, n) rising fractions that split each piece where its distance from its partner may pass `reach` (n,).

    These are the piece's ends, and where it meets the outline of all points within `reach` of the partner: the partner
    offset to both sides, and the circles about its ends.
    """
    fractions = np.empty((10, len(pieces)))
    fractions[0], fractions[1], fractions[2:] = 0.0, 1.0, _clamped(_outline(pieces, other, reach))
    fractions.sort(axis=0)
    return fractions


def _outline(pieces: PieceArrays, other: PieceArrays, reach: Floats) -> Floats:
    """Return (8, n) fractions at the circles about both ends, and at a line's two offsets or an arc's two circles."""
    bent, ends = other.arcs, (other.start, other.end)
    arcs = np.count_nonzero(bent)
    if not arcs:
        caps = fractions_on_circle(pieces, np.array(ends), np.array((reach, reach)))
        return np.concatenate((caps, _sides(pieces, other, reach)), axis=1).reshape(8, -1)
    center, radii = other.center, (reach, reach, other.radius + reach, np.abs(other.radius - reach))
    met = fractions_on_circle(pieces, np.array((*ends, center, center)), np.array(radii))
    if arcs < len(bent):
        met[:, 2:] = np.where(bent, met[:, 2:], _sides(pieces, other, reach))
    return met.reshape(8, -1)


def _sides(pieces: PieceArrays, line: PieceArrays, reach: Floats) -> Floats:
    unit = line.unit
    normal = 1j * reach * unit
    return fractions_on_line(pieces, np.array((line.start + normal, line.start - normal)), unit)


def _clamped(fractions: Floats) -> Floats:
    return np.minimum(np.fmax(fractions, 0.0), 1.0)


def feet(pieces: PieceArrays, other: PieceArrays) -> Floats:
    """Return (4, n) fractions: the feet of the other's two ends and, both ways, of its center or along its normal."""
    return by_kind(pieces.arcs, _line_feet, _arc_feet, pieces, other)


def _line_feet(line: PieceArrays, other: PieceArrays) -> Floats:
    center = other.center
    return _line_foot(line, np.array((other.start, other.end, center, center)))


def _arc_feet(arc: PieceArrays, other: PieceArrays) -> Floats:
    normal = np.where(other.arcs, other.center - arc.center, 1j * other.vector)
    directions = np.array((other.start - arc.center, other.end - arc.center, normal, -normal))
    return _arc_fractions(arc, directions)


def _arc_fractions(arc: PieceArrays, directions: Points) -> Floats:
    """Return the fractions at which arcs pass the directions (..., n) from their centers; beyond 1 past their ends."""
    return traveled(arc, directions) / arc.angle


def _equidistant_fractions(pieces: PieceArrays, arc: PieceArrays) -> Floats:
    middle = arc.arm / arc.radius * np.exp(0.5j * arc.turn * arc.angle)
    fractions = fractions_on_line(pieces, arc.center, middle)
    return np.concatenate((fractions, fractions))


def distances_at(pieces: PieceArrays, other: PieceArrays, fractions: Floats) -> Floats:
    """Return the (k, n) distances of the points at `fractions` (k, n) of each piece from its partner in `other`."""
    return distance(other, at(pieces, fractions))
