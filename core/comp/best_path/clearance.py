"""Clearance: find the slices along which the cutter is nowhere nearer to the surface than its radius.

A slice that turns the wrong way is not clear.  Every other one is measured in its middle.
"""

from __future__ import annotations

import numpy as np

from core.comp.best_path.prepared_contour import Walls
from core.comp.best_path.raw_offset import RawOffset
from core.comp.best_path.slices import Slices
from core.geometry.distance import distance
from core.geometry.nearby import near_pairs, point_boxes
from core.geometry.path import Flags, Points, Rows, as_complex
from core.tolerance import CLEAR


def clear_slices(raw: RawOffset, cut: Slices, walls: Walls, radius: float) -> Slices:
    """Return the slices along which the cutter is nowhere nearer to the surface than the radius."""
    alive = (~cut.dead).nonzero()[0]
    points, piece = cut.middles(raw, alive)
    return cut.take(alive[clear(points, raw.segment[piece], walls, radius)])


def clear(points: Points, segments: Rows, walls: Walls, radius: float) -> Flags:
    """Return (k,) True for points that are no nearer to any piece of the surface than the radius, within CLEAR.

    `segments` (k,) are the pieces that the points were offset from: most points that are not clear are too near to a
    vertex close to that piece.
    """
    good = _clear_of_vertices(points, segments, as_complex(walls.path.points), radius)
    rows = good.nonzero()[0]
    if len(rows):
        spots = points[rows]
        for i, j in near_pairs(point_boxes(spots), walls.tree, radius):
            good[rows[i[distance(walls.pieces.take(j), spots[i]) < radius - CLEAR]]] = False
    return good


def _clear_of_vertices(points: Points, segments: Rows, vertices: Points, radius: float) -> Flags:
    """True for points that are clear of the vertices 1, 2, 4, 8 ... segments ahead and back, until none is near."""
    good = np.ones(len(points), np.bool_)
    step, near = 1, True
    while near and step < len(vertices):
        near = False
        for shift in (step, -step):
            known = np.minimum(np.maximum(segments + shift, 0), len(vertices) - 1)
            apart = np.abs(points - vertices[known])
            near |= bool((good & (apart < 2.0 * radius) & (known == segments + shift)).any())
            good &= apart >= radius - CLEAR
        step *= 2
    return good
