"""Path: a chain of exact lines and arcs, joined end to start, as immutable numpy arrays.

The one representation of geometry for ten pieces and for a hundred thousand.  A path of n pieces has
n + 1 points, so that it is joined by construction.  Millimeters and radians, right-handed XY.

Calculations with arrays of pieces take points as complex numbers x + iy (`as_complex`) and pieces that need not join
(`Pieces`): the real part of conj(u) v is the dot product of u and v, the imaginary part their cross product.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi, tau
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.geometry.piece import ANGLE_ROUNDING, Arc, Line, Piece, Point, Turn
from core.tolerance import LARGEST_COORDINATE

Floats = NDArray[np.float64]
Points = NDArray[np.complex128]
Rows = NDArray[np.intp]
Flags = NDArray[np.bool_]
Turns = NDArray[np.int8]

_QUARTERS: Final = np.array([[tau / 2], [3 * tau / 4], [0.0], [tau / 4]])
"""(4, 1) the angles of a circle's leftmost, lowest, rightmost and highest point, in radians."""


@dataclass(frozen=True, eq=False, slots=True)
class Path:
    """n joined pieces.

    `points` (n + 1, 2): piece i runs from row i to row i + 1.  `centers` (n, 2): of arcs; a line has its own
    start there.  `turns` (n,): 0 line, +1 counterclockwise, -1 clockwise.  `numbers` (n,): the programmed
    segment k each piece belongs to, k + 1/2 for the corner arc between k and k + 1.  An arc whose two points
    are the same row of numbers is a full circle.  The empty path has one point or none.
    """

    points: Floats
    centers: Floats
    turns: Turns
    numbers: Floats

    def __post_init__(self) -> None:
        for array in (self.points, self.centers, self.turns, self.numbers):
            array.setflags(write=False)

    @staticmethod
    def of(points: Floats, centers: Floats, turns: Turns, numbers: Floats | None = None) -> Path:
        """Make a path of these arrays, made contiguous; the centers of lines may be anything but are their starts then.

        Numbers are 1 ... n unless given.
        """
        points, turns = np.ascontiguousarray(points, np.float64).reshape(-1, 2), np.ascontiguousarray(turns, np.int8)
        numbers = np.arange(1.0, len(turns) + 1.0) if numbers is None else np.ascontiguousarray(numbers, np.float64)
        own_centers = np.asarray(centers, np.float64).reshape(-1, 2)
        return Path(points, np.where(turns[:, None] == 0, points[:-1], own_centers), turns, numbers)

    @staticmethod
    def from_pieces(pieces: Sequence[Piece], numbers: Sequence[float] | None = None) -> Path:
        """Make the path of pieces that join end to start; each piece starts at the end of the piece before it."""
        if not pieces:
            return EMPTY
        points = [pieces[0].start, *(piece.end for piece in pieces)]
        centers = [piece.center if isinstance(piece, Arc) else piece.start for piece in pieces]
        turns = [piece.turn if isinstance(piece, Arc) else 0 for piece in pieces]
        own_numbers = None if numbers is None else np.array(numbers)
        return Path.of(np.array(points), np.array(centers), np.array(turns), own_numbers)

    def __len__(self) -> int:
        return len(self.turns)

    def __getitem__(self, index: int) -> Piece:
        """Piece `index` as a Line or an Arc of plain numbers."""
        index = range(len(self))[index]
        start, end = self.points[index].tolist(), self.points[index + 1].tolist()
        if not self.turns[index]:
            return Line(tuple(start), tuple(end))
        return Arc(tuple(start), tuple(end), tuple(self.centers[index].tolist()), Turn(int(self.turns[index])))

    def __iter__(self) -> Iterator[Piece]:
        return (self[index] for index in range(len(self)))

    @property
    def reachable(self) -> bool:
        """True if a machine could have all coordinates; NaN is none of these."""
        return all(bool((np.abs(array) <= LARGEST_COORDINATE).all()) for array in (self.points, self.centers))

    @property
    def starts(self) -> Floats:
        """(n, 2) first point of each piece."""
        return self.points[:-1]

    @property
    def ends(self) -> Floats:
        """(n, 2) last point of each piece."""
        return self.points[1:]

    @property
    def radii(self) -> Floats:
        """(n,) radius of each arc, 0 for a line."""
        radial = self.starts - self.centers
        return np.hypot(radial[:, 0], radial[:, 1])

    @property
    def sweeps(self) -> Floats:
        """(n,) angle traveled by each arc, positive counterclockwise, 0 for a line, a full turn for a circle."""
        return swept(pieces_of(self)) * self.turns

    @property
    def lengths(self) -> Floats:
        """(n,) length of each piece."""
        return lengths(pieces_of(self))

    @property
    def start_directions(self) -> Floats:
        """(n, 2) unit tangent at the start of each piece; (0, 0) for a line without length."""
        return _units(tangents(self)[0])

    @property
    def end_directions(self) -> Floats:
        """(n, 2) unit tangent at the end of each piece; (0, 0) for a line without length."""
        return _units(tangents(self)[1])

    @property
    def boxes(self) -> Floats:
        """(4, n) exact bounding boxes: left, bottom, right, top."""
        return boxes(pieces_of(self))

    def reversed(self) -> Path:
        """Return the same pieces traveled the other way; numbers stay with their pieces."""
        backward = slice(None, None, -1)
        return Path.of(self.points[backward], self.centers[backward], -self.turns[backward], self.numbers[backward])

    def without(self, rows: Rows) -> Path:
        """Return the path without `rows`, pieces of no length; each piece then starts where the one before it ends.

        Full circles stay full.
        """
        kept = np.ones(len(self), np.bool_)
        kept[rows] = False
        points = np.concatenate((self.points[:1], self.points[1:][kept]))
        circles = (self.points[1:] == self.points[:-1]).all(axis=1)[kept].nonzero()[0]
        for row in circles[::-1].tolist():
            points[row] = points[row + 1]
        return Path.of(points, self.centers[kept], self.turns[kept], self.numbers[kept])

    def part(self, first: int, last: int) -> Path:
        """Return pieces first ... last - 1."""
        # rows of contiguous arrays are contiguous: nothing is copied
        keep = slice(first, last)
        return Path(self.points[first : last + 1], self.centers[keep], self.turns[keep], self.numbers[keep])


def tangents(path: Path) -> tuple[Points, Points]:
    """Return the (n,) directions of travel at the starts and at the ends of all pieces, not of unit length."""
    points, centers = as_complex(path.points), as_complex(path.centers)
    chord = points[1:] - points[:-1]
    arcs = path.turns.nonzero()[0]
    if not len(arcs):
        return chord, chord
    first, last = chord.copy(), chord
    across = 1j * path.turns[arcs]
    first[arcs] = across * (points[arcs] - centers[arcs])
    last[arcs] = across * (points[arcs + 1] - centers[arcs])
    return first, last


def _units(directions: Points) -> Floats:
    size = np.abs(directions)
    return coordinates(directions / np.where(size == 0.0, 1.0, size))


def boxes(pieces: Pieces) -> Floats:
    """Return the (4, n) exact bounding boxes: left, bottom, right, top.

    Rounding may decide whether an arc's end lies before or past a quarter point; either way the box moves by no more
    than the last digit, for near that point the arc runs along the box.
    """
    box = np.empty((4, len(pieces.turn)))
    for axis, (start, end) in enumerate(((pieces.start.real, pieces.end.real), (pieces.start.imag, pieces.end.imag))):
        np.minimum(start, end, out=box[axis])
        np.maximum(start, end, out=box[axis + 2])
    rows = pieces.turn.nonzero()[0]
    arcs = pieces.take(rows)
    arm = arcs.start - arcs.center
    ahead = np.mod((_QUARTERS - np.angle(arm)) * arcs.turn, tau)
    center, radius = coordinates(arcs.center).T, np.abs(arm)
    extremes = np.concatenate((center - radius, center + radius))
    box[:, rows] = np.where(ahead <= swept(arcs), extremes, box[:, rows])
    return box


def lengths(pieces: Pieces) -> Floats:
    """Return the (n,) length of each piece."""
    size: Floats = np.abs(pieces.end - pieces.start)
    rows = pieces.turn.nonzero()[0]
    arcs = pieces.take(rows)
    size[rows] = np.abs(arcs.start - arcs.center) * swept(arcs)
    return size


def swept(pieces: Pieces) -> Floats:
    """Return the (n,) angle traveled by each arc, in [0, tau]: a full turn where both ends are equal, 0 for a line.

    An angle a hair less than a full turn is an empty arc plus rounding, and counts as 0.
    """
    turned = (pieces.end - pieces.center) * (pieces.start - pieces.center).conj()
    angle = np.arctan2(turned.imag * pieces.turn, turned.real)
    angle[angle < 0.0] += tau
    angle[(angle > tau - ANGLE_ROUNDING) | np.isnan(angle) | (pieces.turn == 0)] = 0.0
    angle[(pieces.start == pieces.end) & (pieces.turn != 0)] = tau
    return angle


def joined(parts: Sequence[Path]) -> Path:
    """Return one path of paths that join end to start; empty ones are skipped."""
    parts = [part for part in parts if len(part)]
    if len(parts) < 2:
        return parts[0] if parts else EMPTY
    points = [parts[0].points, *(part.points[1:] for part in parts[1:])]
    return Path(
        np.concatenate(points),
        np.concatenate([part.centers for part in parts]),
        np.concatenate([part.turns for part in parts]),
        np.concatenate([part.numbers for part in parts]),
    )


EMPTY = Path(np.empty((0, 2)), np.empty((0, 2)), np.empty(0, np.int8), np.empty(0))
"""The path that has no pieces."""


class Pieces(NamedTuple):
    """k pieces that need not join: ends and centers as complex numbers, turns as in `Path`."""

    start: Points
    end: Points
    center: Points
    turn: Turns

    def take(self, rows: Rows) -> Pieces:
        """Return the pieces of these rows."""
        return Pieces(self.start[rows], self.end[rows], self.center[rows], self.turn[rows])


def as_complex(pairs: Floats) -> Points:
    """Return (n, 2) coordinates as (n,) complex numbers, without a copy if they are contiguous in memory."""
    return np.ascontiguousarray(pairs).view(np.complex128)[:, 0]


def coordinates(points: Points) -> Floats:
    """Return (n,) complex numbers as (n, 2) coordinates, without a copy if they are contiguous in memory."""
    return np.ascontiguousarray(points).view(np.float64).reshape(-1, 2)


def point_of_row(row: Floats) -> Point:
    """Return one row of (n, 2) coordinates as a point."""
    x, y = row.tolist()
    return x, y


def next_in_ring(values: NDArray[Any]) -> NDArray[Any]:
    """Return the successor of each value in a ring; the last one's is the first.  `np.roll` takes 5 times as long."""
    return np.concatenate((values[1:], values[:1]))


def pieces_of(path: Path) -> Pieces:
    """Return the pieces of a path, without a copy."""
    points = as_complex(path.points)
    return Pieces(points[:-1], points[1:], as_complex(path.centers), path.turns)


def runs_of(flags: Flags) -> list[Rows]:
    """Return the rows that have a flag, in groups of consecutive ones."""
    rows = np.flatnonzero(flags)
    return np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else []


def chords_of(path: Path, sag: float) -> Floats:
    """Return the (m, 2) points of a path whose arcs are replaced by chords no farther than `sag` (mm) from them.

    They are for shapely to cut or to measure roughly.
    """
    if not len(path):
        return np.empty((0, 2))
    bent = np.isfinite(path.radii) & (path.radii > sag)
    angles = np.minimum(2.0 * np.arccos(1.0 - sag / np.where(bent, path.radii, sag)), pi / 4)
    counts = np.where(bent, np.maximum(np.ceil(np.abs(path.sweeps) / angles), 1.0), 1.0).astype(np.intp)
    row = np.arange(len(path)).repeat(counts)
    nth = np.arange(len(row)) - (counts.cumsum() - counts)[row]
    part = nth / counts[row]
    starts, ends, centers = (as_complex(points)[row] for points in (path.starts, path.ends, path.centers))
    turned = centers + (starts - centers) * np.exp(1j * path.sweeps[row] * part)
    points = np.where(path.turns[row] != 0, turned, starts + (ends - starts) * part)
    return np.concatenate([coordinates(points), path.points[-1:]])
