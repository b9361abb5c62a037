"""Lines that are nothing but a move, as nearly all of a long program are: read by one expression."""

from __future__ import annotations

import re
from typing import Final

from core.controls.iso.words import NUMBER, Block
from core.tolerance import LARGEST

_LETTERS: Final = "XYZIJKR"
_MOVE: Final = re.compile(
    "".join((r"(?:G0?([0-3]))?", *(rf"(?:[ \t]*+{letter}({NUMBER}))?" for letter in _LETTERS), r"[ \t]*+"))
)
"""G0 to G3, then positions and an arc's center in this order, each at most once."""


def plain_move(text: str, line: int) -> Block | None:
    """The block of a line of this kind, the same as `read_line` makes of it; None for any other line."""
    found = _MOVE.fullmatch(text)
    if found is None or found.lastindex is None:
        return None
    code, *numbers = found.groups()
    block = Block(line, text)
    words = block.words
    for letter, number in zip(_LETTERS, numbers, strict=True):
        if number is not None:
            words[letter] = value = float(number)
            if not -LARGEST < value < LARGEST:
                return None
    if code is not None:
        block.g.append(10 * int(code))
    block.moves_only = True
    return block
