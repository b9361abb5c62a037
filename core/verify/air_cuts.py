"""Air cuts, and pieces that run along the surface against its direction.

Neither is a gouge.  Lead moves always cut air; in a path read from a file, any other air cut, or a piece traveled
backwards, is a mistake worth seeing.
"""

from __future__ import annotations

from math import isinf
from typing import Final

import numpy as np

from core.geometry.distance import foot
from core.geometry.path import Flags, Path, Rows
from core.geometry.piece_arrays import at, batches_by_kind, direction, piece_arrays
from core.tolerance import ON_PATH, STOCK
from core.verify.pairs import Pairs, measurable, near_ends_and_middle, pairs_of, piece_within, rounding_of
from core.verify.uncut import MAX_POINT_LENGTH, gaps_of, stretches
from core.verify.verdict import Uncut

MAX_PARALLEL_SINE: Final = 1e-6
"""Sine of the largest angle at which a move and the wall it touches count as parallel."""

MAX_DIRECTIONLESS_LENGTH: Final = 1e-5
"""Millimeters up to which a piece has no direction: rounding leaves it where two walls nearly run on tangent."""


AirCut = Uncut
"""A stretch of the path farther from the surface than the radius; `thickness` is its largest distance less that."""


def may_cut_air(pairs: Pairs, radius: float) -> tuple[int, ...]:
    """Return the rows of pieces without a single wall that is within the radius of both ends and the middle."""
    near = np.zeros(len(pairs.pieces), np.bool_)
    near[pairs.i[near_ends_and_middle(pairs, radius)]] = True
    return tuple(pairs.pieces.rows[~near].tolist())


def air_cuts(surface: Path, radius: float, center: Path) -> tuple[AirCut, ...]:
    """Return where `center` is farther from the surface than the radius (millimeters), in the order of travel.

    A path that cannot be judged has no air cuts.
    """
    if not (len(surface) and len(center) and measurable(radius, surface, center)):
        return ()
    with np.errstate(all="ignore"):
        walls, moves = piece_arrays(surface), piece_arrays(center)
        if isinf(float(walls.slack.max() + moves.slack.max())):
            return ()
        return _air_cuts(pairs_of(moves, walls, rounding_of(walls)), radius, center)


def _air_cuts(pairs: Pairs, radius: float, center: Path) -> tuple[AirCut, ...]:
    """Use the search for uncut surface with path and surface swapped: path that does not reach the surface cuts air."""
    fully_reached = np.zeros(len(pairs.pieces), np.bool_)
    fully_reached[pairs.i[piece_within(pairs, radius + pairs.tolerance)]] = True
    gaps = gaps_of(pairs, fully_reached, radius)
    return tuple(cut for cut in stretches(gaps, center.numbers[pairs.pieces.rows], radius) if cut.thickness > STOCK)


def backwards(pairs: Pairs, radius: float) -> tuple[int, ...]:
    """Return the rows of pieces with a direction that touch walls, always against the walls' direction.

    Only the walls nearest to a piece count: a piece that gouges may run along others behind them either way.
    """
    against = (_directions(pairs, radius) < 0) & (pairs.pieces.length > MAX_DIRECTIONLESS_LENGTH)
    return tuple(pairs.pieces.rows[against].tolist())


def _directions(pairs: Pairs, radius: float) -> Rows:
    """Return (n,) +1 for pieces that run with some wall they touch, -1 if they run against all of them, else 0."""
    touching = (pairs.least <= radius + pairs.tolerance).nonzero()[0]
    signs = np.zeros(len(touching), np.intp)
    for batch in batches_by_kind(pairs.pieces.arcs[pairs.i[touching]], pairs.others.arcs[pairs.j[touching]]):
        signs[batch] = _direction(pairs.keep(touching[batch]), radius)
    directions = np.zeros(len(pairs.pieces), np.intp)
    directions[pairs.i[touching[signs < 0]]] = -1
    directions[pairs.i[touching[signs > 0]]] = 1
    return directions


def _direction(pairs: Pairs, radius: float) -> Rows:
    """Return +1 if a piece and the wall it touches run side by side in the same direction, -1 if opposite, else 0."""
    limit = radius + pairs.tolerance
    piece, wall = pairs.pieces.take(pairs.i), pairs.others.take(pairs.j)
    feet = foot(wall, np.array((piece.start, piece.end)))
    reached = np.concatenate((pairs.from_other, pairs.from_piece[::2])) <= limit
    fractions = np.array((np.zeros(len(feet[0])), np.ones(len(feet[0])), *feet))
    begin, end = np.where(reached, fractions, 2.0).min(axis=0), np.where(reached, fractions, -2.0).max(axis=0)
    wide = (end - begin) * wall.length > MAX_POINT_LENGTH
    turn = piece.turn * wall.turn
    straight = ~(piece.arcs | wall.arcs) & (pairs.least >= radius - pairs.tolerance)
    deviation = np.abs(piece.center - wall.center) + np.abs(np.abs(piece.radius - wall.radius) - radius)
    comparable = straight | ((turn != 0.0) & (deviation <= pairs.tolerance))
    sign = np.sign(np.where(turn == 0.0, (piece.vector * np.conj(wall.vector)).real, turn))
    directions: Rows = np.where(wide & comparable, sign, 0.0).astype(np.intp)
    to_measure = (~comparable & (np.abs(pairs.from_piece[1] - radius) <= 2.0 * (pairs.tolerance + ON_PATH))).nonzero()[
        0
    ]
    if len(to_measure):
        directions[to_measure] = _direction_at_middle(pairs.keep(to_measure), radius)
    return directions


def _direction_at_middle(pairs: Pairs, radius: float) -> Rows:
    """Return the same for pieces whose middle is a radius from the wall and parallel to it there."""
    piece, wall = pairs.pieces.take(pairs.i), pairs.others.take(pairs.j)
    half = np.full(len(pairs.i), 0.5)
    middle = at(piece, half)
    t = foot(wall, middle)
    turn = direction(piece, half) * np.conj(direction(wall, t))
    touching: Flags = np.abs(np.abs(middle - at(wall, t)) - radius) <= pairs.tolerance + ON_PATH
    parallel = touching & (t > 0.0) & (t < 1.0) & (np.abs(turn.imag) < MAX_PARALLEL_SINE)
    return np.where(parallel, np.sign(turn.real), 0.0).astype(np.intp)
