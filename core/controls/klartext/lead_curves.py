"""Lead curves are the path of the tool center along an APPR or DEP, as geometry; `leads` reads the blocks.

LT is a straight line tangent to the contour, LN one square to it, CT an arc tangent to it over an angle, LCT a line
and an arc tangent to each other and to the contour.  All lengths and radii apply to the tool center: an approach
ends at PA', the point square to the contour's first point at one tool radius.  PS is the tool's position, PH the
point where the lead itself begins.  Departures are approaches traveled backwards.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import acos, atan2, cos, hypot, sin, tau
from typing import Final

from core.controls.compensation.elements import SAME_DIRECTION, offset_point, point_along
from core.geometry.construct import rotated
from core.geometry.piece import Point
from core.tolerance import JOINED

MAX_ROUNDING_SHARE: Final = 1e-12
"""Share of the radius by which rounding may put the start of an LCT inside its circle."""


class LeadShape(StrEnum):
    """The shape of an approach or departure."""

    LT = "LT"
    LN = "LN"
    CT = "CT"
    LCT = "LCT"


@dataclass(frozen=True, slots=True)
class Lead:
    """A programmed lead: `length` of LT and LN, signed `radius` and `angle` (radians) of CT, `radius` of LCT."""

    shape: LeadShape
    length: float = 0.0
    radius: float = 0.0
    angle: float = 0.0


@dataclass(frozen=True, slots=True)
class Curve:
    """The lead of the tool center: straight to or from `point` (PH), and between it and the contour a line or an arc.

    With `turn` 0 it is a line; an arc whose `point` is the contour's own point is a full circle.
    """

    point: Point
    center: Point
    turn: int


def approach(lead: Lead, start: Point, end: Point, direction: Point, hand: int) -> Curve | None:
    """Return the approach from PS to PA', where the contour starts in `direction`.

    `hand` is +1 with the tool on the left of the contour, -1 on the right, 0 without compensation: an LCT then has
    its circle on the side PS lies on.  Points in millimeters.  None for an LCT that starts inside its own circle.
    """
    if lead.shape is LeadShape.LT:
        point = point_along(end, direction, -lead.length)
        return Curve(point, point, 0)
    if lead.shape is LeadShape.LN:
        point = offset_point(end, direction, hand * lead.length)
        return Curve(point, point, 0)
    if lead.shape is LeadShape.CT:
        center = offset_point(end, direction, hand * lead.radius)
        turn = hand if lead.radius > 0.0 else -hand
        whole = lead.angle >= tau - SAME_DIRECTION
        return Curve(end if whole else rotated(end, center, -turn * lead.angle), center, turn)
    return _tangent_arc(lead.radius, start, end, direction, hand or _side_of(start, end, direction))


def _tangent_arc(radius: float, start: Point, end: Point, direction: Point, hand: int) -> Curve | None:
    center = offset_point(end, direction, hand * radius)
    dx, dy = start[0] - center[0], start[1] - center[1]
    distance = hypot(dx, dy)
    if distance < radius * (1.0 - MAX_ROUNDING_SHARE):
        return None
    # Seen from the center PH lies ahead of PS by the angle whose cosine is radius / distance.
    angle = atan2(dy, dx) + hand * acos(min(1.0, radius / distance))
    point = (center[0] + radius * cos(angle), center[1] + radius * sin(angle))
    if hypot(point[0] - end[0], point[1] - end[1]) <= JOINED:  # PS lies on the line through PA'
        return Curve(end, end, 0)
    return Curve(point, center, hand)


def _side_of(at: Point, corner: Point, direction: Point) -> int:
    return 1 if direction[0] * (at[1] - corner[1]) - direction[1] * (at[0] - corner[0]) >= 0.0 else -1


def departure(lead: Lead, start: Point, end: Point, direction: Point, hand: int) -> Curve | None:
    """Return the departure from PE', where the contour ends in `direction`, to `end`, which only LCT uses.

    It is the approach from `end` to PE' run backwards: the contour runs the other way with the tool on its other side.
    """
    back = approach(lead, end, start, (-direction[0], -direction[1]), -hand)
    return None if back is None else Curve(back.point, back.center, -back.turn)
