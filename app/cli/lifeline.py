"""This module ends a program that a server has started when that server ends, in whatever way.

The server holds one end of a pipe and never writes.  The system closes that end with the server.  The program waits
for this in a thread from its first line on.
"""

from __future__ import annotations

import os
import signal
from threading import Thread
from time import sleep
from typing import Final

LIFELINE_VARIABLE: Final = "CUTCOMP_LIFELINE"
"""The environment variable with the number of the pipe's end."""
GRACE_SECONDS: Final = 1.0
"""Seconds that a program has to end in order; all accepted work is on the disk already."""


def watch() -> None:
    """Watch the pipe that the environment names, if any."""
    number = os.environ.pop(LIFELINE_VARIABLE, "")
    if number.isdecimal():
        os.set_inheritable(int(number), False)
        Thread(target=_wait, args=(int(number),), name="lifeline", daemon=True).start()


def _wait(handle: int) -> None:
    while os.read(handle, 1):
        pass
    os.kill(os.getpid(), signal.SIGHUP)
    sleep(GRACE_SECONDS)
    os.kill(os.getpid(), signal.SIGKILL)
