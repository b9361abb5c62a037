"""This module keeps the cells that the terminal shows, and sends only those cells of a picture that differ.

Textual paints a line from its first changed cell to its last one, and the whole screen more often than it changes.
The known cells are forgotten as soon as something else may have written on the terminal: after a resize, after the
program was stopped, and at every control sequence that is not known to leave the cells alone.  From then on
everything is sent, until one picture covers the whole terminal.

Textual also sends every piece of text with all of its colors before it and a reset after it.  Here a color is sent only
when it changes, and blanks are sent in any text color, which does not show on them.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import compress, groupby
from operator import ne
from typing import Final, NamedTuple

from rich.cells import cell_len

TOKEN: Final = re.compile(
    r"\x1b\[([0-9;]*)m"
    r"|(\x1b\[[0-9]+;[0-9]+H|\r\n)"
    r"|(\x1b\[[0-?]*[ -/]*[@-~]|\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)|[\x00-\x1f\x7f])"
    r"|([^\x00-\x1f\x7f]+)"
)
"""A style; a cursor position; another control sequence; text."""
NEUTRAL: Final = re.compile(
    r"(?:\x1b\[\?(?:7|25|1000|1003|1004|1006|1015|1016|2004|2026|2048)(?:h|l|\$p)|\x1b\]22;[^\x07\x1b]*(?:\x07|\x1b\\)|\x07)*"
)
"""Sequences that leave all cells as they are."""
PLACE: Final = re.compile(r"\x1b\[([0-9]+);([0-9]+)H")
CURSOR_HOME: Final = "\x1b[H"
ERASE_LINE: Final = "\x1b[K"
"""Erases to the end of the line."""
MIN_ERASED_BLANKS: Final = 5
"""The fewest blanks that are erased instead of written."""


class Style(NamedTuple):
    """What a control sequence turns on after a reset: attributes, text color (ink), background (paper)."""

    attributes: frozenset[str] = frozenset()
    ink: str = "39"
    paper: str = "49"


PLAIN_STYLE: Final = Style()
SHOWN_ON_BLANKS: Final = frozenset({"4", "7", "9", "21", "53"})
"""Attributes that show on a blank: underlines, reverse, strikethrough, overline."""


@lru_cache(256)
def style_of(parameters: str) -> Style:
    """Return the style that a sequence's parameters give after a reset."""
    attributes, ink, paper = set(), PLAIN_STYLE.ink, PLAIN_STYLE.paper
    rest = parameters.split(";")
    while rest:
        number = rest.pop(0)
        if number in ("38", "48") and rest:
            length = 2 if rest[0] == "5" else 4
            color, rest = ";".join([number, *rest[:length]]), rest[length:]
            ink, paper = (color, paper) if number == "38" else (ink, color)
        elif len(number) > 1 and number[:-1] in ("3", "9"):
            ink = number
        elif number[:-1] in ("4", "10"):
            paper = number
        else:
            attributes.add(number)
    return Style(frozenset(attributes), ink, paper)


@lru_cache(512)
def style_change(now: Style, then: Style) -> str:
    """Return the shortest sequence that changes one style into another."""
    if now == then:
        return ""
    if then == PLAIN_STYLE:
        return "\x1b[0m"
    lists = ["0", *_added(PLAIN_STYLE, then)], _added(now, then)
    return min((f"\x1b[{';'.join(codes)}m" for codes in lists[: 1 if now.attributes - then.attributes else 2]), key=len)


def _added(base: Style, then: Style) -> list[str]:
    """Return the parameters that change `base` into a style with all of its attributes."""
    colors = [new for old, new in ((base.ink, then.ink), (base.paper, then.paper)) if old != new]
    return [*sorted(then.attributes - base.attributes), *colors]


def alike_on_blanks(now: Style, then: Style) -> bool:
    """True if blanks look the same in both styles."""
    visible = (now.attributes | then.attributes) & SHOWN_ON_BLANKS
    return not visible and now.paper == then.paper


class Cell(NamedTuple):
    """A character and its style; for a blank only what shows on a blank."""

    text: str
    style: Style

    @property
    def blank(self) -> bool:
        """True if erasing can give the same cell."""
        return self.text == " " and not self.style.attributes


Line = list[Cell | None]
"""None marks an unknown cell; then the whole line is unknown."""


@dataclass(slots=True)
class TerminalCells:
    """The cells of the terminal; `size` returns its current columns and rows.

    `erases` is True if erased cells take the color in force, as on most terminals; if not, only cells with the
    terminal's own background are erased.
    """

    size: Callable[[], tuple[int, int]]
    erases: bool = False
    lines: list[Line] = field(default_factory=list)
    cursor: tuple[int, int] | None = None
    stale: bool = False

    def forget(self) -> None:
        """Forget the cells; this is safe at any moment, also in a signal handler.

        A write in progress goes on with the known cells; the next one knows nothing.
        """
        self.stale = True

    def write(self, data: str) -> str:
        """Return what to send so that the terminal shows what `data` would make it show."""
        if NEUTRAL.fullmatch(data):
            return data
        columns, rows = self.size()
        if self.stale or (self.lines and (len(self.lines[0]), len(self.lines)) != (columns, rows)):
            self._drop_known()
        known = self.lines or [[None] * columns for _ in range(rows)]
        changed, cursor = parse_paint(data, columns, known)
        # without known cells, a picture must cover the whole terminal
        if cursor is None or not (self.lines or sum(None not in line for line in changed.values()) == rows):
            self._drop_known()
            return data
        self.lines = known
        writer = CellWriter(self.cursor, columns, self.erases)
        for row, line in sorted(changed.items()):
            writer.line(row, known[row], line)
            known[row] = line
        writer.move(*cursor)
        self.cursor = cursor
        writer.turn(PLAIN_STYLE)
        return "".join(writer.out)

    def _drop_known(self) -> None:
        # cleared first: a `forget` from here on takes effect at the next write
        self.stale = False
        self.lines, self.cursor = [], None


class Cells(dict[str, Cell]):
    """Cells of one style by character; equal cells are the same object, so that lines are compared quickly."""

    def __init__(self, style: Style) -> None:
        self.style = style

    def __missing__(self, text: str) -> Cell:
        plain = text == " " and not self.style.attributes & SHOWN_ON_BLANKS
        self[text] = Cell(text, Style(paper=self.style.paper) if plain else self.style)
        return self[text]


_styled: Final = lru_cache(256)(Cells)


def neighbors(line: Line, columns: list[int]) -> Iterator[tuple[int, str, Style]]:
    """Yield the cells in these columns: adjacent ones in one style as one text, with its first column."""
    # the difference of column and place stays the same as long as no column is left out
    cells = [(column - place, column, cell) for place, column in enumerate(columns) if (cell := line[column])]
    for (_, style), run in groupby(cells, lambda each: (each[0], each[2].style)):
        together = list(run)
        yield together[0][1], "".join([cell.text for _, _, cell in together]), style


def parse_paint(data: str, columns: int, lines: list[Line]) -> tuple[dict[int, Line], tuple[int, int] | None]:
    """Return the lines that a text changes, with their new cells, and the cursor (row, column) after it.

    The cursor is None if the text does anything but paint, or leaves the terminal's area.
    """
    # text before the first cursor position would go wherever the cursor is
    changed, style, row, column = dict[int, Line](), PLAIN_STYLE, len(lines), 0
    for parameters, place, other, text in TOKEN.findall(data):
        if text:
            if row >= len(lines) or column + len(text) > columns or not is_single_cell(text):
                return {}, None
            if row not in changed:
                changed[row] = lines[row].copy()
            changed[row][column : column + len(text)] = map(_styled(style).__getitem__, text)
            column += len(text)
        elif other == "\n" or place == "\r\n":
            row, column = row + 1, 0
        elif match := PLACE.fullmatch(place):
            row, column = int(match[1]) - 1, int(match[2]) - 1
        elif other:
            return {}, None
        else:
            style = PLAIN_STYLE if parameters in ("", "0") else style_of(parameters)
    return changed, (row, column) if row < len(lines) and column < columns else None


def is_single_cell(text: str) -> bool:
    """True if every character takes one cell."""
    return text.isascii() or all(cell_len(character) == 1 for character in set(text))


@dataclass(slots=True)
class CellWriter:
    """Writes cells; holds the cursor's position, the style in force, and what goes to the terminal."""

    cursor: tuple[int, int] | None
    columns: int
    erases: bool
    now: Style = PLAIN_STYLE
    out: list[str] = field(default_factory=list)

    def has(self, text: str, wanted: Style) -> bool:
        """True if this text can be written without a change of style."""
        return self.now == wanted or (text.isspace() and alike_on_blanks(self.now, wanted))

    def write(self, text: str, wanted: Style) -> None:
        """Write text in a style."""
        if not self.has(text, wanted):
            self.turn(wanted)
        self.out.append(text)

    def turn(self, wanted: Style) -> None:
        """Change to another style."""
        self.out.append(style_change(self.now, wanted))
        self.now = wanted

    def line(self, row: int, old: Line, new: Line) -> None:
        """Write the cells of a line that differ; an unknown line is erased first."""
        if old[0] is None:
            old = self._erase_unknown(row, new)
        changed = list(compress(range(len(new)), map(ne, old, new)))
        tail = self._tail(new) if len(changed) >= MIN_ERASED_BLANKS else len(new)
        erased = len(changed) >= MIN_ERASED_BLANKS and changed[-MIN_ERASED_BLANKS] >= tail
        written = [column for column in changed if column < tail] if erased else changed
        for column, text, style in neighbors(new, written):
            self._reach(row, column, new)
            self.write(text, style)
            self._advance(row, column + len(text))
        if erased and (last := new[-1]) is not None:
            self._erase(row, tail, last)

    def move(self, row: int, column: int) -> None:
        """Move the cursor to a cell with the shortest sequence."""
        if self.cursor == (row, column):
            return
        sequences = [CURSOR_HOME if (row, column) == (0, 0) else f"\x1b[{row + 1}{f';{column + 1}' if column else ''}H"]
        if self.cursor is not None and self.cursor[0] == row and column > self.cursor[1]:
            steps = column - self.cursor[1]
            sequences.append(f"\x1b[{steps if steps > 1 else ''}C")
        self.out.append(min(sequences, key=len))
        self.cursor = row, column

    def _reach(self, row: int, column: int, line: Line) -> None:
        """Go to a cell; rewrite the cells in between if that is shorter, which five cells or more never are."""
        if self.cursor == (row, column):
            return
        if self.cursor is None or self.cursor[0] != row or column - self.cursor[1] > 4:
            self.move(row, column)
            return
        between = [cell for cell in line[self.cursor[1] : column] if cell is not None]
        text = "".join([cell.text for cell in between])
        short = len(text.encode()) <= (3 if len(between) == 1 else 4)
        if between and short and all(self.has(*cell) for cell in between):
            self.out.append(text)
            self._advance(row, column)
        else:
            self.move(row, column)

    def _advance(self, row: int, column: int) -> None:
        """Set the cursor after text; beyond the last column it is unknown, as terminals differ there."""
        self.cursor = (row, column) if column < self.columns else None

    def _erase_unknown(self, row: int, new: Line) -> Line:
        """Erase an unknown line in the color of most of its blanks, if possible; return its cells then."""
        papers = Counter(cell.style for cell in new if cell is not None and cell.blank and self._erasable(cell.style))
        if not papers:
            return [None] * self.columns
        blank = Cell(" ", papers.most_common(1)[0][0])
        self._erase(row, 0, blank)
        return [blank] * self.columns

    def _tail(self, line: Line) -> int:
        """Return the first column from which erasing gives the rest of a line; its length if there is none."""
        last = line[-1]
        if last is None or not last.blank or not self._erasable(last.style):
            return len(line)
        return next((column + 1 for column in reversed(range(len(line))) if line[column] != last), 0)

    def _erase(self, row: int, column: int, blank: Cell) -> None:
        """Erase to the end of the line."""
        self.move(row, column)
        if not alike_on_blanks(self.now, blank.style):
            self.turn(blank.style)
        self.out.append(ERASE_LINE)

    def _erasable(self, style: Style) -> bool:
        return self.erases or style.paper == PLAIN_STYLE.paper
