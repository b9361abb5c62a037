"""The program under every kind of terminal, its screen compared cell by cell: `python -m tests.reports.matrix`.

TERM x colors x locale x drawing characters x size, and the function keys of every mode of PuTTY.  What stands on a
terminal emulator's screen after every key is compared with what was recorded on an xterm, where every picture was also
painted anew; the bytes are looked through for anything a terminal would not take; the cursor has to be seen, without
any color too.
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

from app.terminal.capabilities import LOOKALIKE_ERRORS, set_charset
from tests.reports.recorded import Picture, Step, difference, keys_of, masked, recorded
from tests.reports.terminals import (
    FUNCTION_KEYS,
    MODES,
    PUTTY,
    SIZES,
    XTERM,
    Colors,
    Kind,
    kinds,
    sampled,
    sent,
)
from tests.terminal import Terminal, cutcomp, running

ROOT: Final = Path(__file__).parents[2]
set_charset(None, "ascii")  # what stands in for characters that a terminal has not
PART: Final = "pocket"
PATIENCE: Final = 30.0
"""Seconds until a screen counts as wrong."""
KNOWN: Final = re.compile(rb"\x1b\[[0-9;?<>=]*\$?[a-zA-Z]|\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)|\x1b[78=>]|[\r\n]")
"""Control sequences with one meaning everywhere."""
HEX: Final = re.compile(r"[0-9a-f]{6}")

SCRIPT: Final = (
    # a number that cannot be read, and all that is on START
    keys_of("ctrl+home", ["tab"] * 5, [*"1..5"], "enter", "ctrl+z", "up", "shift+tab", "up", "up", "up", "f1", "f2")
    + keys_of(["tab"] * 11, "4", "enter", "f3", "f4", "tab", "f7", "f8", "f8", "f5", "f7", "f8", "f8")
    # TOOL SETUP with its import, the look-ahead table
    + keys_of("f6", "f2", "f1", "f7", "f8", "f3", "f2", "f8", "f8")
    + keys_of("ctrl+home", ["tab"] * 11, "space", "down", "f3", "f7", "f8", "f8")
    # segments, the two lists, HELP, DRAW with its keys
    + keys_of("ctrl+home", "pagedown", "f2", "f1", "ctrl+z", "f9", "f9", "f10", "f10", "?", "f8")
    + keys_of("f7", "f1", "f2", "f3", "f4", "f5", "f8")
    # PROGRAM, POST, HOME
    + keys_of("f8", "f2", "f1", "f4", "f8", "f5", "f8", "f6", "f8", "f7", "f8", "f3", "f2", "escape", "f8")
    + keys_of("f8", "f4", "f8", "f8", "escape", "enter")
)
"""Every softkey at least once: an error, a USR look-ahead, every setup screen, DRAW, PROGRAM, HOME."""


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
    """One terminal with the program on it, beside the pictures that must be seen there, one after the other."""

    kind: Kind
    terminal: Terminal
    expected: Iterator[Picture]
    size: tuple[int, int]
    sequences: tuple[str, ...]
    tally: Tally
    last: Picture | None = None

    def walk(self, steps: Sequence[Step]) -> Iterator[Step]:
        """The first screen, then every step, each compared."""
        self.compare("the start")
        for step in steps:
            self.step(step)
            yield step

    def step(self, step: Step) -> None:
        """A key typed or another size, and the screen compared with the next picture."""
        if isinstance(step, tuple):
            self.size = step
            self.terminal.resize(*step)
        else:
            self.terminal.send(sent(step, self.sequences))
        self.compare(step)

    def compare(self, after: Step) -> None:
        """Wait until the screen is the next picture; tell what is wrong if it never is."""
        self.last = next(self.expected)
        self.again(after)

    def again(self, after: Step) -> None:
        """Wait until the screen is the last picture."""
        assert self.last is not None
        right = self.last
        begun = time.monotonic()
        while True:
            self.terminal.read(quiet=0.02, longest=0.1)
            trouble = self.trouble(right)
            if not trouble:
                break
            if time.monotonic() - begun > PATIENCE:
                self.wrong(f"after {after}: {trouble}")
                raise Lost
        self.tally.screens += 1

    def wrong(self, text: str) -> None:
        self.tally.wrong.append(f"{self.kind} {self.size}: {text}")

    def trouble(self, right: Picture) -> str:
        """The first line that is not as it must be, or the cursor that is not seen; empty when all is well."""
        lines = right.lines
        if self.kind.characters != "utf-8":
            lines = tuple(
                line.encode(self.kind.characters, LOOKALIKE_ERRORS).decode(self.kind.characters) for line in lines
            )
        shown = Picture(masked(self.terminal.screen.display), right.cursor)
        return difference(shown, Picture(lines, right.cursor)) or self.invisible(right)

    def invisible(self, right: Picture) -> str:
        """Where the cursor is not seen: in each of its cells with many colors, else somewhere in each line of it.

        There an empty field shows it as one underlined cell.
        """
        few = self.kind.shown in (Colors.FEW, Colors.NONE)
        for row in sorted({row for _, row in right.cursor}):
            columns = sorted(column for column, at in right.cursor if at == row)
            # the place where the next sign goes has colors of its own
            wanted = range(columns[0], columns[-1] + 1) if few else columns
            cells = [self.terminal.screen.buffer[row][column] for column in wanted]
            seen = [stands_out(cell, self.kind.shown) for cell in cells]
            if not (any(seen) or sum(cell.underscore for cell in cells) == 1 if few else all(seen)):
                return f"the cursor is not seen in line {row}: {cells[seen.index(False)]}"
        return ""


def stands_out(cell: Any, colors: Colors) -> bool:
    """Whether a cell of the cursor differs from its surroundings, by an attribute where colors are few."""
    if colors in (Colors.FEW, Colors.NONE):
        return bool(cell.reverse)
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


Recordings = dict[tuple[tuple[int, int], str, tuple[Step, ...]], list[Picture]]
RECORDINGS: Final[Recordings] = {}
"""What was recorded in this process or handed to it."""


def pictures(size: tuple[int, int], mode: str, steps: tuple[Step, ...]) -> list[Picture]:
    """The pictures of a script, recorded once."""
    if (size, mode, steps) not in RECORDINGS:
        RECORDINGS[size, mode, steps] = recorded(["--characters", mode, "--example", PART], steps, size)
    return RECORDINGS[size, mode, steps]


def recording(size: tuple[int, int], mode: str, steps: tuple[Step, ...]) -> Recordings:
    """One of them, for another process."""
    return {(size, mode, steps): pictures(size, mode, steps)}


@contextmanager
def seated(
    kind: Kind, size: tuple[int, int], steps: tuple[Step, ...], sequences: tuple[str, ...], tally: Tally, mode: str
) -> Iterator[Seat]:
    """A seat whose program has just been started; what it was sent is looked through in the end."""
    option = ["--characters", mode] if mode != kind.modes[0] or kind.asked else []
    expected = iter(pictures(size, mode, steps))
    own = {**kind.environment, "PYTHONPATH": str(ROOT)}
    with (
        TemporaryDirectory() as folder,
        running(
            cutcomp("--example", PART, *option), columns=size[0], rows=size[1], environment=own, cwd=folder
        ) as terminal,
        suppress(Lost),
    ):
        if kind.characters != "utf-8":
            terminal.stream.select_other_charset("@")
        seat = Seat(kind, terminal, expected, size, sequences, tally)
        tally.runs += 1
        yield seat
        if trouble := stray(bytes(terminal.seen), kind.characters) or colors_wrong(terminal, kind.shown):
            seat.wrong(trouble)


def resizing(sizes: Sequence[tuple[int, int]]) -> tuple[Step, ...]:
    """The form and DRAW on every size."""
    return tuple(step for size in sizes for step in (size, "f7", "f8"))


def drawn(kind: Kind, mode: str, sizes: tuple[tuple[int, int], ...], tally: Tally) -> None:
    """One way of drawing that this terminal is here for, on every size."""
    steps = resizing(sizes)
    with seated(kind, SIZES[0], steps, (), tally, mode) as seat:
        shown = (f"{seat.size[0]}x{seat.size[1]} {mode}" for step in seat.walk(steps) if step == "f8")
        tally.combinations.update(shown)


def one_kind(kind: Kind, number: int, sizes: tuple[tuple[int, int], ...] = SIZES) -> Tally:
    """One terminal: the script on a size of its own, then every size with every way of drawing."""
    tally = Tally()
    sequences = FUNCTION_KEYS.get(kind.term, XTERM) if number % 2 == 0 else ()
    with seated(kind, sizes[number % len(sizes)], SCRIPT, sequences, tally, kind.modes[0]) as seat:
        list(seat.walk(SCRIPT))
    for mode in kind.only_here:
        drawn(kind, mode, sizes, tally)
    return tally


def one_mode(name: str) -> Tally:
    """The script by the function keys of one of PuTTY's modes."""
    tally = Tally()
    with seated(Kind("putty", Colors.MANY, "UTF-8"), SIZES[0], SCRIPT, PUTTY[name], tally, MODES[0]) as seat:
        list(seat.walk(SCRIPT))
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


def record_all(pool: ProcessPoolExecutor) -> Recordings:
    """Every picture that is compared with."""
    wanted: list[tuple[tuple[int, int], str, tuple[Step, ...]]] = [
        (size, mode, SCRIPT) for size, mode in product(SIZES, MODES)
    ]
    wanted += [(SIZES[0], mode, resizing(SIZES)) for mode in MODES]
    made: Recordings = {}
    for one in pool.map(recording, *zip(*wanted, strict=True)):
        made |= one
    return made


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
        recordings = record_all(pool)
    print(f"{sum(map(len, recordings.values()))} pictures recorded", flush=True)
    with ProcessPoolExecutor(options.at_once, initializer=RECORDINGS.update, initargs=(recordings,)) as pool:
        tallies = gathered(pool, every)
    print("\n".join(report(tallies)))
    return 1 if any(tally.wrong for tally in tallies.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
