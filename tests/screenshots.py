"""The pictures in `screenshots/`, made by the program in a real terminal: `python -m tests.screenshots`."""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, field
from pathlib import Path

from tests.picture import save_picture
from tests.terminal import running

FOLDER = Path(__file__).parent.parent / "screenshots"
F7 = b"\x1b7"


@dataclass(frozen=True)
class Shot:
    """One picture: the example it shows, the keys that lead there, a text seen there, and the terminal's size."""

    name: str
    example: str
    keys: tuple[bytes, ...] = ()
    text: str = "best"
    size: tuple[int, int] = (80, 24)
    environment: dict[str, str] = field(default_factory=lambda: {"COLORTERM": "truecolor"})


DOWN = b"\x1b[B"
TO_LOOKAHEAD = b"\t" * 11

PAGE_DOWN = b"\x1b[6~"
GOUGE = ("notch", (PAGE_DOWN, PAGE_DOWN), "POINT X")
SEGMENT = ("pocket", (b"8\r",), "DIRECTION")
DRAW = ("pocket", (b"8\r", F7), "CHARACTERS")
TABLE = ("notch", (TO_LOOKAHEAD, b" ", DOWN), "LOOKAHEAD TABLE")
WIDE = (132, 43)
SHOTS = (
    Shot("start", "pocket"),
    Shot("start-wide", "pocket", size=WIDE),
    Shot("segment", *SEGMENT),
    Shot("segment-wide", *SEGMENT, size=WIDE),
    Shot("gouge", *GOUGE),
    Shot("gouge-wide", *GOUGE, size=WIDE),
    Shot("draw", *DRAW),
    Shot("draw-wide", *DRAW, size=WIDE),
    Shot("lookahead-table", *TABLE),
    Shot("lookahead-table-wide", *TABLE, size=WIDE),
    Shot("no-color", *GOUGE, environment={"NO_COLOR": "1"}),
    Shot("sixteen-colors", *GOUGE, environment={"TERM": "xterm"}),
    Shot("ascii", *GOUGE, environment={"TERM": "vt100", "LC_ALL": "C"}),
    Shot("widest", "pocket", (b"3\r\t",), "XY LENGTH", size=(200, 60)),
)


def take(shot: Shot) -> None:
    """Run the program, press the keys, save the screen."""
    columns, rows = shot.size
    arguments = [sys.executable, "-m", "app", "--example", shot.example]
    with running(arguments, columns=columns, rows=rows, environment=shot.environment) as terminal:
        terminal.until("best", longest=60.0)
        for key in shot.keys:
            terminal.read(quiet=1.0)
            terminal.send(key)
        terminal.until(shot.text, longest=60.0)
        terminal.read(quiet=3.0)
        save_picture(terminal.screen, FOLDER / f"{shot.name}.png")


def main() -> None:
    """Take every picture, or those named on the command line."""
    parser = argparse.ArgumentParser("tests.screenshots", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(shot.name for shot in SHOTS))
    names = parser.parse_args().names
    for shot in SHOTS:
        if not names or shot.name in names:
            take(shot)
            print(shot.name)


if __name__ == "__main__":
    main()
