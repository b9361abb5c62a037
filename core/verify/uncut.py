"""Uncut: the stretches of surface that no point of the center path reaches, and how thick they stay."""

from __future__ import annotations

from math import inf, nan

import numpy as np

from core.geometry.path import Flags, Floats, Path, Points
from core.geometry.piece import Side
from core.tolerance import CLOSED, STOCK
from core.verify.gaps import Bound, GapParts, bounds, parts_of, thickest
from core.verify.pairs import Pairs
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
    parts = parts_of(pairs, gaps)
    if not len(pairs.center):
        every, far, unknown = np.ones(len(gaps), np.bool_), np.full(len(gaps), inf), np.full(len(gaps), nan)
        return _told(pairs, surface, parts, every, parts.points[parts.begins], far, unknown)
    over = closed and bool(gaps.first[0] == 0.0 and gaps.last[-1] == total)
    bound = bounds(pairs, parts, near, radius)
    thick = bound.apart > radius + STOCK
    if over and (thick[0] or thick[-1]):
        thick[0] = thick[-1] = True
    if not thick.any():
        return NOTHING
    if not thick.all():
        gaps, near, bound = gaps.keep(thick), near[:, thick], bound.keep(thick)
    sign = 0 if side is None else side.sign
    area = _areas(np.where((near < 0).any(axis=0), nan, bound.sector), sign)
    points, apart = thickest(pairs, gaps, near, bound, radius)
    told = _told(pairs, surface, parts, thick, points, apart - radius, area)
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


def _told(
    pairs: Pairs, surface: Path, parts: GapParts, chosen: Flags, thickest: Points, thickness: Floats, area: Floats
) -> UncutStretches:
    begins, ends = parts.begins[chosen], parts.ends[chosen]
    numbers, first, last = surface.numbers[pairs.surface.rows], parts.j[begins], parts.j[ends]
    start, end, length = parts.points[begins], parts.points[ends], parts.s[ends] - parts.s[begins]
    return UncutStretches(numbers[first], numbers[last], start, end, length, thickness, thickest, area)
