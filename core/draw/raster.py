"""Raster: a scene as rows of characters with a role for every cell.

One chain of arrays for all layers: pieces -> chords in the window -> dots -> bits of a cell -> a character of the mode.

Chords are in window coordinates: the window's center is 0, a cell is 1 wide and `CELL_HEIGHT` high, the second axis
points up; a point is one complex number.  Arcs are trimmed to the part near the window before they are divided, so that
no zoom makes them expensive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, tau
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.draw.areas import inside
from core.draw.characters import CELLS_OF_MODE, Cells, CellSheet, Mode, write_marks_and_labels
from core.draw.scene import DOTTED_STYLES, MAX_DRAWN_COORDINATE, Area, Layer, Scene, Style
from core.draw.view import CELL_HEIGHT, View
from core.geometry.path import EMPTY, Flags, Floats, Points, Rows, Turns, pieces_of

MAX_CHORD_ERROR: Final = 0.1
"""Largest distance of a chord from its arc, in cell widths: less than half a dot of the finest mode."""
MAX_TURN: Final = tau / 8
"""Largest angle of one chord, in radians."""
MAX_SINGLE_CHORD: Final = 0.25
"""An arc shorter than this, in cell widths, becomes one chord: half a dot of the finest mode."""
MIN_CONCENTRIC_DIVISOR: Final = 1e-9
"""Least divisor for an arc about the window's center, which is either all visible or not at all."""


class Chords(NamedTuple):
    """m chords in window coordinates, ordered by `layers` (m,): each from `starts` by `runs` (m,).

    `along` (m,) is the length traveled on the layer's path up to the chord's start, in cell widths.
    """

    starts: Points
    runs: Points
    layers: Rows
    along: Floats

    def only(self, keep: Rows) -> Chords:
        """Return the chords of these rows."""
        return Chords._make(column[keep] for column in self)


class _Pieces(NamedTuple):
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
        return _Pieces._make(column[keep] for column in self)

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
    both = Chords._make(map(np.concatenate, zip(straight, divided, strict=True)))
    return both.only(both.layers.argsort(kind="stable"))


def _pieces(layers: Sequence[Layer], view: View) -> _Pieces:
    """Return the pieces of all layers that are drawn at all."""
    paths, middle = [layer.path for layer in layers], complex(*view.center)
    counts = [len(path) for path in paths]
    columns = zip(pieces_of(EMPTY), *map(pieces_of, paths), strict=True)
    starts, ends, centers, turns = map(np.concatenate, columns)
    starts, ends, centers = starts - middle, ends - middle, centers - middle
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
    all_visible, hidden = (part >= 1.0) | inside, (within <= 0.0) & ~inside
    half = 2.0 * np.arcsin(np.sqrt(part))
    middle = np.mod((np.angle(-arcs.centers) - _begin(arcs)) * arcs.turns, tau)
    turned = np.array([[-tau], [0.0], [tau]])
    low = np.maximum(middle - half + turned, 0.0)
    high = np.minimum(middle + half + turned, sweeps)
    low[:, all_visible], high[:, all_visible | hidden] = 0.0, 0.0
    high[1] = np.where(all_visible & ~hidden, sweeps, high[1])
    row, arc = np.nonzero(high > low)
    return arcs.only(arc), low[row, arc], (high - low)[row, arc]


DASH_PATTERN: Final = (3.0, 1.8)
"""A dash's period and its lit part, in cell widths."""
AXIS_DASH_PATTERN: Final = (4.0, 1.0)
DOT_SHIFT: Final = 1e-6
"""Share of a dot by which all dots shift: rounding must not move a line that lies exactly between two rows of dots."""
FAINT_STYLES: Final = (Style.AXIS, Style.PATH, Style.LEAD, Style.RAPID)
"""Roles that do not give a cell the surface's character."""
DELETED_CHARACTER: Final = "#"
"""The character of cells with deleted surface if dots are too coarse for a dotted line."""
DOT_PATTERN: Final = (1.0, 0.4)
"""The period and the lit part of a dotted line, in cell widths."""
THICK_STYLES: Final = (Style.UNCUT, Style.CURRENT)
"""Roles drawn two dots thick."""
SHADE_CHARACTERS: Final = {Style.GOUGE_AREA: ":", Style.UNCUT_AREA: "."}
"""The character of a shaded cell if a cell has only one dot."""
AXIS_PHASE: Final = 0.25
"""Phase of an axis's dashes at the window's edge, where rounding cannot decide whether a dot is lit."""

Bits = NDArray[np.bool_]
Styles = NDArray[np.uint8]

NO_AXES: Final = np.empty(0, np.intp)


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    """`rows` of equal length, and the Style of each cell: `styles` (rows, columns)."""

    rows: tuple[str, ...]
    styles: Styles


def draw(scene: Scene, view: View, columns: int, rows: int, mode: Mode) -> Picture:
    """Draw the part of the scene that `view` shows, in columns x rows cells; either may be 0.

    Dots of all layers stay lit.  A cell takes the style of the last layer in it; a circle in it overrides that, and a
    mark overrides both.  Coordinates that are not finite, or too large for any machine, are left out.
    """
    if columns < 1 or rows < 1:
        return Picture(("",) * max(rows, 0), np.zeros((max(rows, 0), max(columns, 0)), np.uint8))
    look = CELLS_OF_MODE[mode]
    layers = scene.outlined
    axes = _axes(view, look, columns, rows) if scene.axes else NO_AXES
    drawn = _thickened(chords(layers, view, columns, rows), layers, look)
    visible = _clipped(drawn, columns / 2, rows * CELL_HEIGHT / 2)
    shades = [(area.style, _shaded(area, view, look, columns, rows)) for area in scene.areas]
    lit, styles, strong, struck = _light(visible, layers, axes, shades, look, columns, rows)
    codes = np.packbits(lit, bitorder="little")
    characters = look.table[codes]
    if look.faint is not None:
        characters = np.where(strong | (styles == Style.AXIS.value), characters, look.faint[codes])
    characters[struck] = DELETED_CHARACTER
    if not look.by_dot:
        for style, dots in shades:
            shaded = dots >> 3
            characters[shaded[codes[shaded] == 0]] = SHADE_CHARACTERS[style]
    sheet = CellSheet(columns, rows, characters.tolist(), bytearray(styles))
    write_marks_and_labels(sheet, scene, view, mode)
    text = "".join(sheet.characters)
    lines = tuple(text[first : first + columns] for first in range(0, len(text), columns))
    return Picture(lines, np.frombuffer(sheet.styles, np.uint8).reshape(rows, columns))


def _axes(view: View, look: Cells, columns: int, rows: int) -> Rows:
    """Return the bits that the X axis, left to right, and the Y axis, top to bottom, light inside the window."""
    (x, y), limit, (dot_width, dot_height) = view.center, MAX_DRAWN_COORDINATE / view.scale, look.dot
    axis_x, axis_y, half_width, half_height = -x / view.scale, -y / view.scale, columns / 2, rows * CELL_HEIGHT / 2
    axes: list[tuple[complex, complex]] = []
    if abs(axis_y) <= half_height and max(half_width, abs(axis_y)) <= limit:
        level = int((half_height - axis_y) / dot_height + DOT_SHIFT)
        axes.append((complex(-half_width, half_height - (level + 0.5) * dot_height), complex(2.0 * half_width, 0.0)))
    if abs(axis_x) <= half_width and max(half_height, abs(axis_x)) <= limit:
        upright = int((axis_x + half_width) / dot_width + DOT_SHIFT)
        axes.append((complex((upright + 0.5) * dot_width - half_width, half_height), complex(0.0, -2.0 * half_height)))
    starts, runs = np.array(axes, np.complex128).reshape(-1, 2).T
    lines = Chords(starts, runs, np.zeros(len(axes), np.intp), np.zeros(len(axes)))
    chord, part, bits = _dots(lines, look, columns, rows)
    return bits[np.mod(part * np.abs(runs)[chord] + AXIS_PHASE, AXIS_DASH_PATTERN[0]) < AXIS_DASH_PATTERN[1]]


def _clipped(lines: Chords, half_width: float, half_height: float) -> Chords:
    """Clip the chords to the window (Liang and Barsky's parameters)."""
    starts, run = lines.starts, lines.runs
    enter, leave = np.zeros(len(run)), np.ones(len(run))
    for start, step, limit in ((starts.real, run.real, half_width), (starts.imag, run.imag, half_height)):
        low, high = _interval_inside(start, step, limit)
        np.maximum(enter, low, out=enter)
        np.minimum(leave, high, out=leave)
    keep = (enter <= leave).nonzero()[0]
    starts, run, enter, leave = starts[keep], run[keep], enter[keep], leave[keep]
    along, ends = lines.along[keep] + enter * np.abs(run), starts + leave * run
    starts = starts + enter * run
    return Chords(starts, ends - starts, lines.layers[keep], along)


def _interval_inside(start: Floats, step: Floats, limit: float) -> tuple[Floats, Floats]:
    """Return the interval of t in which start + t * step is in -limit ... limit; from infinity on if never."""
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (-limit - start) / step, (limit - start) / step
    low, high = np.minimum(first, second), np.maximum(first, second)
    constant = step == 0.0
    if constant.any():
        inside = np.abs(start) <= limit
        low = np.where(constant, np.where(inside, -np.inf, np.inf), low)
        high = np.where(constant, np.inf, high)
    return low, high


def _thickened(lines: Chords, layers: Sequence[Layer], look: Cells) -> Chords:
    """Return the chords, with copies of those in thick roles one dot to the right and one dot down."""
    if not look.fine:
        return lines
    thick = np.array([layer.style in THICK_STYLES for layer in layers], np.bool_)
    thick_chords = lines.only(thick[lines.layers].nonzero()[0]) if len(layers) else lines
    wide, high = look.dot
    copies = (thick_chords._replace(starts=thick_chords.starts + shift) for shift in (wide, -1j * high))
    all_chords = Chords._make(map(np.concatenate, zip(lines, *copies, strict=True)))
    return all_chords.only(all_chords.layers.argsort(kind="stable"))


def _shaded(area: Area, view: View, look: Cells, columns: int, rows: int) -> Rows:
    """Return the bits of dots to light in an area: with fine dots every other one of a gouge, every fourth if uncut."""
    (dot_width, dot_height), dense = look.dot, area.style is Style.GOUGE_AREA
    down, across = np.divmod(np.arange(rows * look.down * columns * look.across), columns * look.across)
    spread = (down + across) % (2 if look.by_dot else 1) == 0
    if look.fine and not dense:
        spread = (across % 2 == 0) & ((down + across // 2) % 2 == 0)
    (x, y), half_width, half_height = view.center, columns / 2, rows * CELL_HEIGHT / 2
    along = x + ((across[spread] + 0.5) * dot_width - half_width) * view.scale
    up = y + (half_height - (down[spread] + 0.5) * dot_height) * view.scale
    bits: Rows = _bits(look, columns, rows)[spread][inside(area.region, along, up)]
    return bits


def _light(
    lines: Chords,
    layers: Sequence[Layer],
    axes: Rows,
    shades: Sequence[tuple[Style, Rows]],
    look: Cells,
    columns: int,
    rows: int,
) -> tuple[Bits, Styles, Bits | None, Rows]:
    """Return the bits lit (rows x columns x 8,), the styles (rows x columns,), which cells hold more than center paths
    if the mode needs it, and the cells with deleted surface.  Layers win over the bits of `axes` and `shades`."""
    chord, part, bits = _dots(lines, look, columns, rows)
    # the last style belongs to no layer: there may be no layers
    roles = np.frombuffer(bytes((*(layer.style for layer in layers), Style.AXIS)), np.uint8)
    role = roles[lines.layers][chord]
    dashed = [layer.dashed and (look.fine or layer.style is not Style.DELETED) for layer in layers]
    if any(dashed):
        on_dash = _dashes(lines, np.array(dashed)[lines.layers][chord].nonzero()[0], chord, part, role)
        bits, role = bits[on_dash], role[on_dash]
    cell = bits >> 3
    lit, styles = np.zeros(rows * columns * 8, np.bool_), np.zeros(rows * columns, np.uint8)
    lit[axes], styles[axes >> 3] = True, Style.AXIS
    for style, dots in shades:
        lit[dots], styles[dots >> 3] = look.by_dot, style
    lit[bits], styles[cell] = True, role
    strong = None
    if look.faint is not None:
        strong = np.zeros(rows * columns, np.bool_)
        strong[cell[~np.isin(role, FAINT_STYLES)]] = True
    return lit, styles, strong, cell[role == Style.DELETED.value] if not look.fine else NO_AXES


def _bits(look: Cells, columns: int, rows: int) -> Rows:
    """Return (dots,) the bit that each dot of a window lights, row by row; each cell has eight bits."""
    down, across = np.divmod(np.arange(rows * look.down * columns * look.across), columns * look.across)
    cell = down // look.down * columns + across // look.across
    bits: Rows = cell * 8 + look.bit[down % look.down * look.across + across % look.across]
    return bits


def _dots(lines: Chords, look: Cells, columns: int, rows: int) -> tuple[Rows, Floats, Rows]:
    """Return each dot's chord, the fraction of the chord before the dot and the bit to light (m,), by chord."""
    (dot_width, dot_height), start, run = look.dot, lines.starts, lines.runs
    x, y = (
        (start.real + columns / 2) / dot_width + DOT_SHIFT,
        (rows * CELL_HEIGHT / 2 - start.imag) / dot_height + DOT_SHIFT,
    )
    dots_across, dots_down = run.real / dot_width, run.imag / -dot_height
    steps = np.ceil(np.maximum(np.abs(dots_across), np.abs(dots_down))).astype(np.intp)
    counts = steps + 1
    chord = np.arange(len(counts)).repeat(counts)
    nth = np.arange(len(chord)) - (counts.cumsum() - counts)[chord]
    part = nth * (1.0 / np.maximum(steps, 1))[chord]
    across = (x[chord] + part * dots_across[chord]).astype(np.intp)
    down = (y[chord] + part * dots_down[chord]).astype(np.intp)
    width, height = columns * look.across, rows * look.down
    across, down = np.minimum(across, width - 1), np.minimum(down, height - 1)
    dot = np.maximum(down, 0) * width + np.maximum(across, 0)
    return chord, part, _bits(look, columns, rows)[dot] if look.by_dot else dot * 8 + _slants(lines)[chord]


def _dashes(lines: Chords, rows: Rows, chord: Rows, part: Floats, role: Styles) -> Bits:
    """Return which dots (m,) are lit: part of each period in the dots `rows` of dashed lines, and all other dots."""
    lit_dots = np.ones(len(chord), np.bool_)
    owners = chord[rows]
    along = lines.along[owners] + part[rows] * np.abs(lines.runs[owners])
    dotted = np.isin(role[rows], [style.value for style in DOTTED_STYLES])
    period, lit = (np.where(dotted, fine, coarse) for fine, coarse in zip(DOT_PATTERN, DASH_PATTERN, strict=True))
    lit_dots[rows] = np.mod(along, period) < lit
    return lit_dots


def _slants(lines: Chords) -> Rows:
    """Return the bit of each chord's line character: 0 level, 1 rising, 2 upright, 3 falling, as seen in tall cells."""
    across, up = lines.runs.real, lines.runs.imag
    steep = np.abs(up) / CELL_HEIGHT
    slants = np.where(across * up > 0.0, 1, 3)
    slants[steep > np.abs(across) * np.tan(3 * np.pi / 8)] = 2
    slants[steep <= np.abs(across) * np.tan(np.pi / 8)] = 0
    return slants
