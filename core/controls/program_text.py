"""Program text is split from bytes of any encoding into lines, and pieces of it are made fit to quote."""

from __future__ import annotations

import re
from typing import Final

from core.units import printable

BYTE_ORDER_MARKS: Final = (b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")
"""The marks of UTF-8 and UTF-16 that may begin a file."""

_BREAK: Final = re.compile(r"\r\n|\n|\r")
_BRACES: Final = str.maketrans("{}", "??")


def lines_of(text: bytes) -> list[str]:
    """Return the lines of a program without their ends (CR, LF or both); the last line may lack one.

    It reads UTF-8 and UTF-16 (by its mark), and anything else byte for byte.  Never raises.
    """
    lines = _BREAK.split(_decoded(text))
    if lines and not lines[-1]:
        lines.pop()
    return lines


def _decoded(text: bytes) -> str:
    if text.startswith(BYTE_ORDER_MARKS[1:]):
        return text.decode("utf-16", errors="replace")
    try:
        return text.decode("utf-8-sig")
    except UnicodeDecodeError:
        return text.decode("latin-1")


def capitals(text: str) -> str:
    """Return a line in capitals, character for character: only plain letters change, as others may become several."""
    if text.isascii():
        return text.upper()
    return "".join(sign.upper() if sign.isascii() else sign for sign in text)


def quoted(text: str) -> str:
    """Return a piece of a program as a message may quote it: short, and without anything that a terminal would obey."""
    return printable(text.translate(_BRACES))
