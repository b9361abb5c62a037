"""Killed at random moments, nothing that was accepted is lost: `python -m tests.reports.kill --times 500`.

Into the real program in a pseudo-terminal a contour program or an NC text is typed until a signal strikes, at a moment
drawn at random: while it starts, while it asks, in the middle of a key, a write or a save.  SIGKILL leaves no time,
SIGHUP and SIGTERM two seconds.  What is typed is known edit by edit without the program's screens.  What comes back
must be a state between the last one that the screen had acknowledged and the last key sent, with its undo; the next
start must offer it, restore it, and save it as it is.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from app.documents.journal_file import journal_path
from app.documents.unsaved_work import read
from tests.reports.kill_parts import NC, ContourPart, NcPart, Part, bytes_of_key
from tests.terminal import Terminal, cutcomp, running

LIVES_OF_A_PART: Final = 20
"""After so many kills another part is begun, so that programs of all lengths are typed."""
SIGNALS: Final = (signal.SIGKILL, signal.SIGKILL, signal.SIGKILL, signal.SIGHUP, signal.SIGTERM)
PATIENCE: Final = 120.0
LONGEST_LIFE: Final = 2.0
"""Seconds of typing until the signal strikes."""


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

    def lose(self, part: Part, found: object) -> None:
        """Tell what is missing, and which of the typed states came back instead of the acknowledged one or a later."""
        same = [index for index, state in enumerate(part.states) if part.content(state.work) == found]
        which = f"state {same} came back, {part.acknowledged} of {len(part.states) - 1} was acknowledged by"
        self.lost.append(f"{part.file.name}, kill {self.kills}: {part.missing(found)}\n{which}\n{part.screen}")


def type_until_killed(part: Part, terminal: Terminal, chance: random.Random, tally: Tally) -> None:
    """Type; now and then wait until the screen has caught up, now and then do not.

    A program that does not end is left to the caller.
    """
    begun = time.monotonic()
    while terminal.ended() is None and time.monotonic() - begun < LONGEST_LIFE + PATIENCE:
        for key in part.next_keys(chance):
            tally.moments["keys typed"] += 1
            with suppress(OSError):
                terminal.send(bytes_of_key(key))
            if chance.random() < 0.3:
                terminal.read(quiet=0.001, longest=0.02)
        if chance.random() < 0.6:
            wait_for(part, terminal)
        part.acknowledge(terminal.text)


def wait_for(part: Part, terminal: Terminal) -> None:
    """Until the screen shows the last state, or the program is dead."""
    begun = time.monotonic()
    while not part.states[-1].shown(terminal.text) and time.monotonic() - begun < 1.0:
        if terminal.read(quiet=0.01, longest=0.01).count == 0 and not alive(terminal.pid):
            return


def alive(pid: int) -> bool:
    """Whether a child of ours runs; a dead one that was not waited for does not."""
    return os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None


def came_back(part: Part, tally: Tally) -> bool:
    """Go on from what came back, by the journal or by the saved file; tells whether it must be offered."""
    saved, possible = part.saved_work(), part.possible()
    journal = read(journal_path(part.file))
    if journal is None or part.content(part.work_of(journal)) == saved:
        if possible and not any(part.content(work) == saved for work in possible):
            tally.lose(part, saved)
        part.begin(None)
        return False
    found = part.work_of(journal)
    if possible and found not in possible:
        tally.lose(part, part.content(found))
    part.begin(journal)
    return True


def restored(terminal: Terminal, part: Part, *, offered: bool) -> None:
    """The start of the program: what was left behind is offered and restored."""
    terminal.until("RESTORE" if offered else part.READY, longest=PATIENCE)
    if offered:
        terminal.send(b"r")
        terminal.until("Your work is back", longest=PATIENCE)
    else:
        terminal.read(quiet=0.2)
        assert "RESTORE" not in terminal.text
    for key in part.prepare():
        terminal.send(bytes_of_key(key))


def compared(part: Part, terminal: Terminal, tally: Tally) -> None:
    """Saved by the real program, the file holds what was typed.

    Killed after a save and before its journal says so, it asks: the file is not the one that the journal is about.
    """
    part.saving()
    terminal.send(b"\x13")
    terminal.until("Saved", "CHANGED MEANWHILE", longest=PATIENCE)
    if "CHANGED MEANWHILE" in terminal.text:
        tally.moments["killed between a save and its journal"] += 1
        terminal.send(b"y")
        terminal.until("Saved", longest=PATIENCE)
    tally.moments["saved and compared"] += 1
    if part.saved_work() != part.content(part.states[-1].work):
        tally.lose(part, part.saved_work())


def one_life(part: Part, chance: random.Random, tally: Tally, own: Path) -> None:
    """From a start to the next kill."""
    offered = came_back(part, tally)
    tally.moments["work offered" if offered else "nothing to offer"] += 1
    number = chance.choice(SIGNALS)
    early = chance.random() < 0.2
    folders = {"XDG_STATE_HOME": str(own), "XDG_CONFIG_HOME": str(own)}
    with running(cutcomp(str(part.file)), environment=folders) as terminal:
        if early:
            time.sleep(chance.uniform(0.0, 1.5))
            tally.moments["killed while it starts or asks"] += 1
            if chance.random() < 0.5:
                terminal.read(quiet=0.0, longest=0.0)
                terminal.send(b"r")
                time.sleep(chance.uniform(0.0, 0.02))
            os.kill(terminal.pid, number)
        else:
            restored(terminal, part, offered=offered)
            if chance.random() < 0.3:
                compared(part, terminal, tally)
            struck(part, terminal, chance, tally, number)
            tally.moments["killed while it is typed into"] += 1
            tally.moments["edits typed"] += len(part.states) - 1
            tally.moments["edits ahead of the screen"] += len(part.states) - 1 - part.acknowledged
        wait_for_end(terminal, tally, number)
    tally.kills += 1
    tally.moments[f"{number.name} {type(part).__name__}"] += 1


def wait_for_end(terminal: Terminal, tally: Tally, number: signal.Signals) -> None:
    """Until it is dead: what it still writes counts."""
    begun = time.monotonic()
    while alive_still(terminal):
        terminal.read(quiet=0.02, longest=0.05)
        if time.monotonic() - begun > PATIENCE:
            tally.lost.append(f"{number.name} has not ended the program")
            return


def alive_still(terminal: Terminal) -> bool:
    """Whether it runs; also after it was waited for."""
    with suppress(ChildProcessError):
        return alive(terminal.pid)
    return False


def struck(part: Part, terminal: Terminal, chance: random.Random, tally: Tally, number: signal.Signals) -> None:
    """Typed into until a timer kills, whatever is going on at that moment."""
    timer = threading.Timer(chance.uniform(0.0, LONGEST_LIFE), os.kill, (terminal.pid, number))
    timer.start()
    try:
        type_until_killed(part, terminal, chance, tally)
    finally:
        timer.join()
    terminal.read(quiet=0.05, longest=0.5)
    part.acknowledge(terminal.text)


def new_part(folder: Path, seed: int, number: int) -> Part:
    """Contour programs and NC texts by turns."""
    if number // LIVES_OF_A_PART % 2 == 0:
        return ContourPart(folder / f"part-{seed}-{number}.toml")
    part = NcPart(folder / f"part-{seed}-{number}.nc")
    part.file.write_bytes(NC)
    return part


def lives(times: int, seed: int) -> Tally:
    """So many kills, one after the other."""
    chance, tally = random.Random(seed), Tally()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        part = new_part(folder, seed, 0)
        for number in range(times):
            if number and number % LIVES_OF_A_PART == 0:
                came_back(part, tally)
                part = new_part(folder, seed, number)
            one_life(part, chance, tally, folder)
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


if __name__ == "__main__":
    sys.exit(main())
