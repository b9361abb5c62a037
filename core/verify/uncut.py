"""Uncut: the stretches of surface that no point of the centre path reaches, and how thick they stay."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.geometry.distance import band_places, feet
from core.geometry.measured import Flags, Floats, Measured, Points, Rows, at, place
from core.geometry.path import Path
from core.tolerance import ON_PATH, STOCK, UNCUT
from core.verify.farthest import Farthest, farthest
from core.verify.pairs import Pairs, middle_distances
from core.verify.reach import Parts, Stretches, joined, union, within
from core.verify.thin import thin
from core.verify.verdict import Uncut

FEW: Final = 1500
"""Pairs that are all tried at once."""


@dataclass(frozen=True, eq=False, slots=True)
class Reached:
    """Stretches of surface that are reached, and the pieces of the centre path that reach their two ends."""

    stretches: Stretches
    begin: Rows
    end: Rows

    def gaps(self, total: float) -> tuple[Stretches, Rows]:
        """What is not reached and longer than STOCK, and (2, k) the centre pieces at its ends, -1 at the contour's."""
        before, behind = np.concatenate(([-1], self.end)), np.concatenate((self.begin, [-1]))
        gaps = Stretches(np.append(0.0, self.stretches.last), np.append(self.stretches.first, total))
        wide = gaps.last - gaps.first > STOCK
        return gaps.keep(wide), np.stack((before, behind))[:, wide]


def reached(pairs: Pairs, radius: float) -> Reached:
    """The stretches of surface within the radius of the centre path.

    UNCUT, rounding of the coordinates themselves and the slack of uneven arcs decide whether a place is reached;
    where a stretch ends is then settled with the radius alone.  The centre path's piece nearest to the middle of a
    surface piece is tried first; where it reaches all, no other is.
    """
    grant = UNCUT + _rounding(pairs.surface) + pairs.slack
    parts = _within(
        pairs, np.arange(len(pairs.j)) if len(pairs.j) <= FEW else _nearest_to_middle(pairs), radius + grant
    )
    stretches = union(parts.first, parts.last)
    whole = _whole(pairs, stretches)
    if whole.all():
        return Reached(stretches, np.full(len(stretches), -1), np.full(len(stretches), -1))
    if len(pairs.j) > FEW:
        rest = np.flatnonzero(~whole[pairs.j])
        parts = joined((parts, _within(pairs, rest, radius + grant)))
    return _settled(pairs, parts, union(parts.first, parts.last), radius, grant)


def _settled(pairs: Pairs, parts: Parts, stretches: Stretches, radius: float, grant: Floats) -> Reached:
    """Both ends of each stretch drawn in to where the piece that reaches them does so with the radius alone."""
    owner = stretches.index(parts.first)
    change = np.flatnonzero(np.diff(np.sort(owner), append=-1))
    begin, end = np.lexsort((-parts.first, owner))[change], np.lexsort((parts.last, owner))[change]
    pair = parts.pair[np.concatenate((begin, end))]
    ends = np.concatenate((stretches.first, stretches.last))
    inward = np.repeat((1.0, -1.0), len(stretches))
    ends = _draw_in(pairs, pair, ends, inward, radius, grant[pair])
    first, last = ends[: len(stretches)], ends[len(stretches) :]
    return Reached(Stretches(first, np.maximum(first, last)), pairs.i[parts.pair[begin]], pairs.i[parts.pair[end]])


def _draw_in(pairs: Pairs, pair: Rows, ends: Floats, inward: Floats, radius: float, grant: Floats) -> Floats:
    """Ends moved `inward` (+1 or -1 along the surface) to where the distance is the radius, or least.

    What is granted moves an end by as much as sqrt(2 r grant) where the reach ends in a circle about the end of a
    move beside the wall; the foot of that end is where it stops when the wall is exactly a radius away.
    """
    i, j = pairs.i[pair], pairs.j[pair]
    piece, other = pairs.surface.take(j), pairs.centre.take(i)
    places = np.concatenate((band_places(piece, other, np.full(len(pair), radius)), feet(piece, other)))
    moved = (pairs.surface_stations[j] + places * piece.length - ends) * inward
    widest = 2.0 * np.sqrt(2.0 * (radius + grant) * grant)
    least = np.where((moved > 0.0) & (moved < widest), moved, np.inf).min(axis=0)
    return ends + inward * np.where(np.isinf(least), 0.0, least)


def _rounding(surface: Measured) -> float:
    """Four units in the last place of the largest coordinate or radius."""
    largest = max(np.abs(surface.start.real).max(), np.abs(surface.start.imag).max(), surface.radius.max())
    return 4.0 * float(np.spacing(largest))


def _nearest_to_middle(pairs: Pairs) -> Rows:
    """Of each surface piece that has pairs the one whose centre piece is nearest to its middle."""
    apart = middle_distances(pairs.surface, pairs.j, pairs.centre, pairs.i)
    order = np.lexsort((apart, pairs.j))
    nearest: Rows = order[np.flatnonzero(np.diff(pairs.j[order], prepend=-1))]
    return nearest


def _within(pairs: Pairs, chosen: Rows, reach: Floats) -> Parts:
    parts = within(pairs.surface, pairs.j[chosen], pairs.centre, pairs.i[chosen], reach[chosen])
    return replace(parts, pair=chosen[parts.pair])


def _whole(pairs: Pairs, stretches: Stretches) -> Flags:
    """(n,) surface pieces that lie on one stretch from end to end."""
    first, last = pairs.surface_stations[:-1], pairs.surface_stations[1:]
    if not len(stretches):
        return np.zeros(len(first), np.bool_)
    owner = stretches.index(first + ON_PATH)
    return (owner >= 0) & (stretches.last[owner] >= last - ON_PATH)


def uncut(pairs: Pairs, radius: float, surface: Path, *, closed: bool) -> tuple[Uncut, ...]:
    """Stretches farther than the radius from the path, in the contour's order, each over its joints in one.

    In a closed contour a stretch that runs over START stands last.  What is nowhere thicker than STOCK is left out.
    """
    total = float(pairs.surface_stations[-1])
    gaps, near = reached(pairs, radius).gaps(total)
    thick = ~thin(pairs, gaps, near, radius)
    gaps, near = gaps.keep(thick), near[:, thick]
    if not len(gaps):
        return ()
    far = _farthest(pairs, gaps, near, radius)
    told = _stretches(pairs, gaps, far, radius, surface)
    if closed and len(told) > 1 and gaps.first[0] == 0.0 and gaps.last[-1] == total:
        told = [*told[1:-1], _over_start(told[-1], told[0])]
    return tuple(stretch for stretch in told if stretch.thickness > STOCK)


def _farthest(pairs: Pairs, gaps: Stretches, near: Rows, radius: float) -> Farthest:
    if not len(pairs.centre):
        return Farthest(gaps.first, np.full(len(gaps), np.inf))
    grant = float(pairs.slack.max(initial=0.0))
    return farthest(pairs.surface, gaps, pairs.centre, near, radius + STOCK + grant)


def _stretches(pairs: Pairs, gaps: Stretches, far: Farthest, radius: float, surface: Path) -> list[Uncut]:
    begin, first = _points(pairs, gaps.first, ON_PATH)
    end, last = _points(pairs, gaps.last, -ON_PATH)
    thickest, _ = _points(pairs, far.place, 0.0)
    columns = (
        surface.numbers[first].tolist(),
        surface.numbers[last].tolist(),
        begin.tolist(),
        end.tolist(),
        (gaps.last - gaps.first).tolist(),
        (far.apart - radius).tolist(),
        thickest.tolist(),
    )
    return [
        Uncut(one, other, (p.real, p.imag), (q.real, q.imag), length, thickness, (t.real, t.imag))
        for one, other, p, q, length, thickness, t in zip(*columns, strict=True)
    ]


def _points(pairs: Pairs, s: Floats, inward: float) -> tuple[Points, Rows]:
    """Points of the surface at places along it, and the contour's rows they are on, at a joint the one `inward`."""
    index, _ = place(pairs.surface, pairs.surface_stations, s + inward)
    piece = pairs.surface.take(index)
    t = (s - pairs.surface_stations[index]) / np.where(piece.length == 0.0, 1.0, piece.length)
    return at(piece, np.clip(t, 0.0, 1.0)), piece.rows


def _over_start(last: Uncut, first: Uncut) -> Uncut:
    """The closed contour's last and first stretch as the one they are."""
    thicker = max(last, first, key=lambda stretch: stretch.thickness)
    return Uncut(
        last.first_number,
        first.last_number,
        last.start,
        first.end,
        last.length + first.length,
        thicker.thickness,
        thicker.thickest,
    )
