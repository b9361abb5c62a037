"""Memory of the real program under random keys: `python -m tests.reports.memory --minutes 60`.

The program runs in a pseudo-terminal of its own, with its threads, its driver and its journal.  A monkey sits in the
process, since only there is known which screen stands; it tells its next key through a pipe, so many a second, and the
key comes back as bytes of a terminal.  Told is the memory of the process every minute; `--rate 0` leaves it at rest.
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
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from statistics import median
from typing import Any, Final

from tests.reports.terminals import sent
from tests.terminal import Terminal, running

ROOT: Final = Path(__file__).parents[2]
MEGABYTE: Final = 1024
"""Kilobytes."""
BOUND: Final = 200.0
"""Megabytes that the program may take; with all its modules and a form on the screen it takes 95."""
SLACK: Final = 3.0
"""Megabytes by which the last quarter may lie above the third: until then caches and the undo fill."""
LARGEST: Final = 40
"""Segments of a program; a larger one is given up for a new one, so that a key stays fast."""
LIFE: Final = 400
"""Keys until another program is opened."""
LAST_WORDS: Final = 20_000
"""Bytes of the program's output that are kept."""
EXTRA: Final = {
    "f12": b"\x1b[24~",
}
"""Bytes of keys that the terminals' table does not know."""


def inside(pipe: int, seed: int, part: str, rate: float) -> int:
    """The program with a monkey in it; for the child process."""
    import app.app as module
    from app.cli import screens
    from app.terminal.signals import terminal_modes

    assert terminal_modes() is not None, "this is for a pseudo-terminal"
    module.CutcompApp = _told(module.CutcompApp, Told(pipe, Random(seed), Path.cwd(), rate))  # type: ignore[misc]
    return screens.run(Path(part))


@dataclass
class Told:
    """Where the next keys go: names, one a line; `keys` counts them, another program comes at `next_life`."""

    pipe: int
    chance: Random
    cage: Path
    rate: float
    waiting: list[str] = field(default_factory=list)
    keys: int = 0
    next_life: int = LIFE

    def tell(self, app: Any, monkey: Any) -> None:
        """The next key for this screen."""
        if not self.waiting:
            self.waiting = monkey.keys(app)
        key = monkey.caged(app, self.waiting.pop(0))
        monkey.coverage.look(app.screen)
        monkey.coverage.press(app.screen, key)
        self.keys += 1
        screens, softkeys = monkey.coverage.screens, len(monkey.coverage.pressed)
        os.write(self.pipe, f"{key.encode().hex()} {len(screens)} {softkeys}\n".encode())


def _told(kind: type[Any], told: Told) -> type[Any]:
    """The App that tells its next key, so many a second; who leaves, or has a large program, begins another life."""
    from tests.reports.monkey_keys import Monkey

    monkey = Monkey(told.chance, told.cage)

    class Haunted(kind):  # type: ignore[misc]  # the App, whichever it is
        CSS_PATH = str(ROOT / "app" / "app.tcss")

        def on_ready(self) -> None:
            super().on_ready()
            if told.rate:
                self.set_interval(1 / told.rate, self.next)

        def next(self) -> None:
            program = self.session.program
            large = sum(len(block.segments) for block in program.blocks) > LARGEST or len(program.blocks) > 5
            # a file that is just being opened is nobody's yet
            if (large or told.keys >= told.next_life) and not any(
                worker.group == "question" and worker.is_running for worker in self.workers
            ):
                another_life(self, told)
            told.tell(self, monkey)

        def exit(self, *arguments: Any, **named: Any) -> None:
            """Leaving is another life; a signal ends the program."""
            if named.get("return_code"):
                super().exit(*arguments, **named)
            else:
                another_life(self, told)

    return Haunted


def another_life(app: Any, told: Told) -> None:
    """Another program, HOME, or an NC program under proof."""
    told.next_life = told.keys + LIFE
    part = told.chance.choice(("pocket.toml", "plate-mm.toml", "part.nc"))
    if part != "part.nc":
        shutil.copy(ROOT / "app" / "examples" / part, told.cage)
    documents = [app.document, *(proof.document for proof in app.proofs)]
    for _ in app.screen_stack[1:]:
        app.pop_screen()
    for document in documents:
        app.service.close(document)
    app.show_opened(app.service.new() if part == "part.nc" else app.service.open(told.cage / part))
    if part == "part.nc":
        app.show_opened(app.service.open(told.cage / part))
    if told.chance.random() < 0.3:
        app.action_home()


@dataclass
class Watch:
    """What was seen from outside: keys pressed, screens and softkeys reached, memory by the minute in megabytes.

    `last` is the end of what the program wrote: what it says when it dies.
    """

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
    rest = b""
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
                terminal.send(EXTRA.get(key) or sent(key.replace("alt+", "f")))


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
        call = f"inside({theirs}, {seed}, 'pocket.toml', {rate})"
        code = f"import sys; from tests.reports.memory import inside; sys.exit({call})"
        own = {"PYTHONPATH": str(ROOT), "HOME": name, "XDG_STATE_HOME": f"{name}/own", "XDG_CONFIG_HOME": f"{name}/own"}
        with running([sys.executable, "-c", code], cwd=name, environment=own) as terminal:
            yield from watched(terminal, ours, minutes, Watch())
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
    """The last quarter beside the third one, and the bound."""
    quarter = max(len(watch.memory) // 4, 1)
    early, late = median(watch.memory[-2 * quarter : -quarter] or watch.memory), median(watch.memory[-quarter:])
    yield f"third quarter {early:.1f} MB, last quarter {late:.1f} MB, most ever {most:.1f} MB"
    wrong = [f"more than {BOUND:.0f} MB"] * (late > BOUND) + ["memory grows"] * (late > early + SLACK)
    yield from (f"WRONG: {one}" for one in wrong)
    yield f"failures {len(wrong)}"


def main() -> int:
    """Print the report; exit status 1 when the program takes too much, or ever more."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rate", type=float, default=20.0, help="keys a second; 0 for a program at rest")
    options = parser.parse_args()
    last = ""
    for last in report(options.minutes, options.seed, options.rate):
        print(last, flush=True)
    return 0 if last == "failures 0" else 1


if __name__ == "__main__":
    sys.exit(main())
