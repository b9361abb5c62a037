"""The scene of one contour: what lies over what, and which marks it carries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, sin

from core.draw.scene import Circle, Layer, Mark, Scene, Style, Symbol
from core.geometry.path import EMPTY, Floats, Path
from core.geometry.piece import Line, Piece, Point
from core.geometry.stretch import NO_PARTS, Parts
from core.units import Unit


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
