"""A scene as rows of characters with a role for every cell.

One vectorised chain for all layers: pieces -> chords in the window -> dots -> bits of a cell -> a character from
the mode's table.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.chords import Chords, Points, Rows, chords
from core.draw.mode import Cells, Mode, cells
from core.draw.scene import Circle, Layer, Scene, Style
from core.draw.signs import Styles, write_signs
from core.draw.view import TALL, View
from core.geometry.path import EMPTY, Floats, Path
from core.records import dataclass

DASH: Final = (3.0, 1.8)
"""A dash's period and the lit part of it, in cells' widths."""
AXIS_DASH: Final = (4.0, 1.0)
NUDGE: Final = 1e-6
"""Parts of a dot: a line exactly between two rows of dots must not change rows where rounding does."""
AXES: Final = 2
"""The first layers drawn are the two axes."""
FAINT: Final = (Style.AXIS, Style.PATH, Style.LEAD, Style.RAPID)
"""Roles that do not make a cell one of the surface."""
STRUCK: Final = "#"
"""The character of cells with deleted surface: without colours a line there would be one that is merely uncut."""
PHASE: Final = 0.25
"""Where in its period an axis begins at the window's edge: away from where rounding could decide."""

Bits = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    """`rows` of equally many characters, and the Style of each cell: `styles` (rows, columns)."""

    rows: tuple[str, ...]
    styles: NDArray[np.uint8]


def draw(scene: Scene, view: View, columns: int, rows: int, mode: Mode) -> Picture:
    """The part of the scene that `view` shows, in columns x rows cells; either may be 0.

    Dots of all layers stay lit.  A cell takes the style of the last layer in it, then of the last circle, of the last
    mark.  What is not finite, or beyond every machine, is left out.
    """
    if columns < 1 or rows < 1:
        return Picture(("",) * max(rows, 0), np.zeros((max(rows, 0), max(columns, 0)), np.uint8))
    look = cells(mode)
    layers = (*_axes(scene, view, columns, rows), *scene.layers, *map(_outline, scene.circles))
    found = _clipped(chords(layers, view, columns, rows), columns / 2, rows * TALL / 2)
    lit, styles, strong, struck = _light(found, layers, look, columns, rows)
    codes = np.packbits(lit, bitorder="little")
    characters = look.table[codes]
    if look.faint is not None:
        characters = np.where(strong | (styles == Style.AXIS.value), characters, look.faint[codes])
    characters[struck] = STRUCK
    characters, styles = characters.reshape(rows, columns), styles.reshape(rows, columns)
    write_signs(characters, styles, scene, view, mode)
    return Picture(tuple("".join(row) for row in characters.tolist()), styles)


def _outline(circle: Circle) -> Layer:
    """The whole circle as a layer."""
    (x, y), radius = circle.centre, circle.radius
    rim = np.array([[x + radius, y], [x + radius, y]])
    return Layer(Path.of(rim, np.array([[x, y]]), np.array([1], np.int8)), circle.style)


def _axes(scene: Scene, view: View, columns: int, rows: int) -> tuple[Layer, Layer]:
    """The parts of the X and Y axis inside the window; an axis outside is an empty layer."""
    (left, top), (right, bottom) = view.at(0, 0, columns, rows), view.at(columns, rows, columns, rows)
    level = bottom <= 0.0 <= top and scene.axes
    upright = left <= 0.0 <= right and scene.axes
    return (
        Layer(_straight(left, 0.0, right, 0.0) if level else EMPTY, Style.AXIS, dashed=True),
        Layer(_straight(0.0, top, 0.0, bottom) if upright else EMPTY, Style.AXIS, dashed=True),
    )


def _straight(x0: float, y0: float, x1: float, y1: float) -> Path:
    return Path.of(np.array([[x0, y0], [x1, y1]]), np.array([[x0, y0]]), np.array([0], np.int8))


def _clipped(found: Chords, half_width: float, half_height: float) -> Chords:
    """What of the chords lies inside the window (Liang and Barsky's parameters)."""
    run = found.ends - found.starts
    if _inside(found.starts, half_width, half_height) and _inside(found.ends, half_width, half_height):
        # as below, to the last digit
        return Chords(found.starts, found.starts + run, found.layers, found.along)
    enter, leave = np.zeros(len(run)), np.ones(len(run))
    for start, step, limit in (
        (found.starts.real, run.real, half_width),
        (found.starts.imag, run.imag, half_height),
    ):
        low, high = _between(start, step, limit)
        np.maximum(enter, low, out=enter)
        np.minimum(leave, high, out=leave)
    keep = (enter <= leave).nonzero()[0]
    starts, run, enter, leave = found.starts[keep], run[keep], enter[keep], leave[keep]
    along = found.along[keep] + enter * np.abs(run)
    return Chords(starts + enter * run, starts + leave * run, found.layers[keep], along)


def _inside(points: Points, half_width: float, half_height: float) -> bool:
    return bool((np.abs(points.real) <= half_width).all() and (np.abs(points.imag) <= half_height).all())


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
    found: Chords, layers: tuple[Layer, ...], look: Cells, columns: int, rows: int
) -> tuple[Bits, Styles, NDArray[np.bool_], NDArray[np.bool_]]:
    """Bits lit (rows x columns x 8,), styles (rows x columns,), which cells more than centre paths are in, and which
    have deleted surface."""
    chord, part, across, down = _dots(found, look, columns, rows)
    layer = found.layers[chord]
    row, column = down // look.down, across // look.across
    cell = row * columns + column
    if look.by_dot:
        bit = look.bit[(down - row * look.down) * look.across + across - column * look.across]
    else:
        bit = _slants(found)[chord]
    shown = _dashes(found, layers, layer, chord, part).nonzero()[0]
    bits, cell = (cell * 8 + bit)[shown], cell[shown]
    role = np.frombuffer(bytes(each.style for each in layers), np.uint8)[layer[shown]]
    lit = np.zeros(rows * columns * 8, np.bool_)
    lit[bits] = True
    styles = np.zeros(rows * columns, np.uint8)
    styles[cell] = role
    strong = np.zeros(rows * columns, np.bool_)
    if look.faint is not None:
        strong[cell[~np.isin(role, FAINT)]] = True
    struck = np.zeros(rows * columns, np.bool_)
    struck[cell[role == Style.DELETED.value]] = True
    return lit, styles, strong, struck


def _dots(found: Chords, look: Cells, columns: int, rows: int) -> tuple[Rows, Floats, Rows, Rows]:
    """Chord, part of it that lies before the dot, dot across and dot down (m,) of every dot, in order of chords."""
    run = found.ends - found.starts
    wide, high = look.dot
    steps = np.ceil(np.maximum(np.abs(run.real) / wide, np.abs(run.imag) / high)).astype(np.intp)
    counts = steps + 1
    chord = np.repeat(np.arange(len(counts)), counts)
    nth = np.arange(len(chord)) - (np.cumsum(counts) - counts)[chord]
    part = nth * (1.0 / np.maximum(steps, 1))[chord]
    places = found.starts[chord] + part * run[chord]
    across = ((places.real + columns / 2) / wide + NUDGE).astype(np.intp)
    down = ((rows * TALL / 2 - places.imag) / high + NUDGE).astype(np.intp)
    np.minimum(across, columns * look.across - 1, out=across)
    np.minimum(down, rows * look.down - 1, out=down)
    np.maximum(across, 0, out=across)
    np.maximum(down, 0, out=down)
    return chord, part, across, down


def _dashes(found: Chords, layers: tuple[Layer, ...], layer: Rows, chord: Rows, part: Floats) -> NDArray[np.bool_]:
    """Which dots (m,) are lit: all of a whole line, part of each period of a dashed one."""
    dashed = np.array([each.dashed and each.style is not Style.DELETED for each in layers])
    rows = dashed[layer].nonzero()[0]
    shown = np.ones(len(layer), np.bool_)
    own = chord[rows]
    along = found.along[own] + part[rows] * np.abs(found.ends - found.starts)[own]
    axis = layer[rows] < AXES
    period, lit = np.where(axis, AXIS_DASH[0], DASH[0]), np.where(axis, AXIS_DASH[1], DASH[1])
    shown[rows] = np.mod(along + PHASE * axis, period) < lit
    return shown


def _slants(found: Chords) -> Rows:
    """The line character's bit of each chord: 0 level, 1 rising, 2 upright, 3 falling, as it looks in tall cells."""
    run = found.ends - found.starts
    across, up = run.real, run.imag
    steep = np.abs(up) / TALL
    slants = np.where(across * up > 0.0, 1, 3)
    slants[steep > np.abs(across) * np.tan(3 * np.pi / 8)] = 2
    slants[steep <= np.abs(across) * np.tan(np.pi / 8)] = 0
    return slants
