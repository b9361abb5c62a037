"""The input of a run: its elements in millimeters and radians, where it starts, and how many data are missing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from core.geometry.oriented import OrientedLine
from core.geometry.piece import Point, Turn

LONGEST: Final = 12
"""The most LINEs and ARCs that are solved together."""

COUNTED: Final = (
    "x_end",
    "y_end",
    "x_end_inc",
    "y_end_inc",
    "length",
    "angle",
    "x_center",
    "y_center",
    "x_center_inc",
    "y_center_inc",
    "radius",
    "sweep",
    "start_angle",
    "point",
    "parallel",
    "offset",
    "link",
)
"""What counts as one datum each."""


Parallel = int | OrientedLine
"""PARALLEL TO: the index of the line in the run, or the line itself where it lies before the run."""


@dataclass(frozen=True)
class Element:
    """A LINE (`turn` NONE) or an ARC of a run.

    `typed` are its data by name; `link` is the angle from the heading at the end of the element before to its own,
    0 for TANGENT, None where nothing is typed about it.
    """

    number: int
    turn: Turn
    typed: tuple[tuple[str, float], ...] = ()
    link: float | None = None
    parallel: Parallel | None = None

    @cached_property
    def known(self) -> Mapping[str, float]:
        """The data by name, in millimeters and radians; relative ones with the ending `_inc`."""
        return dict(self.typed)

    @property
    def point(self) -> Point | None:
        """The point that the element's line passes at DISTANCE, or that lies on its circle."""
        if "point_x" in self.known and "point_y" in self.known:
            return self.known["point_x"], self.known["point_y"]
        return None

    @property
    def unknowns(self) -> int:
        """How many numbers determine it once its start is known."""
        return 3 if self.turn else 2

    @cached_property
    def data(self) -> tuple[str, ...]:
        """What is typed of it, each of which counts as one."""
        present = set(self.known) & set(COUNTED)
        extra = {"point": self.point, "parallel": self.parallel, "link": self.link}
        present |= {name for name, value in extra.items() if value is not None}
        return tuple(name for name in COUNTED if name in present)


@dataclass(frozen=True)
class Run:
    """Elements that are solved together: from `start`, behind a piece that ends in direction `heading`."""

    start: Point
    heading: float | None
    elements: tuple[Element, ...]

    @property
    def missing(self) -> int:
        """How many more data it takes at least; 0 or less where there are enough."""
        return sum(element.unknowns - len(element.data) for element in self.elements)

    @property
    def enough(self) -> bool:
        """Whether there may be enough data: for the whole run, and for its end whatever comes before that."""
        rest = 0
        for element in reversed(self.elements):
            rest += element.unknowns - len(element.data)
            if rest > 0:
                return False
        return True

    @property
    def size(self) -> float:
        """The largest coordinate difference among its typed points, at least its largest typed length."""
        xs, ys, sizes = [self.start[0]], [self.start[1]], [0.0]
        for element in self.elements:
            known = element.known
            xs += [known[name] for name in ("x_end", "x_center", "point_x") if name in known]
            ys += [known[name] for name in ("y_end", "y_center", "point_y") if name in known]
            sizes += [known[name] for name in ("length", "radius") if name in known]
        return max(max(xs) - min(xs), max(ys) - min(ys), *sizes)
