"""What must stand on a screen after every step: recorded once on an xterm with UTF-8, and painted anew to be sure.

A step is a key by its name, or another size of the terminal.  After each one the recorder waits until the program is at
rest, then has everything sent again: what differs after that was sent wrong the first time.
"""

from __future__ import annotations

import os
import re
import signal
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

from app.terminal.split_keys import ESC_SECONDS
from tests.bench.keys import until_rest
from tests.reports.terminals import Colors, Kind, sent
from tests.terminal import Terminal, cutcomp, running

ROOT: Final = Path(__file__).parents[2]
PLAIN: Final = Kind("xterm-256color", Colors.MANY, "UTF-8")
CURSOR: Final = "87d7ff"
"""The ground of the cursor among 256 colors."""
LONGEST: Final = 120.0
"""Seconds until a program that still works is given up: a busy machine may be slow."""
PASSING: Final = re.compile(
    "[▌|] .*(?:Saved|Deleted|Posted|Written|Tool, feeds)|press the softkey now|no value is clean"
)
"""A toast, and what Esc says of the digits, go by themselves after a few seconds; why no value is clean comes later."""
LONGEST_PASSING: Final = 20.0
"""Seconds that the program is waited for while something stands that goes by itself."""
FOLDER: Final = re.compile(r"/tmp/[a-z0-9_]+(/tmp[a-z0-9_]+)?")
VARYING: Final = re.compile(r"\d{4}-\d\d-\d\d-\d{6}|\d{4}-\d\d-\d\d|\d\d:\d\d|Free: +\d+ [GM]B")
"""What the clock and the disk make different from run to run."""

Step = str | tuple[int, int]


@dataclass(frozen=True)
class Picture:
    """What stands after a step: the lines without what varies, and the cells of the cursor as column and row."""

    lines: tuple[str, ...]
    cursor: frozenset[tuple[int, int]]


def keys_of(*texts: str | Iterable[str]) -> tuple[str, ...]:
    """Names stay whole, lists are spread: keys_of("tab", [*"1.5"], "enter")."""
    return tuple(key for text in texts for key in ((text,) if isinstance(text, str) else text))


def masked(lines: Iterable[str]) -> tuple[str, ...]:
    """Lines without what differs from run to run; as much stands there."""
    bare = (VARYING.sub(lambda found: re.sub(r"\d", "0", found[0]), line) for line in lines)
    return tuple(FOLDER.sub("/tmp/folder", line).rstrip() for line in bare)


def settle(terminal: Terminal) -> None:
    """Until the program is at rest and nothing stands that goes by itself."""
    deadline = time.monotonic() + LONGEST_PASSING
    passing = True
    while passing and time.monotonic() < deadline:
        for _, _, data in until_rest(terminal, LONGEST):
            terminal.seen += data
            terminal.stream.feed(data)
        passing = PASSING.search(terminal.text) is not None


def picture(terminal: Terminal) -> Picture:
    """The screen of a recording."""
    cells: Any = terminal.screen.buffer
    size = terminal.screen.columns, terminal.screen.lines
    cursor = {(x, y) for y in range(size[1]) for x in range(size[0]) if cells[y][x].bg == CURSOR}
    return Picture(masked(terminal.screen.display), frozenset(cursor))


def recorded(
    arguments: Sequence[str],
    steps: Sequence[Step],
    size: tuple[int, int],
    cwd: str | None = None,
    environment: Mapping[str, str | None] | None = None,
) -> list[Picture]:
    """The picture at the start and after every step; AssertionError where a picture was sent wrong."""
    pictures = []
    own = {**PLAIN.environment, "PYTHONPATH": str(ROOT), **(environment or {})}
    with (
        TemporaryDirectory() as folder,
        running(cutcomp(*arguments), columns=size[0], rows=size[1], environment=own, cwd=cwd or folder) as terminal,
    ):
        terminal.until("F8", longest=30.0)
        for step in (None, *steps):
            if isinstance(step, tuple):
                terminal.resize(*step)
            elif step is not None:
                terminal.send(sent(step))
            if step == "escape":
                # the program rests while it waits for the rest of a key
                time.sleep(2 * ESC_SECONDS)
            settle(terminal)
            shown = picture(terminal)
            os.kill(terminal.pid, signal.SIGWINCH)
            settle(terminal)
            anew = picture(terminal)
            assert shown == anew, f"after {step}: {difference(shown, anew)}\n{terminal.text}"
            pictures.append(shown)
    return pictures


def difference(shown: Picture, right: Picture) -> str:
    """The first line that is not as it must be, or the cursor; empty where all is well."""
    pairs = enumerate(zip(shown.lines, right.lines, strict=True))
    wrong = next((f"line {number}: {one!r} instead of {other!r}" for number, (one, other) in pairs if one != other), "")
    return wrong or ("" if shown.cursor == right.cursor else f"cursor {sorted(shown.cursor ^ right.cursor)[:3]}")
