"""What the best path is measured against: brute force distances, and every place on the cutter's side, one by one."""

from __future__ import annotations

from itertools import pairwise
from math import acos, ceil, pi, tau

import numpy as np
import shapely

from core.comp.best_path.best_path import BestPath, best_path
from core.geometry.path import Floats, Path
from core.geometry.piece import Arc, Line, Piece, Side

SHARES = np.array([0.0, 0.0731, 0.2683, 0.5, 0.6117, 0.8429, 1.0])
"""Where loops are looked at: both ends, the middle, and between."""

CLOSE = 1e-9
"""Agreement with what is found by hand."""

PLACES = np.array([0.0137, 0.0731, 0.2683, 0.4142, 0.6117, 0.8429, 0.9713])
"""Where a contour is looked at: shares that nothing is built on, for one place where the cutter fits is no path."""


def at(piece: Piece, shares: Floats) -> Floats:
    """Points (k, 2) at shares of a piece."""
    if isinstance(piece, Line):
        return piece.start + shares[:, None] * np.subtract(piece.end, piece.start)
    dx, dy = np.subtract(piece.start, piece.center)
    angle = np.arctan2(dy, dx) + shares * piece.sweep
    return piece.center + piece.radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)


def headings(piece: Piece, shares: Floats) -> Floats:
    """Unit tangents (k, 2) at shares of a piece."""
    if isinstance(piece, Line):
        along = np.subtract(piece.end, piece.start) / piece.length
        return np.repeat(along[None], len(shares), axis=0)
    radial = (at(piece, shares) - piece.center) / piece.radius
    return np.stack((-radial[:, 1], radial[:, 0]), axis=1) * int(piece.turn)


def away(piece: Piece, points: Floats) -> Floats:
    """Distance (k,) of points from a piece."""
    ends: Floats = np.minimum(np.hypot(*(points - piece.start).T), np.hypot(*(points - piece.end).T))
    if isinstance(piece, Line):
        span = np.subtract(piece.end, piece.start)
        share = np.clip((points - piece.start) @ span / max(span @ span, 1e-300), 0.0, 1.0)
        return np.asarray(np.hypot(*(points - piece.start - share[:, None] * span).T))
    towards, first = points - piece.center, np.subtract(piece.start, piece.center)
    angle = np.arctan2(towards[:, 1], towards[:, 0]) - np.arctan2(first[1], first[0])
    inside = np.mod(angle * int(piece.turn), tau) <= abs(piece.sweep)
    return np.asarray(np.where(inside, np.abs(np.hypot(*towards.T) - piece.radius), ends))


def distance(path: Path, points: Floats) -> Floats:
    """Least distance (k,) of points from all pieces of a path."""
    return np.asarray(np.min([away(piece, points) for piece in path], axis=0, initial=np.inf))


def sampled(path: Path) -> Floats:
    """Points all along a path."""
    return np.concatenate([at(piece, SHARES) for piece in path])


def from_loops(best: BestPath, points: Floats) -> Floats:
    """Least distance (k,) of points from all loops."""
    return np.asarray(np.min([np.full(len(points), np.inf), *(distance(loop, points) for loop in best.loops)], axis=0))


def candidates(contour: Path, side: Side, radius: float, *, closed: bool) -> Floats:
    """Places of the center at the radius from points of each segment on its side, and about each outside corner."""
    places = [np.empty((0, 2))]
    pieces = [piece for piece in contour if piece.length > 1e-7]
    for piece in pieces:
        if isinstance(piece, Arc) and piece.radius - int(piece.turn) * side.sign * radius < 1e-6:
            continue
        tangent = headings(piece, PLACES)
        normal = np.stack((-tangent[:, 1], tangent[:, 0]), axis=1) * side.sign
        places.append(at(piece, PLACES) + radius * normal)
    for before, behind in pairwise([*pieces, *(pieces[:1] if closed else ())]):
        places.append(behind.start + radius * _corner(before, behind, side))
    return np.concatenate(places)


def _corner(before: Piece, behind: Piece, side: Side) -> Floats:
    """Unit vectors (k, 2) across an outside corner, none at an inside one or at a reversal, which has its own tests."""
    one, two = headings(before, np.ones(1))[0], headings(behind, np.zeros(1))[0]
    bend = np.arctan2(one[0] * two[1] - one[1] * two[0], one @ two)
    if bend * side.sign >= -1e-6 or abs(bend) > pi - 1e-6:
        return np.empty((0, 2))
    angle = np.arctan2(one[0] * side.sign, -one[1] * side.sign) + PLACES * bend
    return np.stack((np.cos(angle), np.sin(angle)), axis=1)


def assert_true(contour: Path, side: Side, radius: float, *, closed: bool) -> BestPath:
    """The best path is clear of the contour, at the radius from it, whole, and leaves out no place."""
    best = best_path(contour, side, radius, closed=closed)
    codes = {finding.code for finding in best.findings}
    assert "BEST_BROKEN" not in codes
    assert bool(best.loops) != ("NO_PATH" in codes)
    for loop, ring in zip(best.loops, best.closed, strict=True):
        apart = distance(contour, sampled(loop))
        assert apart.min() > radius - 1e-7
        assert apart.max() < radius + 1e-7
        assert not ring or loop.points[0].tolist() == loop.points[-1].tolist()
    places = candidates(contour, side, radius, closed=closed)
    free = places[distance(contour, places) > radius - 1e-13]
    assert from_loops(best, free).max(initial=0.0) < 2e-6
    return best


def chords(path: Path, tolerance: float) -> Floats:
    """Points (k, 2) on a path whose chords leave it by no more than the tolerance."""
    points = [path.points[:1]]
    for piece in path:
        count = 1
        if isinstance(piece, Arc) and piece.radius > tolerance:
            count = max(2, ceil(abs(piece.sweep) / (2.0 * acos(1.0 - tolerance / piece.radius))))
        points.append(at(piece, np.arange(1, count + 1) / count))
    return np.concatenate(points)


def area(path: Path) -> float:
    """The area a closed path goes round, positive counter-clockwise: that of its chords and of the segments on them."""
    x, y = path.points.T
    under = 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    sweeps = path.sweeps
    return under + 0.5 * float(np.sum(path.radii**2 * (sweeps - np.sin(sweeps))))


def reached(contour: Path, side: Side, radius: float) -> shapely.Geometry:
    """Inside, the region the center may be in; outside, the one it may not: of a simple closed contour.

    Each chord is widened by itself: one buffer of thousands of short chords drops some of them.
    """
    ring = chords(contour, CHORD)
    polygon = shapely.Polygon(ring)
    segments = shapely.linestrings(np.stack((ring[:-1], ring[1:]), axis=1))
    band = shapely.union_all(shapely.buffer(segments, radius, quad_segs=QUADRANT))
    inside = (side is Side.LEFT) == polygon.exterior.is_ccw
    return polygon.difference(band) if inside else polygon.union(band)


CHORD = 2e-5
"""Millimeters that the reference's chords leave arcs by."""

QUADRANT = 48
"""Chords to a quarter of the reference's cutter: they leave it by the radius times 1 - cos(pi / 4 / 48) = 1.34e-4 r."""


def only(contour: Path, side: Side, radius: float, *, closed: bool = True) -> Path:
    """The one loop there is, of the same kind as the contour."""
    best = assert_true(contour, side, radius, closed=closed)
    assert best.closed == (closed,)
    return best.loops[0]
