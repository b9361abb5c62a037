"""Moves above the part, such as a rapid between two contours, are taken out of a stretch before it is judged.

No program says how high a part is.  A move counts as above it when it is higher than all cuts before it and not below
zero, where the top of a part usually is.  Such a move cuts nothing, and a rapid there is no contour.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from typing import Final

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.moves import Moves, Plane
from core.geometry.path import Flags, Floats
from core.tolerance import ON_PATH

Z_COLUMN: Final = 2

MoveSpan = tuple[int, int]
"""The row of the point where a run of moves starts, and the row of its last move."""


@dataclass(frozen=True, eq=False, slots=True)
class Divided:
    """A stretch divided into the pieces between its moves above.

    Of the control's moves above, `links` run from one piece to the next, and `leads` before the first piece and after
    the last one.  Each starts at the point of the move before it.
    """

    pieces: tuple[Stretch, ...]
    links: tuple[Moves, ...]
    leads: tuple[Moves, ...]


def heights_above(run: ControlRun) -> Floats:
    """Return (n,) the height from which on each of a run's moves is above the part.

    Every feed move in the plane cuts, except the leads of compensated stretches.
    """
    moves = run.moves
    heights = moves.points[:, Z_COLUMN]
    reached = np.maximum(heights, np.concatenate((heights[:1], heights[:-1])))
    cuts = moves.moving_in(Plane.XY) & ~moves.rapid & ~_leads(run)
    return np.maximum(np.maximum.accumulate(np.where(cuts, reached, -inf)) + 2.0 * ON_PATH, 0.0)


def _leads(run: ControlRun) -> Flags:
    """Return (n,) flags of the run's rows that belong to a compensated stretch but not to its surface."""
    rows = np.zeros(len(run.moves), np.bool_)
    for stretch in run.stretches:
        moves = slice(stretch.first + 1, stretch.last)
        rows[moves] |= ~np.isin(run.moves.lines[moves], stretch.programmed.lines[surface_rows(stretch)])
    return rows


def divided(moves: Moves, stretch: Stretch, height: float) -> Divided | None:
    """Return the stretch without its moves at `height` or higher; None if there are none or they may cut something."""
    if stretch.plane is not Plane.XY or stretch.changes:
        return None
    programmed, driven = stretch.programmed, moves.part(stretch.first, stretch.last)
    high, driven_high = _at_least(programmed, height), _at_least(driven, height)
    if (surface_rows(stretch) & ~programmed.rapid & high).any():
        return None
    contours, paths = _between(programmed, high), _between(driven, driven_high)
    gaps = _gaps(paths, len(driven))
    linked = [_lines(programmed, gap) for gap in _gaps(contours, len(programmed))[1:-1]]
    if not paths or len(contours) != len(paths) or linked != [_lines(driven, gap) for gap in gaps[1:-1]]:
        return None
    if not all(driven_high[last + 1 : first + 1].all() for last, first in gaps):
        return None
    above = [driven.part(last, first + 1) for last, first in gaps]
    leads = tuple(lead for lead in (above[0], above[-1]) if lead.moving_in(Plane.XY).any())
    if not leads and len(above) == 2:
        return None
    last_surface = len(programmed) - 1 - stretch.exit
    pieces = tuple(
        replace(
            stretch,
            programmed=programmed.part(first, last + 1),
            entry=max(stretch.entry - first, 0),
            exit=max(last - last_surface, 0),
            first=stretch.first + begin,
            last=stretch.first + end + 1,
        )
        for (first, last), (begin, end) in zip(contours, paths, strict=True)
    )
    return Divided(pieces, tuple(above[1:-1]), leads)


def _at_least(moves: Moves, height: float) -> Flags:
    """Return (n,) flags of rows that start and end at this height or higher."""
    high: Flags = moves.points[:, Z_COLUMN] >= height
    high[1:] &= high[:-1]
    return high


def surface_rows(stretch: Stretch) -> Flags:
    """Return (n,) flags of the programmed rows that move in the plane and are not leads."""
    rows = stretch.programmed.moving_in(Plane.XY)
    rows[: stretch.entry + 1] = False
    rows[len(rows) - stretch.exit :] = False
    return rows


def _between(moves: Moves, high: Flags) -> list[MoveSpan]:
    """Return the parts of the moves between high ones; each has moves in the plane, all of them low."""
    in_plane = moves.moving_in(Plane.XY)
    low, above = np.flatnonzero(in_plane & ~high), np.flatnonzero(in_plane & high)
    parts = list[MoveSpan]()
    for group in np.split(low, np.flatnonzero(np.diff(np.searchsorted(above, low))) + 1) if len(low) else ():
        before, after = above[above < group[0]], above[above > group[-1]]
        first = int(before[-1]) if len(before) else 0
        parts.append((first, int(after[0]) - 1 if len(after) else len(moves) - 1))
    return parts


def _gaps(parts: list[MoveSpan], count: int) -> list[MoveSpan]:
    """Return the gaps before, between and after parts of `count` rows; without parts, all rows are one gap."""
    return list(pairwise([0, *(row for part in parts for row in part), count - 1]))[::2]


def _lines(moves: Moves, gap: MoveSpan) -> frozenset[int]:
    """Return the lines of a gap's moves that run in the plane."""
    part = moves.part(gap[0], gap[1] + 1)
    return frozenset(part.lines[part.moving_in(Plane.XY)].tolist())
