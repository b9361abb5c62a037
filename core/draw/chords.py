"""Pieces of paths as short straight chords inside a window, vectorised.

Window coordinates: the window's center is 0, a cell is 1 wide and `TALL` high, the second axis points up.  A point is
one complex number here, which numpy gathers twice as fast as a pair.  Arcs are cut down to the part near the window
before they are divided, so that no zoom makes them expensive.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, tau
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.scene import BEYOND, Arcs, Gathered, Pieces
from core.draw.view import TALL, View
from core.geometry.path import Floats, Turns, coordinates

SAG: Final = 0.1
"""How far a chord may stray from its arc, in cells' widths: less than half a dot of the finest mode."""
STEP: Final = tau / 8
"""The most a chord turns, in radians."""
SHORT: Final = 0.25
"""An arc shorter than this, in cells' widths, is its own chord: half a dot of the finest mode."""
CONCENTRIC: Final = 1e-9
"""An arc about the window's center is all in sight or all out of it; this keeps the division finite."""

Points = NDArray[np.complex128]
Rows = NDArray[np.intp]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Chords:
    """m chords in window coordinates, ordered by `layers` (m,): each from `starts` by `runs` (m,).

    `along` (m,) is the length traveled on the layer's path up to the chord's start, in cells' widths.
    """

    starts: Points
    runs: Points
    layers: Rows
    along: Floats

    def only(self, keep: Rows) -> Chords:
        """These chords, by their numbers."""
        return Chords(self.starts[keep], self.runs[keep], self.layers[keep], self.along[keep])


@dataclass(frozen=True, eq=False, slots=True)
class _Arcs:
    """k arcs (k,) in window coordinates: the `rows` of their pieces, and the directions in which they `begin`."""

    rows: Rows
    centers: Points
    turns: Turns
    sweeps: Floats
    radii: Floats
    begin: Floats

    def only(self, keep: Rows) -> _Arcs:
        """These arcs, by their numbers."""
        rows, centers, turns = self.rows[keep], self.centers[keep], self.turns[keep]
        return _Arcs(rows, centers, turns, self.sweeps[keep], self.radii[keep], self.begin[keep])


def chords(gathered: Gathered, view: View, columns: int, rows: int) -> Chords:
    """The chords of all layers' pieces that may touch the window of columns x rows cells.

    A layer is known by its index among those of `gathered`.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        pieces, given, along = _near(gathered, view)
        points, arcs = _in_window(pieces.points, view), _arcs(given, view)
    starts = points[pieces.rows]
    every = Chords(starts, points[pieces.rows + 1] - starts, pieces.layers, along / view.scale)
    if not len(arcs.rows):
        return every
    return _replaced(every, arcs.rows, _divided(arcs, every, hypot(columns / 2, rows * TALL / 2) + 1.0))


def _replaced(every: Chords, arcs: Rows, bent: Chords) -> Chords:
    """All chords in the order of their layers, with those of `arcs` replaced by `bent` ones."""
    layers = np.concatenate((every.layers, bent.layers))
    # what is replaced is sorted behind all layers
    layers[arcs] = every.layers[-1] + 1
    starts, runs = np.concatenate((every.starts, bent.starts)), np.concatenate((every.runs, bent.runs))
    found = Chords(starts, runs, layers, np.concatenate((every.along, bent.along)))
    return found.only(layers.argsort(kind="stable")[: len(layers) - len(arcs)])


def _near(gathered: Gathered, view: View) -> tuple[Pieces, Arcs, Floats]:
    """The pieces that are drawn at all, the arcs among them, and how far each is along its path, in millimeters."""
    pieces, arcs, along, center = gathered.pieces, gathered.arcs, _traveled(gathered), complex(*view.center)
    reach = BEYOND - abs(center)
    # a comparison with what is not a number is false
    if _farthest(pieces.points) <= reach and _farthest(arcs.centers) <= reach:
        return pieces, arcs, along
    near = _within(pieces.points - center)
    shown = near[pieces.rows] & near[pieces.rows + 1] & np.isfinite(along)
    shown[arcs.rows] &= _within(arcs.centers - center)
    keep = shown.nonzero()[0]
    pieces = pieces.only(keep)
    return pieces, pieces.arcs, along[keep]


def _farthest(points: Points) -> float:
    """The largest coordinate, whatever its sign."""
    return float(np.abs(coordinates(points)).max(initial=0.0))


def _within(points: Points) -> Mask:
    """(n,) which points are drawn at all."""
    within: Mask = (np.abs(points.real) <= BEYOND) & (np.abs(points.imag) <= BEYOND)
    return within


def _in_window(points: Points, view: View) -> Points:
    window: Points = points - complex(*view.center)
    window /= view.scale
    return window


def _traveled(gathered: Gathered) -> Floats:
    """(n,) millimeters from its path's start to each piece of a dashed layer.

    Where only parts of a path are drawn each piece's dashes begin with it.
    """
    owners = gathered.pieces.layers
    along = np.zeros(len(owners))
    for index, layer in enumerate(gathered.layers):
        if layer.dashed and layer.own is None and len(layer.path) > 1:
            lengths, first = layer.path.lengths, int(np.searchsorted(owners, index))
            along[first : first + len(lengths)] = np.cumsum(lengths) - lengths
    return along


def _arcs(given: Arcs, view: View) -> _Arcs:
    """The arcs in window coordinates, without those shorter than SHORT: these are lines here."""
    radii, keep = given.radii / view.scale, (given.radii * given.sweeps > SHORT * view.scale).nonzero()[0]
    centers = _in_window(given.centers, view)
    return _Arcs(given.rows, centers, given.turns, given.sweeps, radii, given.begin).only(keep)


def _divided(arcs: _Arcs, pieces: Chords, reach: float) -> Chords:
    """Chords of arcs among the pieces within `reach` of the window's center."""
    arcs, low, span = _visible(arcs, reach)
    counts = np.ceil(span / np.minimum(np.sqrt(8.0 * SAG / np.maximum(arcs.radii, SAG)), STEP)).astype(np.intp)
    pace = span / np.maximum(counts, 1)
    arc = np.arange(len(counts)).repeat(counts)
    nth = np.arange(len(arc)) - (counts.cumsum() - counts)[arc]
    turned, turns, radii, piece = low[arc] + nth * pace[arc], arcs.turns, arcs.radii[arc], arcs.rows[arc]
    starts = radii * np.exp(1j * (arcs.begin[arc] + turns[arc] * turned))
    runs = starts * (np.exp(1j * turns * pace) - 1.0)[arc]
    return Chords(arcs.centers[arc] + starts, runs, pieces.layers[piece], pieces.along[piece] + turned * radii)


def _visible(arcs: _Arcs, reach: float) -> tuple[_Arcs, Floats, Floats]:
    """m parts of arcs that run within `reach` of the window's center: (m,) the angle traveled to each, and its own.

    The circle meets the disc of that reach symmetrically about the direction to the window's center, over a half
    angle h with sin^2(h / 2) = (reach^2 - (d - r)^2) / (4 d r), d being the distance of the two centers.
    """
    distance, radii, sweeps = np.abs(arcs.centers), arcs.radii, arcs.sweeps
    if (distance + radii).max() <= reach:
        return arcs, np.zeros(len(sweeps)), sweeps
    within = reach * reach - (distance - radii) ** 2
    part = np.minimum(np.maximum(within / np.maximum(4.0 * distance * radii, CONCENTRIC), 0.0), 1.0)
    whole, hidden = part >= 1.0, within <= 0.0
    half = 2.0 * np.arcsin(np.sqrt(part))
    middle = np.mod((np.angle(-arcs.centers) - arcs.begin) * arcs.turns, tau)
    turned = np.array([[-tau], [0.0], [tau]])
    low = np.maximum(middle - half + turned, 0.0)
    high = np.minimum(middle + half + turned, sweeps)
    low[:, whole], high[:, whole | hidden] = 0.0, 0.0
    high[1] = np.where(whole & ~hidden, sweeps, high[1])
    shown, arc = np.nonzero(high > low)
    return arcs.only(arc), low[shown, arc], (high - low)[shown, arc]
