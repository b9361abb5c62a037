"""The side of a contour on which the cutter runs, as traveled."""

from __future__ import annotations

from enum import StrEnum


class Side(StrEnum):
    """LEFT or RIGHT of the contour, seen along the travel."""

    LEFT = "LEFT"
    RIGHT = "RIGHT"

    @property
    def sign(self) -> int:
        """+1 for LEFT: the left normal of a direction (dx, dy) is (-dy, dx)."""
        return 1 if self is Side.LEFT else -1
