"""This module ends the program on a signal, also if the link has dropped or the terminal takes no more output.

All accepted work is on the disk already.  A handler asks the event loop to end and starts a thread that ends the
process in any case: a loop that waits for a stalled terminal runs no timer, no callback and no handler of its own,
but threads go on.
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
GRACE_SECONDS: Final = 2.0
"""Seconds that the program has to end by itself."""
RESET_SEQUENCE: Final = (
    b"\x1b[?2026l\x1b[0m\x1b[?2004l\x1b[?7h\x1b[?1004l\x1b[?1000l\x1b[?1003l\x1b[?1015l\x1b[?1006l\x1b[?1049l\x1b[?25h"
)
"""Turns off everything that was turned on in the terminal, and brings back the previous screen."""


@dataclass(slots=True)
class Safety:
    """Ends the program; `stop` is called in the event loop with the exit status, `status` is None until then.

    `last` is called at the very end, from the main thread or from the watchdog.
    """

    stop: Callable[[int], None]
    last: Callable[[], None]
    status: int | None = None
    modes: list[Any] | None = field(default_factory=lambda: terminal_modes())

    def arm(self) -> None:
        """Make the SIGNALS end the program in order from now on."""
        for number in SIGNALS:
            # not the bound method: asking for the handler formats its repr, with everything that this object holds
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
        sleep(GRACE_SECONDS)
        restore(self.modes)
        self.leave()

    def leave(self) -> None:
        """End now, without waiting for threads or for a stalled terminal."""
        try:
            self.last()
        finally:
            os._exit(self.status or 0)


def terminal_modes() -> list[Any] | None:
    """Return the terminal's settings; None if there is no terminal."""
    try:
        return termios.tcgetattr(sys.__stdin__.fileno()) if sys.__stdin__ is not None else None
    except (termios.error, OSError, ValueError):
        return None


def restore(modes: list[Any] | None) -> None:
    """Restore the terminal's settings and screen, as far as it still takes output; never wait for it."""
    if modes is None or sys.__stdin__ is None:
        return
    with suppress(termios.error, OSError):
        number = sys.__stdin__.fileno()
        termios.tcsetattr(number, termios.TCSANOW, modes)
        # drop queued output: on a stalled terminal it would come before the sequence
        termios.tcflush(number, termios.TCOFLUSH)
        handle = os.open(os.ttyname(number), os.O_WRONLY | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            os.write(handle, RESET_SEQUENCE)
        finally:
            os.close(handle)
