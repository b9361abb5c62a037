"""Standing walls are what the other passes of a stretch leave of a closed pass's wall.

A bore is opened circle by circle, a counterbore is wider than the bore below it, a boss is cut down to size.  A pass
cuts the wall of another one away down to its own depth if it runs the same way around and lies behind that wall, in its
material.  Above its depth no wall is left that a move could gouge.

A pass above the lowest one of the other shape makes a step.  It may share walls with it if the step is somewhere wider
than the cutter's radius: a narrower one may be a wrong coordinate at one of several depths.  Any other pass makes it
roughing, whose whole wall is cut away: it comes later, shares no wall with it, and is at most a cutter's diameter
behind, so that nothing stays between them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import Final, Literal

import shapely
from shapely import STRtree
from shapely.geometry import Polygon

from core.controls.judging.repeated_passes import PathKey, path_key
from core.geometry.path import Floats, Path, chords_of, joined
from core.geometry.piece import Side
from core.tolerance import ON_PATH

MAX_CHORD_ERROR: Final = 1e-3
"""Millimeters by which chords may be off the passes; passes that come nearer than two of them share a wall."""


MIN_POINTS: Final = 4
"""Fewest points that enclose something, the first one again at the end; a move shorter than CLOSED has two."""


@dataclass(frozen=True, eq=False, slots=True)
class ClosedPass:
    """A closed run of moves, what it encloses, the heights of its lowest and highest point, and the cutter's radius.

    The region is empty if the run crosses itself: then it cuts nothing away, and nothing cuts it away.
    """

    path: Path
    region: Polygon
    low: float
    high: float
    radius: float

    @staticmethod
    def of(path: Path, heights: Floats, radius: float) -> ClosedPass:
        """Return the pass of a closed path; `heights` (n, 2) has those of both ends of each piece."""
        chords = chords_of(path, MAX_CHORD_ERROR)
        region = Polygon(chords) if len(chords) >= MIN_POINTS else Polygon()
        region = region if region.is_valid and region.area > 0.0 else Polygon()
        return ClosedPass(path, region, float(heights.min()), float(heights.max()), radius)

    @property
    def shape(self) -> PathKey:
        """The same key for passes of one shape."""
        return path_key(self.path)


@dataclass(frozen=True, eq=False, slots=True)
class StandingWall:
    """A wall from its lowest point up to the height above which another pass cuts it away, if one does.

    `cut_away_by` is the path of that pass; `shape` is that of the passes that make the wall.
    """

    path: Path
    low: float = -inf
    top: float = inf
    cut_away_by: Path | None = None
    shape: PathKey = ()

    @property
    def stands(self) -> bool:
        """False for a roughing pass: nothing of its wall stays."""
        return self.top > self.low + ON_PATH


def walls_of(walls: Sequence[StandingWall], passes: Sequence[ClosedPass]) -> list[StandingWall]:
    """Return the walls that these passes make, without what other passes of the same shapes add to their paths."""
    paths = defaultdict[PathKey, list[Path]](list)
    for each in passes:
        paths[each.shape].append(each.path)
    return [replace(wall, path=joined(paths[wall.shape])) for wall in walls if wall.shape in paths]


@dataclass(eq=False, slots=True)
class _Shape:
    """The rows of passes of one shape, what they enclose, and that region grown by what its chords may be off."""

    rows: list[int]
    region: Polygon
    grown: Polygon
    reached: dict[tuple[float, str], Polygon] = field(default_factory=dict)

    @staticmethod
    def of(rows: list[int], region: Polygon) -> _Shape:
        grown = region.buffer(2.0 * MAX_CHORD_ERROR)
        shapely.prepare([region, grown])
        return _Shape(rows, region, grown)

    def runs_inside(self, side: Side) -> bool:
        """True if the cutter runs inside."""
        return bool(self.region.exterior.is_ccw) is (side is Side.LEFT)

    def nested(self, other: _Shape, side: Side) -> tuple[_Shape, _Shape]:
        """Return this wall and a pass behind it, the inner one first."""
        return (self, other) if self.runs_inside(side) else (other, self)

    def has_behind(self, other: _Shape, side: Side) -> bool:
        """True if another pass runs the same way around and lies in the material of this wall, or on the wall."""
        if self.region.is_empty or other.region.is_empty:
            return False
        inner, outer = self.nested(other, side)
        same_way = self.region.exterior.is_ccw is other.region.exterior.is_ccw
        return bool(same_way and outer.region.area > inner.region.area and outer.grown.contains(inner.region))

    def shares_walls(self, other: _Shape, side: Side) -> bool:
        """True if a pass behind the wall shares walls with it."""
        inner, outer = self.nested(other, side)
        return not outer.region.contains(inner.grown)

    def is_close(self, other: _Shape, radius: float, side: Side) -> bool:
        """True if a pass behind the wall shares no wall with it, and is nowhere farther than its cutter's diameter."""
        reach = 2.0 * (radius + MAX_CHORD_ERROR)
        if self.shares_walls(other, side):
            return False
        if self.runs_inside(side):
            return bool(self.region.contains(other.within_reach(-reach)))
        return bool(other.within_reach(reach).contains(self.region))

    def is_wide(self, other: _Shape, radius: float, side: Side) -> bool:
        """True if a pass behind the wall shares no wall with it, or is somewhere farther than its cutter's radius.

        The distance is measured square to the walls.
        """
        inner, outer = self.nested(other, side)
        return not (self.shares_walls(other, side) and inner.within_reach(radius, "mitre").contains(outer.region))

    def within_reach(self, distance: float, corners: Literal["round", "mitre"] = "round") -> Polygon:
        """Return its region grown by a distance, shrunk by a negative one."""
        if (distance, corners) not in self.reached:
            region = self.region.buffer(distance, join_style=corners)
            shapely.prepare(region)
            self.reached[distance, corners] = region
        return self.reached[distance, corners]


def standing_walls(passes: Sequence[ClosedPass], side: Side) -> list[StandingWall]:
    """Return the walls of passes in the order of the program; passes of one shape at several heights make one wall."""
    rows_of = defaultdict[PathKey, list[int]](list)
    for row, each in enumerate(passes):
        rows_of[each.shape].append(row)
    shapes = [_Shape.of(rows, passes[rows[0]].region) for rows in rows_of.values()]
    walls, tree = list[StandingWall](), STRtree([shape.region for shape in shapes])
    for key, shape in zip(rows_of, shapes, strict=True):
        path = joined([passes[row].path for row in shape.rows])
        low = min(passes[row].low for row in shape.rows)
        near = [shapes[index] for index in sorted(tree.query(shape.region).tolist())]
        behind = [(other, row) for other in near if shape.has_behind(other, side) for row in other.rows]
        close = [row for other, row in behind if shape.is_close(other, passes[row].radius, side)]
        above = [(other, passes[row]) for other, row in behind if passes[row].high > low + ON_PATH]
        steps = [step for other, step in above if shape.is_wide(other, step.radius, side)]
        lowest_cuts = list[ClosedPass]()
        for row in shape.rows:
            # a close pass cuts the wall away if it comes later, or from above
            later = [passes[index] for index in close if index > row or passes[index].high > passes[row].low + ON_PATH]
            lowest_cuts += sorted((*steps, *later), key=lambda cut: cut.high)[:1]
        if len(lowest_cuts) < len(shape.rows):
            walls.append(StandingWall(path, low, shape=key))
        else:
            highest = max(lowest_cuts, key=lambda cut: cut.high)
            walls.append(StandingWall(path, low, highest.high, highest.path, key))
    return walls
