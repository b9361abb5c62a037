"""Machine: how fast it is here and now, which may change in a minute, and what a process works on it."""

from __future__ import annotations

import platform
import time
from contextlib import suppress
from pathlib import Path
from statistics import median
from typing import Final

STEPS: Final = 300_000
ROUNDS: Final = 7


def pace() -> str:
    """The interpreter, and the milliseconds it takes for a loop of additions: its build counts as much as its age."""
    took = 1000 * median(_loop() for _ in range(ROUNDS))
    return f"Python {platform.python_version()}: {STEPS} additions in {took:.1f} ms"


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
