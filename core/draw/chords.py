"""Pieces of paths as short straight chords inside a window, vectorised.

Window coordinates: the window's centre is 0, a cell is 1 wide and `TALL` high, the second axis points up.  A point is
one complex number here, which numpy gathers twice as fast as a pair.  Arcs are cut down to the part near the window
before they are divided, so that no zoom makes them expensive.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, tau
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.scene import BEYOND, Layer, Pieces, gathered
from core.draw.view import TALL, View
from core.geometry.path import Floats, Turns, swept
from core.records import dataclass

SAG: Final = 0.1
"""How far a chord may stray from its arc, in cells' widths: less than half a dot of the finest mode."""
STEP: Final = tau / 8
"""The most a chord turns, in radians."""
SHORT: Final = 0.25
"""An arc shorter than this, in cells' widths, is its own chord: half a dot of the finest mode."""
CONCENTRIC: Final = 1e-9
"""An arc about the window's centre is all in sight or all out of it; this keeps the division finite."""

Points = NDArray[np.complex128]
Rows = NDArray[np.intp]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Chords:
    """m chords `starts`, `ends` (m,) in window coordinates, ordered by `layers` (m,).

    `along` (m,) is the length travelled on the layer's path up to the chord's start, in cells' widths.
    """

    starts: Points
    ends: Points
    layers: Rows
    along: Floats


@dataclass(frozen=True, eq=False, slots=True)
class _Pieces:
    """n pieces (n,) in window coordinates, and k `arcs` among them: their rows, centres, turns, sweeps, radii and
    the directions in which they begin (k,)."""

    starts: Points
    ends: Points
    layers: Rows
    along: Floats
    arcs: Rows
    centres: Points
    turns: Turns
    sweeps: Floats
    radii: Floats
    begin: Floats


def chords(layers: Sequence[Layer], view: View, columns: int, rows: int) -> Chords:
    """Chords of all layers' paths that may touch the window of columns x rows cells; a layer is known by its index."""
    given = [(index, layer) for index, layer in enumerate(layers) if len(layer.path)]
    if not given:
        none = np.empty(0, np.complex128)
        return Chords(none, none, np.empty(0, np.intp), np.empty(0))
    with np.errstate(invalid="ignore", over="ignore"):
        pieces = _gathered(given, view)
    if not len(pieces.arcs):
        return Chords(pieces.starts, pieces.ends, pieces.layers, pieces.along)
    arcs = _divided(pieces, hypot(columns / 2, rows * TALL / 2) + 1.0)
    straight = np.ones(len(pieces.starts), np.bool_)
    straight[pieces.arcs] = False
    lines = straight.nonzero()[0]
    found = np.concatenate((pieces.layers[lines], arcs.layers))
    order = np.argsort(found, kind="stable")
    starts, ends = (pieces.starts[lines], arcs.starts), (pieces.ends[lines], arcs.ends)
    along = np.concatenate((pieces.along[lines], arcs.along))
    return Chords(np.concatenate(starts)[order], np.concatenate(ends)[order], found[order], along[order])


def _gathered(given: Sequence[tuple[int, Layer]], view: View) -> _Pieces:
    """The pieces of all layers in window coordinates, in order; arcs shorter than SHORT are lines here."""
    pieces = gathered([layer for _, layer in given])
    layers = np.array([index for index, _ in given])[pieces.layers]
    along = _travelled([layer for _, layer in given], pieces.layers) / view.scale
    points, centres = _in_window(pieces.points, view), _in_window(pieces.centres, view)
    limit = BEYOND / view.scale
    if not (_within(points, limit).all() and _within(centres, limit).all()):
        near = _within(points, limit)
        shown = near[pieces.rows] & near[pieces.rows + 1] & _within(centres, limit) & np.isfinite(along)
        keep = shown.nonzero()[0]
        pieces, layers, along, centres = pieces.only(keep), layers[keep], along[keep], centres[keep]
    starts, ends = points[pieces.rows], points[pieces.rows + 1]
    arcs = pieces.turns.nonzero()[0]
    sweeps, radial = _sweeps(pieces.only(arcs)), starts[arcs] - centres[arcs]
    radii = np.abs(radial)
    curved = (radii * sweeps > SHORT).nonzero()[0]
    arcs, radii, begin = arcs[curved], radii[curved], np.angle(radial[curved])
    return _Pieces(starts, ends, layers, along, arcs, centres[arcs], pieces.turns[arcs], sweeps[curved], radii, begin)


def _sweeps(arcs: Pieces) -> Floats:
    """(k,) angles that arcs travel: whether one is a full circle only its own millimetres tell."""
    starts, ends = arcs.starts, arcs.ends
    return swept(starts - arcs.centres, ends - arcs.centres, arcs.turns, starts == ends)


def _within(points: Points, limit: float) -> Mask:
    """(n,) which points are drawn at all."""
    within: Mask = (np.abs(points.real) <= limit) & (np.abs(points.imag) <= limit)
    return within


def _in_window(points: Floats, view: View) -> Points:
    window: Points = np.ascontiguousarray(points).view(np.complex128)[:, 0] - complex(*view.centre)
    window /= view.scale
    return window


def _travelled(layers: Sequence[Layer], owners: Rows) -> Floats:
    """(n,) millimetres from its path's start to each piece of a dashed layer; `owners` (n,) are the pieces' layers.

    Where only parts of a path are drawn each piece's dashes begin with it.
    """
    along = np.zeros(len(owners))
    for index, layer in enumerate(layers):
        if layer.dashed and layer.own is None and len(layer.path) > 1:
            lengths, first = layer.path.lengths, int(np.searchsorted(owners, index))
            along[first : first + len(lengths)] = np.cumsum(lengths) - lengths
    return along


def _divided(pieces: _Pieces, reach: float) -> Chords:
    """Chords of the arcs among the pieces within `reach` of the window's centre."""
    arc, low, high = _visible(pieces, reach)
    span, radii, turns = high - low, pieces.radii[arc], pieces.turns[arc]
    counts = np.ceil(span / np.minimum(np.sqrt(8.0 * SAG / np.maximum(radii, SAG)), STEP)).astype(np.intp)
    pace = span / np.maximum(counts, 1)
    row = np.repeat(np.arange(len(arc)), counts)
    nth = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    turned = low[row] + nth * pace[row]
    angle = pieces.begin[arc][row] + turns[row] * turned
    starts = radii[row] * np.exp(1j * angle)
    ends = starts * np.exp(1j * turns * pace)[row]
    centres, piece = pieces.centres[arc][row], pieces.arcs[arc]
    along = pieces.along[piece][row] + turned * radii[row]
    return Chords(centres + starts, centres + ends, pieces.layers[piece][row], along)


def _visible(pieces: _Pieces, reach: float) -> tuple[Rows, Floats, Floats]:
    """(m,) arcs, and the angles travelled, from and to, between which each runs within `reach` of the window's centre.

    The circle meets the disc of that reach symmetrically about the direction to the window's centre, over a half
    angle h with sin^2(h / 2) = (reach^2 - (d - r)^2) / (4 d r), d being the distance of the two centres.
    """
    distance, radii, sweeps = np.abs(pieces.centres), pieces.radii, pieces.sweeps
    within = reach * reach - (distance - radii) ** 2
    part = np.minimum(np.maximum(within / np.maximum(4.0 * distance * radii, CONCENTRIC), 0.0), 1.0)
    whole, hidden = part >= 1.0, within <= 0.0
    if whole.all() and not hidden.any():
        return np.arange(len(sweeps)), np.zeros(len(sweeps)), sweeps
    half = 2.0 * np.arcsin(np.sqrt(part))
    middle = np.mod((np.angle(-pieces.centres) - pieces.begin) * pieces.turns, tau)
    turned = np.array([[-tau], [0.0], [tau]])
    low = np.maximum(middle - half + turned, 0.0)
    high = np.minimum(middle + half + turned, sweeps)
    low[:, whole], high[:, whole | hidden] = 0.0, 0.0
    high[1] = np.where(whole & ~hidden, sweeps, high[1])
    shown, arc = np.nonzero(high > low)
    return arc, low[shown, arc], high[shown, arc]
