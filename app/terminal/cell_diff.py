"""What stands on the terminal, cell by cell: of every picture only the cells that differ from it are sent.

Textual paints a line from its first changed cell to its last one, and the whole screen more often than it changes.
What is known of the terminal is forgotten as soon as somebody else may have written on it: after a resize, after the
program was stopped, and with every control sequence that is not known to leave the cells as they are.  From then on
everything is sent, until a picture has covered the terminal as a whole.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import compress
from operator import ne
from typing import Final, NamedTuple

from rich.cells import cell_len

from app.terminal.fewer_bytes import PLAIN, SHOWN_ON_BLANKS, TOKEN, Pen, Style, alike_on_blanks, read, slim

NEUTRAL: Final = re.compile(
    r"(?:\x1b\[\?(?:7|25|1000|1003|1004|1006|1015|1016|2004|2026|2048)(?:h|l|\$p)|\x1b\]22;[^\x07\x1b]*(?:\x07|\x1b\\)|\x07)*"
)
"""Sequences that leave all cells as they are."""
PLACE: Final = re.compile(r"\x1b\[([0-9]+);([0-9]+)H")
HOME: Final = "\x1b[H"
ERASE_LINE: Final = "\x1b[K"
"""To the end of the line."""
SHORTEST: Final = 5
"""So many blanks are erased sooner than written."""


class Cell(NamedTuple):
    """A character and how it looks; of a blank only what a blank shows."""

    text: str
    style: Style

    @property
    def blank(self) -> bool:
        """Whether erasing makes the same of it."""
        return self.text == " " and not self.style.attributes


class Run(NamedTuple):
    """Text of one style from a cell on."""

    row: int
    column: int
    text: str
    style: Style


Line = list[Cell | None]
"""None: nobody knows what stands there, and nowhere else in that line."""


@dataclass(slots=True)
class Shown:
    """The cells of the terminal; `size` tells how many columns and rows it has just now.

    `erases` says that erasing leaves the color in force behind, as most terminals do it: where it does not, only
    the terminal's own paper is erased.
    """

    size: Callable[[], tuple[int, int]]
    erases: bool = False
    lines: list[Line] = field(default_factory=list)
    cursor: tuple[int, int] | None = None
    stale: bool = False

    def forget(self) -> None:
        """Somebody else may have written on the terminal; may be called at any moment, in a signal handler too.

        A write that is under way goes on with what it knows; the next one knows nothing.
        """
        self.stale = True

    def write(self, data: str) -> str:
        """What has to be sent so that the terminal shows what `data` would make it show."""
        if NEUTRAL.fullmatch(data):
            return data
        columns, rows = self._measured()
        picture = parsed(data, columns, rows)
        if picture is None or not (self.lines or picture.whole(columns, rows)):
            self._forgotten()
            return slim(data)
        self.lines = self.lines or [[None] * columns for _ in range(rows)]
        return self._sent(picture.over(self.lines), picture.cursor)

    def _measured(self) -> tuple[int, int]:
        """Columns and rows of the terminal, of which nothing is known any more if they have changed."""
        columns, rows = self.size()
        if self.stale or (self.lines and (len(self.lines[0]), len(self.lines)) != (columns, rows)):
            self._forgotten()
        return columns, rows

    def _sent(self, lines: Iterable[tuple[int, Line]], cursor: tuple[int, int]) -> str:
        """What makes these lines of those that stand, and puts the cursor there."""
        ink = _Ink(self.cursor, len(self.lines[0]), self.erases)
        for row, line in lines:
            ink.line(row, self.lines[row], line)
            self.lines[row] = line
        ink.move(*cursor)
        self.cursor = cursor
        ink.pen.turn(PLAIN)
        return "".join(ink.pen.out)

    def _forgotten(self) -> None:
        # lowered first: what is forgotten from here on is forgotten before the next write
        self.stale = False
        self.lines, self.cursor = [], None


@dataclass(slots=True)
class Picture:
    """Runs of text on the terminal, and where its cursor stands behind them (row, column)."""

    runs: list[Run] = field(default_factory=list)
    cursor: tuple[int, int] = (0, 0)

    def whole(self, columns: int, rows: int) -> bool:
        """Whether it covers the terminal."""
        covered = [set[int]() for _ in range(rows)]
        for run in self.runs:
            covered[run.row].update(range(run.column, run.column + len(run.text)))
        return all(len(line) == columns for line in covered)

    def over(self, lines: list[Line]) -> Iterator[tuple[int, Line]]:
        """The lines it changes, in order, as they become."""
        changed: dict[int, Line] = {}
        for row, column, text, style in self.runs:
            line = changed.setdefault(row, lines[row].copy()) if row not in changed else changed[row]
            line[column : column + len(text)] = map(_styled(style).__getitem__, text)
        yield from sorted(changed.items())


class Cells(dict[str, Cell]):
    """The characters of one style as cells; the same ones are the same object, so that lines are compared quickly."""

    def __init__(self, style: Style) -> None:
        self.style = style

    def __missing__(self, text: str) -> Cell:
        plain = text == " " and not self.style.attributes & SHOWN_ON_BLANKS
        self[text] = Cell(text, Style(paper=self.style.paper) if plain else self.style)
        return self[text]


_styled: Final = lru_cache(256)(Cells)


def neighbors(line: Line, columns: list[int]) -> Iterator[tuple[int, str, Style]]:
    """Cells of a line in these columns: those side by side in one style as one text, with the first one's column."""
    first, text, style, behind = 0, "", PLAIN, -1
    for column in columns:
        cell = line[column]
        assert cell is not None
        if column == behind and (cell.style is style or cell.style == style):
            text += cell.text
        else:
            if text:
                yield first, text, style
            first, (text, style) = column, cell
        behind = column + 1
    if text:
        yield first, text, style


def parsed(data: str, columns: int, rows: int) -> Picture | None:
    """The picture that a text for the terminal paints; None where it does anything else, or paints beside it."""
    # text before the first place would stand wherever the cursor is
    picture, style, row, column = Picture(), PLAIN, rows, 0
    for parameters, place, other, text in TOKEN.findall(data):
        if text:
            if row >= rows or column + len(text) > columns or not single(text):
                return None
            picture.runs.append(Run(row, column, text, style))
            column += len(text)
        elif other == "\n" or place == "\r\n":
            row, column = row + 1, 0
        elif found := PLACE.fullmatch(place):
            row, column = int(found[1]) - 1, int(found[2]) - 1
        elif other:
            return None
        else:
            style = PLAIN if parameters in ("", "0") else read(parameters)
    picture.cursor = row, column
    return picture if row < rows and column < columns else None


def single(text: str) -> bool:
    """Whether every character takes one cell."""
    return text.isascii() or all(cell_len(one) == 1 for one in set(text))


@dataclass(slots=True)
class _Ink:
    """Writes cells: where the cursor stands and what is on its way to the terminal."""

    cursor: tuple[int, int] | None
    columns: int
    erases: bool
    pen: Pen = field(default_factory=Pen)

    def line(self, row: int, old: Line, new: Line) -> None:
        """The cells of a line that differ; a line of which nothing is known is erased before."""
        if old[0] is None:
            old = self._erased(row, new)
        changed = list(compress(range(len(new)), map(ne, old, new)))
        tail = self._tail(new) if len(changed) >= SHORTEST else len(new)
        erased = len(changed) >= SHORTEST and changed[-SHORTEST] >= tail
        written = [column for column in changed if column < tail] if erased else changed
        for column, text, style in neighbors(new, written):
            self._to(row, column, new)
            self.pen.write(text, style)
            self._went(row, column + len(text))
        if erased and (last := new[-1]) is not None:
            self._erase(row, tail, last)

    def move(self, row: int, column: int) -> None:
        """The cursor to a cell, in the shortest way."""
        if self.cursor == (row, column):
            return
        ways = [HOME if (row, column) == (0, 0) else f"\x1b[{row + 1}{f';{column + 1}' if column else ''}H"]
        if self.cursor is not None and self.cursor[0] == row and column > self.cursor[1]:
            steps = column - self.cursor[1]
            ways.append(f"\x1b[{steps if steps > 1 else ''}C")
        self.pen.out.append(min(ways, key=len))
        self.cursor = row, column

    def _to(self, row: int, column: int, line: Line) -> None:
        """To a cell: what stands between is written again where that is shorter, which of five cells it never is."""
        if self.cursor == (row, column):
            return
        if self.cursor is None or self.cursor[0] != row or column - self.cursor[1] > 4:
            self.move(row, column)
            return
        between = [cell for cell in line[self.cursor[1] : column] if cell is not None]
        text = "".join([cell.text for cell in between])
        short = len(text.encode()) <= (3 if len(between) == 1 else 4)
        if between and short and all(self.pen.has(*cell) for cell in between):
            self.pen.out.append(text)
            self._went(row, column)
        else:
            self.move(row, column)

    def _went(self, row: int, column: int) -> None:
        """The cursor after text; in the last column it stays or hangs, as terminals have it."""
        self.cursor = (row, column) if column < self.columns else None

    def _erased(self, row: int, new: Line) -> Line:
        """A line in the color of most of its blanks, if it can be erased."""
        papers = Counter(cell.style for cell in new if cell is not None and cell.blank and self._erasable(cell.style))
        if not papers:
            return [None] * self.columns
        blank = Cell(" ", papers.most_common(1)[0][0])
        self._erase(row, 0, blank)
        return [blank] * self.columns

    def _tail(self, line: Line) -> int:
        """The first column from which on erasing makes the same of the rest of a line."""
        last = line[-1]
        if last is None or not last.blank or not self._erasable(last.style):
            return len(line)
        return next((column + 1 for column in reversed(range(len(line))) if line[column] != last), 0)

    def _erase(self, row: int, column: int, blank: Cell) -> None:
        """To the end of the line."""
        self.move(row, column)
        if not alike_on_blanks(self.pen.now, blank.style):
            self.pen.turn(blank.style)
        self.pen.out.append(ERASE_LINE)

    def _erasable(self, style: Style) -> bool:
        return self.erases or style.paper == PLAIN.paper
