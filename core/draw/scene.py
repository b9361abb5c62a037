"""Scene: everything to draw, as paths, circles and marks in millimeters, each with its role, independent of the screen.

A cell takes the style of the last layer in it; layers win over areas, circles over layers, marks over circles.
Labels appear only where nothing else is; dots once lit stay lit.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum, auto
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from core.geometry.path import EMPTY, Floats, Path, point_of_row
from core.geometry.path_parts import NO_PARTS, PathParts
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.tolerance import LARGEST_COORDINATE
from core.units import Unit

Box = tuple[float, float, float, float]

MAX_DRAWN_COORDINATE: Final = 10 * LARGEST_COORDINATE
"""A coordinate that is larger than this, or NaN, is neither drawn nor fitted into a view."""


class Style(IntEnum):
    """The role of something drawn; each screen decides how a role looks."""

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
    NUMBER = 14
    GOUGE_AREA = 15
    UNCUT_AREA = 16
    UNTAKEN = 17
    """Alternative solutions of a segment or a run that are not chosen, and contours of other blocks."""


DOTTED_STYLES: Final = frozenset({Style.DELETED, Style.UNTAKEN})
"""The styles whose dashed lines are dotted."""


class Symbol(Enum):
    """The meaning of a mark; the raster picks a character for it that the mode's terminals have."""

    START = auto()
    ARROW = auto()
    PLUNGE = auto()
    GOUGE = auto()
    DELETED = auto()
    CENTER = auto()
    NUMBER = auto()


@dataclass(frozen=True, eq=False, slots=True)
class Layer:
    """One path and its role; if `drawn` (n,) is given, only the pieces for which it is True are drawn."""

    path: Path
    style: Style
    dashed: bool = False
    drawn: NDArray[np.bool_] | None = None

    @property
    def parts(self) -> list[Path]:
        """The runs of pieces that are drawn."""
        if self.drawn is None:
            return [self.path] if len(self.path) else []
        return PathParts(self.path, self.drawn).paths

    @property
    def boxes(self) -> Floats:
        """(n, 4) bounding boxes of the pieces that are drawn."""
        boxes = self.path.boxes.T
        return boxes if self.drawn is None else boxes[self.drawn]


@dataclass(frozen=True, slots=True)
class Circle:
    """The outline of a disk, such as the cutter: `center` and `radius` in millimeters."""

    center: Point
    radius: float
    style: Style = Style.CUTTER


class Mark(NamedTuple):
    """One character at a point; an ARROW points along `direction`, a NUMBER is the digit `text`."""

    at: Point
    style: Style
    symbol: Symbol
    direction: Point = (1.0, 0.0)
    text: str = ""


class Area(NamedTuple):
    """A region in millimeters to shade with dots: densely if it is gouged, sparsely if it is left uncut."""

    region: BaseGeometry
    style: Style


class Label(NamedTuple):
    """A short text a little away from a point, in the direction `away`."""

    at: Point
    text: str
    away: Point


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """Everything to draw.  `unit` is the scale bar's, None for no bar; `axes` shows the program's X and Y axis."""

    layers: tuple[Layer, ...] = ()
    circles: tuple[Circle, ...] = ()
    marks: tuple[Mark, ...] = ()
    unit: Unit | None = None
    axes: bool = True
    areas: tuple[Area, ...] = ()
    labels: tuple[Label, ...] = ()

    @property
    def outlined(self) -> tuple[Layer, ...]:
        """The layers that have pieces, with the outlines of the circles after them."""
        return tuple(layer for layer in (*self.layers, *map(_outline, self.circles)) if len(layer.path))

    @property
    def bounds(self) -> Box | None:
        """Least x, least y, largest x, largest y of everything that can be drawn; None for an empty scene."""
        marks = [(x, y, x, y) for (x, y), *_ in self.marks]
        return _box_around([*self._boxes(()), np.array(marks, float).reshape(-1, 4)])

    def extent(self, without: Container[Style] = ()) -> Box | None:
        """Return the bounds of circles and layers only, except layers in the styles `without`."""
        return _box_around(self._boxes(without))

    def _boxes(self, without: Container[Style]) -> list[Floats]:
        layers = [*(layer for layer in self.layers if layer.style not in without), *map(_outline, self.circles)]
        with np.errstate(invalid="ignore", over="ignore"):
            return [layer.boxes for layer in layers]


def _outline(circle: Circle) -> Layer:
    """Return the whole circle as a layer."""
    rim = (circle.center[0] + circle.radius, circle.center[1])
    return Layer(Path.from_pieces([Arc(rim, rim, circle.center, Turn.CCW)]), circle.style)


def _box_around(boxes: Sequence[Floats]) -> Box | None:
    """Return the box around all boxes (n, 4) that can be drawn."""
    rows = np.concatenate([np.empty((0, 4)), *boxes])
    # comparisons with NaN are false
    drawn = rows[(np.abs(rows) <= MAX_DRAWN_COORDINATE).all(axis=1)]
    if not len(drawn):
        return None
    (left, low), (right, high) = drawn[:, :2].min(axis=0).tolist(), drawn[:, 2:].max(axis=0).tolist()
    return left, low, right, high


def joined_scenes(scenes: Sequence[Scene]) -> Scene:
    """Join several blocks in one drawing; unit and axes are the first one's."""
    return Scene(
        tuple(layer for scene in scenes for layer in scene.layers),
        tuple(circle for scene in scenes for circle in scene.circles),
        tuple(mark for scene in scenes for mark in scene.marks),
        scenes[0].unit if scenes else None,
        scenes[0].axes if scenes else True,
        tuple(area for scene in scenes for area in scene.areas),
        tuple(label for scene in scenes for label in scene.labels),
    )


def contour_scene(
    surface: Path,
    *,
    unit: Unit | None = None,
    sketches: PathParts = NO_PARTS,
    untaken: PathParts = NO_PARTS,
    path: Path = EMPTY,
    further: Sequence[Path] = (),
    leads: Sequence[Path] = (),
    rough: Sequence[Path] = (),
    over_run: PathParts = NO_PARTS,
    deleted: PathParts = NO_PARTS,
    meetings: Sequence[Point] = (),
    gouges: Sequence[Point] = (),
    uncut: PathParts = NO_PARTS,
    cutter: tuple[Point, float] | None = None,
    current: Path | None = None,
    start: Point | None = None,
) -> Scene:
    """Return the drawing of one contour, lengths in millimeters.

    `sketches` are segments not determined yet, `untaken` solutions not chosen; `further` the center path's
    other loops; `leads` the blend moves, the blend-in first; `over_run` the ends of the surface that are leads;
    `rough` dashed center paths; `deleted` pieces of the contour the look-ahead deletes, `meetings` the points where
    the deleting pieces meet; `gouges` the points cut into; `cutter` (center, radius); `current` the segment under the
    cursor; `start` the contour's START.
    """
    # deleted segments have a line of their own
    deleted_numbers = deleted.path.numbers[deleted.in_part]
    left_uncut = PathParts(uncut.path, uncut.in_part & ~np.isin(uncut.path.numbers, deleted_numbers))
    layers = (
        *_parts(untaken, Style.UNTAKEN, dashed=True),
        *_parts(sketches, Style.SURFACE, dashed=True),
        *_parts(PathParts(surface, ~np.isin(surface.numbers, deleted_numbers)), Style.SURFACE),
        *_layers(rough, Style.RAPID, dashed=True),
        *_layers(leads, Style.LEAD),
        *_parts(over_run, Style.LEAD),
        *_layers((path, *further), Style.PATH),
        *_parts(left_uncut, Style.UNCUT),
        *_parts(deleted, Style.DELETED, dashed=True),
        *_layers((current or EMPTY,), Style.CURRENT),
    )
    marks = (
        *_travel_arrow(path if len(path) else surface),
        *_plunge_mark(leads, path),
        *(Mark(at, Style.START, Symbol.START) for at in (start,) if at is not None),
        *(Mark(at, Style.DELETED, Symbol.DELETED) for at in meetings),
        *(Mark(at, Style.GOUGE, Symbol.GOUGE) for at in gouges),
    )
    return Scene(layers, () if cutter is None else (Circle(*cutter),), marks, unit)


def _layers(paths: Sequence[Path], style: Style, *, dashed: bool = False) -> Iterator[Layer]:
    return (Layer(path, style, dashed) for path in paths if len(path))


def _parts(parts: PathParts, style: Style, *, dashed: bool = False) -> Iterator[Layer]:
    if len(parts.path):
        yield Layer(parts.path, style, dashed, parts.in_part)


def _travel_arrow(path: Path) -> Iterator[Mark]:
    """Yield an arrow in the middle of the path's first piece with a length."""
    first = next((piece for piece in path if piece.length > 0.0), None)
    if first is not None:
        yield Mark(first.point_at(0.5), Style.START, Symbol.ARROW, direction_at_middle(first))


def direction_at_middle(piece: Piece) -> Point:
    """Return the direction of travel in the middle of a piece, as a vector of any length."""
    if isinstance(piece, Line):
        return piece.end[0] - piece.start[0], piece.end[1] - piece.start[1]
    x, y = piece.point_at(0.5)
    return (piece.center[1] - y) * int(piece.turn), (x - piece.center[0]) * int(piece.turn)


def _plunge_mark(leads: Sequence[Path], path: Path) -> Iterator[Mark]:
    """Yield the mark where the cutter plunges: the start of the first lead, or of the path."""
    first = next((lead for lead in leads if len(lead)), path)
    if len(first):
        yield Mark(point_of_row(first.points[0]), Style.LEAD, Symbol.PLUNGE)
