"""Other contours: the walls that a cutter cuts into on its way along a contour of another block or stretch.

Each contour is judged with its own path first.  A path may cut the wall of another contour too: an island too near to a
pocket, a contour at a wrong place.  No program says which walls are meant to stay, so such a cut is a doubt, not a
gouge.  A roughing pass is not reported: other paths cut away all that it left of its wall, and if it is an island some
of its inside stays.

Shapely finds the doubtful cuts, with chords for arcs; those reported are measured exactly.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Final

import numpy as np
import shapely
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from core.geometry.nearby import near_pairs
from core.geometry.path import Floats, Path, chords_of, runs_of
from core.geometry.piece import Side
from core.progress import Progress, silent
from core.tolerance import ARC_RADII, GOUGE, ON_PATH
from core.verify.judge import judge
from core.verify.surface import Leads
from core.verify.verdict import Gouge

MAX_CHORD_ERROR: Final = 1e-3
"""Largest distance in millimeters of a chord from its arc."""

CHORDS_PER_QUARTER: Final = 32
"""Chords per quarter circle at the ends of a swept region."""

MIN_CUT_DEPTH: Final = 0.01
"""Least depth in millimeters at which a path cuts a wall away."""

MAX_WALL_LEFT: Final = 0.05
"""Millimeters of a wall that may remain when it is cut away; rounded ends leave that much."""

MAX_ISLAND_SHARE: Final = 0.01
"""An island is destroyed if no more than this share of its inside stays."""


@dataclass(frozen=True, eq=False, slots=True)
class Wall:
    """A contour that is cut, seen along its path with the cutter on `side`.

    `top` is the height of its highest cut (mm).  The radii of its arcs may differ by `accepted` (mm).  Contours that
    have the same `shape` are one wall.  Places of two setups are not compared.  `number` says whose contour it is.
    """

    path: Path
    side: Side
    top: float
    shape: Hashable
    accepted: float = ARC_RADII
    setup: int = 0
    number: int = 0

    def line(self) -> LineString:
        """Return its path as chords."""
        return LineString(chords_of(self.path, MAX_CHORD_ERROR))


@dataclass(frozen=True, eq=False, slots=True)
class Sweep:
    """The center path of a cutter, the (n, 2) heights of both ends of its pieces, and the cutter's radius (mm).

    `shapes` are those of the walls that it cuts on purpose.  `setup` and `number` are as in Wall.
    """

    path: Path
    heights: Floats
    radius: float
    shapes: frozenset[Hashable]
    setup: int = 0
    number: int = 0
    _regions: dict[tuple[float, float], BaseGeometry] = field(default_factory=dict)

    def low(self, top: float) -> Iterator[Path]:
        """Yield the parts of the path that are no higher than `top`."""
        for rows in runs_of(self.heights.max(axis=1, initial=-np.inf) <= top + ON_PATH):
            yield self.path.part(int(rows[0]), int(rows[-1]) + 1)

    def lines(self, top: float) -> list[LineString]:
        """Return these parts as chords."""
        return [LineString(chords_of(path, MAX_CHORD_ERROR)) for path in self.low(top)]

    def region(self, top: float, grown: float) -> BaseGeometry:
        """Return the region that a cutter larger by `grown` on all sides sweeps in the parts no higher than `top`."""
        if (top, grown) not in self._regions:
            reach = max(self.radius + grown, 0.0)
            parts = [line.buffer(reach, quad_segs=CHORDS_PER_QUARTER) for line in self.lines(top)]
            region = shapely.union_all(parts)
            shapely.prepare(region)
            self._regions[top, grown] = region
        return self._regions[top, grown]

    def reaches(self, line: BaseGeometry, top: float) -> bool:
        """True if the cutter goes deeper than MIN_CUT_DEPTH into a wall, in the parts no higher than `top`."""
        return any(bool(shapely.dwithin(line, part, self.radius - MIN_CUT_DEPTH)) for part in self.lines(top))


@dataclass(frozen=True, slots=True)
class ContourCut:
    """A cut into the wall of another contour.  The gouge's numbers are those of the wall's path and of the sweep's."""

    gouge: Gouge
    wall: Wall
    sweep: Sweep

    @property
    def through(self) -> bool:
        """True if the whole cutter is behind the wall, so that the depth is unknown."""
        return self.gouge.depth >= 2.0 * self.sweep.radius - GOUGE


def cuts_into_other_contours(
    walls: Sequence[Wall], sweeps: Sequence[Sweep], progress: Progress = silent
) -> list[ContourCut]:
    """Return each number's deepest cut into each wall, by sweeps of another shape that run no higher than its top."""
    walls, sweeps = [wall for wall in walls if len(wall.path)], [sweep for sweep in sweeps if len(sweep.path)]
    if not walls or not sweeps:
        return []
    cuts, reach = list[ContourCut](), max(sweep.radius for sweep in sweeps)
    by_shape = defaultdict[Hashable, list[Wall]](list)
    for wall in walls:
        by_shape[wall.shape].append(wall)
    bounds = _bounds([wall.path for wall in walls])
    for rows, sweep_rows in near_pairs(bounds, _bounds([sweep.path for sweep in sweeps]), reach):
        pairs = defaultdict[int, list[Sweep]](list)
        for row, index in zip(rows.tolist(), sweep_rows.tolist(), strict=True):
            if walls[row].setup == sweeps[index].setup:
                pairs[row].append(sweeps[index])
        for row, near_sweeps in pairs.items():
            progress(row / len(walls))
            cuts += _cuts(walls[row], near_sweeps, by_shape)
    return cuts


def _bounds(paths: Sequence[Path]) -> Floats:
    """Return (4, n) the box of each path."""
    boxes = [path.boxes for path in paths]
    return np.array([(*box[:2].min(axis=1), *box[2:].max(axis=1)) for box in boxes]).T.reshape(4, -1)


def _cuts(wall: Wall, sweeps: Sequence[Sweep], walls: Mapping[Hashable, Sequence[Wall]]) -> Iterator[ContourCut]:
    """Yield the deepest cut into a wall by the sweeps of each number; none if the wall was not to stay."""
    other_sweeps, chords = [sweep for sweep in sweeps if wall.shape not in sweep.shapes], wall.line()
    shapely.prepare(chords)
    if not any(sweep.reaches(chords, wall.top) for sweep in other_sweeps):
        return
    own_regions = [sweep.region(wall.top, MIN_CUT_DEPTH) for sweep in sweeps if wall.shape in sweep.shapes]
    cut_region, inside, line = shapely.union_all(own_regions), _enclosed(chords), _outline(chords)
    is_open = inside.is_empty
    # an island's own path stays outside it
    if inside.intersection(cut_region).area >= inside.length * 3.0 * MIN_CUT_DEPTH:
        inside = Polygon()
    standing, inside_left, cutting = line.intersection(cut_region), inside, defaultdict[int, list[Sweep]](list)
    for sweep in other_sweeps:
        region = sweep.region(wall.top, -MIN_CUT_DEPTH)
        if not region.intersects(line):
            continue
        cutting[sweep.number].append(sweep)
        standing, inside_left = standing.difference(region), inside_left.difference(region)
        if standing.length <= MAX_WALL_LEFT and inside.is_empty:
            return
    destroyed = not inside.is_empty and inside_left.area <= MAX_ISLAND_SHARE * inside.area
    if standing.length <= MAX_WALL_LEFT and not destroyed:
        return
    for group in cutting.values():
        cuts = list[ContourCut]()
        for sweep in group:
            crossed = [each for shape in sweep.shapes for each in walls[shape]] if is_open else ()
            first, last = _wall_extent(chords, crossed)
            places = ((chords.project(Point(cut.gouge.surface_at)), cut) for cut in _measured(wall, sweep))
            cuts += [cut for place, cut in places if first <= place <= last]
        if cuts:
            yield max(cuts, key=lambda cut: cut.gouge.depth)


def _wall_extent(open_line: LineString, crossed: Sequence[Wall]) -> tuple[float, float]:
    """Return between which lengths along an open contour it is wall: it runs on past the contours that it crosses.

    A slot runs on past the edge to which it is open, and each of two sides past their corner.
    """
    crossings = (shapely.get_parts(open_line.intersection(_outline(other.line()))) for other in crossed)
    along = [open_line.project(point) for points in crossings for point in points if isinstance(point, Point)]
    return min(along, default=0.0), max(along, default=inf)


def _enclosed(line: LineString) -> Polygon:
    """Return the largest region that a contour encloses; it is empty for an open one."""
    regions = shapely.get_parts(shapely.polygonize([shapely.node(line)]))
    return max(regions, key=lambda region: region.area, default=Polygon())


def _outline(line: LineString) -> BaseGeometry:
    """Return a contour without over-runs if it encloses something."""
    enclosed = _enclosed(line)
    return line if enclosed.is_empty else enclosed.exterior


def _measured(wall: Wall, sweep: Sweep) -> Iterator[ContourCut]:
    for path in sweep.low(wall.top):
        verdict = judge(
            wall.path, wall.side, sweep.radius, path, wall.accepted, leads=Leads.MOVES, measures_uncut=False
        )
        yield from (ContourCut(gouge, wall, sweep) for gouge in verdict.gouges)
