"""What must be so before Textual is imported, or anything else that is large."""

from __future__ import annotations

import gc
import os
import sys
from typing import Final

TURN: Final = 0.0005
"""Seconds a thread calculates before another one that waits has its turn; a tenth of what is usual."""


def prepare() -> None:
    """Settle what the screens are started with.

    Without the first, F3 of some terminals is lost.  The imports make hundreds of thousands of objects that stay:
    looking through them again and again costs a tenth of the start, so the App switches the collector on again.
    A key waits no longer than `TURN` for what a thread is calculating, each time it has to.
    """
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    gc.disable()
    sys.setswitchinterval(TURN)
