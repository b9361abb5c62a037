"""The raw chain of the best path: what may be left of the offset, joined across the start, and what else cuts it.

Words: the SIDE pieces are the offset segments and corner arcs on the cutter's side; of a closed contour they are
joined across its start.  The OUTLINE pieces are the rest of the outline of all places nearer than the radius: the
other side, and the half circles about an open contour's two ends.  They only cut.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

import numpy as np

from core.comp.best_path.winding import winds
from core.comp.offset import Chain, Part, offset
from core.geometry.path import Flags, Floats, Path, Pieces, Points, Rows, Turns, as_complex, joined
from core.geometry.piece import SLIVER, Side
from core.tolerance import JOINED


@dataclass(frozen=True, eq=False, slots=True)
class Raw:
    """m raw pieces in order of travel; the side pieces follow each other without a gap.

    `start`, `end`, `center` (m,) complex; `turns` (m,); `numbers` (m,) programmed; `lengths` (m,) mm.  `following`
    (m,) is the piece whose start is this one's end, -1 where none is; `smooth` (m,) marks those joined so that nothing
    vanished between.  `side` (m,) marks the side pieces, which belong to the surface's `segment` (m,), from 0, or to
    the corner behind it.  `blunt_start`, `blunt_end` (m,) mark pieces cut off inside a wall there.
    """

    start: Points
    end: Points
    center: Points
    turns: Turns
    numbers: Floats
    lengths: Floats
    following: Rows
    smooth: Flags
    side: Flags
    segment: Rows
    blunt_start: Flags
    blunt_end: Flags

    def __len__(self) -> int:
        return len(self.turns)

    @property
    def pieces(self) -> Pieces:
        """All pieces, without a copy."""
        return Pieces(self.start, self.end, self.center, self.turns)


@dataclass(frozen=True, eq=False, slots=True)
class Untrimmed:
    """The raw chain before its inside corners are cut, and the surface's `joints`: those of row k are k and k + 1.

    `order` (m,) is each piece's next in its ring, -1 at an open end; `inside` (m,) marks an inside corner between
    them, `corner` (m,) the corner arcs.
    """

    raw: Raw
    order: Rows
    inside: Flags
    corner: Flags
    joints: Points


def untrimmed(surface: Path, side: Side, radius: float, *, closed: bool, crossing: bool) -> Untrimmed:
    """The raw chain of a surface; of a closed one that crosses itself also the outline of its other side.

    An open contour that winds or crosses itself is taken there and back, as a closed one without width: the way back
    is its other side.  Of another open contour the half circles about its ends are all the outline that can cut.
    """
    if closed:
        return _closed(surface, side, radius, crossing=crossing)
    if crossing or winds(surface, radius):
        both = joined((surface, surface.reversed()))
        chain = _around(both, side, radius)
        return _untrimmed(chain, 2 * len(surface) - 1, as_complex(both.points), rings=(len(chain),))
    whole = joined((surface.part(0, 1).reversed(), surface, surface.part(len(surface) - 1, len(surface)).reversed()))
    chain = _without_cusps(offset(whole, side, radius), whole, side)
    chain = Chain(chain.raw, chain.parts, chain.places - 2)
    return _untrimmed(chain, 2 * len(surface) - 1, as_complex(surface.points), rings=())


def _closed(surface: Path, side: Side, radius: float, *, crossing: bool) -> Untrimmed:
    chain = _around(surface, side, radius)
    joints = as_complex(surface.points)
    if not crossing:
        return _untrimmed(chain, 2 * len(surface), joints, rings=(len(chain),))
    back = _around(surface.reversed(), side, radius)
    chain, ring = _both(chain, back, 2 * len(joints)), len(chain)
    return _untrimmed(chain, 2 * len(surface), np.concatenate((joints, joints[::-1])), rings=(ring, len(chain)))


def _around(surface: Path, side: Side, radius: float) -> Chain:
    """The raw chain of a closed surface with the joint at its start: traveled on over the first segment."""
    chain = offset(joined((surface, surface.part(0, 1))), side, radius)
    last = int(np.searchsorted(chain.places, 2 * len(surface)))
    chain = Chain(chain.raw.part(0, last), chain.parts[:last], chain.places[:last])
    return _without_cusps(chain, surface, side)


def _without_cusps(chain: Chain, surface: Path, side: Side) -> Chain:
    """The chain without half circles about reversals whose inside the cutter is on: there they are behind the wall.

    Which side is inside shows in how far to the left the way back lies of the way there, a little before the tip:
    by the angle between them and by their curvatures.  Where they lie on each other both sides are outside.
    """
    points, centers = as_complex(chain.raw.points), as_complex(chain.raw.centers)
    corners = (chain.parts == Part.CORNER.value).nonzero()[0]
    across = points[corners] + points[corners + 1] - 2.0 * centers[corners]
    corners = corners[np.abs(across) <= JOINED]
    if not len(corners):
        return chain
    there = chain.places[corners].astype(np.intp) // 2
    back = (there + 1) % len(surface)
    first, last = points[corners] - centers[corners], points[corners + 1] - centers[corners]
    bend = first.conj() * last
    before = np.minimum(_lengths(surface, there), _lengths(surface, back)) / 4.0
    aside = (
        bend.imag / np.abs(bend) * before - (_curvature(surface, there) + _curvature(surface, back)) * before**2 / 2.0
    )
    parts = chain.parts.copy()
    parts[corners[side.sign * aside > JOINED]] = Part.BRIDGE.value
    return Chain(chain.raw, parts, chain.places)


def _lengths(path: Path, rows: Rows) -> Floats:
    points = as_complex(path.points)
    return lengths(points[rows], points[rows + 1], as_complex(path.centers)[rows], path.turns[rows])


def _curvature(path: Path, rows: Rows) -> Floats:
    """Curvatures of pieces, positive to the left, 0 of a line."""
    radii = np.abs(as_complex(path.points)[rows] - as_complex(path.centers)[rows])
    curvature: Floats = path.turns[rows] / np.where(path.turns[rows] == 0, 1.0, radii)
    return curvature


def _both(one: Chain, two: Chain, places: int) -> Chain:
    """Two chains as one, a bridge between them; the second one's places begin at `places`."""
    points = np.concatenate((one.raw.points, two.raw.points))
    path = Path.of(
        points,
        np.concatenate((one.raw.centers, one.raw.points[-1:], two.raw.centers)),
        np.concatenate((one.raw.turns, np.zeros(1, np.int8), two.raw.turns)),
        np.concatenate((one.raw.numbers, np.zeros(1), two.raw.numbers)),
    )
    bridge = np.full(1, Part.BRIDGE.value, np.uint8)
    parts = np.concatenate((one.parts, bridge, two.parts))
    return Chain(path, parts, np.concatenate((one.places, one.places[-1:] + 1, two.places + places)))


def _untrimmed(chain: Chain, sides: int, joints: Points, *, rings: tuple[int, ...]) -> Untrimmed:
    """The pieces of a chain that have a geometry of their own, joined over provisional bridges of no length.

    Side pieces have places 0 ... `sides` - 1.  Before each of the rows `rings` a ring ends, whose last piece is joined
    to its first; the row at its end, if there are more, is none of either ring.
    """
    path = chain.raw
    rows = (chain.parts <= Part.CORNER.value).nonzero()[0]
    points = as_complex(path.points)
    start, end, turns = points[rows], points[rows + 1], path.turns[rows]
    center = as_complex(path.centers)[rows]
    onward, order = _onward(rows, len(chain), rings)
    gapless = (order >= 0) & (np.abs(start[order] - end) <= JOINED)
    bridged = (order >= 0) & ~gapless & (chain.parts[onward[rows]] == Part.BRIDGE.value)
    raw = Raw(
        start,
        end,
        center,
        turns,
        path.numbers[rows],
        lengths(start, end, center, turns),
        np.where(gapless, order, -1),
        gapless & (rows[order] == onward[rows]),
        (chain.places[rows] >= 0) & (chain.places[rows] < sides),
        chain.places[rows].astype(np.intp) // 2,
        np.zeros(len(rows), np.bool_),
        np.zeros(len(rows), np.bool_),
    )
    inside = bridged & (rows[order] == onward[onward[rows]])
    return Untrimmed(raw, order, inside, chain.parts[rows] == Part.CORNER.value, joints)


def _onward(rows: Rows, count: int, rings: tuple[int, ...]) -> tuple[Rows, Rows]:
    """The row behind each of `count` rows, round each ring; and of the rows `rows` the next one of them, or -1."""
    onward = np.minimum(np.arange(1, count + 1), count - 1)
    order = np.arange(1, len(rows) + 1)
    order[-1:] = -1
    first = 0
    for last in rings:
        onward[last - 1] = first
        low, high = np.searchsorted(rows, (first, last)).tolist()
        order[low:high][-1:] = low
        first = last + 1
    return onward, order


def lengths(start: Points, end: Points, center: Points, turns: Turns) -> Floats:
    """(n,) lengths of pieces; an arc whose ends are equal is a full circle."""
    found: Floats = np.abs(end - start)
    arcs = turns.nonzero()[0]
    first, last, turn = start[arcs] - center[arcs], end[arcs] - center[arcs], turns[arcs]
    angle = np.angle(first.conj() * last) * turn
    angle[angle < 0.0] += tau
    angle[angle > tau - SLIVER] = 0.0
    angle[found[arcs] == 0.0] = tau
    found[arcs] = angle * np.abs(first)
    return found
