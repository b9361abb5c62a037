"""The pictures in `screenshots/`, made by the program in a real terminal: `python -m tests.screenshots`."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field
from pathlib import Path

from tests.picture import save_picture
from tests.terminal import cutcomp, running

ROOT = Path(__file__).parent.parent
FOLDER = ROOT / "screenshots"
F7 = b"\x1b7"


@dataclass(frozen=True)
class Shot:
    """One picture: what is shown, the text that it begins with, the keys that lead on, a text seen there, and the
    terminal's size.  A text among the keys is waited for."""

    name: str
    arguments: tuple[str, ...]
    keys: tuple[bytes | str, ...] = ()
    text: str = "best"
    start: str = "best"
    size: tuple[int, int] = (80, 24)
    environment: dict[str, str] = field(default_factory=lambda: {"COLORTERM": "truecolor"})


DOWN = b"\x1b[B"
TO_LOOKAHEAD = b"\t" * 11

PAGE_DOWN = b"\x1b[6~"
POCKET, NOTCH = ("--example", "pocket"), ("--example", "notch")
GOUGE = (NOTCH, (PAGE_DOWN, PAGE_DOWN), "POINT X")
SEGMENT = (POCKET, (b"8\r",), "DIRECTION")
DRAW = (POCKET, (b"8\r", F7), "CHARACTERS")
TABLE = (NOTCH, (TO_LOOKAHEAD, b" ", DOWN), "LOOKAHEAD TABLE")
BRACKET = ("proof", "--control", "fanuc", "--tool", "3=.5", "tests/data/proof/fanuc-bracket.nc")
WIDE = (132, 43)
SHOTS = (
    Shot("start", POCKET),
    Shot("start-wide", POCKET, size=WIDE),
    Shot("segment", *SEGMENT),
    Shot("segment-wide", *SEGMENT, size=WIDE),
    Shot("gouge", *GOUGE),
    Shot("gouge-wide", *GOUGE, size=WIDE),
    Shot("draw", *DRAW),
    Shot("draw-wide", *DRAW, size=WIDE),
    Shot("lookahead-table", *TABLE),
    Shot("lookahead-table-wide", *TABLE, size=WIDE),
    Shot("nc-proof", BRACKET, (DOWN * 9,), "LINE 10", start="runs"),
    Shot("compare-controls", BRACKET, (b"v",), "heidenhain", start="runs"),
    Shot("dotted-path", BRACKET, (b"v", "heidenhain", DOWN, b" "), "dotted", start="runs", size=(200, 60)),
    Shot("no-color", *GOUGE, environment={"NO_COLOR": "1"}),
    Shot("sixteen-colors", *GOUGE, environment={"TERM": "xterm"}),
    Shot("ascii", *GOUGE, environment={"TERM": "vt100", "LC_ALL": "C"}),
    Shot("widest", POCKET, (b"3\r\t",), "XY LENGTH", size=(200, 60)),
)


def take(shot: Shot) -> None:
    """Run the program, press the keys, save the screen."""
    columns, rows = shot.size
    command = cutcomp(*shot.arguments)
    with running(command, columns=columns, rows=rows, environment=shot.environment, cwd=str(ROOT)) as terminal:
        terminal.until(shot.start, longest=60.0)
        for key in shot.keys:
            if isinstance(key, str):
                terminal.until(key, longest=60.0)
            else:
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
