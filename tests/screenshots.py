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
    """One picture: the example it shows, the keys that lead there, and the terminal's size."""

    name: str
    example: str
    keys: tuple[bytes, ...] = ()
    size: tuple[int, int] = (80, 24)
    environment: dict[str, str] = field(default_factory=dict)


DOWN, F4 = b"\x1b[B", b"\x1b4"
TO_LOOKAHEAD = b"\t" * 11

SHOTS = (
    Shot("start", "pocket"),
    Shot("start-wide", "pocket", size=(132, 43)),
    Shot("segment", "pocket", (b"8\r",)),
    Shot("gouge", "notch"),
    Shot("draw", "pocket", (b"8\r", F7)),
    Shot("lookahead-table", "notch", (TO_LOOKAHEAD, F4, DOWN)),
    Shot("no-color", "pocket", environment={"NO_COLOR": "1"}),
    Shot(
        "sixteen-colors",
        "overrun-square",
        (TO_LOOKAHEAD, b"4\r", b"\t" * 10, b"2..5\r"),
        environment={"TERM": "xterm"},
    ),
    Shot("ascii", "notch", (b"2\r",), environment={"TERM": "vt100", "LC_ALL": "C"}),
    Shot("widest", "pocket", (b"3\r\t",), size=(200, 60)),
)


def take(shot: Shot) -> None:
    """Run the program, press the keys, save the screen."""
    columns, rows = shot.size
    arguments = [sys.executable, "-m", "app", "--example", shot.example]
    with running(arguments, columns=columns, rows=rows, environment=shot.environment) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.read(quiet=1.5)
        for key in shot.keys:
            terminal.send(key)
            terminal.read(quiet=0.4)
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
