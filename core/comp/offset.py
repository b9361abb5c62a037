"""Offset: move every segment one radius to the side and put corner arcs between, also for best paths and M120.

The position of a part in half steps is 2 k for the k-th segment (from 0), and 2 k + 1 for the part between it and the
next.  Two parts are within a look-ahead of v if they are within 2 v half steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Flags, Path, Points, Rows, as_complex, coordinates
from core.geometry.piece import Side
from core.tolerance import JOINED


class RawPart(IntEnum):
    """The kind of a piece of the raw chain."""

    SEGMENT = 0
    """An offset segment."""
    CORNER = 1
    """An arc about an outside corner."""
    BRIDGE = 2
    """A provisional line at an inside corner, where the two offsets are still to be tested."""
    VANISHED = 3
    """A line in place of an inside arc that is not larger than the tool."""


@dataclass(frozen=True, eq=False, slots=True)
class RawChain:
    """The raw chain of m pieces: their path `raw`, their kinds `parts` (m,) and their positions `half_steps` (m,)."""

    raw: Path
    parts: NDArray[np.uint8]
    half_steps: Rows

    def __len__(self) -> int:
        return len(self.parts)


def offset(contour: Path, side: Side, radius: float) -> RawChain:
    """Return the raw chain of a contour without zero-length segments, `radius` > 0 millimeters to `side`.

    Each segment has two slots, one for itself and one for its joint with the next; the chain takes the slots in use.
    """
    ends, normals, vanished = _offsets(contour, side.sign * radius)
    link, outside = _joints(normals, side.sign, radius)
    slots = 2 * len(contour) - 1
    segments, joints = slice(0, None, 2), slice(1, None, 2)
    points, turns, parts = np.empty(slots + 1, np.complex128), np.zeros(slots, np.int8), np.zeros(slots, np.uint8)
    points[0::2], points[1::2] = ends
    turns[segments] = np.where(vanished, 0, contour.turns)
    turns[joints] = np.where(outside, -side.sign, 0)
    parts[segments] = np.where(vanished, RawPart.VANISHED, RawPart.SEGMENT)
    parts[joints] = np.where(outside, RawPart.CORNER, RawPart.BRIDGE)
    centers = points[:-1].copy()
    centers[segments] = np.where(turns[segments] == 0, centers[segments], as_complex(contour.centers))
    centers[joints] = np.where(outside, as_complex(contour.points)[1:-1], centers[joints])
    numbers = np.repeat(contour.numbers, 2)[:-1]
    numbers[joints] += 0.5
    in_use = np.ones(slots, np.bool_)
    in_use[joints] = link
    half_steps = in_use.nonzero()[0]
    starts = np.append(points[half_steps], points[-1])
    _close_circles(starts, contour, half_steps)
    raw = Path(coordinates(starts), coordinates(centers[half_steps]), turns[half_steps], numbers[half_steps])
    return RawChain(raw, parts[half_steps], half_steps)


def _offsets(contour: Path, shift: float) -> tuple[Points, Points, Flags]:
    """Move n segments by `shift` along their left normals.

    Return starts and ends (2, n), the left unit normals there (2, n), and which have vanished (n,).
    """
    points, centers, turns = as_complex(contour.points), as_complex(contour.centers), contour.turns
    ends = np.array((points[:-1], points[1:]))
    normals = np.where(turns == 0, 1j * (ends[1] - ends[0]), (centers - ends) * turns)
    sizes = np.abs(normals)
    normals /= sizes
    return ends + shift * normals, normals, (turns != 0) & (sizes[0] - shift * turns <= JOINED)


def _joints(normals: Points, sign: int, radius: float) -> tuple[Flags, Flags]:
    """Return which joints need a link between their segments, and which are outside corners.

    A joint is tangent if its offset ends coincide: their distance is the radius times the distance of the normals.
    An exact reversal is an outside corner: its offsets never meet on the other side.
    """
    before, following = normals[1, :-1], normals[0, 1:]
    bend = before.conj() * following
    reversal = (bend.real < 0.0) & (radius * np.abs(bend.imag) <= JOINED)
    return radius * np.abs(following - before) > JOINED, (sign * bend.imag < 0.0) | reversal


def _close_circles(starts: Points, contour: Path, half_steps: Rows) -> None:
    """Keep full circles full: set their start equal to their end, which is the next piece's start in the chain."""
    ends = as_complex(contour.points)
    circles = (ends[1:] == ends[:-1]).nonzero()[0]
    for row in half_steps.searchsorted(2 * circles)[::-1].tolist():
        starts[row] = starts[row + 1]
