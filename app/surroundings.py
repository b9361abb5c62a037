"""What the status line takes from outside the program: the time of day and the free memory."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from core.records import dataclass


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
    return datetime.now().astimezone().strftime("%H:%M")


def free_memory() -> int:
    """Kilobytes the kernel says are available; 0 where it does not say."""
    try:
        text = Path("/proc/meminfo").read_text()
    except OSError:
        return 0
    line = next((line for line in text.splitlines() if line.startswith("MemAvailable:")), "")
    number = line.removeprefix("MemAvailable:").removesuffix("kB").strip()
    return int(number) if number.isdecimal() else 0
