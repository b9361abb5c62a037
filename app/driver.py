"""The remedy for input that is not UTF-8: one byte of a Latin-1 terminal must not end the program.

Textual's driver for terminals decodes strictly and dies of the first wrong byte.  Its module takes the decoder by
name, so this one puts a decoder there that replaces what it cannot read; a test types such a byte into a
pseudo-terminal.
"""

from __future__ import annotations

import sys
from codecs import IncrementalDecoder, getincrementaldecoder
from collections.abc import Callable
from functools import partial
from typing import Final

LENIENT: Final[Callable[[], IncrementalDecoder]] = partial(getincrementaldecoder("utf-8"), errors="replace")
"""Makes a decoder of UTF-8 in pieces that puts a replacement character for what is none."""


def be_lenient() -> None:
    """Let the terminal's driver read any byte."""
    if sys.platform != "win32":
        from textual.drivers import linux_driver

        linux_driver.__dict__["getincrementaldecoder"] = _lenient


def _lenient(encoding: str) -> Callable[[], IncrementalDecoder]:
    assert encoding == "utf-8"
    return LENIENT
