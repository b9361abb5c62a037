"""Where a contour turns straight back at a line, which few parts do that a cutter goes around."""

from __future__ import annotations

from math import radians, sin
from typing import Final

import numpy as np

from core.finding import Finding, Severity
from core.geometry.path import Path

STRAIGHT_BACK: Final = sin(radians(1.0))
"""Sine of the angle between two segments below which they lie on each other: an end typed to the last digit of a
drawing misses the tangent of a small arc by less."""


def turning_back(surface: Path, *, closed: bool) -> tuple[Finding, ...]:
    """A segment that leaves the end of the one before in the direction it came from, one of the two a line: mostly an
    arc of the wrong DIRECTION between two lines that it should be tangent to.

    Two arcs do so where scallops meet, and are left alone.
    """
    come, go = surface.end_directions, surface.start_directions
    leave, into = (come, np.roll(go, -1, axis=0)) if closed else (come[:-1], go[1:])
    ahead = np.einsum("nk,nk->n", leave, into)
    across = leave[:, 0] * into[:, 1] - leave[:, 1] * into[:, 0]
    straight = surface.turns == 0
    either = (straight | np.roll(straight, -1))[: len(ahead)]
    back = (either & (ahead < 0.0) & (np.abs(across) < STRAIGHT_BACK)).nonzero()[0].tolist()
    return tuple(_turned(surface, row, (row + 1) % len(surface)) for row in back)


def _turned(surface: Path, row: int, behind: int) -> Finding:
    before, number = f"{surface.numbers[row]:g}", float(surface.numbers[behind])
    check = f"DIRECTION of segment {before}" if surface.turns[row] else "its end"
    if surface.turns[behind]:
        check = "its DIRECTION and its end"
    text = f"It begins straight back along segment {before}, at X {{x}} Y {{y}}. Check {check}."
    return Finding("TURNS_BACK", Severity.WARNING, text, number, at=tuple(surface.points[row + 1].tolist()))
