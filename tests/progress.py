"""How often a calculation looks whether it is still wanted."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from core.progress import Stopped


def looks_until_stopped(work: Callable[[Callable[[float], None]], object], granted: int) -> int:
    """How often `work` has looked when it stops, which it must at the first look after the `granted` ones."""
    looks = 0

    def check(_: float) -> None:
        nonlocal looks
        looks += 1
        if looks > granted:
            raise Stopped

    with pytest.raises(Stopped):
        work(check)
    return looks
