"""The judge: what a centre path, whoever made it, does to a surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite, isinf, nan
from typing import Final

import numpy as np

from core.geometry.measured import Floats, Measured, boxes, measured, stacked
from core.geometry.path import EMPTY, Path
from core.geometry.side import Side
from core.tolerance import CLOSED, GOUGE, LARGEST
from core.verify.beside import NOBODY, Beside, beside
from core.verify.contact import backwards, loose
from core.verify.crossing import Crossings, crossings
from core.verify.gouge import gouges, gouging
from core.verify.pairs import approaches, clearance, granted, pairs_of
from core.verify.sides import sided, wrong_side
from core.verify.uncut import uncut
from core.verify.verdict import NOTHING, Verdict

FEW: Final = 300
"""Walls of which measuring every pair costs less than proving what runs beside them."""


def judge(surface: Path, side: Side, radius: float, centre: Path) -> Verdict:
    """What a cutter of this radius does whose centre runs along `centre`, lead moves included, beside `surface`.

    Every distance is exact, between lines and arcs.  Nearer than the radius by no more than GOUGE, or than what the
    uneven radii of an arc leave open, is rounding and no gouge.  Nothing is raised for any joined paths: coordinates
    or a radius that are not finite, or larger than LARGEST, and arcs whose radii at both ends differ by more than
    ARC_RADII give a verdict that is not `judged` and so never clean.
    """
    return judge_all(surface, side, radius, (centre,))[0]


def judge_together(surface: Path, side: Side, radius: float, centres: Sequence[Path]) -> Verdict:
    """The verdict on several centre paths that are all cut, such as the loops of one contour.

    A gouge's `path_piece` counts the pieces of all of them, in order.
    """
    with np.errstate(all="ignore"):
        if not all(judgeable(surface, radius, centre) for centre in centres):
            return _unjudged(radius)
        if not len(surface) or not centres:
            return judge(surface, side, radius, EMPTY)
        moves, numbers = stacked(centres), [centre.numbers for centre in centres]
        return _judged(surface, _ground(surface), side, radius, np.concatenate((*numbers, np.empty(0))), moves)


def judge_all(surface: Path, side: Side, radius: float, centres: Sequence[Path]) -> tuple[Verdict, ...]:
    """The verdict of `judge` on each centre path; the surface is looked at once, and equal paths are judged once."""
    keys = [_key(centre) for centre in centres] if len(centres) > 1 else [()] * len(centres)
    with np.errstate(all="ignore"):
        ground = _ground(surface) if len(surface) and _sound(surface) else None
        verdicts = {
            key: _verdict(surface, ground, side, radius, centre)
            for key, centre in dict(zip(keys, centres, strict=True)).items()
        }
    return tuple(verdicts[key] for key in keys)


def judgeable(surface: Path, radius: float, centre: Path) -> bool:
    """All coordinates and the radius are lengths a machine could have."""
    return _sound(surface) and _sound(centre) and isfinite(radius) and 0.0 <= radius <= LARGEST


def _sound(path: Path) -> bool:
    # what is not a number makes the largest one none, and no comparison holds
    return all(bool(np.abs(array).max(initial=0.0) <= LARGEST) for array in (path.points, path.centres))


def _key(path: Path) -> tuple[bytes, ...]:
    """What two equal paths have in common."""
    return tuple(array.tobytes() for array in (path.points, path.centres, path.turns, path.numbers))


@dataclass(frozen=True, eq=False, slots=True)
class _Ground:
    """A surface as every path over it needs it."""

    walls: Measured
    stations: Floats
    bounds: Floats
    closed: bool
    crossed: Crossings


def _ground(surface: Path) -> _Ground:
    walls = measured(surface)
    stations, bounds = walls.stations, boxes(walls)
    closed = bool(abs(walls.end[-1] - walls.start[0]) <= CLOSED)
    return _Ground(walls, stations, bounds, closed, crossings(walls, stations, bounds, closed=closed))


def _verdict(surface: Path, ground: _Ground | None, side: Side, radius: float, centre: Path) -> Verdict:
    if not judgeable(surface, radius, centre):
        return _unjudged(radius)
    if ground is None:
        return Verdict(radius, inf, (), NOTHING, 0.0, crosses_itself=False)
    return _judged(surface, ground, side, radius, centre.numbers, measured(centre))


def _unjudged(radius: float) -> Verdict:
    return Verdict(radius, nan, (), NOTHING, nan, crosses_itself=False, judged=False)


def _judged(surface: Path, ground: _Ground, side: Side, radius: float, numbers: Floats, moves: Measured) -> Verdict:
    slack = float(ground.walls.slack.max() + moves.slack.max(initial=0.0))
    if isinf(slack):
        return _unjudged(radius)
    reach = radius + 10.0 * GOUGE
    own = _own(moves, numbers, ground.walls, surface.numbers, side, radius)
    pairs = pairs_of(moves, ground.walls, ground.stations, ground.bounds, radius, reach + slack, own)
    near = approaches(pairs, radius - GOUGE)
    found = gouging(pairs, near)
    length = float(ground.stations[-1])
    sides = sided(side, ground.crossed, length, closed=ground.closed)
    return Verdict(
        radius=radius,
        clearance=clearance(pairs, near, reach),
        gouges=gouges(found, pairs, radius, surface, numbers),
        uncut=uncut(pairs, radius, surface, closed=ground.closed, side=side),
        surface_length=length,
        crosses_itself=len(ground.crossed) > 0,
        wrong_side=wrong_side(pairs, found, sides, reach),
        loose=loose(pairs),
        backwards=backwards(pairs, radius),
        crossing_at=_first(ground.crossed),
    )


def _own(moves: Measured, numbers: Floats, walls: Measured, segments: Floats, side: Side, radius: float) -> Beside:
    """The moves that run beside the wall of their number, where there are enough walls for that to save time."""
    known = segments[walls.rows]
    if len(known) <= FEW or not (known[1:] > known[:-1]).all():
        return NOBODY
    mine = numbers[moves.rows]
    wall = np.minimum(np.searchsorted(known, mine), len(known) - 1)
    own = beside(moves, np.where(known[wall] == mine, wall, -1), walls, side.sign, radius, granted(walls))
    return own if 4 * np.count_nonzero(own.piece >= 0) > len(known) else NOBODY


def _first(crossed: Crossings) -> tuple[float, float] | None:
    if not len(crossed):
        return None
    point = crossed.points[0].item()
    return point.real, point.imag
