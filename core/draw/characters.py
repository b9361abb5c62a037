"""Characters of a drawing: each mode's table from a cell's lit dots to a character; marks, labels and the scale bar."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from math import atan2, floor, log10, tau
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.scene import Mark, Scene, Style, Symbol
from core.draw.view import CELL_HEIGHT, View
from core.geometry.piece import Point
from core.units import Unit, from_mm

MAX_SCALE_BAR_SHARE: Final = 0.3
"""Largest share of the window's width that the scale bar takes."""
LABEL_DISTANCE: Final = 2.5
"""Distance of a label from its point, in cell widths."""
MIN_SCALE_BAR_COLUMNS: Final = 16
MIN_SCALE_BAR_ROWS: Final = 3
"""Smaller windows have no scale bar and no axis names."""


@dataclass(eq=False, slots=True)
class CellSheet:
    """A picture's cells row by row: the `characters` and the `styles`, both (rows * columns,)."""

    columns: int
    rows: int
    characters: list[str]
    styles: bytearray


def write_marks_and_labels(sheet: CellSheet, scene: Scene, view: View, mode: Mode) -> None:
    """Write a scene's axis names, labels and marks over a picture's cells."""
    columns, rows, look = sheet.columns, sheet.rows, CELLS_OF_MODE[mode]
    if scene.axes and columns >= MIN_SCALE_BAR_COLUMNS and rows >= MIN_SCALE_BAR_ROWS:
        _name_axes(sheet, view)
    _write_labels(sheet, scene, view)
    for mark in scene.marks:
        column, row = view.cell(mark.at, columns, rows)
        # a NaN is in no cell
        if 0 <= column < columns and 0 <= row < rows:
            here = int(row) * columns + int(column)
            sheet.characters[here] = _sign(mark, look)
            sheet.styles[here] = mark.style


def _sign(mark: Mark, look: Cells) -> str:
    if mark.symbol is Symbol.ARROW:
        return arrow(mark.direction, look.arrows)
    return mark.text if mark.symbol is Symbol.NUMBER else SYMBOLS[mark.symbol]


def _write_labels(sheet: CellSheet, scene: Scene, view: View) -> None:
    """Write the labels whose cells are empty or hold only an axis."""
    for (x, y), text, (right, up) in scene.labels:
        reach = view.scale * LABEL_DISTANCE
        column, row = view.cell((x + right * reach, y + up * reach), sheet.columns, sheet.rows)
        column -= (len(text) - 1) / 2
        if not (0 <= column <= sheet.columns - len(text) and 0 <= row < sheet.rows):
            continue
        first = int(row) * sheet.columns + int(column)
        if all(sheet.styles[cell] in (Style.BACKGROUND, Style.AXIS) for cell in range(first, first + len(text))):
            _write(sheet, int(row), text, Style.NUMBER, int(column))


def scale_bar(scale: float, columns: int, unit: Unit, ends: str) -> str:
    """Return a bar of a round length (1, 2 or 5 times a power of ten, in program units) with that length as text.

    `scale` is millimeters per cell width; the bar runs from the middle of its first cell to that of its last.
    """
    length, decimals = round_length(from_mm(scale * max(columns * MAX_SCALE_BAR_SHARE, 1.0), unit))
    width = max(round(length / from_mm(scale, unit)), 1)
    return f"{ends[0]}{ends[1] * (width - 1)}{ends[2]} {length:.{decimals}f} {unit}"


def round_length(limit: float) -> tuple[float, int]:
    """Return the largest of 1, 2, 5 times a power of ten that is not above `limit`, and the decimals that show it."""
    power = floor(log10(limit))
    length = next(step * 10.0**power for step in (5, 2, 1) if step * 10.0**power <= limit * (1 + 1e-9))
    return length, max(-power, 0)


def arrow(direction: Point, heads: str) -> str:
    """Return the arrowhead of eight, for 0, 45, 90 ... degrees, that is closest to `direction`."""
    return heads[round(atan2(direction[1], direction[0]) / (tau / 8)) % 8]


def _name_axes(sheet: CellSheet, view: View) -> None:
    columns, rows = sheet.columns, sheet.rows
    column, row = view.cell((0.0, 0.0), columns, rows)
    for name, across, down in (("X", columns - 1.0, row), ("Y", column, 0.0)):
        inside = 0 <= across < columns and 0 <= down < rows
        if inside and sheet.styles[int(down) * columns + int(across)] in (Style.BACKGROUND, Style.AXIS):
            _write(sheet, int(down), name, Style.AXIS, int(across))


def _write(sheet: CellSheet, row: int, text: str, style: Style, column: int = 0) -> None:
    text = text[: sheet.columns - column]
    first = row * sheet.columns + column
    sheet.characters[first : first + len(text)] = text
    sheet.styles[first : first + len(text)] = bytes([style]) * len(text)


Characters = NDArray[np.str_]


class Mode(Enum):
    """BRAILLE has 2 x 4 dots per cell, BLOCK 1 x 2 half blocks, ASCII one line character."""

    BRAILLE = "braille"
    BLOCK = "block"
    ASCII = "ascii"


@dataclass(frozen=True, eq=False, slots=True)
class Cells:
    """The way one mode fills a cell.

    `across`, `down`: dots per cell.  `bit` (down * across,): the bit of each dot, row by row.  In ASCII a cell has one
    dot, and the bit follows the direction: level, rising, upright, falling.  `table` (256,): the character of every
    combination of bits.
    `faint` (256,): the characters of cells with only center paths, which thus differ from the surface without color;
    None if the dots are fine enough to keep the two apart.
    `arrows`: heads for 0, 45, 90 ... degrees.  `bar`: the scale bar's end, middle, end.
    """

    across: int
    down: int
    bit: NDArray[np.intp]
    table: Characters
    arrows: str
    bar: str
    faint: Characters | None = None

    @property
    def dot(self) -> tuple[float, float]:
        """A dot's width and height in cell widths."""
        return 1.0 / self.across, CELL_HEIGHT / self.down

    @property
    def fine(self) -> bool:
        """True if dots are fine enough for dotted and thick lines."""
        return self.faint is None

    @property
    def by_dot(self) -> bool:
        """True if the bits are dots, not directions."""
        return self.across * self.down > 1


def _table(characters: dict[int, str], other: str) -> Characters:
    return np.array([characters.get(code, other) for code in range(256)])


SYMBOLS: Final[Mapping[Symbol, str]] = {
    Symbol.START: "S",
    Symbol.PLUNGE: "o",
    Symbol.GOUGE: "!",
    Symbol.DELETED: "x",
    Symbol.CENTER: "+",
}
"""A mark's character; an arrow or a number has its own."""


def _braille() -> Cells:
    table = _table({0: " ", **{code: chr(0x2800 + code) for code in range(1, 256)}}, " ")
    return Cells(2, 4, np.array([0, 3, 1, 4, 2, 5, 6, 7]), table, "→↗↑↖←↙↓↘", "├─┤")


def _block() -> Cells:
    table = _table({0: " ", 1: "▀", 2: "▄"}, "█")
    return Cells(1, 2, np.array([0, 1]), table, ">>^<<<v>", "├─┤", _table({0: " ", 1: "'", 2: "."}, ":"))


def _ascii() -> Cells:
    bends = {1 | 2: "/", 4 | 2: "/", 1 | 8: "\\", 4 | 8: "\\"}
    table = _table({0: " ", 1: "-", 2: "/", 4: "|", 8: "\\", **bends}, "+")
    return Cells(1, 1, np.array([0]), table, ">>^<<<v>", "|-|", _table({0: " "}, "."))


CELLS_OF_MODE: Final[Mapping[Mode, Cells]] = {Mode.BRAILLE: _braille(), Mode.BLOCK: _block(), Mode.ASCII: _ascii()}
"""The way each mode fills a cell."""
