"""This module defines the input of a run: its elements in millimeters and radians, its start and its missing data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from core.geometry.oriented import OrientedLine
from core.geometry.piece import Point, Turn

MAX_RUN_LENGTH: Final = 12
"""The largest number of LINEs and ARCs that are solved together."""

POINT_FIELDS: Final = frozenset(("point_x", "point_y", "point_dist"))
"""The data that count as one together, as far as they give a point."""


Parallel = int | OrientedLine
"""PARALLEL TO: the index of the line in the run, or the line itself if it lies before the run."""


@dataclass(frozen=True)
class Element:
    """A LINE (`turn` NONE) or an ARC of a run.

    `typed` are its data by name.  `link` is the angle from the final heading of the element before to its own initial
    heading: 0 for TANGENT, None if nothing is typed about it.
    """

    number: int
    turn: Turn
    typed: tuple[tuple[str, float], ...] = ()
    link: float | None = None
    parallel: Parallel | None = None

    @cached_property
    def known(self) -> Mapping[str, float]:
        """The data by name, in millimeters and radians; names of relative data end in `_inc`."""
        return dict(self.typed)

    @property
    def point(self) -> Point | None:
        """The point that the element's line passes at DISTANCE, or that its circle passes through."""
        if "point_x" in self.known and "point_y" in self.known:
            return self.known["point_x"], self.known["point_y"]
        return None

    @property
    def missing(self) -> int:
        """The number of values that it needs beside its start and its typed data; negative if more are typed."""
        relations = sum(value is not None for value in (self.point, self.parallel, self.link))
        return (3 if self.turn else 2) - len(self.known.keys() - POINT_FIELDS) - relations


@dataclass(frozen=True)
class Run:
    """Elements that are solved together, from `start`, after a piece that ends in direction `heading`."""

    start: Point
    heading: float | None
    elements: tuple[Element, ...]

    @property
    def missing(self) -> int:
        """The least number of data still needed; 0 or less if there are enough."""
        return sum(element.missing for element in self.elements)

    @property
    def enough(self) -> bool:
        """True if the data may suffice: counted for the whole run, and for its last elements, however many."""
        rest = 0
        for element in reversed(self.elements):
            rest += element.missing
            if rest > 0:
                return False
        return True

    @property
    def size(self) -> float:
        """The greatest of the X and Y ranges of its typed points and its typed lengths and radii."""
        xs, ys, sizes = [self.start[0]], [self.start[1]], [0.0]
        for element in self.elements:
            known = element.known
            xs += [known[name] for name in ("x_end", "x_center", "point_x") if name in known]
            ys += [known[name] for name in ("y_end", "y_center", "point_y") if name in known]
            sizes += [known[name] for name in ("length", "radius") if name in known]
        return max(max(xs) - min(xs), max(ys) - min(ys), *sizes)
