"""What is to be drawn: paths, circles and marks with the role each plays, in millimeters, before any screen.

Later layers win a cell's style, circles win over layers, marks over circles; dots once lit stay lit.

The scene of one contour: what lies over what, and which marks it carries.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum, auto
from itertools import accumulate
from math import cos, sin, tau
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Floats, Path, Points, Turns, as_complex, coordinates, swept
from core.geometry.piece import Line, Piece, Point
from core.geometry.stretch import NO_PARTS, Parts
from core.tolerance import LARGEST
from core.units import Unit

Box = tuple[float, float, float, float]

BEYOND: Final = 10 * LARGEST
"""A coordinate larger than this, or not a number, is neither drawn nor fitted into a view."""
ALIKE: Final = 1e-9
"""Millimeters by which an arc may reach over the points without its being seen: rounding does, where it ends there."""

_SIDES: Final = np.array([[tau / 2], [3 * tau / 4], [0.0], [tau / 4]])
"""(4, 1) the directions in which a circle reaches farthest to each side of a box."""


class Style(IntEnum):
    """The role of what is drawn; a screen gives each role its looks."""

    # an enumeration's own is written in Python
    __hash__ = int.__hash__

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

    # as of `Style`
    __hash__ = object.__hash__

    START = auto()
    ARROW = auto()
    PLUNGE = auto()
    GOUGE = auto()
    DELETED = auto()
    CENTER = auto()


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
    """The outline of a disc, such as the cutter: `center` and `radius` in millimeters."""

    center: Point
    radius: float
    style: Style = Style.CUTTER


class Mark(NamedTuple):
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
        return self.gathered.bounds([mark.at for mark in self.marks])

    @property
    def gathered(self) -> Gathered:
        """The scene's pieces, to be asked once and not layer by layer."""
        layers = [layer for layer in (*self.layers, *map(_outline, self.circles)) if len(layer.path.turns)]
        pieces = _gathered(layers) if layers else NO_PIECES
        return Gathered(self, layers, pieces, pieces.arcs)


@dataclass(frozen=True, eq=False, slots=True)
class Arcs:
    """k arcs among some pieces: their `rows` among them, centers, turns and radii (k,), in millimeters.

    `begin` (k,) are the directions in which they start from their centers, `sweeps` (k,) the angles they travel.
    """

    rows: NDArray[np.intp]
    centers: Points
    turns: Turns
    radii: Floats
    begin: Floats
    sweeps: Floats

    def boxes(self, keep: NDArray[np.bool_], box: Box) -> list[Box]:
        """Of some arcs with their ends in a box that box, as far out as each arc reaches on every side it passes."""
        x, y, radii = self.centers.real[keep], self.centers.imag[keep], self.radii[keep]
        passed = np.mod((_SIDES - self.begin[keep]) * self.turns[keep], tau) < self.sweeps[keep]
        sides = np.where(passed, (x - radii, y - radii, x + radii, y + radii), np.array(box)[:, None])
        return [(left, low, right, high) for left, low, right, high in sides.T.tolist()]


@dataclass(frozen=True, eq=False, slots=True)
class Pieces:
    """The n pieces of several layers one behind the other, in millimeters, points as complex numbers.

    `points` (m,) are those of all paths; piece i runs from `points[rows[i]]` to the next one and belongs to the layer
    `layers[i]`.  `centers` (n,) and `turns` (n,) as a path has them.
    """

    points: Points
    rows: NDArray[np.intp]
    centers: Points
    turns: Turns
    layers: NDArray[np.intp]

    def only(self, keep: NDArray[np.intp]) -> Pieces:
        """These pieces, by their numbers."""
        return Pieces(self.points, self.rows[keep], self.centers[keep], self.turns[keep], self.layers[keep])

    @property
    def arcs(self) -> Arcs:
        """The arcs among them."""
        arcs = self.turns.nonzero()[0]
        rows, centers, turns = self.rows[arcs], self.centers[arcs], self.turns[arcs]
        starts, ends = self.points[rows], self.points[rows + 1]
        with np.errstate(invalid="ignore", over="ignore"):
            first, last, same = starts - centers, ends - centers, coordinates(starts) == coordinates(ends)
            sweeps = swept(coordinates(first), coordinates(last), turns, same)
            x, y = first.real, first.imag
            return Arcs(arcs, centers, turns, np.hypot(x, y), np.arctan2(y, x), sweeps)


_NONE: Final = np.empty(0, np.complex128)
_NO_ROWS: Final = np.empty(0, np.intp)
_ROUND: Final = np.ones(1, np.int8)
_FIRST: Final = np.ones(1)
"""Turn and number of the one piece of a circle."""
NO_PIECES: Final = Pieces(_NONE, _NO_ROWS, _NONE, np.empty(0, np.int8), _NO_ROWS)


@dataclass(frozen=True, eq=False, slots=True)
class Gathered:
    """A scene's pieces, gathered once for its bounds and its picture, and the `arcs` among them.

    `layers` are those that have pieces, and behind them the outlines of the circles.
    """

    scene: Scene
    layers: Sequence[Layer]
    pieces: Pieces
    arcs: Arcs

    def bounds(self, spots: Sequence[Point] = (), without: Container[Style] = ()) -> Box | None:
        """Least x, least y, largest x, largest y of all spots, circles and layers, but for layers `without`."""
        boxes = [_box_of(circle.center, circle.radius) for circle in self.scene.circles]
        boxes += [_box_of(spot, 0.0) for spot in spots]
        count = len(self.layers) - len(self.scene.circles)
        spanning = [row < count and layer.style not in without for row, layer in enumerate(self.layers)]
        with np.errstate(invalid="ignore", over="ignore"):
            boxes += self._boxes(spanning) if any(spanning) else []
        kept = [box for box in boxes if _drawn(box)]
        if not kept:
            return None
        left, low, right, high = zip(*kept, strict=True)
        return min(left), min(low), max(right), max(high)

    def _boxes(self, spanning: list[bool]) -> list[Box]:
        """Boxes that span the same as those of all pieces of some layers: of their points, and of arcs that reach over.

        Where a coordinate can be no part of a drawing each piece has its own, so that it can be left out.
        """
        spans, pieces, arcs = np.array(spanning), self.pieces, self.arcs
        points = pieces.points[spans.repeat([len(layer.path.points) for layer in self.layers])]
        x, y = points.real, points.imag
        left, low, right, high = box = float(x.min()), float(y.min()), float(x.max()), float(y.max())
        # what is not a number is neither the least nor the largest, but comes out of both
        if not _drawn(box):
            return _each(pieces.only(spans[pieces.layers].nonzero()[0]))
        x, y, reach = arcs.centers.real, arcs.centers.imag, ALIKE - arcs.radii
        over = (left - x > reach) | (low - y > reach) | (x - right > reach) | (y - high > reach)
        return [box, *arcs.boxes(over & spans[pieces.layers[arcs.rows]], box)] if over.any() else [box]


def _outline(circle: Circle) -> Layer:
    """The whole circle as a layer."""
    (x, y), radius = circle.center, circle.radius
    rim = np.array([[x + radius, y], [x + radius, y]])
    return Layer(Path(rim, np.array([[x, y]]), _ROUND, _FIRST), circle.style)


def _gathered(layers: Sequence[Layer]) -> Pieces:
    """All pieces that are drawn of layers with paths that are not empty."""
    paths, counts = [layer.path for layer in layers], [len(layer.path.turns) for layer in layers]
    owners = np.arange(len(counts)).repeat(counts)
    every = Pieces(
        as_complex(np.concatenate([path.points for path in paths])),
        np.arange(len(owners)) + owners,
        as_complex(np.concatenate([path.centers for path in paths])),
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


def _drawn(box: Box) -> bool:
    """Whether nothing of a box is beyond every drawing, or no number."""
    left, low, right, high = box
    return abs(left) <= BEYOND and abs(low) <= BEYOND and abs(right) <= BEYOND and abs(high) <= BEYOND


def _each(pieces: Pieces) -> list[Box]:
    """The boxes of all pieces, taken from a path of them with a line from each to the next."""
    if not len(pieces.rows):
        return []
    points = np.empty(2 * len(pieces.rows), np.complex128)
    points[::2], points[1::2] = pieces.points[pieces.rows], pieces.points[pieces.rows + 1]
    centers, turns = points[:-1].copy(), np.zeros(len(points) - 1, np.int8)
    centers[::2], turns[::2] = pieces.centers, pieces.turns
    path = Path.of(coordinates(points), coordinates(centers), turns)
    return [(a, b, c, d) for a, b, c, d in path.boxes[::2].tolist()]


def _box_of(center: Point, radius: float) -> Box:
    (x, y) = center
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


def contour_scene(
    surface: Path,
    *,
    unit: Unit | None = None,
    sketches: Parts = NO_PARTS,
    path: Path = EMPTY,
    further: Sequence[Path] = (),
    leads: Sequence[Path] = (),
    rough: Sequence[Path] = (),
    deleted: Parts = NO_PARTS,
    meetings: Sequence[Point] = (),
    gouges: Sequence[Point] = (),
    uncut: Parts = NO_PARTS,
    cutter: tuple[Point, float] | None = None,
    current: Path | None = None,
    start: Point | None = None,
) -> Scene:
    """Everything one contour shows, lengths in millimeters.

    `sketches` are segments not determined yet; `further` the center path's other loops; `leads` the blend moves,
    the blend-in first; `rough` further center paths; `deleted` pieces of the contour that the look-ahead erased and
    `meetings` the points where the erasing pieces meet; `gouges` the spots cut into; `uncut` stretches of the surface;
    `cutter` (center, radius); `current` the segment under the cursor; `start` the contour's START.
    """
    layers = (
        *_parts(sketches, Style.SURFACE, dashed=True),
        *_layers((surface,), Style.SURFACE),
        *_layers(rough, Style.RAPID, dashed=True),
        *_layers(leads, Style.LEAD),
        *_layers((path, *further), Style.PATH),
        *_parts(uncut, Style.UNCUT),
        *_parts(deleted, Style.DELETED, dashed=True),
        *_layers((current or EMPTY,), Style.CURRENT),
    )
    travel = (*_travel(path if len(path) else surface), *_plunge(leads, path))
    marks = (*travel, *_trouble(start, meetings, gouges))
    return Scene(layers, () if cutter is None else (Circle(*cutter),), marks, unit)


def _trouble(start: Point | None, meetings: Sequence[Point], gouges: Sequence[Point]) -> list[Mark]:
    """START, and over it what is wrong."""
    return [
        *_spots(() if start is None else (start,), Style.START, Symbol.START),
        *_spots(meetings, Style.DELETED, Symbol.DELETED),
        *_spots(gouges, Style.GOUGE, Symbol.GOUGE),
    ]


def _layers(paths: Sequence[Path], style: Style, *, dashed: bool = False) -> Iterator[Layer]:
    return (Layer(path, style, dashed) for path in paths if len(path))


def _parts(parts: Parts, style: Style, *, dashed: bool = False) -> Iterator[Layer]:
    if len(parts.path):
        yield Layer(parts.path, style, dashed, parts.own)


def _spots(places: Sequence[Point], style: Style, symbol: Symbol) -> list[Mark]:
    return [Mark(at, style, symbol) for at in places]


def _travel(path: Path) -> Iterator[Mark]:
    """An arrow in the middle of the path's first piece with a length."""
    first = next((piece for piece in path if piece.length > 0.0), None)
    if first is not None:
        at, along = _middle(first)
        yield Mark(at, Style.START, Symbol.ARROW, along)


def _middle(piece: Piece) -> tuple[Point, Point]:
    """The middle of a piece and the direction of travel there."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    if isinstance(piece, Line):
        return ((x0 + x1) / 2, (y0 + y1) / 2), (x1 - x0, y1 - y0)
    (cx, cy), half = piece.center, piece.sweep / 2
    dx, dy = x0 - cx, y0 - cy
    dx, dy = dx * cos(half) - dy * sin(half), dx * sin(half) + dy * cos(half)
    return (cx + dx, cy + dy), (-dy * int(piece.turn), dx * int(piece.turn))


def _plunge(leads: Sequence[Path], path: Path) -> Iterator[Mark]:
    """Where the cutter goes down: the first lead's beginning, or the path's."""
    for one in [*(lead for lead in leads if len(lead)), path][:1]:
        if len(one):
            yield Mark(_point(one.points[0]), Style.LEAD, Symbol.PLUNGE)


def _point(row: Floats) -> Point:
    x, y = row.tolist()
    return (x, y)
