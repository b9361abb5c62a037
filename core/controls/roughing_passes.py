"""Roughing passes are closed contours that a later pass of the same stretch cuts away, one step of the cutter deeper.

A bore is opened circle by circle, a boss is cut down to size: what the earlier passes leave is no wall of the part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from shapely.geometry import Polygon

from core.controls.contours_and_leads import RowRange, closed_passes, is_closed
from core.geometry.chords import chords_of
from core.geometry.path import Path
from core.geometry.piece import Side

MAX_CHORD_ERROR: Final = 1e-3
"""Millimeters by which chords may be off the passes; passes that come nearer than two of them share a wall."""


MIN_POINTS: Final = 4
"""Fewest points that enclose something, the first one again at the end; a move shorter than CLOSED has two."""


@dataclass(frozen=True, slots=True)
class RoughingPass:
    """A pass and the later one that cuts it away, by the numbers of their first and last moves; `rows` are its own.

    `later_starts` are the numbers of the first moves of the later pass and of its repeats, at other heights perhaps.
    """

    rows: RowRange
    numbers: tuple[float, float]
    later_numbers: tuple[float, float]
    later_starts: tuple[float, ...]


def without_roughing_passes(
    path: Path, contours: Sequence[RowRange], side: Side, radius: float
) -> tuple[tuple[RowRange, ...], tuple[RoughingPass, ...]]:
    """Return the contours that later passes leave, ascending, and the passes that they cut away.

    The later pass runs the same way around, shares no wall with the earlier one, and lies at most a cutter's diameter
    deeper, so that nothing stays between them.  A pass that misses this is a wall.
    """
    passes = [rows for contour in contours for rows in closed_passes(path, contour)]
    regions = [_region(path, rows) for rows in passes]
    kept, roughing = list[RowRange](), list[RoughingPass]()
    for index, rows in enumerate(passes):
        rest = list(zip(passes[index + 1 :], regions[index + 1 :], strict=True))
        later = next((each for each in rest if _cuts_away(regions[index], each[1], side, radius)), None)
        if later is None:
            kept.append(rows)
        else:
            starts = tuple(_ends(path, other)[0] for other, region in rest if region is not None and region == later[1])
            roughing.append(RoughingPass(rows, _ends(path, rows), _ends(path, later[0]), starts))
    return (tuple(kept), tuple(roughing)) if roughing else (tuple(contours), ())


def _ends(path: Path, rows: RowRange) -> tuple[float, float]:
    return float(path.numbers[rows[0]]), float(path.numbers[rows[1] - 1])


def _region(path: Path, rows: RowRange) -> Polygon | None:
    """Return what a closed run of pieces encloses; None if it is open or crosses itself."""
    if not is_closed(path, rows):
        return None
    chords = chords_of(path.part(*rows), MAX_CHORD_ERROR)
    if len(chords) < MIN_POINTS:
        return None
    region = Polygon(chords)
    return region if region.is_valid and region.area > 0.0 else None


def _cuts_away(earlier: Polygon | None, later: Polygon | None, side: Side, radius: float) -> bool:
    """True if the second pass lies within the material of the first one, at most a cutter's diameter deeper."""
    if earlier is None or later is None or earlier.exterior.distance(later.exterior) <= 2.0 * MAX_CHORD_ERROR:
        return False
    counterclockwise = bool(earlier.exterior.is_ccw)
    if counterclockwise != later.exterior.is_ccw:
        return False
    if counterclockwise is (side is Side.LEFT):  # the cutter runs inside
        return bool(later.contains(earlier) and earlier.contains(later.buffer(-2.0 * radius)))
    return bool(earlier.contains(later) and later.buffer(2.0 * radius).contains(earlier))
