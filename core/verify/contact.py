"""Contact: which pieces of a center path keep to the surface, and which of them run against it."""

from __future__ import annotations

from typing import Final

import numpy as np

from core.geometry.distance import foot
from core.geometry.path import Flags, Rows
from core.geometry.piece_arrays import at, direction
from core.tolerance import ON_PATH
from core.verify.pairs import Pairs
from core.verify.touch import POINT

PARALLEL: Final = 1e-6
"""Sine of the angle up to which a move and the wall it touches run the same way."""


def loose(pairs: Pairs) -> tuple[int, ...]:
    """Rows of pieces that no single surface piece is a radius or less from at both ends and in the middle."""
    held = pairs.own.settled(len(pairs.center))
    held[pairs.i[pairs.touch.along]] = True
    return tuple(pairs.center.rows[~held].tolist())


def backwards(pairs: Pairs, radius: float) -> tuple[int, ...]:
    """Rows of pieces that touch walls along more than a point, all of them against the walls' direction."""
    touch, own = pairs.touch, pairs.own
    wide = (touch.last - touch.first) * pairs.surface.length.take(pairs.j) > POINT
    way = np.zeros(len(pairs.i), np.intp)
    known = wide & ~touch.unsure
    if touch.unsure.any():
        known[_about_one_center(pairs, (wide & touch.unsure).nonzero()[0], radius)] = True
        # twice what is granted there, since the distance of the middle is measured anew
        held = np.abs(touch.middle - radius) <= 2.0 * (pairs.grant + ON_PATH)
        unsure = (touch.unsure & held & ~known).nonzero()[0]
        if len(unsure):
            way[unsure] = _way_in_the_middle(pairs, unsure, radius)
    sure = known.nonzero()[0]
    way[sure] = _way(pairs, sure)
    against = np.zeros(len(pairs.center), np.bool_)
    against[pairs.i[way < 0]] = True
    if not against.any():
        return ()
    against[pairs.i[way > 0]] = False
    against[own.piece[(own.last - own.first) * pairs.surface.length[: len(own.piece)] > POINT]] = False
    return tuple(pairs.center.rows[against].tolist())


def _about_one_center(pairs: Pairs, wide: Rows, radius: float) -> Rows:
    """Those of these pairs, of more than a point beside each other, that are arcs about one center, a radius apart:
    they run one way or the other wherever they do."""
    arcs = (pairs.center.turn[pairs.i[wide]] * pairs.surface.turn[pairs.j[wide]]).nonzero()[0]
    if not len(arcs):
        return arcs
    both = wide[arcs]
    piece, other = pairs.center.take(pairs.i[both]), pairs.surface.take(pairs.j[both])
    off = np.abs(piece.center - other.center) + np.abs(np.abs(piece.radius - other.radius) - radius)
    return both[off <= pairs.grant[both]]


def _way(pairs: Pairs, chosen: Rows) -> Rows:
    """+1 where both pieces, parallel or about one center, run the same way, else -1."""
    i, j = pairs.i[chosen], pairs.j[chosen]
    turn = pairs.center.turn[i] * pairs.surface.turn[j]
    dot = (pairs.center.vector[i] * np.conj(pairs.surface.vector[j])).real
    way: Rows = np.sign(np.where(turn == 0.0, dot, turn)).astype(np.intp)
    return way


def _way_in_the_middle(pairs: Pairs, chosen: Rows, radius: float) -> Rows:
    """The same where the middle of a center piece is a radius from its partner and parallel to it there, else 0."""
    piece, other = pairs.center.take(pairs.i[chosen]), pairs.surface.take(pairs.j[chosen])
    half = np.full(len(chosen), 0.5)
    middle = at(piece, half)
    t = foot(other, middle)
    turn = direction(piece, half) * np.conj(direction(other, t))
    touching: Flags = np.abs(np.abs(middle - at(other, t)) - radius) <= pairs.grant[chosen] + ON_PATH
    alike = touching & (t > 0.0) & (t < 1.0) & (np.abs(turn.imag) < PARALLEL)
    return np.where(alike, np.sign(turn.real), 0.0).astype(np.intp)
