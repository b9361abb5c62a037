"""Settings of all tests: what is found must not depend on how busy the machine is."""

from __future__ import annotations

import gc
import os
import sys

from hypothesis import settings

# sources are compiled once, not by each worker and by each of the many programs that the tests start
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

settings.register_profile("cutcomp", deadline=None, derandomize=True)
settings.load_profile("cutcomp")


def pytest_collection_finish() -> None:
    """The libraries and the tests stay: the garbage collector need not look through them again and again."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000)
