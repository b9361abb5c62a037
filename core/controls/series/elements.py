"""Programmed elements as arrays, and the geometry of `corners` on them: the same operations in the same order.

Sums, products, quotients and square roots are rounded alike for one number and for many.  `hypot` and `atan2` of the
array library may differ from the language's own in the last bit, so they are called number by number.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import atan2, hypot
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.controls.compensation.corners import Element
from core.controls.moves import WIDTH, Floats, Plane
from core.controls.series.words import Flags

Rows = NDArray[np.int64] | Flags

Points = tuple[Floats, Floats]
"""x and y, (n,) each, in the coordinates of a plane."""

_element: Final = partial(tuple.__new__, Element)


class Elements(NamedTuple):
    """n elements as `Element` has them, (n,) each; `turn` 0.0, 1.0 or -1.0, `rapid` 1.0 where it is so."""

    start_x: Floats
    start_y: Floats
    end_x: Floats
    end_y: Floats
    center_x: Floats
    center_y: Floats
    turn: Floats
    leaving_x: Floats
    leaving_y: Floats
    arriving_x: Floats
    arriving_y: Floats
    low: Floats
    high: Floats
    rapid: Floats
    feed: Floats
    line: Floats

    @property
    def size(self) -> int:
        """How many there are."""
        return len(self.turn)

    @property
    def start(self) -> Points:
        """Where they start."""
        return self.start_x, self.start_y

    @property
    def end(self) -> Points:
        """Where they end."""
        return self.end_x, self.end_y

    @property
    def center(self) -> Points:
        """The centers of arcs."""
        return self.center_x, self.center_y

    @property
    def leaving(self) -> Points:
        """The directions at their starts."""
        return self.leaving_x, self.leaving_y

    @property
    def arriving(self) -> Points:
        """The directions at their ends."""
        return self.arriving_x, self.arriving_y

    @property
    def moves(self) -> Flags:
        """Which move in the plane."""
        found: Flags = (self.turn != 0.0) | (self.start_x != self.end_x) | (self.start_y != self.end_y)
        return found

    def part(self, first: int, last: int) -> Elements:
        """Elements first ... last - 1."""
        return Elements(*(column[first:last] for column in self))

    def of(self, rows: Rows) -> Elements:
        """The elements of these rows."""
        return Elements(*(column[rows] for column in self))

    def put(self, rows: Rows, others: Elements) -> None:
        """Puts other elements into these rows."""
        for column, other in zip(self, others, strict=True):
            column[rows] = other

    def behind(self, front: Element) -> Elements:
        """These elements with another one before them."""
        return Elements(*(np.concatenate(((one,), column)) for one, column in zip(_flat(front), self, strict=True)))

    def each(self) -> Iterator[Element]:
        """One by one."""
        for row in zip(*(column.tolist() for column in self), strict=True):
            sx, sy, ex, ey, cx, cy, turn, lx, ly, ax, ay, low, high, rapid, feed, line = row
            ends = (sx, sy), (ex, ey), (cx, cy), int(turn), (lx, ly), (ax, ay)
            yield _element((*ends, low, high, rapid == 1.0, feed, int(line), 1))

    def one(self, row: int) -> Element:
        """The element of a row; -1 is the last."""
        return next(self.of(np.array((row,))).each())


def _flat(one: Element) -> tuple[float, ...]:
    ends = (*one.start, *one.end, *one.center, one.turn, *one.leaving, *one.arriving)
    return (*ends, one.low, one.high, one.rapid, one.feed, one.line)


def hypots(x: Floats, y: Floats) -> Floats:
    """Lengths, by the language's own `hypot`."""
    return np.fromiter(map(hypot, x.tolist(), y.tolist()), np.float64, len(x))


def angles(y: Floats, x: Floats) -> Floats:
    """Directions, by the language's own `atan2`."""
    return np.fromiter(map(atan2, y.tolist(), x.tolist()), np.float64, len(x))


def tangents(at: Points, center: Points, turn: Floats) -> Points:
    """Unit directions of travel at points of arcs."""
    dx, dy = at[0] - center[0], at[1] - center[1]
    size = hypots(dx, dy)
    size = np.where(size == 0.0, 1.0, size)
    return -turn * dy / size, turn * dx / size


def squares(at: Points, way: Points, offset: float | Floats) -> Points:
    """The points beside `at`, `offset` to the left of directions."""
    return at[0] - offset * way[1], at[1] + offset * way[0]


def rows(
    end: Points, height: Floats, center: Points, elements: Elements, plane: Plane, *, turn: Floats | None = None
) -> Floats:  # fmt: skip
    """Rows (n, `WIDTH`) of a tape: elements run to other ends and centers; without a turn of their own as they turn."""
    table = np.empty((elements.size, WIDTH))
    first, second, third = plane.axes
    turns = elements.turn if turn is None else turn
    arcs = turns != 0.0
    table[:, first], table[:, second], table[:, third] = end[0], end[1], height
    table[:, 3 + first], table[:, 3 + second] = np.where(arcs, center[0], end[0]), np.where(arcs, center[1], end[1])
    table[:, 3 + third] = height
    table[:, 6], table[:, 7] = turns, np.where(arcs, float(plane), 0.0)
    table[:, 8] = np.where(arcs, 0.0, elements.rapid)
    table[:, 9] = np.where(table[:, 8] == 1.0, 0.0, elements.feed)
    table[:, 10] = elements.line
    return table
