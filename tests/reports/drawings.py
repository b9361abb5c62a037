"""Drawings picked by keys over a slow line, posted, run by LinuxCNC: `python -m tests.reports.drawings FILE.dxf ...`.

Of each drawing the first contour and the one after it are marked and taken, at 80x24; tool and depths are typed, and
the program is posted.  Told is what the keys cost, and whether rs274 runs what was posted.  The files are anybody's:
none is part of the project.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path
from typing import Final

from tests.reports.relay import Line, Relayed, relayed
from tests.reports.terminals import sent
from tests.rs274 import run
from tests.terminal import cutcomp, running

ROOT: Final = Path(__file__).parents[2]
QUIET: Final = 1.5
"""Seconds without a byte after which a screen counts as finished on a slow line."""
FIRST_BYTE: Final = 10.0
"""Seconds within which a key shows something; some show nothing."""
LONGEST: Final = 180.0
SEGMENT_TO_Z_BOTTOM: Final = 7
"""Fields from SEGMENT to Z BOTTOM."""


def press(terminal: Relayed, *keys: str) -> int:
    """Keys one after the other, each until the screen stands; the bytes they cost."""
    before = len(terminal.seen)
    for key in keys:
        here, begun = len(terminal.seen), time.monotonic()
        terminal.send(sent(key))
        while len(terminal.seen) == here and time.monotonic() - begun < FIRST_BYTE:
            terminal.read(quiet=0.1, longest=1.0)
        terminal.read(quiet=QUIET, longest=LONGEST)
    return len(terminal.seen) - before


def picked(terminal: Relayed, name: str) -> None:
    """The drawing listed, two contours marked and taken."""
    terminal.until("start X", "UNITS?", longest=LONGEST)
    if "UNITS?" in terminal.text:
        press(terminal, "m")
        terminal.until("start X", longest=LONGEST)
    terminal.read(quiet=QUIET, longest=LONGEST)
    print(f"{name}: listed after {len(terminal.seen)} bytes")
    rows = [line[:59] for line in terminal.text.splitlines()[2:9] if line[:6].strip()]
    print("\n".join(rows))
    print(f"  a row on costs {press(terminal, 'down')} bytes, back {press(terminal, 'up')}")
    press(terminal, "space", "down", "right", "space")
    print(terminal.text.splitlines()[0][:59])
    press(terminal, "enter")
    terminal.until("MILL CONTOUR", longest=LONGEST)


def completed(terminal: Relayed, options: argparse.Namespace) -> None:
    """The tool's diameter, speed and feeds, the blend, and Z BOTTOM of both blocks."""
    go(terminal, "f6", "DIAMETER")
    press(terminal, "tab", "tab")
    for value in (options.diameter, options.speed, options.feed, options.feed):
        press(terminal, *value, "enter")
    go(terminal, "f8", "SEGMENT")
    go(terminal, "f4", "BLEND OFFSET")
    press(terminal, "tab", *options.blend, "enter")
    for block in (1, 2):
        if block == 2:
            go(terminal, "f8", "2 blocks")
            press(terminal, "down")
        go(terminal, "f8" if block == 1 else "enter", "SEGMENT >")
        press(terminal, *["tab"] * SEGMENT_TO_Z_BOTTOM, *options.depth, "enter")
        print("\n".join(line[:59] for line in terminal.text.splitlines()[:13]))


def go(terminal: Relayed, key: str, text: str) -> None:
    """A key that leads to another screen."""
    press(terminal, key)
    terminal.until(text, longest=LONGEST)
    terminal.read(quiet=QUIET, longest=LONGEST)


def posted(terminal: Relayed, folder: Path, diameter: float) -> bool:
    """The program posted as part.nc and run."""
    go(terminal, "f8", "2 blocks")
    go(terminal, "f3", "Enter posts")
    press(terminal, "enter")
    made = folder / "part.nc"
    if not made.exists():
        print(terminal.text)
        return False
    ran = run(made.read_text(), {1: diameter}, folder)
    print(
        f"  posted {len(made.read_text().splitlines())} lines; rs274: {ran.accepted}, {len(ran.moves)} moves {ran.said}"
    )
    return ran.accepted


def over(line: Line, drawing: Path, options: argparse.Namespace) -> bool:
    """One drawing from its first screen to the interpreter."""
    with tempfile.TemporaryDirectory() as name:
        folder, environment = Path(name), {"PYTHONPATH": str(ROOT)}
        command = cutcomp(str(drawing.absolute()))
        with running(command, environment=environment, cwd=name) as inner, relayed(inner, line) as terminal:
            picked(terminal, drawing.name)
            completed(terminal, options)
            return posted(terminal, folder, float(options.diameter))


def main() -> int:
    """All drawings; 1 where one is not run to its end."""
    parser = argparse.ArgumentParser("tests.reports.drawings", description=__doc__)
    parser.add_argument("drawings", type=Path, nargs="+", metavar="FILE.dxf")
    parser.add_argument("--baud", type=int, default=9600)
    parser.add_argument("--delay", type=float, default=0.15, help="seconds each way")
    parser.add_argument("--diameter", default="2", help="of the tool, in the drawing's unit")
    parser.add_argument("--speed", default="3000", help="SPEED of the tool")
    parser.add_argument("--feed", default="100", help="FEED and PLUNGE FEED of the tool")
    parser.add_argument("--blend", default="1", help="BLEND OFFSET")
    parser.add_argument("--depth", default="-1", help="Z BOTTOM")
    options = parser.parse_args()
    line = Line(delay=options.delay, baud=options.baud)
    ran = [over(line, drawing, options) for drawing in options.drawings]
    print(f"{sum(ran)} of {len(ran)} drawings picked, posted and run")
    return 0 if all(ran) else 1


if __name__ == "__main__":
    sys.exit(main())
