"""The program under every kind of terminal, its screen compared cell by cell: `python -m tests.reports.matrix`.

TERM x colors x locale x drawing characters x size, and the function keys of every mode of PuTTY.  What stands on a
terminal emulator's screen after every key is compared with what the App draws without a terminal; the bytes are
looked through for anything a terminal would not take; the cursor has to be seen, without any color too.
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

from app.documents.files import load
from app.documents.programs import example
from app.painted.session import Session
from app.painted.widgets.rows import Look
from app.terminal.character_set import lookalike
from tests.reports.reference import Reference, keys_of
from tests.reports.terminals import (
    FUNCTION_KEYS,
    PUTTY,
    SIZES,
    XTERM,
    Colors,
    Kind,
    kinds,
    sampled,
    sent,
)
from tests.terminal import Terminal, running

ROOT: Final = Path(__file__).parents[2]
PART: Final = "pocket"
PATIENCE: Final = 10.0
"""Seconds until a screen counts as wrong."""
KNOWN: Final = re.compile(rb"\x1b\[[0-9;?<>=]*\$?[a-zA-Z]|\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)|\x1b[78=>]|[\r\n]")
"""Control sequences with one meaning everywhere."""
HEX: Final = re.compile(r"[0-9a-f]{6}")

SCRIPT: Final = (
    keys_of(["tab"] * 4, [*"1..5"], "enter", "ctrl+z")
    + keys_of(["tab"] * 7, "4", "enter", "shift+tab", "f4", "f8", "f3")
    + keys_of("ctrl+z", "ctrl+z", "?", "f8", "f8", "enter", "tab")
    + keys_of("f4", "f8", "f5", "f8", "f6", "f2", "f1", "f8", "pagedown", "f1", "ctrl+z", "f2", "f8")
    + keys_of("f7", "f1", "f2", "f3", "f8", "f4", "f5", "f6", "f8", "f8")
    + keys_of("f3", "f1", "f7", "f7", "f2", "f8", "f7", "f6", "f8", "enter")
)
"""Every softkey at least once: an error, a USR look-ahead, every setup screen, DRAW, PROGRAM and its three sets."""
MARKED: Final = {"ERR": SCRIPT.index("ctrl+z"), "USR": SCRIPT.index("f4"), "CAL": 0}
"""Keys before which a mark stands on the screen."""


@dataclass
class Tally:
    """How much was compared, and what was wrong, in words."""

    runs: int = 0
    screens: int = 0
    combinations: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        self.runs += other.runs
        self.screens += other.screens
        self.combinations.update(other.combinations)
        self.wrong += other.wrong


class Lost(Exception):
    """A screen is wrong; what follows it would only be wrong again."""


@dataclass
class Seat:
    """One terminal with the program on it, beside the App that tells what must be seen."""

    kind: Kind
    terminal: Terminal
    reference: Reference
    size: tuple[int, int]
    sequences: tuple[str, ...]
    tally: Tally

    def press(self, key: str) -> None:
        """A key typed here and there, and the two screens compared."""
        self.terminal.send(sent(key, self.sequences))
        self.reference.press(key)
        self.compare(key)

    def compare(self, after: str) -> None:
        """Wait until the screen is right; tell what is wrong if it never is."""
        begun = time.monotonic()
        while True:
            self.terminal.read(quiet=0.02, longest=0.1)
            difference = self.difference()
            if not difference:
                break
            if time.monotonic() - begun > PATIENCE:
                self.wrong(f"after {after}: {difference}")
                raise Lost
        self.tally.screens += 1

    def wrong(self, text: str) -> None:
        self.tally.wrong.append(f"{self.kind} {self.size}: {text}")

    def difference(self) -> str:
        """The first line that is not as it must be, or the cursor that is not seen; empty when all is well."""
        columns, rows = self.size
        expected = self.reference.lines(columns, rows)
        shown = list(self.terminal.screen.display)
        if self.kind.characters != "utf-8":
            expected = [lookalike(line) for line in expected]
        for number, (one, other) in enumerate(zip(expected, shown, strict=True)):
            # clock and free memory are this machine's
            status = number == rows - 1 and rows >= 6
            if one[:18] != other[:18] if status else one != other:
                return f"line {number}: {other!r} instead of {one!r}"
        return self.invisible()

    def invisible(self) -> str:
        """Where the cursor is, but is not seen."""
        columns, rows = self.size
        for y, row in enumerate(self.reference.rows(columns, rows)):
            x = 0
            for span in row:
                for column in range(x, x + len(span.text)):
                    cell = self.terminal.screen.buffer[y][column]
                    if span.look is Look.CURSOR and not stands_out(cell, self.kind.shown):
                        return f"cursor at {column}, {y} is not seen: {cell}"
                    if span.look is Look.CARET and not cell.underscore:
                        return f"caret at {column}, {y} is not seen: {cell}"
                x += len(span.text)
        return ""


def stands_out(cell: Any, colors: Colors) -> bool:
    """Whether a cell of the cursor differs from its surroundings, by an attribute where colors are few."""
    if colors in (Colors.FEW, Colors.NONE):
        return bool(cell.reverse or cell.underscore)
    return bool(cell.reverse) or cell.bg not in ("default", "12171c", "121212", "1c1c1c")


def stray(data: bytes, characters: str) -> str:
    """What a terminal of this set of characters would not take for one of them or for a control sequence."""
    text = KNOWN.sub(b"", data)
    try:
        decoded = text.decode(characters)
    except UnicodeDecodeError as error:
        return f"bytes that are not {characters}: {text[error.start : error.start + 8]!r}"
    odd = sorted({one for one in decoded if not one.isprintable()} | ({"\ufffd"} & set(decoded)))
    return f"stray characters {odd}" if odd else ""


def colors_wrong(terminal: Terminal, colors: Colors) -> str:
    """A color that the terminal has not."""
    used = {part for row in terminal.screen.buffer.values() for cell in row.values() for part in (cell.fg, cell.bg)}
    if colors is Colors.NONE and used - {"default"}:
        return f"colors where none are wanted: {sorted(used)}"
    if colors is Colors.FEW and any(HEX.fullmatch(one) for one in used):
        return f"more than sixteen colors: {sorted(used)}"
    if colors in (Colors.TRUE, Colors.MANY) and not any(HEX.fullmatch(one) for one in used):
        return f"colors are not used: {sorted(used)}"
    direct = re.search(rb"\x1b\[[0-9;]*[34]8;2;", bytes(terminal.seen)) is not None
    return "" if direct == (colors is Colors.TRUE) else f"direct colors: {direct}"


@contextmanager
def seated(kind: Kind, size: tuple[int, int], sequences: tuple[str, ...], tally: Tally) -> Iterator[Seat]:
    """A seat with the first verdict on its screen; what it was sent is looked through in the end."""
    option = ["--characters", kind.asked] if kind.asked else []
    arguments = [sys.executable, "-m", "app", "--example", PART, *option]
    own = {**kind.environment, "PYTHONPATH": str(ROOT)}
    with (
        TemporaryDirectory() as folder,
        running(arguments, columns=size[0], rows=size[1], environment=own, cwd=folder) as terminal,
        suppress(Lost),
    ):
        if kind.characters != "utf-8":
            terminal.stream.select_other_charset("@")
        reference = Reference(replace(Session.of(load(example(PART))), title=PART))
        reference.desk = replace(reference.desk, mode=kind.modes[0], modes=kind.modes)
        seat = Seat(kind, terminal, reference, size, sequences, tally)
        tally.runs += 1
        seat.compare("the start")
        yield seat
        if trouble := stray(bytes(terminal.seen), kind.characters) or colors_wrong(terminal, kind.shown):
            seat.wrong(trouble)


def marks(seat: Seat, step: int) -> None:
    """What must be readable before a step of the script."""
    for mark, there in MARKED.items():
        if there == step and seat.size != SIZES[-1] and mark not in seat.terminal.text:
            seat.wrong(f"{mark} is not on the screen")


def drawn(seat: Seat, sizes: Iterable[tuple[int, int]]) -> None:
    """Every size and every way of drawing that this terminal is here for: the form and DRAW on each."""
    while seat.reference.desk.mode != seat.kind.only_here[0]:
        next_mode(seat)
    for _ in seat.kind.only_here:
        for size in sizes:
            seat.size = size
            seat.terminal.resize(*size)
            seat.compare(f"a resize to {size}")
            seat.press("f7")
            seat.press("f8")
            seat.tally.combinations[f"{size[0]}x{size[1]} {seat.reference.desk.mode}"] += 1
        next_mode(seat)


def next_mode(seat: Seat) -> None:
    """The key that changes the characters, on DRAW."""
    for key in ("f7", "f7", "f8"):
        seat.press(key)


def one_kind(kind: Kind, number: int, sizes: tuple[tuple[int, int], ...] = SIZES) -> Tally:
    """One terminal: the script on a size of its own, then every size with every way of drawing."""
    tally = Tally()
    sequences = FUNCTION_KEYS.get(kind.term, XTERM) if number % 2 == 0 else ()
    with seated(kind, sizes[number % len(sizes)], sequences, tally) as seat:
        for step, key in enumerate(SCRIPT):
            marks(seat, step)
            seat.press(key)
        drawn(seat, sizes)
    return tally


def one_mode(name: str) -> Tally:
    """The script by the function keys of one of PuTTY's modes."""
    tally = Tally()
    with seated(Kind("putty", Colors.MANY, "UTF-8"), SIZES[0], PUTTY[name], tally) as seat:
        for key in SCRIPT:
            seat.press(key)
    tally.wrong = [f"PuTTY's mode {name}: {one}" for one in tally.wrong]
    return tally


def report(tallies: dict[str, Tally]) -> Iterator[str]:
    """A line for each kind, and the sum."""
    whole = Tally()
    yield f"{'terminal':<34}{'combinations':>14}{'screens':>10}{'failures':>10}"
    for name, tally in tallies.items():
        combinations = sum(tally.combinations.values())
        yield f"{name:<34}{combinations:>14}{tally.screens:>10}{len(tally.wrong):>10}"
        whole.add(tally)
    yield from (f"WRONG: {text}" for text in whole.wrong)
    yield " ".join(f"{name}: {count}." for name, count in sorted(whole.combinations.items()))
    yield (
        f"{sum(whole.combinations.values())} combinations in {whole.runs} runs, {whole.screens} screens compared, "
        f"failures {len(whole.wrong)}"
    )


def gathered(pool: ProcessPoolExecutor, every: tuple[Kind, ...]) -> dict[str, Tally]:
    """These terminals, summed up by TERM and colors, then PuTTY's modes."""
    tallies: dict[str, Tally] = {}
    for kind, tally in zip(every, pool.map(one_kind, every, range(len(every))), strict=True):
        tallies.setdefault(f"{kind.term} {kind.colors}", Tally()).add(tally)
        print(kind, len(tally.wrong), file=sys.stderr)
    for name, tally in zip(PUTTY, pool.map(one_mode, PUTTY), strict=True):
        tallies[f"PuTTY keys {name}"] = tally
    return tallies


def main() -> int:
    """Print the report; exit status 1 when anything was wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--at-once", type=int, default=2)
    parser.add_argument("--all", action="store_true", help="every terminal with every color in every locale")
    options = parser.parse_args()
    every = kinds() if options.all else sampled()
    print(f"{len(every)} of {len(kinds())} terminals with colors and locale; --all runs them all")
    with ProcessPoolExecutor(options.at_once) as pool:
        tallies = gathered(pool, every)
    print("\n".join(report(tallies)))
    return 1 if any(tally.wrong for tally in tallies.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
