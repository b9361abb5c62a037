"""Comments of NC text: plain ASCII in round brackets that nothing written in them can close or bring to life."""

from __future__ import annotations

import re
from collections.abc import Iterator
from textwrap import wrap
from typing import Final

WIDTH: Final = 72
"""Characters inside the brackets; longer text goes on in a further comment."""
ACTIVE: Final = re.compile(r"\s*[A-Za-z_]+\s*,")
"""A comment that begins like this is an order to some controls: (MSG, ...), (LOGOPEN, ...), (PY, ...)."""
READABLE: Final = str.maketrans({"(": "[", ")": "]", "%": " PERCENT", "\u00b0": " DEG", "\u2013": "-", "\u2212": "-"})


def comments(text: str) -> Iterator[str]:
    """The comment lines that say `text`: one, or several where it is long; none for blank text."""
    plain = text.translate(READABLE).encode("ascii", "replace").decode("ascii")
    spaced = "".join(character if character.isprintable() else " " for character in plain)
    for line in wrap(spaced, WIDTH):
        yield f"(* {line})" if ACTIVE.match(line) else f"({line})"
