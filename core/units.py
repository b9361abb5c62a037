"""Between the operator's text and millimetres and radians: the only place that knows inches and degrees."""

from __future__ import annotations

from enum import Enum, StrEnum, auto


class Unit(StrEnum):
    """The unit of every length and feed of a program."""

    IN = "IN"
    MM = "MM"


class Kind(Enum):
    """What sort of value a field takes; it decides how it is read, shown and converted."""

    LENGTH = auto()
    FEED = auto()
    ANGLE = auto()
    COUNT = auto()
    PERCENT = auto()
    CHOICE = auto()
    TEXT = auto()
