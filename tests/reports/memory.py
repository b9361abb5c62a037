"""Memory of the real program under random keys: `python -m tests.reports.memory --minutes 60`.

The program runs in a pseudo-terminal of its own, with its threads, its driver and its journal.  A monkey sits in the
process, since only there is known which screen stands; it tells its next key through a pipe, and the key comes back as
bytes of a terminal.  Told is the memory of the process every minute.
"""

from __future__ import annotations

import argparse
import os
import select
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from random import Random
from statistics import median
from typing import Any, Final

from tests.reports.terminals import sent
from tests.terminal import Terminal, running

ROOT: Final = Path(__file__).parents[2]
MEGABYTE: Final = 1024
"""Kilobytes."""
BOUND: Final = 90.0
"""Megabytes that the program may take."""
SLACK: Final = 3.0
"""Megabytes by which the last quarter may lie above the second: noise, not growth."""
LARGEST: Final = 40
"""Segments of a program; a larger one is given up for a new one, so that a key stays fast."""
LIFE: Final = 400
"""Keys until another program is opened."""
SILENCE: Final = 1.0
"""Seconds after which the next key comes although the last one has done nothing."""
LAST_WORDS: Final = 20_000
"""Bytes of the program's output that are kept."""
EXTRA: Final = {
    "insert": b"\x1b[2~",
    "ctrl+home": b"\x1b[1;5H",
    "ctrl+end": b"\x1b[1;5F",
    "f9": b"\x1b[20~",
    "f12": b"\x1b[24~",
    "shift+f1": b"\x1b[1;2P",
}
"""Bytes of keys that the terminals' table does not know."""


def inside(pipe: int, seed: int, part: str) -> int:
    """The program with a monkey in it; for the child process."""
    from app.cli import screens as main
    from app.painted import application

    application.CutcompApp = _told(application.CutcompApp, Told(pipe, Random(seed), Path.cwd()))  # type: ignore[misc]  # in a process of its own
    return main.run(Path(part))


@dataclass
class Told:
    """Where the next keys go: names, one a line; `keys` counts them."""

    pipe: int
    chance: Random
    cage: Path
    waiting: list[str] = field(default_factory=list)
    keys: int = 0

    def tell(self, app: Any, monkey: Any) -> None:
        """The next key for this screen."""
        if not self.waiting:
            self.waiting = monkey.keys(app.desk)
        key = monkey.caged(app.desk, self.waiting.pop(0))
        monkey.coverage.look(app.desk)
        monkey.coverage.press(app.desk, key)
        self.keys += 1
        screens, softkeys = monkey.coverage.screens, len(monkey.coverage.pressed)
        os.write(self.pipe, f"{key.encode().hex()} {len(screens)} {softkeys}\n".encode())


def begun(desk: Any, told: Told) -> Any:
    """The desk at the beginning of another life: a program, the start screen, or an NC program under proof."""
    from app.painted.filing import fresh
    from app.painted.opened import opened
    from app.painted.screens.proof import ProofPage
    from app.painted.screens.proof_files import read
    from app.painted.starting import begun as at_start

    part = told.chance.choice(("pocket", "plate-mm"))
    shutil.copy(ROOT / "app" / "examples" / f"{part}.toml", told.cage)
    desk = fresh(desk, opened(told.cage / f"{part}.toml"))
    match told.chance.choice(("program", "program", "start", "proof")):
        case "start":
            return at_start(desk)
        case "proof":
            file = told.cage / "part.nc"
            return replace(desk, pages=(*desk.pages[:1], ProofPage.of(read(file), file, alone=True)))
        case _:
            return desk


def _told(kind: type[Any], told: Told) -> type[Any]:
    """The App that tells its next key behind each; who leaves, or has a large program, begins another life."""
    from tests.reports.monkey_keys import Monkey

    monkey = Monkey(told.chance, told.cage)

    class Haunted(kind):  # type: ignore[misc]  # the App, whichever it is
        desk: Any
        CSS_PATH = str(ROOT / "app" / "app.tcss")

        def on_ready(self) -> None:
            super().on_ready()
            self.last = 0.0
            self.set_interval(SILENCE, self.nudge)

        def nudge(self) -> None:
            if time.monotonic() - self.last > SILENCE:
                self.next()

        def next(self) -> None:
            self.last = time.monotonic()
            told.tell(self, monkey)

        def key(self, key: str, character: str | None) -> None:
            super().key(key, character)
            self.next()

        def _advance(self) -> None:
            program = self.desk.session.program
            large = sum(len(block.segments) for block in program.blocks) > LARGEST or len(program.blocks) > 5
            if self.desk.exit or large or told.keys % LIFE == LIFE - 1:
                self.desk = self.keep(replace(begun(self.desk, told), exit=False))
            super()._advance()

    return Haunted


@dataclass
class Watch:
    """What was seen from outside: keys pressed, screens and softkeys reached, memory by the minute in megabytes.

    `last` is the end of what the program wrote: what it says when it dies.
    """

    rate: float
    keys: int = 0
    screens: int = 0
    softkeys: int = 0
    last: bytes = b""
    memory: list[float] = field(default_factory=list)
    dead: bool = False

    def status(self, terminal: Terminal) -> int | None:
        """The exit status once the program has ended; one whose terminal is closed is waited for."""
        while (status := terminal.ended()) is None and self.dead:
            time.sleep(0.1)
        return status


def resident(pid: int, name: str = "VmRSS") -> float:
    """Megabytes of a process; `VmHWM` for the most it ever had."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name)) / MEGABYTE


def haunted(terminal: Terminal, pipe: int, watch: Watch, until: float) -> None:
    """Keys as the child tells them, no faster than wanted, until a moment or until it is dead."""
    rest, free = b"", 0.0
    while time.monotonic() < until:
        ready, _, _ = select.select([terminal.fd, pipe], [], [], 0.5)
        if terminal.fd in ready and not _drained(terminal.fd, watch):
            watch.dead = True
            return
        if pipe in ready:
            *lines, rest = (rest + os.read(pipe, 65536)).split(b"\n")
            for line in lines:
                name, screens, softkeys = line.decode().split()
                watch.screens, watch.softkeys, watch.keys = int(screens), int(softkeys), watch.keys + 1
                key = bytes.fromhex(name).decode()
                time.sleep(max(0.0, min(free - time.monotonic(), SILENCE / 2)))
                free = time.monotonic() + 1 / watch.rate
                terminal.send(EXTRA.get(key) or sent(key))


def _drained(handle: int, watch: Watch) -> bool:
    """What came is thrown away but for its end; no when nothing comes any more."""
    try:
        came = os.read(handle, 65536)
    except OSError:
        return False
    watch.last = (watch.last + came)[-LAST_WORDS:]
    return bool(came)


def report(minutes: float, seed: int, rate: float) -> Iterator[str]:
    """A line a minute, then what it comes to."""
    with tempfile.TemporaryDirectory() as name:
        cage = Path(name).resolve()
        shutil.copy(ROOT / "app" / "examples" / "pocket.toml", cage)
        (cage / "part.nc").write_text("G20 G17 G90\nT1 M6\nG41 D1 G1 X0 Y0 F10\nX2\nY1\nX0\nY0\nG40 X-1\nM30\n")
        (cage / "tool.tbl").write_text("T1 P1 D0.5 ;end mill\nT2 P2 D0.25\n")
        ours, theirs = os.pipe()
        os.set_inheritable(theirs, True)
        code = f"import sys; from tests.reports.memory import inside; sys.exit(inside({theirs}, {seed}, 'pocket.toml'))"
        own = {"PYTHONPATH": str(ROOT), "HOME": name, "XDG_STATE_HOME": f"{name}/own", "XDG_CONFIG_HOME": f"{name}/own"}
        with running([sys.executable, "-c", code], cwd=name, environment=own) as terminal:
            yield from watched(terminal, ours, minutes, Watch(rate))
        os.close(ours)
        os.close(theirs)


def watched(terminal: Terminal, pipe: int, minutes: float, watch: Watch) -> Iterator[str]:
    """The child's minutes."""
    terminal.until("MILL CONTOUR", longest=30.0)
    yield f"at start    {resident(terminal.pid):6.1f} MB"
    begun = time.monotonic()
    while len(watch.memory) < minutes:
        haunted(terminal, pipe, watch, min(begun + 60 * (len(watch.memory) + 1), begun + 60 * minutes))
        if (status := watch.status(terminal)) is not None:
            said = watch.last.decode(errors="replace")
            yield f"WRONG: the program has ended with {status} after {watch.keys} keys\n{said}"
            yield "failures 1"
            return
        watch.memory.append(resident(terminal.pid))
        yield (
            f"minute {len(watch.memory):4} {watch.memory[-1]:6.1f} MB {watch.keys:8} keys, "
            f"{watch.screens} screens, {watch.softkeys} softkeys"
        )
    yield from summed_up(watch, resident(terminal.pid, "VmHWM"))


def summed_up(watch: Watch, most: float) -> Iterator[str]:
    """The last quarter beside the second one, and the bound."""
    quarter = max(len(watch.memory) // 4, 1)
    early, late = median(watch.memory[quarter : 2 * quarter] or watch.memory), median(watch.memory[-quarter:])
    yield f"second quarter {early:.1f} MB, last quarter {late:.1f} MB, most ever {most:.1f} MB"
    wrong = [f"more than {BOUND:.0f} MB"] * (late > BOUND) + ["memory grows"] * (late > early + SLACK)
    yield from (f"WRONG: {one}" for one in wrong)
    yield f"failures {len(wrong)}"


def main() -> int:
    """Print the report; exit status 1 when the program takes too much, or ever more."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rate", type=float, default=20.0, help="keys a second")
    options = parser.parse_args()
    last = ""
    for last in report(options.minutes, options.seed, options.rate):
        print(last, flush=True)
    return 0 if last == "failures 0" else 1


if __name__ == "__main__":
    sys.exit(main())
