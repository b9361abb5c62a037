"""View: the part of the plane that a window of character cells shows.

A terminal's cell counts as twice as high as it is wide.  The scale is millimeters per cell width, so that a
view stays the same when the drawing mode changes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from core.draw.scene import Box
from core.geometry.piece import Point

CELL_HEIGHT: Final = 2.0
"""A cell's height over its width."""
FINEST_SCALE: Final = 1e-7
COARSEST_SCALE: Final = 1e8
BEYOND_PART: Final = 1 / 7
"""Share of the window that may lie beyond the workpiece on each side."""
MARGIN_SHARE: Final = 0.04
"""Share of the window that `fit` leaves free on each side."""


@dataclass(frozen=True, slots=True)
class View:
    """`center` (x, y) in millimeters is in the middle of the window; `scale` is millimeters per cell width."""

    center: Point = (0.0, 0.0)
    scale: float = 1.0

    @staticmethod
    def fit(bounds: Box | None, columns: int, rows: int) -> View:
        """Return the largest view of `bounds` in columns x rows cells, with a margin; None gives a view around zero."""
        x0, y0, x1, y1 = bounds or (-1.0, -1.0, 1.0, 1.0)
        width, height = max(columns, 1) * (1 - 2 * MARGIN_SHARE), max(rows, 1) * CELL_HEIGHT * (1 - 2 * MARGIN_SHARE)
        scale = max((x1 - x0) / width, (y1 - y0) / height)
        return View(((x0 + x1) / 2, (y0 + y1) / 2), _limited_scale(scale) if scale > 0.0 else 2.0 / width)

    def zoom(self, factor: float, about: Point | None = None) -> View:
        """Return the view enlarged by `factor` about a point (mm), else the window's center, within sensible limits."""
        scale = _limited_scale(self.scale / factor)
        if about is None:
            return View(self.center, scale)
        (x, y), part = self.center, 1.0 - scale / self.scale
        return View((x + part * (about[0] - x), y + part * (about[1] - y)), scale)

    def pan(self, dx: float, dy: float, columns: int, rows: int) -> View:
        """Return the view moved over the part by fractions of the window: dx to the right, dy up."""
        x, y = self.center
        return View((x + dx * columns * self.scale, y + dy * rows * CELL_HEIGHT * self.scale), self.scale)

    def centered_on(self, point: Point, bounds: Box, columns: int, rows: int) -> View:
        """Return the view centered on a point (mm), but no farther beyond `bounds` than a seventh of the window."""
        half = columns * self.scale / 2, rows * CELL_HEIGHT * self.scale / 2
        x, y = (
            _limited_center(value, low, high, room)
            for value, low, high, room in zip(point, bounds[:2], bounds[2:], half, strict=True)
        )
        return View((x, y), self.scale)

    def is_near(self, bounds: Box, times: float) -> bool:
        """True if the window's center is within `times` the larger side of `bounds` from its center, in X and in Y."""
        (x, y), (x0, y0, x1, y1) = self.center, bounds
        limit = times * max(x1 - x0, y1 - y0, FINEST_SCALE)
        return abs(x - (x0 + x1) / 2) <= limit and abs(y - (y0 + y1) / 2) <= limit

    def at(self, column: float, row: float, columns: int, rows: int) -> Point:
        """Return the point (mm) at a position in the window: (0, 0) is top left, (0.5, 0.5) the first cell's middle."""
        x, y = self.center
        return x + (column - columns / 2) * self.scale, y - (row - rows / 2) * CELL_HEIGHT * self.scale

    def cell(self, point: Point, columns: int, rows: int) -> tuple[float, float]:
        """Return (column, row) of a point (mm), fractions included: the inverse of `at`."""
        (x, y), (px, py) = self.center, point
        return (px - x) / self.scale + columns / 2, (y - py) / (CELL_HEIGHT * self.scale) + rows / 2


def _limited_center(value: float, low: float, high: float, half_window: float) -> float:
    """Return a window's middle, `half_window` from its edges, moved so that little beyond low and high is visible."""
    first, last = low + half_window * (1.0 - 2.0 * BEYOND_PART), high - half_window * (1.0 - 2.0 * BEYOND_PART)
    return min(max(value, min(first, last)), max(first, last))


def _limited_scale(scale: float) -> float:
    return min(max(scale, FINEST_SCALE), COARSEST_SCALE)
