"""The verdict's words: what a center path does to a surface.  Millimeters throughout."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf, isnan, nan
from typing import Any, Final, overload

import numpy as np
from numpy.typing import NDArray

from core.geometry.path_parts import PartEnds
from core.geometry.piece import Point


@dataclass(frozen=True, slots=True)
class Gouge:
    """One stretch of the center path nearer to the surface than the radius, told by its deepest point.

    `depth` is how far the cutter reaches behind the surface there: the radius less the center's distance from it, and
    where the center itself is on the part's side the radius and that distance.  The stretch ends where the center is
    the radius away again; where that is behind the surface, all of the cutter is, and it is told twice the radius
    deep however far the path goes on: `wrong_side` tells the moves.  Beside an open contour nothing is behind where
    one of its ends is nearest, and where its arms contradict each other a move's side is asked for at 63 places
    between any two at which it meets a wall.  Where a contour crosses itself the sides of its walls contradict each
    other: distances alone count there, and no depth is larger than the radius.

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
    """The least distance from path to surface, and the first place along the path that is so near.

    `at` is the center there, `surface_at` the surface point, `surface_number` the contour's segment.
    """

    distance: float
    at: Point
    surface_at: Point
    surface_number: float


@dataclass(frozen=True, slots=True)
class Uncut:
    """One stretch of the surface that no point of the path reaches: segments it begins and ends on, and its ends.

    `thickness` is the largest distance from the stretch to the swept area, met at `thickest`.  `area` is what lies
    between both, square millimeters; None where the stretch ends at the contour's end, or where the cutter moves on
    while it is away from it.
    """

    first_number: float
    last_number: float
    start: Point
    end: Point
    length: float
    thickness: float
    thickest: Point
    area: float | None = None


class UncutStretches(Sequence[Uncut]):
    """k stretches in the contour's order, held as columns (k,): there may be as many as a contour has corners."""

    __slots__ = ("columns", "length", "thickness")

    def __init__(self, *columns: NDArray[Any]) -> None:
        """Columns in the order of the fields of `Uncut`; points are complex numbers."""
        self.columns = columns
        self.length: NDArray[np.float64] = columns[4]
        self.thickness: NDArray[np.float64] = columns[5]

    def __len__(self) -> int:
        return len(self.length)

    @overload
    def __getitem__(self, index: int) -> Uncut: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Uncut, ...]: ...

    def __getitem__(self, index: int | slice) -> Uncut | tuple[Uncut, ...]:
        if isinstance(index, slice):
            return tuple(self[row] for row in range(*index.indices(len(self))))
        row = range(len(self))[index]
        return next(_stretches(column[row : row + 1] for column in self.columns))

    def __iter__(self) -> Iterator[Uncut]:
        return _stretches(self.columns)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    @property
    def ends(self) -> PartEnds:
        """Each stretch's first segment and the point on it, its last segment and the point on that."""
        first, last, start, end = self.columns[:4]
        return PartEnds(first, start, last, end)

    def keep(self, chosen: NDArray[np.bool_]) -> UncutStretches:
        """The stretches for which `chosen` (k,) is True."""
        return self if chosen.all() else UncutStretches(*(column[chosen] for column in self.columns))

    def over_start(self, area: float) -> UncutStretches:
        """A closed contour's first and last stretch as the one they are, standing last, with its area."""
        first, last = self[0], self[-1]
        thicker = max(last, first, key=lambda stretch: stretch.thickness)
        both = (
            last.first_number,
            first.last_number,
            complex(*last.start),
            complex(*first.end),
            last.length + first.length,
            thicker.thickness,
            complex(*thicker.thickest),
            area,
        )
        columns = zip(self.columns, both, strict=True)
        return UncutStretches(*(np.append(column[1:-1], value) for column, value in columns))


def _stretches(columns: Iterable[NDArray[Any]]) -> Iterator[Uncut]:
    """The stretches of columns (k,) one by one."""
    firsts, lasts, starts, ends, lengths, thicknesses, thickest, areas = columns
    known = (None if isnan(area) else area for area in areas.tolist())
    plain = (lengths.tolist(), thicknesses.tolist(), _points(thickest))
    return map(Uncut, firsts.tolist(), lasts.tolist(), _points(starts), _points(ends), *plain, known)


def _points(points: NDArray[np.complex128]) -> Iterator[Point]:
    return zip(points.real.tolist(), points.imag.tolist(), strict=True)


NOTHING: Final = UncutStretches(
    *(np.zeros(0, kind) for kind in (float, float, complex, complex, float, float, complex, float))
)
"""No stretches."""


@dataclass(frozen=True, slots=True)
class UnevenArc:
    """An arc that cannot be judged: its radii at both ends differ by so much, which is infinite where nobody knows
    whether it is empty or a full circle."""

    number: float
    difference: float
    on_surface: bool


@dataclass(frozen=True, slots=True)
class OverRun:
    """Where a contour's first and last element meet, `at`, and how long what lies before and behind that is: leads.

    `first_number` and `last_number` are those of the pieces that meet.  `doubtful` is one lead alone that is so long a
    part of its segment that it may be a wall: the contour's other end, START or the last one, lies on that segment and
    may be mistyped.  `lead_numbers` are those of all leads, where they are so long that they may be walls.
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
    """What one center path does to one surface.

    `closest` is where the path comes nearest to the surface, None for an empty path; gouges are deepest first, uncut
    stretches in the contour's order.  `wrong_side` lists rows of the path that are behind the surface somewhere,
    on the part's side of what is nearest to them, by more than GOUGE: all of them where a closed contour does not cross
    itself; beside any other those that meet a wall, and those that are so at their ends, in their middles or where
    they gouge most.
    `loose` are rows that may be farther from the surface than the radius somewhere, lead moves among them, and
    `backwards` rows that run against all walls they touch.
    `crossing_at` is the first place where the surface crosses or touches itself.  There is an `over_run` where its
    first and its last element meet, and nothing else, if what lies beyond is clear of the part: that is judged as
    lead-in and lead-out and is no surface.  `radius_slack` is how much the uneven radii of arcs add to the tolerance at
    most.
    `judged` is False, and `clearance` not a number, where coordinates or radius are no lengths a machine could have or
    an arc, `uneven_arc`, has two clearly different radii: nothing is known then.
    """

    radius: float
    closest: Approach | None
    gouges: tuple[Gouge, ...]
    uncut: UncutStretches
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
        """The least distance from path to surface, infinite for an empty path and no number if nothing is judged."""
        if not self.judged:
            return nan
        return inf if self.closest is None else self.closest.distance

    @property
    def clean(self) -> bool:
        """All is judged, nothing is gouged and nothing runs on the wrong side."""
        return self.judged and not self.gouges and not self.wrong_side

    @property
    def depth(self) -> float:
        """Depth of the deepest gouge, 0 if there is none."""
        return self.gouges[0].depth if self.gouges else 0.0

    @property
    def uncut_length(self) -> float:
        """Length of surface that is not reached."""
        return float(self.uncut.length.sum())
