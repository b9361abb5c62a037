"""First paint and key-to-screen times through a real pseudo-terminal: `python -m tests.bench.keys`.

The empty Textual app is started in turn with the program, so that both see the same machine; medians are printed
side by side.  Keys are typed into a contour of 200 segments, with everything derived again at each of them.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
from dataclasses import replace
from math import cos, pi, sin
from pathlib import Path

from core.program.edit import new_block
from core.program.model import ArcSegment, CutterComp, Direction, Entry, LineSegment, Program, Segment, Tool
from core.program.store import save
from tests.terminal import Answer, running

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
    segments = [_side(row, corners[(row + 1) % len(corners)]) for row in range(len(corners))]
    block = replace(
        new_block(Program(tools=(Tool(1, diameter=Entry(0.25)),))),
        cutter_comp=CutterComp.RIGHT,
        x_start=Entry(corners[0][0]),
        y_start=Entry(corners[0][1]),
        z_bottom=Entry(-0.25),
        segments=tuple(segments),
    )
    return Program(tools=(Tool(1, diameter=Entry(0.125)),), blocks=(block,))


def _side(row: int, end: tuple[float, float]) -> Segment:
    if row % 4 != 1:
        return LineSegment(x_end=Entry(end[0]), y_end=Entry(end[1]))
    return ArcSegment(Direction.CCW, x_end=Entry(end[0]), y_end=Entry(end[1]), radius=Entry(0.2), choice=0)


def first_paint(arguments: list[str], text: str) -> float:
    """Seconds from the start of a program until `text` stands on its screen."""
    with running(arguments) as terminal:
        return terminal.until(text)


def side_by_side(program: Path, rounds: int) -> tuple[float, float]:
    """Median first paint of the empty app and of ours, started in turn."""
    empty, ours = [], []
    for _ in range(rounds):
        empty.append(first_paint([sys.executable, "-c", EMPTY_APP], "READY"))
        ours.append(first_paint([sys.executable, "-m", "app", str(program)], "MILL CONTOUR"))
    return statistics.median(empty), statistics.median(ours)


def key_answers(program: Path, keys: list[bytes]) -> list[Answer]:
    """Type the keys one by one, each after the screen has come to rest."""
    with running([sys.executable, "-m", "app", str(program)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.read(quiet=1.5)
        answers = []
        for key in keys:
            terminal.send(key)
            answers.append(terminal.read(quiet=0.25))
        return answers


def report(name: str, answers: list[Answer]) -> str:
    """One line of the table: milliseconds and bytes, median and 95th percentile."""
    times = sorted(1000 * answer.last for answer in answers)
    sizes = sorted(answer.count for answer in answers)
    high = round(0.95 * (len(answers) - 1))
    return (
        f"{name:<34} {statistics.median(times):8.1f} ms  95%: {times[high]:6.1f} ms   "
        f"{statistics.median(sizes):6.0f} bytes  95%: {sizes[high]:5} bytes   n {len(answers)}"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--segments", type=int, default=200)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "gear.toml"
        save(gear(options.segments), program)
        empty, ours = side_by_side(program, options.rounds)
        print(f"first paint   empty app {1000 * empty:.0f} ms   cutcomp {1000 * ours:.0f} ms   {ours / empty:.2f}:1")
        digits = [str(digit % 10).encode() for digit in range(options.rounds * 4)]
        print(report("a digit in a field", key_answers(program, [b"\t", *digits])[1:]))
        print(report("Tab to the next field", key_answers(program, [b"\t"] * options.rounds * 4)))
        depths = [f"-.{value + 20}".encode() for value in range(options.rounds * 4)]
        accepted = [key for depth in depths for key in (depth, b"\r", b"\x1b[A")]
        answers = key_answers(program, [b"\t"] * 6 + accepted)[6:]
        print(report("Enter: everything derived again", answers[1::3]))


if __name__ == "__main__":
    main()
