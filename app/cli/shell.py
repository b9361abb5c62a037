"""What all commands share: their names, their exit statuses, and how they speak.  Costs the screens nothing."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import Final, TypeVar

Asked = TypeVar("Asked")

CLEAN: Final = 0
FINDINGS: Final = 1
UNUSABLE: Final = 2

HELP: Final = {
    "path": "the center path of every block",
    "lookahead": "what becomes of the path at every look-ahead value",
    "post": "write the NC file",
    "plot": "draw the program as SVG or DXF",
}
SHOP_HELP: Final = {
    "sheet": "the setup sheet, as text or as a page with the drawing",
    "tools": "list the tool table, or import a LinuxCNC tool table",
    "serve": "the screens in a browser on this machine",
}

SWITCH_SECONDS: Final = 0.0005
"""How long a thread calculates before another one that waits has its turn; a tenth of what is usual."""


@dataclass(frozen=True, slots=True)
class TerminalOptions:
    """What the operator asks of the terminal: characters to draw with (empty: what it has), light paper, the mouse."""

    characters: str = ""
    light: bool = False
    mouse: bool = False


class Unusable(Exception):
    """Arguments or a file that cannot be used; the text says why and what to do."""


def reported(command: Callable[[Asked], int]) -> Callable[[Asked], int]:
    """The command, which says what cannot be used and returns the status of that."""

    @wraps(command)
    def run(asked: Asked) -> int:
        try:
            return command(asked)
        except Unusable as error:
            say(str(error))
            return UNUSABLE

    return run


NOTHING_ASKED: Final = TerminalOptions()


def prepare() -> None:
    """Settle what must be so before Textual is imported, or anything else that is large.

    Without the first, F3 of some terminals is lost.  The imports make hundreds of thousands of objects that stay:
    looking through them again and again costs a tenth of the start, so the App switches the collector on again.
    A key waits no longer than `SWITCH_SECONDS` for what a thread is calculating, each time it has to.
    """
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    gc.disable()
    sys.setswitchinterval(SWITCH_SECONDS)


def say(text: str) -> None:
    """A message for the person at the keyboard."""
    plain = "".join(one if one.isprintable() or one == "\n" else "?" for one in text)
    print(f"cutcomp: {plain}", file=sys.stderr)
