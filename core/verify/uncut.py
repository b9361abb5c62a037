"""Uncut: the stretches of surface that no point of the centre path reaches, and how thick they stay."""

from __future__ import annotations

from math import nan

import numpy as np

from core.geometry.measured import Floats, Points, Rows, at, place
from core.geometry.path import Path
from core.geometry.side import Side
from core.tolerance import CLOSED, ON_PATH, STOCK
from core.verify.farthest import Farthest
from core.verify.gaps import Bound, bounds, thickest
from core.verify.pairs import Pairs
from core.verify.reach import Stretches
from core.verify.reached import covered, reached
from core.verify.verdict import NOTHING, UncutStretches


def uncut(pairs: Pairs, radius: float, surface: Path, *, closed: bool, side: Side | None = None) -> UncutStretches:
    """Stretches farther than the radius from the path, in the contour's order, each over its joints in one.

    In a closed contour a stretch that runs over START stands last.  What is nowhere thicker than STOCK is left out.
    Areas are told of what lies on the cutter's `side`.
    """
    if covered(pairs):
        return NOTHING
    total = float(pairs.surface_stations[-1])
    gaps, near = reached(pairs, radius).gaps(total)
    if not len(gaps):
        return NOTHING
    if not len(pairs.centre):
        nowhere = Farthest(gaps.first, np.full(len(gaps), np.inf))
        return _told(pairs, gaps, nowhere, radius, surface, np.full(len(gaps), nan))
    over = closed and bool(gaps.first[0] == 0.0 and gaps.last[-1] == total)
    bound = bounds(pairs, gaps, near, radius)
    thick = bound.apart > radius + STOCK
    if over and (thick[0] or thick[-1]):
        thick[0] = thick[-1] = True
    if not thick.any():
        return NOTHING
    gaps, near, bound = gaps.keep(thick), near[:, thick], bound.keep(thick)
    sign = 0 if side is None else side.sign
    area = _areas(np.where((near < 0).any(axis=0), nan, bound.sector), sign)
    told = _told(pairs, gaps, thickest(pairs, gaps, near, bound, radius), radius, surface, area)
    if over and len(told) > 1:
        told = told.over_start(_area_over_start(bound, sign))
    return told.keep(told.thickness > STOCK)


def _areas(sector: Floats, sign: int) -> Floats:
    """Sectors on the cutter's side: a gap of a contour that crosses itself may run round the part instead."""
    return np.where(sector * sign > 0.0, np.abs(sector), nan)


def _area_over_start(bound: Bound, sign: int) -> float:
    """The area of the first and the last gap together, seen from one point; not a number if they are not."""
    one = bool(np.abs(bound.corner[0] - bound.corner[-1]) <= CLOSED)
    return float(_areas(bound.sector[:1] + bound.sector[-1:], sign)[0]) if one else nan


def _told(pairs: Pairs, gaps: Stretches, far: Farthest, radius: float, surface: Path, area: Floats) -> UncutStretches:
    inward = np.repeat((ON_PATH, -ON_PATH, 0.0), len(gaps))
    points, rows = _points(pairs, np.concatenate((gaps.first, gaps.last, far.place)), inward)
    (start, end, thickest), (first, last, _) = points.reshape(3, -1), rows.reshape(3, -1)
    return UncutStretches(
        surface.numbers[first],
        surface.numbers[last],
        start,
        end,
        gaps.last - gaps.first,
        far.apart - radius,
        thickest,
        area,
    )


def _points(pairs: Pairs, s: Floats, inward: Floats) -> tuple[Points, Rows]:
    """Points of the surface at places along it, and the contour's rows they are on, at a joint the one `inward`."""
    index, _ = place(pairs.surface, pairs.surface_stations, s + inward)
    piece = pairs.surface.take(index)
    t = (s - pairs.surface_stations[index]) / np.where(piece.length == 0.0, 1.0, piece.length)
    return at(piece, np.minimum(np.maximum(t, 0.0), 1.0)), piece.rows
