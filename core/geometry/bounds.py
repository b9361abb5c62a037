"""The exact bounding boxes of pieces."""

from __future__ import annotations

from math import pi, tau
from typing import Final

import numpy as np

from core.geometry.measured import FEW, Flags, Floats, Measured, Rows
from core.geometry.planes import coordinates

QUARTERS: Final = np.array((-pi, -pi / 2.0, 0.0, pi / 2.0))[:, None]
"""(4, 1) angles of the directions -x, -y, x and y."""


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
    passed, center, out = _quarters(arc), coordinates(arc.center).T, arc.radius
    if arcs < len(arc):
        passed &= bent
    reached = box[:, rows]
    np.copyto(reached[:2], center - out, where=passed[:2])
    np.copyto(reached[2:], center + out, where=passed[2:])
    box[:, rows] = reached
    return box


def _quarters(arc: Measured) -> Flags:
    """(4, n) whether the arcs pass the directions -x, -y, x and y seen from their centers.

    What doubles cannot tell, at the ends of an arc, moves no box by more than their last digit: so near to such a
    direction an arc keeps its distance from the center.
    """
    ahead = (QUARTERS - np.arctan2(arc.arm.imag, arc.arm.real)) * arc.turn
    ahead += tau * (ahead < 0.0)
    passed: Flags = ahead <= arc.angle
    return passed
