"""What is to be drawn: paths, circles and marks with the role each plays, in millimetres, before any screen.

Later layers win a cell's style, circles win over layers, marks over circles; dots once lit stay lit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum, auto
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Floats, Path
from core.geometry.piece import Point
from core.tolerance import LARGEST
from core.units import Unit

Box = tuple[float, float, float, float]

BEYOND: Final = 10 * LARGEST
"""A coordinate larger than this, or not a number, is neither drawn nor fitted into a view."""


class Style(IntEnum):
    """The role of what is drawn; a screen gives each role its looks."""

    BACKGROUND = 0
    AXIS = 1
    SURFACE = 2
    PATH = 3
    LEAD = 4
    RAPID = 5
    DELETED = 6
    GOUGE = 7
    UNCUT = 8
    CUTTER = 9
    START = 10
    CURRENT = 11
    SCALE = 12
    MESSAGE = 13


class Symbol(Enum):
    """What a mark says; the raster picks a character for it that the mode's terminals have."""

    START = auto()
    ARROW = auto()
    PLUNGE = auto()
    GOUGE = auto()
    DELETED = auto()
    CENTRE = auto()


@dataclass(frozen=True, eq=False, slots=True)
class Layer:
    """One path and its role."""

    path: Path
    style: Style
    dashed: bool = False


@dataclass(frozen=True, slots=True)
class Circle:
    """The outline of a disc, such as the cutter: `centre` and `radius` in millimetres."""

    centre: Point
    radius: float
    style: Style = Style.CUTTER


@dataclass(frozen=True, slots=True)
class Mark:
    """One character at a point; an ARROW points along `direction`."""

    at: Point
    style: Style
    symbol: Symbol
    direction: Point = (1.0, 0.0)


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """Everything to draw.  `unit` is that of the scale bar, None for none; `axes` shows the program's X and Y axis."""

    layers: tuple[Layer, ...] = ()
    circles: tuple[Circle, ...] = ()
    marks: tuple[Mark, ...] = ()
    unit: Unit | None = None
    axes: bool = True

    @property
    def bounds(self) -> Box | None:
        """Least x, least y, largest x, largest y of all that can be drawn; None for an empty scene."""
        paths = [layer.path for layer in self.layers if len(layer.path)]
        chain, own = chained(paths) if paths else (EMPTY, np.empty(0, np.bool_))
        with np.errstate(invalid="ignore", over="ignore"):
            boxes = [chain.boxes[own]]
        boxes += [_box_of(circle.centre, circle.radius) for circle in self.circles]
        boxes += [_box_of(mark.at, 0.0) for mark in self.marks]
        rows = np.concatenate(boxes)
        rows = rows[np.all(np.abs(rows) <= BEYOND, axis=1)]
        if not len(rows):
            return None
        (x0, y0), (x1, y1) = rows[:, :2].min(axis=0).tolist(), rows[:, 2:].max(axis=0).tolist()
        return (x0, y0, x1, y1)


def chained(paths: Sequence[Path]) -> tuple[Path, NDArray[np.bool_]]:
    """All paths as one, and which of its pieces are theirs: a line from each to the next is not.

    What is asked of it once would be asked of a hundred little paths one by one.
    """
    points = np.concatenate([path.points for path in paths])
    own = np.ones(len(points) - 1, np.bool_)
    own[np.cumsum([len(path) + 1 for path in paths])[:-1] - 1] = False
    centres, turns = points[:-1].copy(), np.zeros(len(own), np.int8)
    centres[own] = np.concatenate([path.centres for path in paths])
    turns[own] = np.concatenate([path.turns for path in paths])
    return Path.of(points, centres, turns), own


def _box_of(centre: Point, radius: float) -> Floats:
    (x, y) = centre
    return np.array([[x - radius, y - radius, x + radius, y + radius]])


def joined_scenes(scenes: Sequence[Scene]) -> Scene:
    """Several blocks in one drawing; unit and axes are the first one's."""
    return Scene(
        tuple(layer for scene in scenes for layer in scene.layers),
        tuple(circle for scene in scenes for circle in scene.circles),
        tuple(mark for scene in scenes for mark in scene.marks),
        scenes[0].unit if scenes else None,
        scenes[0].axes if scenes else True,
    )
