"""What is to be drawn: paths, circles and marks with the role each plays, in millimetres, before any screen.

Later layers win a cell's style, circles win over layers, marks over circles; dots once lit stay lit.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, IntEnum, auto
from itertools import accumulate
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Floats, Path, Turns
from core.geometry.piece import Point
from core.geometry.stretch import Parts
from core.records import dataclass
from core.tolerance import LARGEST
from core.units import Unit

Box = tuple[float, float, float, float]

BEYOND: Final = 10 * LARGEST
"""A coordinate larger than this, or not a number, is neither drawn nor fitted into a view."""
ALIKE: Final = 1e-9
"""Millimetres by which an arc may reach over the points without its being seen: rounding does, where it ends there."""


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
    """One path and its role; where `own` (n,) is given, only those of its pieces are drawn for which it is True."""

    path: Path
    style: Style
    dashed: bool = False
    own: NDArray[np.bool_] | None = None

    @property
    def parts(self) -> list[Path]:
        """The runs of pieces that are drawn."""
        if self.own is None:
            return [self.path] if len(self.path) else []
        return Parts(self.path, self.own).paths


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
        boxes = [_box_of(circle.centre, circle.radius) for circle in self.circles]
        boxes += [_box_of(mark.at, 0.0) for mark in self.marks]
        layers = [layer for layer in self.layers if len(layer.path)]
        with np.errstate(invalid="ignore", over="ignore"):
            boxes += _boxes(gathered(layers)) if layers else []
        kept = [box for box in boxes if _drawn(box)]
        if not kept:
            return None
        left, low, right, high = zip(*kept, strict=True)
        return min(left), min(low), max(right), max(high)


@dataclass(frozen=True, eq=False, slots=True)
class Pieces:
    """The n pieces of several layers one behind the other, in millimetres.

    `points` (m, 2) are those of all paths; piece i runs from row `rows[i]` of them to the next one and belongs to the
    layer `layers[i]`.  `centres` (n, 2) and `turns` (n,) as a path has them.
    """

    points: Floats
    rows: NDArray[np.intp]
    centres: Floats
    turns: Turns
    layers: NDArray[np.intp]

    def only(self, keep: NDArray[np.intp]) -> Pieces:
        """These pieces, by their numbers."""
        # rows of pairs: an array's own `take` takes a fifth of the time of an index
        centres = self.centres.take(keep, axis=0)
        return Pieces(self.points, self.rows[keep], centres, self.turns[keep], self.layers[keep])

    @property
    def starts(self) -> Floats:
        """(n, 2) first point of each piece."""
        return self.points.take(self.rows, axis=0)

    @property
    def ends(self) -> Floats:
        """(n, 2) last point of each piece."""
        return self.points.take(self.rows + 1, axis=0)


def gathered(layers: Sequence[Layer]) -> Pieces:
    """All pieces that are drawn of layers with paths that are not empty, to be asked once and not layer by layer."""
    paths, counts = [layer.path for layer in layers], [len(layer.path.turns) for layer in layers]
    owners = np.repeat(np.arange(len(counts)), counts)
    every = Pieces(
        np.concatenate([path.points for path in paths]),
        np.arange(len(owners)) + owners,
        np.concatenate([path.centres for path in paths]),
        np.concatenate([path.turns for path in paths]),
        owners,
    )
    if all(layer.own is None for layer in layers):
        return every
    drawn = np.ones(len(owners), np.bool_)
    for layer, behind in zip(layers, accumulate(counts), strict=True):
        if layer.own is not None:
            drawn[behind - len(layer.own) : behind] = layer.own
    return every.only(drawn.nonzero()[0])


def _boxes(pieces: Pieces) -> list[Box]:
    """Boxes that span the same as those of all pieces: that of all points, and of the arcs that reach over it.

    Where a coordinate can be no part of a drawing each piece has its own, so that it can be left out.
    """
    x, y = pieces.points[:, 0], pieces.points[:, 1]
    left, low, right, high = box = float(x.min()), float(y.min()), float(x.max()), float(y.max())
    # what is not a number is neither the least nor the largest, but comes out of both
    if not _drawn(box):
        return _each(pieces)
    arcs = pieces.turns.nonzero()[0]
    bent = pieces.only(arcs)
    starts, x, y = bent.starts, bent.centres[:, 0], bent.centres[:, 1]
    reach = ALIKE - np.hypot(starts[:, 0] - x, starts[:, 1] - y)
    over = ((left - x > reach) | (low - y > reach) | (x - right > reach) | (y - high > reach)).nonzero()[0]
    return [box, *_each(bent.only(over))] if len(over) else [box]


def _drawn(box: Box) -> bool:
    """Whether nothing of a box is beyond every drawing, or no number."""
    left, low, right, high = box
    return abs(left) <= BEYOND and abs(low) <= BEYOND and abs(right) <= BEYOND and abs(high) <= BEYOND


def _each(pieces: Pieces) -> list[Box]:
    """The boxes of all pieces, taken from a path of them with a line from each to the next."""
    points = np.empty((2 * len(pieces.rows), 2))
    points[::2], points[1::2] = pieces.starts, pieces.ends
    centres, turns = points[:-1].copy(), np.zeros(len(points) - 1, np.int8)
    centres[::2], turns[::2] = pieces.centres, pieces.turns
    return [(a, b, c, d) for a, b, c, d in Path.of(points, centres, turns).boxes[::2].tolist()]


def _box_of(centre: Point, radius: float) -> Box:
    (x, y) = centre
    return (x - radius, y - radius, x + radius, y + radius)


def joined_scenes(scenes: Sequence[Scene]) -> Scene:
    """Several blocks in one drawing; unit and axes are the first one's."""
    return Scene(
        tuple(layer for scene in scenes for layer in scene.layers),
        tuple(circle for scene in scenes for circle in scene.circles),
        tuple(mark for scene in scenes for mark in scene.marks),
        scenes[0].unit if scenes else None,
        scenes[0].axes if scenes else True,
    )
