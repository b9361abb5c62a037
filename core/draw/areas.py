"""Areas: the material that the cutter gouges from the part and leaves on the wall, as regions to shade.

They are only drawn: arcs are chords here, off by no more than half a dot, and shapely cuts the regions.
`core.verify` decides what is gouged and uncut.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import isfinite
from typing import Final

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import LineString, MultiPolygon, Polygon, box
from shapely.geometry.base import BaseGeometry

from core.geometry.path import Floats, Path, chords_of
from core.geometry.piece import Side

EMPTY_REGION: Final = MultiPolygon()
CHORDS_PER_QUARTER: Final = 16
"""Chords per quarter circle at the ends of a swept region."""
OUTSIDE_THICKNESS_RADII: Final = 4.0
"""Thickness of the material drawn outside a closed contour whose outside is the part, in tool radii."""
OPEN_THICKNESS_RADII: Final = 2.0
"""Thickness of the material drawn behind an open contour, in tool radii: no gouge is reported deeper."""
MAX_STRETCHES: Final = 200
"""Uncut stretches that are shaded, the thickest first."""


def material(surface: Path, side: Side, radius: float, *, closed: bool, sag: float) -> BaseGeometry:
    """Return the part behind a surface, as far as a cutter of this radius can reach into it."""
    points = chords_of(surface, sag)
    if len(points) < 2 or (closed and len(points) < 4):
        return EMPTY_REGION
    if not closed:
        return _strip_along(
            points, -OPEN_THICKNESS_RADII * radius if side is Side.LEFT else OPEN_THICKNESS_RADII * radius
        )
    inside = shapely.make_valid(Polygon(points))
    x, y = points.T
    counterclockwise = bool((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() > 0.0)
    if counterclockwise is not (side is Side.LEFT):
        return inside
    return box(*inside.buffer(OUTSIDE_THICKNESS_RADII * radius).bounds).difference(inside)


def _strip_along(points: Floats, distance: float) -> BaseGeometry:
    """Return the strip along a line up to a distance (mm), on its left if that is positive.

    Shapely fails on some lines that cross themselves: the strip is then the union of each chord's own strip, without
    the wedges at corners.
    """
    try:
        return LineString(points).buffer(distance, single_sided=True)
    except shapely.GEOSException:
        return shapely.union_all([LineString(chord).buffer(distance, single_sided=True) for chord in pairwise(points)])


def swept(paths: Sequence[Path], radius: float, sag: float) -> BaseGeometry:
    """Return the region that a cutter of this radius sweeps on its paths."""
    lines = [LineString(points).simplify(sag / 2.0) for path in paths if len(points := chords_of(path, sag)) > 1]
    return shapely.union_all([line.buffer(max(radius, 0.0), quad_segs=CHORDS_PER_QUARTER) for line in lines])


def gouged(part: BaseGeometry, paths: Sequence[Path], radius: float, sag: float) -> BaseGeometry:
    """Return the region of the part that the cutter gouges; a depth below `sag` (mm) is not shaded."""
    return swept(paths, radius - sag, sag).intersection(part)


def uncut(
    part: BaseGeometry,
    stretches: Iterable[Path],
    thicknesses: Iterable[float],
    paths: Sequence[Path],
    radius: float,
    sag: float,
) -> BaseGeometry:
    """Return the region that the cutter leaves on stretches of the surface, each as thick as it was judged; stretches
    thinner than `sag` are not shaded."""
    pairs = [
        (depth, path) for path, depth in zip(stretches, thicknesses, strict=True) if isfinite(depth) and depth > sag
    ]
    pairs.sort(key=lambda pair: -pair[0])
    bands = shapely.union_all(
        [
            LineString(points).buffer(depth + sag, quad_segs=CHORDS_PER_QUARTER)
            for depth, path in pairs[:MAX_STRETCHES]
            if len(points := chords_of(path, sag)) > 1
        ]
    )
    return bands.difference(part).difference(swept(paths, radius, sag))


def inside(region: BaseGeometry, x: Floats, y: Floats) -> NDArray[np.bool_]:
    """Return (n,) True for points in the region."""
    shapely.prepare(region)
    within: NDArray[np.bool_] = shapely.contains_xy(region, x, y)
    return within
