"""The terminal's set of characters: named by the locale, and what stands for a character that is not in it.

The program itself cannot ask a terminal what it takes.  Python turns the C locale into UTF-8, and writes that into its
own environment as LC_CTYPE; so the name that the operator's locale has is read here.  One that names no UTF-8 gets
letters that every terminal has.
"""

from __future__ import annotations

import codecs
import os
import unicodedata
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final, TextIO

UTF_8: Final = "utf-8"
ASCII: Final = "ascii"
LATIN_1: Final = "iso8859-1"
"""What a locale such as de_DE means by itself."""
VARIABLES: Final = ("LC_ALL", "LC_CTYPE", "LANG")
"""The first of these that is not empty names the locale."""
COERCED: Final = ("C.UTF-8", "C.utf8", "UTF-8")
"""What Python makes of LC_CTYPE where that is C, or a locale that is not installed (its PEP 538)."""
STARTED_WITH: Final = Path("/proc/self/environ")
"""The environment as the program was started with it, on Linux."""
LOOKALIKES: Final = str.maketrans("│┃─━├┤▀▄█…→↗↑↖←↙↓↘▲▼▶◀✓✖×•·", '||--||"_#~>>^<<<v>^v><+!x..')
ERRORS: Final = "cutcomp.lookalike"
FIRST_FRAME, LAST_FRAME, LAST_BLOCK = "\u2500", "\u257f", "\u259f"
FIRST_BRAILLE, LAST_BRAILLE = "\u2801", "\u28ff"


def started_with() -> Mapping[str, str] | None:
    """The environment before Python changed it; None where the system does not tell."""
    try:
        data = STARTED_WITH.read_bytes()
    except OSError:
        return None
    pairs = (os.fsdecode(one).partition("=") for one in data.split(b"\0") if one)
    return {name: value for name, _, value in pairs}


def own(
    environment: Mapping[str, str], started: Callable[[], Mapping[str, str] | None] = started_with
) -> Mapping[str, str]:
    """The environment with the operator's own LC_CTYPE, not with the one that Python has put there.

    Where nobody tells which of them it is, one that only says UTF-8 beside a LANG that does not is Python's.
    """
    if environment.get("LC_ALL") or environment.get("LC_CTYPE") not in COERCED:
        return environment
    if (before := started()) is not None:
        return {**environment, "LC_CTYPE": before.get("LC_CTYPE", "")}
    told = environment["LC_CTYPE"] == COERCED[-1] or environment.get("PYTHONCOERCECLOCALE") == "0"
    return environment if told else {**environment, "LC_CTYPE": ""}


def charset(environment: Mapping[str, str]) -> str:
    """Name of the characters the terminal takes, as Python knows it."""
    name = next((environment[one] for one in VARIABLES if environment.get(one)), "C")
    if name in ("C", "POSIX"):
        return ASCII
    locale = name.partition("@")[0]
    _, dot, given = locale.rpartition(".")
    # a name without a point is a language, or, on some systems, the set alone
    wanted = given if dot or _known(given) else LATIN_1
    return _known(wanted) or ASCII


def _known(name: str) -> str:
    try:
        return codecs.lookup(name).name
    except LookupError:
        return ""


def lookalike(text: str) -> str:
    """ASCII characters for others, one for one."""
    return "".join(one if one.isascii() else _letter(one) for one in text.translate(LOOKALIKES))


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


def settle(stream: TextIO | None, name: str) -> None:
    """Let a stream write this set, and no character end the program or spread over several cells."""
    codecs.register_error(ERRORS, _stand_in)
    if stream is not None and hasattr(stream, "reconfigure"):
        stream.reconfigure(encoding=name, errors=ERRORS)
