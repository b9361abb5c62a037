"""Moves are what a control's axes do, in one neutral form for every control, as immutable numpy arrays.

Units are millimeters and millimeters per minute.  A move goes from the end of the row before it to its own point; row 0
is the start point, a rapid of line 0.  An arc's direction is seen from the positive side of the axis across its plane;
an arc that ends where it starts is a full circle; an arc that also moves along that axis is a helix.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from struct import Struct
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import EMPTY, Flags, Floats, Path, runs_of
from core.tolerance import JOINED, ON_PATH

Point3 = tuple[float, float, float]


class Plane(IntEnum):
    """The plane of an arc and of compensation, named by its first and second axis."""

    XY = 0
    ZX = 1
    YZ = 2

    @property
    def axes(self) -> tuple[int, int, int]:
        """The indices (of x, y, z: 0, 1, 2) of the plane's first and second axis and of the axis across it."""
        return _AXES[self]


_AXES: Final = ((0, 1, 2), (2, 0, 1), (1, 2, 0))


def without_rounding(end: Sequence[float], here: Sequence[float]) -> Point3:
    """Return the end of a move; each coordinate that differs from that of `here` by a rounding only becomes equal."""
    x, y, z = (old if abs(new - old) <= JOINED else new for new, old in zip(end, here, strict=True))
    return x, y, z


def flat(point: Point3, plane: Plane) -> Point3:
    """Return a point's first and second coordinate in a plane, and the one across it."""
    first, second, third = _AXES[plane]
    return point[first], point[second], point[third]


def solid(first: float, second: float, third: float, plane: int) -> Point3:
    """Return the point (x, y, z) with these coordinates in a plane: the inverse of `flat`."""
    if plane == Plane.XY:
        return first, second, third
    return (second, third, first) if plane == Plane.ZX else (third, first, second)


@dataclass(frozen=True, slots=True)
class Move:
    """One move: `turn` 0 is a line, +1 counterclockwise, -1 clockwise; `feed` is 0 where none was given."""

    point: Point3
    center: Point3
    turn: int
    plane: Plane
    rapid: bool
    feed: float
    line: int


@dataclass(frozen=True, eq=False, slots=True)
class Moves:
    """n moves, the start point first.

    `points`, `centers` (n, 3) of x, y, z; a line has its own end as center.  `turns` (n,) 0 line, +1 counterclockwise,
    -1 clockwise.  `planes` (n,) values of `Plane`.  `rapid` (n,) bool.  `feeds` (n,).  `lines` (n,) of the program,
    from 1; 0 for the start point.
    """

    points: Floats
    centers: Floats
    turns: NDArray[np.int8]
    planes: NDArray[np.int8]
    rapid: NDArray[np.bool_]
    feeds: Floats
    lines: NDArray[np.int32]

    def __post_init__(self) -> None:
        for name in self.__slots__:
            getattr(self, name).flags.writeable = False

    def __len__(self) -> int:
        return len(self.turns)

    def __getitem__(self, index: int) -> Move:
        """Return move `index` as plain numbers."""
        x, y, z = self.points[index].tolist()
        cx, cy, cz = self.centers[index].tolist()
        plane = Plane(int(self.planes[index]))
        turn, rapid = int(self.turns[index]), bool(self.rapid[index])
        return Move((x, y, z), (cx, cy, cz), turn, plane, rapid, float(self.feeds[index]), int(self.lines[index]))

    def __iter__(self) -> Iterator[Move]:
        return (self[index] for index in range(len(self)))

    def part(self, first: int, last: int) -> Moves:
        """Return rows first ... last - 1; row `first` becomes the start point."""
        return Moves(*(getattr(self, name)[first:last] for name in self.__slots__))

    def runs(self, flags: Flags) -> Iterator[Moves]:
        """Yield each run of consecutive flagged moves, after the point where it starts; row 0 is no move."""
        return (self.part(int(rows[0]), int(rows[-1]) + 2) for rows in runs_of(flags[1:]))

    def low(self, top: float) -> Flags:
        """Return (n,) flags of the rows that start and end no higher than `top`; the start point is none."""
        low: Flags = self.points[:, 2] <= top + ON_PATH
        low[1:] &= low[:-1]
        low[:1] = False
        return low

    def moving_in(self, plane: Plane) -> Flags:
        """Return (n,) flags of the rows that move in a plane."""
        flat = self.points[:, list(plane.axes[:2])]
        moving: Flags = self.turns != 0
        moving[1:] |= np.any(flat[1:] != flat[:-1], axis=1)
        moving[:1] = False
        return moving

    def path(self, plane: Plane = Plane.XY) -> Path:
        """Return the moves as seen on a plane, numbered by their lines; arcs of other planes become straight."""
        first, second, _ = plane.axes
        ends = self.points[:, [first, second]]
        if len(ends) < 2:
            return EMPTY
        turns, moving = self._turning_and_moving(plane)
        points = np.vstack((ends[:1], ends[1:][moving]))
        centers, numbers = self.centers[1:][moving][:, [first, second]], self.lines[1:][moving].astype(np.float64)
        return Path.of(points, centers, turns[moving], numbers)

    def heights(self) -> Floats:
        """Return (n, 2) the heights of both ends of each piece of `path()`."""
        _, moving = self._turning_and_moving(Plane.XY)
        return np.column_stack((self.points[:-1, 2], self.points[1:, 2]))[moving]

    def _turning_and_moving(self, plane: Plane) -> tuple[NDArray[np.int8], Flags]:
        """Return the turns of the moves as seen on a plane, and flags of those that move there, without the start."""
        ends = self.points[:, list(plane.axes[:2])]
        turns = np.where(self.planes[1:] == plane, self.turns[1:], 0).astype(np.int8)
        return turns, np.any(ends[1:] != ends[:-1], axis=1) | (turns != 0)


_ROW: Final = Struct("=6dbb?di")
_POINT: Final = Struct("=3d")
_TABLE: Final = np.dtype("3f8,3f8,i1,i1,?,f8,i4")
"""A row of a tape, as `_ROW` packs it: one of each array of `Moves`, in their order."""


class Tape:
    """Records moves, as packed rows.

    While `lost` is set, the tool axis is at a machine position: the height of the moves recorded then is not known, and
    their rows are kept in `unplaced`.
    """

    __slots__ = ("_packed", "lost", "unplaced")

    def __init__(self, start: Point3 = (0.0, 0.0, 0.0)) -> None:
        self._packed = bytearray()
        self.lost = False
        self.unplaced = set[int]()
        self.straight(start, 0.0, 0, rapid=True)

    def __len__(self) -> int:
        return len(self._packed) // _ROW.size

    @property
    def last(self) -> Point3:
        """The position of the axes."""
        x, y, z = _POINT.unpack_from(self._packed, len(self._packed) - _ROW.size)
        return x, y, z

    def straight(self, end: Point3, feed: float, line: int, *, rapid: bool = False) -> None:
        """Record a straight move."""
        self._note_lost()
        self._packed += _ROW.pack(*end, *end, 0, 0, rapid, feed, line)

    def arc(
        self, end: Point3, center: Point3, turn: int, plane: int, feed: float, line: int, *, rapid: bool = False
    ) -> None:  # fmt: skip
        """Record an arc or a helix."""
        self._note_lost()
        self._packed += _ROW.pack(*end, *center, turn, plane, rapid, feed, line)

    def _note_lost(self) -> None:
        if self.lost:
            self.unplaced.add(len(self))

    def cut(self, rows: int) -> None:
        """Drop all moves after the given number of rows."""
        del self._packed[rows * _ROW.size :]
        self.unplaced = {row for row in self.unplaced if row < rows}

    def moves(self) -> Moves:
        """Return everything recorded so far."""
        table = np.frombuffer(bytes(self._packed), _TABLE)
        return Moves(*(np.ascontiguousarray(table[name]) for name in _TABLE.names or ()))
