"""First paint and key-to-screen times through a real pseudo-terminal: `python -m tests.bench.keys`.

The empty Textual app is started in turn with the program, so that both see the same machine; medians are printed
side by side.  Keys are typed into two contours of 200 segments: a plate whose every corner the tool reaches, and a
gear none of whose 50 gaps it enters, where every remedy is tried after every change.

`changed` is the time from the key to the first screen that shows the derived path, `finished` that to the last byte:
by then the look-ahead table stands, and what the contour needs.
"""

from __future__ import annotations

import argparse
import os
import select
import statistics
import sys
import tempfile
import time
from dataclasses import dataclass, replace
from math import cos, dist, pi, sin
from pathlib import Path

from core.program.edit import new_block
from core.program.model import ArcSegment, CutterComp, Direction, Entry, LineSegment, Program, Segment, Tool
from core.program.store import save
from tests.terminal import Terminal, running

EMPTY_APP = """
from textual.app import App
from textual.widgets import Static

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
        new_block(Program(tools=(Tool(1, diameter=Entry(0.25)),))),
        cutter_comp=CutterComp.RIGHT,
        x_start=Entry(corners[0][0]),
        y_start=Entry(corners[0][1]),
        z_bottom=Entry(-0.25),
        segments=tuple(segments),
    )
    return Program(tools=(Tool(1, diameter=Entry(0.125)),), blocks=(block,))


def _side(row: int, end: tuple[float, float], tip: float) -> Segment:
    if row % 4 != 1:
        return LineSegment(x_end=Entry(end[0]), y_end=Entry(end[1]))
    return ArcSegment(Direction.CCW, x_end=Entry(end[0]), y_end=Entry(end[1]), radius=Entry(tip), choice=0)


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
        segments.append(LineSegment(x_end=Entry(come[0]), y_end=Entry(come[1])))
        turn = Direction.CW if inside else Direction.CCW
        segments.append(ArcSegment(turn, x_end=Entry(go[0]), y_end=Entry(go[1]), radius=Entry(radius), choice=0))
    block = replace(
        new_block(Program(tools=(Tool(1, diameter=Entry(0.25)),))),
        cutter_comp=CutterComp.RIGHT,
        x_start=Entry(radius),
        y_start=Entry(0.0),
        z_bottom=Entry(-0.25),
        segments=tuple(segments),
    )
    return Program(tools=(Tool(1, diameter=Entry(0.25)),), blocks=(block,))


def _towards(corner: tuple[float, float], other: tuple[float, float], far: float) -> tuple[float, float]:
    part = far / dist(corner, other)
    (x, y), (to_x, to_y) = corner, other
    return round(x + part * (to_x - x), 5), round(y + part * (to_y - y), 5)


@dataclass(frozen=True)
class Answer:
    """What came back after a key: bytes, and seconds to the first derived screen and to the last byte."""

    count: int
    changed: float
    finished: float


def answer(terminal: Terminal, key: bytes, quiet: float) -> Answer:
    """Type a key and wait for the screen to come to rest; the emulator is fed afterwards, it takes its time."""
    begun = time.perf_counter()
    terminal.send(key)
    came: list[tuple[float, bytes]] = []
    while select.select([terminal.fd], [], [], quiet)[0]:
        data = os.read(terminal.fd, 65536)
        came.append((time.perf_counter() - begun, data))
    changed = 0.0
    for when, data in came:
        terminal.stream.feed(data)
        if not changed and "calculating" not in terminal.text:
            changed = when
    return Answer(sum(len(data) for _, data in came), changed, came[-1][0] if came else 0.0)


def first_paint(arguments: list[str], text: str) -> float:
    """Seconds from the start of a program until the bytes that hold `text` have come."""
    with running(arguments) as terminal:
        begun, seen = time.perf_counter(), b""
        while text.encode() not in seen:
            seen += os.read(terminal.fd, 65536)
        return time.perf_counter() - begun


def side_by_side(program: Path, rounds: int) -> tuple[float, float]:
    """Median first paint of the empty app and of ours, started in turn."""
    empty, ours = [], []
    for _ in range(rounds):
        empty.append(first_paint([sys.executable, "-c", EMPTY_APP], "READY"))
        ours.append(first_paint([sys.executable, "-m", "app", str(program)], "MILL CONTOUR"))
    return statistics.median(empty), statistics.median(ours)


def key_answers(program: Program, before: list[bytes], keys: list[bytes], quiet: float = 0.25) -> list[Answer]:
    """Type the keys one by one, each after the screen has come to rest, behind some that are not counted."""
    with tempfile.TemporaryDirectory() as folder:
        # a file of its own, beside which no earlier run has left unsaved work
        path = Path(folder) / "part.toml"
        save(program, path)
        return _answers(path, before, keys, quiet)


def _answers(path: Path, before: list[bytes], keys: list[bytes], quiet: float) -> list[Answer]:
    with running([sys.executable, "-m", "app", str(path)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.read(quiet=2.0)
        for key in before:
            answer(terminal, key, 0.5)
        return [answer(terminal, key, quiet) for key in keys]


def report(name: str, answers: list[Answer]) -> str:
    """One line of the table: milliseconds and bytes, median and 95th percentile."""
    changed, finished = (_middle_and_high([1000 * value for value in some]) for some in _columns(answers))
    sizes = _middle_and_high([float(one.count) for one in answers])
    return (
        f"{name:<42} {changed[0]:7.1f} {changed[1]:7.1f}   {finished[0]:7.1f} {finished[1]:7.1f}   "
        f"{sizes[0]:6.0f} {sizes[1]:6.0f}   {len(answers):3}"
    )


def _columns(answers: list[Answer]) -> tuple[list[float], list[float]]:
    return [one.changed for one in answers], [one.finished for one in answers]


def _middle_and_high(values: list[float]) -> tuple[float, float]:
    return statistics.median(values), sorted(values)[round(0.95 * (len(values) - 1))]


def keys_of(program: Program, name: str, number: int, rounds: int) -> None:
    """The table of one program; `number` is a LINE whose X END is moved to and fro."""
    x = _x_end(program, number)
    digits = [str(digit % 10).encode() for digit in range(rounds)]
    print(report(f"{name}: a digit of TOOL", key_answers(program, [b"\t"], digits)))
    there = [str(number).encode(), b"\r", b"\t"]
    typed = [key for digit in digits for key in (digit, b"\x7f")]
    first = [str(x).encode()]
    print(report(f"{name}: a digit of X END", key_answers(program, [*there, *first], typed, 0.6)[::2]))
    print(report(f"{name}: Tab", key_answers(program, [], [b"\t"] * rounds)))
    depths = [key for row in range(rounds) for key in (f"-.{row + 26}".encode(), b"\r", b"\x1b[A")]
    print(report(f"{name}: Enter, another Z BOTTOM", key_answers(program, [b"\t"] * 7, depths, 0.6)[1::3]))
    points = [key for row in range(rounds) for key in (f"{x + 0.004 * (row % 5 + 1):.4f}".encode(), b"\r", b"\x1b[A")]
    print(report(f"{name}: Enter, another X END", key_answers(program, there, points, 0.6)[1::3]))


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9, help="starts; keys are four times as many")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "gear.toml"
        save(gear(200), program)
        empty, ours = side_by_side(program, options.rounds)
    print(f"first paint   empty app {1000 * empty:.0f} ms   cutcomp {1000 * ours:.0f} ms   {ours / empty:.2f}:1")
    print(f"{'median and 95th percentile':<42} {'changed, ms':>15}   {'finished, ms':>15}   {'bytes':>13}     n")
    keys_of(plate(), "plate", 105, 4 * options.rounds)
    keys_of(gear(200), "gear", 101, 4 * options.rounds)


def _x_end(program: Program, number: int) -> float:
    segment = program.blocks[0].segments[number - 1]
    assert isinstance(segment, LineSegment)
    assert isinstance(segment.x_end, Entry)
    return segment.x_end.value


if __name__ == "__main__":
    main()
