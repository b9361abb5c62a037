"""Rounding for NC text: coordinates as whole numbers of the last posted digit, and arcs that survive it.

A machine travels what is written, not what was meant.  Rounding may turn a short arc's ends around its center the
other way, which a control reads as a full circle; or it may make them one point, which it reads as a full circle too.
Every arc is therefore measured again as written.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, cos, hypot, pi, tau
from typing import Final

from core.geometry.piece import Arc, Point
from core.tolerance import CLOSED
from core.units import Kind, Unit, from_mm, show

NC_DECIMALS: Final = {Unit.IN: 6, Unit.MM: 5}
FEED_DECIMALS: Final = 3
FINER: Final = 1
"""Further decimals of I and J, which keep the two radii of an arc equal."""
MAX_END_ERROR: Final = 4.0
"""How far, in last digits, an arc as written may end from where it should, measured along it."""
MIN_RADIUS: Final = 160.0
"""An arc of a smaller radius, in last digits, is written as chords: LinuxCNC refuses it as one without a radius."""
MIN_ANGLE: Final = 1e-5
"""Radians.  Controls take an angle much smaller than this for none at all, and so the arc for a full circle."""
MAX_CHORD_HEIGHT: Final = 0.5
"""A chord that leaves its arc by no more than this, in last digits, is the arc as well as can be written."""

Steps = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Grid:
    """The last digit of a unit's coordinates."""

    unit: Unit

    @property
    def decimals(self) -> int:
        """Decimals of X, Y and Z; I and J have `FINER` more."""
        return NC_DECIMALS[self.unit]

    def fine(self, value: float) -> float:
        """Millimeters in last digits, not rounded."""
        return from_mm(value, self.unit) * 10.0**self.decimals

    def steps(self, value: float) -> int:
        """Millimeters in whole last digits."""
        return round(self.fine(value))

    def point(self, point: Point) -> Steps:
        """A point in whole last digits."""
        return self.steps(point[0]), self.steps(point[1])

    def text(self, steps: int, further: int = 0) -> str:
        """A whole number of last digits as a decimal number: at least one decimal, no more than needed, no -0."""
        decimals = self.decimals + further
        digits = f"{abs(steps):0{decimals + 1}d}"
        decimal = digits[-decimals:].rstrip("0") or "0"
        return f"{'-' if steps < 0 else ''}{digits[:-decimals]}.{decimal}"


@dataclass(frozen=True, slots=True)
class ArcPart:
    """A part of an arc: it ends at `end` after `share` of the arc, 0 to 1.

    `center` is counted from the start as written, in last digits of I and J; None for a chord.
    """

    end: Point
    share: float
    center: Steps | None = None


def arc_parts(arc: Arc, grid: Grid, first: float = 0.0, last: float = 1.0) -> Iterator[ArcPart]:
    """The arc from one share to another in parts that mean the same after rounding, in order: mostly one arc."""
    start, end = (_point_at(arc, share) for share in (first, last))
    sweep, radius = arc.sweep * (last - first), grid.fine(arc.radius)
    (cx, cy), (x, y) = arc.center, grid.point(start)
    i, j = round((grid.fine(cx) - x) * 10**FINER), round((grid.fine(cy) - y) * 10**FINER)
    height = radius * (1.0 - cos(sweep / 2) if abs(sweep) <= pi else 2.0)
    if radius >= MIN_RADIUS and _survives(start, end, (i, j), sweep, radius, grid):
        yield ArcPart(end, last, (i, j))
    elif height <= MAX_CHORD_HEIGHT:
        yield ArcPart(end, last)
    else:
        middle = (first + last) / 2
        yield from arc_parts(arc, grid, first, middle)
        yield from arc_parts(arc, grid, middle, last)


def _point_at(arc: Arc, share: float) -> Point:
    return {0.0: arc.start, 1.0: arc.end}.get(share) or arc.point_at(share)


def _survives(start: Point, end: Point, center: Steps, sweep: float, radius: float, grid: Grid) -> bool:
    """The arc as written turns as far as meant, and ends at its start only if it is the full circle.

    An end within `CLOSED` of the start is one that controls with fewer digits take for it.
    """
    first, last = grid.point(start), grid.point(end)
    if start == end:
        return abs(sweep) == tau
    if first == last or max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= CLOSED:
        return False
    i, j = center[0] / 10**FINER, center[1] / 10**FINER
    away = (last[0] - first[0] - i, last[1] - first[1] - j)
    turn = 1 if sweep > 0.0 else -1
    turned = turn * (atan2(away[1], away[0]) - atan2(-j, -i)) % tau
    if not MIN_ANGLE <= turned <= tau - MIN_ANGLE:
        return False
    return abs(turned - abs(sweep)) * radius <= MAX_END_ERROR and abs(hypot(*away) - hypot(i, j)) <= MAX_END_ERROR


def feed_text(feed: float, grid: Grid) -> str:
    """A feed in program units per minute, without needless zeros."""
    whole, _, decimal = f"{from_mm(feed, grid.unit):.{FEED_DECIMALS}f}".partition(".")
    return f"{whole}.{decimal.rstrip('0') or '0'}"


def length_text(value: float, unit: Unit) -> str:
    """Millimeters in program units, with the decimals of the form."""
    return show(from_mm(value, unit), Kind.LENGTH, unit)
