"""Rounds for NC text: coordinates as whole numbers of the last posted digit, and arcs that survive the rounding.

A machine travels what is written, not what was meant.  Rounding may swap the order of a short arc's ends around its
center, or make them one point; a control reads either as a full circle.  Every arc is therefore measured again as
written.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, cos, hypot, pi, tau
from typing import Final

from core.geometry.piece import Arc, Point
from core.tolerance import CLOSED
from core.units import Unit, from_mm

NC_DECIMALS: Final = {Unit.IN: 6, Unit.MM: 5}
FEED_DECIMALS: Final = 3
EXTRA_CENTER_DECIMALS: Final = 1
"""Additional decimals of I and J, which keep the two radii of an arc equal."""
MAX_END_ERROR: Final = 4.0
"""Largest distance, in last digits and along the arc, of an arc's written end from where it should be."""
MIN_RADIUS: Final = 160.0
"""Smallest radius of an arc, in last digits; LinuxCNC refuses a smaller one as zero, so chords replace it."""
MIN_ANGLE: Final = 1e-5
"""Smallest angle of an arc, in radians: controls take a much smaller one for zero, and the arc for a full circle."""
MAX_CHORD_HEIGHT: Final = 0.5
"""A chord that deviates from its arc by no more than this, in last digits, is as good as the arc."""

Steps = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Grid:
    """The last digit of a unit's coordinates."""

    unit: Unit

    @property
    def decimals(self) -> int:
        """Decimals of X, Y and Z; I and J have `EXTRA_CENTER_DECIMALS` more."""
        return NC_DECIMALS[self.unit]

    def fine(self, value: float) -> float:
        """Return millimeters in last digits, not rounded."""
        return from_mm(value, self.unit) * 10.0**self.decimals

    def steps(self, value: float) -> int:
        """Return millimeters in whole last digits."""
        return round(self.fine(value))

    def point(self, point: Point) -> Steps:
        """Return a point in whole last digits."""
        return self.steps(point[0]), self.steps(point[1])

    def text(self, steps: int, further: int = 0) -> str:
        """Return a whole number of last digits as a decimal number: at least one decimal, none needless, no -0."""
        decimals = self.decimals + further
        digits = f"{abs(steps):0{decimals + 1}d}"
        decimal = digits[-decimals:].rstrip("0") or "0"
        return f"{'-' if steps < 0 else ''}{digits[:-decimals]}.{decimal}"


@dataclass(frozen=True, slots=True)
class ArcPart:
    """A part of an arc: it ends at `end` after the fraction `share` of the arc, 0 to 1.

    `center` is counted from the start as written, in last digits of I and J; None for a chord.
    """

    end: Point
    share: float
    center: Steps | None = None


def arc_parts(arc: Arc, grid: Grid, first: float = 0.0, last: float = 1.0) -> Iterator[ArcPart]:
    """Yield the arc from one share to another in parts that rounding does not change, in order: mostly one arc."""
    start, end = ({0.0: arc.start, 1.0: arc.end}.get(share) or arc.point_at(share) for share in (first, last))
    sweep, radius = arc.sweep * (last - first), grid.fine(arc.radius)
    (cx, cy), (x, y) = arc.center, grid.point(start)
    center_scale = 10**EXTRA_CENTER_DECIMALS
    i, j = round((grid.fine(cx) - x) * center_scale), round((grid.fine(cy) - y) * center_scale)
    height = radius * (1.0 - cos(sweep / 2) if abs(sweep) <= pi else 2.0)
    if radius >= MIN_RADIUS and _survives(start, end, (i, j), sweep, radius, grid):
        yield ArcPart(end, last, (i, j))
    elif height <= MAX_CHORD_HEIGHT:
        yield ArcPart(end, last)
    else:
        middle = (first + last) / 2
        yield from arc_parts(arc, grid, first, middle)
        yield from arc_parts(arc, grid, middle, last)


def _survives(start: Point, end: Point, center: Steps, sweep: float, radius: float, grid: Grid) -> bool:
    """True if the arc as written turns as far as meant, and ends at its start only if it is the full circle.

    Controls with fewer digits take an end within `CLOSED` of the start for the start.
    """
    first, last = grid.point(start), grid.point(end)
    if start == end:
        return abs(sweep) == tau
    if first == last or max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= CLOSED:
        return False
    i, j = center[0] / 10**EXTRA_CENTER_DECIMALS, center[1] / 10**EXTRA_CENTER_DECIMALS
    away = (last[0] - first[0] - i, last[1] - first[1] - j)
    turn = 1 if sweep > 0.0 else -1
    turned = turn * (atan2(away[1], away[0]) - atan2(-j, -i)) % tau
    if not MIN_ANGLE <= turned <= tau - MIN_ANGLE:
        return False
    return abs(turned - abs(sweep)) * radius <= MAX_END_ERROR and abs(hypot(*away) - hypot(i, j)) <= MAX_END_ERROR


def feed_text(feed: float, grid: Grid) -> str:
    """Return a feed in program units per minute, without needless zeros."""
    integer, _, decimal = f"{from_mm(feed, grid.unit):.{FEED_DECIMALS}f}".partition(".")
    return f"{integer}.{decimal.rstrip('0') or '0'}"
