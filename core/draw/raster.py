"""A scene as rows of characters with a role for every cell.

One vectorised chain for all layers: pieces -> chords in the window -> dots -> bits of a cell -> a character from
the mode's table.

Pieces of paths as short straight chords inside a window, vectorised.

Window coordinates: the window's center is 0, a cell is 1 wide and `TALL` high, the second axis points up.  A point is
one complex number here, which numpy gathers twice as fast as a pair.  Arcs are cut down to the part near the window
before they are divided, so that no zoom makes them expensive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import hypot, tau
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.characters import Cells, Mode, Sheet, cells, write_signs
from core.draw.scene import BEYOND, Arcs, Gathered, Layer, Pieces, Scene, Style
from core.draw.view import TALL, View
from core.geometry.path import Floats, Turns, coordinates

DASH: Final = (3.0, 1.8)
"""A dash's period and the lit part of it, in cells' widths."""
AXIS_DASH: Final = (4.0, 1.0)
NUDGE: Final = 1e-6
"""Parts of a dot: a line exactly between two rows of dots must not change rows where rounding does."""
FAINT: Final = (Style.AXIS, Style.PATH, Style.LEAD, Style.RAPID)
"""Roles that do not make a cell one of the surface."""
STRUCK: Final = "#"
"""The character of cells with deleted surface: without colors a line there would be one that is merely uncut."""
PHASE: Final = 0.25
"""Where in its period an axis begins at the window's edge: away from where rounding could decide."""

Bits = NDArray[np.bool_]
Styles = NDArray[np.uint8]

NO_AXES: Final = np.empty(0, np.intp)


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    """`rows` of equally many characters, and the Style of each cell: `styles` (rows, columns)."""

    rows: tuple[str, ...]
    styles: Styles


def draw(scene: Scene, view: View, columns: int, rows: int, mode: Mode, gathered: Gathered | None = None) -> Picture:
    """The part of the scene that `view` shows, in columns x rows cells; either may be 0.

    Dots of all layers stay lit.  A cell takes the style of the last layer in it, then of the last circle, of the last
    mark.  What is not finite, or beyond every machine, is left out.  `gathered` are the scene's pieces where they are
    gathered already.
    """
    if columns < 1 or rows < 1:
        return Picture(("",) * max(rows, 0), np.zeros((max(rows, 0), max(columns, 0)), np.uint8))
    look = cells(mode)
    gathered = scene.gathered if gathered is None else gathered
    axes = _axes(view, look, columns, rows) if scene.axes else NO_AXES
    found = _clipped(chords(gathered, view, columns, rows), columns / 2, rows * TALL / 2)
    lit, styles, strong, struck = _light(found, gathered.layers, axes, look, columns, rows)
    codes = np.packbits(lit, bitorder="little")
    characters = look.table[codes]
    if look.faint is not None:
        characters = np.where(strong | (styles == Style.AXIS.value), characters, look.faint[codes])
    characters[struck] = STRUCK
    sheet = Sheet(columns, rows, characters.tolist(), bytearray(styles))
    write_signs(sheet, scene, view, mode)
    text = "".join(sheet.characters)
    lines = tuple(text[first : first + columns] for first in range(0, len(text), columns))
    return Picture(lines, np.frombuffer(sheet.styles, np.uint8).reshape(rows, columns))


def _axes(view: View, look: Cells, columns: int, rows: int) -> Rows:
    """The bits that the X and the Y axis light inside the window."""
    (x, y), limit, (wide, high) = view.center, BEYOND / view.scale, look.dot
    across, up, half_width, half_height = -x / view.scale, -y / view.scale, columns / 2, rows * TALL / 2
    level = upright = None
    if abs(up) <= half_height and max(half_width, abs(up)) <= limit:
        level = int((half_height - up) / high + NUDGE)
    if abs(across) <= half_width and max(half_height, abs(across)) <= limit:
        upright = int((across + half_width) / wide + NUDGE)
    return _crossing(look, columns, rows, level, upright)


@lru_cache(8)
def _crossing(look: Cells, columns: int, rows: int, level: int | None, upright: int | None) -> Rows:
    """The bits of dashed lines along one row of dots, from left to right, and one column, from top to bottom."""
    (wide, high), half_width, half_height, found = (
        look.dot,
        columns / 2,
        rows * TALL / 2,
        list[tuple[complex, complex]](),
    )
    if level is not None:
        found.append((complex(-half_width, half_height - (level + 0.5) * high), complex(2.0 * half_width, 0.0)))
    if upright is not None:
        found.append((complex((upright + 0.5) * wide - half_width, half_height), complex(0.0, -2.0 * half_height)))
    starts, runs = np.array(found, np.complex128).reshape(-1, 2).T
    lines = Chords(starts, runs, np.zeros(len(found), np.intp), np.zeros(len(found)))
    chord, part, bits = _dots(lines, look, columns, rows)
    return bits[np.mod(part * np.abs(runs)[chord] + PHASE, AXIS_DASH[0]) < AXIS_DASH[1]]


def _clipped(found: Chords, half_width: float, half_height: float) -> Chords:
    """What of the chords lies inside the window (Liang and Barsky's parameters)."""
    starts, run = found.starts, found.runs
    ends = starts + run
    if _inside(np.concatenate((starts, ends)), half_width, half_height):
        # as below, to the last digit
        return Chords(starts, ends - starts, found.layers, found.along)
    enter, leave = np.zeros(len(run)), np.ones(len(run))
    for start, step, limit in (
        (starts.real, run.real, half_width),
        (starts.imag, run.imag, half_height),
    ):
        low, high = _between(start, step, limit)
        np.maximum(enter, low, out=enter)
        np.minimum(leave, high, out=leave)
    keep = (enter <= leave).nonzero()[0]
    starts, run, enter, leave = starts[keep], run[keep], enter[keep], leave[keep]
    along, ends = found.along[keep] + enter * np.abs(run), starts + leave * run
    starts = starts + enter * run
    return Chords(starts, ends - starts, found.layers[keep], along)


def _inside(points: Points, half_width: float, half_height: float) -> bool:
    # what is not a number is neither more nor less
    across, up = np.abs(points.real).max(initial=0.0), np.abs(points.imag).max(initial=0.0)
    return bool(across <= half_width and up <= half_height)


def _between(start: Floats, step: Floats, limit: float) -> tuple[Floats, Floats]:
    """The parameters between which start + t * step lies in -limit ... limit; from infinity on where it never does."""
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (-limit - start) / step, (limit - start) / step
    low, high = np.minimum(one, other), np.maximum(one, other)
    still = step == 0.0
    if still.any():
        inside = np.abs(start) <= limit
        low = np.where(still, np.where(inside, -np.inf, np.inf), low)
        high = np.where(still, np.inf, high)
    return low, high


def _light(
    found: Chords, layers: Sequence[Layer], axes: Rows, look: Cells, columns: int, rows: int
) -> tuple[Bits, Styles, Bits | None, Rows]:
    """Bits lit (rows x columns x 8,), styles (rows x columns,), which cells more than center paths are in where that is
    asked for, and cells that have deleted surface.  The bits of the `axes` lie under all layers."""
    chord, part, bits = _dots(found, look, columns, rows)
    # the last style is no layer's: there may be no layers
    roles = np.frombuffer(bytes((*(each.style for each in layers), Style.AXIS)), np.uint8)
    role = roles[found.layers][chord]
    dashed = [each.dashed and each.style is not Style.DELETED for each in layers]
    if any(dashed):
        shown = _dashes(found, np.array(dashed)[found.layers][chord].nonzero()[0], chord, part)
        bits, role = bits[shown], role[shown]
    cell = bits >> 3
    lit, styles = np.zeros(rows * columns * 8, np.bool_), np.zeros(rows * columns, np.uint8)
    lit[axes], styles[axes >> 3] = True, Style.AXIS
    lit[bits], styles[cell] = True, role
    strong = None
    if look.faint is not None:
        strong = np.zeros(rows * columns, np.bool_)
        strong[cell[~np.isin(role, FAINT)]] = True
    return lit, styles, strong, cell[role == Style.DELETED.value]


@lru_cache(8)
def _bits(look: Cells, columns: int, rows: int) -> Rows:
    """(dots,) the bit that each dot of a window lights, row by row: eight to a cell."""
    down, across = np.divmod(np.arange(rows * look.down * columns * look.across), columns * look.across)
    cell = down // look.down * columns + across // look.across
    bits: Rows = cell * 8 + look.bit[down % look.down * look.across + across % look.across]
    return bits


def _dots(found: Chords, look: Cells, columns: int, rows: int) -> tuple[Rows, Floats, Rows]:
    """Chord, part of it that lies before the dot, and bit (m,) that it lights, of every dot in order of chords."""
    (wide, high), start, run = look.dot, found.starts, found.runs
    x, y = (start.real + columns / 2) / wide + NUDGE, (rows * TALL / 2 - start.imag) / high + NUDGE
    over, under = run.real / wide, run.imag / -high
    steps = np.ceil(np.maximum(np.abs(over), np.abs(under))).astype(np.intp)
    counts = steps + 1
    chord = np.arange(len(counts)).repeat(counts)
    nth = np.arange(len(chord)) - (counts.cumsum() - counts)[chord]
    part = nth * (1.0 / np.maximum(steps, 1))[chord]
    across = (x[chord] + part * over[chord]).astype(np.intp)
    down = (y[chord] + part * under[chord]).astype(np.intp)
    width, height = columns * look.across, rows * look.down
    across, down = np.minimum(across, width - 1), np.minimum(down, height - 1)
    dot = np.maximum(down, 0) * width + np.maximum(across, 0)
    return chord, part, _bits(look, columns, rows)[dot] if look.by_dot else dot * 8 + _slants(found)[chord]


def _dashes(found: Chords, rows: Rows, chord: Rows, part: Floats) -> Bits:
    """Which dots (m,) are lit: all of a whole line, part of each period of a dashed one, which has the dots `rows`."""
    shown = np.ones(len(chord), np.bool_)
    own = chord[rows]
    along = found.along[own] + part[rows] * np.abs(found.runs[own])
    shown[rows] = np.mod(along, DASH[0]) < DASH[1]
    return shown


def _slants(found: Chords) -> Rows:
    """The line character's bit of each chord: 0 level, 1 rising, 2 upright, 3 falling, as it looks in tall cells."""
    across, up = found.runs.real, found.runs.imag
    steep = np.abs(up) / TALL
    slants = np.where(across * up > 0.0, 1, 3)
    slants[steep > np.abs(across) * np.tan(3 * np.pi / 8)] = 2
    slants[steep <= np.abs(across) * np.tan(np.pi / 8)] = 0
    return slants


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
