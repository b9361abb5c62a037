"""Crossing contours are compensated contours of a program that cut into one another.

Each contour is judged with its own path first.  A path may cut the wall of another contour too: an island too near to a
pocket, a contour at a wrong place.  No program says which walls are meant to stay, so such a cut is a doubt, not a
gouge.  A roughing pass is not reported: other paths cut away all that it left of its wall, and if it is an island some
of its inside stays.

Shapely finds the doubtful cuts, with chords for arcs; those reported are measured exactly.
"""

from __future__ import annotations

from bisect import bisect
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np
import shapely
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from core.controls.control_run import ControlRun, Stretch
from core.controls.iso.modal_state import TAKEN_AS_ZERO
from core.controls.judging.rapids_at_depth import CutContour
from core.controls.judging.repeated_passes import PathKey, path_key
from core.controls.moves import Moves, Plane
from core.finding import Severity
from core.geometry.chords import chords_of
from core.geometry.nearby import near_pairs
from core.geometry.path import Floats, Path
from core.progress import Progress, silent
from core.tolerance import GOUGE
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

MAX_MEASURED_PATHS: Final = 10
"""Most paths into one contour whose cuts are measured."""


@dataclass(frozen=True, slots=True)
class ContourCut:
    """A cut into another contour, and the radius of the cutter."""

    gouge: Gouge
    radius: float

    @property
    def through(self) -> bool:
        """True if the whole cutter is behind the wall, so that the depth is unknown."""
        return self.gouge.depth >= 2.0 * self.radius - GOUGE


@dataclass(eq=False, slots=True)
class _Pass:
    """Moves of one radius in a compensated stretch, and the shapes of the contours that the stretch cuts.

    `setup` counts the changes of clamping and of unknown shifts so far: places of two setups are not compared.
    """

    moves: Moves
    radius: float
    contour_shapes: frozenset[PathKey]
    setup: int
    regions: dict[tuple[float, float], BaseGeometry] = field(default_factory=dict)

    def low(self, top: float) -> Iterator[Path]:
        """Yield the parts of the moves that are no higher than `top`."""
        paths = (run.path() for run in self.moves.runs(self.moves.low(top)))
        return (path for path in paths if len(path))

    def swept(self, top: float, grown: float) -> BaseGeometry:
        """Return the region that a cutter larger by `grown` on all sides sweeps in the moves no higher than `top`."""
        if (top, grown) not in self.regions:
            lines = [LineString(chords_of(path, MAX_CHORD_ERROR)) for path in self.low(top)]
            reach = max(self.radius + grown, 0.0)
            region = shapely.union_all([line.buffer(reach, quad_segs=CHORDS_PER_QUARTER) for line in lines])
            shapely.prepare(region)
            self.regions[top, grown] = region
        return self.regions[top, grown]


@dataclass(frozen=True, eq=False, slots=True)
class _Wall:
    """A contour at its highest cut, and its shape."""

    contour: CutContour
    shape: PathKey
    setup: int


def cuts_of_other_contours(
    run: ControlRun, contours: Sequence[CutContour], progress: Progress = silent
) -> tuple[ContourCut, ...]:
    """Return the cuts of compensated XY moves into other stretches' contours that are cut no deeper than they run.

    Only the deepest cut of each contour is listed, in the order of the moves' lines.  A gouge's `path_number` is that
    line, `surface_number` the contour's.
    """
    if len(run.stretches) < 2:
        return ()
    walls, passes = _walls(run, contours), _passes(run, contours)
    if not walls or not passes:
        return ()
    cuts, reach = list[ContourCut](), max(sweep.radius for sweep in passes)
    bounds = _bounds([wall.contour.path for wall in walls])
    for rows, near in near_pairs(bounds, _bounds([sweep.moves.path() for sweep in passes]), reach):
        pairs = defaultdict[int, list[_Pass]](list)
        for row, index in zip(rows.tolist(), near.tolist(), strict=True):
            if walls[row].setup == passes[index].setup:
                pairs[row].append(passes[index])
        for row, others in pairs.items():
            progress(row / len(walls))
            if (cut := _cut(walls[row], others)) is not None:
                cuts.append(cut)
    return tuple(sorted(cuts, key=lambda cut: cut.gouge.path_number))


def _walls(run: ControlRun, contours: Sequence[CutContour]) -> list[_Wall]:
    """Return the contours in XY; of those with the same shape, the one that is cut highest."""
    walls, setup = dict[tuple[PathKey, int], _Wall](), _setups(run)
    for contour in contours:
        if contour.stretch.plane is Plane.XY and len(contour.path):
            key = (path_key(contour.path), bisect(setup, _line(contour.stretch)))
            if key not in walls or contour.top > walls[key].contour.top:
                walls[key] = _Wall(contour, *key)
    return list(walls.values())


def _passes(run: ControlRun, contours: Sequence[CutContour]) -> list[_Pass]:
    """Return the compensated moves of a run in XY, by stretch and radius; of equal ones the lowest."""
    passes, setups = dict[tuple[PathKey, float, int], _Pass](), _setups(run)
    for stretch in run.stretches:
        shapes = frozenset(path_key(cut.path) for cut in contours if stretch.has_part(cut.stretch))
        setup = bisect(setups, _line(stretch))
        for part in stretch.parts() if stretch.plane is Plane.XY else ():
            moves = run.moves.part(part.first, part.last)
            key = (path_key(moves.path()), part.radius, setup)
            lowest = passes[key].moves.points[:, 2].min() if key in passes else np.inf
            if part.radius > MIN_CUT_DEPTH and len(moves.path()) and moves.points[:, 2].min() < lowest:
                passes[key] = _Pass(moves, part.radius, shapes, setup)
    return list(passes.values())


def _setups(run: ControlRun) -> list[int]:
    """Return the lines at which the program turns the part or takes a work offset whose values it does not give."""
    return sorted(
        finding.line
        for finding in run.findings
        if finding.line
        and finding.severity is Severity.WARNING
        and (finding.code == "AXIS" or (finding.code == "OFFSET" and TAKEN_AS_ZERO in finding.text))
    )


def _line(stretch: Stretch) -> int:
    return int(stretch.programmed.lines[-1])


def _bounds(paths: Sequence[Path]) -> Floats:
    """Return (4, n) the box of each path."""
    boxes = [path.boxes for path in paths]
    return np.array([(*box[:2].min(axis=1), *box[2:].max(axis=1)) for box in boxes]).T.reshape(4, -1)


def _cut(wall: _Wall, passes: Sequence[_Pass]) -> ContourCut | None:
    """Return the deepest cut of these passes into a contour; None if there is none, or its wall was not to stay."""
    top = wall.contour.top
    cut_region = shapely.union_all(
        [sweep.swept(top, MIN_CUT_DEPTH) for sweep in passes if wall.shape in sweep.contour_shapes]
    )
    line, inside = _outline(wall.contour.path, cut_region)
    stands, core, cutting = line.intersection(cut_region), inside, list[_Pass]()
    for sweep in passes:
        if wall.shape in sweep.contour_shapes or not sweep.swept(top, -MIN_CUT_DEPTH).intersects(line):
            continue
        cutting.append(sweep)
        region = sweep.swept(top, -MIN_CUT_DEPTH)
        stands, core = stands.difference(region), core.difference(region)
        if stands.length <= MAX_WALL_LEFT and inside.is_empty:
            return None
    destroyed = not inside.is_empty and core.area <= MAX_ISLAND_SHARE * inside.area
    if not cutting or (stands.length <= MAX_WALL_LEFT and not destroyed):
        return None
    return max(
        (cut for sweep in cutting[:MAX_MEASURED_PATHS] for cut in _measured(wall.contour, sweep)),
        key=_depth,
        default=None,
    )


def _outline(path: Path, own: BaseGeometry) -> tuple[BaseGeometry, BaseGeometry]:
    """Return a contour as a line, without over-runs if it encloses something, and what material it encloses."""
    line = LineString(chords_of(path, MAX_CHORD_ERROR))
    regions = list(shapely.get_parts(shapely.polygonize([shapely.node(line)])))
    largest = max(regions, key=lambda region: region.area, default=Polygon())
    if largest.is_empty:
        return line, largest
    # an island's own path stays outside it
    is_island = largest.intersection(own).area < largest.length * 3.0 * MIN_CUT_DEPTH
    return largest.exterior, largest if is_island else Polygon()


def _measured(contour: CutContour, sweep: _Pass) -> Iterator[ContourCut]:
    for path in sweep.low(contour.top):
        verdict = judge(
            contour.path,
            contour.stretch.side,
            sweep.radius,
            path,
            contour.accepted,
            leads=Leads.MOVES,
            measures_uncut=False,
        )
        yield from (ContourCut(gouge, sweep.radius) for gouge in verdict.gouges)


def _depth(cut: ContourCut) -> float:
    return cut.gouge.depth
