"""Bytes and work of a key on the screens made of widgets, beside stock Textual: `python -m tests.bench.native_keys`.

A stock form of 13 labelled Inputs and the program on the plate of `tests.bench.keys` are started in turn in one run on
one machine, so that ratios can be trusted where times cannot.  `work` is the processor's time of a key until the screen
is at rest, for the program with everything that its workers derive; `echo` is the work until the first byte.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from app.documents.files import save
from core.program.model import Program
from tests.bench.keys import IDLE, Answer, answer, first_paint, plate
from tests.terminal import Terminal, running

STOCK_FORM = """
from textual.app import App
from textual.containers import Horizontal
from textual.widgets import Input, Label

class Form(App):
    CSS = "Horizontal { height: 1; } Label { width: 20; } Input { width: 14; }"

    def compose(self):
        for number in range(13):
            with Horizontal():
                yield Label(f"FIELD {number}")
                yield Input(compact=True)

Form().run(mouse=False)
"""
EMPTY_APP = """
from textual.app import App
from textual.widgets import Input, Static

class Empty(App):
    def compose(self):
        yield Static("READY")

Empty().run(mouse=False)
"""


@contextmanager
def program_at_rest(program: Program) -> Iterator[Terminal]:
    """The program on a file of its own."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.toml"
        save(program, path)
        with running([sys.executable, "-m", "app", str(path)]) as terminal:
            terminal.until("MILL CONTOUR")
            answer(terminal, b"")
            yield terminal


@contextmanager
def stock_at_rest() -> Iterator[Terminal]:
    """The stock form."""
    with running([sys.executable, "-c", STOCK_FORM]) as terminal:
        terminal.until("FIELD 12")
        answer(terminal, b"")
        yield terminal


def report(name: str, answers: list[Answer]) -> str:
    """One line: medians of work in milliseconds and of bytes, and the 95th percentile of the bytes."""
    work, echo = (1000 * statistics.median(each.work[index] for each in answers) for index in (1, 0))
    sizes = sorted(each.count for each in answers)
    high = sizes[round(0.95 * (len(sizes) - 1))]
    return f"{name:<34}{echo:9.1f}{work:9.1f}{statistics.median(sizes):9.0f}{high:9}{len(answers):5}"


def paints(program: Program, rounds: int) -> tuple[float, float]:
    """Median seconds to the first paint of an empty app that imports Input, and of the program, in turn."""
    with tempfile.TemporaryDirectory() as folder:
        save(program, path := Path(folder) / "part.toml")
        ours = [sys.executable, "-m", "app", str(path)]
        empty = [sys.executable, "-c", EMPTY_APP]
        pairs = [(first_paint(empty, "READY"), first_paint(ours, "MILL CONTOUR")) for _ in range(rounds)]
    return statistics.median(pair[0] for pair in pairs), statistics.median(pair[1] for pair in pairs)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", type=int, default=5)
    parser.add_argument("--keys", type=int, default=8)
    options = parser.parse_args()
    program = plate()
    empty, ours = paints(program, options.starts)
    print(f"first paint   empty app {1000 * empty:.0f} ms   cutcomp {1000 * ours:.0f} ms   {ours / empty:.2f}:1")
    print(f"{'':<34}{'echo':>9}{'work':>9}{'bytes':>9}{'95 %':>9}{'n':>5}")
    digits = [str(row % 10).encode() for row in range(options.keys)]
    with stock_at_rest() as terminal:
        print(report("stock form: a digit", [answer(terminal, digit) for digit in digits]))
        print(report("stock form: Tab", [answer(terminal, b"\t") for _ in digits]), flush=True)
    every: list[Answer] = []
    with program_at_rest(program) as terminal:
        for key in (b"105", b"\r", b"\t"):
            answer(terminal, key)
        rows = {
            "a digit of X END": [answer(terminal, digit) for digit in digits],
            "Esc": [answer(terminal, b"\x1b")],
            "Tab": [answer(terminal, b"\t") for _ in digits],
            "Page Down": [answer(terminal, b"\x1b[6~") for _ in digits],
        }
        for name, answers in rows.items():
            print(report(f"plate: {name}", answers), flush=True)
            every += answers
        print(report("plate: every key", every))
        print(f"plate: idle for {IDLE:.0f} s: {terminal.read(quiet=IDLE, longest=IDLE).count} bytes")


if __name__ == "__main__":
    main()
