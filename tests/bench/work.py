"""What a process works: whether it runs, and how long its threads have run, waiting left out."""

from __future__ import annotations

import time
from contextlib import suppress
from pathlib import Path


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
