"""This module finds what the terminal can show: its character set by the locale, its colors by its name, or nothing.

A program cannot ask a terminal what it takes.  Python turns the C locale into UTF-8 and writes that into its own
environment as LC_CTYPE, so the operator's own locale is read here.  If that does not name UTF-8, characters outside
its set are replaced by ASCII.
"""

from __future__ import annotations

import codecs
import os
import re
import sys
import unicodedata
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final, TextIO

UTF_8: Final = "utf-8"
ASCII: Final = "ascii"
LATIN_1: Final = "iso8859-1"
"""The character set of a locale without one in its name, such as de_DE."""
LOCALE_VARIABLES: Final = ("LC_ALL", "LC_CTYPE", "LANG")
"""The first of these that is not empty names the locale."""
COERCED_LOCALES: Final = ("C.UTF-8", "C.utf8", "UTF-8")
"""What Python may set LC_CTYPE to if it is C or a locale that is not installed (PEP 538)."""
START_ENVIRONMENT: Final = Path("/proc/self/environ")
"""The environment with which the program was started, on Linux."""
LOOKALIKES: Final = str.maketrans("│┃─━├┤▀▄█…→↗↑↖←↙↓↘▲▼▶◀✓✖×•·", '||--||"_#~>>^<<<v>^v><+!x..')
LOOKALIKE_ERRORS: Final = "cutcomp.lookalike"
FIRST_FRAME, LAST_FRAME, LAST_BLOCK = "\u2500", "\u257f", "\u259f"
FIRST_BRAILLE, LAST_BRAILLE = "\u2801", "\u28ff"
CHARACTER_SETS: Final[tuple[str, ...]] = ("braille", "block", "ascii")
"""The character sets that a drawing can be made of."""
UNFIT_TERMS: Final = ("dumb", "unknown", "")
"""Values of TERM for terminals that cannot position the cursor."""
COLORED: Final = re.compile(
    r"(?:xterm|screen|tmux|linux|putty|rxvt|vte|konsole|gnome|alacritty|foot|kitty)\b|.*colou?r"
)
"""Names of terminals with colors; for these the start skips the table, which costs some milliseconds."""
BARE: Final = re.compile(r"vt[1-5]\d\d\b.*|.*-(?:m|mono)\b.*")
"""Names of terminals without colors, for use if the table does not know them."""
OLD: Final = re.compile(r"vt[1-5]\d\d\b")
"""Names of terminals older than UTF-8, and of programs that emulate only those."""


# ---- characters


def started_with() -> Mapping[str, str] | None:
    """Return the environment before Python changed it; None if the system does not show it."""
    try:
        data = START_ENVIRONMENT.read_bytes()
    except OSError:
        return None
    pairs = (os.fsdecode(entry).partition("=") for entry in data.split(b"\0") if entry)
    return {name: value for name, _, value in pairs}


def operators_environment(
    environment: Mapping[str, str], started: Callable[[], Mapping[str, str] | None] = started_with
) -> Mapping[str, str]:
    """Return the environment with the operator's own LC_CTYPE, not the one that Python may have set.

    If the system does not show it, `C.UTF-8` and `C.utf8` count as Python's, unless PYTHONCOERCECLOCALE is 0.
    """
    if environment.get("LC_ALL") or environment.get("LC_CTYPE") not in COERCED_LOCALES:
        return environment
    if (before := started()) is not None:
        return {**environment, "LC_CTYPE": before.get("LC_CTYPE", "")}
    chosen = environment["LC_CTYPE"] == COERCED_LOCALES[-1] or environment.get("PYTHONCOERCECLOCALE") == "0"
    return environment if chosen else {**environment, "LC_CTYPE": ""}


def charset(environment: Mapping[str, str]) -> str:
    """Return the name, as Python knows it, of the character set that the terminal takes."""
    name = next((environment[variable] for variable in LOCALE_VARIABLES if environment.get(variable)), "C")
    if name in ("C", "POSIX"):
        return ASCII
    locale = name.partition("@")[0]
    _, dot, given = locale.rpartition(".")
    # a name without a dot is a language or, on some systems, the character set alone
    wanted = given if dot or _known(given) else LATIN_1
    return _known(wanted) or ASCII


def _known(name: str) -> str:
    try:
        return codecs.lookup(name).name
    except LookupError:
        return ""


def lookalike(text: str) -> str:
    """Return the text with each non-ASCII character replaced by one ASCII character."""
    return "".join(character if character.isascii() else _letter(character) for character in text.translate(LOOKALIKES))


def _letter(character: str) -> str:
    if FIRST_BRAILLE <= character <= LAST_BRAILLE:
        return "*"
    if FIRST_FRAME <= character <= LAST_FRAME:
        return "+"
    if LAST_FRAME < character <= LAST_BLOCK:
        return "#"
    bare = unicodedata.normalize("NFKD", character)[0]
    return bare if bare.isascii() and bare.isprintable() else "?"


def _stand_in(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return lookalike(error.object[error.start : error.end]), error.end


def set_charset(stream: TextIO | None, name: str) -> None:
    """Make a stream write this character set; others become one ASCII character each instead of an error."""
    codecs.register_error(LOOKALIKE_ERRORS, _stand_in)
    if stream is not None and hasattr(stream, "reconfigure"):
        stream.reconfigure(encoding=name, errors=LOOKALIKE_ERRORS)


def ascii_only(environment: Mapping[str, str]) -> bool:
    """True if a terminal cannot show UTF-8, whatever the locale says."""
    return OLD.match(environment.get("TERM", "")) is not None


def characters(environment: Mapping[str, str], wanted: str = "") -> tuple[str, tuple[str, ...]]:
    """Return the character set to write, and the sets that drawings can use, the one to begin with first.

    `wanted` is the operator's choice, which overrides the environment.  The fonts of the Linux console have no
    braille; a VT100 has no UTF-8 at all.
    """
    name = UTF_8 if wanted in CHARACTER_SETS[:-1] else charset(environment)
    if wanted not in CHARACTER_SETS[:-1] and name == UTF_8 and ascii_only(environment):
        name = ASCII
    if name != UTF_8:
        return name, CHARACTER_SETS[-1:]
    console = environment.get("TERM", "").startswith("linux") and wanted != CHARACTER_SETS[0]
    able = CHARACTER_SETS[1:] if console else CHARACTER_SETS
    first = able.index(wanted) if wanted else 0
    return name, (*able[first:], *able[:first])


# ---- colors


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


def few_colors(environment: Mapping[str, str]) -> bool:
    """True if only the terminal's own sixteen colors are used, or none; by default TERM and COLORTERM decide.

    Without colors, the terminal's own text color and background stay; bold, underline and reverse video do the rest.
    """
    asked = environment.get("TEXTUAL_COLOR_SYSTEM", "auto").lower()
    if "NO_COLOR" in environment or asked != "auto":
        return "NO_COLOR" in environment or asked == "standard"
    true_color = environment.get("COLORTERM", "") in ("truecolor", "24bit")
    return not true_color and not any(word in environment.get("TERM", "") for word in ("256color", "direct", "kitty"))


def refusal(environment: Mapping[str, str]) -> str:
    """Return why the screens cannot run here; empty if they can."""
    if not all(stream is not None and stream.isatty() for stream in (sys.__stdin__, sys.__stderr__)):
        return (
            "the screens need a terminal, and here is none. Start it in a terminal window, or see the commands "
            "without a screen: cutcomp --help"
        )
    if environment.get("TERM", "") in UNFIT_TERMS:
        return (
            f"the terminal says TERM={environment.get('TERM', '')}, which cannot place a cursor. Set TERM to what it "
            "is, such as TERM=xterm or TERM=vt100, and start again."
        )
    return ""
