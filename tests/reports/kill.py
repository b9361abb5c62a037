"""Killed at random moments, nothing that was accepted is lost: `python -m tests.reports.kill --times 500`.

A real pty types a program into the real screens until SIGKILL strikes, at a moment drawn at random: while it starts,
while it asks, in the middle of a key, a write or a save.  The same keys go into a desk in memory, which knows the
program and its undo after each of them.  What comes back must be a state between the last one that the screen had
acknowledged and the last key sent, with its undo; the next start must offer it, restore it, and save it as it is.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import signal
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from app.documents.files import load
from app.documents.journal_file import journal_path
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.places import read
from app.painted.session import FIRST, SEGMENT, Session
from core.program.edit import FormPlace
from core.program.history import History, differences
from tests.app.operator import Operator
from tests.terminal import Terminal, running

LIVES_OF_A_PART = 30
"""After so many kills another part is begun, so that programs of all lengths are typed."""


BYTES = {
    "tab": b"\t",
    "enter": b"\r",
    "up": b"\x1b[A",
    "down": b"\x1b[B",
    "shift+tab": b"\x1b[Z",
    "pageup": b"\x1b[5~",
    "pagedown": b"\x1b[6~",
    "backspace": b"\x7f",
    "delete": b"\x1b[3~",
    "ctrl+z": b"\x1a",
    "ctrl+y": b"\x19",
    "ctrl+s": b"\x13",
}
"""What a terminal sends for a key that is no character."""
MOVES = ("tab", "tab", "tab", "down", "up", "shift+tab", "pageup", "pagedown")


@dataclass
class Part:
    """One program on its way through many crashes: its file, and the desk in memory after every key since the start.

    `acknowledged` is the index of the last state that the screen of the killed program had shown.
    """

    file: Path
    states: list[Session] = field(default_factory=list)
    operator: Operator = field(default_factory=Operator.at)
    acknowledged: int = 0

    def begin(self, history: History, where: FormPlace = FIRST, name: str = SEGMENT) -> None:
        """Go on from here, as the program does it after a start; what the desk in memory saves goes elsewhere."""
        shadow = self.file.with_suffix(".shadow")
        shadow.unlink(missing_ok=True)
        session = replace(Session.of(history.program, shadow), history=history).at(where, name)
        self.operator = Operator(Desk(session))
        self.states, self.acknowledged = [session], 0

    def press(self, key: str) -> None:
        """A key typed."""
        self.operator.press(key)
        self.states.append(self.operator.session)

    def possible(self) -> list[Session]:
        """What may come back."""
        return self.states[self.acknowledged :]


@dataclass
class Tally:
    """What happened, and each loss in words."""

    kills: int = 0
    moments: Counter[str] = field(default_factory=Counter)
    lost: list[str] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        self.kills += other.kills
        self.moments.update(other.moments)
        self.lost += other.lost


def counts(text: str) -> tuple[int, int]:
    """How much the screen says can be undone and redone."""
    last = text.rstrip().splitlines()[-1] if text.strip() else ""
    found = {name: re.search(rf"\b{name} (\d+)", last) for name in ("undo", "redo")}
    undo, redo = (0 if one is None else int(one[1]) for one in found.values())
    return undo, redo


def counts_of(history: History) -> tuple[int, int]:
    """How much can be undone and redone."""
    return history.undo_count, history.redo_count


def acknowledge(part: Part, terminal: Terminal) -> None:
    """The first state from the last acknowledged one on that the screen may be showing."""
    shown = counts(terminal.text)
    for index in range(part.acknowledged, len(part.states)):
        if counts_of(part.states[index].history) == shown:
            part.acknowledged = index
            return


def type_until_killed(part: Part, terminal: Terminal, chance: random.Random) -> None:
    """Type; now and then wait until the screen has caught up, now and then do not."""
    while terminal.ended() is None:
        for key in next_keys(chance, part.operator):
            part.press(key)
            with suppress(OSError):
                terminal.send(bytes_of_key(key))
            if chance.random() < 0.3:
                terminal.read(quiet=0.001, longest=0.02)
        if chance.random() < 0.6:
            wait_for(part, terminal)
        acknowledge(part, terminal)


def wait_for(part: Part, terminal: Terminal) -> None:
    """Until the screen shows the last state, or the program is dead."""
    wanted = counts_of(part.states[-1].history)
    begun = time.monotonic()
    while counts(terminal.text) != wanted and time.monotonic() - begun < 1.0:
        if terminal.read(quiet=0.01, longest=0.01).count == 0 and not alive(terminal.pid):
            return


def alive(pid: int) -> bool:
    """Whether a child of ours runs; a dead one that was not waited for does not."""
    return os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None


def came_back(part: Part, tally: Tally) -> bool:
    """Go on from what came back, by the journal or by the saved file; tells whether it must be offered."""
    saved = load(part.file) if part.file.exists() else empty_program()
    found = read(journal_path(part.file))
    if found is None or found.history.program == saved:
        if not any(state.program == saved for state in part.possible()):
            lose(part, tally, History(saved))
        part.begin(History(saved))
        return False
    if not any(state.history == found.history for state in part.possible()):
        lose(part, tally, found.history)
    part.begin(found.history, found.cursor.where, found.cursor.field)
    return True


def lose(part: Part, tally: Tally, history: History) -> None:
    """Tell what is missing."""
    wanted = part.states[part.acknowledged]
    words = differences(history.program, wanted.program) or ("the same program with another history",)
    tally.lost.append(
        f"{part.file.name}, kill {tally.kills}: undo, redo {counts_of(history)} came back, "
        f"{counts_of(wanted.history)} had been accepted. {' '.join(words)}"
    )


def restored(terminal: Terminal, *, offered: bool) -> None:
    """The start of the program: what was left behind is offered and restored."""
    terminal.until("RESTORE" if offered else "MILL CONTOUR")
    if offered:
        terminal.send(b"r")
        terminal.until("Your work is back")
    else:
        assert "RESTORE" not in terminal.text


def compared(part: Part, terminal: Terminal, tally: Tally) -> None:
    """Saved by the real program, what came back is what the desk in memory has.

    Killed behind a save and before its journal says so, it asks: the file is not the one that the journal is about.
    """
    terminal.send(b"\x13")
    part.press("ctrl+s")
    terminal.until("Saved", "CHANGED MEANWHILE")
    if "CHANGED MEANWHILE" in terminal.text:
        tally.moments["killed between a save and its journal"] += 1
        assert "It holds the same program as when it was opened here." in " ".join(terminal.text.split())
        terminal.send(b"y")
        terminal.until("Saved")
    if load(part.file) != part.states[-1].program:
        lose(part, tally, History(load(part.file)))


def one_life(part: Part, chance: random.Random, tally: Tally, own: Path) -> None:
    """From a start to the next kill."""
    if not part.states:
        part.begin(History(empty_program()))
    offered = came_back(part, tally)
    tally.moments["work offered" if offered else "nothing to offer"] += 1
    early = chance.random() < 0.2
    with running(
        [sys.executable, "-m", "app", str(part.file)],
        environment={"XDG_STATE_HOME": str(own), "XDG_CONFIG_HOME": str(own)},
    ) as terminal:
        if early:
            time.sleep(chance.uniform(0.0, 0.9))
            tally.moments["killed while it starts or asks"] += 1
            if chance.random() < 0.5:
                terminal.read(quiet=0.0, longest=0.0)
                terminal.send(b"r")
                time.sleep(chance.uniform(0.0, 0.02))
            os.kill(terminal.pid, signal.SIGKILL)
        else:
            restored(terminal, offered=offered)
            if chance.random() < 0.3:
                compared(part, terminal, tally)
            struck(part, terminal, chance)
            tally.moments["killed while it is typed into"] += 1
            tally.moments["keys typed"] += len(part.states) - 1
            tally.moments["keys ahead of the screen"] += len(part.states) - 1 - part.acknowledged
    tally.kills += 1


def struck(part: Part, terminal: Terminal, chance: random.Random) -> None:
    """Typed into until a timer kills, whatever is going on at that moment."""
    timer = threading.Timer(chance.uniform(0.0, 1.0), os.kill, (terminal.pid, signal.SIGKILL))
    timer.start()
    try:
        type_until_killed(part, terminal, chance)
    finally:
        timer.join()
    terminal.read(quiet=0.05, longest=0.5)
    acknowledge(part, terminal)


def lives(times: int, seed: int) -> Tally:
    """So many kills, one after the other."""
    chance, tally = random.Random(seed), Tally()
    with tempfile.TemporaryDirectory() as folder:
        for number in range(times):
            if number % LIVES_OF_A_PART == 0:
                part = Part(Path(folder) / f"part-{seed}-{number}.toml")
            one_life(part, chance, tally, Path(folder))
        came_back(part, tally)
    return tally


def report(tally: Tally) -> Iterator[str]:
    """The result, and what it rests on."""
    for what, count in sorted(tally.moments.items()):
        yield f"{what:<36}{count:>8}"
    yield from (f"LOST: {text}" for text in tally.lost)
    yield f"{tally.kills} kills, {len(tally.lost)} lost"


def main() -> int:
    """Print the report; exit status 1 when anything was lost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=2)
    options = parser.parse_args()
    share = [options.times // options.at_once + (n < options.times % options.at_once) for n in range(options.at_once)]
    whole = Tally()
    with ProcessPoolExecutor(options.at_once) as pool:
        for tally in pool.map(lives, share, range(options.seed, options.seed + options.at_once)):
            whole.add(tally)
    print("\n".join(report(whole)))
    return 1 if whole.lost else 0


def next_keys(chance: random.Random, operator: Operator) -> list[str]:
    """What an operator does next."""
    kind = chance.choices(("number", "move", "segment", "undo", "redo", "save", "rubbish"), (10, 5, 3, 2, 1, 1, 1))[0]
    match kind:
        case "number":
            text = f"{chance.uniform(-5, 20):.{chance.randint(0, 4)}f}"
            return [*text, chance.choice(("enter", "tab", "down"))]
        case "segment":
            count = len(operator.session.block.segments) - operator.session.where.segment + 1
            return [*["pagedown"] * count, chance.choice("lab")]
        case "undo" | "redo":
            return ["ctrl+z" if kind == "undo" else "ctrl+y"] * chance.randint(1, 4)
        case "save":
            return ["ctrl+s"]
        case "rubbish":
            return [*"2..5", "tab"]
        case _:
            return [chance.choice(MOVES) for _ in range(chance.randint(1, 3))]


def bytes_of_key(key: str) -> bytes:
    """A key as bytes."""
    return BYTES.get(key) or key.encode()


if __name__ == "__main__":
    sys.exit(main())
