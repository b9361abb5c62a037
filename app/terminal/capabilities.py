"""This module finds a terminal's abilities by its name: colors, by the system's table, and non-ASCII characters."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from typing import Final

COLORED: Final = re.compile(
    r"(?:xterm|screen|tmux|linux|putty|rxvt|vte|konsole|gnome|alacritty|foot|kitty)\b|.*colou?r"
)
"""Names of terminals with colors; for these the start skips the table, which costs some milliseconds."""
BARE: Final = re.compile(r"vt[1-5]\d\d\b.*|.*-(?:m|mono)\b.*")
"""Names of terminals without colors, for use if the table does not know them."""
OLD: Final = re.compile(r"vt[1-5]\d\d\b")
"""Names of terminals older than UTF-8, and of programs that emulate only those."""


def colors(name: str) -> int | None:
    """Return a terminal's number of colors by the system's table; None if the table does not know it.

    The library looks up only one name per process; no second one is needed.
    """
    try:
        import curses
    except ImportError:
        return None
    try:
        curses.setupterm(name, 2 if sys.__stderr__ is None else sys.__stderr__.fileno())
        return max(curses.tigetnum("colors"), 0)
    except (curses.error, OSError, ValueError):
        return None


def monochrome(environment: Mapping[str, str], table: Callable[[str], int | None] = colors) -> bool:
    """True if a terminal has no colors; COLORTERM or a requested color system outweighs its name."""
    asked = environment.get("TEXTUAL_COLOR_SYSTEM", "auto").lower() != "auto"
    name = environment.get("TERM", "")
    bare = BARE.fullmatch(name) is not None
    if asked or environment.get("COLORTERM") or (COLORED.match(name) and not bare):
        return False
    known = table(name)
    return bare if known is None else known < 2


def ascii_only(environment: Mapping[str, str]) -> bool:
    """True if a terminal cannot show UTF-8, whatever the locale says."""
    return OLD.match(environment.get("TERM", "")) is not None
