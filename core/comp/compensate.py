"""Compensate: a contour's centre path under the control's look-ahead rule, every stage kept.

The stages: zero-length segments dropped, offset to the raw chain, crossings found, walked and pruned, blended.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.comp import trouble
from core.comp.blend import blend_in, blend_out
from core.comp.crossings import crossings
from core.comp.offset import Chain, offset
from core.comp.prune import Pruned, prune
from core.comp.result import Compensated, Deletions
from core.finding import Finding
from core.geometry.intersect import Indices, planes
from core.geometry.path import EMPTY, Path
from core.geometry.side import Side
from core.tolerance import JOINED


def compensate(
    contour: Path,
    side: Side,
    radius: float,
    lookahead: int,
    *,
    closed: bool,
    blend: float = 0.0,
    overlap: float = 0.0,
) -> Compensated:
    """The centre path of a contour at `radius` millimetres to `side`, at one look-ahead.

    `closed` is whether the programmed contour ends at its start; its first and last segments are then never tested
    against each other.  `blend` is the radius of the blend arcs, `overlap` how far a closed contour runs past its
    start, millimetres, 0 = none.  A contour that cannot be compensated gives an empty path and an error finding.
    """
    return compensate_all(contour, side, radius, (lookahead,), closed=closed, blend=blend, overlap=overlap)[0]


def compensate_all(
    contour: Path,
    side: Side,
    radius: float,
    lookaheads: Sequence[int],
    *,
    closed: bool,
    blend: float = 0.0,
    overlap: float = 0.0,
) -> tuple[Compensated, ...]:
    """`compensate` at several look-aheads, in their order; offsets and crossings are found once.

    Look-aheads that test the same crossings share their arrays: their `path` is one object.
    """
    values = tuple(lookaheads)
    refused = trouble.refusal(contour, radius, values)
    if refused or not values:
        return tuple(_nothing(contour, side, radius, value, refused, closed=closed) for value in values)
    surface, common = _with_length(contour)
    if not len(surface):
        empty = trouble.refusal(surface, radius, values)
        return tuple(_nothing(surface, side, radius, value, (*common, *empty), closed=closed) for value in values)
    if closed:
        common += trouble.inside_start(surface, side, radius)
    chain = offset(surface, side, radius)
    found = crossings(chain, max(values), closed=closed)
    made: dict[int, Compensated] = {}
    for value in sorted(set(values)):
        others = found.within(value)
        same = next((one for one in made.values() if len(found.within(one.lookahead)) == len(others)), None)
        if same is None:
            pruned = prune(chain, found.joints, others, last_wins=closed and len(surface) == 2)
            findings = (*common, *_findings(surface, chain, pruned, radius, closed=closed))
            made[value] = Compensated(
                surface,
                side,
                radius,
                value,
                closed,
                chain.raw,
                pruned.path,
                pruned.bridged,
                pruned.deleted,
                blend_in(pruned.path, side, blend),
                blend_out(pruned.path, side, blend, overlap, closed=closed),
                findings,
            )
        else:
            made[value] = replace(same, lookahead=value)
    return tuple(made[value] for value in values)


def _findings(surface: Path, chain: Chain, pruned: Pruned, radius: float, *, closed: bool) -> list[Finding]:
    found = trouble.standing(surface, chain, pruned, radius)
    if closed:
        found += trouble.long_way(surface, pruned)
    if not len(pruned.path):
        found.append(trouble.nothing_left())
    return found


def _nothing(
    contour: Path, side: Side, radius: float, lookahead: int, findings: tuple[Finding, ...], *, closed: bool
) -> Compensated:
    """The answer to a contour that has no centre path."""
    none = Deletions(np.empty(0), np.empty((0, 2)), np.empty((0, 2)))
    still = np.empty(0, np.bool_)
    return Compensated(contour, side, radius, lookahead, closed, EMPTY, EMPTY, still, none, EMPTY, EMPTY, findings)


def _with_length(contour: Path) -> tuple[Path, list[Finding]]:
    """The contour without its zero-length segments, and a finding for each of them."""
    points = planes(contour.points)
    near = np.flatnonzero(np.abs(points[1:] - points[:-1]) <= JOINED)
    dropped = np.array([row for row in near.tolist() if contour[row].length <= JOINED], np.intp)
    if not len(dropped):
        return contour, []
    return _without(contour, dropped), trouble.zero_length(contour, dropped)


def _without(contour: Path, dropped: Indices) -> Path:
    """The contour without some segments of no length: the next one starts where the one before ends."""
    kept = np.ones(len(contour), np.bool_)
    kept[dropped] = False
    points = np.concatenate((contour.points[:1], contour.points[1:][kept]))
    whole = np.flatnonzero((contour.points[1:] == contour.points[:-1]).all(axis=1)[kept])
    for row in whole[::-1].tolist():
        points[row] = points[row + 1]
    return Path.of(points, contour.centres[kept], contour.turns[kept], contour.numbers[kept])
