"""What a terminal can do by its name: colors as the system's table of terminals has it, characters beyond ASCII."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from typing import Final

COLORED: Final = re.compile(
    r"(?:xterm|screen|tmux|linux|putty|rxvt|vte|konsole|gnome|alacritty|foot|kitty)\b|.*colou?r"
)
"""Names that need no look into the table, which costs the start some milliseconds."""
BARE: Final = re.compile(r"vt[1-5]\d\d\b.*|.*-(?:m|mono)\b.*")
"""Names of terminals without colors, where the system has no table."""
OLD: Final = re.compile(r"vt[1-5]\d\d\b")
"""Names of terminals that were made before there was UTF-8, and of programs that are no more than they."""


def colors(name: str) -> int | None:
    """How many colors the system's table says that a terminal has; None where it does not know the terminal.

    The library looks up one name in a process; another one is not asked for.
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
    """Whether a terminal has no colors; COLORTERM or a system of colors that is asked for say more than its name."""
    asked = environment.get("TEXTUAL_COLOR_SYSTEM", "auto").lower() != "auto"
    name = environment.get("TERM", "")
    bare = BARE.fullmatch(name) is not None
    if asked or environment.get("COLORTERM") or (COLORED.match(name) and not bare):
        return False
    known = table(name)
    return bare if known is None else known < 2


def ascii_only(environment: Mapping[str, str]) -> bool:
    """Whether a terminal has no characters of UTF-8 whatever the locale says."""
    return OLD.match(environment.get("TERM", "")) is not None
