"""Judge: decide what a center path from any source does to a surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.geometry.path import Floats, Path
from core.geometry.piece import Side
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import ARC_RADII, GOUGE
from core.verify.air_cuts import backwards, may_cut_air
from core.verify.gouge import closest, gouges, gouging
from core.verify.pairs import NotMeasurableError, measurable, pairs_of, rounding_of, uneven_slack
from core.verify.surface import Leads, Surface
from core.verify.uncut import covered_walls, uncut
from core.verify.verdict import UnevenArc, Verdict
from core.verify.wrong_side import with_sides, wrong_side


def judge(
    surface: Path,
    side: Side,
    radius: float,
    center: Path | Sequence[Path],
    arc_tolerance: float = ARC_RADII,
    *,
    leads: Leads = Leads.SEGMENTS,
    measures_uncut: bool = True,
) -> Verdict:
    """Judge what a cutter of this radius does to `surface` when its center runs along `center`, lead moves included.

    `center` may be several paths that are all cut, such as the loops of one contour; a gouge's `path_piece` then counts
    the pieces of all of them, in order.

    Every distance between lines and arcs is exact.  A path that is nearer than the radius by no more than GOUGE plus
    the slack of uneven arcs does not gouge: that is rounding.  `leads` says which parts of the surface's ends may
    belong to an over-run.

    No joined path raises an error.  A verdict is not `judged`, and so never clean, in three cases: a coordinate or the
    radius is not finite or exceeds LARGEST_COORDINATE; an arc's radii at its two ends differ by more than
    `arc_tolerance` (mm); an uneven arc has both ends on one ray from its center.

    Without `measures_uncut` the verdict says nothing of what stays uncut, which takes most of the time.
    """
    centers = (center,) if isinstance(center, Path) else center
    if not measurable(radius, surface, *centers):
        return _unjudged(radius)
    if not len(surface):
        return Verdict(radius, None, (), (), 0.0, crosses_itself=False)
    prepared = Surface.prepare(surface, side, leads=leads)
    return judge_prepared(prepared, radius, centers, arc_tolerance, measures_uncut=measures_uncut)


def judge_prepared(
    surface: Surface,
    radius: float,
    centers: Sequence[Path],
    arc_tolerance: float = ARC_RADII,
    *,
    measures_uncut: bool = True,
) -> Verdict:
    """Judge like `judge`, on a surface that is already prepared."""
    if not measurable(radius, *centers):
        return _unjudged(radius)
    with np.errstate(all="ignore"):
        moves = piece_arrays(*centers)
        numbers = np.concatenate((np.empty(0), *(center.numbers for center in centers)))
        for pieces, piece_numbers in ((surface.walls, surface.path.numbers), (moves, numbers)):
            worst = int(pieces.slack.argmax()) if len(pieces) else 0
            if len(pieces) and not pieces.slack[worst] <= arc_tolerance:
                number, slack = float(piece_numbers[pieces.rows[worst]]), float(pieces.slack[worst])
                return _unjudged(radius, UnevenArc(number, slack, on_surface=pieces is surface.walls))
        try:
            return _judged(surface, radius, moves, numbers, measures_uncut=measures_uncut)
        except NotMeasurableError:
            return _unjudged(radius)


def _unjudged(radius: float, arc: UnevenArc | None = None) -> Verdict:
    return Verdict(radius, None, (), (), float("nan"), crosses_itself=False, judged=False, uneven_arc=arc)


def _judged(surface: Surface, radius: float, moves: PieceArrays, numbers: Floats, *, measures_uncut: bool) -> Verdict:
    walls, side = surface.walls, surface.side
    pairs = pairs_of(moves, walls, rounding_of(walls))
    if np.isnan(pairs.least).any():
        return _unjudged(radius)
    gouging_parts = gouging(pairs, radius - GOUGE)
    wrong, deepest = wrong_side(
        pairs, gouging_parts, with_sides(side, walls, surface.crossings, closed=surface.closed), radius
    )
    crossing_points = surface.crossings.points[:1].tolist()
    verdict = Verdict(
        radius=radius,
        closest=closest(pairs, surface.path),
        gouges=gouges(deepest, pairs, radius, surface.path, numbers),
        uncut=(),
        surface_length=float(walls.stations[-1]),
        crosses_itself=bool(crossing_points),
        wrong_side=tuple(moves.rows[wrong].tolist()),
        may_cut_air=may_cut_air(pairs, radius),
        backwards=backwards(pairs, radius),
        crossing_at=(crossing_points[0].real, crossing_points[0].imag) if crossing_points else None,
        over_run=surface.over_run,
        radius_slack=float(uneven_slack(moves, pairs.i, walls, pairs.j).max(initial=0.0)),
    )
    if not measures_uncut:
        return verdict
    covered = covered_walls(pairs, radius, closed=surface.closed)
    # free the memory of the moves' pairs before those of the walls are made
    del pairs
    uncut_stretches = uncut(walls, moves, covered, radius, surface.path, side, closed=surface.closed)
    return replace(verdict, uncut=uncut_stretches)
