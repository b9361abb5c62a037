"""The screens that need a file's troubles, on every kind of terminal: `python -m tests.reports.dialogs`.

START, OPEN, SAVE AS, LEAVE, OPEN ALREADY, work that was not saved, CHANGED MEANWHILE and NC PROOF.  What stands on each
terminal is compared, but for times, with what stands on an xterm of UTF-8, and its bytes are looked through as in the
matrix; on a terminal without colors something has to stand out all the same.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from app.documents.lock import myself, take
from app.documents.programs import example
from app.terminal.character_set import lookalike
from tests.app.kept import DEAD, ELSEWHERE, started
from tests.reports.matrix import ROOT, colors_wrong, stray
from tests.reports.terminals import Colors, Kind, sampled
from tests.terminal import Terminal, running

PART: Final = "part.toml"
NC: Final = "square.nc"
TIMES: Final = re.compile(r"\d{4}-\d\d-\d\d-\d{6}|\d{4}-\d\d-\d\d|\d\d:\d\d")
"""What the clock and a file's time make different from run to run."""
FOLDERS: Final = re.compile(r"/tmp/[a-z0-9_]+")
QUIET: Final = 0.3
PATIENCE: Final = 20.0
PLAIN: Final = Kind("xterm-256color", Colors.MANY, "UTF-8")


@dataclass(frozen=True)
class Step:
    """Bytes typed, and the title that stands on the screen then; `before` is done in the folder first."""

    name: str
    typed: bytes
    title: str
    before: Callable[[Path], object] = lambda _: None


@dataclass(frozen=True)
class Scene:
    """One start of the program in a folder with files; `before` gets them into trouble."""

    arguments: tuple[str, ...]
    steps: tuple[Step, ...]
    before: Callable[[Path], object] = lambda _: None


def left_behind(folder: Path) -> None:
    """Work of this user that a program which died has left."""
    me = replace(DEAD, user=myself("").user)
    started(folder / "own", folder / PART, me).press("tab").type("7").killed()


def changed(folder: Path) -> None:
    """Somebody else has written the file."""
    shutil.copy(example("notch"), folder / PART)


SCENES: Final = (
    Scene((), (Step("START", b"", "EXAMPLES"), Step("OPEN", b"\x0f", "OPEN"))),
    Scene(
        ("--example", "pocket"),
        (
            Step("the form", b"", "GOUGE none"),
            Step("SAVE AS", b"\x13", "SAVE AS"),
            Step("LEAVE", b"\x1b8\t7\r\x11", "LEAVE"),
        ),
    ),
    Scene((PART,), (Step("OPEN ALREADY", b"", "OPEN ALREADY"),), lambda folder: take(folder / PART, ELSEWHERE)),
    Scene(
        (PART,),
        (
            Step("recovery", b"", "WORK THAT WAS NOT SAVED"),
            Step("restored", b"r", "Your work is back"),
            Step("CHANGED MEANWHILE", b"\x13", "CHANGED MEANWHILE", changed),
        ),
        left_behind,
    ),
    Scene((NC,), (Step("NC PROOF", b"", "NC PROOF"),)),
)
NAMES: Final = tuple(step.name for scene in SCENES for step in scene.steps)


def screens(kind: Kind, characters: str = "") -> Iterator[tuple[str, list[str], str]]:
    """The name of every screen, what stands on it, and what is wrong with its bytes and colors, in words."""
    for scene in SCENES:
        with TemporaryDirectory() as name:
            folder = Path(name)
            shutil.copy2(example("pocket"), folder / PART)
            shutil.copy2(ROOT / "tests/data/nc/threeblock-inside.nc", folder / NC)
            scene.before(folder)
            option = ["--characters", characters or kind.asked] if characters or kind.asked else []
            arguments = [sys.executable, "-m", "app", *option, *scene.arguments]
            environment = {**kind.environment, "PYTHONPATH": str(ROOT)}
            with running(arguments, environment=environment, cwd=name) as terminal:
                if kind.characters != "utf-8":
                    terminal.stream.select_other_charset("@")
                yield from walked(kind, scene, folder, terminal)


def walked(kind: Kind, scene: Scene, folder: Path, terminal: Terminal) -> Iterator[tuple[str, list[str], str]]:
    """The screens of one start."""
    for step in scene.steps:
        step.before(folder)
        terminal.send(step.typed)
        try:
            terminal.until(step.title, longest=PATIENCE)
        except AssertionError:
            yield step.name, [], f"it does not come:\n{terminal.text}"
            return
        settle(terminal)
        wrong = stray(bytes(terminal.seen), kind.characters) or colors_wrong(terminal, kind.shown)
        yield step.name, masked(terminal), wrong or flat(terminal)


def settle(terminal: Terminal) -> None:
    """Wait until nothing comes any more and nothing is still being calculated, but not for ever."""
    begun = time.monotonic()
    while (terminal.read(quiet=QUIET).count or " ..." in terminal.text) and time.monotonic() - begun < PATIENCE:
        pass


def masked(terminal: Terminal) -> list[str]:
    """The screen without what differs from run to run: times, the folder's name, the status line's end."""
    lines = [FOLDERS.sub("/tmp/folder", TIMES.sub("time", line)).rstrip() for line in terminal.screen.display]
    return [*lines[:-1], lines[-1][:18]]


def flat(terminal: Terminal) -> str:
    """Nothing stands out: neither cursor nor title nor a softkey."""
    cells = (cell for row in terminal.screen.buffer.values() for cell in row.values())
    return "" if any(cell.reverse or cell.bold or cell.underscore for cell in cells) else "nothing stands out"


@lru_cache(None)
def expected(mode: str) -> dict[str, list[str]]:
    """The screens of an xterm of UTF-8 that draws with these characters."""
    return {name: lines for name, lines, _ in screens(replace(PLAIN, asked=mode), mode)}


def one_kind(kind: Kind) -> list[str]:
    """What is wrong on a terminal, screen by screen; empty where all is well."""
    wrong: list[str] = []
    seen = []
    for name, lines, trouble in screens(kind):
        seen.append(name)
        right = expected(kind.modes[0])[name]
        right = right if kind.characters == "utf-8" else [lookalike(line) for line in right]
        differing = [f"{one!r} instead of {other!r}" for one, other in zip(lines, right, strict=False) if one != other]
        wrong += [f"{kind}: {name}: {text}" for text in (trouble, *differing[:1]) if text]
    return wrong + [f"{kind}: {name} was not reached" for name in NAMES if name not in seen]


def main() -> int:
    """Print a line for each terminal and what is wrong; exit status 1 when anything is."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--at-once", type=int, default=2)
    options = parser.parse_args()
    every, failures = sampled(), 0
    print(f"{len(NAMES)} screens ({', '.join(NAMES)}) on {len(every)} terminals")
    with ProcessPoolExecutor(options.at_once) as pool:
        for kind, wrong in zip(every, pool.map(one_kind, every), strict=True):
            print(f"{kind!s:<40}{kind.form:<10} failures {len(wrong)}", *wrong, sep="\n  ", flush=True)
            failures += len(wrong)
    print(f"{len(NAMES) * len(every)} screens compared, failures {failures}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
