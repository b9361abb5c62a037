"""What the status line takes from outside the program: the time of day and the free memory."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import strftime
from typing import Final

MEMORY: Final = Path("/proc/meminfo")
HEAD: Final = 256
"""Bytes of it that hold its first lines, the one asked for among them: it is read while keys are typed."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """`clock` gives the text of the clock, `free` kilobytes of free memory; tests put fixed ones here."""

    clock: Callable[[], str]
    free: Callable[[], int]

    def now(self) -> Surroundings:
        """They as they are at this moment, whenever they are asked: what is painted twice for a key has them once."""
        clock, free = self.clock(), self.free()
        return Surroundings(lambda: clock, lambda: free)


def real() -> Surroundings:
    """This machine's."""
    return Surroundings(time_of_day, free_memory)


def time_of_day() -> str:
    """Hours and minutes: seconds would write to an idle terminal."""
    return strftime("%H:%M")


def free_memory() -> int:
    """Kilobytes the kernel says are available; 0 where it does not say."""
    try:
        with MEMORY.open("rb", buffering=0) as told:
            text = told.read(HEAD)
    except OSError:
        return 0
    number = text.partition(b"MemAvailable:")[2].partition(b"kB")[0].strip()
    return int(number) if number.isdigit() else 0
