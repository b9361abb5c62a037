"""What is painted key by key is what the whole screen painted anew shows, on every kind of terminal."""

from __future__ import annotations

import sys
from collections.abc import Mapping

import pytest

from tests.bench.keys import answer
from tests.terminal import Terminal, running

TERMINALS: tuple[Mapping[str, str], ...] = (
    {"COLORTERM": "truecolor"},
    {"TERM": "screen"},
    {"TERM": "vt100", "LANG": "C"},
    {"NO_COLOR": "1"},
)
KEYS = (b"\t", b"\t", b" ", b"\x1b[B", b"1", b".", b"x", b"\r", b"\x1b", b"\x1b[6~", b"\x1bOS", b"\x1bOS", b"\x1a")
PAINT_AGAIN = b"\x0c"


def cells(terminal: Terminal) -> list[object]:
    """Every cell with its looks; of a blank only what a blank shows."""
    screen = terminal.screen
    every = [screen.buffer[y][x] for y in range(screen.lines) for x in range(screen.columns)]
    return [(" ", cell.bg) if cell.data == " " and not (cell.reverse or cell.underscore) else cell for cell in every]


@pytest.mark.parametrize("environment", TERMINALS, ids=lambda one: " ".join(one.values()))
def test_key_by_key_equals_painted_anew(environment: Mapping[str, str]) -> None:
    # Esc acts at once: it would wait longer for the rest of a key than `answer` waits for the screen
    own = {**environment, "ESCDELAY": "1"}
    with running([sys.executable, "-m", "app", "--example", "pocket"], environment=own) as terminal:
        terminal.until("GOUGE none")
        for number, key in enumerate(KEYS):
            answer(terminal, key)
            if number % 4 == 0:
                before = cells(terminal)
                assert answer(terminal, PAINT_AGAIN).count > 1000
                assert cells(terminal) == before
