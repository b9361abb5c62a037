"""Pairs: the pieces of a center path and of a surface that are near enough to matter to each other."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan, ulp

import numpy as np

from core.geometry.boxes import closest_pairs, near_pairs
from core.geometry.distance import between, nearest_places
from core.geometry.path import Floats, Rows
from core.geometry.piece_arrays import PieceArrays, blocks
from core.geometry.remembered import remembered
from core.tolerance import UNCUT
from core.verify.beside import NOBODY, Beside
from core.verify.course import Course
from core.verify.touch import Touches, touches
from core.verify.unproved import CLEAR, unproved_pairs


@dataclass(frozen=True, eq=False, slots=True)
class Pairs:
    """Pieces `i` of the center path and `j` of the surface, in rising order of i, and what is measured of both paths.

    Every pair whose pieces come within the reach it was made for is there, and no other, but for what `own` proves of
    own pieces, corners and their walls.  `touch` is what is measured of the pairs, `grant` (m,) what rounding and the
    uneven radii of arcs leave open for each.  `center_stations` and `surface_stations` are the lengths traveled at
    the pieces' starts and at the end.
    """

    center: PieceArrays
    surface: PieceArrays
    center_stations: Floats
    surface_stations: Floats
    center_boxes: Floats
    surface_boxes: Floats
    i: Rows
    j: Rows
    grant: Floats
    touch: Touches
    own: Beside


def pairs_of(
    center: Course,
    surface: Course,
    radius: float,
    reach: float,
    own: Beside = NOBODY,
) -> Pairs:
    """All pairs within `reach`.  Touches are those within `radius`."""
    moves, walls, exact = center.pieces, surface.pieces, granted(surface.pieces)
    if len(own.piece):
        i, j = unproved_pairs(moves, center.boxes, walls, surface.boxes, own, reach, radius + CLEAR * exact)
    else:
        i, j = near_pairs(center.boxes, surface.boxes, reach)
    grant = np.full(len(i), exact)
    for pieces, rows in ((moves, i), (walls, j)):
        if pieces.slack.any():
            grant += pieces.slack[rows]
    if 2 * len(i) > len(moves) + len(walls):
        center, surface = center.whole(), surface.whole()
    touch = touches(center, i, surface, j, radius, grant)
    # what is no number is kept, for the judge to see
    near = (~(touch.apart > reach)).nonzero()[0]
    if len(near) < len(i):
        i, j, grant, touch = i[near], j[near], grant[near], touch.take(near)
    stations, bounds = (center.stations, surface.stations), (center.boxes, surface.boxes)
    return Pairs(moves, walls, *stations, *bounds, i, j, grant, touch, own)


def granted(surface: PieceArrays) -> float:
    """What counts as exact: UNCUT, and four units in the last place of the largest coordinate or radius."""
    largest = max(np.abs(surface.start.view(np.float64)).max(), surface.radius.max())
    return UNCUT + 4.0 * ulp(largest)


@dataclass(frozen=True, eq=False, slots=True)
class Approaches:
    """The least distance among all pairs, infinite without any, and the pairs nearer than was asked for.

    Of these: places (8, m) on pieces `i` of the center path where they may be nearest to pieces `j`, how near they are
    there, and what each pair was asked for.  The least is no number if any distance is none.
    """

    least: float
    i: Rows
    j: Rows
    places: Floats
    apart: Floats
    limit: Floats


def approaches(pairs: Pairs, limit: float) -> Approaches:
    """All pairs nearer than `limit` less the slack of both."""
    measured = pairs.touch.apart.min(initial=np.inf)
    least = float(pairs.own.apart.min(initial=measured))
    if measured >= limit:
        return _none(least, pairs.i[:0])
    deep = (pairs.touch.apart < limit).nonzero()[0]
    near = measure(pairs, pairs.i[deep], pairs.j[deep], limit)
    least = near.least if isnan(near.least) else least
    return Approaches(least, near.i, near.j, near.places, near.apart, near.limit)


def measure(pairs: Pairs, i: Rows, j: Rows, limit: float) -> Approaches:
    """Of these pieces those nearer than `limit` less the slack of both."""
    if not len(i):
        return _none(np.inf, i)
    found = [
        _measure_block(pairs, i[block], j[block], limit)
        for block in blocks(pairs.center.arcs[i], pairs.surface.arcs[j])
    ]
    if len(found) == 1:
        return found[0]
    columns = zip(*((one.i, one.j, one.places, one.apart, one.limit) for one in found), strict=True)
    least = float(np.min([one.least for one in found]))
    return Approaches(least, *(np.concatenate(column, axis=-1) for column in columns))


def _none(least: float, nobody: Rows) -> Approaches:
    places = np.zeros((8, 0))
    return Approaches(least, nobody, nobody, places, places, places[0])


def _measure_block(pairs: Pairs, i: Rows, j: Rows, limit: float) -> Approaches:
    piece, other = pairs.center.take(i), pairs.surface.take(j)
    places, apart = _measured(piece, other)
    limits = limit - piece.slack - other.slack
    deep = (apart < limits).any(axis=0)
    return Approaches(float(apart.min()), i[deep], j[deep], places[:, deep], apart[:, deep], limits[deep])


@remembered
def _measured(piece: PieceArrays, other: PieceArrays) -> tuple[Floats, Floats]:
    """(8, m) places where the pieces may be nearest to their partners, and how far they are there."""
    places = nearest_places(piece, other)
    return places, between(piece, other, places)


def clearance(pairs: Pairs, near: Approaches, reach: float) -> float:
    """Least distance of the two paths, infinite if one is empty; `near` knows it if it is within `reach`."""
    if near.least <= reach or not len(pairs.center) or not len(pairs.surface):
        return near.least
    return measure(pairs, *closest_pairs(pairs.center_boxes, pairs.surface_boxes), 0.0).least
