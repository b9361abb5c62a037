"""Draws a derived block: surface, paths, blend moves, the cutter, and what is deleted, gouged and left uncut."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot
from typing import Final, NamedTuple

import numpy as np

from core.advice.block_paths import BlockPaths
from core.advice.lookahead_table import Row
from core.comp.compensated import CenterPath, Compensated
from core.draw.areas import gouged, material, uncut
from core.draw.characters import CELLS_OF_MODE, Mode, scale_bar
from core.draw.raster import Picture, draw
from core.draw.scene import (
    Area,
    Box,
    Label,
    Layer,
    Mark,
    Scene,
    Style,
    Symbol,
    contour_scene,
    direction_at_middle,
    joined_scenes,
)
from core.draw.view import CELL_HEIGHT, View
from core.geometry.distance import distance
from core.geometry.path import EMPTY, Path, as_complex, point_of_row
from core.geometry.path_parts import NO_PARTS, PartEnds, PathParts, parts_between, parts_of, single_pieces
from core.geometry.piece import Piece, Point, Side
from core.geometry.piece_arrays import piece_arrays
from core.output.dxf import dxf
from core.output.svg import svg
from core.pipeline.derived import Derived, DerivedBlock
from core.program.solve.solved import untaken_pieces
from core.tolerance import JOINED
from core.units import Unit
from core.verify.verdict import Verdict

STYLES_DRAWN_OVER_SURFACE: Final = frozenset({Style.UNCUT, Style.GOUGE})
"""Roles of layers that repeat parts of the surface: they cannot widen the bounds of a drawing."""
SURFACE_STYLES: Final = frozenset({Style.SURFACE, Style.UNCUT, Style.DELETED, Style.CURRENT, Style.UNTAKEN})
"""Roles of the surface and of its faults."""
LOUPE_HEIGHT_RADII: Final = 4.6
"""Height of a loupe in tool radii."""
MIN_DOTS: Final = 2.6
"""The tool's path is drawn next to the surface only if the tool radius has at least this many dots."""
MIN_DOTS_FOR_NUMBERS: Final = 3.0
"""The same for the numbers of segments."""
MAX_NARROW_COLUMNS: Final = 44
"""Segment numbers would crowd in a drawing of this many columns or fewer."""


def nearest_segment(block: DerivedBlock, at: Point) -> int | None:
    """Return the number of the segment nearest to a point (mm); None if the block has no determined segment."""
    surface = _surface(block)
    if not len(surface):
        return None
    arrays = piece_arrays(surface)
    apart = distance(arrays, np.full(len(arrays), complex(*at)))
    return int(surface.numbers[arrays.rows[int(apart.argmin())]])


def svg_of(derived: Derived, *, title: str) -> str:
    """Return the whole program as one SVG drawing."""
    scenes = [block_scene(block, None, derived.program.unit) for block in derived.blocks]
    return svg(joined_scenes(scenes), title=title)


def dxf_of(derived: Derived) -> str:
    """Return the whole program as one DXF drawing."""
    unit = derived.program.unit
    return dxf(joined_scenes([block_scene(block, None, unit) for block in derived.blocks]), unit)


def block_scene(block: DerivedBlock, segment: int | None, unit: Unit, row: Row | None = None) -> Scene:
    """Return the block with the cursor on `segment` (0 is START, None nowhere), or with the path of a table row."""
    work, solved = block.paths, block.solved
    loops, control, verdict = ((), None, None) if work is None else (work.loops, work.compensated, work.verdict)
    if work is not None and work.best is not None:
        # the control's path is not posted: its deletions do not matter
        control = None
    if row is not None:
        control, verdict = row.compensated, row.verdict
        loops = (control,)
    surface, first = _surface(block), loops[0] if loops else CenterPath(EMPTY)
    place = None if segment is None else _place(loops, control, segment)
    gouges = [] if verdict is None else [gouge.surface_at for gouge in verdict.gouges]
    # where the path cuts into the contours of other blocks
    gouges += [found.at for found in block.findings if found.code == "OTHER_BLOCK" and found.at is not None]
    return contour_scene(
        surface,
        unit=unit,
        sketches=_sketches(block),
        untaken=parts_of([piece] for pieces in untaken_pieces(solved, segment or 0) for piece in pieces),
        path=first.path,
        further=[loop.path for loop in loops[1:]],
        leads=[lead for loop in loops for lead in (loop.lead_in, loop.lead_out)],
        rough=() if row is not None else _dashed_paths(work),
        deleted=NO_PARTS if control is None else _deleted(control),
        meetings=() if control is None else list(dict.fromkeys(zip(*control.deleted.at.T.tolist(), strict=True))),
        over_run=NO_PARTS if verdict is None else _over_run(surface, verdict),
        gouges=gouges,
        uncut=NO_PARTS if verdict is None or not verdict.uncut else parts_between(surface, verdict.uncut_ends),
        cutter=None if place is None or block.radius is None else (place, block.radius),
        current=_current(block, segment),
        start=solved.segments[0].start if solved.segments else None,
    )


@dataclass(frozen=True, eq=False, slots=True)
class Subject:
    """What a drawing shows of a block; points and lengths in millimeters.

    `segment` is the one with the cursor (0 is START, None none), `row` a row of the look-ahead table that is drawn in
    place of the path in force.  `near` is the center of a loupe, None shows the whole part; `view`, what the operator
    zoomed to, overrides both.  An `outline` shows the surface alone, with the number of each place of `trouble`.  The
    `cross` is where the operator points.
    """

    block: DerivedBlock
    unit: Unit
    segment: int | None = None
    row: Row | None = None
    near: Point | None = None
    view: View | None = None
    outline: bool = False
    trouble: tuple[Mark, ...] = ()
    cross: Point | None = None

    def drawn(self, columns: int, rows: int, mode: Mode) -> Drawn | None:
        """Return the picture in columns x rows cells; None if there is nothing to see."""
        scene = block_scene(self.block, self.segment, self.unit, self.row)
        scene = _outlined(scene, self) if self.outline else replace(scene, axes=self.near is None)
        bounds = scene.extent(without=STYLES_DRAWN_OVER_SURFACE)
        if bounds is None or columns < 1 or rows < 1:
            return None
        view, look = _view_of(self, bounds, columns, rows), CELLS_OF_MODE[mode]
        if not self.outline:
            others = (Layer(path, Style.UNTAKEN, dashed=True) for path in self.block.cut_contours)
            scene = replace(scene, layers=(*others, *scene.layers))
        dot = view.scale * look.dot[0]
        dots = (self.block.radius or 0.0) / dot
        if dots < MIN_DOTS:
            scene = _outlined(scene, self)
        elif not self.outline:
            labels = (
                _segment_labels(self.block) if dots >= MIN_DOTS_FOR_NUMBERS and columns > MAX_NARROW_COLUMNS else ()
            )
            scene = replace(scene, areas=_areas(self, dot), labels=labels)
        if self.cross is not None:
            scene = replace(scene, marks=(*scene.marks, Mark(self.cross, Style.CURRENT, Symbol.CENTER)))
        picture = draw(scene, view, columns, rows, mode)
        return Drawn(picture, view, scale_bar(view.scale, columns, self.unit, look.bar), bounds)


class Drawn(NamedTuple):
    """A picture of a block, the view it shows, and a scale bar in program units for its frame.

    `bounds` is the box (mm) around everything drawn.
    """

    picture: Picture
    view: View
    scale_bar: str
    bounds: Box


@dataclass(frozen=True, eq=False, slots=True)
class SceneSubject:
    """A scene that is drawn as it is; `view` is what the operator zoomed to, None shows all of it."""

    scene: Scene
    unit: Unit
    view: View | None = None

    def drawn(self, columns: int, rows: int, mode: Mode) -> Drawn | None:
        """Return the picture in columns x rows cells; None if there is nothing to see."""
        bounds = self.scene.extent(without=STYLES_DRAWN_OVER_SURFACE)
        if bounds is None or columns < 1 or rows < 1:
            return None
        view = self.view or View.fit(bounds, columns, rows)
        picture = draw(self.scene, view, columns, rows, mode)
        return Drawn(picture, view, scale_bar(view.scale, columns, self.unit, CELLS_OF_MODE[mode].bar), bounds)


def _view_of(subject: Subject, bounds: Box, columns: int, rows: int) -> View:
    if subject.view is not None:
        return subject.view
    whole = View.fit(bounds, columns, rows)
    if subject.near is None or not subject.block.radius:
        return whole
    loupe = View(subject.near, LOUPE_HEIGHT_RADII * subject.block.radius / (rows * CELL_HEIGHT))
    return whole if loupe.scale >= whole.scale else loupe.centered_on(subject.near, bounds, columns, rows)


def _outlined(scene: Scene, subject: Subject) -> Scene:
    """Return the surface and its faults alone: if the cutter is a few dots wide, the rest would be one blob."""
    layers = tuple(layer for layer in scene.layers if layer.style in SURFACE_STYLES)
    if subject.outline:
        return Scene(layers, marks=subject.trouble, axes=False)
    marks = tuple(mark for mark in scene.marks if mark.style in (Style.GOUGE, Style.DELETED, Style.START))
    return Scene(layers, marks=(*marks, *subject.trouble), axes=scene.axes)


def _areas(subject: Subject, dot: float) -> tuple[Area, ...]:
    """Return what is gouged and what is left uncut as regions; `dot` is the width (mm) of a dot on the screen."""
    block, block_paths = subject.block, subject.block.paths
    if block_paths is None or block.radius is None or block.side is None:
        return ()
    verdict = block_paths.verdict if subject.row is None else subject.row.verdict
    loops = block_paths.loops if subject.row is None else (subject.row.compensated,)
    paths = [loop.with_leads for loop in loops]
    if verdict is None or not (verdict.gouges or verdict.uncut):
        return ()
    part = material(block_paths.surface, block.side, block.radius, closed=block.solved.closed, sag=dot / 2)
    areas = []
    if verdict.uncut:
        stretch = parts_between(block_paths.surface, verdict.uncut_ends).paths
        thick = [left.thickness for left in verdict.uncut]
        if len(stretch) == len(thick):
            areas.append(Area(uncut(part, stretch, thick, paths, block.radius, dot / 2), Style.UNCUT_AREA))
    if verdict.gouges:
        areas.append(Area(gouged(part, paths, block.radius, dot), Style.GOUGE_AREA))
    return tuple(areas)


def _segment_labels(block: DerivedBlock) -> tuple[Label, ...]:
    """Return the numbers of the segments, on the part's side of their midpoints."""
    labels = []
    for number, segment in enumerate(block.solved.segments, 1):
        if segment.piece is not None and segment.piece.length > 0.0:
            at, (x, y) = segment.piece.point_at(0.5), direction_at_middle(segment.piece)
            size = hypot(x, y) * (1.0 if block.side is Side.RIGHT else -1.0)
            labels.append(Label(at, str(number), (-y / size, x / size)))
    return tuple(labels)


def _over_run(surface: Path, verdict: Verdict) -> PathParts:
    """Return the parts of the surface beyond the crossing of its ends: lead-in and lead-out."""
    if verdict.over_run_at is None:
        return NO_PARTS
    crossing, numbers = complex(*verdict.over_run_at), surface.numbers[[0, -1]]
    start, end = as_complex(surface.points[[0, -1]])
    starts, ends = np.array([start, crossing]), np.array([crossing, end])
    # one end may begin or stop at the crossing
    runs = np.abs(ends - starts) > JOINED
    return parts_between(surface, PartEnds(numbers[runs], starts[runs], numbers[runs], ends[runs]))


def _dashed_paths(work: BlockPaths | None) -> list[Path]:
    """Return the roughing passes, and the control's path if another one is posted."""
    if work is None:
        return []
    passes = [loop.with_leads for rough in work.rough for loop in rough.loops]
    return passes if work.best is None or work.compensated is None else [*passes, work.compensated.path]


def _surface(block: DerivedBlock) -> Path:
    if block.paths is not None:
        return block.paths.surface
    pieces = block.solved.pieces
    return Path.from_pieces([piece for _, piece in pieces], [float(number) for number, _ in pieces])


def _sketches(block: DerivedBlock) -> PathParts:
    """Return what is known of segments not determined yet, or the solutions that the operator picks from."""
    pieces: list[Piece] = []
    for segment in block.solved.segments[block.solved.determined :]:
        run = block.solved.run_of(segment.number)
        if segment.piece is not None:
            pieces.append(segment.piece)
        elif run is not None:
            # all solutions, or what is known of the pieces
            answers = [piece for answer in run.answers for _, piece in answer.pieces]
            pieces += (answers or run.sketch) if run.first == segment.number else ()
        else:
            pieces += segment.choices or ((segment.sketch,) if segment.sketch is not None else ())
    return parts_of([piece] for piece in pieces)


def _deleted(control: Compensated) -> PathParts:
    if not len(control.deleted):
        return NO_PARTS
    return single_pieces(control.contour, np.isin(control.contour.numbers, control.deleted.segments).nonzero()[0])


def _current(block: DerivedBlock, segment: int | None) -> Path | None:
    if not segment or segment > len(block.solved.segments):
        return None
    piece = block.solved.segments[segment - 1].piece
    return None if piece is None else Path.from_pieces([piece])


def _place(loops: Sequence[CenterPath], control: Compensated | None, segment: int) -> Point | None:
    """Return the end of a segment's path, the path's start for START, or where the path passes a deleted segment."""
    for loop in loops:
        parts = [part for part in (loop.lead_in, loop.path, loop.lead_out) if len(part)]
        if not segment and parts:
            return point_of_row(parts[0].points[0])
        for part in reversed(parts):
            if len(rows := (part.numbers == segment).nonzero()[0]):
                return point_of_row(part.ends[rows[-1]])
    return None if control is None else _meeting(control, segment)


def _meeting(control: Compensated, segment: float) -> Point | None:
    """Return the meeting that deleted a segment, or a later one that also deleted a piece of that pair."""
    deleted = {deletion.segment: deletion for deletion in control.deleted}
    later = last = deleted.get(segment)
    while later is not None:
        last = later
        later = next((deleted[number] for number in later.by if number in deleted), None)
    return None if last is None else last.at
