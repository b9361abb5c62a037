"""Behind: where a gouging center path is itself on the part's side of the surface, and how far inside it gets there.

A path changes sides where it meets the surface, and beside an open contour where it passes the normal at a free end,
beyond which there is no side.  Parted there it has one side in each part: that of the part's middle.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Final

import numpy as np

from core.geometry.boxes import near_pairs
from core.geometry.distance import distance, foot, on_line
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import at, direction, place
from core.tolerance import GOUGE, JOINED, ON_PATH
from core.verify.farthest import FINE, farthest
from core.verify.gouge import Gouging
from core.verify.pairs import Approaches, Pairs, measure
from core.verify.reach import Nearest, Stretches, changes, least_of, nearest, union
from core.verify.sides import Sided, on_part_side

SHARES: Final = np.linspace(0.0, 1.0, 65)[1:-1, None]
"""(63, 1) shares of a part at which its side is asked for where walls may contradict each other."""

HALVINGS: Final = 40
"""Times that the place where the side changes is drawn nearer: to the last digit of any part's length."""


@dataclass(frozen=True, eq=False, slots=True)
class Behind:
    """m parts of pieces `index` of the center path that are on the part's side, in order.

    `place`, in length traveled, is where the part is farthest inside, `apart` its distance there from the surface,
    `j` the nearest wall.
    """

    index: Rows
    middle: Floats
    place: Floats
    apart: Floats
    j: Rows


NOWHERE: Final = Behind(np.zeros(0, np.intp), np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0, np.intp))
"""Nothing is behind the surface."""


NO_PARTS: Final = Stretches(np.zeros(0), np.zeros(0))
"""Nothing meets the surface."""


def parted(pairs: Pairs, near: Approaches, found: Gouging, sides: Sided, radius: float) -> Stretches:
    """Gouging stretches parted where the center path may change sides; `near` is what gouges.

    A cutter of no radius gouges nothing: of its path the pieces that meet walls without running along one are asked.
    Where a surface crosses itself the sides of its walls contradict each other, and nothing is asked.
    """
    stretches = found.stretches
    if sides.crossed or not (len(stretches) or radius <= GOUGE):
        return NO_PARTS
    met = _meeting(pairs, radius)
    if radius <= GOUGE:
        stretches = union(pairs.center_stations[pairs.i[met]], pairs.center_stations[pairs.i[met] + 1])
    if not len(stretches):
        return NO_PARTS
    cuts = _crossed_at(pairs, near, met, radius), _ends_passed(pairs, stretches, sides), _joints(pairs, sides)
    parts = _parts(stretches, np.concatenate(cuts))
    return parts if sides.endless else _parts(parts, _between_arms(pairs, parts, sides, radius))


def behind(pairs: Pairs, runs: Stretches, radius: float) -> Behind:
    """Of `runs`, parts on the part's side, parted at the joints within them, what is more than GOUGE there."""
    return _deepest(pairs, _parts(runs, pairs.center_stations[1:-1]), radius) if len(runs) else NOWHERE


def deepened(found: Gouging, inside: Behind, radius: float, slack: float) -> Gouging:
    """The gouges, those that are behind the surface somewhere told by the place farthest inside.

    Its distance counts as negative there.  A gouge ends where the path is the radius away again, short of which it is
    by GOUGE and `slack`: at the end that is farthest inside all of the cutter is behind the surface.
    """
    if not len(found.i) or not len(inside.index):
        return found
    owner = found.stretches.index(inside.middle)
    rows = ((owner >= 0) & (inside.middle < found.stretches.last[owner])).nonzero()[0]
    apart = inside.apart[rows]
    apart = np.where(apart >= radius - GOUGE - slack - 2.0 * FINE, radius, apart)
    order = np.lexsort((inside.place[rows], -np.round(apart / ON_PATH), owner[rows]))
    best = order[changes(owner[rows[order]])]
    chosen, gouge = rows[best], owner[rows[best]]
    where, distance, i, j = found.place.copy(), found.apart.copy(), found.i.copy(), found.j.copy()
    where[gouge], distance[gouge] = inside.place[chosen], -apart[best]
    i[gouge], j[gouge] = inside.index[chosen], inside.j[chosen]
    return Gouging(found.stretches, where, distance, i, j)


def _meeting(pairs: Pairs, radius: float) -> Rows:
    """Pairs whose pieces meet; along a wall the center of a cutter of no radius does so everywhere."""
    meets = pairs.touch.apart <= JOINED
    if radius <= GOUGE:
        held = np.zeros(len(pairs.center), np.bool_)
        held[pairs.i[pairs.touch.along]] = True
        meets &= ~held[pairs.i]
    return meets.nonzero()[0]


def _joints(pairs: Pairs, sides: Sided) -> Floats:
    """Places between pieces at which the side may be another one: beside a closed contour those where a path ends."""
    joints, moves = pairs.center_stations[1:-1], pairs.center
    return joints[np.abs(moves.end[:-1] - moves.start[1:]) > JOINED] if sides.endless else joints


def _crossed_at(pairs: Pairs, near: Approaches, met: Rows, radius: float) -> Floats:
    """Places of the center path at which these pairs meet: they are all among those that gouge, but with a cutter of
    hardly any radius."""
    if radius - GOUGE - pairs.grant.max(initial=0.0) <= JOINED:
        near = measure(pairs, pairs.i[met], pairs.j[met], np.inf)
    k, pair = np.nonzero(near.apart <= JOINED)
    i = near.i[pair]
    places: Floats = pairs.center_stations[i] + near.places[k, pair] * pairs.center.length[i]
    return places


def _ends_passed(pairs: Pairs, stretches: Stretches, sides: Sided) -> Floats:
    """Places of these stretches' pieces on the normals at the surface's two ends, or at a closed one's open seam."""
    walls, moves = pairs.surface, pairs.center
    if sides.endless and abs(walls.end[-1] - walls.start[0]) <= ON_PATH:
        return np.zeros(0)
    begin, _ = place(moves, pairs.center_stations, stretches.first)
    end, _ = place(moves, pairs.center_stations, stretches.last)
    steps = np.zeros(len(moves) + 1, np.intp)
    np.add.at(steps, begin, 1)
    np.add.at(steps, end + 1, -1)
    rows = (steps.cumsum()[:-1] > 0).nonzero()[0]
    pieces, found = moves.take(rows), []
    for wall, t in ((0, 0.0), (-1, 1.0)):
        one, share = walls.take(np.full(len(rows), wall)), np.full(len(rows), t)
        corner = at(one, share)
        met = foot(pieces, corner)[None] if sides.endless else on_line(pieces, corner, 1j * direction(one, share))
        k, row = np.nonzero((met > 0.0) & (met < 1.0))
        found.append(pairs.center_stations[rows[row]] + met[k, row] * pieces.length[row])
    return np.concatenate(found)


def _between_arms(pairs: Pairs, parts: Stretches, sides: Sided, radius: float) -> Floats:
    """Places where these parts change sides halfway between arms of an open contour, with its part's side of the one
    and the cutter's of the other: nothing is met there."""
    parts = parts.keep(_about_ends(pairs, parts, radius))
    if not len(parts):
        return np.zeros(0)
    s = parts.first + SHARES * (parts.last - parts.first)
    wrong = _wrong(pairs, s.ravel(), sides, radius).reshape(s.shape)
    changed = wrong[1:] != wrong[:-1]
    low: Floats = s[:-1][changed]
    high, begins = s[1:][changed], wrong[:-1][changed]
    for _ in range(HALVINGS if len(low) else 0):
        middle = (low + high) / 2.0
        same = _wrong(pairs, middle, sides, radius) == begins
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low


def _about_ends(pairs: Pairs, parts: Stretches, radius: float) -> Flags:
    """Parts between whose nearest walls there may be an end of the surface: no other changes sides meeting nothing.

    Let it leave a place nearest to `a` on the left and come to one nearest to `b` on the right.  The way from `a` along
    the surface to `b` and back over the path is a loop that the surface's other two branches leave to different sides,
    and cross nowhere: one of its ends is inside.  The loop runs within the boxes of the walls from the first to the
    last that may be nearest to any place of the part, and of the part.  Where an uneven arc misses an end of its own a
    path may slip through all the same, and no part is left out.
    """
    if pairs.surface.slack.any():
        return np.ones(len(parts), np.bool_)
    middle, near = _nearest(pairs, (parts.first + parts.last) / 2.0, radius)
    reach = near.apart[changes(near.k)] + parts.last - parts.first + JOINED
    around = np.array((middle.real - reach, middle.imag - reach, middle.real + reach, middle.imag + reach))
    k, j = near_pairs(around, pairs.surface_boxes, 0.0)
    starts = changes(k)
    first, last = np.minimum.reduceat(j, starts), np.maximum.reduceat(j, starts)
    runs = np.array((first, last + 1)).T.ravel()
    # a run may end behind the last wall
    walls = np.concatenate((pairs.surface_boxes, pairs.surface_boxes[:, -1:]), axis=1)
    low = np.minimum(np.minimum.reduceat(walls[:2], runs, axis=1)[:, ::2], around[:2])
    high = np.maximum(np.maximum.reduceat(walls[2:], runs, axis=1)[:, ::2], around[2:])
    held = np.zeros(len(middle), np.bool_)
    for end in (pairs.surface.start[0], pairs.surface.end[-1]):
        held |= (low[0] <= end.real) & (low[1] <= end.imag) & (high[0] >= end.real) & (high[1] >= end.imag)
    return held


def _parts(stretches: Stretches, cuts: Floats) -> Stretches:
    """What is between the cuts within the stretches."""
    owner = stretches.index(cuts)
    inside = (owner >= 0) & (cuts < stretches.last[owner])
    s = np.sort(np.concatenate((stretches.first, stretches.last, cuts[inside])))
    middle = (s[1:] + s[:-1]) / 2.0
    owner = stretches.index(middle)
    parts = (s[1:] > s[:-1] + ON_PATH) & (owner >= 0) & (middle < stretches.last[owner])
    return Stretches(s[:-1][parts], s[1:][parts])


def _nearest(pairs: Pairs, s: Floats, radius: float) -> tuple[Points, Nearest]:
    """Points at places of the center path, and what of the surface is nearest to them.

    All walls within the radius of a piece are among its pairs, unless the judge has proved where it is.
    """
    index, t = place(pairs.center, pairs.center_stations, s)
    points = at(pairs.center.take(index), t)
    begin = pairs.i.searchsorted(index)
    counts = pairs.i.searchsorted(index, side="right") - begin
    if len(pairs.own.piece) or not counts.all():
        return points, nearest(points, pairs.surface, pairs.surface_boxes, tie=ON_PATH)
    k, starts = np.repeat(np.arange(len(s)), counts), np.cumsum(counts) - counts
    j = pairs.j[np.arange(len(k)) + (begin - starts)[k]]
    near = least_of(k, j, distance(pairs.surface.take(j), points[k]), starts, ON_PATH)
    if near.apart.max(initial=0.0) > radius:
        return points, nearest(points, pairs.surface, pairs.surface_boxes, tie=ON_PATH)
    return points, near


def _wrong(pairs: Pairs, s: Floats, sides: Sided, radius: float) -> Flags:
    """Which places along the center path are on the part's side."""
    return on_part_side(pairs, *_nearest(pairs, s, radius), sides)


def _deepest(pairs: Pairs, parts: Stretches, radius: float) -> Behind:
    """Of each part the place farthest inside, without those that are nowhere farther than GOUGE."""
    middle = (parts.first + parts.last) / 2.0
    # what gouges is nowhere farther from the surface
    most = radius - GOUGE if radius > GOUGE else inf
    far = farthest(pairs.center, parts, pairs.surface, pairs.surface_boxes, most=most, tie=ON_PATH)
    keep = far.apart > GOUGE
    middle = middle[keep]
    index = pairs.center_stations[1:-1].searchsorted(middle, side="right")
    return Behind(index, middle, far.place[keep], far.apart[keep], far.near[keep])
