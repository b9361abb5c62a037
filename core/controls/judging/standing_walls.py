"""Standing walls are what the other passes of a stretch leave of a closed pass's wall.

A bore is opened circle by circle, a counterbore is wider than the bore below it, a boss is cut down to size.  A pass
cuts the wall of another one away down to its own depth if it runs the same way around, shares no wall with it, and lies
in its material, at most a cutter's diameter behind the wall, so that nothing stays between them.  Both must have
something to cut: it comes later, or it is the shallower one.  Above its depth no wall is left that a move could gouge;
a pass whose whole wall is cut away was roughing.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Final

from shapely import STRtree
from shapely.geometry import Polygon

from core.controls.judging.contours_and_leads import RowRange, closed_passes, is_closed
from core.controls.judging.repeated_passes import PathKey, path_key
from core.geometry.chords import chords_of
from core.geometry.path import Floats, Path, joined
from core.geometry.piece import Side
from core.tolerance import ON_PATH

MAX_CHORD_ERROR: Final = 1e-3
"""Millimeters by which chords may be off the passes; passes that come nearer than two of them share a wall."""


MIN_POINTS: Final = 4
"""Fewest points that enclose something, the first one again at the end; a move shorter than CLOSED has two."""


@dataclass(frozen=True, eq=False, slots=True)
class ClosedPass:
    """A closed run of moves, the heights of its lowest and highest point, and what it encloses.

    The region is empty if the run crosses itself: then it cuts nothing away, and nothing cuts it away.
    """

    path: Path
    region: Polygon
    low: float
    high: float

    @property
    def numbers(self) -> tuple[float, float]:
        """The numbers of its first and last move."""
        return float(self.path.numbers[0]), float(self.path.numbers[-1])


@dataclass(frozen=True, eq=False, slots=True)
class StandingWall:
    """A wall from its lowest point up to the height above which another pass cuts it away, if one does.

    `cut_away_by` has the numbers of that pass's first and last move.
    """

    path: Path
    low: float = -inf
    top: float = inf
    cut_away_by: tuple[float, float] | None = None

    @property
    def stands(self) -> bool:
        """False for a roughing pass: nothing of its wall stays."""
        return self.top > self.low + ON_PATH

    @property
    def numbers(self) -> tuple[float, float]:
        """The numbers of its first and last move."""
        return float(self.path.numbers[0]), float(self.path.numbers[-1])


def closed_passes_of(path: Path, contours: Sequence[RowRange], heights: Floats) -> list[ClosedPass]:
    """Return the passes of the closed contours; `heights` (n, 2) has those of both ends of each piece of the path."""
    return [
        ClosedPass(
            path.part(first, last),
            _region(path.part(first, last)),
            float(heights[first:last].min()),
            float(heights[first:last].max()),
        )
        for contour in contours
        if is_closed(path, contour)
        for first, last in closed_passes(path, contour)
    ]


def _region(path: Path) -> Polygon:
    """Return what a closed run of pieces encloses; an empty region if it crosses itself."""
    chords = chords_of(path, MAX_CHORD_ERROR)
    region = Polygon(chords) if len(chords) >= MIN_POINTS else Polygon()
    return region if region.is_valid and region.area > 0.0 else Polygon()


def standing_walls(passes: Sequence[ClosedPass], side: Side, radius: float) -> list[StandingWall]:
    """Return the walls of passes in the order of the program; passes of one shape at several heights make one wall."""
    shapes = defaultdict[PathKey, list[int]](list)
    for row, each in enumerate(passes):
        shapes[path_key(each.path)].append(row)
    walls, runs = list[StandingWall](), list(shapes.values())
    regions = [passes[rows[0]].region for rows in runs]
    tree = STRtree(regions)
    for rows, region in zip(runs, regions, strict=True):
        path = joined([passes[row].path for row in rows])
        near = sorted(tree.query(region).tolist())
        cutting = [row for each in near if _cuts_away(region, regions[each], side, radius) for row in runs[each]]
        others = [_lowest(row, passes, cutting) for row in rows]
        low = min(passes[row].low for row in rows)
        highest = None if None in others else max((each for each in others if each), key=lambda other: other.high)
        if highest is None:
            walls.append(StandingWall(path, low))
        else:
            walls.append(StandingWall(path, low, highest.high, highest.numbers))
    return walls


def _lowest(row: int, passes: Sequence[ClosedPass], cutting: Sequence[int]) -> ClosedPass | None:
    """Return the lowest of the passes `cutting` the wall of pass `row` away, later or from above; None without one."""
    others = [passes[index] for index in cutting if index > row or passes[index].high > passes[row].low + ON_PATH]
    return min(others, key=lambda other: other.high, default=None)


def _cuts_away(wall: Polygon, other: Polygon, side: Side, radius: float) -> bool:
    """True if the other pass lies within the material of the wall, at most a cutter's diameter behind it."""
    if wall.exterior.distance(other.exterior) <= 2.0 * MAX_CHORD_ERROR:
        return False
    counterclockwise = bool(wall.exterior.is_ccw)
    if counterclockwise != other.exterior.is_ccw:
        return False
    reach = 2.0 * (radius + MAX_CHORD_ERROR)
    if counterclockwise is (side is Side.LEFT):  # the cutter runs inside
        return bool(other.contains(wall) and wall.contains(other.buffer(-reach)))
    return bool(wall.contains(other) and other.buffer(reach).contains(wall))
