"""Clear: is the cutter, its centre at a point, nowhere nearer to the surface than its radius?"""

from __future__ import annotations

import numpy as np

from core.comp.best_tree import near, piece_boxes, tree
from core.geometry.intersect import Indices, Masks, Planes, planes
from core.geometry.path import Floats, Path, Turns
from core.tolerance import CLEAR


def clear(surface: Path, points: Planes, radius: float) -> Masks:
    """(k,) which points are no nearer to any piece of the surface than the radius, within CLEAR."""
    ends, centres, turns = planes(surface.points), planes(surface.centres), surface.turns
    walls = tree(piece_boxes(ends[:-1], ends[1:], centres, turns, 0.0))
    spots = tree(np.array((points.real, points.imag, points.real, points.imag)))
    found = np.ones(len(points), np.bool_)
    for i, j in near(spots, walls, radius):
        rows = np.flatnonzero(found[i])
        i, j = i[rows], j[rows]
        found[i[distances(surface, j, points[i]) < radius - CLEAR]] = False
    return found


def distances(surface: Path, rows: Indices, points: Planes) -> Floats:
    """(k,) least distances of points from pieces of a path."""
    ends = planes(surface.points)
    start, end = ends[rows], ends[rows + 1]
    arcs = np.flatnonzero(surface.turns[rows])
    span, to = end - start, points - start
    square = span.real * span.real + span.imag * span.imag
    part = (span.real * to.real + span.imag * to.imag) / np.where(square == 0.0, 1.0, square)
    found: Floats = np.abs(to - np.clip(part, 0.0, 1.0) * span)
    if len(arcs):
        centre, turn = planes(surface.centres)[rows[arcs]], surface.turns[rows[arcs]]
        found[arcs] = _arc_distances(start[arcs] - centre, end[arcs] - centre, turn, points[arcs] - centre)
    return found


def _arc_distances(first: Planes, last: Planes, turn: Turns, radial: Planes) -> Floats:
    """Distances from arcs about the origin: radially inside their sector, else to the nearer end.

    Being inside is decided by cross products: with both ends' rays for an arc under a half turn, with either above it.
    """
    inside_first = (first.conj() * radial).imag * turn >= 0.0
    inside_last = (radial.conj() * last).imag * turn >= 0.0
    minor = (first.conj() * last).imag * turn > 0.0
    inside = np.where(minor, inside_first & inside_last, inside_first | inside_last) | (first == last)
    ends = np.minimum(np.abs(radial - first), np.abs(radial - last))
    found: Floats = np.where(inside, np.abs(np.abs(radial) - np.abs(first)), ends)
    return found
