"""How fast Python is here and now: printed beside times, since the same machine may be half as fast a minute later."""

from __future__ import annotations

import platform
import time
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
