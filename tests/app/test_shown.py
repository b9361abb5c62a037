"""Only differences are sent, and the terminal shows the same as if everything were sent."""

from __future__ import annotations

from typing import Any

import pyte
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.terminal.cell_diff import CellWriter, Line, TerminalCells

COLUMNS, ROWS = 12, 4
STYLES = ("", "0", "31", "44", "31;44", "1;38;2;1;2;3;48;5;4", "4", "7", "39;49", "2;44")
TEXTS = ("X", " ", "  ", "    ", "word", "│ ", "1.5 ", "é", "      ")
OTHERS = ("\x1b[?2026h", "\x1b[?2026l", "\x1b[?25l", "\x07")
FORGOTTEN = ("\x1b[?1049h", "\x1b7", "\x1b[2J", "\x1b[3;3H\x1b[K", "wörld\x08", "\t", "日本")


class Watched:
    """A terminal that receives the differences, and one that receives everything."""

    def __init__(self, *, erases: bool = True) -> None:
        self.ours, self.whole = (self._screen() for _ in range(2))
        self.columns, self.rows = COLUMNS, ROWS
        self.shown = TerminalCells(lambda: (self.columns, self.rows), erases)

    @staticmethod
    def _screen() -> pyte.Screen:
        screen = pyte.Screen(COLUMNS, ROWS)
        # as the driver sets it: no wrapping at the end of a line
        pyte.Stream(screen).feed("\x1b[?7l")
        return screen

    def write(self, data: str) -> str:
        sent = self.shown.write(data)
        pyte.Stream(self.ours).feed(sent)
        pyte.Stream(self.whole).feed(data)
        return sent

    def resize(self, columns: int, rows: int) -> None:
        self.columns, self.rows = columns, rows
        self.ours.resize(rows, columns)
        self.whole.resize(rows, columns)

    def scribble(self, data: str) -> None:
        """Another program writes on the terminal."""
        pyte.Stream(self.ours).feed(data)
        self.shown.forget()

    @property
    def alike(self) -> bool:
        cursors = [(screen.cursor.y, screen.cursor.x) for screen in (self.ours, self.whole)]
        return displayed_cells(self.ours) == displayed_cells(self.whole) and cursors[0] == cursors[1]


def displayed_cells(screen: pyte.Screen) -> list[Any]:
    """Every cell as displayed: of a blank, only its background counts."""
    cells = [screen.buffer[y][x] for y in range(screen.lines) for x in range(screen.columns)]
    return [(" ", cell.bg) if cell.data == " " and not (cell.reverse or cell.underscore) else cell for cell in cells]


def covering(text: str = " ", style: str = "44", columns: int = COLUMNS, rows: int = ROWS) -> str:
    """The whole terminal filled in one style, as Textual sends it."""
    lines = [f"\x1b[{row + 1};1H\x1b[{style}m{(text * columns)[:columns]}\x1b[0m" for row in range(rows)]
    return "\n".join(lines) + "\x1b[1;1H"


piece = st.tuples(st.integers(1, ROWS), st.integers(1, COLUMNS), st.sampled_from(STYLES), st.sampled_from(TEXTS))
pictures = st.lists(piece, min_size=1, max_size=6).map(
    lambda pieces: (
        "".join(
            f"\x1b[{row};{column}H\x1b[{style}m{text[: COLUMNS - column + 1]}\x1b[0m"
            for row, column, style, text in pieces
        )
        + "\x1b[1;1H"
    )
)
writes = st.one_of(
    pictures,
    pictures,
    st.sampled_from(OTHERS),
    st.sampled_from(FORGOTTEN),
    st.builds(covering, st.sampled_from(("a ", " ", "x  y")), st.sampled_from(STYLES)),
)


@given(st.lists(writes, max_size=8), st.booleans())
def test_the_terminal_shows_what_everything_would_show(data: list[str], erases: bool) -> None:
    watched = Watched(erases=erases)
    for one in [covering(), *data]:
        watched.write(one)
        assert watched.alike


@given(pictures, pictures)
def test_somebody_elses_writing_is_gone_with_the_next_whole_picture(before: str, after: str) -> None:
    watched = Watched()
    watched.write(covering())
    watched.write(before)
    watched.scribble("\x1b[0m\x1b[2J$ ls\r\npart.nc\r\n")
    watched.write(after)
    watched.write(covering("a "))
    assert watched.alike


def test_repeating_a_picture_sends_nothing() -> None:
    watched = Watched()
    watched.write(covering("a "))
    assert watched.write(covering("a ")) == ""


def test_only_cells_that_differ_are_sent() -> None:
    watched = Watched()
    watched.write(covering("a"))
    assert watched.write("\x1b[2;1H\x1b[44maaaaaabaaaaa\x1b[0m\x1b[1;1H") == "\x1b[2;7H\x1b[44mb\x1b[H\x1b[0m"


def test_a_short_gap_is_written_over() -> None:
    watched = Watched()
    watched.write(covering("a", ""))
    assert watched.write("\x1b[2;1Hbabaaaaaaabb\x1b[1;1H") == "\x1b[2Hbab\x1b[7Cbb\x1b[H"


def test_blanks_up_to_the_end_of_a_line_are_erased() -> None:
    watched = Watched()
    watched.write(covering("a"))
    assert watched.write("\x1b[2;1H\x1b[44maa          \x1b[0m\x1b[1;1H") == "\x1b[2;3H\x1b[44m\x1b[K\x1b[H\x1b[0m"


def test_colored_blanks_are_written_when_erasing_leaves_no_color() -> None:
    watched = Watched(erases=False)
    assert "\x1b[K" not in watched.write(covering("a "))
    watched.write(covering("a"))
    assert "\x1b[K" not in watched.write("\x1b[2;1H\x1b[44maa          \x1b[0m\x1b[1;1H")
    assert "\x1b[K" in watched.write("\x1b[2;1Haa          \x1b[1;1H")


@pytest.mark.parametrize("data", FORGOTTEN)
def test_everything_is_sent_after_an_unknown_sequence(data: str) -> None:
    watched = Watched()
    watched.write(covering("a"))
    assert watched.write(data) == data
    part = "\x1b[2;1H\x1b[44maa\x1b[0m\x1b[1;1H"
    assert watched.write(part) == part
    assert watched.write(covering("a")).count("a") == COLUMNS * ROWS
    assert watched.write("\x1b[2;1H\x1b[44maa\x1b[0m\x1b[1;1H") == ""


def test_a_new_size_forgets_the_picture() -> None:
    watched = Watched()
    watched.write(covering("a"))
    watched.resize(COLUMNS + 2, ROWS + 1)
    wrong_size = covering("b")
    assert watched.write(wrong_size) == wrong_size
    watched.write(covering("c", columns=COLUMNS + 2, rows=ROWS + 1))
    assert watched.alike
    assert watched.write("\x1b[1;1H\x1b[44mc\x1b[0m\x1b[1;1H") == ""


def test_everything_is_sent_after_forgetting_in_the_middle_of_a_write(monkeypatch: pytest.MonkeyPatch) -> None:
    watched = Watched()
    watched.write(covering("a"))
    written = CellWriter.line

    def resized_meanwhile(writer: CellWriter, row: int, old: Line, new: Line) -> None:
        written(writer, row, old, new)
        watched.shown.forget()

    monkeypatch.setattr(CellWriter, "line", resized_meanwhile)
    watched.write(covering("b"))
    monkeypatch.setattr(CellWriter, "line", written)
    assert watched.write(covering("b")).count("b") == COLUMNS * ROWS
    assert watched.alike
