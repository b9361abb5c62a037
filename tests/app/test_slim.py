"""Fewer bytes, the same cells: the terminal shows the same as with the full output."""

from __future__ import annotations

from typing import Any

import pyte
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.terminal.cell_diff import PLAIN_STYLE, TOKEN, CellWriter, style_change, style_of

STYLES = ("1", "3", "4", "7", "31", "92", "45", "103", "38;5;188;48;5;16", "1;38;2;1;2;3;48;2;4;5;6", "39;49", "0", "")
TEXTS = ("X", " ", "   ", "word", "│ ", "1.5 ", "é", "\r\n")
OTHERS = (
    "\x1b[2;3H",
    "\x1b[?2026h",
    "\x1b[?2026l",
    "\x1b[?25l",
    "\x1b[?2026$p",
    "\x1b]22;default\x07",
    "\x1b[2J",
    "\x1b7",
)


def displayed_cells(data: str) -> list[tuple[Any, ...]]:
    """Every cell as displayed: of a blank, only its background counts."""
    screen = pyte.Screen(20, 6)
    pyte.Stream(screen).feed(data)
    cells = [screen.buffer[y][x] for y in range(6) for x in range(20)]
    return [_seen(cell) for cell in cells]


def _seen(cell: Any) -> tuple[Any, ...]:
    if cell.data == " " and not cell.reverse and not cell.underscore and not cell.strikethrough:
        return (" ", cell.bg)
    return tuple(cell)


def slim(data: str) -> str:
    """The same text written with a pen, in plain style at its beginning and end."""
    pen = CellWriter(None, 0, erases=False)
    wanted = PLAIN_STYLE
    for style, place, other, text in TOKEN.findall(data):
        if text:
            pen.write(text, wanted)
        elif place:
            pen.out.append(place)
        elif other:
            pen.turn(wanted)
            pen.out.append(other)
        else:
            wanted = PLAIN_STYLE if style in ("", "0") else style_of(style)
    pen.turn(PLAIN_STYLE)
    return "".join(pen.out)


def painted(pieces: list[tuple[str, str, str]]) -> str:
    """Text as Textual writes it: a sequence, then a style, a text, and a reset."""
    return "".join(f"{other}\x1b[{style}m{text}\x1b[0m" for other, style, text in pieces)


@given(
    st.lists(
        st.tuples(st.sampled_from(("", "", *OTHERS)), st.sampled_from(STYLES), st.sampled_from(TEXTS)), max_size=12
    )
)
def test_the_same_cells_in_no_more_bytes(pieces: list[tuple[str, str, str]]) -> None:
    data = painted(pieces)
    assert displayed_cells(slim(data)) == displayed_cells(data)
    assert len(slim(data)) <= len(data)


@pytest.mark.parametrize(
    ("data", "sent"),
    [
        ("\x1b[31mA\x1b[0m\x1b[31mB\x1b[0m", "\x1b[31mAB\x1b[0m"),
        ("\x1b[31mA\x1b[0m\x1b[32m  \x1b[0m\x1b[31mB\x1b[0m", "\x1b[31mA  B\x1b[0m"),
        ("\x1b[31;44mA\x1b[0m\x1b[32;44mB\x1b[0m", "\x1b[31;44mA\x1b[32mB\x1b[0m"),
        ("\x1b[1;31mA\x1b[0m\x1b[31mB\x1b[0m", "\x1b[1;31mA\x1b[0;31mB\x1b[0m"),
        ("\x1b[31mA\x1b[0m\x1b[7m \x1b[0m", "\x1b[31mA\x1b[0;7m \x1b[0m"),
        ("\x1b[31mA\x1b[0m", "\x1b[31mA\x1b[0m"),
        ("plain", "plain"),
    ],
)
def test_redundant_styles_are_left_out(data: str, sent: str) -> None:
    assert slim(data) == sent


def test_changing_a_style_sends_only_what_differs() -> None:
    style = style_of("1;38;2;1;2;3;48;5;4")
    assert style == (frozenset({"1"}), "38;2;1;2;3", "48;5;4")
    assert style_change(PLAIN_STYLE, style) == "\x1b[1;38;2;1;2;3;48;5;4m"
    assert style_change(style, style) == ""
    assert style_change(style, PLAIN_STYLE) == "\x1b[0m"
