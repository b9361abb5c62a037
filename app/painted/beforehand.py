"""What must be so before Textual is imported, or anything else that is large."""

from __future__ import annotations

import gc
import os
import sys
from importlib import import_module
from types import ModuleType
from typing import Final

TURN: Final = 0.0005
"""Seconds a thread calculates before another one that waits has its turn; a tenth of what is usual."""
TYPES: Final = "textual.types"
"""Names for those who write with Textual, which it collects from widgets that our screens have none of."""
ELSEWHERE: Final = {"IgnoreReturnCallbackType": "textual._types"}
"""What Textual itself takes from there, and where that comes from."""


def prepare() -> None:
    """Settle what the screens are started with.

    Without the first, F3 of some terminals is lost.  The imports make hundreds of thousands of objects that stay:
    looking through them again and again costs a tenth of the start, so the App switches the collector on again.
    A key waits no longer than `TURN` for what a thread is calculating, each time it has to.
    """
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    gc.disable()
    sys.setswitchinterval(TURN)
    sys.modules.setdefault(TYPES, stand_in())
    import_without_tls()


def import_without_tls() -> None:
    """Import asyncio as where Python has no TLS, which costs a thirtieth of the start: the screens talk to no network.

    Whoever imports `ssl` for himself later gets it; asyncio's own connections stay without TLS, and say so when asked.
    """
    if "asyncio" in sys.modules or "ssl" in sys.modules:
        return
    sys.modules["ssl"] = None  # type: ignore[assignment]  # how the import system is told that there is none
    try:
        import_module("asyncio")
    finally:
        del sys.modules["ssl"]


def stand_in() -> ModuleType:
    """A module in place of `TYPES`: with it come trees, lists and input lines, a tenth of the time to the first screen.

    Whatever is asked of it but the names in `ELSEWHERE` has the real one imported, which then takes its place.
    """
    module = ModuleType(TYPES)

    def asked(name: str) -> object:
        if name.startswith("__"):
            raise AttributeError(name)
        if name not in ELSEWHERE and sys.modules.get(TYPES) is module:
            del sys.modules[TYPES]
        return getattr(import_module(ELSEWHERE.get(name, TYPES)), name)

    vars(module)["__getattr__"] = asked
    return module
