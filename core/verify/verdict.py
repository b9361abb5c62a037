"""The verdict's data types: what a center path does to a surface.  Millimeters throughout."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan

import numpy as np

from core.geometry.path_parts import PartEnds
from core.geometry.piece import Point


@dataclass(frozen=True, slots=True)
class Gouge:
    """One stretch of the center path nearer to the surface than the radius, reported by its deepest point.

    `depth` is how far the cutter reaches into the part there: the radius less the center's distance from the surface,
    or the radius plus that distance if the center itself is on the part's side.  The stretch ends where the center is
    the radius away again.  If that is on the part's side, the whole cutter is inside the part: the depth is then twice
    the radius however far the path goes on, and `wrong_side` lists the moves.  An open contour has no part's side where
    one of its ends is the nearest point; where its arms contradict each other, a move's side is tested at 63 places
    between any two at which it meets a wall.  If a contour crosses itself, the sides of its walls contradict each
    other: only distances count then, and no depth is larger than the radius.

    `at` is the center there, `surface_at` the surface point it cuts into; `path_piece` is the row of the judged
    path, `path_number` its number, `surface_number` the contour's segment; `extent` the stretch's length.
    """

    depth: float
    at: Point
    surface_at: Point
    path_piece: int
    path_number: float
    surface_number: float
    extent: float


@dataclass(frozen=True, slots=True)
class Approach:
    """The least distance from path to surface, and the first place along the path with that distance.

    `at` is the center there, `surface_at` the surface point, `surface_number` the contour's segment.
    """

    distance: float
    at: Point
    surface_at: Point
    surface_number: float


@dataclass(frozen=True, slots=True)
class Uncut:
    """One stretch of the surface that the cutter does not reach: the segments it begins and ends on, and its ends.

    `thickness` is the largest distance from the stretch to the swept area, reached at `thickest`.  `area` lies between
    the two, in square millimeters; it is None if the stretch ends at the contour's end, or if the cutter travels
    between its contacts with the stretch's ends."""

    first_number: float
    last_number: float
    start: Point
    end: Point
    length: float
    thickness: float
    thickest: Point
    area: float | None = None


@dataclass(frozen=True, slots=True)
class UnevenArc:
    """An arc that cannot be judged: its radii at both ends differ by `difference`, which is infinite if the arc may be
    empty or a full circle."""

    number: float
    difference: float
    on_surface: bool


@dataclass(frozen=True, slots=True)
class OverRun:
    """The point `at` where a contour's first and last element meet, and the lengths of the leads before and after it.

    `first_number` and `last_number` are those of the pieces that meet.  `doubtful` marks a single lead that takes so
    large a part of its segment that it may be a wall: the contour's other end, START or the last one, lies on that
    segment and may be mistyped.  `lead_numbers` are those of all leads, if they are so long that they may be walls.
    """

    at: Point
    lead_in: float
    lead_out: float
    first_number: float
    last_number: float
    doubtful: bool
    lead_numbers: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Verdict:
    """The effects of one center path on one surface.

    `closest` is where the path comes nearest to the surface, None for an empty path; gouges are deepest first, uncut
    stretches in the contour's order.  `wrong_side` lists rows of the path that are somewhere inside the part, on the
    part's side of the nearest wall, by more than GOUGE.  The list is complete for a closed contour that does not cross
    itself; for any other it has the rows that meet a wall, and those inside the part at their ends, in their middles or
    where they gouge most.
    `loose` are rows that may be farther from the surface than the radius somewhere, lead moves among them, and
    `backwards` rows that run against all walls they touch.
    `crossing_at` is the first place where the surface crosses or touches itself.  There is an `over_run` if only its
    first and its last element meet, and the ends beyond that point are clear of the part: these ends count as lead-in
    and lead-out, not as surface.  `radius_slack` is the most that the uneven radii of arcs add to the tolerance.
    If `judged` is False and `clearance` NaN, nothing is known: a coordinate or the radius is not a length that a
    machine could have, or an arc, `uneven_arc`, has two clearly different radii.
    """

    radius: float
    closest: Approach | None
    gouges: tuple[Gouge, ...]
    uncut: tuple[Uncut, ...]
    surface_length: float
    crosses_itself: bool
    wrong_side: tuple[int, ...] = ()
    loose: tuple[int, ...] = ()
    backwards: tuple[int, ...] = ()
    crossing_at: Point | None = None
    over_run: OverRun | None = None
    radius_slack: float = 0.0
    judged: bool = True
    uneven_arc: UnevenArc | None = None

    @property
    def over_run_at(self) -> Point | None:
        """Where the first and the last element of an over-run meet."""
        return None if self.over_run is None else self.over_run.at

    @property
    def clearance(self) -> float:
        """The least distance from path to surface, infinite for an empty path and NaN if the path is not judged."""
        if not self.judged:
            return nan
        return inf if self.closest is None else self.closest.distance

    @property
    def clean(self) -> bool:
        """True if the path is judged, gouges nothing and nowhere runs on the wrong side."""
        return self.judged and not self.gouges and not self.wrong_side

    @property
    def depth(self) -> float:
        """Depth of the deepest gouge, 0 if there is none."""
        return self.gouges[0].depth if self.gouges else 0.0

    @property
    def uncut_length(self) -> float:
        """Length of surface that the cutter does not reach."""
        return sum((stretch.length for stretch in self.uncut), 0.0)

    @property
    def uncut_ends(self) -> PartEnds:
        """Each uncut stretch's first segment and the start point on it, its last segment and the end point on it."""
        first = np.array([stretch.first_number for stretch in self.uncut], float)
        last = np.array([stretch.last_number for stretch in self.uncut], float)
        start = np.array([complex(*stretch.start) for stretch in self.uncut], complex)
        end = np.array([complex(*stretch.end) for stretch in self.uncut], complex)
        return PartEnds(first, start, last, end)
