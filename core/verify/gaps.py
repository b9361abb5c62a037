"""Gaps: how far the stretches of surface that no point of the path reaches are from the path.

Nearly every gap is what the cutter leaves in an inside corner, where it stands still at one point while the surface
goes in and out again: nothing in it is farther from the path than from that point.  The bound is the distance when
nothing else of the path is nearer to the place where it is met; every other gap is left to `farthest`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from core.geometry.aligned import aligned_pairs
from core.geometry.boxes import near_pairs
from core.geometry.distance import distance
from core.geometry.path import Flags, Floats, Points, Rows
from core.geometry.piece_arrays import PieceArrays, at, place, traveled
from core.tolerance import ON_PATH
from core.verify.farthest import FINE, farthest
from core.verify.pairs import Pairs
from core.verify.reach import Stretches, changes
from core.verify.unproved import company_boxes

WIDE: Final = 4.0
"""Gaps farther from the path than so many radii are few, and left to `farthest`."""


ON_EDGE: Final = 1e-7
"""Millimeters from the cutter's edge at which a gap's end is on it."""


@dataclass(frozen=True, eq=False, slots=True)
class Bound:
    """(k,) for each gap an end of a path's piece, and what of the gap is farthest from it: the place along the surface,
    its point and the surface piece `j` it is on, and how far it is.

    `sector` is the area between the gap and the circle of the radius about that end, as seen from it, positive where
    the gap runs counter-clockwise; nan where an end of the gap that is reached is not on that circle.
    """

    corner: Points
    place: Floats
    point: Points
    j: Rows
    apart: Floats
    sector: Floats

    def keep(self, chosen: Flags) -> Bound:
        """Those for which `chosen` (k,) is True."""
        corner, spot, point, j = self.corner[chosen], self.place[chosen], self.point[chosen], self.j[chosen]
        return Bound(corner, spot, point, j, self.apart[chosen], self.sector[chosen])


@dataclass(frozen=True, eq=False, slots=True)
class GapParts:
    """What of each gap, `owner`, lies on one surface piece `j`, in order: its first place and point, and the gap's last
    ones as one more; `begins` and `ends` are the first and the last of each gap."""

    owner: Rows
    j: Rows
    s: Floats
    points: Points
    begins: Rows
    ends: Rows


def parts_of(pairs: Pairs, gaps: Stretches) -> GapParts:
    """The gaps parted at the joints within them: an end at a joint is on the piece within the gap."""
    stations = pairs.surface_stations
    count = len(gaps)
    s = np.concatenate((gaps.first, gaps.last))
    inward = s.copy()
    inward[:count] += ON_PATH
    inward[count:] -= ON_PATH
    index = stations[1:-1].searchsorted(inward, side="right")
    low, high = index[:count], np.maximum(index[:count], index[count:])
    counts = high - low + 2
    behind = counts.cumsum()
    begins, ends = behind - counts, behind - 1
    owner = np.repeat(np.arange(count), counts)
    j = np.arange(len(owner)) - (begins - low)[owner]
    j[ends] = high
    at_ends, pieces = np.concatenate((begins, ends)), pairs.surface.take(index)
    t = (s - stations[index]) / np.where(pieces.length == 0.0, 1.0, pieces.length)
    places, points = stations[j], pairs.surface.start[j]
    places[at_ends], points[at_ends] = s, at(pieces, np.minimum(np.maximum(t, 0.0), 1.0))
    return GapParts(owner, j, places, points, begins, ends)


def bounds(pairs: Pairs, parts: GapParts, near: Rows, radius: float) -> Bound:
    """What no place of each gap is farther from the path than; `near` (2, k) are the pieces at its ends."""
    corner = _corner(pairs, near, parts)
    off = _off(parts, corner, near, radius)
    lost = (off & (near >= 0).all(axis=0)).nonzero()[0]
    if len(lost):
        _to_common_ends(pairs, parts, corner, lost, radius)
        off = _off(parts, corner, near, radius)
    seen = parts.points - corner[parts.owner]
    apart = np.abs(seen)
    bends = _bends(pairs, parts)
    sector = _sectors(parts, bends, seen, radius)
    sector[off] = np.nan
    s, points = (parts.s, parts.points) if bends is None else _to_arcs(parts, bends, corner, apart)
    most = np.maximum.reduceat(apart, parts.begins)
    where = (apart == most[parts.owner]).nonzero()[0]
    first = where[changes(parts.owner[where])]
    return Bound(corner, s[first], points[first], parts.j[first], most, sector)


def _corner(pairs: Pairs, near: Rows, parts: GapParts) -> Points:
    """(k,) of the ends of the pieces at each gap's ends the one nearest to that of these which is farther from it."""
    known = np.where(near < 0, near[::-1], near)
    start = pairs.center.start[known]
    ends = np.concatenate((start, start + pairs.center.vector[known]))
    first, last = parts.points[parts.begins], parts.points[parts.ends]
    apart = np.maximum(np.abs(ends - first), np.abs(ends - last))
    best: Points = ends[apart.argmin(axis=0), np.arange(len(first))]
    return best


class _Bends(NamedTuple):
    """The parts on arcs, by their rows, these arcs, and the lengths traveled at the arcs' starts."""

    rows: Rows
    arc: PieceArrays
    start: Floats


def _bends(pairs: Pairs, parts: GapParts) -> _Bends | None:
    j, within = parts.j[:-1], parts.owner[1:] == parts.owner[:-1]
    rows = (within & (pairs.surface.turn[j] != 0.0)).nonzero()[0]
    return _Bends(rows, pairs.surface.take(j[rows]), pairs.surface_stations[j[rows]]) if len(rows) else None


def _to_arcs(parts: GapParts, bends: _Bends, corner: Points, apart: Floats) -> tuple[Floats, Points]:
    """The parts' first places and points: where a part on an arc has its farthest place within it, that instead."""
    rows, arc = bends.rows, bends.arc
    away = arc.center - corner[parts.owner[rows]]
    s, size = bends.start + traveled(arc, away) * arc.radius, np.abs(away)
    # about its own center all of an arc is equally far
    inner = ((s > parts.s[rows]) & (s < parts.s[rows + 1]) & (size > 0.0)).nonzero()[0]
    places, points, chosen = parts.s.copy(), parts.points.copy(), rows[inner]
    places[chosen], apart[chosen] = s[inner], (size + arc.radius)[inner]
    points[chosen] = (arc.center + away / size * arc.radius)[inner]
    return places, points


def _sectors(parts: GapParts, bends: _Bends | None, seen: Points, radius: float) -> Floats:
    """(k,) area between each gap and the circle about the point from which its parts begin at `seen`."""
    turned = np.conj(seen[:-1]) * seen[1:]
    angle, area = np.arctan2(turned.imag, turned.real), 0.5 * turned.imag
    if bends is not None:
        rows, arc = bends.rows, bends.arc
        sweep = (parts.s[rows + 1] - parts.s[rows]) / arc.radius
        area[rows] += 0.5 * arc.turn * arc.radius**2 * (sweep - np.sin(sweep))
        t = (parts.s[rows] - bends.start) / arc.length
        middle = seen[rows] + at(arc, t + 0.5 * sweep / arc.angle) - parts.points[rows]
        angle[rows] = np.angle(np.conj(seen[rows]) * middle) + np.angle(np.conj(middle) * seen[rows + 1])
    area -= 0.5 * radius * radius * angle
    area[parts.ends[:-1]] = 0.0
    sums: Floats = np.add.reduceat(np.concatenate((area, (0.0,))), parts.begins)
    return sums


def _off(parts: GapParts, corner: Points, near: Rows, radius: float) -> Flags:
    """Gaps of which an end that is reached is not as far from the corner as the cutter's edge."""
    ends = parts.points[np.array((parts.begins, parts.ends))]
    away: Flags = (np.abs(np.abs(ends - corner) - radius) > ON_EDGE) & (near >= 0)
    off: Flags = away[0] | away[1]
    return off


def _to_common_ends(pairs: Pairs, parts: GapParts, corner: Points, gaps: Rows, radius: float) -> None:
    """Corners of these gaps moved to an end of a piece that has both ends of the gap on the cutter's edge, if any has.

    Several pieces may reach the one end of a gap, such as all that roll about a joint, and any of them stands for it.
    """
    first, last = parts.points[parts.begins[gaps]], parts.points[parts.ends[gaps]]
    spots = np.array((first.real, first.imag, first.real, first.imag))
    k, i = near_pairs(spots, pairs.center_boxes, radius + ON_EDGE)
    ends = np.array((pairs.center.start[i], pairs.center.start[i] + pairs.center.vector[i]))
    misses = np.maximum(np.abs(np.abs(ends - first[k]) - radius), np.abs(np.abs(ends - last[k]) - radius))
    # from the last to the first, which is to stand for them all
    end, pair = (misses <= ON_EDGE)[::-1, ::-1].nonzero()
    corner[gaps[k[::-1][pair]]] = ends[::-1, ::-1][end, pair]


def thickest(pairs: Pairs, gaps: Stretches, near: Rows, bound: Bound, radius: float) -> tuple[Points, Floats]:
    """(k,) the point of each gap that is farthest from the path, and its distance within FINE.

    Uneven arcs leave open which piece is the nearest at the end of a gap.
    """
    proved = _proved(pairs, near, bound, radius)
    rest = (~proved).nonzero()[0]
    if not len(rest):
        return bound.point, bound.apart
    grant = float(pairs.grant.max(initial=0.0))
    at_ends = np.where(pairs.center.slack.any() or pairs.surface.slack.any(), -1, near[:, rest])
    rest_of = gaps.keep(~proved)
    far = farthest(pairs.surface, rest_of, pairs.center, pairs.center_boxes, near=at_ends, ends=radius + grant)
    points, apart = bound.point.copy(), bound.apart.copy()
    index, t = place(pairs.surface, pairs.surface_stations, far.place)
    points[rest], apart[rest] = at(pairs.surface.take(index), t), far.apart
    return points, apart


def _proved(pairs: Pairs, near: Rows, bound: Bound, radius: float) -> Flags:
    """Gaps whose bound is the distance of its place from the path."""
    proved = bound.apart <= WIDE * radius
    rows = proved.nonzero()[0]
    some = bound if len(rows) == len(proved) else bound.keep(proved)
    x, y, apart = some.point.real, some.point.imag, some.apart
    k, i = _moves_about(
        pairs, np.array((x - apart, y - apart, x + apart, y + apart)), _at_joints(pairs, near[:, rows], some)
    )
    # of what is no number nothing is proved
    nearer = ~(distance(pairs.center.take(i), some.point[k]) >= apart[k] - FINE)
    proved[rows[k[nearer]]] = False
    return proved


def _at_joints(pairs: Pairs, near: Rows, bound: Bound) -> Rows:
    """The wall behind each gap whose place is the joint of two straight walls with own pieces that meet at its corner.

    Those pieces run beside their walls up to the corner, whose feet are not beyond the joint: no other place of them
    is nearer to it.  -1 for any other gap.
    """
    own, surface, center, index = pairs.own, pairs.surface, pairs.center, bound.j
    if not len(own.piece):
        return np.full(len(index), -1)
    before = np.maximum(index - 1, 0)
    joint = (index > 0) & (near[0] >= 0) & (near[1] == near[0] + 1)
    joint &= (own.piece[before] == near[0]) & (own.piece[index] == near[1])
    joint &= (surface.turn[before] == 0.0) & (surface.turn[index] == 0.0)
    joint &= np.abs(bound.place - pairs.surface_stations[index]) <= ON_PATH
    joint &= np.abs(center.start[near[1]] - bound.corner) <= ON_PATH
    joint &= np.abs(center.start[near[0]] + center.vector[near[0]] - bound.corner) <= ON_PATH
    return np.where(joint, before, -1)


def _moves_about(pairs: Pairs, around: Floats, joint: Rows) -> tuple[Rows, Rows]:
    """Boxes k and pieces i of the path that meet, but for the two that belong to the joints."""
    own, one, rest = pairs.own, (joint >= 0).nonzero()[0], (joint < 0).nonzero()[0]
    k, i = near_pairs(around[:, rest], pairs.center_boxes, 0.0)
    if not len(one):
        return rest[k], i
    loose = (~own.settled(len(pairs.center))).nonzero()[0]
    boxes = around[:, one]
    other, stray = near_pairs(boxes, pairs.center_boxes[:, loose], 0.0)
    spread = np.full((4, len(own.piece)), np.inf)
    spread[2:] = -np.inf
    spread[:, joint[one]] = boxes
    back = np.zeros(len(own.piece), np.intp)
    back[joint[one]] = one
    wall, company = aligned_pairs(spread, company_boxes(pairs.center_boxes, own), 0.0, 1)
    pieces = np.where(company == wall + 1, -1, own.piece[company]), own.corner[company]
    walls, moves = np.concatenate((wall, wall)), np.concatenate(pieces)
    there = moves >= 0
    return np.concatenate((rest[k], one[other], back[walls[there]])), np.concatenate((i, loose[stray], moves[there]))
