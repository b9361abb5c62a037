"""Clearance: find the slices along which the cutter is nowhere nearer to the surface than its radius.

Slices that turn into each other at crossings, on the cutter's side, form a GROUP: all of them are clear, or none is.
A group with one slice that turns the wrong way is not clear.  In every other group the distance to the surface is
measured at a sample of slices, and at all of them if the sample disagrees.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.comp.best_path.prepared_contour import Walls
from core.comp.best_path.raw_offset import RawOffset
from core.comp.best_path.slices import Slices, least_of_connected
from core.geometry.distance import distance
from core.geometry.nearby import near_pairs, point_boxes
from core.geometry.path import Flags, Points, Rows, as_complex
from core.tolerance import CLEAR

SAMPLE: Final = 64
"""Interval between the slices of a group that are measured; all long slices are measured too."""


def clear_slices(raw: RawOffset, cut: Slices, walls: Walls, radius: float) -> Slices:
    """Return the slices along which the cutter is nowhere nearer to the surface than the radius."""
    if not len(cut):
        return cut
    turning = (cut.turning >= 0).nonzero()[0]
    group = least_of_connected(len(cut), turning, cut.turning[turning])
    lost = np.zeros(len(cut), np.bool_)
    lost[group[cut.dead]] = True
    alive = ~lost[group]
    sample = alive & ((_rank(np.where(alive, group, -1)) % SAMPLE == 0) | (cut.size > radius / 4.0))
    good = _clear_in_middle(raw, cut, sample, walls, radius)
    clear, blocked = np.zeros((2, len(cut)), np.bool_)
    clear[group[good]] = True
    blocked[group[sample & ~good]] = True
    doubtful = alive & clear[group] & blocked[group] & ~sample
    good |= alive & clear[group] & ~blocked[group]
    good |= _clear_in_middle(raw, cut, doubtful, walls, radius)
    return cut.take(good.nonzero()[0])


def _clear_in_middle(raw: RawOffset, cut: Slices, chosen: Flags, walls: Walls, radius: float) -> Flags:
    """Return which of the `chosen` slices are clear, each measured in its middle."""
    good = chosen.copy()
    points, piece = cut.middles(raw, chosen.nonzero()[0])
    good[chosen] = clear(points, raw.segment[piece], walls, radius)
    return good


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


def _rank(group: Rows) -> Rows:
    """Return each slice's rank within its group."""
    order = np.argsort(group, kind="stable")
    ordered = group[order]
    rank = np.empty(len(group), np.intp)
    rank[order] = np.arange(len(group)) - np.searchsorted(ordered, ordered)
    return rank
