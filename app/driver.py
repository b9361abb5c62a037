"""The terminal's side of Textual: which terminals the screens can have, and any byte that comes from them.

Textual's own driver dies of the first byte that is not UTF-8, and reads for ever from a link that has dropped.
"""

from __future__ import annotations

import os
import select
import signal
import sys
from codecs import getincrementaldecoder
from collections.abc import Mapping
from typing import Final

from textual._xterm_parser import XTermParser
from textual.drivers.linux_driver import LinuxDriver

PATIENCE: Final = 0.1
"""Seconds between two looks whether the program ends."""
LARGEST_READ: Final = 4096
UNFIT: Final = ("dumb", "unknown", "")
"""Values of TERM of what cannot place a cursor."""


class TerminalDriver(LinuxDriver):
    """A driver that replaces what it cannot read, and takes the end of its input for a hangup."""

    def run_input_thread(self) -> None:
        """Read keys until the program ends or the link drops."""
        parser = XTermParser(self._debug)
        decode = getincrementaldecoder("utf-8")(errors="replace").decode
        while not self.exit_event.is_set():
            if select.select([self.fileno], [], [], PATIENCE)[0]:
                data = read(self.fileno)
                if not data:
                    os.kill(os.getpid(), signal.SIGHUP)
                    return
                for message in parser.feed(decode(data)):
                    self.process_message(message)
            for message in parser.tick():
                self.process_message(message)


def read(handle: int) -> bytes:
    """What was typed, nothing at the end of the input or when the link has dropped."""
    try:
        return os.read(handle, LARGEST_READ)
    except OSError:
        return b""


def few_colours(environment: Mapping[str, str]) -> bool:
    """Whether the terminal has sixteen colours and no more; its name and COLORTERM are all there is to go by.

    Not so where no colours are wanted: Textual then shows greys, and would make black of the terminal's own colours.
    """
    if "NO_COLOR" in environment:
        return False
    many = environment.get("COLORTERM", "") in ("truecolor", "24bit")
    return not many and not any(word in environment.get("TERM", "") for word in ("256color", "direct", "kitty"))


def refusal(environment: Mapping[str, str]) -> str:
    """Why there can be no screens here, empty where there can."""
    if not all(stream is not None and stream.isatty() for stream in (sys.__stdin__, sys.__stderr__)):
        return (
            "the screens need a terminal, and here is none. Start it in a terminal window, or see the commands "
            "without a screen: cutcomp --help"
        )
    if environment.get("TERM", "") in UNFIT:
        return (
            f"the terminal says TERM={environment.get('TERM', '')}, which cannot place a cursor. Set TERM to what it "
            "is, such as TERM=xterm or TERM=vt100, and start again."
        )
    return ""


def settle_output() -> bool:
    """Let no character end the program or spread over several cells; says whether the terminal takes UTF-8."""
    stream = sys.__stderr__
    if stream is None or not hasattr(stream, "reconfigure"):
        return True
    stream.reconfigure(errors="replace")
    return stream.encoding.lower().replace("-", "") == "utf8"
