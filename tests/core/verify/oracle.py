"""A second opinion: dense points and plain loops, sharing nothing with the code under test."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, ceil, cos, hypot, sin, sqrt, tau

import numpy as np
from numpy.typing import NDArray
from shapely import LineString

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece

Points = NDArray[np.float64]


def swept(arc: Arc) -> float:
    """Unsigned angle traveled."""
    if arc.start == arc.end:
        return tau
    first = atan2(arc.start[1] - arc.center[1], arc.start[0] - arc.center[0])
    last = atan2(arc.end[1] - arc.center[1], arc.end[0] - arc.center[0])
    angle = ((last - first) * int(arc.turn)) % tau
    return 0.0 if angle > tau - 1e-9 else angle


def length(piece: Piece) -> float:
    if isinstance(piece, Line):
        return hypot(piece.end[0] - piece.start[0], piece.end[1] - piece.start[1])
    return hypot(piece.start[0] - piece.center[0], piece.start[1] - piece.center[1]) * swept(piece)


def along(piece: Piece, shares: Points) -> Points:
    """(k, 2) points at shares of the piece's length."""
    if isinstance(piece, Line):
        start, end = np.array(piece.start), np.array(piece.end)
        return np.asarray(start + shares[:, None] * (end - start))
    first = atan2(piece.start[1] - piece.center[1], piece.start[0] - piece.center[0])
    angle = first + int(piece.turn) * swept(piece) * shares
    radius = hypot(piece.start[0] - piece.center[0], piece.start[1] - piece.center[1])
    return np.asarray(np.array(piece.center) + radius * np.stack((np.cos(angle), np.sin(angle)), axis=1))


def apart(points: Points, path: Path) -> Points:
    """(k,) distance of each point from the nearest piece."""
    return np.asarray(np.min([_apart(points, piece) for piece in path], axis=0))


def _apart(points: Points, piece: Piece) -> Points:
    to_ends = np.minimum(*(np.hypot(*(points - np.array(end)).T) for end in (piece.start, piece.end)))
    if isinstance(piece, Line):
        way = np.array(piece.end) - np.array(piece.start)
        size = hypot(*way)
        if size == 0.0:
            return np.asarray(to_ends)
        off = points - np.array(piece.start)
        share = off @ way / size**2
        foot = np.abs(off[:, 0] * way[1] - off[:, 1] * way[0]) / size
        return np.asarray(np.where((share > 0) & (share < 1), foot, to_ends))
    radius = hypot(piece.start[0] - piece.center[0], piece.start[1] - piece.center[1])
    half = swept(piece) / 2
    first = atan2(piece.start[1] - piece.center[1], piece.start[0] - piece.center[0]) + int(piece.turn) * half
    middle = np.array((cos(first), sin(first)))
    radial = points - np.array(piece.center)
    opposite = np.arctan2(np.abs(radial[:, 0] * middle[1] - radial[:, 1] * middle[0]), radial @ middle)
    return np.asarray(np.where(opposite <= half, np.abs(np.hypot(*radial.T) - radius), to_ends))


def samples(path: Path, step: float) -> tuple[Points, Points]:
    """Points along the whole path no farther apart than `step`, and the length of path each stands for."""
    points, weights = [], []
    for piece in path:
        size = length(piece)
        count = max(2, int(np.ceil(size / step)))
        points.append(along(piece, (np.arange(count) + 0.5) / count))
        weights.append(np.full(count, size / count))
    return np.concatenate(points), np.concatenate(weights)


def least(path: Path, other: Path, step: float) -> float:
    """Least distance of two paths, too large by less than half a step."""
    points, _ = samples(path, step)
    ends = np.concatenate([along(piece, np.array((0.0, 1.0))) for piece in path])
    return float(apart(np.concatenate((points, ends)), other).min())


def length_near(path: Path, other: Path, radius: float, step: float) -> float:
    """Length of path nearer to the other than the radius, in steps."""
    points, weights = samples(path, step)
    return float(weights[apart(points, other) < radius].sum())


def extreme(path: Path, other: Path, step: float, sign: float) -> float:
    """The largest (sign 1) or least (-1) distance from path to other: dense points, then denser about the best ones."""
    return sign * _largest(path, lambda points: apart(points, other) * sign, step)


def deepest(path: Path, outline: Path, step: float, *, room_inside: bool) -> float:
    """How far behind a closed outline a path gets; negative if it does not, by how far it keeps off."""
    return _largest(path, lambda points: behind(points, outline, room_inside=room_inside), step)


def behind(points: Points, outline: Path, *, room_inside: bool) -> Points:
    """(k,) distances of points from a closed outline, negative for those in the room of the cutter."""
    return np.asarray(apart(points, outline) * np.where(encloses(outline, points) == room_inside, -1.0, 1.0))


def _largest(path: Path, value: Callable[[Points], Points], step: float) -> float:
    found = []
    for piece in path:
        count = max(2, int(np.ceil(length(piece) / step)))
        shares = np.linspace(0.0, 1.0, count + 1)
        values = value(along(piece, shares))
        found.append((float(values.max()), piece, float(shares[values.argmax()]), 1.0 / count))
    found.sort(key=lambda one: -one[0])
    return max(_closer(piece, value, share, width) for _, piece, share, width in found[:4])


def _closer(piece: Piece, value: Callable[[Points], Points], share: float, width: float) -> float:
    for _ in range(5):
        shares = np.clip(np.linspace(share - width, share + width, 41), 0.0, 1.0)
        values = value(along(piece, shares))
        share, width = float(shares[values.argmax()]), width / 15.0
    return float(values.max())


def encloses(outline: Path, points: Points) -> NDArray[np.bool_]:
    """(k,) whether a closed outline runs round each point, by the angle it turns as seen from there.

    An arc turns by as much as its chord, and once more about what lies between the two.
    """
    turned = np.zeros(len(points))
    for piece in outline:
        first, last = np.array(piece.start) - points, np.array(piece.end) - points
        cross = first[:, 0] * last[:, 1] - first[:, 1] * last[:, 0]
        turned += np.arctan2(cross, (first * last).sum(axis=1)) * (piece.start != piece.end)
        if isinstance(piece, Arc):
            near = np.hypot(*(points - np.array(piece.center)).T) < hypot(*np.subtract(piece.start, piece.center))
            beyond = (cross * int(piece.turn) < 0.0) | (piece.start == piece.end)
            turned += tau * int(piece.turn) * (near & beyond)
    return np.asarray(np.abs(turned) > 3.0)


def turning(path: Path) -> float:
    """Twice the area inside a closed path, positive counter-clockwise, by the polygon of dense points."""
    x, y = samples(path, 0.05)[0].T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def inside(path: Path, outline: Path, step: float) -> bool:
    """Most of a path's points that are clear of a closed outline are inside it."""
    points, _ = samples(path, 20.0 * step)
    points = points[apart(points, outline) > 0.05]
    return bool(len(points)) and float(np.mean(encloses(outline, points))) > 0.5


CHORD = 1e-5
"""Millimeters between an arc and its chords."""


def chords(path: Path) -> LineString:
    """The path as a polyline no farther than CHORD from it."""
    spots = [path.points[:1]]
    for piece, radius in zip(path, path.radii.tolist(), strict=True):
        step = sqrt(8.0 * CHORD * max(radius, CHORD))
        count = 1 if isinstance(piece, Line) else max(2, ceil(length(piece) / step))
        spots.append(along(piece, np.arange(1, count + 1) / count))
    return LineString(np.concatenate(spots))
