"""Where a contour turns straight back at a line, which few parts do that a cutter goes around."""

from __future__ import annotations

from math import cos, radians
from typing import Final

import numpy as np

from core.finding import Finding, Severity
from core.geometry.path import Path, onward, planes

STRAIGHT_BACK: Final = cos(radians(1.0))
"""Cosine of the angle between two segments below which they lie on each other: an end typed to the last digit of a
drawing misses the tangent of a small arc by less."""


def turning_back(surface: Path, *, closed: bool) -> tuple[Finding, ...]:
    """A segment that leaves the end of the one before in the direction it came from, one of the two a line: mostly an
    arc of the wrong DIRECTION between two lines that it should be tangent to.

    Two arcs do so where scallops meet, and are left alone.
    """
    points, centers, turns = planes(surface.points), planes(surface.centers), surface.turns
    # a line has its own start for a center: from there to its end it runs as it is
    leave, arcs = points[1:] - centers, turns.nonzero()[0]
    into, quarter = leave.copy(), 1j * turns[arcs]
    leave[arcs] *= quarter
    into[arcs] = quarter * (points[arcs] - centers[arcs])
    turned = leave.conj() * onward(into)
    rows = (turned.real < -STRAIGHT_BACK * np.abs(turned)).nonzero()[0].tolist()
    joints = [(row, (row + 1) % len(turns)) for row in rows if closed or row + 1 < len(turns)]
    return tuple(_turned(surface, row, behind) for row, behind in joints if not (turns[row] and turns[behind]))


def _turned(surface: Path, row: int, behind: int) -> Finding:
    before, number = f"{surface.numbers[row]:g}", float(surface.numbers[behind])
    check = f"DIRECTION of segment {before}" if surface.turns[row] else "its end"
    if surface.turns[behind]:
        check = "its DIRECTION and its end"
    text = f"It begins straight back along segment {before}, at X {{x}} Y {{y}}. Check {check}."
    return Finding("TURNS_BACK", Severity.WARNING, text, number, at=tuple(surface.points[row + 1].tolist()))
