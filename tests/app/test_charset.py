"""The locale's name decides which characters are written; any other becomes one ASCII character."""

from __future__ import annotations

import io
from itertools import product

import pytest

from app.terminal.capabilities import characters, charset, lookalike, set_charset
from core.draw.characters import CELLS_OF_MODE, Mode

BRAILLE_FIRST, BLOCK_FIRST = ("braille", "block", "ascii"), ("block", "ascii")


@pytest.mark.parametrize(
    ("environment", "name"),
    [
        ({}, "ascii"),
        ({"LANG": ""}, "ascii"),
        ({"LANG": "C"}, "ascii"),
        ({"LANG": "POSIX"}, "ascii"),
        ({"LANG": "C", "LC_CTYPE": "C"}, "ascii"),
        ({"LANG": "C", "LC_CTYPE": "C.UTF-8"}, "utf-8"),
        ({"LC_ALL": "C.UTF-8"}, "utf-8"),
        ({"LANG": "C.UTF-8"}, "utf-8"),
        ({"LANG": "de_DE.utf8"}, "utf-8"),
        ({"LC_CTYPE": "UTF-8"}, "utf-8"),
        ({"LANG": "de_DE.UTF-8", "LC_ALL": "C"}, "ascii"),
        ({"LANG": "de_DE.UTF-8", "LC_CTYPE": "de_DE"}, "iso8859-1"),
        ({"LANG": "de_DE.UTF-8", "LC_ALL": ""}, "utf-8"),
        ({"LANG": "de_DE.ISO-8859-1"}, "iso8859-1"),
        ({"LANG": "de_DE.ISO-8859-15@euro"}, "iso8859-15"),
        ({"LANG": "de_DE@euro"}, "iso8859-1"),
        ({"LANG": "xx.no-such-set"}, "ascii"),
    ],
)
def test_the_character_set_follows_from_the_locale(environment: dict[str, str], name: str) -> None:
    assert charset(environment) == name


@pytest.mark.parametrize(
    ("environment", "chosen", "found"),
    [
        ({"LANG": "C.UTF-8", "TERM": "xterm"}, "", ("utf-8", BRAILLE_FIRST)),
        ({"LANG": "C.UTF-8", "TERM": "linux"}, "", ("utf-8", BLOCK_FIRST)),
        ({"LANG": "C.UTF-8", "TERM": "linux"}, "braille", ("utf-8", BRAILLE_FIRST)),
        ({"LANG": "C", "TERM": "xterm"}, "", ("ascii", ("ascii",))),
        ({"LANG": "C", "TERM": "xterm"}, "block", ("utf-8", ("block", "ascii", "braille"))),
        ({"LANG": "C.UTF-8", "TERM": "xterm"}, "ascii", ("utf-8", ("ascii", "braille", "block"))),
        ({"LANG": "de_DE", "TERM": "xterm"}, "ascii", ("iso8859-1", ("ascii",))),
    ],
)
def test_the_drawing_characters_follow_from_locale_terminal_and_choice(
    environment: dict[str, str], chosen: str, found: tuple[str, tuple[str, ...]]
) -> None:
    assert characters(environment, chosen) == found


def test_each_character_is_replaced_by_one_ascii_character() -> None:
    assert lookalike("│ a… Ünï 中 ⣿ \x9b") == "| a~ Uni ? * ?"
    assert lookalike("╭━╮┃ ▲▼ ✓ ✖ × ▆▏") == "+-+| ^v + ! x ##"
    drawn = [
        text
        for mode in Mode
        for text in (*CELLS_OF_MODE[mode].table, CELLS_OF_MODE[mode].arrows, CELLS_OF_MODE[mode].bar)
    ]
    assert all(len(lookalike(text)) == len(text) and lookalike(text).isascii() for text in drawn)


@pytest.mark.parametrize(("name", "text"), product(("ascii", "iso8859-1", "utf-8"), ("│⣿Üä…", "\ud800", "中\u0301")))
def test_no_written_text_raises_an_error(name: str, text: str) -> None:
    written = io.BytesIO()
    stream = io.TextIOWrapper(written, encoding="utf-8")
    set_charset(stream, name)
    stream.write(text)
    stream.flush()
    assert len(written.getvalue().decode(name)) == len(text)
