"""The judge: what a center path, whoever made it, does to a surface."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import inf, isfinite, isinf, isnan, nan
from typing import Final

import numpy as np

from core.geometry.boxes import near_pairs
from core.geometry.path import Floats, Path
from core.geometry.piece import Side
from core.geometry.piece_arrays import PieceArrays
from core.tolerance import CLOSED, GOUGE, LARGEST
from core.verify.behind import behind, deepened, parted
from core.verify.beside import NOBODY, Beside, beside
from core.verify.contact import backwards, loose
from core.verify.course import Course, courses
from core.verify.crossing import Crossings, crossings
from core.verify.gouge import gouges, gouging
from core.verify.pairs import Approaches, Pairs, approaches, clearance, granted, pairs_of
from core.verify.ruling import Ruling
from core.verify.sides import sided, wrong_side
from core.verify.uncut import uncut
from core.verify.verdict import NOTHING, Verdict

FEW: Final = 300
"""Walls of which measuring every pair costs less than proving what runs beside them."""

FEW_PAIRS: Final = 2_000
"""Pairs of a path that is judged when its verdict is read: that takes no longer than a picture."""


def judge(surface: Path, side: Side, radius: float, center: Path) -> Verdict:
    """What a cutter of this radius does whose center runs along `center`, lead moves included, beside `surface`.

    Every distance is exact, between lines and arcs.  Nearer than the radius by no more than GOUGE, or than what the
    uneven radii of an arc leave open, is rounding and no gouge.  Nothing is raised for any joined paths: coordinates
    or a radius that are not finite, or larger than LARGEST, and arcs whose radii at both ends differ by more than
    ARC_RADII, or at all with both ends on one ray from the center, give a verdict that is not `judged` and so never
    clean.
    """
    return judge_together(surface, side, radius, (center,))


def judge_together(surface: Path, side: Side, radius: float, centers: Sequence[Path]) -> Verdict:
    """The verdict on several center paths that are all cut, such as the loops of one contour.

    A gouge's `path_piece` counts the pieces of all of them, in order.
    """
    return judge_on_ground(surface, side, radius, centers)[0]


def judge_on_ground(
    surface: Path, side: Side, radius: float, centers: Sequence[Path], before: Ground | None = None
) -> tuple[Verdict, Ground | None]:
    """The verdict of `judge_together`, and the surface as it is judged, for `rulings`; None where it is not.

    `before` is another surface, of which this one may have most pieces.
    """
    with np.errstate(all="ignore"):
        if not judgeable(radius, surface, *centers):
            return _unjudged(radius), None
        if not len(surface):
            return _nothing_to_cut(radius), None
        walls, moves = courses((surface,), centers)
        numbers = np.concatenate((np.empty(0), *(center.numbers for center in centers)))
        ground = _ground(surface, walls, before)
        measured = _measured(ground, side, radius, numbers, moves)
        verdict = _unjudged(radius) if measured is None else _judged(ground, side, radius, numbers, measured)
        return verdict, ground


def rulings(
    surface: Path, side: Side, radius: float, centers: Sequence[Path], ground: Ground | None = None
) -> tuple[Ruling, ...]:
    """Whether each center path is clean, with the verdict of `judge` on it.

    The surface is looked at once, and equal paths are judged once.  `ground` saves to look at the surface again; one of
    another surface is not used.
    """
    keys = [_key(center) for center in centers] if len(centers) > 1 else [()] * len(centers)
    paths = dict(zip(keys, centers, strict=True))
    with np.errstate(all="ignore"):
        found = dict(zip(paths, _each(surface, side, radius, tuple(paths.values()), ground), strict=True))
    return tuple(found[key] for key in keys)


def _each(surface: Path, side: Side, radius: float, centers: Sequence[Path], ground: Ground | None) -> Iterator[Ruling]:
    if not len(surface) or not judgeable(radius, surface):
        yield from (Ruling.of(judge(surface, side, radius, center)) for center in centers)
        return
    if ground is None or ground.surface is not surface:
        found = courses((surface,), *((center,) for center in centers))
        ground = _ground(surface, next(found))
    else:
        found = courses(*((center,) for center in centers))
    for center, moves in zip(centers, found, strict=True):
        if judgeable(radius, center):
            yield _ruled(ground, side, radius, center, moves)
        else:
            yield Ruling.of(_unjudged(radius))


def judgeable(radius: float, *paths: Path) -> bool:
    """All coordinates and the radius are lengths a machine could have."""
    numbers = np.concatenate([array for path in paths for array in (path.points, path.centers)])
    # what is not a number makes the largest one none, and no comparison holds
    sound = bool(np.abs(numbers, out=numbers).max(initial=0.0) <= LARGEST)
    return sound and isfinite(radius) and 0.0 <= radius <= LARGEST


def _key(path: Path) -> tuple[bytes, ...]:
    """What two equal paths have in common."""
    return tuple(array.tobytes() for array in (path.points, path.centers, path.turns, path.numbers))


@dataclass(frozen=True, eq=False, slots=True)
class Ground:
    """A surface as every path over it needs it, whatever the side and the radius."""

    surface: Path
    walls: Course
    closed: bool
    crossed: Crossings


def _ground(surface: Path, walls: Course, before: Ground | None = None) -> Ground:
    pieces = walls.pieces
    closed = bool(abs(pieces.start[-1] + pieces.vector[-1] - pieces.start[0]) <= CLOSED)
    free = None if before is None or before.closed != closed or len(before.crossed) else before.walls
    return Ground(surface, walls, closed, crossings(walls, closed=closed, free=free))


def _unjudged(radius: float) -> Verdict:
    return Verdict(radius, nan, (), NOTHING, nan, crosses_itself=False, judged=False)


def _nothing_to_cut(radius: float) -> Verdict:
    return Verdict(radius, inf, (), NOTHING, 0.0, crosses_itself=False)


def _ruled(ground: Ground, side: Side, radius: float, center: Path, moves: Course) -> Ruling:
    """Not clean where any pair is too near: a path with few pairs is then judged when its verdict is read."""
    if _cuts_in(moves, ground.walls, radius):
        return Ruling(partial(_again, ground, side, radius, center), clean=False)
    measured = _measured(ground, side, radius, center.numbers, moves)
    if measured is None:
        return Ruling.of(_unjudged(radius))
    if len(measured.near.i) and len(measured.pairs.i) <= FEW_PAIRS:
        # nothing of what is measured here is kept: a table's twenty paths would hold more than all the rest
        return Ruling(partial(_again, ground, side, radius, center), clean=False)
    return Ruling.of(_judged(ground, side, radius, center.numbers, measured))


def _cuts_in(moves: Course, walls: Course, radius: float) -> bool:
    """Whether a corner of the path is too near to one of the surface, which most paths that gouge tell at a glance.

    The pairs of both are then measured when the verdict is read.  What rounding leaves open is not told here.
    """
    limit = radius - 2.0 * GOUGE - float(walls.pieces.slack.max() + moves.pieces.slack.max(initial=0.0))
    if limit <= 0.0:
        return False
    i, j = near_pairs(moves.boxes, walls.boxes, limit)
    if len(i) > FEW_PAIRS:
        return False
    return bool((np.abs(moves.pieces.start.take(i) - walls.pieces.start.take(j)) < limit).any())


@np.errstate(all="ignore")
def _again(ground: Ground, side: Side, radius: float, center: Path) -> Verdict:
    (moves,) = courses((center,))
    measured = _measured(ground, side, radius, center.numbers, moves)
    return _unjudged(radius) if measured is None else _judged(ground, side, radius, center.numbers, measured)


@dataclass(frozen=True, eq=False, slots=True)
class _Measured:
    """The pairs of a path and a surface, those that are too near, and what uneven arcs leave open."""

    pairs: Pairs
    near: Approaches
    slack: float


def _measured(ground: Ground, side: Side, radius: float, numbers: Floats, moves: Course) -> _Measured | None:
    """None where an arc's radii leave everything open, or a distance is no number."""
    surface, walls = ground.surface, ground.walls
    slack = float(walls.pieces.slack.max() + moves.pieces.slack.max(initial=0.0))
    if isinf(slack):
        return None
    own = _own(moves.pieces, numbers, walls.pieces, surface.numbers, side, radius)
    pairs = pairs_of(moves, walls, radius, radius + 10.0 * GOUGE + slack, own)
    near = approaches(pairs, radius - GOUGE)
    return None if isnan(near.least) else _Measured(pairs, near, slack)


def _judged(ground: Ground, side: Side, radius: float, numbers: Floats, measured: _Measured) -> Verdict:
    surface, length = ground.surface, float(ground.walls.stations[-1])
    pairs, near, reach = measured.pairs, measured.near, radius + 10.0 * GOUGE
    found = gouging(pairs, near)
    sides = sided(side, ground.crossed, length, closed=ground.closed)
    parts = parted(pairs, near, found, sides, radius)
    wrong, told = wrong_side(pairs, found, sides, reach, parts)
    inside = behind(pairs, parts.keep(told), radius)
    # of a piece that meets the surface a part is behind it
    wrong[inside.index] = True
    deeper = deepened(found, inside, radius, measured.slack)
    return Verdict(
        radius=radius,
        clearance=clearance(pairs, near, reach),
        gouges=gouges(deeper, pairs, radius, surface, numbers),
        uncut=uncut(pairs, radius, surface, closed=ground.closed, side=side),
        surface_length=length,
        crosses_itself=len(ground.crossed) > 0,
        wrong_side=tuple(pairs.center.rows[wrong].tolist()),
        loose=loose(pairs),
        backwards=backwards(pairs, radius),
        crossing_at=_first(ground.crossed),
    )


def _own(
    moves: PieceArrays, numbers: Floats, walls: PieceArrays, segments: Floats, side: Side, radius: float
) -> Beside:
    """The moves that run beside the wall of their number, where there are enough walls for that to save time."""
    if len(walls) <= FEW:
        return NOBODY
    known = segments[walls.rows]
    if not (known[1:] > known[:-1]).all():
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
