"""How fast the machine is here and now: printed beside times, since it may be half as fast a minute later."""

from __future__ import annotations

import platform
import tempfile
import time
from pathlib import Path as File
from statistics import median
from typing import Final

from tests.bench import peers
from tests.bench.families import gear

STEPS: Final = 300_000
ROUNDS: Final = 7
SEGMENTS: Final = 100_000
RS274_SECONDS: Final = 0.7
"""What rs274 took for the gear of so many segments where the bars in milliseconds were set."""


def pace() -> str:
    """The interpreter, and the milliseconds it takes for a loop of additions: its build counts as much as its age."""
    took = 1000 * median(_loop() for _ in range(ROUNDS))
    return f"Python {platform.python_version()}: {STEPS} additions in {took:.1f} ms"


def slowness() -> float | None:
    """How many times slower rs274, which is no Python, is here and now than where the bars were set; None without it.

    A time in milliseconds divided by it is what that machine would take.
    """
    with tempfile.TemporaryDirectory() as folder:
        process = peers.interpreter(gear(SEGMENTS), File(folder))
        if process is None:
            return None
        begun = time.perf_counter()
        process()
        return (time.perf_counter() - begun) / RS274_SECONDS


def witnessed(slower: float | None) -> str:
    """The pace, with that of rs274 where it is known."""
    beside = "" if slower is None else f"; rs274 takes {slower:.1f} times what it took where the bars were set"
    return f"{pace()}{beside}"


def _loop() -> float:
    begun, total = time.perf_counter(), 0
    for step in range(STEPS):
        total += step
    return time.perf_counter() - begun
