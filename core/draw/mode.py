"""The ways of drawing with characters: how many dots a cell has, and the table from its lit dots to a character."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.draw.scene import Symbol
from core.draw.view import TALL

Characters = NDArray[np.str_]


class Mode(Enum):
    """BRAILLE 2 x 4 dots a cell, BLOCK half blocks 1 x 2, ASCII one line character a cell."""

    BRAILLE = "braille"
    BLOCK = "block"
    ASCII = "ascii"


@dataclass(frozen=True, eq=False, slots=True)
class Cells:
    """How one mode fills a cell.

    `across`, `down`: dots a cell.  `bit` (down * across,): the bit a dot lights, line by line.  In ASCII a cell has one
    dot and the bit is chosen by direction: level, rising, upright, falling.  `table` (256,): the character of every
    combination.
    `faint` (256,): that of a cell in which only center paths are, so that they differ from the surface without colors;
    None where the dots are fine enough to keep the two apart.
    `symbols`: a mark's character; `arrows`: heads for 0, 45, 90 ... degrees.  `bar`: the scale bar's end, middle, end.
    """

    across: int
    down: int
    bit: NDArray[np.intp]
    table: Characters
    symbols: Mapping[Symbol, str]
    arrows: str
    bar: str
    faint: Characters | None = None

    @property
    def dot(self) -> tuple[float, float]:
        """A dot's width and height in cells' widths."""
        return 1.0 / self.across, TALL / self.down

    @property
    def by_dot(self) -> bool:
        """The bits are dots, and not directions."""
        return self.across * self.down > 1


def cells(mode: Mode) -> Cells:
    """The table of a mode."""
    return _CELLS[mode]


def _table(characters: dict[int, str], other: str) -> Characters:
    return np.array([characters.get(code, other) for code in range(256)])


_SYMBOLS: Final[Mapping[Symbol, str]] = MappingProxyType(
    {
        Symbol.START: "S",
        Symbol.ARROW: ">",
        Symbol.PLUNGE: "o",
        Symbol.GOUGE: "!",
        Symbol.DELETED: "x",
        Symbol.CENTER: "+",
    }
)


def _braille() -> Cells:
    table = _table({0: " ", **{code: chr(0x2800 + code) for code in range(1, 256)}}, " ")
    bit = np.array([0, 3, 1, 4, 2, 5, 6, 7])
    return Cells(2, 4, bit, table, _SYMBOLS, "→↗↑↖←↙↓↘", "├─┤")


def _block() -> Cells:
    table = _table({0: " ", 1: "▀", 2: "▄"}, "█")
    return Cells(1, 2, np.array([0, 1]), table, _SYMBOLS, ">>^<<<v>", "├─┤", _table({0: " ", 1: "'", 2: "."}, ":"))


def _ascii() -> Cells:
    bends = {1 | 2: "/", 4 | 2: "/", 1 | 8: "\\", 4 | 8: "\\"}
    table = _table({0: " ", 1: "-", 2: "/", 4: "|", 8: "\\", **bends}, "+")
    return Cells(1, 1, np.array([0]), table, _SYMBOLS, ">>^<<<v>", "|-|", _table({0: " "}, "."))


_CELLS: Final[Mapping[Mode, Cells]] = MappingProxyType(
    {Mode.BRAILLE: _braille(), Mode.BLOCK: _block(), Mode.ASCII: _ascii()}
)
