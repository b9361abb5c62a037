"""Every dialog, on every kind of terminal: `python -m tests.reports.dialogs`.

Each dialog is reached as an operator reaches it, at 80x24 and at 60x20.  Its words have to be readable in full inside
their frame, and Esc has to leave it.  What stands on the other terminals is compared, but for times, with what stands
on an xterm of UTF-8, and its bytes are looked through as in the matrix; something has to stand out without colors too.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from app.documents.journal_file import journal_path
from app.documents.lock import myself, take
from app.documents.programs import example
from app.terminal.capabilities import lookalike
from tests.app.documents.typist import DEAD, ELSEWHERE, started
from tests.reports.matrix import ROOT, colors_wrong, stray
from tests.reports.recorded import PLAIN, keys_of, masked
from tests.reports.terminals import Kind, sampled, sent
from tests.terminal import Terminal, cutcomp, running

PART: Final = "part.toml"
NC: Final = "square.nc"
SIZES: Final = ((80, 24), (60, 20))
QUIET: Final = 0.4
PATIENCE: Final = 40.0
TOP: Final = re.compile(r"[╭+][─-] .*[─-][╮+]")
END: Final = re.compile(r"[╰+][─-]+[╯+]")
WORKING: Final = re.compile(r"[a-z] \.\.\.|working +\d|calculating")
"""What says that something is still being worked out; dots alone are the path of an ASCII drawing."""
GO_BACK: Final = ("GO BACK, nothing changes",)
TABLE: Final = "T1 P1 D0.5 ;end mill\nT7 P7 D0.25\n"


@dataclass(frozen=True)
class Dialog:
    """A dialog: what starts the program, the keys that lead there, its title, and words that must be readable.

    `ready` stands on the screen before the keys are typed; `prepared` is done in the folder before the start, `before`
    once the program runs.
    """

    name: str
    arguments: tuple[str, ...]
    keys: tuple[str, ...]
    title: str
    words: tuple[str, ...] = ()
    ready: str = "F8"
    prepared: Callable[[Path], object] = lambda _: None
    before: Callable[[Path], object] = lambda _: None


def left_behind(folder: Path) -> None:
    """Work of this user that a program which died has left."""
    started(folder / "own", folder / PART, replace(DEAD, user=myself("").user)).type(7).killed()


def damaged(folder: Path) -> None:
    """A journal that nobody can read."""
    journal_path(folder / PART).write_bytes(b"no journal\n" * 9)


def changed(folder: Path) -> None:
    """Somebody else has written the file."""
    shutil.copy(example("notch"), folder / PART)


def taken(folder: Path) -> None:
    """Somebody else has taken the lock over."""
    lock = folder / f".{PART}.cutcomp-lock"
    lock.unlink(missing_ok=True)
    take(folder / PART, ELSEWHERE)


OTHER: Final = keys_of("ctrl+home", "tab", "7", "enter")
"""Another TOOL."""


def palette(words: str) -> tuple[str, ...]:
    """A command by its name."""
    return keys_of("ctrl+k", [*words], "enter")


POCKET: Final = ("--example", "pocket")
DIALOGS: Final = (
    Dialog("QUIT", POCKET, (*OTHER, "ctrl+q"), "QUIT?", ("was never saved.", "DISCARD", "SAVE, then go on", *GO_BACK)),
    Dialog("OPEN", POCKET, (*OTHER, "ctrl+o", "enter"), "OPEN?", ("was never saved.", "DISCARD", *GO_BACK)),
    Dialog("NEW PROGRAM", POCKET, (*OTHER, "ctrl+o", "f2"), "NEW PROGRAM?", ("DISCARD", "SAVE, then go on", *GO_BACK)),
    Dialog(
        "OPEN ALREADY",
        (PART,),
        (),
        "OPEN ALREADY",
        ("has had this program open since", "LOOK, nothing can be changed", "TAKE OVER", *GO_BACK),
        prepared=lambda folder: take(folder / PART, ELSEWHERE),
    ),
    Dialog(
        "UNSAVED WORK",
        (PART,),
        (),
        "UNSAVED WORK FOUND",
        ("1 edit.", "RESTORE", "DISCARD, kept as a backup", *GO_BACK),
        prepared=left_behind,
    ),
    Dialog(
        "DAMAGED WORK",
        (PART,),
        (),
        "UNSAVED WORK IS DAMAGED",
        ("is damaged and cannot be read.", "CONTINUE, without it", *GO_BACK),
        prepared=damaged,
    ),
    Dialog(
        "CHANGED MEANWHILE",
        (PART,),
        (*OTHER, "ctrl+s"),
        "CHANGED MEANWHILE",
        ("was changed by somebody else", "Both are kept.", "YOURS, the other one is kept", "THEIRS", *GO_BACK),
        before=changed,
    ),
    Dialog(
        "TAKEN OVER",
        (PART,),
        (*OTHER, "ctrl+s"),
        "TAKEN OVER: SAVE ANYWAY?",
        ("bob on office has taken part.toml over.", "KEEP BOTH", "OVERWRITE, under this name", *GO_BACK),
        before=taken,
    ),
    Dialog(
        "REPLACE",
        POCKET,
        keys_of("ctrl+s", "ctrl+a", ["delete"] * 20, [*"part"], "enter"),
        "REPLACE THE FILE?",
        ("exists. Its content is replaced.", "REPLACE", *GO_BACK),
    ),
    Dialog(
        "ANOTHER FOLDER",
        POCKET,
        keys_of("ctrl+s", "ctrl+a", ["delete"] * 20, [*"/tmp/x.toml"], "enter"),
        "WRITE IN ANOTHER FOLDER?",
        ("is not in the current folder", "WRITE THERE", *GO_BACK),
    ),
    Dialog(
        "UNITS", POCKET, ("f4", "right", "enter"), "UNITS", ("Convert every typed length and feed", "CONVERT", *GO_BACK)
    ),
    Dialog("IMPORT", (PART,), keys_of("f6", "f3", "enter"), "IMPORT?", ("IMPORT", *GO_BACK)),
    Dialog("TOOLS", POCKET, ("ctrl+home", "tab", "space"), "TOOLS", ("END MILL",)),
    Dialog("SHIFT BLOCK", POCKET, palette("shift block"), "SHIFT BLOCK", ("Distance to move", "X", "Y")),
    Dialog("ROTATE BLOCK", POCKET, palette("rotate block"), "ROTATE BLOCK", ("Counterclockwise about", "ANGLE")),
    Dialog("MIRROR BLOCK", POCKET, palette("mirror block"), "MIRROR BLOCK", ("In the line through X, Y at ANGLE",)),
    Dialog("REPEAT", POCKET, palette("repeat segments, shifted"), "REPEAT, SHIFTED", ("FIRST SEGMENT", "LAST SEGMENT")),
    Dialog("PALETTE", POCKET, ("ctrl+k",), "Search for commands", ("PART SETUP", "EXIT to program")),
    Dialog("CONTROL", (NC,), ("c",), "CONTROL", ("linuxcnc",), "FINDINGS"),
    Dialog("COMPARE CONTROLS", (NC,), ("v",), "COMPARE CONTROLS", ("linuxcnc",), "FINDINGS"),
    Dialog("TOOL DIAMETER", (NC,), ("t",), "TOOL DIAMETER", ("Tool and diameter in", "1=12 or 1=.5in."), "FINDINGS"),
    Dialog("LEAVE NC PROOF", (NC,), keys_of("f1", "1", "f8"), "LEAVE?", ("DISCARD", *GO_BACK), "FINDINGS"),
)


@dataclass
class Seen:
    """A dialog as it stood: its lines, and what is wrong with it, in words."""

    name: str
    lines: tuple[str, ...]
    trouble: list[str]


def reached(dialog: Dialog, kind: Kind, size: tuple[int, int], characters: str = "") -> Seen:
    """Go there, look, and leave by Esc."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        for source, target in ((example("pocket"), PART), (ROOT / "tests/data/nc/threeblock-inside.nc", NC)):
            shutil.copy2(source, folder / target)
        (folder / "tool.tbl").write_text(TABLE)
        dialog.prepared(folder)
        option = ["--characters", characters or kind.asked] if characters or kind.asked else []
        environment = {**kind.environment, "PYTHONPATH": str(ROOT), "HOME": name}
        command = cutcomp(*option, *dialog.arguments)
        with running(command, columns=size[0], rows=size[1], environment=environment, cwd=name) as terminal:
            if kind.characters != "utf-8":
                terminal.stream.select_other_charset("@")
            return _walked(dialog, kind, terminal, folder)


def _walked(dialog: Dialog, kind: Kind, terminal: Terminal, folder: Path) -> Seen:
    seen = Seen(dialog.name, (), [])
    try:
        terminal.until(dialog.ready, longest=PATIENCE)
        dialog.before(folder)
        for key in dialog.keys:
            terminal.send(sent(key))
            terminal.read(quiet=0.05, longest=0.3)
        terminal.until(*titles(dialog), longest=PATIENCE)
    except AssertionError:
        seen.trouble.append(f"it does not come:\n{terminal.text}")
        return seen
    settle(terminal)
    seen.lines = masked(terminal.screen.display)
    seen.trouble += unreadable(dialog, terminal)
    seen.trouble += [one for one in (flat(terminal),) if one]
    leave(dialog, terminal, seen)
    wrong = stray(bytes(terminal.seen), kind.characters) or colors_wrong(terminal, kind.shown)
    seen.trouble += [wrong] if wrong else []
    return seen


def titles(dialog: Dialog) -> tuple[str, ...]:
    """The title as it stands in the frame."""
    return (dialog.title,) if dialog.name == "PALETTE" else (f"─ {dialog.title} ─", f"- {dialog.title} -")


def leave(dialog: Dialog, terminal: Terminal, seen: Seen) -> None:
    """Esc leaves it."""
    terminal.send(b"\x1b")
    begun = time.monotonic()
    while any(title in terminal.text for title in titles(dialog)):
        terminal.read(quiet=0.05, longest=0.2)
        if time.monotonic() - begun > PATIENCE / 4:
            seen.trouble.append(f"Esc does not leave it:\n{terminal.text}")
            return
    settle(terminal)
    if terminal.ended() is not None:
        seen.trouble.append("Esc ends the program")


def unreadable(dialog: Dialog, terminal: Terminal) -> Iterator[str]:
    """Words that are not on the screen in full, and a frame that is cut off."""
    framed = [line.strip() for line in columns_of(dialog, terminal.screen.display)]
    words = " ".join(" ".join(inside(line) for line in framed).split())
    for word in dialog.words:
        if word not in words:
            yield f"{word!r} cannot be read:\n{terminal.text}"
    if dialog.name != "PALETTE" and not any("╰" in line or "+--" in line for line in framed[1:]):
        yield f"the frame has no lower end:\n{terminal.text}"


def columns_of(dialog: Dialog, lines: Sequence[str]) -> Sequence[str]:
    """The lines from the title on, cut off beside the frame: a drawing next to it has signs like the frame's."""
    for row, line in enumerate(lines):
        for title in titles(dialog):
            if title in line and line[: line.index(title)].rstrip("─-").endswith(("╭", "+")):
                start = len(line[: line.index(title)].rstrip("─-")) - 1
                ends = [line.find(corner, start + 1) for corner in "╮+"]
                return [each[start : max(ends) + 1] for each in lines[row:]]
    return lines


def inside(line: str) -> str:
    """What stands between the sides of a frame, else the whole line."""
    for side in "│|":
        if line.count(side) >= 2:
            return line.split(side)[1]
    return line


def settle(terminal: Terminal) -> None:
    """Wait until nothing comes any more and nothing is still being calculated, but not for ever."""
    begun = time.monotonic()
    while (terminal.read(quiet=QUIET).count or WORKING.search(terminal.text)) and time.monotonic() - begun < PATIENCE:
        pass


def flat(terminal: Terminal) -> str:
    """Nothing stands out: neither cursor nor title nor an answer."""
    cells = (cell for row in terminal.screen.buffer.values() for cell in row.values())
    return "" if any(cell.reverse or cell.bold or cell.underscore for cell in cells) else "nothing stands out"


def named(name: str) -> Dialog:
    """A dialog by its name."""
    return next(one for one in DIALOGS if one.name == name)


@lru_cache(None)
def expected(name: str, mode: str) -> tuple[str, ...]:
    """A dialog on an xterm of UTF-8 that draws with these characters."""
    return reached(named(name), PLAIN, SIZES[0], mode).lines


def on_an_xterm(name: str) -> list[str]:
    """What is wrong with a dialog at either size."""
    dialog = named(name)
    return [f"{dialog.name} {size}: {text}" for size in SIZES for text in reached(dialog, PLAIN, size).trouble]


def one_kind(kind: Kind) -> list[str]:
    """What is wrong on another terminal, dialog by dialog; empty where all is well."""
    wrong: list[str] = []
    for dialog in DIALOGS:
        seen, right = reached(dialog, kind, SIZES[0]), expected(dialog.name, kind.modes[0])
        right = right if kind.characters == "utf-8" else tuple(lookalike(line) for line in right)
        pairs = zip(box(seen.lines), box(right), strict=False)
        differing = [f"{one!r} instead of {other!r}" for one, other in pairs if one != other]
        wrong += [f"{kind}: {dialog.name}: {text}" for text in (*seen.trouble, *differing[:1]) if text]
    return wrong


def box(lines: tuple[str, ...]) -> list[str]:
    """The lines of the dialog itself; what stands behind it may still be worked out."""
    tops = [(row, found) for row, line in enumerate(lines) if (found := TOP.search(line))]
    ends = [row for row, line in enumerate(lines) if END.search(line)]
    if not tops or not ends:
        return list(lines[:-1])
    row, top = tops[0]
    return [line[top.start() : top.end()] for line in lines[row : ends[-1] + 1]]


def main() -> int:
    """Print a line for each dialog and terminal and what is wrong; exit status 1 when anything is."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--at-once", type=int, default=2)
    parser.add_argument("--terminals", type=int, default=len(sampled()), help="how many of the other terminals")
    options = parser.parse_args()
    every, failures = sampled()[: options.terminals], 0
    print(f"{len(DIALOGS)} dialogs at {len(SIZES)} sizes, then on {len(every)} terminals")
    with ProcessPoolExecutor(options.at_once) as pool:
        names = [dialog.name for dialog in DIALOGS]
        for name, wrong in zip(names, pool.map(on_an_xterm, names), strict=True):
            print(f"{name:<40} failures {len(wrong)}", *wrong, sep="\n  ", flush=True)
            failures += len(wrong)
        for kind, wrong in zip(every, pool.map(one_kind, every), strict=True):
            print(f"{kind!s:<40}{kind.form:<10} failures {len(wrong)}", *wrong, sep="\n  ", flush=True)
            failures += len(wrong)
    print(f"{len(DIALOGS) * (len(SIZES) + len(every))} dialogs looked at, failures {failures}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
