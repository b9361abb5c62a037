"""Judge: what a center path, whoever made it, does to a surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, nan

import numpy as np

from core.geometry.path import Floats, Path
from core.geometry.piece import Side
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import CLOSED, GOUGE
from core.verify.contact import backwards, loose
from core.verify.crossing import Crossings, crossings
from core.verify.gouge import closest, gouges, gouging
from core.verify.pairs import measurable, pairs_of, rounding_of
from core.verify.uncut import uncut
from core.verify.verdict import NOTHING, Verdict
from core.verify.wrong_side import sided, wrong_side


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """A surface prepared for any number of paths over it, whatever their side and radius."""

    path: Path
    walls: PieceArrays
    closed: bool
    crossings: Crossings

    @staticmethod
    def prepare(path: Path) -> Surface:
        """The pieces of a surface that can be judged, and where it meets itself."""
        with np.errstate(all="ignore"):
            walls = piece_arrays(path)
            closed = bool(abs(walls.end[-1] - walls.start[0]) <= CLOSED)
            return Surface(path, walls, closed, crossings(walls, closed=closed))


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
    if not measurable(radius, surface, *centers):
        return _unjudged(radius)
    if not len(surface):
        return Verdict(radius, None, (), NOTHING, 0.0, crosses_itself=False)
    return judge_prepared(Surface.prepare(surface), side, radius, centers)


def judge_prepared(surface: Surface, side: Side, radius: float, centers: Sequence[Path]) -> Verdict:
    """The verdict of `judge_together` on a surface that is prepared."""
    if not measurable(radius, *centers):
        return _unjudged(radius)
    with np.errstate(all="ignore"):
        moves = piece_arrays(*centers)
        numbers = np.concatenate((np.empty(0), *(center.numbers for center in centers)))
        return _judged(surface, side, radius, moves, numbers)


def _unjudged(radius: float) -> Verdict:
    return Verdict(radius, None, (), NOTHING, nan, crosses_itself=False, judged=False)


def _judged(surface: Surface, side: Side, radius: float, moves: PieceArrays, numbers: Floats) -> Verdict:
    walls = surface.walls
    rounding = rounding_of(walls)
    if not isfinite(float(walls.slack.max() + moves.slack.max(initial=0.0))):
        return _unjudged(radius)
    pairs = pairs_of(moves, walls, rounding)
    if np.isnan(pairs.least).any():
        return _unjudged(radius)
    found = gouging(pairs, radius - GOUGE)
    wrong, deepest = wrong_side(pairs, found, sided(side, walls, surface.crossings, closed=surface.closed), radius)
    return Verdict(
        radius=radius,
        closest=closest(pairs, surface.path),
        gouges=gouges(deepest, pairs, radius, surface.path, numbers),
        uncut=uncut(pairs, radius, surface.path, side, rounding, closed=surface.closed),
        surface_length=float(walls.stations[-1]),
        crosses_itself=len(surface.crossings) > 0,
        wrong_side=tuple(moves.rows[wrong].tolist()),
        loose=loose(pairs, radius),
        backwards=backwards(pairs, radius),
        crossing_at=_first(surface.crossings),
    )


def _first(crossed: Crossings) -> tuple[float, float] | None:
    if not len(crossed):
        return None
    point = crossed.points[0].item()
    return point.real, point.imag
