"""The exact bounding boxes of pieces."""

from __future__ import annotations

from math import pi
from typing import Final

import numpy as np

from core.geometry.measured import FEW, Flags, Floats, Measured, Rows
from core.geometry.planes import coordinates

FLAT: Final = 1e-9
"""Radians up to which an arc of any radius a machine could have bulges by nothing beyond its ends."""


def boxes(pieces: Measured) -> Floats:
    """(4, n) exact bounding boxes: least x, least y, largest x, largest y."""
    start, end = coordinates(pieces.start).T, coordinates(pieces.end).T
    box = np.empty((4, len(pieces)))
    np.minimum(start, end, out=box[:2])
    np.maximum(start, end, out=box[2:])
    bent = pieces.arcs
    arcs = np.count_nonzero(bent)
    if not arcs:
        return box
    rows: Rows | slice = slice(None)
    arc = pieces
    if arcs < len(pieces) > FEW:
        rows = some = bent.nonzero()[0]
        arc = pieces.take(some)
    passed, centre, out = _quarters(arc), coordinates(arc.centre).T, arc.radius
    if arcs < len(arc):
        passed &= bent
    reached = box[:, rows]
    np.copyto(reached[:2], centre - out, where=passed[:2])
    np.copyto(reached[2:], centre + out, where=passed[2:])
    box[:, rows] = reached
    return box


def _quarters(arc: Measured) -> Flags:
    """(4, n) whether the arcs pass the directions -x, -y, x and y seen from their centres.

    Counter-clockwise from `a` to `b` an arc of no more than half a turn passes a direction q where neither the cross
    product of a and q nor that of q and b is negative; a larger one where q is not within what is left of the circle,
    from b to a.
    What doubles cannot tell, at the ends and at half a turn, moves no box by more than their last digit.
    """
    first, last = arc.arm, arc.arm + arc.vector
    large = arc.angle > pi
    swap = (arc.turn < 0.0) != large
    a, b = np.where(swap, last, first), np.where(swap, first, last)
    behind, before = np.array((a.imag, -a.real)), np.array((-b.imag, b.real))
    least, most = np.minimum(behind, before), np.maximum(behind, before)
    none = arc.angle <= FLAT
    back = np.where(large, least > 0.0, least < 0.0) | none
    ahead = np.where(large, most < 0.0, most > 0.0) | none
    return np.concatenate((~back, ~ahead))
