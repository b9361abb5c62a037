"""Chords: the pieces of a scene as short straight chords inside a window, for all layers at once.

Window coordinates: the window's center is 0, a cell is 1 wide and `CELL_HEIGHT` high, the second axis points up; a
point is one complex number.  Arcs are trimmed to the part near the window before they are divided, so that no zoom
makes them expensive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import hypot, tau
from typing import Final

import numpy as np

from core.draw.scene import MAX_DRAWN_COORDINATE, Layer
from core.draw.view import CELL_HEIGHT, View
from core.geometry.path import Flags, Floats, Points, Rows, Turns, as_complex

MAX_CHORD_ERROR: Final = 0.1
"""Largest distance of a chord from its arc, in cell widths: less than half a dot of the finest mode."""
MAX_TURN: Final = tau / 8
"""Largest angle of one chord, in radians."""
MAX_SINGLE_CHORD: Final = 0.25
"""An arc shorter than this, in cell widths, becomes one chord: half a dot of the finest mode."""
MIN_CONCENTRIC_DIVISOR: Final = 1e-9
"""Least divisor for an arc about the window's center, which is either all visible or not at all."""


@dataclass(frozen=True, eq=False, slots=True)
class Chords:
    """m chords in window coordinates, ordered by `layers` (m,): each from `starts` by `runs` (m,).

    `along` (m,) is the length traveled on the layer's path up to the chord's start, in cell widths.
    """

    starts: Points
    runs: Points
    layers: Rows
    along: Floats

    def only(self, keep: Rows) -> Chords:
        """Return the chords of these rows."""
        return Chords(self.starts[keep], self.runs[keep], self.layers[keep], self.along[keep])


@dataclass(frozen=True, eq=False, slots=True)
class _Pieces:
    """n pieces in window coordinates; `sweeps` (n,) is the angle an arc travels, 0 for a line."""

    starts: Points
    ends: Points
    centers: Points
    turns: Turns
    sweeps: Floats
    layers: Rows
    along: Floats

    def only(self, keep: Rows | Flags) -> _Pieces:
        """Return the pieces of these rows."""
        return _Pieces(*(getattr(self, field.name)[keep] for field in fields(self)))

    @property
    def radii(self) -> Floats:
        """(n,) radii of arcs, in cell widths."""
        return np.abs(self.starts - self.centers)


def chords(layers: Sequence[Layer], view: View, columns: int, rows: int) -> Chords:
    """Return the chords of all layers' pieces that may touch the window of columns x rows cells.

    Coordinates that are not finite, or too large for any machine, are left out.  A layer's number is its index.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        pieces = _pieces(layers, view)
        bent = (pieces.radii * pieces.sweeps > MAX_SINGLE_CHORD) & (pieces.turns != 0)
    lines = pieces.only(~bent)
    straight = Chords(lines.starts, lines.ends - lines.starts, lines.layers, lines.along)
    if not bent.any():
        return straight
    divided = _divided(pieces.only(bent), hypot(columns / 2, rows * CELL_HEIGHT / 2) + 1.0)
    parts = ((getattr(straight, field.name), getattr(divided, field.name)) for field in fields(Chords))
    both = Chords(*(np.concatenate(pair) for pair in parts))
    return both.only(both.layers.argsort(kind="stable"))


def _pieces(layers: Sequence[Layer], view: View) -> _Pieces:
    """Return the pieces of all layers that are drawn at all."""
    paths = [layer.path for layer in layers]

    def together(name: str) -> Points:
        return as_complex(np.concatenate([np.empty((0, 2)), *(getattr(path, name) for path in paths)]))

    counts = [len(path) for path in paths]
    starts, ends, centers = (together(name) - complex(*view.center) for name in ("starts", "ends", "centers"))
    turns = np.concatenate([np.empty(0, np.int8), *(path.turns for path in paths)])
    sweeps = np.concatenate([np.empty(0), *(np.abs(path.sweeps) for path in paths)])
    along = np.concatenate([np.empty(0), *map(_traveled, layers)])
    chosen = (np.ones(len(layer.path), np.bool_) if layer.drawn is None else layer.drawn for layer in layers)
    wanted = np.concatenate([np.empty(0, np.bool_), *chosen])
    drawn = wanted & _within(starts) & _within(ends) & (_within(centers) | (turns == 0)) & np.isfinite(along)
    owners = np.arange(len(layers)).repeat(counts)
    scale = view.scale
    return _Pieces(starts / scale, ends / scale, centers / scale, turns, sweeps, owners, along / scale).only(drawn)


def _within(points: Points) -> Flags:
    """Return (n,) True for points that are drawn at all; a NaN is not."""
    return (np.abs(points.real) <= MAX_DRAWN_COORDINATE) & (np.abs(points.imag) <= MAX_DRAWN_COORDINATE)


def _traveled(layer: Layer) -> Floats:
    """Return (n,) the millimeters to each piece of a dashed layer from the start of its path, or of its drawn part."""
    if not layer.dashed:
        return np.zeros(len(layer.path))
    lengths = layer.path.lengths
    traveled: Floats = np.cumsum(lengths) - lengths
    if layer.drawn is None:
        return traveled
    begins = layer.drawn & ~np.concatenate(([False], layer.drawn[:-1]))
    latest = np.maximum.accumulate(np.where(begins, np.arange(len(begins)), 0))
    return traveled - traveled[latest]


def _divided(arcs: _Pieces, reach: float) -> Chords:
    """Divide arcs into chords, within `reach` of the window's center."""
    arcs, low, span = _visible(arcs, reach)
    counts = np.ceil(
        span / np.minimum(np.sqrt(8.0 * MAX_CHORD_ERROR / np.maximum(arcs.radii, MAX_CHORD_ERROR)), MAX_TURN)
    ).astype(np.intp)
    pace = span / np.maximum(counts, 1)
    arc = np.arange(len(counts)).repeat(counts)
    nth = np.arange(len(arc)) - (counts.cumsum() - counts)[arc]
    turned, turns, radii = low[arc] + nth * pace[arc], arcs.turns, arcs.radii[arc]
    starts = radii * np.exp(1j * (_begin(arcs)[arc] + turns[arc] * turned))
    runs = starts * (np.exp(1j * turns * pace) - 1.0)[arc]
    return Chords(arcs.centers[arc] + starts, runs, arcs.layers[arc], arcs.along[arc] + turned * radii)


def _begin(arcs: _Pieces) -> Floats:
    """Return (k,) the directions from the arcs' centers to their starts."""
    return np.angle(arcs.starts - arcs.centers)


def _visible(arcs: _Pieces, reach: float) -> tuple[_Pieces, Floats, Floats]:
    """Return m parts of arcs within `reach` of the window's center, the angle (m,) traveled to each, and its own angle.

    The circle is within that reach symmetrically about the direction to the window's center, over a half
    angle h with sin^2(h / 2) = (reach^2 - (d - r)^2) / (4 d r), d being the distance of the two centers.
    """
    distance, radii, sweeps = np.abs(arcs.centers), arcs.radii, arcs.sweeps
    within = reach * reach - (distance - radii) ** 2
    part = np.minimum(np.maximum(within / np.maximum(4.0 * distance * radii, MIN_CONCENTRIC_DIVISOR), 0.0), 1.0)
    inside = distance + radii <= reach
    whole, hidden = (part >= 1.0) | inside, (within <= 0.0) & ~inside
    half = 2.0 * np.arcsin(np.sqrt(part))
    middle = np.mod((np.angle(-arcs.centers) - _begin(arcs)) * arcs.turns, tau)
    turned = np.array([[-tau], [0.0], [tau]])
    low = np.maximum(middle - half + turned, 0.0)
    high = np.minimum(middle + half + turned, sweeps)
    low[:, whole], high[:, whole | hidden] = 0.0, 0.0
    high[1] = np.where(whole & ~hidden, sweeps, high[1])
    row, arc = np.nonzero(high > low)
    return arcs.only(arc), low[row, arc], (high - low)[row, arc]
