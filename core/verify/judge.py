"""The judge: what a centre path, whoever made it, does to a surface."""

from __future__ import annotations

from math import inf, isfinite, isinf, nan

import numpy as np

from core.geometry.measured import Measured, measured
from core.geometry.path import Path
from core.geometry.side import Side
from core.tolerance import CLOSED, GOUGE, LARGEST
from core.verify.crossing import Crossings, crossings
from core.verify.gouge import gouges, gouging
from core.verify.pairs import approaches, clearance, middles, pairs_of
from core.verify.sides import sided, wrong_side
from core.verify.uncut import uncut
from core.verify.verdict import Verdict


def judge(surface: Path, side: Side, radius: float, centre: Path) -> Verdict:
    """What a cutter of this radius does whose centre runs along `centre`, lead moves included, beside `surface`.

    Every distance is exact, between lines and arcs.  Nearer than the radius by no more than GOUGE, or than what the
    uneven radii of an arc leave open, is rounding and no gouge.  Nothing is raised for any joined paths: coordinates
    or a radius that are not finite, or larger than LARGEST, and arcs whose radii at both ends differ by more than
    ARC_RADII give a verdict that is not `judged` and so never clean.
    """
    if not judgeable(surface, radius, centre):
        return _unjudged(radius)
    if not len(surface):
        return Verdict(radius, inf, (), (), 0.0, crosses_itself=False)
    with np.errstate(all="ignore"):
        return _judged(surface, side, radius, centre)


def judgeable(surface: Path, radius: float, centre: Path) -> bool:
    """All coordinates and the radius are lengths a machine could have."""
    return _sound(surface) and _sound(centre) and isfinite(radius) and 0.0 <= radius <= LARGEST


def _unjudged(radius: float) -> Verdict:
    return Verdict(radius, nan, (), (), nan, crosses_itself=False, judged=False)


def _sound(path: Path) -> bool:
    return all(bool(np.all(np.abs(array) <= LARGEST)) for array in (path.points, path.centres))


def _judged(surface: Path, side: Side, radius: float, centre: Path) -> Verdict:
    walls, moves = measured(surface), measured(centre)
    slack = _largest_slack(walls) + _largest_slack(moves)
    if isinf(slack):
        return _unjudged(radius)
    reach = radius + 10.0 * GOUGE
    pairs = pairs_of(moves, walls, reach + slack)
    closed = _closed(walls)
    crossed = crossings(walls, pairs.surface_stations, pairs.surface_boxes, closed=closed)
    middle = middles(pairs)
    near = approaches(pairs, middle, radius - GOUGE)
    found = gouging(pairs, near)
    sides = sided(side, crossed, float(pairs.surface_stations[-1]), closed=closed)
    return Verdict(
        radius=radius,
        clearance=clearance(pairs, near, reach),
        gouges=gouges(found, pairs, radius, surface, centre),
        uncut=uncut(pairs, radius, surface, closed=closed),
        surface_length=float(pairs.surface_stations[-1]),
        crosses_itself=len(crossed) > 0,
        wrong_side=wrong_side(pairs, middle, found, sides, reach),
        crossing_at=_first(crossed),
    )


def _largest_slack(pieces: Measured) -> float:
    return float(pieces.slack.max(initial=0.0))


def _closed(surface: Measured) -> bool:
    return bool(abs(surface.end[-1] - surface.start[0]) <= CLOSED)


def _first(crossed: Crossings) -> tuple[float, float] | None:
    if not len(crossed):
        return None
    point = crossed.points[0].item()
    return point.real, point.imag
