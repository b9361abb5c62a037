"""This module finds arc centers from I, J, K or R words, and says what makes an arc impossible."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot, sqrt
from typing import Final

from core.controls.moves import Plane, Point3
from core.geometry.piece import Point
from core.units import Unit

WHOLE_CHORD: Final = 1 - 1e-12
"""Share of the diameter above which a chord counts as a diameter: rounding must not move the center off it."""

MIN_ARC_RADIUS: Final = 0.00127
"""Millimeters (0.00005 in): a smaller radius counts as none; R may be less than half its chord by as much."""


@dataclass(frozen=True, slots=True)
class NoArc:
    """Why an arc is impossible; `{0}` and `{1}` in the text stand for `lengths` in millimeters.

    `fault` is the rule's id: ARC-RADII, ARC-POINT or ARC-PLANE if a control may have an alarm of its own for it.
    """

    text: str
    lengths: tuple[float, ...] = ()
    fault: str = "ARC"


@dataclass(frozen=True, slots=True)
class ArcTolerance:
    """How far an arc's radii at its start and its end may differ on a control.

    The control accepts a difference up to `inch` or `mm`, by the unit in force, and above that up to `share` of the
    larger radius, but at most `most` times the first.  `interpreted`: the maker's manual does not say.
    """

    inch: float = 0.0005
    mm: float = 0.0127
    share: float = 0.001
    most: float = 6.0
    interpreted: bool = True

    def largest_difference(self, radius: float, unit: Unit) -> float:
        """Return the millimeters by which the radii may differ, given the larger one."""
        allowed = self.inch * 25.4 if unit is Unit.IN else self.mm
        return max(allowed, min(allowed * self.most, self.share * radius))

    def refused(self, start: Point, end: Point, center: Point, unit: Unit) -> NoArc | None:
        """Return why an arc about a center is refused, for no radius or two that differ too much; None if it is not."""
        first = hypot(start[0] - center[0], start[1] - center[1])
        last = hypot(end[0] - center[0], end[1] - center[1])
        if min(first, last) < MIN_ARC_RADIUS:
            return NoArc(
                "The arc has no radius: its center is its start or its end; correct the center.", fault="ARC-POINT"
            )
        if abs(first - last) <= self.largest_difference(max(first, last), unit):
            return None
        text = "The arc's radius is {0} at its start and {1} at its end; correct the center or the end point."
        limit = " cutcomp assumes how much they may differ; the manual does not say." if self.interpreted else ""
        return NoArc(text + limit, (first, last), "ARC-RADII")


USUAL_ARC_TOLERANCE: Final = ArcTolerance()
"""The tolerance assumed where a maker's manual does not say.

It is at most 0.003 in, 0.0762 mm: rounding start, end and center to three decimals of an inch makes the radii differ by
at most 0.0028 in.
"""


def center_by_radius(start: Point, end: Point, radius: float, turn: int) -> Point | NoArc:
    """Return the center of an arc with a radius: one of at most half a turn, or of more if the radius is negative."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    chord, size = hypot(dx, dy), abs(radius)
    if chord == 0.0:
        return NoArc("An arc with R cannot end where it starts; write the full circle with its center.")
    if chord / 2 - size > MIN_ARC_RADIUS or size == 0.0:
        return NoArc("The radius {0} does not reach the end point {1} away; correct R.", (size, chord), "ARC-RADII")
    distance = sqrt(max(size * size - chord * chord / 4, 0.0)) * turn * (1 if radius > 0 else -1)
    if chord / 2 / size > WHOLE_CHORD:
        distance = 0.0
    return (start[0] + end[0]) / 2 - distance * dy / chord, (start[1] + end[1]) / 2 + distance * dx / chord


IN_PLANE: Final[Mapping[Plane, tuple[str, str, str]]] = {
    Plane.XY: ("I", "J", "K"),
    Plane.ZX: ("K", "I", "J"),
    Plane.YZ: ("J", "K", "I"),
}
"""The letters of a center's first and second coordinate in a plane, and of the one across it."""


def given_center(
    words: Mapping[str, float], plane: Plane, start: Point, scale: float, origin: Point3 | None
) -> Point | NoArc:  # fmt: skip
    """Return the center from I, J, K, counted from the arc's start or, if given, an origin (in plane coordinates)."""
    first, second, across = IN_PLANE[plane]
    if "R" in words:
        return NoArc("The arc has both R and a center. Keep one of them.")
    if across in words:
        return NoArc(f"{across} does not lie in the arc's plane; write {first} and {second}.", fault="ARC-PLANE")
    if first not in words and second not in words:
        return NoArc(f"The arc has neither center nor radius; write {first} and {second}, or R.")
    if origin is None:
        return start[0] + words.get(first, 0.0) * scale, start[1] + words.get(second, 0.0) * scale
    for letter in (first, second):
        if letter not in words:
            return NoArc(f"{letter} is missing; an absolute center needs {first} and {second}.")
    return origin[0] + words[first] * scale, origin[1] + words[second] * scale
