"""Bytes and work of a key on the screens made of widgets, beside stock Textual: `python -m tests.bench.keys`.

A stock form of 13 labelled Inputs and the program on a plate of 200 segments are started in turn in one run on
one machine, so that ratios can be trusted where times cannot.  `work` is the processor's time of a key until the screen
is at rest, for the program with everything that its workers derive; `echo` is the work until the first byte.
"""

from __future__ import annotations

import argparse
import os
import select
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import cos, dist, pi, sin
from pathlib import Path

from app.documents.files import save
from core.program.edit import new_block
from core.program.model import ArcSegment, CutterComp, Direction, LineSegment, Number, Program, Segment, Tool
from tests.bench.machine import at_work, worked
from tests.terminal import Terminal, cutcomp, running

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


def gear(count: int) -> Program:
    """A closed outside contour of `count` segments: teeth of lines with arcs on their tips, inch."""
    teeth, inner, outer = count // 4, 3.0, 3.4
    corners = []
    for tooth in range(teeth):
        for radius, part in ((inner, 0.0), (outer, 0.25), (outer, 0.5), (inner, 0.75)):
            angle = 2 * pi * (tooth + part) / teeth
            corners.append((round(radius * cos(angle), 5), round(radius * sin(angle), 5)))
    tip = max(0.2, round(0.75 * dist(corners[1], corners[2]), 5))
    segments = [_side(row, corners[(row + 1) % len(corners)], tip) for row in range(len(corners))]
    block = replace(
        new_block(Program(tools=(Tool(1, diameter=Number(0.25)),))),
        cutter_comp=CutterComp.RIGHT,
        x_start=Number(corners[0][0]),
        y_start=Number(corners[0][1]),
        z_bottom=Number(-0.25),
        plunge_feed=Number(20.0),
        speed=Number(300.0),
        segments=tuple(segments),
    )
    return Program(tools=(Tool(1, diameter=Number(0.125)),), blocks=(block,))


def _side(row: int, end: tuple[float, float], tip: float) -> Segment:
    if row % 4 != 1:
        return LineSegment(x_end=Number(end[0]), y_end=Number(end[1]))
    return ArcSegment(Direction.CCW, x_end=Number(end[0]), y_end=Number(end[1]), radius=Number(tip), choice=0)


def plate(bumps: int = 24) -> Program:
    """A closed outside contour of 8 + 8 * `bumps` segments: a plate with rounded tabs that the tool reaches around."""
    radius, right = 0.25, 2.0 * bumps + 2.0
    corners = [(right, 0.0), (right, 4.0)]
    for tab in range(bumps):
        edge = right - 1.5 - 2.0 * tab
        corners += [(edge, 4.0), (edge, 5.0), (edge - 1.0, 5.0), (edge - 1.0, 4.0)]
    corners += [(0.0, 4.0), (0.0, 0.0)]
    segments: list[Segment] = []
    for row, corner in enumerate(corners):
        before, behind = corners[row - 1], corners[(row + 1) % len(corners)]
        come, go = (_towards(corner, other, radius) for other in (before, behind))
        inside = (corner[0] - before[0]) * (behind[1] - corner[1]) < (corner[1] - before[1]) * (behind[0] - corner[0])
        segments.append(LineSegment(x_end=Number(come[0]), y_end=Number(come[1])))
        turn = Direction.CW if inside else Direction.CCW
        segments.append(ArcSegment(turn, x_end=Number(go[0]), y_end=Number(go[1]), radius=Number(radius), choice=0))
    block = replace(
        new_block(Program(tools=(Tool(1, diameter=Number(0.25)),))),
        cutter_comp=CutterComp.RIGHT,
        x_start=Number(radius),
        y_start=Number(0.0),
        z_bottom=Number(-0.25),
        plunge_feed=Number(20.0),
        speed=Number(300.0),
        segments=tuple(segments),
    )
    return Program(tools=(Tool(1, diameter=Number(0.25)),), blocks=(block,))


def _towards(corner: tuple[float, float], other: tuple[float, float], far: float) -> tuple[float, float]:
    part = far / dist(corner, other)
    (x, y), (to_x, to_y) = corner, other
    return round(x + part * (to_x - x), 5), round(y + part * (to_y - y), 5)


LOOK = 0.02
"""Seconds between two looks at a program that sends nothing."""
TICK = 0.0005
"""Seconds of work between two looks that are only the looking after clocks, such as for the cursor."""
LOOKS = 5
"""So many looks in a row at which it has not run: it is at rest."""
LONGEST = 20.0
"""Seconds after which a program that still runs is given up."""
IDLE = 3.0
"""Seconds without a key."""


@dataclass(frozen=True)
class Answer:
    """What came back after a key: bytes, and seconds to the first derived screen and to the last byte.

    `work` is how much of these seconds the program ran.
    """

    count: int
    changed: float
    finished: float
    work: tuple[float, float]


def answer(terminal: Terminal, key: bytes) -> Answer:
    """Type a key and wait for the program to come to rest; the emulator is fed afterwards, it takes its time."""
    begun, before = time.perf_counter(), worked(terminal.pid)
    terminal.send(key)
    came = [(when - begun, ran - before, data) for when, ran, data in until_rest(terminal)]
    changed = (0.0, 0.0)
    for when, ran, data in came:
        terminal.stream.feed(data)
        if not changed[0] and "calculating" not in terminal.text:
            changed = (when, ran)
    finished = came[-1][:2] if came else (0.0, 0.0)
    return Answer(sum(len(data) for *_, data in came), changed[0], finished[0], (changed[1], finished[1]))


def until_rest(terminal: Terminal, longest: float = LONGEST) -> Iterator[tuple[float, float, bytes]]:
    """What a program sends, each with its time and the work done by then, until it neither sends nor calculates."""
    still, used, begun = 0, -1.0, time.perf_counter()
    while still < LOOKS:
        if select.select([terminal.fd], [], [], LOOK)[0]:
            data = os.read(terminal.fd, 65536)
            still = 0
            yield time.perf_counter(), worked(terminal.pid), data
            continue
        spent = worked(terminal.pid)
        still = 0 if at_work(terminal.pid) or spent - used > TICK else still + 1
        used = spent
        if time.perf_counter() - begun > longest:
            raise AssertionError(f"not at rest after {longest} s:\n{terminal.text}")


def first_paint(arguments: list[str], text: str) -> float:
    """Seconds from the start of a program until the bytes that hold `text` have come."""
    with running(arguments) as terminal:
        begun, seen = time.perf_counter(), b""
        while text.encode() not in seen:
            seen += os.read(terminal.fd, 65536)
        return time.perf_counter() - begun


@contextmanager
def program_at_rest(program: Program) -> Iterator[Terminal]:
    """The program on its own file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.toml"
        save(program, path)
        with running(cutcomp(str(path))) as terminal:
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
        ours = cutcomp(str(path))
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
