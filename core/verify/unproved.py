"""Unproved: the pairs of a center path and a surface that have to be measured beyond what runs `beside` it.

Words: the company of a wall is its own piece and the corner behind that.  All pieces in company are held against the
walls in the order of the contour, where hardly any but those at one joint are near; all other pieces are loose.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.geometry.aligned import aligned_pairs
from core.geometry.boxes import near_pairs, reaching
from core.geometry.path import Flags, Floats, Rows
from core.geometry.piece_arrays import PieceArrays
from core.verify.beside import Beside

CLEAR: Final = 3.0
"""Grants farther than the radius from which on a wall is neither touched nor the nearest."""


def unproved_pairs(
    center: PieceArrays, around: Floats, surface: PieceArrays, bounds: Floats, own: Beside, reach: float, far: float
) -> tuple[Rows, Rows]:
    """Pieces i of the center path, rising, and walls j whose boxes come within `reach`, but for those that are proved.

    Left out are own pieces and their walls, both sides of proved joints, and straight walls that are farther than
    `far` from a straight own piece.  `around` and `bounds` are the boxes of both.
    """
    settled = own.settled(len(center))
    loose = (~settled).nonzero()[0]
    one, other = near_pairs(around[:, loose], bounds, reach)
    i, j = _of_company(around, bounds, own, reach)
    i, j = i[near := reaching(around.take(i, axis=1), bounds.take(j, axis=1), reach)], j[near]
    i, j = i[unclear := ~clear(center, i, surface, j, far)], j[unclear]
    i, j = np.concatenate((loose[one], i)), np.concatenate((other, j))
    order = np.argsort(i, kind="stable")
    return i[order], j[order]


def _of_company(around: Floats, bounds: Floats, own: Beside, reach: float) -> tuple[Rows, Rows]:
    """Company and walls, but for proved joints: near boxes, and neighbors whether they are near or not."""
    wall, j = aligned_pairs(company_boxes(around, own), bounds, reach, 2, runs=own.runs)
    before, behind = (~own.proved).nonzero()[0], (~own.proved).nonzero()[0] + 1
    corner = _turning_back(own)
    i = np.concatenate((own.piece[wall], own.corner[wall], own.piece[before], own.piece[behind], own.corner[corner]))
    j = np.concatenate((j, j, behind, before, corner - 1))
    there = i >= 0
    return i[there], j[there]


def _turning_back(own: Beside) -> Rows:
    """Walls behind which there is a corner that may be near the wall before."""
    corner = own.corner[1:] >= 0
    if own.runs:
        corner &= ~own.runs.behind(1)
    return corner.nonzero()[0] + 1


def company_boxes(around: Floats, own: Beside) -> Floats:
    """(4, n) boxes of each wall's company; without any it is nowhere."""
    boxes = around.take(own.piece, axis=1)
    boxes[:2, own.piece < 0], boxes[2:, own.piece < 0] = np.inf, -np.inf
    rows = (own.corner >= 0).nonzero()[0]
    if len(rows):
        corner = around.take(own.corner[rows], axis=1)
        boxes[:2, rows] = np.minimum(boxes[:2, rows], corner[:2])
        boxes[2:, rows] = np.maximum(boxes[2:, rows], corner[2:])
    return boxes


def clear(center: PieceArrays, i: Rows, surface: PieceArrays, j: Rows, far: float) -> Flags:
    """Pairs of two lines of which one is wholly on one side of the other's endless line, and farther than `far`."""
    parted = np.zeros(len(i), np.bool_)
    if not len(i):
        return parted
    lines = ((center.turn[i] == 0.0) & (surface.turn[j] == 0.0)).nonzero()[0]
    if not len(lines):
        return parted
    i, j = i[lines], j[lines]
    between = surface.start[j] - center.start[i]
    piece, wall = center.vector[i], surface.vector[j]
    found = np.zeros(len(i), np.bool_)
    for axis, size, vector in ((piece, center.length[i], wall), (wall, surface.length[j], -piece)):
        start = (np.conj(axis) * between).imag
        end = start + (np.conj(axis) * vector).imag
        found |= (np.minimum(np.abs(start), np.abs(end)) > far * size) & (start * end > 0.0)
    parted[lines] = found
    return parted
