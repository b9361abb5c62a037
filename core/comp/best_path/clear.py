"""Clear: is the cutter, its center at a point, nowhere nearer to the surface than its radius?"""

from __future__ import annotations

import numpy as np

from core.comp.best_path.surface import Surface
from core.comp.best_path.tree import near, tree
from core.geometry.path import Flags, Floats, Path, Points, Rows, Turns, as_complex
from core.tolerance import CLEAR


def clear(surface: Surface, points: Points, segments: Rows, radius: float) -> Flags:
    """(k,) which points are no nearer to any piece of the surface than the radius, within CLEAR.

    `segments` (k,) are the pieces the points were offset from: most points that are not clear are too near to a joint
    not far from there.
    """
    found = _clear_nearby(surface.path, points, segments, radius)
    rows = found.nonzero()[0]
    spots = points[rows]
    for i, j in near(tree(np.array((spots.real, spots.imag, spots.real, spots.imag))), surface.walls, radius):
        some = found[rows[i]].nonzero()[0]
        i, j = rows[i[some]], j[some]
        found[i[distances(surface.path, j, points[i]) < radius - CLEAR]] = False
    return found


def _clear_nearby(surface: Path, points: Points, segments: Rows, radius: float) -> Flags:
    """Which points are clear of the joints 1, 2, 4, 8 ... segments ahead and behind, as far as any of those is near."""
    found = np.ones(len(points), np.bool_)
    joints, step, near_some = as_complex(surface.points), 1, True
    while near_some and step < len(surface):
        near_some = False
        for shift in (step, -step):
            rows = found.nonzero()[0]
            joint = joints[np.minimum(np.maximum(segments[rows] + shift, 0), len(surface))]
            apart = np.abs(points[rows] - joint)
            found[rows[apart < radius - CLEAR]] = False
            near_some |= bool((apart < 2.0 * radius).any())
        step *= 2
    return found


def distances(surface: Path, rows: Rows, points: Points) -> Floats:
    """(k,) least distances of points from pieces of a path."""
    ends = as_complex(surface.points)
    start, end = ends[rows], ends[rows + 1]
    arcs = surface.turns[rows].nonzero()[0]
    span, to = end - start, points - start
    square = span.real * span.real + span.imag * span.imag
    part = (span.real * to.real + span.imag * to.imag) / np.where(square == 0.0, 1.0, square)
    found: Floats = np.abs(to - np.minimum(np.maximum(part, 0.0), 1.0) * span)
    if len(arcs):
        center, turn = as_complex(surface.centers)[rows[arcs]], surface.turns[rows[arcs]]
        found[arcs] = _arc_distances(start[arcs] - center, end[arcs] - center, turn, points[arcs] - center)
    return found


def _arc_distances(first: Points, last: Points, turn: Turns, radial: Points) -> Floats:
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
