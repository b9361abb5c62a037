"""PieceArrays: the pieces of a path as arrays, with the values that exact distances need, calculated once.

Points are complex numbers x + iy.  A place on a piece is the fraction t of the piece traveled so far, 0 to 1;
a place on a whole path is the length s traveled since its first point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import tau
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from core.geometry.construct import on_bisector
from core.geometry.path import EMPTY, Flags, Floats, Path, Pieces, Points, Rows, Turns, boxes, pieces_of, swept
from core.geometry.piece import ANGLE_ROUNDING
from core.tolerance import ON_PATH

FEW_PAIRS: Final = 500
"""Up to this many pairs are calculated at once: that costs less than separating lines from arcs."""

PAIRS_PER_BATCH: Final = 2_000
"""Pairs calculated at a time."""


@dataclass(frozen=True, eq=False, slots=True)
class PieceArrays:
    """n pieces, (n,) arrays each, millimeters and radians.

    `rows` are the pieces' rows in the path they come from.  `vector` is end - start.  `arm` is start - center of an
    arc and 1 of a line, `turn` 0 for a line, `angle` the unsigned angle traveled by an arc and 0 for a line.
    `slack` is how far an arc with two different radii may be from the circle used for it; it is infinite if both ends
    are on one ray from the center, since the arc may then be empty or a full circle.
    """

    rows: Rows
    start: Points
    vector: Points
    arm: Points
    turn: Floats
    angle: Floats
    radius: Floats
    length: Floats
    slack: Floats

    def __len__(self) -> int:
        return len(self.rows)

    def take(self, rows: Rows) -> PieceArrays:
        """Return the pieces of these indices, in their order and with their repetitions."""
        return PieceArrays(*(getattr(self, name).take(rows) for name in self.__slots__))

    @property
    def arcs(self) -> Flags:
        """(n,) True for arcs."""
        curved: Flags = self.turn != 0.0
        return curved

    @property
    def end(self) -> Points:
        """(n,) last points."""
        return self.start + self.vector

    @property
    def center(self) -> Points:
        """(n,) centers of arcs; meaningless for a line."""
        return self.start - self.arm

    @property
    def unit(self) -> Points:
        """(n,) direction of each chord; 0 for one without length."""
        size = np.abs(self.vector)
        return self.vector / np.where(size == 0.0, 1.0, size)

    @property
    def stations(self) -> Floats:
        """(n + 1,) length traveled at the start of each piece, and at the end of the last."""
        stations = np.zeros(len(self.length) + 1)
        self.length.cumsum(out=stations[1:])
        return stations

    @property
    def boxes(self) -> Floats:
        """(4, n) exact bounding boxes: left, bottom, right, top."""
        return boxes(Pieces(self.start, self.end, self.center, self.turn.astype(np.int8)))


FormulaArgument = PieceArrays | Floats | Points
Formula = Callable[..., NDArray[Any]]


def piece_arrays(*paths: Path) -> PieceArrays:
    """Return the pieces of these paths that have a length as one set; a path without any contributes its first piece.

    Rows count all pieces of all paths.
    """
    start, end, center, turn = map(np.concatenate, zip(pieces_of(EMPTY), *map(pieces_of, paths), strict=True))
    whole = _of_points(start, end, center, turn.astype(np.float64))
    short = whole.length <= ON_PATH
    if not short.any():
        return whole
    # a piece whose length is NaN stays, so that it is not silently ignored
    keep, first = ~short, 0
    for path in paths:
        if len(path) and not keep[first : first + len(path)].any():
            keep[first] = True
        first += len(path)
    return whole.take(keep.nonzero()[0])


def _of_points(start: Points, end: Points, center: Points, turn: Floats) -> PieceArrays:
    arc = turn.nonzero()[0]
    arm, vector = np.ones(len(turn), np.complex128), end - start
    angle, radius, slack = np.zeros((3, len(turn)))
    length = np.abs(vector)
    if len(arc):
        starts, ends, turns = start.take(arc), end.take(arc), turn.take(arc)
        centers, slack[arc] = even_centers(starts, ends, center.take(arc), turns)
        arm[arc] = arms = starts - centers
        radius[arc] = radii = np.abs(arms)
        angle[arc] = angles = swept(Pieces(starts, ends, centers, turns.astype(np.int8)))
        length[arc] = radii * angles
    return PieceArrays(np.arange(len(turn)), start, vector, arm, turn, angle, radius, length, slack)


def even_centers(start: Points, end: Points, center: Points, turn: Floats | Turns) -> tuple[Points, Floats]:
    """Return centers equally far from both ends of arcs (n,), and the slack that an arc's two radii leave to its run.

    A center moves onto the bisector of the ends, by no more than the radii differ.  If that is not enough, as with a
    chord shorter than the radius, an arc of less than half a turn keeps its ends and gets the mean of its radii.  A
    longer arc keeps its center: moving it would move the far side of the arc just as much.  An arc with both ends on
    one ray from the center may be empty or a full circle: its slack is infinite.
    """
    centers, slack = center.copy(), np.abs(np.abs(start - center) - np.abs(end - center))
    uneven = (slack > ON_PATH).nonzero()[0]
    slack[slack <= ON_PATH] = 0.0
    if len(uneven):
        ends = start[uneven], end[uneven], center[uneven]
        centers[uneven], slack[uneven] = _evened(*ends, turn[uneven], slack[uneven])
    return centers, slack


def _evened(
    start: Points, end: Points, center: Points, turn: Floats | Turns, difference: Floats
) -> tuple[Points, Floats]:
    """Return the moved centers and the slacks of arcs whose radii have this `difference`."""
    chord, size = end - start, (np.abs(start - center) + np.abs(end - center)) / 2.0
    half = np.abs(chord) / 2.0
    mean_center = (start + end) / 2.0 + 1j * turn * np.sqrt(np.maximum(size**2 - half**2, 0.0)) * chord / (2.0 * half)
    turned = (end - center) * np.conj(start - center)
    fallback = np.where(turned.imag * turn >= 0.0, mean_center, center)
    moved = on_bisector(start, end, center)
    on_one_ray = (np.abs(turned.imag) <= 2.0 * ANGLE_ROUNDING * turned.real) & (turned.real > 0.0)
    return np.where(np.abs(moved - center) > difference, fallback, moved), np.where(on_one_ray, np.inf, difference)


def by_kind(arcs: Flags, line: Formula, arc: Formula, *arguments: FormulaArgument) -> NDArray[Any]:
    """Return what `line` yields where `arcs` is False and `arc` where it is True; the last axis counts the pieces.

    If both kinds occur, both formulas run on all pieces: either yields some value for any piece.
    """
    if not arcs.any():
        return line(*arguments)
    return arc(*arguments) if arcs.all() else np.where(arcs, arc(*arguments), line(*arguments))


def batches_by_kind(first: Flags, second: Flags) -> Iterator[Rows]:
    """Yield pair indices grouped by which of the two are arcs, at most PAIRS_PER_BATCH at once; few pairs all together.

    In a batch of one kind no formula has to separate lines from arcs, and small batches bound the memory in use.
    """
    if 0 < len(first) <= FEW_PAIRS:
        yield np.arange(len(first))
        return
    kinds = 2 * first.astype(np.int8) + second
    for kind in range(4):
        rows = (kinds == kind).nonzero()[0]
        for start in range(0, len(rows), PAIRS_PER_BATCH):
            yield rows[start : start + PAIRS_PER_BATCH]


def at(pieces: PieceArrays, t: Floats) -> Points:
    """Return the (..., n) points at the fractions `t` (..., n) of each piece."""
    return by_kind(
        pieces.arcs,
        lambda: pieces.start + t * pieces.vector,
        lambda: pieces.center + pieces.arm * np.exp(1j * (pieces.turn * pieces.angle) * t),
    )


def direction(pieces: PieceArrays, t: Floats) -> Points:
    """Return the (n,) unit tangents at the fractions `t` (n,)."""
    turn, size = pieces.turn, np.where(pieces.radius == 0.0, 1.0, pieces.radius)
    return by_kind(
        pieces.arcs,
        lambda: pieces.unit + 0.0 * t,
        lambda: 1j * turn * (pieces.arm / size) * np.exp(1j * (turn * pieces.angle) * t),
    )


def traveled(arc: PieceArrays, directions: Points) -> Floats:
    """Return the angles in [0, tau) traveled from each arc's start to `directions` (..., n), seen from its center."""
    turned = directions * np.conj(arc.arm)
    angle: Floats = np.arctan2(turned.imag, turned.real) * arc.turn
    # adding a turn to negative angles is ten times as fast as np.mod
    angle += tau * (angle < 0.0)
    return angle


def piece_at(pieces: PieceArrays, stations: Floats, s: Floats) -> tuple[Rows, Floats]:
    """Return pieces, and fractions of them, at lengths `s` along the path; at a joint the piece that begins there."""
    index = stations[1:-1].searchsorted(s, side="right")
    return index, fraction(s - stations.take(index), pieces.length.take(index))


def fraction(traveled_on: Floats, length: Floats) -> Floats:
    """Return the fractions, within 0 ... 1, of pieces of these lengths (n,) after (..., n) lengths traveled on them."""
    return np.clip(traveled_on / np.where(length == 0.0, 1.0, length), 0.0, 1.0)
