"""Finds which closed contours lie inside which, which of them cross, and the areas and boxes of contours.

Areas, boxes and crossings of a contour with itself are exact.  Nesting and crossings with others are tested on chords
that deviate from the arcs by no more than `CHORD_ERROR` millimeters.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
import shapely

from core.geometry.path import Floats, Path, chords_of
from core.geometry.path_parts import parts_of
from core.geometry.piece import Piece, signed_area
from core.geometry.piece_arrays import piece_arrays
from core.verify.self_crossings import self_crossings

Box = tuple[float, float, float, float]
"""Left, bottom, right and top."""
CHORD_ERROR: Final = 0.005


def box_of(pieces: Sequence[Piece]) -> Box:
    """Return the box of pieces."""
    # what links the parts of a path lies within their box
    left, bottom, right, top = parts_of([piece] for piece in pieces).path.boxes
    return float(left.min()), float(bottom.min()), float(right.max()), float(top.max())


def containers(chains: Sequence[Sequence[Piece]]) -> list[list[int]]:
    """Return for each closed chain the indexes (from 0) of the chains it lies inside."""
    if not chains:
        return []
    polygons = [_polygon(chords_of(Path.from_pieces(chain), CHORD_ERROR)) for chain in chains]
    sizes = [abs(signed_area(chain)) for chain in chains]
    tree = shapely.STRtree(polygons)
    # a point of the chain itself may lie on another one that it touches
    points = shapely.point_on_surface(polygons)
    inside: list[list[int]] = [[] for _ in chains]
    for inner, outer in tree.query(points, predicate="within").T.tolist():
        # a chain does not lie in itself, and never in a smaller one
        if inner != outer and (sizes[outer], -outer) > (sizes[inner], -inner):
            inside[inner].append(outer)
    return inside


def _polygon(points: Floats) -> shapely.Geometry:
    """Return the polygon of points; one that crosses itself becomes what it encloses by the even-odd rule."""
    if len(points) < 4:
        return shapely.Polygon()
    polygon: shapely.Geometry = shapely.polygons(points)
    return polygon if polygon.is_valid else shapely.make_valid(polygon)


def crossings(chains: Sequence[Sequence[Piece]], most: int) -> dict[int, int]:
    """Return, by index, the first chain that each chain touches or crosses; nothing for more than `most` chains."""
    if not chains or len(chains) > most:
        return {}
    lines = [shapely.LineString(chords_of(Path.from_pieces(chain), CHORD_ERROR)) for chain in chains]
    pairs = shapely.STRtree(lines).query(lines, predicate="intersects").T.tolist()
    met: dict[int, int] = {}
    for first, second in sorted(pairs):
        if first != second:
            met.setdefault(first, second)
    return met


def crosses_itself(chain: Sequence[Piece]) -> bool:
    """True if a closed chain meets itself away from its joints."""
    if len(chain) < 2:
        return False
    # the exact formulas are evaluated where they do not apply too
    with np.errstate(all="ignore"):
        return len(self_crossings(piece_arrays(Path.from_pieces(chain)), closed=True)) > 0
