"""What all commands share: their names, their exit statuses, and how they speak.  Costs the screens nothing."""

from __future__ import annotations

import sys
from typing import Final

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
    "tools": "list the tool table, or import one of LinuxCNC",
    "serve": "the screens in a browser on this machine",
}


def say(text: str) -> None:
    """A message for the person at the keyboard."""
    plain = "".join(one if one.isprintable() or one == "\n" else "?" for one in text)
    print(f"cutcomp: {plain}", file=sys.stderr)
