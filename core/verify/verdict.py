"""The verdict's words: what a centre path does to a surface.  Millimetres throughout."""

from __future__ import annotations

from dataclasses import dataclass

from core.geometry.piece import Point


@dataclass(frozen=True, slots=True)
class Gouge:
    """One stretch of the centre path nearer to the surface than the radius, told by its deepest point.

    `at` is the centre there, `surface_at` the surface point it cuts into; `path_piece` is the row of the judged
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
class Uncut:
    """One stretch of the surface that no point of the path reaches: segments it begins and ends on, and its ends.

    `thickness` is the largest distance from the stretch to the swept area, met at `thickest`.
    """

    first_number: float
    last_number: float
    start: Point
    end: Point
    length: float
    thickness: float
    thickest: Point


@dataclass(frozen=True, eq=False, slots=True)
class Verdict:
    """What one centre path does to one surface.

    `clearance` is the least distance from path to surface (infinite for an empty path); gouges are deepest first,
    uncut stretches in the contour's order.  `wrong_side` lists rows of the path that run on the part's side.
    `crossing_at` is the first place where the surface crosses or touches itself.  `judged` is False, and
    `clearance` not a number, where coordinates or radius are no lengths a machine could have or an arc has two clearly
    different radii: nothing is known then.
    """

    radius: float
    clearance: float
    gouges: tuple[Gouge, ...]
    uncut: tuple[Uncut, ...]
    surface_length: float
    crosses_itself: bool
    wrong_side: tuple[int, ...] = ()
    crossing_at: Point | None = None
    judged: bool = True

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
        return sum(stretch.length for stretch in self.uncut)
