"""Gaps: how far the stretches of surface that no point of the path reaches are from the path.

Nearly every gap is what the cutter leaves in an inside corner, where it stands still at one point while the surface
goes in and out again: nothing in it is farther from the path than from that point.  The bound is the distance when
nothing else of the path is nearer to the place where it is met; every other gap is left to `farthest`.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.geometry.aligned import aligned_pairs
from core.geometry.boxes import near_pairs
from core.geometry.distance import distance
from core.geometry.measured import Flags, Floats, Points, Rows, at, place, travelled
from core.records import dataclass
from core.tolerance import ON_PATH
from core.verify.farthest import FINE, Farthest, farthest
from core.verify.pairs import Pairs
from core.verify.reach import Stretches, changes
from core.verify.unproved import company_boxes

WIDE: Final = 4.0
"""Gaps farther from the path than so many radii are few, and left to `farthest`."""


ON_EDGE: Final = 1e-7
"""Millimetres from the cutter's edge at which a gap's end is on it."""


@dataclass(frozen=True, eq=False, slots=True)
class Bound:
    """(k,) for each gap an end of a path's piece, the place farthest from it along the surface, and how far it is.

    `sector` is the area between the gap and the circle of the radius about that end, as seen from it, positive where
    the gap runs counter-clockwise; nan where an end of the gap that is reached is not on that circle.
    """

    corner: Points
    place: Floats
    apart: Floats
    sector: Floats

    def keep(self, chosen: Flags) -> Bound:
        """Those for which `chosen` (k,) is True."""
        return Bound(self.corner[chosen], self.place[chosen], self.apart[chosen], self.sector[chosen])


def bounds(pairs: Pairs, gaps: Stretches, near: Rows, radius: float) -> Bound:
    """What no place of each gap is farther from the path than; `near` (2, k) are the pieces at its ends."""
    parts = _parts(pairs, gaps)
    corner = _corner(pairs, near, parts)
    off = _off(parts, corner, near, radius)
    _to_common_ends(pairs, parts, corner, (off & (near >= 0).all(axis=0)).nonzero()[0], radius)
    off[off] = _off(parts, corner, near, radius)[off]
    seen = parts.points - corner[parts.owner]
    apart = np.abs(seen)
    sector = _sectors(pairs, parts, seen, radius)
    sector[off] = np.nan
    _to_arcs(pairs, parts, corner, apart)
    most = np.maximum.reduceat(apart, parts.begins)
    where = (apart == most[parts.owner]).nonzero()[0]
    first = where[changes(parts.owner[where])]
    return Bound(corner, parts.s[first], most, sector)


@dataclass(frozen=True, eq=False, slots=True)
class _Parts:
    """What of each gap, `owner`, lies on one surface piece `j`, in order: its first place, and the gap's last place
    as one more; `begins` and `ends` are the first and the last of each gap."""

    owner: Rows
    j: Rows
    s: Floats
    points: Points
    begins: Rows
    ends: Rows


def _parts(pairs: Pairs, gaps: Stretches) -> _Parts:
    stations = pairs.surface_stations
    count = len(gaps)
    places = np.concatenate((gaps.first, gaps.last))
    places[:count] += ON_PATH
    places[count:] -= ON_PATH
    index, t = place(pairs.surface, stations, places)
    low, high = index[:count], index[count:]
    np.maximum(low, high, out=high)
    counts = high - low + 2
    ends = np.cumsum(counts) - 1
    begins = ends - counts + 1
    owner = np.repeat(np.arange(len(low)), counts)
    j = np.arange(len(owner)) - (begins - low)[owner]
    j[ends] = high
    s, points = stations[j], pairs.surface.start[j]
    found = at(pairs.surface.take(index), t)
    s[begins], s[ends] = gaps.first, gaps.last
    points[begins], points[ends] = found[:count], found[count:]
    return _Parts(owner, j, s, points, begins, ends)


def _corner(pairs: Pairs, near: Rows, parts: _Parts) -> Points:
    """(k,) of the ends of the pieces at each gap's ends the one nearest to that of these which is farther from it."""
    known = np.where(near < 0, near[::-1], near)
    start = pairs.centre.start[known]
    ends = np.concatenate((start, start + pairs.centre.vector[known]))
    first, last = parts.points[parts.begins], parts.points[parts.ends]
    apart = np.maximum(np.abs(ends - first), np.abs(ends - last))
    best: Points = ends[0]
    least = apart[0]
    for end, far in zip(ends[1:], apart[1:], strict=True):
        nearer = far < least
        best, least = np.where(nearer, end, best), np.where(nearer, far, least)
    return best


def _to_arcs(pairs: Pairs, parts: _Parts, corner: Points, apart: Floats) -> None:
    """Parts on arcs that have their farthest place within them: it replaces the first one."""
    rows = (pairs.surface.turn[parts.j[:-1]] * (parts.owner[1:] == parts.owner[:-1])).nonzero()[0]
    if not len(rows):
        return
    arc, p = pairs.surface.take(parts.j[rows]), corner[parts.owner[rows]]
    s = pairs.surface_stations[parts.j[rows]] + travelled(arc, arc.centre - p) * arc.radius
    inner = (s > parts.s[rows]) & (s < parts.s[rows + 1])
    parts.s[rows[inner]] = s[inner]
    apart[rows[inner]] = (np.abs(arc.centre - p) + arc.radius)[inner]


def _sectors(pairs: Pairs, parts: _Parts, seen: Points, radius: float) -> Floats:
    """(k,) area between each gap and the circle about the point from which its parts begin at `seen`."""
    turned = np.conj(seen[:-1]) * seen[1:]
    angle, area = np.angle(turned), 0.5 * turned.imag
    rows = pairs.surface.turn[parts.j[:-1]].nonzero()[0]
    if len(rows):
        arc = pairs.surface.take(parts.j[rows])
        sweep = (parts.s[rows + 1] - parts.s[rows]) / arc.radius
        area[rows] += 0.5 * arc.turn * arc.radius**2 * (sweep - np.sin(sweep))
        t = (parts.s[rows] - pairs.surface_stations[parts.j[rows]]) / arc.length
        middle = seen[rows] + at(arc, t + 0.5 * sweep / arc.angle) - parts.points[rows]
        angle[rows] = np.angle(np.conj(seen[rows]) * middle) + np.angle(np.conj(middle) * seen[rows + 1])
    area -= 0.5 * radius * radius * angle
    area[parts.ends[:-1]] = 0.0
    sums: Floats = np.add.reduceat(np.concatenate((area, (0.0,))), parts.begins)
    return sums


def _off(parts: _Parts, corner: Points, near: Rows, radius: float) -> Flags:
    """Gaps of which an end that is reached is not as far from the corner as the cutter's edge."""
    ends = parts.points[np.array((parts.begins, parts.ends))]
    off: Flags = np.any((np.abs(np.abs(ends - corner) - radius) > ON_EDGE) & (near >= 0), axis=0)
    return off


def _to_common_ends(pairs: Pairs, parts: _Parts, corner: Points, gaps: Rows, radius: float) -> None:
    """Corners of these gaps moved to an end of a piece that has both ends of the gap on the cutter's edge, if any has.

    Several pieces may reach the one end of a gap, such as all that roll about a joint, and any of them stands for it.
    """
    if not len(gaps):
        return
    first, last = parts.points[parts.begins[gaps]], parts.points[parts.ends[gaps]]
    spots = np.array((first.real, first.imag, first.real, first.imag))
    k, i = near_pairs(spots, pairs.centre_boxes, radius + ON_EDGE)
    ends = np.array((pairs.centre.start[i], pairs.centre.start[i] + pairs.centre.vector[i]))
    misses = np.maximum(np.abs(np.abs(ends - first[k]) - radius), np.abs(np.abs(ends - last[k]) - radius))
    # from the last to the first, which is to stand for them all
    end, pair = (misses <= ON_EDGE)[::-1, ::-1].nonzero()
    corner[gaps[k[::-1][pair]]] = ends[::-1, ::-1][end, pair]


def thickest(pairs: Pairs, gaps: Stretches, near: Rows, bound: Bound, radius: float) -> Farthest:
    """The largest distance from the path, within FINE, on each gap.

    Uneven arcs leave open which piece is the nearest at the end of a gap.
    """
    proved = _proved(pairs, near, bound, radius)
    rest = (~proved).nonzero()[0]
    if not len(rest):
        return Farthest(bound.place, bound.apart)
    known = np.zeros(len(gaps), np.bool_)
    known[rest] = True
    grant = float(pairs.grant.max(initial=0.0))
    at_ends = np.where(pairs.centre.slack.any() or pairs.surface.slack.any(), -1, near[:, rest])
    far = farthest(pairs.surface, gaps.keep(known), pairs.centre, pairs.centre_boxes, at_ends, radius + grant)
    where, apart = bound.place.copy(), bound.apart.copy()
    where[rest], apart[rest] = far.place, far.apart
    return Farthest(where, apart)


def _proved(pairs: Pairs, near: Rows, bound: Bound, radius: float) -> Flags:
    """Gaps whose bound is the distance of its place from the path."""
    proved = bound.apart <= WIDE * radius
    rows = proved.nonzero()[0]
    index, t = place(pairs.surface, pairs.surface_stations, bound.place[rows])
    points, apart = at(pairs.surface.take(index), t), bound.apart[rows]
    around = np.array((points.real - apart, points.imag - apart, points.real + apart, points.imag + apart))
    k, i = _moves_about(pairs, around, _at_joints(pairs, near[:, rows], bound.keep(proved), index))
    nearer = distance(pairs.centre.take(i), points[k]) < apart[k] - FINE
    proved[rows[k[nearer]]] = False
    return proved


def _at_joints(pairs: Pairs, near: Rows, bound: Bound, index: Rows) -> Rows:
    """The wall behind each gap whose place is the joint of two straight walls with own pieces that meet at its corner.

    Those pieces run beside their walls up to the corner, whose feet are not beyond the joint: no other place of them
    is nearer to it.  -1 for any other gap.
    """
    own, surface, centre = pairs.own, pairs.surface, pairs.centre
    if not len(own.piece):
        return np.full(len(index), -1)
    before = np.maximum(index - 1, 0)
    joint = (index > 0) & (near[0] >= 0) & (near[1] == near[0] + 1)
    joint &= (own.piece[before] == near[0]) & (own.piece[index] == near[1])
    joint &= (surface.turn[before] == 0.0) & (surface.turn[index] == 0.0)
    joint &= np.abs(bound.place - pairs.surface_stations[index]) <= ON_PATH
    joint &= np.abs(centre.start[near[1]] - bound.corner) <= ON_PATH
    joint &= np.abs(centre.start[near[0]] + centre.vector[near[0]] - bound.corner) <= ON_PATH
    return np.where(joint, before, -1)


def _moves_about(pairs: Pairs, around: Floats, joint: Rows) -> tuple[Rows, Rows]:
    """Boxes k and pieces i of the path that meet, but for the two that belong to the joints."""
    own, one, rest = pairs.own, (joint >= 0).nonzero()[0], (joint < 0).nonzero()[0]
    k, i = near_pairs(around[:, rest], pairs.centre_boxes, 0.0)
    if not len(one):
        return rest[k], i
    loose = (~own.settled(len(pairs.centre))).nonzero()[0]
    boxes = around[:, one]
    other, stray = near_pairs(boxes, pairs.centre_boxes[:, loose], 0.0)
    spread = np.full((4, len(own.piece)), np.inf)
    spread[2:] = -np.inf
    spread[:, joint[one]] = boxes
    back = np.zeros(len(own.piece), np.intp)
    back[joint[one]] = one
    wall, company = aligned_pairs(spread, company_boxes(pairs.centre_boxes, own), 0.0, 1)
    pieces = np.where(company == wall + 1, -1, own.piece[company]), own.corner[company]
    walls, moves = np.concatenate((wall, wall)), np.concatenate(pieces)
    there = moves >= 0
    return np.concatenate((rest[k], one[other], back[walls[there]])), np.concatenate((i, loose[stray], moves[there]))
