"""The end that nobody asked for: signals, a dropped link, a terminal that takes nothing any more.

What was accepted is on the disk already.  A handler asks the event loop to end and starts a thread that ends the
process in any case: a loop that waits for a terminal which takes nothing runs no timer, no callback and no handler
of its own, threads go on.
"""

from __future__ import annotations

import asyncio
import os
import signal
import sys
import termios
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from threading import Thread
from time import sleep
from typing import Any, Final

SIGNALS: Final = (signal.SIGHUP, signal.SIGTERM, signal.SIGINT, signal.SIGQUIT)
GRACE: Final = 2.0
"""Seconds the program has to end by itself."""
LEAVING: Final = (
    b"\x1b[?2026l\x1b[0m\x1b[?2004l\x1b[?7h\x1b[?1004l\x1b[?1000l\x1b[?1003l\x1b[?1015l\x1b[?1006l\x1b[?1049l\x1b[?25h"
)
"""Everything that was switched on in the terminal, off again; the screen from before comes back."""


@dataclass(slots=True)
class Safety:
    """Ends the program; `stop` is called in the event loop with the exit status, `status` is None until then.

    `last` is done in the very end, whoever ends the program.
    """

    stop: Callable[[int], None]
    last: Callable[[], None]
    status: int | None = None
    modes: list[Any] | None = field(default_factory=lambda: terminal_modes())

    def arm(self) -> None:
        """From now on signals end the program in order."""
        for number in SIGNALS:
            # not the method itself: whoever asks for the handler has it spelled out, with all that hangs on it
            signal.signal(number, lambda number, _: self._signalled(number))

    def _signalled(self, number: int) -> None:
        if self.status is not None:
            return
        self.status = 128 + number
        Thread(target=self._watch, name="watchdog", daemon=True).start()
        with suppress(RuntimeError):
            # without a running loop, only the watchdog ends the program
            asyncio.get_running_loop().call_soon_threadsafe(self.stop, self.status)

    def _watch(self) -> None:
        sleep(GRACE)
        restore(self.modes)
        self.leave()

    def leave(self) -> None:
        """End now, without waiting for threads or for a terminal that takes nothing."""
        try:
            self.last()
        finally:
            os._exit(self.status or 0)


def terminal_modes() -> list[Any] | None:
    """How the terminal is set, None where there is none."""
    try:
        return termios.tcgetattr(sys.__stdin__.fileno()) if sys.__stdin__ is not None else None
    except (termios.error, OSError, ValueError):
        return None


def restore(modes: list[Any] | None) -> None:
    """Put the terminal back as it was, as far as it still takes anything; never waits for it."""
    if modes is None or sys.__stdin__ is None:
        return
    with suppress(termios.error, OSError):
        number = sys.__stdin__.fileno()
        termios.tcsetattr(number, termios.TCSANOW, modes)
        # what is queued for a terminal that takes nothing would stand before the sequence
        termios.tcflush(number, termios.TCOFLUSH)
        handle = os.open(os.ttyname(number), os.O_WRONLY | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            os.write(handle, LEAVING)
        finally:
            os.close(handle)
