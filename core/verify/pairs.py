"""Pairs: the pieces of a centre path and of a surface that are near enough to matter to each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.boxes import closest_pairs, near_pairs
from core.geometry.distance import between, distance, nearest_places
from core.geometry.measured import Floats, Measured, Rows, at, boxes
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


def pairs_of(centre: Measured, surface: Measured, reach: float) -> Pairs:
    """All pairs within `reach`, by their bounding boxes."""
    around, along = boxes(centre), boxes(surface)
    i, j = near_pairs(around, along, reach)
    return Pairs(centre, surface, centre.stations, surface.stations, around, along, i, j)


def middles(pairs: Pairs) -> Floats:
    """(m,) distance from the middle of each pair's piece of the centre path to its piece of the surface."""
    half = np.full(len(pairs.i), 0.5)
    return distance(pairs.surface.take(pairs.j), at(pairs.centre.take(pairs.i), half))


@dataclass(frozen=True, eq=False, slots=True)
class Approaches:
    """Places (8, m) on pieces `i` of the centre path where they may be nearest to pieces `j`, and how near they are."""

    i: Rows
    j: Rows
    places: Floats
    apart: Floats

    @property
    def least(self) -> float:
        """The least of all distances, infinite without pairs."""
        return float(self.apart.min()) if self.apart.size else np.inf


def approaches(pairs: Pairs, middle: Floats, radius: float) -> Approaches:
    """The pairs that may be nearer than the radius, or nearest of all; `middle` as of `middles`.

    A piece is nowhere nearer than its middle less half its length.
    """
    if not len(pairs.i):
        return _measure(pairs, pairs.i, pairs.j)
    limit = max(radius, float(middle.min()) + GOUGE)
    keep = middle - pairs.centre.length[pairs.i] / 2.0 < limit
    return _measure(pairs, pairs.i[keep], pairs.j[keep])


def _measure(pairs: Pairs, i: Rows, j: Rows) -> Approaches:
    piece, other = pairs.centre.take(i), pairs.surface.take(j)
    places = nearest_places(piece, other)
    return Approaches(i, j, places, between(piece, other, places))


def clearance(pairs: Pairs, near: Approaches, reach: float) -> float:
    """Least distance of the two paths, infinite if one is empty; `near` knows it if it is within `reach`."""
    if near.least <= reach or not len(pairs.centre) or not len(pairs.surface):
        return near.least
    return _measure(pairs, *closest_pairs(pairs.centre_boxes, pairs.surface_boxes)).least
