"""The verdict's data types: what a center path does to a surface.  Millimeters throughout."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan

import numpy as np

from core.geometry.path_parts import PartEnds
from core.geometry.piece import Point


@dataclass(frozen=True, slots=True)
class Gouge:
    """A part of the center path nearer to the surface than the radius, reported by its deepest point.

    It ends where the center is the radius away again.  VERDICT.md, "Depth of a gouge", says how the depth is found
    where the center itself is on the part's side.
    """

    depth: float
    """How far the edge of the cutter reaches into the part, at most twice the radius."""
    at: Point
    """The center of the cutter at the deepest point."""
    surface_at: Point
    """The point of the surface that it cuts into there."""
    path_piece: int
    """The row of the judged path's piece with the deepest point."""
    path_number: float
    """The number of that piece."""
    surface_number: float
    """The contour's segment that it cuts into."""
    extent: float
    """The length of the gouging part of the path."""


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
    """A stretch of the surface that the cutter does not reach from any point of its path, or the other way around."""

    first_number: float
    """The segment on which it begins, at `start`."""
    last_number: float
    """The segment on which it ends, at `end`."""
    start: Point
    end: Point
    length: float
    thickness: float
    """The largest distance from the stretch to the area that the cutter sweeps, reached at `thickest`."""
    thickest: Point
    area: float | None = None
    """Square millimeters between the stretch and the swept area.

    None if the stretch ends at the contour's end, or if the cutter does not touch both of its ends from one place.
    """


@dataclass(frozen=True, slots=True)
class UnevenArc:
    """An arc that cannot be judged: its radii at both ends differ by `difference`, which is infinite if the arc may be
    empty or a full circle."""

    number: float
    difference: float
    on_surface: bool


@dataclass(frozen=True, slots=True)
class OverRun:
    """The point `at` where a contour's first and last element meet, with the leads beyond it."""

    at: Point
    lead_in: float
    """The length of the lead before that point."""
    lead_out: float
    """The length of the lead after it."""
    first_number: float
    """The number of the first of the two pieces that meet."""
    last_number: float
    """The number of the last of them."""
    doubtful: bool
    """A single lead is so large a part of its segment that it may be a wall: START or the last end may be mistyped."""
    lead_numbers: tuple[float, ...] = ()
    """The numbers of all leads if they are so long that they may be walls."""


@dataclass(frozen=True, eq=False, slots=True)
class Verdict:
    """The effects of one center path on one surface.  If it is not `judged`, no other value means anything."""

    radius: float
    closest: Approach | None
    """Where the path comes nearest to the surface; None for an empty path."""
    gouges: tuple[Gouge, ...]
    """The deepest first."""
    uncut: tuple[Uncut, ...]
    """In the contour's order."""
    surface_length: float
    crosses_itself: bool
    wrong_side: tuple[int, ...] = ()
    """Rows of the path that are somewhere on the part's side of the nearest wall, by more than GOUGE.

    Complete for a closed contour that does not cross itself.  For any other contour it has the rows that meet a wall,
    and those that are inside the part at their ends, in their middles or where they gouge most.
    """
    may_cut_air: tuple[int, ...] = ()
    """Rows that may be farther from the surface than the radius somewhere, lead moves among them."""
    backwards: tuple[int, ...] = ()
    """Rows that run against the direction of all walls that they touch."""
    crossing_at: Point | None = None
    """The first place where the surface crosses or touches itself."""
    over_run: OverRun | None = None
    """Set if only the first and the last element meet, and the ends beyond that point are clear of the part.

    These ends then count as leads, not as surface.
    """
    radius_slack: float = 0.0
    """The most that the uneven radii of arcs add to the tolerance."""
    judged: bool = True
    """False if a coordinate or the radius is not a length that a machine could have, or if there is an `uneven_arc`."""
    uneven_arc: UnevenArc | None = None
    """An arc with two clearly different radii, which cannot be judged."""

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
