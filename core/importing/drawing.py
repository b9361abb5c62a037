"""A drawing as read: shapes in its own unit, each with its layer and its line, and what was left out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.piece import Line
from core.units import Unit

MAX_BYTES: Final = 64_000_000
MAX_ENTITIES: Final = 200_000
MAX_INSERT_DEPTH: Final = 8
MAX_SHAPES: Final = 1_000_000


StageProgress = Callable[[str, int, int], None]
"""Called with the stage, the amount of it that is done, and its total."""


def no_stage_progress(_stage: str, _done: int, _whole: int) -> None:
    """Report no progress."""


class DrawingUnit(StrEnum):
    """The unit of a drawing's coordinates."""

    IN = "IN"
    FT = "FT"
    MM = "MM"
    CM = "CM"
    M = "M"

    @property
    def mm(self) -> float:
        """Millimeters per unit."""
        return _MM[self]

    @property
    def program_unit(self) -> Unit:
        """The unit of a program made from such a drawing alone."""
        return Unit.IN if self in (DrawingUnit.IN, DrawingUnit.FT) else Unit.MM


_MM: Final = {
    DrawingUnit.IN: 25.4,
    DrawingUnit.FT: 304.8,
    DrawingUnit.MM: 1.0,
    DrawingUnit.CM: 10.0,
    DrawingUnit.M: 1000.0,
}

UNIT_CODES: Final = {1: DrawingUnit.IN, 2: DrawingUnit.FT, 4: DrawingUnit.MM, 5: DrawingUnit.CM, 6: DrawingUnit.M}
"""$INSUNITS codes of the units that are read; for every other code the operator is asked."""

OTHER_UNITS: Final = {
    3: "miles",
    7: "kilometers",
    8: "microinches",
    9: "mils",
    10: "yards",
    11: "angstroms",
    12: "nanometers",
    13: "microns",
    14: "decimeters",
    15: "decameters",
    16: "hectometers",
    17: "gigameters",
    18: "astronomical units",
    19: "light years",
    20: "parsecs",
    21: "US survey feet",
}
"""Names of the units that are not read, by $INSUNITS."""


@dataclass(frozen=True, slots=True)
class EllipseArc:
    """The points center + cos(t) first + sin(t) second, t from `begin` to `end` (radians, begin < end).

    `first` and `second` are conjugate semi-diameters as complex numbers: any circle or ellipse, mirrored or skewed.
    """

    center: complex
    first: complex
    second: complex
    begin: float
    end: float

    def at(self, parameters: NDArray[np.float64]) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return (n,) points at these parameters and (n,) derivatives there, which are not unit vectors."""
        ahead, across = np.cos(parameters), np.sin(parameters)
        return self.center + ahead * self.first + across * self.second, ahead * self.second - across * self.first


@dataclass(frozen=True, eq=False, slots=True)
class BSpline:
    """A B-spline: (n,) complex control points, (n,) weights, (n + degree + 1,) knots."""

    degree: int
    points: NDArray[np.complex128]
    weights: NDArray[np.float64]
    knots: NDArray[np.float64]


Shape = Line | EllipseArc | BSpline


class LayeredShape(NamedTuple):
    """A shape with its layer and the number of its entity, counted from 1 once for each insertion; 0 if not known."""

    shape: Shape
    layer: str
    entity: int = 0


@dataclass(frozen=True, slots=True)
class NotFlat:
    """An entity outside the XY plane, and the message about it: its layer cannot be taken."""

    layer: str
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class Drawing:
    """The contents of a drawing file.

    `unit` is None if the file names no unit that is read; `other_unit` is then its name.  `skipped` counts entities
    without a contour by kind, `hidden` entities that are frozen, off or invisible by layer.  `notes` are sentences for
    the operator.
    """

    unit: DrawingUnit | None
    shapes: tuple[LayeredShape, ...]
    skipped: Mapping[str, int] = field(default_factory=dict)
    hidden: Mapping[str, int] = field(default_factory=dict)
    not_flat: tuple[NotFlat, ...] = ()
    notes: tuple[str, ...] = ()
    entities: int = 0
    """Entities that gave the shapes; those of a block count once for each insertion."""
    other_unit: str = ""

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers that have shapes, then those with an entity outside the plane, in the order of the file."""
        return tuple(dict.fromkeys([*(drawn.layer for drawn in self.shapes), *(bad.layer for bad in self.not_flat)]))


class DrawingError(Exception):
    """A drawing cannot be taken; the text is the sentence for the operator.

    `code` is NOT_DXF, DXF_DAMAGED, TOO_FAR, NO_GEOMETRY, NOT_FLAT, TOO_MUCH, NO_EZDXF or FAILED.  `readable` counts the
    entities that can be read, if the operator accepts it, of a file that is damaged or has coordinates too far away;
    None if it cannot be taken.
    """

    def __init__(self, code: str, text: str, readable: int | None = None) -> None:
        super().__init__(text)
        self.code = code
        self.text = text
        self.readable = readable

    def __reduce__(self) -> tuple[type[DrawingError], tuple[str, str, int | None]]:
        return DrawingError, (self.code, self.text, self.readable)


def counted(counts: Mapping[str, int]) -> str:
    """Return counts by kind in words, such as `5 TEXT, 22 DIMENSION`."""
    return ", ".join(f"{count} {kind}" for kind, count in counts.items())
