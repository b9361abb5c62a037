"""Steps: what the reader hands to the compensation, one programmed element with its part in the contour."""

from __future__ import annotations

from enum import Enum, auto
from typing import NamedTuple

from core.controls.compensation.corners import Element
from core.controls.klartext.leads import Lead
from core.controls.moves import Plane


class Role(Enum):
    """What a step is to the compensation."""

    FREE = auto()
    """Moved as programmed, without compensation."""
    ENTRY = auto()
    """The straight move in which RL or RR takes effect."""
    CONTOUR = auto()
    """An element of the compensated contour."""
    DEPTH = auto()
    """Only the tool axis moves."""
    EXIT = auto()
    """The straight move in which R0 takes effect."""
    APPROACH = auto()
    DEPARTURE = auto()


class Corner(Enum):
    """How the corner at the end of an element is made."""

    PLAIN = auto()
    M97 = auto()
    """An outside corner by the meeting of the two offsets instead of an arc."""
    M98 = auto()
    """An inside corner run out to the ends of both elements."""


class Speed(Enum):
    """What the programmed feed means on arcs."""

    CENTER = auto()
    """M111: the feed of the tool's center."""
    EDGE = auto()
    """M109: the feed of the cutting edge, inside and outside."""
    INSIDE = auto()
    """M110: the feed of the cutting edge inside, of the center outside."""


class Step(NamedTuple):
    """One step: `offset` is the tool radius, positive with the tool on the left, 0 without compensation.

    `element` is what is programmed, from the programmed point before it.  Approaches and departures have a `lead`;
    their `hand` is the side of the word RL (+1), RR (-1) or R0 (0), turned over by a negative radius; `before` is
    rapid and feed of the block before.  A departure's element is straight, `leaving` the contour's last direction.
    `ahead` is the LA of M120, 0 without.
    """

    role: Role
    element: Element
    offset: float
    plane: Plane
    corner: Corner = Corner.PLAIN
    speed: Speed = Speed.CENTER
    lead: Lead | None = None
    hand: int = 0
    before: tuple[bool, float] = (False, 0.0)
    ahead: int = 0
