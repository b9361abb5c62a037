"""Names: what a move of a center path is, in a machinist's words, by its number and by what it looks like."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.geometry.path import Path

Names = Callable[[int, float], str]
"""The name of a move by its row in the judged path and by its number."""


def by_number(_row: int, number: float) -> str:
    """All that a number says: the path of segment k, or of the corner behind it by k + 1/2."""
    return f"The path of segment {int(number)}" if number == int(number) else f"The path at {_corner(number)}"


def move_name(path: Path, row: int, surface: Path) -> str:
    """A move of a compensated path: along a segment, about a corner, or straight across what the tool cannot enter."""
    number = path.numbers[row].item()
    if number != int(number):
        return (
            f"The corner arc after segment {int(number)}"
            if path.turns[row]
            else f"The straight move across {_corner(number)}"
        )
    segment = np.flatnonzero(surface.numbers == number)
    if len(segment) and surface.turns[segment[0]] and not path.turns[row]:
        return f"The straight move across segment {int(number)}"
    return f"The path of segment {int(number)}"


def _corner(number: float) -> str:
    return f"the corner after segment {int(number)}"
