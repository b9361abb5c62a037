"""Stray: where a center path is off the surface by more than the radius, and where it runs against the contour.

Neither is a gouge.  Lead moves are always away; in a path read from elsewhere a stretch away that is no lead move, or a
piece traveled backwards, is a mistake worth seeing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isinf

import numpy as np

from core.geometry.path import Path
from core.geometry.piece import Point
from core.tolerance import GOUGE
from core.verify.contact import backwards
from core.verify.course import courses
from core.verify.judge import judgeable
from core.verify.pairs import Pairs, pairs_of
from core.verify.uncut import uncut


@dataclass(frozen=True, slots=True)
class Away:
    """A stretch of the path farther from the surface than the radius: numbers and places of its ends, its length.

    `beyond` is how much farther than the radius it gets, at `farthest`.
    """

    first_number: float
    last_number: float
    start: Point
    end: Point
    length: float
    beyond: float
    farthest: Point


@dataclass(frozen=True, eq=False, slots=True)
class Stray:
    """Stretches away from the surface in the path's order, and the rows of pieces that run against all they touch."""

    away: tuple[Away, ...]
    backwards: tuple[int, ...]


def stray(surface: Path, radius: float, center: Path) -> Stray:
    """Where `center` leaves the surface by more than the radius (millimeters), and where it runs backwards.

    Nothing is told of a path that cannot be judged.
    """
    if not (len(surface) and len(center) and judgeable(radius, surface, center)):
        return Stray((), ())
    with np.errstate(all="ignore"):
        walls, moves = courses((surface,), (center,))
        slack = float(walls.pieces.slack.max() + moves.pieces.slack.max())
        if isinf(slack):
            return Stray((), ())
        reach = radius + 10.0 * GOUGE + slack
        pairs, turned = pairs_of(moves, walls, radius, reach), pairs_of(walls, moves, radius, reach)
        return Stray(_away(turned, radius, center), backwards(pairs, radius))


def _away(pairs: Pairs, radius: float, center: Path) -> tuple[Away, ...]:
    """The path is to the surface what the surface is to the path: what it does not reach it is away from."""
    told = uncut(pairs, radius, center, closed=False)
    return tuple(
        Away(one.first_number, one.last_number, one.start, one.end, one.length, one.thickness, one.thickest)
        for one in told
    )
