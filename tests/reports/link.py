"""The program over a link that is slow, is cut, or leads through others: `python -m tests.reports.link`.

A relay between two pseudo-terminals delays every byte, lets no more through than a line of so many baud, and can tear
keys apart.  Told is
how many bytes each key costs and when the finished screen stands, compared cell by cell with what must stand there;
then the same screen after a resize, after the program was stopped and continued, and in a tmux that was left and
entered again.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from app.documents.files import save
from tests.bench.keys import gear
from tests.reports.matrix import Lost, Seat, Tally
from tests.reports.recorded import Picture, Step, recorded
from tests.reports.relay import LOCAL, Line, Relayed, relayed
from tests.reports.terminals import Colors, Kind, sent
from tests.terminal import cutcomp, running

ROOT: Final = Path(__file__).parents[2]
SIZE: Final = (80, 24)
KIND: Final = Kind("xterm-256color", Colors.MANY, "UTF-8")
QUIET: Final = 0.6
"""Seconds without a byte after which a screen counts as finished on a slow line."""
LINES: Final = {
    "here": LOCAL,
    "300 ms": Line(delay=0.15),
    "9600 baud": Line(baud=9600),
    "9600 baud, 300 ms": Line(delay=0.15, baud=9600),
    "300 ms, each typed byte up to 300 ms later": Line(delay=0.15, jitter=0.3),
}
KEYS: Final = {
    "a digit in a field": ("tab", "1", "2", ".", "5", "backspace"),
    "Tab to the next field": ("tab",) * 6,
    "a segment on": ("pagedown",) * 4,
    "another screen": ("f6", "f8", "f5", "f8"),
}


@dataclass(frozen=True)
class Cost:
    """What one key cost: bytes, and seconds until the last of them had arrived."""

    count: int
    seconds: float


@dataclass
class Work:
    """What is done on a program, and the pictures recorded for each way of doing it."""

    program: Path
    recordings: dict[tuple[Step, ...], list[Picture]] = field(default_factory=dict)

    def copied(self) -> Path:
        """The program in a folder of its own: work that is cut off in one run is not offered in the next."""
        folder = Path(tempfile.mkdtemp(dir=self.program.parent))
        return Path(shutil.copy(self.program, folder))

    def pictures(self, steps: Sequence[Step]) -> Iterator[Picture]:
        """What must stand at the start and after every step."""
        if tuple(steps) not in self.recordings:
            self.recordings[tuple(steps)] = recorded([str(self.copied())], steps, SIZE)
        return iter(self.recordings[tuple(steps)])


def timed(seat: Seat, key: str) -> Cost:
    """A key pressed, the line listened to until nothing comes any more, the screen compared."""
    before = len(seat.terminal.seen)
    begun = time.perf_counter()
    seat.terminal.send(sent(key))
    answer = seat.terminal.read(quiet=QUIET, longest=60.0)
    took = answer.last if answer.count else time.perf_counter() - begun
    seat.compare(key)
    return Cost(len(seat.terminal.seen) - before, took)


@contextmanager
def begun(line: Line, work: Work, steps: Sequence[Step], tally: Tally) -> Iterator[tuple[Seat, Cost]]:
    """The program at the end of a line, and what its first finished screen cost."""
    pictures = work.pictures(steps)
    environment = {**KIND.environment, "PYTHONPATH": str(ROOT)}
    with running(cutcomp(str(work.copied())), environment=environment) as inner, relayed(inner, line) as terminal:
        seat = Seat(KIND, terminal, pictures, SIZE, (), tally)
        start = time.perf_counter()
        terminal.until("MILL CONTOUR", longest=60.0)
        terminal.read(quiet=QUIET + 0.5, longest=60.0)
        seat.compare("the start")
        yield seat, Cost(len(terminal.seen), time.perf_counter() - start - QUIET - 0.5)


def over(line: Line, work: Work, tally: Tally) -> Iterator[str]:
    """The table's lines for one line."""
    with begun(line, work, [key for keys in KEYS.values() for key in keys], tally) as (seat, first):
        yield row("first screen", [first])
        for name, keys in KEYS.items():
            yield row(name, [timed(seat, key) for key in keys])


def row(name: str, costs: list[Cost]) -> str:
    """Bytes and milliseconds, the median and the worst."""
    counts, times = [cost.count for cost in costs], [1000 * cost.seconds for cost in costs]
    return (
        f"  {name:<24}{statistics.median(counts):8.0f} bytes, most {max(counts):6}"
        f"{statistics.median(times):9.0f} ms, most {max(times):7.0f}"
    )


def idle(work: Work, seconds: float, tally: Tally) -> int:
    """Bytes that come while nobody presses a key; but for the clock, whose minute is waited for."""
    with begun(LOCAL, work, (), tally) as (seat, _):
        while time.time() % 60 > 59 - seconds:
            time.sleep(0.1)
        seat.terminal.read(quiet=1.0)
        before = len(seat.terminal.seen)
        last = time.monotonic() + seconds
        while time.monotonic() < last:
            seat.terminal.read(quiet=0.2, longest=0.2)
        return len(seat.terminal.seen) - before


def resized(work: Work, tally: Tally) -> None:
    """Smaller, larger and back, while keys come."""
    steps = [step for size in ((132, 43), (60, 20), (200, 60), (20, 5), SIZE) for step in (size, "pagedown")]
    with begun(LOCAL, work, steps, tally) as (seat, _):
        for step in steps:
            seat.step(step)


def stopped(work: Work, tally: Tally) -> None:
    """Stopped as by a shell's job control; what others write meanwhile is gone after it goes on."""
    pictures = work.pictures(("tab", "tab", "tab"))
    with running(cutcomp(str(work.copied())), environment={**KIND.environment, "PYTHONPATH": str(ROOT)}) as terminal:
        seat = Seat(KIND, terminal, pictures, SIZE, (), tally)
        seat.compare("the start")
        seat.step("tab")
        os.kill(terminal.pid, signal.SIGTSTP)
        os.waitpid(terminal.pid, os.WUNTRACED)
        terminal.read(quiet=0.2)
        if b"\x1b[?1049l" not in terminal.seen:
            seat.wrong("the shell's screen does not come back when the program is stopped")
        # the emulator has one screen only, as some terminals do: what was written stays until it is painted over
        terminal.stream.feed(b"\x1b[0m\x1b[2J\x1b[H$ ls\r\npart.nc  part.toml\r\n$ fg\r\n")
        os.kill(terminal.pid, signal.SIGCONT)
        seat.again("going on")
        seat.step("tab")
        # a stop that the program is not told of
        os.kill(terminal.pid, signal.SIGSTOP)
        os.waitpid(terminal.pid, os.WUNTRACED)
        terminal.stream.feed(b"\x1b[0m\x1b[2J\x1b[H$ ls\r\n$ fg\r\n")
        os.kill(terminal.pid, signal.SIGCONT)
        seat.again("going on after SIGSTOP")
        seat.step("tab")


def reattached(work: Work, tally: Tally) -> None:
    """In a tmux that is left in the middle of an edit and entered again from a terminal of another size."""
    with tempfile.TemporaryDirectory() as folder:
        tmux = ["tmux", "-S", f"{folder}/socket", "-f", "/dev/null"]
        start = [*tmux, "set", "-g", "status", "off", ";", "new", *cutcomp(str(work.copied()))]
        environment = {"PYTHONPATH": str(ROOT)}
        pictures = work.pictures(("tab", "4", (132, 43), "enter"))
        try:
            with running(start, environment=environment) as terminal:
                seat = Seat(KIND, terminal, pictures, SIZE, (), tally)
                seat.compare("the start in tmux")
                for key in ("tab", "4"):
                    seat.step(key)
                terminal.send(b"\x02d")
                terminal.until("detached")
            with running([*tmux, "attach"], columns=132, rows=43, environment=environment) as terminal:
                seat.terminal, seat.size = terminal, (132, 43)
                seat.compare("entering again")
                seat.step("enter")
        finally:
            os.spawnvp(os.P_WAIT, "tmux", [*tmux, "kill-server"])


def written_over(work: Work, tally: Tally) -> None:
    """Somebody else has written on the terminal: Ctrl+L, or a signal of a resize that was none."""
    with begun(LOCAL, work, (), tally) as (seat, _):
        program_of = seat.terminal.inner if isinstance(seat.terminal, Relayed) else seat.terminal
        for ask in (lambda: seat.terminal.send(b"\x0c"), lambda: os.kill(program_of.pid, signal.SIGWINCH)):
            seat.terminal.stream.feed(b"\x1b[5;10Hthe machine goes down at noon")
            ask()
            seat.again("it was written over")


RECOVERIES: Final = {
    "after a resize": resized,
    "after others wrote": written_over,
    "after SIGTSTP, SIGCONT": stopped,
    "after a reattached tmux": reattached,
}


def right_again(name: str, work: Work, whole: Tally) -> str:
    """One line: whether the screen is right again."""
    if name.endswith("tmux") and shutil.which("tmux") is None:
        return f"{name:<26} no tmux here"
    tally = Tally()
    with suppress(Lost):
        RECOVERIES[name](work, tally)
    whole.add(tally)
    return f"{name:<26} {tally.screens} screens compared, wrong {len(tally.wrong)}"


def report(segments: int, idleness: float) -> Iterator[str]:
    """The whole table."""
    whole = Tally()
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "gear.toml"
        save(gear(segments), program)
        work = Work(program)
        yield f"{segments} segments, {SIZE[0]}x{SIZE[1]}, 256 colors"
        with suppress(Lost):
            yield f"idle                       {idle(work, idleness, whole)} bytes in {idleness:.0f} s"
        for name, line in LINES.items():
            yield name
            with suppress(Lost):
                yield from over(line, work, whole)
        yield from (right_again(name, work, whole) for name in RECOVERIES)
    yield from (f"WRONG: {text}" for text in whole.wrong)
    yield f"failures {len(whole.wrong)}"


def main() -> int:
    """Print the table; exit status 1 when a screen was wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--segments", type=int, default=200)
    parser.add_argument("--idle", type=float, default=20.0, help="seconds without a key, up to 50")
    options = parser.parse_args()
    last = ""
    for last in report(options.segments, options.idle):
        print(last, flush=True)
    return 0 if last == "failures 0" else 1


if __name__ == "__main__":
    sys.exit(main())
