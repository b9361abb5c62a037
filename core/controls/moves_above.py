"""Moves above: what a compensated stretch runs higher than it cuts, such as a rapid from one contour to the next.

Nothing in a program says how high a part is.  A move counts as above it when it is as high as the tool was whenever it
went down to cut, or higher than all cuts so far and not below zero, where the top of a part usually is.  Such a move
cuts nothing, and a rapid there is no contour.
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

    Of the moves the control makes `links` are those that run above from one piece to the next, and are not judged as
    contour either; `leads` those above before the first piece and behind the last one.  Each has the move before it as
    its start.
    """

    pieces: tuple[Stretch, ...]
    links: tuple[Moves, ...] = ()
    leads: tuple[Moves, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Heights:
    """For each of a run's moves what was so far; (n,), -inf before the first cut.

    `approach`: the highest place from which the tool went straight down to cut; of a way down in several moves the last
    feed moves count, since a rapid brings the tool near.  `cut`: the highest place of a cut.  Every feed move in the
    plane cuts, except the leads of compensated stretches.
    """

    approach: Floats
    cut: Floats

    @staticmethod
    def of(run: ControlRun) -> Heights:
        """Those of a run."""
        moves = run.moves
        heights, in_plane, falls = moves.points[:, Z], moves.moving_in(Plane.XY), np.zeros(len(moves), np.bool_)
        falls[1:] = (heights[1:] < heights[:-1]) & ~in_plane[1:]
        rows = np.flatnonzero(falls)
        last, starts = [-1], [-inf]
        for way in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else ():
            feeds = way[~moves.rapid[way]]
            last.append(int(way[-1]))
            starts.append(float(heights[(feeds if len(feeds) else way)[0] - 1]))
        way_before = np.searchsorted(last, np.arange(len(moves))) - 1
        cuts = in_plane & ~moves.rapid & ~_leads(run)
        reached = np.maximum(heights, np.concatenate((heights[:1], heights[:-1])))
        return Heights(
            np.maximum.accumulate(np.where(cuts, np.array(starts)[way_before], -inf)),
            np.maximum.accumulate(np.where(cuts, reached, -inf)),
        )

    def above(self, row: int) -> float:
        """The height from which on a move is above the part, up to a row."""
        approach, cut = float(self.approach[row]), float(self.cut[row])
        over_cuts = max(cut + 2.0 * ON_PATH, 0.0)
        return min(approach - ON_PATH, over_cuts) if approach > -inf else over_cuts


def _leads(run: ControlRun) -> Flags:
    """(n,) the run's rows that belong to a compensated stretch and not to its surface."""
    rows = np.zeros(len(run.moves), np.bool_)
    for stretch in run.stretches:
        made = slice(stretch.first + 1, stretch.last)
        surface = stretch.programmed.lines[surface_rows(stretch)]
        rows[made] |= ~np.isin(run.moves.lines[made], surface)
    return rows


def divided(moves: Moves, stretch: Stretch, height: float) -> Divided:
    """The stretch without what it runs at this height or higher; whole where nothing does or may be a contour."""
    whole = Divided((stretch,))
    if stretch.plane is not Plane.XY or stretch.changes:
        return whole
    programmed, made = stretch.programmed, moves.part(stretch.first, stretch.last)
    high = _at_least(programmed, height)
    if _cuts_above(stretch, high):
        return whole
    contours, paths = _between(programmed, high), _between(made, _at_least(made, height))
    linked = [_lines(programmed, last, first) for (_, last), (first, _) in pairwise(contours)]
    if not paths or len(contours) != len(paths):
        return whole
    if linked != [_lines(made, last, first) for (_, last), (first, _) in pairwise(paths)]:
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
    links = tuple(made.part(last, first + 1) for (_, last), (first, _) in pairwise(paths))
    leads = (made.part(0, paths[0][0] + 1), made.part(paths[-1][1], len(made)))
    return Divided(pieces, links, tuple(lead for lead in leads if lead.moving_in(Plane.XY).any()))


def _at_least(moves: Moves, height: float) -> Flags:
    """(n,) rows that start and end at this height or higher."""
    high: Flags = moves.points[:, Z] >= height
    high[1:] &= high[:-1]
    return high


def surface_rows(stretch: Stretch) -> Flags:
    """(n,) rows of what is programmed that move in the plane and are no leads."""
    rows = stretch.programmed.moving_in(Plane.XY)
    rows[: stretch.entry + 1] = False
    rows[len(rows) - stretch.exit :] = False
    return rows


def _cuts_above(stretch: Stretch, high: Flags) -> bool:
    """Whether feed moves so high may be a contour: they are too many in a row, or no rapid is among them."""
    surface, rapid = surface_rows(stretch), stretch.programmed.rapid
    for run in np.split(np.arange(len(high)), np.flatnonzero(high[1:] != high[:-1]) + 1):
        feeds = int((surface & ~rapid)[run].sum())
        if high[run[0]] and feeds and (feeds > MAX_LEAD_MOVES or not (surface & rapid)[run].any()):
            return True
    return False


def _between(moves: Moves, above: Flags) -> list[tuple[int, int]]:
    """The parts between moves above that run in the plane: the row of the point where each starts, and its last row."""
    in_plane = moves.moving_in(Plane.XY)
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
    return frozenset(moves.lines[rows[moves.moving_in(Plane.XY)[rows]]].tolist())
