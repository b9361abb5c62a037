"""This module holds what all commands share: names, exit statuses and messages.  It is cheap to import."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import Final, TypeVar

from core.program.file.read import StoreError

Options = TypeVar("Options")

STATUS_CLEAN: Final = 0
STATUS_FINDINGS: Final = 1
STATUS_UNUSABLE: Final = 2

COMMAND_HELP: Final = {
    "path": "the center path of every block",
    "lookahead": "what every look-ahead value does to the path",
    "post": "write the NC file",
    "plot": "draw the program as SVG or DXF",
    "sheet": "the setup sheet, as text or as a page with the drawing",
    "tools": "list the tool table, or import a LinuxCNC tool table",
    "serve": "the screens in a browser on this machine",
}

SWITCH_SECONDS: Final = 0.0005
"""Seconds that a thread calculates before a waiting one gets its turn; a tenth of Python's default."""


@dataclass(frozen=True, slots=True)
class TerminalOptions:
    """What the operator asks of the terminal: drawing characters (empty: what it has), light paper, the mouse."""

    characters: str = ""
    light: bool = False
    mouse: bool = False


class Unusable(Exception):
    """Arguments or a file that cannot be used; the text says why and what to do."""


def reported(command: Callable[[Options], int]) -> Callable[[Options], int]:
    """Return the command changed to report Unusable and StoreError as a message and return `STATUS_UNUSABLE`."""

    @wraps(command)
    def run(options: Options) -> int:
        try:
            return command(options)
        except (Unusable, StoreError) as error:
            say(str(error))
            return STATUS_UNUSABLE

    return run


NOTHING_ASKED: Final = TerminalOptions()


def prepare() -> None:
    """Set what must be set before Textual or another large package is imported.

    Without the first setting, F3 is lost on some terminals.  The imports make hundreds of thousands of objects that
    stay; collecting garbage among them costs a tenth of the start, so the App turns the collector on again later.
    Each time a key has to wait for a calculating thread, it waits no longer than `SWITCH_SECONDS`.
    """
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    gc.disable()
    sys.setswitchinterval(SWITCH_SECONDS)


def say(text: str) -> None:
    """Print a message for the operator on standard error."""
    plain = "".join(character if character.isprintable() or character == "\n" else "?" for character in text)
    print(f"cutcomp: {plain}", file=sys.stderr)
