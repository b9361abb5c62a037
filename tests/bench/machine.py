"""Machine: how fast it is here and now, which may change in a minute, and what a process works on it."""

from __future__ import annotations

import platform
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Final

from tests.bench import peers
from tests.bench.families import gear

STEPS: Final = 300_000
ROUNDS: Final = 7
SEGMENTS: Final = 100_000
RS274_SECONDS: Final = 0.7
"""What rs274 took for the gear of so many segments where the bars in milliseconds were set."""
EMPTY_SECONDS: Final = 0.137
"""What a minimal Textual app took there from its start to its first paint."""


def pace() -> str:
    """The interpreter, and the milliseconds it takes for a loop of additions: its build counts as much as its age."""
    took = 1000 * median(_loop() for _ in range(ROUNDS))
    return f"Python {platform.python_version()}: {STEPS} additions in {took:.1f} ms"


@dataclass(frozen=True)
class Slowness:
    """How many times slower two programs that are not ours are here and now than where the bars were set.

    One is no Python and may be missing; the other, a minimal Textual app, starts and paints, so it is nearly nothing
    else.  A time divided by the smaller of the two is what that machine would take at most.
    """

    rs274: float | None
    empty: float

    @property
    def least(self) -> float:
        """The smaller of the two: what makes our own times look worse."""
        return self.empty if self.rs274 is None else min(self.rs274, self.empty)

    def told(self) -> str:
        """One line: the pace of Python, and both."""
        one = "" if self.rs274 is None else f"rs274 takes {self.rs274:.1f} times, "
        return f"{pace()}; {one}a minimal Textual app {self.empty:.1f} times what it took where the bars were set"


def rs274_slowness() -> float | None:
    """How many times slower rs274 is here and now than where the bars were set; None without it."""
    with tempfile.TemporaryDirectory() as folder:
        process = peers.interpreter(gear(SEGMENTS), Path(folder))
        if process is None:
            return None
        begun = time.perf_counter()
        process()
        return (time.perf_counter() - begun) / RS274_SECONDS


def _loop() -> float:
    begun, total = time.perf_counter(), 0
    for step in range(STEPS):
        total += step
    return time.perf_counter() - begun


def at_work(pid: int) -> bool:
    """Whether a thread of a process runs, could run or waits for the disk, by /proc."""
    states = set()
    for thread in Path(f"/proc/{pid}/task").iterdir():
        with suppress(FileNotFoundError, ProcessLookupError):
            # the state stands behind the name, which may hold anything
            states.add((thread / "stat").read_text().rpartition(")")[2].split()[0])
    return not states.isdisjoint("RD")


def worked(pid: int) -> float:
    """Seconds that all threads of a process have run, also those that have ended: a busy machine does not change it.

    It is the process's own clock, which Linux names by the complement of the process's number and a 2 for the
    scheduler's clock, and which any process may read.
    """
    return time.clock_gettime((~pid << 3) | 2)
