"""Pairs: the pieces of a centre path and of a surface that are near enough to matter to each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.boxes import closest_pairs, near_pairs
from core.geometry.distance import between, distance, nearest_places
from core.geometry.measured import Floats, Measured, Rows, at, blocks, boxes
from core.tolerance import GOUGE


@dataclass(frozen=True, eq=False, slots=True)
class Pairs:
    """Pieces `i` of the centre path and `j` of the surface, in rising order of i, and what is measured of both paths.

    Every pair whose pieces come within the reach it was made for is there; pairs farther apart may be.
    `centre_stations` and `surface_stations` are the lengths travelled at the pieces' starts and at the end.
    """

    centre: Measured
    surface: Measured
    centre_stations: Floats
    surface_stations: Floats
    centre_boxes: Floats
    surface_boxes: Floats
    i: Rows
    j: Rows

    @property
    def slack(self) -> Floats:
        """(m,) what the uneven radii of arcs leave open for each pair."""
        return self.centre.slack[self.i] + self.surface.slack[self.j]


def pairs_of(centre: Measured, surface: Measured, stations: Floats, bounds: Floats, reach: float) -> Pairs:
    """All pairs within `reach`, by their bounding boxes; `stations` and `bounds` are the surface's."""
    around = boxes(centre)
    i, j = near_pairs(around, bounds, reach)
    return Pairs(centre, surface, centre.stations, stations, around, bounds, i, j)


def middles(pairs: Pairs) -> Floats:
    """(m,) distance from the middle of each pair's piece of the centre path to its piece of the surface."""
    return middle_distances(pairs.centre, pairs.i, pairs.surface, pairs.j)


def middle_distances(pieces: Measured, i: Rows, others: Measured, j: Rows) -> Floats:
    """(m,) distance from the middle of pieces `i` to their partners `j`."""
    middle = at(pieces, np.full(len(pieces), 0.5))
    apart, arcs = np.empty(len(i)), others.arcs[j]
    for block in blocks(arcs, arcs):
        apart[block] = distance(others.take(j[block]), middle[i[block]])
    return apart


@dataclass(frozen=True, eq=False, slots=True)
class Approaches:
    """The least distance among all pairs, infinite without any, and the pairs nearer than was asked for.

    Of these: places (8, m) on pieces `i` of the centre path where they may be nearest to pieces `j`, how near they are
    there, and what each pair was asked for.
    """

    least: float
    i: Rows
    j: Rows
    places: Floats
    apart: Floats
    limit: Floats


def approaches(pairs: Pairs, middle: Floats, limit: float) -> Approaches:
    """All pairs nearer than `limit` less their slack; `middle` as of `middles`.

    A piece is nowhere nearer than its middle less half its length.
    """
    reach = max(limit, float(middle.min(initial=np.inf)) + GOUGE)
    chosen = np.flatnonzero(middle - pairs.centre.length[pairs.i] / 2.0 < reach)
    return _measure(pairs, pairs.i[chosen], pairs.j[chosen], limit)


def _measure(pairs: Pairs, i: Rows, j: Rows, limit: float) -> Approaches:
    found = [
        _measure_block(pairs, i[block], j[block], limit)
        for block in blocks(pairs.centre.arcs[i], pairs.surface.arcs[j])
    ]
    if not found:
        none = np.zeros((8, 0))
        return Approaches(np.inf, i, j, none, none, none[0])
    columns = zip(*((one.i, one.j, one.places, one.apart, one.limit) for one in found), strict=True)
    return Approaches(min(one.least for one in found), *(np.concatenate(column, axis=-1) for column in columns))


def _measure_block(pairs: Pairs, i: Rows, j: Rows, limit: float) -> Approaches:
    piece, other = pairs.centre.take(i), pairs.surface.take(j)
    places = nearest_places(piece, other)
    apart = between(piece, other, places)
    limits = limit - piece.slack - other.slack
    deep = (apart < limits).any(axis=0)
    return Approaches(float(apart.min()), i[deep], j[deep], places[:, deep], apart[:, deep], limits[deep])


def clearance(pairs: Pairs, near: Approaches, reach: float) -> float:
    """Least distance of the two paths, infinite if one is empty; `near` knows it if it is within `reach`."""
    if near.least <= reach or not len(pairs.centre) or not len(pairs.surface):
        return near.least
    return _measure(pairs, *closest_pairs(pairs.centre_boxes, pairs.surface_boxes), 0.0).least
