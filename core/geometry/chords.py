"""Chords: a path as a polyline, for shapely to cut or to measure roughly."""

from __future__ import annotations

from math import acos, ceil, isfinite, pi

import numpy as np

from core.geometry.path import Floats, Path, as_complex, coordinates


def chords_of(path: Path, sag: float) -> Floats:
    """Return the (m, 2) points of a path whose arcs are replaced by chords no farther than `sag` (mm) from them."""
    if not len(path):
        return np.empty((0, 2))
    counts = [
        _count(sweep, radius, sag) for sweep, radius in zip(path.sweeps.tolist(), path.radii.tolist(), strict=True)
    ]
    row = np.arange(len(path)).repeat(counts)
    nth = np.arange(len(row)) - (np.cumsum(counts) - counts)[row]
    part = nth / np.asarray(counts)[row]
    starts, ends, centers = (as_complex(points)[row] for points in (path.starts, path.ends, path.centers))
    turned = centers + (starts - centers) * np.exp(1j * path.sweeps[row] * part)
    points = np.where(path.turns[row] != 0, turned, starts + (ends - starts) * part)
    return np.concatenate([coordinates(points), path.points[-1:]])


def _count(sweep: float, radius: float, sag: float) -> int:
    """Return the number of chords of an arc; 1 for a line."""
    if not sweep or not isfinite(radius) or radius <= sag:
        return 1
    return max(ceil(abs(sweep) / min(2.0 * acos(1.0 - sag / radius), pi / 4)), 1)
