"""Pieces of paths as short straight chords inside a window, vectorised.

Window coordinates: the window's centre is 0, a cell is 1 wide and `TALL` high, the second axis points up.  A point is
one complex number here, which numpy gathers twice as fast as a pair.  Arcs are cut down to the part near the window
before they are divided, so that no zoom makes them expensive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, tau
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.scene import BEYOND, Layer, chained
from core.draw.view import TALL, View
from core.geometry.path import Floats

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
    starts: Points
    ends: Points
    centres: Points
    turns: NDArray[np.int8]
    sweeps: Floats
    layers: Rows
    along: Floats

    def only(self, keep: Mask) -> _Pieces:
        """The pieces of these rows; all of them are not copied."""
        if keep.all():
            return self
        rows = keep.nonzero()[0]
        return _Pieces(
            self.starts[rows],
            self.ends[rows],
            self.centres[rows],
            self.turns[rows],
            self.sweeps[rows],
            self.layers[rows],
            self.along[rows],
        )


def chords(layers: Sequence[Layer], view: View, columns: int, rows: int) -> Chords:
    """Chords of all layers' paths that may touch the window of columns x rows cells; a layer is known by its index."""
    given = [(index, layer) for index, layer in enumerate(layers) if len(layer.path)]
    if not given:
        none = np.empty(0, np.complex128)
        return Chords(none, none, np.empty(0, np.intp), np.empty(0))
    with np.errstate(invalid="ignore", over="ignore"):
        pieces = _gather(given, view)
        pieces = pieces.only(_drawable(pieces, BEYOND / view.scale))
    curved = (pieces.turns != 0) & (np.abs(pieces.starts - pieces.centres) * pieces.sweeps > SHORT)
    if not curved.any():
        return Chords(pieces.starts, pieces.ends, pieces.layers, pieces.along)
    lines, arcs = pieces.only(~curved), _divided(pieces.only(curved), hypot(columns / 2, rows * TALL / 2) + 1.0)
    order = np.argsort(np.concatenate((lines.layers, arcs.layers)), kind="stable")
    starts, ends = np.concatenate((lines.starts, arcs.starts)), np.concatenate((lines.ends, arcs.ends))
    found, along = np.concatenate((lines.layers, arcs.layers)), np.concatenate((lines.along, arcs.along))
    return Chords(starts[order], ends[order], found[order], along[order])


def _gather(given: Sequence[tuple[int, Layer]], view: View) -> _Pieces:
    """The pieces of all layers in window coordinates, in order; only dashed layers are measured."""
    paths = [layer.path for _, layer in given]
    chain, own = chained(paths)
    points, counts = _in_window(chain.points, view), np.array([len(path) for path in paths])
    return _Pieces(
        points[:-1][own],
        points[1:][own],
        _in_window(chain.centres, view)[own],
        chain.turns[own],
        np.abs(chain.sweeps[own]),
        np.repeat([index for index, _ in given], counts),
        _travelled([layer for _, layer in given], np.cumsum(counts)) / view.scale,
    )


def _in_window(points: Floats, view: View) -> Points:
    window: Points = np.ascontiguousarray(points).view(np.complex128)[:, 0] - complex(*view.centre)
    window /= view.scale
    return window


def _travelled(layers: Sequence[Layer], behind: Rows) -> Floats:
    """Millimetres from its path's start to each piece of a dashed layer; `behind` counts the pieces up to its end."""
    along = np.zeros(behind[-1])
    for layer, last in zip(layers, behind.tolist(), strict=True):
        if layer.dashed and len(layer.path) > 1:
            lengths = layer.path.lengths
            along[last - len(lengths) : last] = np.cumsum(lengths) - lengths
    return along


def _drawable(pieces: _Pieces, limit: float) -> Mask:
    drawable: Mask = np.isfinite(pieces.sweeps) & np.isfinite(pieces.along)
    for points in (pieces.starts, pieces.ends, pieces.centres):
        drawable &= (np.abs(points.real) <= limit) & (np.abs(points.imag) <= limit)
    return drawable


def _divided(arcs: _Pieces, reach: float) -> Chords:
    """Chords of arcs within `reach` of the window's centre."""
    radial = arcs.starts - arcs.centres
    radii, begin = np.abs(radial), np.angle(radial)
    low, high = _visible(arcs, radii, begin, reach)
    shown, arc = np.nonzero(high > low)
    low, span, radii = low[shown, arc], (high - low)[shown, arc], radii[arc]
    counts = np.ceil(span / np.minimum(np.sqrt(8.0 * SAG / np.maximum(radii, SAG)), STEP)).astype(np.intp)
    pace = span / np.maximum(counts, 1)
    row = np.repeat(np.arange(len(arc)), counts)
    nth = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    turned = low[row] + nth * pace[row]
    angle = begin[arc][row] + arcs.turns[arc][row] * turned
    starts = radii[row] * np.exp(1j * angle)
    ends = starts * np.exp(1j * arcs.turns[arc] * pace)[row]
    centres = arcs.centres[arc][row]
    return Chords(centres + starts, centres + ends, arcs.layers[arc][row], arcs.along[arc][row] + turned * radii[row])


def _visible(arcs: _Pieces, radii: Floats, begin: Floats, reach: float) -> tuple[Floats, Floats]:
    """(3, n) angles travelled, from and to, between which each arc runs within `reach` of the window's centre.

    The circle meets the disc of that reach symmetrically about the direction to the window's centre, over a half
    angle h with sin^2(h / 2) = (reach^2 - (d - r)^2) / (4 d r), d being the distance of the two centres.
    """
    distance = np.abs(arcs.centres)
    within = reach * reach - (distance - radii) ** 2
    part = np.minimum(np.maximum(within / np.maximum(4.0 * distance * radii, CONCENTRIC), 0.0), 1.0)
    half = 2.0 * np.arcsin(np.sqrt(part))
    middle = np.mod((np.angle(-arcs.centres) - begin) * arcs.turns, tau)
    turned = np.array([[-tau], [0.0], [tau]])
    low = np.maximum(middle - half + turned, 0.0)
    high = np.minimum(middle + half + turned, arcs.sweeps)
    whole, hidden = part >= 1.0, within <= 0.0
    low[:, whole], high[:, whole | hidden] = 0.0, 0.0
    high[1] = np.where(whole & ~hidden, arcs.sweeps, high[1])
    return low, high
