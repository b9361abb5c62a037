"""Keys split by a slow link, through a real pseudo-terminal: they act as keys or not at all, and lose no work."""

from __future__ import annotations

import random
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.programs import example
from core.program.model import Number
from tests.app.documents.typist import started
from tests.app.test_file_actions import DEAD
from tests.reports.relay import Line, relayed
from tests.terminal import Terminal, cutcomp, running

PROGRAM = cutcomp()
ESC = b"\x1b"
CAME_TORN = "The link split a key in two"


@pytest.fixture
def square(tmp_path: Path) -> Path:
    return Path(shutil.copy(example("overrun-square"), tmp_path / "square.toml"))


@contextmanager
def on_x_start(part: Path, line: Line | None = None) -> Iterator[Terminal]:
    """The program with the cursor on X START and a number half typed."""
    with running([*PROGRAM, str(part)]) as inner, relayed(inner, line or Line()) as terminal:
        terminal.until("best", longest=30.0)
        terminal.send(b"\t\t\t\t2.5")
        terminal.until("X START                 2.5")
        yield terminal


def split(terminal: Terminal, tail: bytes, seconds: float) -> None:
    terminal.send(ESC)
    time.sleep(seconds)
    terminal.send(tail)


def left_with_work(part: Path) -> None:
    """Leave the journal of a program that was killed while it had unsaved work."""
    started(part.parent / "own", part, DEAD).type(7).killed()


def test_split_arrows_and_function_keys_act_as_whole_ones(square: Path) -> None:
    with on_x_start(square) as terminal:
        split(terminal, b"[B", 0.15)
        terminal.until("undo 1")
        terminal.send(b"3.5")
        split(terminal, b"[B", 0.28)
        terminal.until("undo 2")
        for tail, title in ((b"OS", "PROGRAM PARAMETERS"), (b"[17~", "TOOL SETUP")):
            split(terminal, tail, 0.15)
            terminal.until(title)
            terminal.send(b"\x1b[19~")
            terminal.until("X START")
        terminal.send(b"\x13")
        terminal.until("Saved")
        assert "[B" not in terminal.text
    block = load(square).blocks[0]
    assert (block.x_start, block.y_start) == (Number(2.5), Number(3.5))


def test_a_late_tail_is_reported_and_neither_typed_nor_a_key_while_esc_still_works(square: Path) -> None:
    with on_x_start(square) as terminal:
        for number, tail in enumerate((b"[B", b"OS", b"[17~"), 1):
            split(terminal, tail, 0.6)
            terminal.until(CAME_TORN)
            assert tail.decode() not in terminal.text
            assert "X START" in terminal.text
            terminal.send(b"3.%d\r" % number)
            terminal.until(f"undo {number}")
            # back to X START
            terminal.send(b"\x1b[A")
            if number < 3:
                terminal.send(b"2.5")
                terminal.until("X START                 2.5")
        terminal.send(ESC + b"6")
        terminal.until("IMPORT TABLE")
        terminal.send(ESC + b"8")
        terminal.until("where the contour starts")
        terminal.send(ESC)
        terminal.until("1 to 8 press the softkey now")
        terminal.send(b"6")
        terminal.until("IMPORT TABLE")
        terminal.send(b"\x13")
        terminal.until("Saved")
    assert load(square).blocks[0].x_start == Number(3.3)


def test_a_split_arrow_on_the_question_discards_nothing(square: Path) -> None:
    left_with_work(square)
    with running([*PROGRAM, str(square)]) as terminal:
        terminal.until("UNSAVED WORK FOUND")
        split(terminal, b"[D", 0.15)
        terminal.read(quiet=0.5)
        assert "UNSAVED WORK FOUND" in terminal.text
        split(terminal, b"[D", 1.2)
        terminal.read(quiet=0.5)
        assert "Kept as a backup" not in terminal.text
    # an Esc whose tail is late leaves the question, which returns at the next start
    with running([*PROGRAM, str(square)]) as terminal:
        terminal.until("UNSAVED WORK FOUND", longest=30.0)
        terminal.send(b"r")
        terminal.until("Your work is back")


def test_keys_work_over_a_link_with_delays_of_up_to_300_ms(square: Path) -> None:
    """Each byte has its own delay: no key types anything, and each number goes into its field."""
    line = Line(jitter=0.3, chance=random.Random(7))
    with on_x_start(square, line) as terminal:
        terminal.send(b"\x1b[B3.5\x1b[B-4.5\x1b[A\x1b[A\x1b[15~")
        terminal.until("PART SETUP", longest=30.0)
        terminal.send(b"\x1b[19~\x13")
        terminal.until("Saved", longest=30.0)
    block = load(square).blocks[0]
    assert (block.x_start, block.y_start, block.z_start) == (Number(2.5), Number(3.5), Number(-4.5))
