"""Moves above: what a compensated stretch runs higher than it cuts, such as a rapid from one contour to the next.

Nothing in a program says how high a part is.  A move counts as above it when it is as high as the tool was whenever it
went down to cut.  Such a move cuts nothing, and a rapid there is no contour.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.contours_and_leads import MAX_LEAD_MOVES
from core.controls.control_run import ControlRun, Stretch
from core.controls.moves import Moves, Plane
from core.geometry.path import Floats
from core.tolerance import ON_PATH

Flags = NDArray[np.bool_]

Z: Final = 2


@dataclass(frozen=True, eq=False, slots=True)
class Divided:
    """A stretch in the pieces between its moves above.

    `above`: of the moves the control makes those that run above, each row with the one before it as its start.
    `links`: the lines of those from one piece to the next, which are not judged as contour either.  `height`: from
    which on a move is above.
    """

    pieces: tuple[Stretch, ...]
    above: tuple[Moves, ...] = ()
    links: tuple[int, ...] = ()
    height: float = inf


def free_heights(run: ControlRun) -> Floats:
    """(n,) for each of the run's moves the highest height from which the tool went straight down to cut until then.

    Of a way down in several moves the last feed moves count: a rapid brings the tool near.  Every feed move in the
    plane cuts, except the leads of compensated stretches.  -inf before the first one.
    """
    moves = run.moves
    heights, in_plane, falls = moves.points[:, Z], _in_plane(moves), np.zeros(len(moves), np.bool_)
    falls[1:] = (heights[1:] < heights[:-1]) & ~in_plane[1:]
    rows = np.flatnonzero(falls)
    last, starts = [-1], [-inf]
    for way in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else ():
        feeds = way[~moves.rapid[way]]
        last.append(int(way[-1]))
        starts.append(float(heights[(feeds if len(feeds) else way)[0] - 1]))
    way_before = np.searchsorted(last, np.arange(len(moves))) - 1
    cuts = in_plane & ~moves.rapid & ~_leads(run)
    return np.maximum.accumulate(np.where(cuts, np.array(starts)[way_before], -inf))


def _leads(run: ControlRun) -> Flags:
    """(n,) the run's rows that belong to a compensated stretch and not to its surface."""
    rows = np.zeros(len(run.moves), np.bool_)
    for stretch in run.stretches:
        made = slice(stretch.first + 1, stretch.last)
        surface = stretch.programmed.lines[_surface(stretch)]
        rows[made] |= ~np.isin(run.moves.lines[made], surface)
    return rows


def divided(moves: Moves, stretch: Stretch, free: float) -> Divided:
    """The stretch without what it runs at the height `free` or higher; whole where nothing does or may be a contour."""
    whole = Divided((stretch,))
    if stretch.plane is not Plane.XY or stretch.changes:
        return whole
    programmed, made = stretch.programmed, moves.part(stretch.first, stretch.last)
    height = free - ON_PATH if free > -inf else inf
    high = _at_least(programmed, height)
    if _cuts_above(stretch, high):
        return whole
    contours, paths = _between(programmed, high), _between(made, _at_least(made, height))
    links = [_lines(programmed, last, first) for (_, last), (first, _) in pairwise(contours)]
    if not paths or len(contours) != len(paths):
        return whole
    if links != [_lines(made, last, first) for (_, last), (first, _) in pairwise(paths)]:
        return whole
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
    ends = [0, *(row for path in paths for row in path), len(made) - 1]
    gaps = [(first, last) for first, last in zip(ends[::2], ends[1::2], strict=True) if last > first]
    above = tuple(made.part(first, last + 1) for first, last in gaps)
    above = tuple(part for part in above if _in_plane(part).any())
    if not above:
        return whole
    return Divided(pieces, above, tuple(sorted({line for lines in links for line in lines})), height)


def _in_plane(moves: Moves) -> Flags:
    """(n,) rows that move in the plane XY."""
    moving: Flags = moves.turns != 0
    moving[1:] |= np.any(moves.points[1:, :Z] != moves.points[:-1, :Z], axis=1)
    moving[0] = False
    return moving


def _at_least(moves: Moves, height: float) -> Flags:
    """(n,) rows that start and end at this height or higher."""
    high: Flags = moves.points[:, Z] >= height
    high[1:] &= high[:-1]
    return high


def _surface(stretch: Stretch) -> Flags:
    """(n,) rows of what is programmed that move in the plane and are no leads."""
    rows = _in_plane(stretch.programmed)
    rows[: stretch.entry + 1] = False
    rows[len(rows) - stretch.exit :] = False
    return rows


def _cuts_above(stretch: Stretch, high: Flags) -> bool:
    """Whether feed moves so high may be a contour: they are too many in a row, or no rapid is among them."""
    surface, rapid = _surface(stretch), stretch.programmed.rapid
    for run in np.split(np.arange(len(high)), np.flatnonzero(high[1:] != high[:-1]) + 1):
        feeds = int((surface & ~rapid)[run].sum())
        if high[run[0]] and feeds and (feeds > MAX_LEAD_MOVES or not (surface & rapid)[run].any()):
            return True
    return False


def _between(moves: Moves, above: Flags) -> list[tuple[int, int]]:
    """The parts between moves above that run in the plane: the row of the point where each starts, and its last row."""
    in_plane = _in_plane(moves)
    low = np.flatnonzero(in_plane & ~above)
    if not len(low):
        return []
    high = np.flatnonzero(in_plane & above)
    cuts = np.searchsorted(high, low)
    groups = np.split(low, np.flatnonzero(np.diff(cuts)) + 1)
    parts = list[tuple[int, int]]()
    for group in groups:
        before, behind = high[high < group[0]], high[high > group[-1]]
        first = int(before[-1]) if len(before) else 0
        last = int(behind[0]) - 1 if len(behind) else len(moves) - 1
        parts.append((first, last))
    return parts


def _lines(moves: Moves, last: int, first: int) -> frozenset[int]:
    """The lines of the moves in the plane from the end of one part to the start of the next."""
    rows = np.arange(last + 1, first + 1)
    return frozenset(moves.lines[rows[_in_plane(moves)[rows]]].tolist())
