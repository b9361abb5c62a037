"""Gouge: the stretches of a center path nearer to the surface than the radius, each with its deepest point."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from core.geometry.distance import foot
from core.geometry.path import Floats, Path, Rows
from core.geometry.piece_arrays import at
from core.tolerance import JOINED, ON_PATH
from core.verify.pairs import Approaches, Pairs
from core.verify.reach import Parts, Stretches, changes, joined, union, within
from core.verify.verdict import Gouge


@dataclass(frozen=True, eq=False, slots=True)
class Gouging:
    """k stretches of the center path that gouge, and of each the deepest place, its distance and its pair (i, j)."""

    stretches: Stretches
    place: Floats
    apart: Floats
    i: Rows
    j: Rows


def gouging(pairs: Pairs, near: Approaches) -> Gouging:
    """Where the center path is nearer to the surface than the limits of `near`."""
    if not len(near.i):
        return Gouging(Stretches(near.limit, near.limit), near.limit, near.limit, near.i, near.j)
    parts = within(pairs.center, near.i, pairs.surface, near.j, near.limit)
    k, pair = (near.apart < near.limit).nonzero()
    spots = pairs.center_stations[near.i[pair]] + near.places[k, pair] * pairs.center.length[near.i[pair]]
    every = joined((parts, Parts(spots, spots, spots, near.apart[k, pair], pair)))
    return _deepest(every, near.i, near.j)


def _deepest(parts: Parts, i: Rows, j: Rows) -> Gouging:
    """Parts as stretches, each with the least distance measured in it; of equal ones the earliest along the path."""
    stretches = union(parts.first, parts.last)
    owner, apart = stretches.index(parts.middle), np.round(parts.apart / ON_PATH)
    least = np.full(len(stretches), np.inf)
    np.minimum.at(least, owner, apart)
    deepest = (apart == least.take(owner)).nonzero()[0]
    owner = owner[deepest]
    order = np.lexsort((parts.pair[deepest], owner))
    best = deepest[order[changes(owner[order])]]
    pair = parts.pair[best]
    return Gouging(stretches, parts.middle[best], parts.apart[best], i[pair], j[pair])


def gouges(found: Gouging, pairs: Pairs, radius: float, surface: Path, numbers: Floats) -> tuple[Gouge, ...]:
    """The stretches as `Gouge`s, deepest first; `numbers` are those of the center path's pieces."""
    if not len(found.i):
        return ()
    piece, other = pairs.center.take(found.i), pairs.surface.take(found.j)
    length = np.where(piece.length == 0.0, 1.0, piece.length)
    t = (found.place - pairs.center_stations[found.i]) / length
    points = at(piece, np.minimum(np.maximum(t, 0.0), 1.0))
    touched = at(other, foot(other, points))
    told = [
        Gouge(depth, (p.real, p.imag), (q.real, q.imag), row, numbers.item(row), surface.numbers.item(wall), extent)
        for depth, p, q, row, wall, extent in zip(
            (radius - found.apart).tolist(),
            points.tolist(),
            touched.tolist(),
            piece.rows.tolist(),
            other.rows.tolist(),
            (found.stretches.last - found.stretches.first).tolist(),
            strict=True,
        )
    ]
    if len(told) > 1 and _over_seam(found.stretches, pairs):
        deeper, less = sorted((told[0], told[-1]), key=lambda gouge: -gouge.depth)
        told = [*told[1:-1], replace(deeper, extent=deeper.extent + less.extent)]
    return tuple(sorted(told, key=lambda gouge: -gouge.depth))


def _over_seam(stretches: Stretches, pairs: Pairs) -> bool:
    """The first and the last stretch are one: the path ends where it begins, and gouges there."""
    meets = bool(abs(pairs.center.end[-1] - pairs.center.start[0]) <= JOINED)
    return (
        meets and bool(stretches.first[0] <= JOINED) and bool(stretches.last[-1] >= pairs.center_stations[-1] - JOINED)
    )
