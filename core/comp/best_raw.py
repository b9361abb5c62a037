"""The raw chain of the best path: what may be left of the offset, joined across the start, and what else cuts it.

Words: the SIDE pieces are the offset segments and corner arcs on the cutter's side; of a closed contour they are
joined across its start.  The OUTLINE pieces are the rest of the outline of all places nearer than the radius: the
other side, and the half circles about an open contour's two ends.  They only cut.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

import numpy as np
from numpy.typing import NDArray

from core.comp.offset import Chain, Part, offset
from core.geometry.intersect import Indices, Masks, Planes, planes
from core.geometry.path import Floats, Path, Turns, joined
from core.geometry.piece import SLIVER
from core.geometry.side import Side
from core.tolerance import JOINED


@dataclass(frozen=True, eq=False, slots=True)
class Raw:
    """m raw pieces, side pieces and outline pieces in order of travel.

    `rows` (m,) are their rows in `path`; `start`, `end`, `centre` (m,) complex; `turns` (m,); `lengths` (m,) mm.
    `following` (m,) is the piece whose start is this one's end, -1 where none is; `smooth` (m,) marks those joined
    smoothly, nothing vanished between.  `side` (m,) marks the side pieces, which belong to the surface's `segment`
    (m,), from 0, or to the corner behind it.
    """

    path: Path
    rows: Indices
    start: Planes
    end: Planes
    centre: Planes
    turns: Turns
    lengths: Floats
    following: NDArray[np.intp]
    smooth: Masks
    side: Masks
    segment: Indices

    def __len__(self) -> int:
        return len(self.rows)


def raw_of(surface: Path, side: Side, radius: float, *, closed: bool, crossing: bool) -> Raw:
    """The raw chain of a surface; of a closed one that crosses itself also the outline of its other side.

    An open contour is taken there and back, as a closed one without width: the way back is its other side.
    """
    if not closed:
        chain = _around(joined((surface, surface.reversed())), side, radius)
        return _raw(chain, int(np.searchsorted(chain.places, 2 * len(surface) - 1)), ring=len(chain))
    chain = _around(surface, side, radius)
    count = len(chain)
    if not crossing:
        return _raw(chain, count, ring=count)
    return _raw(_both(chain, _around(surface.reversed(), side, radius)), count, ring=count)


def _around(surface: Path, side: Side, radius: float) -> Chain:
    """The raw chain of a closed surface with the joint at its start: travelled on over the first segment."""
    chain = offset(joined((surface, surface.part(0, 1))), side, radius)
    last = int(np.searchsorted(chain.places, 2 * len(surface)))
    chain = Chain(chain.raw.part(0, last), chain.parts[:last], chain.places[:last])
    return _without_cusps(chain, surface, side)


def _without_cusps(chain: Chain, surface: Path, side: Side) -> Chain:
    """The chain without half circles about reversals whose inside the cutter is on: there they are behind the wall.

    Which side is inside shows in how far to the left the way back lies of the way there, a little before the tip:
    by the angle between them and by their curvatures.  Where they lie on each other both sides are outside.
    """
    points, centres = planes(chain.raw.points), planes(chain.raw.centres)
    corners = np.flatnonzero(chain.parts == Part.CORNER.value)
    across = points[corners] + points[corners + 1] - 2.0 * centres[corners]
    corners = corners[np.abs(across) <= JOINED]
    if not len(corners):
        return chain
    there = chain.places[corners].astype(np.intp) // 2
    back = (there + 1) % len(surface)
    first, last = points[corners] - centres[corners], points[corners + 1] - centres[corners]
    bend = first.conj() * last
    before = np.minimum(_lengths(surface, there), _lengths(surface, back)) / 4.0
    aside = (
        bend.imag / np.abs(bend) * before - (_curvature(surface, there) + _curvature(surface, back)) * before**2 / 2.0
    )
    parts = chain.parts.copy()
    parts[corners[side.sign * aside > JOINED]] = Part.BRIDGE.value
    return Chain(chain.raw, parts, chain.places)


def _lengths(path: Path, rows: Indices) -> Floats:
    points = planes(path.points)
    return lengths(points[rows], points[rows + 1], planes(path.centres)[rows], path.turns[rows])


def _curvature(path: Path, rows: Indices) -> Floats:
    """Curvatures of pieces, positive to the left, 0 of a line."""
    radii = np.abs(planes(path.points)[rows] - planes(path.centres)[rows])
    curvature: Floats = path.turns[rows] / np.where(path.turns[rows] == 0, 1.0, radii)
    return curvature


def _both(one: Chain, two: Chain) -> Chain:
    """Two chains as one, a bridge between them."""
    points = np.concatenate((one.raw.points, two.raw.points))
    between = one.raw.points[-1:]
    path = Path.of(
        points,
        np.concatenate((one.raw.centres, between, two.raw.centres)),
        np.concatenate((one.raw.turns, np.zeros(1, np.int8), two.raw.turns)),
        np.concatenate((one.raw.numbers, np.zeros(1), two.raw.numbers)),
    )
    bridge = np.full(1, Part.BRIDGE.value, np.uint8)
    parts = np.concatenate((one.parts, bridge, two.parts))
    return Chain(path, parts, np.concatenate((one.places, one.places[-1:] + 1, two.places)))


def _raw(chain: Chain, outline: int, *, ring: int) -> Raw:
    """The pieces of a chain that have a geometry of their own, joined over provisional bridges of no length.

    Pieces from row `outline` on are outline pieces; at row `ring` a second ring begins, joined in itself.
    """
    path = chain.raw
    rows = np.flatnonzero(chain.parts <= Part.CORNER.value)
    points = planes(path.points)
    start, end, turns = points[rows], points[rows + 1], path.turns[rows]
    centre = planes(path.centres)[rows]
    following = np.concatenate([np.roll(part, -1) for part in np.split(np.arange(len(rows)), [_before(rows, ring)])])
    following[np.abs(start[following] - end) > JOINED] = -1
    onward = rows + 1
    onward[rows == ring - 1], onward[rows == len(chain) - 1] = 0, ring + 1 if ring < len(chain) else 0
    length = lengths(start, end, centre, turns)
    return Raw(
        path,
        rows,
        start,
        end,
        centre,
        turns,
        length,
        following,
        (following >= 0) & (rows[following] == onward),
        rows < outline,
        chain.places[rows].astype(np.intp) // 2,
    )


def _before(rows: Indices, row: int) -> int:
    return int(np.searchsorted(rows, row))


def lengths(start: Planes, end: Planes, centre: Planes, turns: Turns) -> Floats:
    """(n,) lengths of pieces; an arc whose ends are equal is a full circle."""
    found: Floats = np.abs(end - start)
    arcs = np.flatnonzero(turns)
    first, last, turn = start[arcs] - centre[arcs], end[arcs] - centre[arcs], turns[arcs]
    angle = np.angle(first.conj() * last) * turn
    angle[angle < 0.0] += tau
    angle[angle > tau - SLIVER] = 0.0
    angle[found[arcs] == 0.0] = tau
    found[arcs] = angle * np.abs(first)
    return found
