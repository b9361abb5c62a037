"""Settings of all tests: what is found must not depend on how busy the machine is."""

from __future__ import annotations

import gc

from hypothesis import settings

settings.register_profile("cutcomp", deadline=None, derandomize=True)
settings.load_profile("cutcomp")


def pytest_collection_finish() -> None:
    """The libraries and the tests stay: the garbage collector need not look through them again and again."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000)
