"""First paint and key-to-screen times through a real pseudo-terminal: `python -m tests.bench.keys`.

The empty Textual app is started in turn with the program, so that both see the same machine; medians are printed
side by side.  Keys are typed into two contours of 200 segments: a plate whose every corner the tool reaches, and a
gear none of whose 50 gaps it enters, where every remedy is tried after every change.

Times are milliseconds; `work` is how long the program ran in them, which a busy machine changes little.  `changed` is
the time from the key to the first screen that shows the derived path, `finished` that to the last byte: by then the
look-ahead table stands, and what the contour needs.  `there` is the work of both as it would be where the bars were
set: by how many times slower a minimal Textual app starts here or rs274 runs, the smaller of the two.
Where half-typed numbers are tried out in a thread, `changed` is the screen with the digit, on which the accepted path
still stands: then only `finished` tells the rest.
The next key is typed when the program is at rest: no byte comes and none of its threads has run for a while.  So what
would help has been tried for a half-typed number before Enter, as for an operator who looks at the screen; behind keys
without a rest it follows Enter.  `idle` are the bytes sent while nobody types, which must be 0.

`a LINE as it is typed` is every key of typing the ends of lines anew, in the mix in which an operator presses them:
half a number is another contour, often a wild one.
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
from tests.bench.machine import EMPTY_SECONDS, Slowness, at_work, rs274_slowness, worked
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
        new_block(Program(tools=(Tool(1, diameter=Number(0.25)),))),
        cutter_comp=CutterComp.RIGHT,
        x_start=Number(corners[0][0]),
        y_start=Number(corners[0][1]),
        z_bottom=Number(-0.25),
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
"""Seconds in which nobody types."""


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


def empty_paint() -> float:
    """The same of the empty app."""
    return first_paint([sys.executable, "-c", EMPTY_APP], "READY")


def slowness(rounds: int) -> Slowness:
    """How much slower than where the bars were set the empty app is here, and rs274."""
    empty = statistics.median(empty_paint() for _ in range(rounds))
    return Slowness(rs274_slowness(), empty / EMPTY_SECONDS)


def side_by_side(program: Program, rounds: int) -> tuple[float, float]:
    """Median first paint of the empty app and of ours on a program, started in turn."""
    with tempfile.TemporaryDirectory() as folder:
        save(program, path := Path(folder) / "part.toml")
        ours = [sys.executable, "-m", "app", str(path)]
        empty, own = zip(*((empty_paint(), first_paint(ours, "MILL CONTOUR")) for _ in range(rounds)), strict=True)
    return statistics.median(empty), statistics.median(own)


@contextmanager
def opened(program: Program) -> Iterator[Terminal]:
    """Our program at rest on a file of its own, beside which no earlier run has left unsaved work."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.toml"
        save(program, path)
        with running([sys.executable, "-m", "app", str(path)]) as terminal:
            terminal.until("MILL CONTOUR")
            answer(terminal, b"")
            yield terminal


def key_answers(program: Program, before: list[bytes], keys: list[bytes]) -> list[Answer]:
    """Type the keys one by one, each after the program has come to rest, behind some that are not counted."""
    with opened(program) as terminal:
        for key in before:
            answer(terminal, key)
        return [answer(terminal, key) for key in keys]


def tabs_and_idle(program: Program, count: int) -> tuple[list[Answer], int]:
    """Tab through the fields, then do nothing: the answers, and the bytes that come all the same."""
    with opened(program) as terminal:
        answers = [answer(terminal, b"\t") for _ in range(count)]
        return answers, terminal.read(quiet=IDLE, longest=IDLE).count


def report(name: str, answers: list[Answer], slower: float | None = None) -> str:
    """One line of the table: milliseconds and bytes, median and 95th percentile; then the work as it would be there."""
    times = ((one.changed, one.work[0], one.finished, one.work[1]) for one in answers)
    told = [_middle_and_high([1000 * value for value in column]) for column in zip(*times, strict=True)]
    sizes = _middle_and_high([float(one.count) for one in answers])
    there = [] if slower is None else [(middle / slower, high / slower) for middle, high in told[1::2]]
    here, beyond = ("".join(f"{middle:8.1f}{high:7.1f}" for middle, high in columns) for columns in (told, there))
    return f"{name:<33}{here}{sizes[0]:7.0f}{sizes[1]:6.0f}{len(answers):5}{beyond}"


def _middle_and_high(values: list[float]) -> tuple[float, float]:
    return statistics.median(values), sorted(values)[round(0.95 * (len(values) - 1))]


def line_keys(program: Program, number: int) -> Iterator[bytes]:
    """The keys that type a LINE's ends anew, X moved a little, and lead to X END of the LINE four segments on."""
    x, y = _ends(program, number)
    for value in (x + 0.004, y):
        yield from (digit.encode() for digit in f"{value:.4f}")
        yield b"\r"
    yield from (b"\t", b"\x1b[A")
    yield from [b"\x1b[6~"] * 4
    yield b"\t"


def rows_of(program: Program, name: str, number: int, count: int, slower: float) -> Iterator[str]:
    """The table of one program, `count` keys of each kind; `number` is a LINE whose X END is moved to and fro."""
    x, _ = _ends(program, number)
    digits = [str(digit % 10).encode() for digit in range(count)]
    yield report(f"{name}: a digit of TOOL", key_answers(program, [b"\t"], digits), slower)
    there = [str(number).encode(), b"\r", b"\t"]
    typed = [key for digit in digits for key in (digit, b"\x7f")]
    yield report(f"{name}: a digit of X END", key_answers(program, [*there, str(x).encode()], typed)[::2], slower)
    tabs, idle = tabs_and_idle(program, count)
    yield report(f"{name}: Tab", tabs, slower)
    depths = [key for row in range(count) for key in (f"-.{row + 26}".encode(), b"\r", b"\x1b[A")]
    yield report(f"{name}: Enter, another Z BOTTOM", key_answers(program, [b"\t"] * 7, depths)[1::3], slower)
    points = [key for row in range(count) for key in (f"{x + 0.004 * (row % 5 + 1):.4f}".encode(), b"\r", b"\x1b[A")]
    yield report(f"{name}: Enter, another X END", key_answers(program, there, points)[1::3], slower)
    lines = [key for line in range(max(1, count // 3)) for key in line_keys(program, number + 4 * line)]
    yield report(f"{name}: a LINE as it is typed", key_answers(program, there, lines), slower)
    yield f"{f'{name}: idle for {IDLE:.0f} s':<93}{idle:7}"


def main() -> None:
    """Print the tables, row by row."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", type=int, default=9, help="starts of the empty app and of ours")
    parser.add_argument("--keys", type=int, default=6, help="keys of each kind")
    options = parser.parse_args()
    empty, ours = side_by_side(gear(200), options.starts)
    print(f"first paint   empty app {1000 * empty:.0f} ms   cutcomp {1000 * ours:.0f} ms   {ours / empty:.2f}:1")
    if not options.keys:
        return
    print(
        f"{'median and 95th percentile':<33}{'changed':>15}{'work':>15}{'finished':>15}{'work':>15}{'bytes':>13}    n"
        f"{'there':>15}{'there':>15}"
    )
    for contour, name, number in ((plate(), "plate", 105), (gear(200), "gear", 101)):
        print((slower := slowness(options.starts)).told())
        for row in rows_of(contour, name, number, options.keys, slower.least):
            print(row, flush=True)
    print(slowness(options.starts).told())


def _ends(program: Program, number: int) -> tuple[float, float]:
    segment = program.blocks[0].segments[number - 1]
    assert isinstance(segment, LineSegment)
    assert isinstance(segment.x_end, Number)
    assert isinstance(segment.y_end, Number)
    return segment.x_end.value, segment.y_end.value


if __name__ == "__main__":
    main()
