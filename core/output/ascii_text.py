"""Shop text in ASCII: what becomes of umlauts, accents and signs in a file that takes no other characters."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final
from unicodedata import combining, normalize

DIAMETER: Final = re.compile("\u2300 *|[\u00d8\u00f8\u2205] *(?=[-.\\d\u00bc-\u00be])")
"""A diameter sign, or the letter that is typed in its place before a number, and the blanks after it."""

REPLACEMENTS: Final[Mapping[str, str]] = {
    "ä": "ae",
    "ö": "oe",
    "ü": "ue",
    "ß": "ss",
    "\u1e9e": "SS",
    "æ": "ae",
    "œ": "oe",
    "ø": "o",
    "ł": "l",
    "đ": "d",
    "ð": "d",
    "þ": "th",
    "\u0131": "i",
    "\u00b0": " DEG",
    "\u00ba": " DEG",
    "\u00b1": "+-",
    "\u00d7": "x",
    "\u00b7": ".",
    **dict.fromkeys("\u00b5\u03bc", "u"),
    "\u20ac": "EUR",
    "\u2044": "/",
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2212", "-"),
    **dict.fromkeys("\u2018\u2019\u201a\u2032", "'"),
    **dict.fromkeys("\u201c\u201d\u201e\u2033\u00ab\u00bb", '"'),
}
"""What stands for a character in shop text; a capital letter is looked up as its small one."""


def in_ascii(text: str) -> str:
    """Return the text in ASCII: ä is ae, other accents are dropped, ° is DEG, ⌀ is DIA; what remains is ?.

    Some signs become the plain ones that they are a variant of: whoever writes a comment replaces what would end it
    after this, not before.
    """
    composed = DIAMETER.sub("DIA ", normalize("NFC", text))
    return "".join(
        sign if sign.isascii() else _plain(sign, composed[max(at - 1, 0) : at], composed[at + 1 : at + 2])
        for at, sign in enumerate(composed)
    )


def _plain(sign: str, before: str, after: str) -> str:
    """Return what stands for a character, in capitals if it is one and stands next to one."""
    replacement = REPLACEMENTS.get(sign) or REPLACEMENTS.get(sign.lower())
    if replacement is None:
        bare = (part for part in normalize("NFKD", sign) if not combining(part))
        # 1½ is 1 1/2, not 11/2
        blank = " " if before.isdecimal() and sign.isnumeric() and not sign.isdecimal() else ""
        return blank + "".join(part if part.isascii() else REPLACEMENTS.get(part, "?") for part in bare)
    if not sign.isalpha():
        return replacement
    in_capitals = any(neighbor.isupper() for neighbor in (before, after))
    if sign.isupper():
        return replacement.upper() if in_capitals else replacement.capitalize()
    return replacement.upper() if sign == "ß" and in_capitals else replacement
